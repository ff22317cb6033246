"""The command line of hair-convert."""

import argparse
import os
import sys

from hairconvert import __version__, info
from hairconvert.dump import add_attributes
from hairconvert.formats import FORMATS, find_format, read_groom, write_groom
from hairconvert.guard import run_guarded
from hairconvert.meshes import (check_mesh_output, describe_mesh, is_mesh, read_mesh,
                                write_mesh)
from hairconvert.report import (EXIT_INPUT, EXIT_OK, EXIT_RUNTIME, EXIT_USAGE, TOOL, InputError,
                                MissingPackage, Report, UsageError, escape)


class Parser(argparse.ArgumentParser):
    """A parser that says one sentence about a wrong argument."""

    def error(self, message):
        complain(message)
        complain("--help lists the options")
        sys.exit(EXIT_USAGE)


def complain(sentence):
    """Print a sentence to stderr."""
    print(f"{TOOL}: {escape(sentence)}", file=sys.stderr)


def _number(low, high):
    def parse(text):
        value = float(text)
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text} is not in [{low:g}, {high:g}]")
        return value
    parse.__name__ = "number"
    return parse


def _whole(low, high):
    def parse(text):
        value = int(text)
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text} is not in [{low}, {high}]")
        return value
    parse.__name__ = "whole number"
    return parse


def make_parser():
    """Return the parser of all commands."""
    parser = Parser(prog=TOOL, description=__doc__.replace("The command line of hair-convert.", "")
                    + "Convert strand hair between " + ", ".join(f.name for f in FORMATS) + ".",
                    epilog="Exit status: 0 done, 1 failed while running, 2 wrong use, 4 unusable "
                    "input.")
    parser.add_argument("--version", action="version", version=f"{TOOL} {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND",
                                     parser_class=Parser)
    about = commands.add_parser("info", help="describe the strands of a file")
    about.add_argument("input", metavar="FILE")
    _add_input_options(about)
    convert = commands.add_parser("convert", help="convert a file to the format of another name")
    convert.add_argument("input", metavar="IN")
    convert.add_argument("output", metavar="OUT")
    _add_input_options(convert)
    _add_output_options(convert)
    _add_curve_options(convert)
    _add_scalp_options(convert)
    motion = commands.add_parser("motion", help="write a dump of hair-capture as USD time samples "
                                 "or as an Alembic cache")
    motion.add_argument("input", metavar="DUMP", help="of hair-capture --dump-guides or "
                        "--dump-followers")
    motion.add_argument("output", metavar="OUT")
    motion.add_argument("--groom", metavar="FILE", help="the haircut whose attributes the strands "
                        "get, matched by the roots of the first frame")
    _add_output_options(motion)
    _add_curve_options(motion)
    motion.set_defaults(scale=None, up=None, frame=None, samples=None, tip_first=False, take="all",
                        vertices=None, mesh=None)
    scalp = commands.add_parser("scalp", help="convert a mesh (.gltf, .glb, .usd, .obj, .tfxmesh, "
                                "or the scalp of .groom) to "
                                ".obj or .tfxmesh, with texture coordinates or skin weights")
    scalp.add_argument("input", metavar="IN")
    scalp.add_argument("output", metavar="OUT")
    _add_unit_options(scalp)
    _add_mesh_option(scalp)
    _add_output_options(scalp)
    return parser


def _add_curve_options(parser):
    parser.add_argument("--basis", choices=("linear", "catmullRom"), default="linear",
                        help="of curves in USD, both go through the vertices; linear")
    parser.add_argument("--width", metavar="X", type=_number(1e-7, 1),
                        help="diameter of strands, m, if the input has no widths")


def _add_scalp_options(parser):
    parser.add_argument("--scalp", metavar="MESH", help="fit the haircut to this mesh: seat roots, "
                        "lead strands out of the head, add root_uv")
    parser.add_argument("--scalp-scale", metavar="X", type=_number(1e-6, 1e6),
                        help="metres of one unit of the scalp; without it, what the file says, "
                        "else 1")
    parser.add_argument("--scalp-up", choices="xyz", help="the axis of the scalp that points up; "
                        "without it, what the file says, else y")
    parser.add_argument("--seat-within", metavar="X", type=_number(0, 10), default=0.02,
                        help="roots farther from the scalp than this stay, m; 0.02")
    parser.add_argument("--bones", metavar="FILE.tfxbone", help="write the joints and weights of "
                        "each strand, from the skin of the scalp")


def _add_mesh_option(parser):
    parser.add_argument("--mesh", metavar="NAME", help="only the meshes, nodes, objects or groups "
                        "of this name; without it, all")


def _add_unit_options(parser):
    parser.add_argument("--scale", metavar="X", type=_number(1e-6, 1e6),
                        help="metres of one unit of the input; without it, what the file says, "
                        "0.01 for Alembic, else 1")
    parser.add_argument("--up", choices="xyz", help="the axis of the input that points up; without "
                        "it, what the file says, else y")


