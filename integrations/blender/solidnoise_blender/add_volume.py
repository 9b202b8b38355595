"""Add > Volume > Solidnoise: a preset's volume, and the same again with other values."""

import json

import bpy

from . import files, materials, recipes, volumes
from .errors import Refused, reported, require_object
from .settings import VolumeSettings


class SolidnoiseVolumeSettings(VolumeSettings, bpy.types.PropertyGroup):
    """Of an object: what it was made with."""


def copy(settings, to) -> None:
    """The values of an operator, for the object that it made."""
    to.filled = settings.filled
    for name in settings.SHARED:
        setattr(to, name, getattr(settings, name))


class OBJECT_OT_solidnoise_volume_add(VolumeSettings, bpy.types.Operator):
    """Add a volume of procedural noise at the 3D cursor"""

    bl_idname = "object.solidnoise_volume_add"
    bl_label = "Solidnoise Volume"
    bl_options = {"REGISTER", "UNDO"}

    size: bpy.props.FloatProperty(name="Size", description="Length of the longest side; 0: the preset's own", default=0.0, min=0.0,
                                  unit="LENGTH", options={"SKIP_SAVE"})

    @classmethod
    def description(cls, context, properties) -> str:
        return dict(recipes.presets(recipes.VOLUME))[properties.preset]

    @reported
    def execute(self, context):
        if context.mode != "OBJECT":
            raise Refused(f"{context.object.name} is in {context.object.mode.lower()} mode; leave it first")
        volumes.require_collection(context)
        recipe = self.recipe()
        path, job = volumes.request(self.preset, recipe)
        self.size = self.size or volumes.longest_side(recipe)
        obj = volumes.add_object(context, self.preset.capitalize())
        obj.scale = (self.size / volumes.longest_side(recipe),) * 3
        obj[volumes.RECIPE] = json.dumps(recipe)
        copy(self, obj.solidnoise_volume)
        obj.data.materials.append(materials.of_volume(obj.name, self.preset, recipe))
        absolute = files.absolute(path)
        volumes.show(obj.data, path, job, lambda _: [volumes.remove_object(user) for user in volumes.users_of(absolute)])
        files.tidy()
        return {"FINISHED"}

    def draw(self, context):
        self.draw_settings(self.layout, "size")


class OBJECT_OT_solidnoise_volume_remake(bpy.types.Operator):
    """Make the volume again, with the values of the side panel"""

    bl_idname = "object.solidnoise_volume_remake"
    bl_label = "Remake"
    bl_options = {"REGISTER", "UNDO"}

    @reported
    def execute(self, context):
        obj = context.object
        require_object(obj, "VOLUME")
        if volumes.RECIPE not in obj:
            raise Refused(f"{obj.name} has no recipe; it was not made here")
        recipe, preset, was_sequence = obj.solidnoise_volume.recipe(), obj.solidnoise_volume.preset, obj.data.is_sequence
        volumes.remake(obj, recipe)
        slots = obj.data.materials
        if slots and materials.is_of_another(slots[0], preset):
            slots[0] = materials.of_volume(obj.name, preset, recipe)
        if was_sequence:
            self.report({"INFO"}, f"{obj.name} is a single volume again; Object > Solidnoise > Sequence makes its frames")
        files.tidy()
        return {"FINISHED"}


CLASSES = (SolidnoiseVolumeSettings, OBJECT_OT_solidnoise_volume_add, OBJECT_OT_solidnoise_volume_remake)


def register() -> None:
    bpy.types.Object.solidnoise_volume = bpy.props.PointerProperty(type=SolidnoiseVolumeSettings)


def unregister() -> None:
    del bpy.types.Object.solidnoise_volume
