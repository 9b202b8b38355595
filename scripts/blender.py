"""blender.py IN.vdb OUT.png [SIZE]: a volume as a user of Blender sees it, in Cycles with a Principled Volume. What has a grid `temperature` glows
before black, its Blackbody Intensity 5; all else is lit by a sun and a sky. Run by blender -b --factory-startup --python-exit-code 3 -P blender.py -- ..."""

import os
import sys

import bpy
from mathutils import Vector


def principled_volume(glows):
    material = bpy.data.materials.new("volume")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader = tree.nodes.new("ShaderNodeVolumePrincipled")
    shader.inputs["Anisotropy"].default_value = 0.3
    shader.inputs["Color"].default_value = (0.25, 0.24, 0.23, 1) if glows else (0.95, 0.95, 0.95, 1)
    if glows:
        shader.inputs["Temperature Attribute"].default_value = "temperature"
        shader.inputs["Temperature"].default_value = 1.0
        shader.inputs["Blackbody Intensity"].default_value = 5
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs["Volume"], output.inputs["Volume"])
    return material


def light(scene, glows):
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy = 3 if glows else 8
    lamp = bpy.data.objects.new("sun", sun)
    lamp.rotation_euler = (0.8, 0.3, 0.6)
    scene.collection.objects.link(lamp)
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0, 0, 0, 1) if glows else (0.12, 0.25, 0.5, 1)


def look_at(scene, volume):
    corners = [volume.matrix_world @ Vector(corner) for corner in volume.bound_box]
    low, high = (Vector(choose(corner[axis] for corner in corners) for axis in range(3)) for choose in (min, max))
    centre, size = (low + high) / 2, (high - low).length
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.clip_end = 20 * size
    camera.location = centre + Vector((1, -1.3, 0.5)).normalized() * size * 1.15
    camera.rotation_euler = (centre - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera


def render(scene, out, size):
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 48
    scene.cycles.use_denoising = False
    scene.cycles.volume_bounces = 4
    scene.cycles.volume_step_rate = 1.5
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.render.filepath = os.path.abspath(out)
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    bpy.ops.render.render(write_still=True)


def main():
    vdb, out, *size = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.object.volume_import(filepath=os.path.abspath(vdb), files=[])
    volume = bpy.context.object
    volume.rotation_euler = (1.5707963, 0, 0)  # Y is up in the file
    bpy.context.view_layer.update()
    volume.data.grids.load()
    glows = "temperature" in [grid.name for grid in volume.data.grids]
    volume.data.materials.append(principled_volume(glows))
    light(scene, glows)
    look_at(scene, volume)
    render(scene, out, int(size[0]) if size else 480)


if __name__ == "__main__":
    main()
