"""Blender add-on: exports hair curves with all attributes and their scalp, imports simulated hair.

Install this folder as an add-on, and set the path of hair-convert in its preferences. USD files
need no hair-convert.
"""

import os
import shutil
import subprocess
import tempfile

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

bl_info = {
    "name": "Hair grooms",
    "description": "Export hair curves with attributes and scalp, import simulated hair",
    "version": (1, 0, 0),
    "blender": (4, 5, 0),
    "location": "File > Export, File > Import",
    "category": "Import-Export",
}

USD = (".usd", ".usda", ".usdc")


class HairPreferences(bpy.types.AddonPreferences):
    """Preferences of the add-on."""

    bl_idname = __name__

    program: StringProperty(name="hair-convert", subtype="FILE_PATH",
                            description="The program hair-convert. Empty looks for the program in "
                            "the path of commands")

    def draw(self, _context):
        self.layout.prop(self, "program")


def find_program(context, given=""):
    """Return the path of hair-convert, or an empty string."""
    addon = context.preferences.addons.get(__name__)
    return given or (addon and addon.preferences.program) or shutil.which("hair-convert") or ""


def run_convert(operator, context, *arguments):
    """Run hair-convert. Its sentences become reports of the operator. Return whether it worked."""
    program = find_program(context, operator.program)
    if not program:
        operator.report({"ERROR"}, "hair-convert is not found: set its path in the preferences of "
                        "the add-on")
        return False
    done = subprocess.run([bpy.path.abspath(program), *arguments], capture_output=True, text=True,
                          check=False)
    for line in done.stderr.splitlines():
        operator.report({"WARNING"} if done.returncode == 0 else {"ERROR"}, line)
    return done.returncode == 0


def find_hair(context):
    """Return the selected hair objects, or all of the scene if none is selected."""
    hair = [o for o in context.selected_objects if o.type == "CURVES"]
    return hair or [o for o in context.scene.objects if o.type == "CURVES"]


class HairExport(bpy.types.Operator, ExportHelper):
    """Export hair curves with all attributes, and the meshes that they grow on"""

    bl_idname = "hair.export_groom"
    bl_label = "Export Hair Groom"
    filename_ext = ".usdc"
    check_extension = False
    filter_glob: StringProperty(default="*.usd;*.usda;*.usdc;*.abc;*.groom;*.hair;*.tfx",
                                options={"HIDDEN"})
    program: StringProperty(options={"HIDDEN"})

    def execute(self, context):
        hair = find_hair(context)
        if not hair:
            self.report({"ERROR"}, "The scene has no hair curves")
            return {"CANCELLED"}
        scalps = {o.data.surface for o in hair if o.data.surface}
        if self.filepath.lower().endswith(USD):
            export_usd(context, [*hair, *scalps], self.filepath)
            return {"FINISHED"}
        with tempfile.TemporaryDirectory() as folder:
            source = os.path.join(folder, "hair.usdc")
            export_usd(context, [*hair, *scalps], source)
            fit = ["--scalp", source] if scalps else []
            worked = run_convert(self, context, "convert", source, self.filepath, *fit)
        return {"FINISHED"} if worked else {"CANCELLED"}


def export_usd(context, objects, path):
    """Write objects to a USD file, and leave the selection as it was."""
    selected, active = context.selected_objects, context.view_layer.objects.active
    for o in selected:
        o.select_set(False)
    for o in objects:
        o.select_set(True)
    bpy.ops.wm.usd_export(filepath=path, selected_objects_only=True, export_materials=False)
    for o in objects:
        o.select_set(False)
    for o in selected:
        o.select_set(True)
    context.view_layer.objects.active = active


class HairImport(bpy.types.Operator, ImportHelper):
    """Import hair curves with their motion, also a dump of hair-capture"""

    bl_idname = "hair.import_cache"
    bl_label = "Import Hair Cache"
    filename_ext = ".usdc"
    filter_glob: StringProperty(default="*.usd;*.usda;*.usdc;*.abc;*.groom;*.hair;*.tfx;*.dump",
                                options={"HIDDEN"})
    program: StringProperty(options={"HIDDEN"})

    def execute(self, context):
        path = self.filepath
        if not path.lower().endswith(USD):
            # Blender reads frames from the file as long as the scene lives, so the file stays.
            path = os.path.splitext(path)[0] + ".usdc"
            command = "motion" if self.filepath.lower().endswith(".dump") else "convert"
            if not run_convert(self, context, command, self.filepath, path):
                return {"CANCELLED"}
        return bpy.ops.wm.usd_import(filepath=path, set_frame_range=True)


def draw_export(self, _context):
    """Draw the entry of the export menu."""
    self.layout.operator(HairExport.bl_idname, text="Hair groom (.usdc, .abc, .groom, .hair, .tfx)")


def draw_import(self, _context):
    """Draw the entry of the import menu."""
    self.layout.operator(HairImport.bl_idname, text="Hair cache (.usdc, .abc, .groom, .hair, .tfx, .dump)")


CLASSES = (HairPreferences, HairExport, HairImport)


def register():
    """Add operators and menu entries."""
    for c in CLASSES:
        bpy.utils.register_class(c)
    bpy.types.TOPBAR_MT_file_export.append(draw_export)
    bpy.types.TOPBAR_MT_file_import.append(draw_import)


def unregister():
    """Remove operators and menu entries."""
    bpy.types.TOPBAR_MT_file_import.remove(draw_import)
    bpy.types.TOPBAR_MT_file_export.remove(draw_export)
    for c in reversed(CLASSES):
        bpy.utils.unregister_class(c)
