"""blender_gallery.py SCENE OUT.png [SIZE]: what the add-on makes, as Cycles shows it with the materials that it gives: of cumulus, smoke, nebula, fire,
explosion, marble, raw and velocity the volume, and the scenes below. Run by blender -b --factory-startup --python-exit-code 3 -P blender_gallery.py -- ..."""

import math
import os
import sys

import addon_utils
import bpy

PROJECT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
sys.path[:0] = [os.path.join(PROJECT, "integrations/blender"), os.path.join(PROJECT, "scripts")]

import blender as look  # noqa: E402


def volume(name, dim=192):
    bpy.ops.object.solidnoise_volume_add(preset=name, domain_dim=dim)
    return bpy.context.object


def eroded():
    smoke = volume("smoke")
    bpy.ops.object.solidnoise_volume_modify(preset="erode")
    return smoke


def cut():
    smoke = volume("smoke")
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.75, location=(0, 0, 0.9))
    ball = bpy.context.object
    bpy.context.view_layer.objects.active = smoke
    bpy.ops.object.solidnoise_volume_modify(preset="mask", mask=ball.name)
    bpy.data.objects.remove(ball)
    return smoke


def wyrm():
    bpy.ops.import_mesh.ply(filepath=os.path.join(PROJECT, "meshes/wyrm.ply"))
    mesh = bpy.context.object
    mesh.rotation_euler = (math.pi / 2, 0, 0)
    bpy.ops.object.shade_smooth()
    bpy.context.view_layer.update()
    return mesh


def rust():
    mesh = wyrm()
    bpy.ops.object.solidnoise_bake(preset="rust")
    return mesh


def moss():
    mesh = wyrm()
    bpy.ops.object.solidnoise_example(file=os.path.join(PROJECT, "examples/exemplars/moss.jpg"))
    return mesh


def displaced():
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=7)
    mesh = bpy.context.object
    bpy.ops.object.solidnoise_displace(preset="stone", height=0.175, surface_gain=0.45, bake_feature_size=1)
    bpy.ops.object.solidnoise_bake(preset="stone", surface_gain=0.45, bake_feature_size=1)
    bpy.ops.object.shade_smooth()
    return mesh


def main():
    name, out, *size = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("solidnoise_blender", default_set=True)
    scene = bpy.context.scene
    makers = {maker.__name__: maker for maker in (eroded, cut, rust, moss, displaced)}
    obj = makers[name]() if name in makers else volume(name)
    glows = name in ("fire", "explosion", "nebula", "velocity")
    bpy.context.view_layer.update()
    if obj.type == "VOLUME":
        obj.data.grids.load()
    look.light(scene, glows)
    if obj.type == "MESH":
        bpy.data.lights["sun"].energy = 2.5
        scene.view_settings.view_transform = "Standard"
    look.look_at(scene, obj)
    scene.camera.data.lens = 36 if name == "marble" else 50  # a whole box is wider than what is in one
    look.render(scene, out, int(size[0]) if size else 320)


main()
