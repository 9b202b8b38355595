"""Menus, and the side panel (N) of what was made."""

import textwrap

import bpy

from . import files, pictures, recipes, volumes, worker
from .errors import Refused


class VIEW3D_MT_solidnoise_volume_add(bpy.types.Menu):
    bl_idname = "VIEW3D_MT_solidnoise_volume_add"
    bl_label = "Solidnoise"

    def draw(self, context):
        for name, _ in recipes.presets(recipes.VOLUME):
            self.layout.operator("object.solidnoise_volume_add", text=name.capitalize(), icon_value=pictures.icon(name, recipes.VOLUME)).preset = name


class VIEW3D_MT_solidnoise_object(bpy.types.Menu):
    bl_idname = "VIEW3D_MT_solidnoise_object"
    bl_label = "Solidnoise"

    def draw(self, context):
        if context.object and context.object.type == "MESH":
            self.layout.operator_menu_enum("object.solidnoise_bake", "preset", text="Bake Noise")
            self.layout.operator("object.solidnoise_displace")
            self.layout.operator("object.solidnoise_example")
            self.layout.operator_menu_enum("object.solidnoise_show", "what")
        elif context.object and context.object.type == "VOLUME":
            self.layout.operator_menu_enum("object.solidnoise_volume_modify", "preset", text="Modify")
            self.layout.operator("object.solidnoise_sequence")
        else:
            self.layout.label(text="Select a mesh or a volume")


class VIEW3D_PT_solidnoise(bpy.types.Panel):
    bl_idname = "VIEW3D_PT_solidnoise"
    bl_label = "Solidnoise"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Solidnoise"

    def draw(self, context):
        layout, obj = self.layout, context.object
        for job in worker.jobs:
            row = layout.row()
            row.label(text=f"{job.fraction:.0%}", icon="TIME")
            row.operator("wm.solidnoise_stop", text="", icon="X").subject = job.subject
        if obj is None or volumes.RECIPE not in obj:
            layout.label(text="Nothing of Solidnoise is selected")
            return
        box = layout.box().column(align=True)
        box.scale_y = 0.75
        try:
            lines = recipes.words(recipes.of_object(obj))
        except Refused as error:
            lines = textwrap.wrap(str(error), recipes.WIDTH)
        for line in lines:
            box.label(text=line)
        if obj.type == "VOLUME" and obj.data.get(files.SOURCES):
            obj.solidnoise_modify.draw_settings(layout)
            layout.operator("object.solidnoise_volume_modify_again", icon="FILE_REFRESH")
        elif obj.type == "VOLUME":
            obj.solidnoise_volume.draw_settings(layout)
            layout.operator("object.solidnoise_volume_remake", icon="FILE_REFRESH")
        else:
            row = layout.row(align=True)
            row.operator_enum("object.solidnoise_show", "what")
            obj.solidnoise_mesh.draw_task(layout)
            layout.operator("object.solidnoise_mesh_remake", icon="FILE_REFRESH")


class WM_OT_solidnoise_stop(bpy.types.Operator):
    """Stop this, and leave nothing of it"""

    bl_idname = "wm.solidnoise_stop"
    bl_label = "Stop"
    bl_options = {"INTERNAL"}

    subject: bpy.props.StringProperty()

    def execute(self, context):
        job = worker.at_work(self.subject)
        if job:
            job.stops = True
        return {"FINISHED"}


def _in_add_menu(self, context) -> None:
    self.layout.menu(VIEW3D_MT_solidnoise_volume_add.bl_idname, icon="OUTLINER_OB_VOLUME")


def _in_object_menu(self, context) -> None:
    self.layout.separator()
    self.layout.menu(VIEW3D_MT_solidnoise_object.bl_idname)


CLASSES = (VIEW3D_MT_solidnoise_volume_add, VIEW3D_MT_solidnoise_object, VIEW3D_PT_solidnoise, WM_OT_solidnoise_stop)


def register() -> None:
    bpy.types.VIEW3D_MT_volume_add.append(_in_add_menu)
    bpy.types.VIEW3D_MT_object.append(_in_object_menu)


def unregister() -> None:
    bpy.types.VIEW3D_MT_volume_add.remove(_in_add_menu)
    bpy.types.VIEW3D_MT_object.remove(_in_object_menu)
