"""blender_textures.py MESH.obj COLOR.<UDIM>.png NORMAL.<UDIM>.png OUT.png [SIZE]: a mesh in textures of several tiles as a user of Blender sees it,
in Cycles, from above and from below. Run by blender -b --factory-startup --python-exit-code 3 -P blender_textures.py -- ..."""

import math
import os
import sys

import bpy
from mathutils import Vector


def tiled_image(path, color_space):
    image = bpy.data.images.load(os.path.abspath(path.replace("<UDIM>", "1001")))
    image.source = "TILED"
    image.filepath = os.path.abspath(path)
    image.tiles.new(1002)
    image.colorspace_settings.name = color_space
    return image


def textured_material(color, normal):
    material = bpy.data.materials.new("baked")
    material.use_nodes = True
    tree = material.node_tree
    shader = tree.nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = 0.6
    colors = tree.nodes.new("ShaderNodeTexImage")
    colors.image = tiled_image(color, "sRGB")
    tree.links.new(colors.outputs["Color"], shader.inputs["Base Color"])
    normals = tree.nodes.new("ShaderNodeTexImage")
    normals.image = tiled_image(normal, "Non-Color")
    bump = tree.nodes.new("ShaderNodeNormalMap")
    tree.links.new(normals.outputs["Color"], bump.inputs["Color"])
    tree.links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    return material


def place(scene, bowl, location, turn):
    copy = bpy.data.objects.new("bowl", bowl)
    copy.location = location
    copy.rotation_euler = turn
    scene.collection.objects.link(copy)


def light(scene):
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy = 3.5
    sun.angle = 0.05
    lamp = bpy.data.objects.new("sun", sun)
    lamp.rotation_euler = (0.75, 0.2, -0.5)
    scene.collection.objects.link(lamp)
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.35, 0.4, 0.45, 1)


def look(scene):
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = Vector((0, -5.3, 3.5))
    camera.rotation_euler = (Vector((0, 0, 0.3)) - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera


def main():
    words = sys.argv[sys.argv.index("--") + 1 :]
    mesh, color, normal, out = words[:4]
    size = int(words[4]) if len(words) > 4 else 420
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.wm.obj_import(filepath=os.path.abspath(mesh), forward_axis="NEGATIVE_Z", up_axis="Y")
    imported = bpy.context.selected_objects[0]
    bowl = imported.data
    bowl.transform(imported.matrix_world)
    bpy.data.objects.remove(imported)
    for polygon in bowl.polygons:
        polygon.use_smooth = True
    bowl.materials.clear()
    bowl.materials.append(textured_material(color, normal))
    place(scene, bowl, (-1.0, 0, 0), (0, 0, 0.6))
    place(scene, bowl, (1.0, 0, 0.65), (math.pi - 0.15, 0, 0.3))
    light(scene)
    look(scene)
    scene.view_settings.view_transform = "Standard"
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 24
    scene.cycles.use_denoising = False
    scene.render.resolution_x = 2 * size
    scene.render.resolution_y = size
    scene.render.filepath = os.path.abspath(out)
    scene.render.image_settings.file_format = "PNG"
    bpy.ops.render.render(write_still=True)


main()
