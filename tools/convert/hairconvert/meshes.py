"""The table of mesh formats, and reading and writing through it."""

import os

from hairconvert import gltf, groomfile, obj, tfxmesh
from hairconvert.formats import refuse_errors
from hairconvert.groom import rotate_from_y
from hairconvert.mesh import check_mesh, place_mesh
from hairconvert.report import InputError, UsageError



def _read_usd(path, name, report):
    from hairconvert import usd_mesh  # Only here, because the packages of USD may be missing.
    return usd_mesh.read(path, name, report)


READERS = {(".gltf", ".glb"): gltf.read, (".obj",): obj.read_mesh, (".tfxmesh",): tfxmesh.read,
           (".groom",): groomfile.read_mesh, (".usda", ".usdc", ".usd", ".usdz"): _read_usd}
WRITERS = {(".obj",): obj.write_mesh, (".tfxmesh",): tfxmesh.write}


def _find(table, path):
    for endings, call in table.items():
        if str(path).lower().endswith(endings):
            return call
    known = ", ".join(e for endings in table for e in endings)
    raise UsageError(f"the name {path} does not end in one of {known}")


def is_mesh(path):
    """Return whether a name is that of a mesh only."""
    return str(path).lower().endswith((".gltf", ".glb", ".tfxmesh"))


def read_mesh(path, options, report):
    """Return the mesh of a file, in metres with +y up."""
    reader = _find(READERS, path)
    if not os.path.isfile(path):
        raise InputError("there is no such file")
    mesh = refuse_errors(reader, path, options.mesh, report)
    return place_mesh(check_mesh(mesh, report), options.scale or mesh.unit or 1,
                      options.up or mesh.up or "y")


def write_mesh(mesh, path, name, options, report):
    """Write a mesh to a path in the format of the final name."""
    writer = _find(WRITERS, name)
    mesh.points = rotate_from_y(mesh.points, options.output_up) / (options.output_scale or 1)
    writer(mesh, path, report)


def check_mesh_output(name):
    """Refuse a name whose ending is that of no format that is written."""
    _find(WRITERS, name)


def describe_mesh(mesh):
    """Return lines that describe a mesh."""
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    lines = [
        f"format      {mesh.format}",
        f"vertices    {len(mesh.points)}",
        f"triangles   {len(mesh.triangles)}",
        "bounds      (" + ", ".join(f"{x:.6g}" for x in low) + ") to (" +
        ", ".join(f"{x:.6g}" for x in high) + ") m",
        f"texture     {'one coordinate per vertex' if mesh.uv is not None else 'none'}",
    ]
    joints = f"{len(mesh.joint_names)} joints" if mesh.weights is not None else "none"
    return [*lines, f"skin        {joints}"]
