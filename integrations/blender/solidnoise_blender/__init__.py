"""Procedural solid noise in Blender: volumes, and noise on meshes, by the Python module solidnoise."""

import bpy

bl_info = {
    "name": "Solidnoise",
    "author": "Solidnoise",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Add > Volume > Solidnoise; Object > Solidnoise; 3D View > Sidebar > Solidnoise",
    "description": "Clouds, smoke, fire and other solid noise as volumes; rust, bark and photographs' noises on meshes",
    "category": "Add Mesh",
}

try:
    import solidnoise
    missing = "" if hasattr(solidnoise, "schema") else f"{solidnoise.__file__} is of an earlier version"
except ImportError as error:
    missing = str(error)

if not missing:
    from . import add_volume, bake_mesh, files, modify_volume, panel, pictures, sequence, volumes, worker

    _PARTS = (pictures, add_volume, modify_volume, sequence, bake_mesh, panel, files)
    files.restore = volumes.restore


class SolidnoisePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    def draw(self, context):
        told = f"The Python module solidnoise is missing: {missing}" if missing else f"Solidnoise, from {solidnoise.__file__}"
        self.layout.label(text=told, icon="ERROR" if missing else "INFO")


def register() -> None:
    bpy.utils.register_class(SolidnoisePreferences)
    for part in () if missing else _PARTS:
        for kind in getattr(part, "CLASSES", ()):
            bpy.utils.register_class(kind)
        part.register()


def unregister() -> None:
    for part in () if missing else reversed(_PARTS):
        part.unregister()
        for kind in reversed(getattr(part, "CLASSES", ())):
            bpy.utils.unregister_class(kind)
    if not missing:
        worker.stop_all()
    bpy.utils.unregister_class(SolidnoisePreferences)