def _add_input_options(parser):
    _add_unit_options(parser)
    _add_mesh_option(parser)
    parser.add_argument("--frame", metavar="T", type=_number(-1e9, 1e9),
                        help="the time code of the pose, for USD, or the time in s, for Alembic; "
                        "without it, the first")
    parser.add_argument("--samples", metavar="N", type=_whole(1, 64),
                        help="edges of the polyline per segment of a cubic curve; without it, as "
                        "many as keep within 0.001 of the strand's length, and 1 for catmullRom")
    parser.add_argument("--tip-first", action="store_true",
                        help="strands of the input run from tip to root")
    parser.add_argument("--take", choices=("all", "guides", "strands"), default="all",
                        help="guides, or only strands that are no guides; all")
    parser.add_argument("--vertices", metavar="N", type=_whole(2, 65536),
                        help="resample every strand to this number of vertices")


def _add_output_options(parser):
    parser.add_argument("--output-scale", metavar="X", type=_number(1e-6, 1e6),
                        help="metres of one unit of the output; 0.01 for Alembic, else 1")
    parser.add_argument("--output-up", choices="yz", default="y",
                        help="the axis of the output that points up; y")


def temporary_name(path):
    """Return the name under which an output is written before it is complete."""
    folder, name = os.path.split(os.path.abspath(path))
    return os.path.join(folder, f".{os.getpid()}.{name}")


def run(options, temporary=None):
    """Run a parsed command. Return the exit status after printing every sentence."""
    report, status = Report(), EXIT_OK
    try:
        if options.command == "info":
            print("\n".join(_describe(options, report)))
        else:
            command = {"convert": _convert, "motion": _convert_motion,
                       "scalp": _convert_mesh}[options.command]
            _write_whole(command, options, temporary or temporary_name(options.output), report)
    except InputError as error:
        status, sentence = EXIT_INPUT, f"{options.input}: {error}"
    except UsageError as error:
        status, sentence = EXIT_USAGE, str(error)
    except MissingPackage as error:
        status, sentence = EXIT_RUNTIME, str(error)
    except MemoryError:
        status, sentence = EXIT_RUNTIME, f"out of memory for {options.input}"
    except OSError as error:
        status, sentence = EXIT_RUNTIME, f"{error.filename or ''}: {error.strerror or error}"
    for said in report.sentences:
        complain(f"{options.input}: {said}")
    if status:
        complain(sentence)
    return status


def _describe(options, report):
    if is_mesh(options.input):
        return describe_mesh(read_mesh(options.input, options, report))
    return info.describe(read_groom(options.input, options, report))


def _write_whole(command, options, temporary, report):
    """Write a temporary file, which gets its name when it is complete."""
    try:
        command(options, temporary, report)
        os.replace(temporary, options.output)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)


def _convert(options, temporary, report):
    find_format(options.output, to_write=True)
    groom = read_groom(options.input, options, report)
    if options.bones and not options.scalp:
        raise UsageError("--bones needs the skin of a --scalp")
    if options.scalp:
        groom = _fit_to_scalp(groom, options, report)
    write_groom(groom, temporary, options.output, options, report)


def _fit_to_scalp(groom, options, report):
    from hairconvert import repair, tfxmesh  # Only here, because igl takes time to load.
    mesh_options = argparse.Namespace(mesh=options.mesh, scale=options.scalp_scale,
                                      up=options.scalp_up)
    try:
        mesh = read_mesh(options.scalp, mesh_options, report)
        if options.bones and mesh.weights is None:
            raise InputError("the mesh has no skin, which --bones needs")
    except InputError as error:
        raise InputError(f"the scalp {options.scalp}: {error}") from None
    groom, surface = repair.fit_to_scalp(groom, mesh, options.seat_within, report)
    if options.bones:
        joints, weights = repair.find_bones(groom, mesh, surface)
        temporary = temporary_name(options.bones)
        tfxmesh.write_bones(mesh.joint_names, joints, weights, temporary)
        os.replace(temporary, options.bones)
    if groom.scalp and (groom.scalp.density is not None or groom.scalp.maps):
        report.lose("the density and the maps of the scalp", "--scalp replaces the scalp")
    groom.scalp = mesh
    return groom


def _convert_motion(options, temporary, report):
    if not find_format(options.output, to_write=True).keeps_motion:
        raise UsageError(f"the format of {options.output} holds no motion, but USD and Alembic do")
    if find_format(options.input).name != "dump":
        raise UsageError(f"the name {options.input} does not end in .dump")
    groom = read_groom(options.input, options, report)
    if options.groom:
        try:
            rest = read_groom(options.groom, options, report)
        except InputError as error:
            raise InputError(f"the haircut {options.groom}: {error}") from None
        add_attributes(groom, rest, report)
    write_groom(groom, temporary, options.output, options, report)


def _convert_mesh(options, temporary, report):
    check_mesh_output(options.output)
    mesh = read_mesh(options.input, options, report)
    write_mesh(mesh, temporary, options.output, options, report)


def main(arguments=None):
    """Parse the command line, run it in a process of its own, and return the exit status."""
    options = make_parser().parse_args(arguments)
    temporary = temporary_name(options.output) if options.command != "info" else None
    size = os.path.getsize(options.input) if os.path.isfile(options.input) else 0
    return run_guarded(lambda: run(options, temporary), temporary, size)
