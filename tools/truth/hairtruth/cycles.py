"""Path tracing of the cases by Cycles, in the Python of Blender, which has the package bpy."""

import math
import sys

import bpy
import mathutils
import numpy as np

from hairtruth import cases

# Cycles traces millimetres around the origin, as Mitsuba does here.
UNIT = 1000.0  # of Cycles' lengths in a metre
BOUNCES = 199  # of paths, which are those of Mitsuba's depth of 200
ROULETTE = 19  # bounces after which paths may end by chance, as those of Mitsuba here
MAX_THREADS = 2


def _place(position):
    """Return a position in Cycles' space."""
    return mathutils.Vector([UNIT * (x - middle) for x, middle in zip(position, cases.TARGET)])


def _link(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def add_camera():
    camera = bpy.data.cameras.new("eye")
    camera.angle = math.radians(cases.FIELD_OF_VIEW)
    camera.clip_start, camera.clip_end = 0.01 * UNIT, 100 * UNIT
    eye = _link("eye", camera)
    backward = _place(cases.EYE).normalized()
    right = mathutils.Vector((0, 1, 0)).cross(backward).normalized()
    turn = mathutils.Matrix((right, backward.cross(right), backward)).transposed()
    eye.matrix_world = mathutils.Matrix.Translation(_place(cases.EYE)) @ turn.to_4x4()
    bpy.context.scene.camera = eye


def add_strands(strands, radius, material):
    """Add strands of one radius, an array of strands, vertices and coordinates in metres."""
    curves = bpy.data.hair_curves.new("hair")
    curves.add_curves([strands.shape[1]] * len(strands))
    points = UNIT * (strands.astype(np.float64) - cases.TARGET)
    curves.attributes["position"].data.foreach_set("vector", points.ravel().astype(np.float32))
    if "radius" not in curves.attributes:
        curves.attributes.new("radius", "FLOAT", "POINT")
    radii = np.full(points.shape[:2], UNIT * radius, np.float32)
    curves.attributes["radius"].data.foreach_set("value", radii.ravel())
    curves.materials.append(material)
    return _link("hair", curves)


def make_fibre():
    """Return a material of hair and its node, whose absorption is not set."""
    material = bpy.data.materials.new("fibre")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    fibre, output = nodes.new("ShaderNodeBsdfHairPrincipled"), nodes.new("ShaderNodeOutputMaterial")
    fibre.model, fibre.parametrization = "CHIANG", "ABSORPTION"
    values = {"Roughness": cases.ALONG, "Radial Roughness": cases.AROUND, "Coat": 0,
              "IOR": cases.REFRACTION, "Offset": cases.TILT,
              "Random Roughness": 0}
    for name, value in values.items():
        fibre.inputs[name].default_value = value
    # A ray that starts inside of another fibre leaves that fibre unseen, as rays of Mitsuba do.
    # Shadow rays ignore this, because Cycles bakes one transparency for both sides of a curve.
    side, clear = nodes.new("ShaderNodeNewGeometry"), nodes.new("ShaderNodeBsdfTransparent")
    either = nodes.new("ShaderNodeMixShader")
    for start, end in ((side.outputs["Backfacing"], either.inputs[0]),
                       (fibre.outputs[0], either.inputs[1]), (clear.outputs[0], either.inputs[2]),
                       (either.outputs[0], output.inputs["Surface"])):
        material.node_tree.links.new(start, end)
    return material, fibre


def add_lights(light):
    """Add the lights of a case in place of those of the case before."""
    for thing in [thing for thing in bpy.data.objects if thing.type == "LIGHT"]:
        bpy.data.objects.remove(thing)
    for way, color in light.suns():
        sun = bpy.data.lights.new("sun", "SUN")
        sun.angle, sun.energy, sun.color = 0, 1, color
        turn = mathutils.Vector(way).to_track_quat("Z", "Y")
        _link("sun", sun).matrix_world = turn.to_matrix().to_4x4()
    for at, color in light.lamps():
        lamp = bpy.data.lights.new("lamp", "POINT")
        # A lamp of Blender has a power, whose intensity is the same all around.
        lamp.shadow_soft_size, lamp.energy, lamp.color = 0, 4 * math.pi * UNIT**2, color
        _link("lamp", lamp).location = _place(at)
    world = bpy.context.scene.world
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    background.inputs["Strength"].default_value = light.sky() / math.pi
    world.cycles_visibility.camera = False


def set_options(size, samples):
    """Turn off all that makes Cycles faster and biased."""
    scene = bpy.context.scene
    cycles, render = scene.cycles, scene.render
    render.engine, cycles.device = "CYCLES", "CPU"
    render.threads_mode, render.threads = "FIXED", MAX_THREADS
    render.use_persistent_data = True
    render.resolution_x = render.resolution_y = size
    render.resolution_percentage = 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.view_settings.view_transform = "Raw"
    scene.cycles_curves.shape = "THICK"
    for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces",
                 "transparent_max_bounces"):
        setattr(cycles, name, BOUNCES)
    cycles.samples, cycles.min_light_bounces = samples, ROULETTE
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_auto_tile = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0


def make_scene(strands, radius, size, samples):
    """Make a scene of strands without lights. Return the node of their fibre."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.world = bpy.data.worlds.new("sky")
    set_options(size, samples)
    add_camera()
    material, fibre = make_fibre()
    add_strands(strands, radius, material)
    return fibre


def render(path, seed):
    bpy.context.scene.cycles.seed = seed
    bpy.context.scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def main(arguments):
    """Trace pictures of a case, which differ by their random numbers, into EXR files."""
    name, strands, prefix = arguments[:3]
    size, samples, parts = (int(argument) for argument in arguments[3:])
    case = next(case for case in cases.all_cases() if case.name == name)
    fibre = make_scene(np.load(strands), cases.HAIRCUTS[case.haircut].radius, size, samples)
    fibre.inputs["Absorption Coefficient"].default_value = cases.absorption(case.reflectance)
    add_lights(case.light)
    for part in range(parts):
        render(f"{prefix}{part}.exr", part)


if __name__ == "__main__":
    main(sys.argv[1:])
