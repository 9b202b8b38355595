"""blender_sky.py POINTS.csv OUT.png [--size W H] [--samples N] [--camera X Y Z] [--look PITCH YAW] [--blend FILE]: a sky of `vdbnoise sky --up z
--write-points POINTS.csv` as a landscape, in Cycles. Each .vdb is one volume, which the objects at its points share. Metres, z up. --blend keeps the
scene. Run by blender -b --factory-startup --python-exit-code 3 -P blender_sky.py -- ..."""

import argparse
import csv
import math
import os
import sys

import bpy


def cloud_material():
    material = bpy.data.materials.new("cloud")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader = tree.nodes.new("ShaderNodeVolumePrincipled")
    shader.inputs["Color"].default_value = (0.99, 0.99, 0.99, 1)
    shader.inputs["Anisotropy"].default_value = 0.5
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs["Volume"], output.inputs["Volume"])
    return material


def place_clouds(scene, points):
    material, volumes = cloud_material(), {}
    folder = os.path.dirname(os.path.abspath(points))
    with open(points, newline="") as file:
        for row in csv.DictReader(file):
            name = row["file"]
            if name not in volumes:
                volumes[name] = bpy.data.volumes.new(name)
                volumes[name].filepath = os.path.join(folder, name)
                volumes[name].materials.append(material)
            cloud = bpy.data.objects.new("cloud", volumes[name])
            cloud.location = [float(row[axis]) for axis in "xyz"]
            cloud.rotation_euler = (0, 0, math.radians(float(row["turn"])))
            cloud.scale = [float(row["scale"])] * 3
            scene.collection.objects.link(cloud)


def ground(scene):
    bpy.ops.mesh.primitive_plane_add(size=400000)
    material = bpy.data.materials.new("ground")
    material.use_nodes = True
    tree = material.node_tree
    shader = tree.nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = 1
    shader.inputs["Specular"].default_value = 0
    place = tree.nodes.new("ShaderNodeNewGeometry")
    noise = tree.nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = 4e-4
    noise.inputs["Detail"].default_value = 8
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[0].color = 0.4, (0.05, 0.075, 0.03, 1)
    ramp.color_ramp.elements[1].position, ramp.color_ramp.elements[1].color = 0.62, (0.16, 0.15, 0.08, 1)
    tree.links.new(place.outputs["Position"], noise.inputs["Vector"])
    tree.links.new(noise.outputs["Fac"], ramp.inputs["Fac"])
    tree.links.new(ramp.outputs["Color"], shader.inputs["Base Color"])
    bpy.context.object.data.materials.append(material)


def light(scene):
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy = 5
    sun.color = (1, 0.94, 0.85)
    lamp = bpy.data.objects.new("sun", sun)
    lamp.rotation_euler = (math.radians(52), 0, math.radians(-62))
    scene.collection.objects.link(lamp)
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    # From the horizon's haze to the blue above.
    up = tree.nodes.new("ShaderNodeTexCoord")
    height = tree.nodes.new("ShaderNodeSeparateXYZ")
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[0].color = 0, (0.52, 0.62, 0.72, 1)
    ramp.color_ramp.elements[1].position, ramp.color_ramp.elements[1].color = 0.55, (0.06, 0.15, 0.42, 1)
    ramp.color_ramp.elements.new(0.12).color = (0.26, 0.42, 0.66, 1)
    tree.links.new(up.outputs["Generated"], height.inputs["Vector"])
    tree.links.new(height.outputs["Z"], ramp.inputs["Fac"])
    tree.links.new(ramp.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    tree.nodes["Background"].inputs["Strength"].default_value = 1.5


def camera(scene, place, look):
    pitch, yaw = (math.radians(angle) for angle in look)
    eye = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    eye.data.lens = 26
    eye.data.clip_start, eye.data.clip_end = 1, 400000
    eye.location = place
    eye.rotation_euler = (math.pi / 2 + pitch, 0, yaw)
    scene.collection.objects.link(eye)
    scene.camera = eye


def render(scene, out, size, samples):
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 16
    scene.cycles.volume_bounces = 12
    scene.cycles.volume_step_rate = 2
    scene.cycles.volume_max_steps = 512
    scene.view_settings.view_transform = "Filmic"
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.filepath = os.path.abspath(out)
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    bpy.ops.render.render(write_still=True)


def main():
    parser = argparse.ArgumentParser(prog="blender_sky.py")
    parser.add_argument("points")
    parser.add_argument("out")
    parser.add_argument("--size", nargs=2, type=int, default=(960, 480))
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--camera", nargs=3, type=float, default=(0, -12000, 500))
    parser.add_argument("--look", nargs=2, type=float, default=(9, 0), help="degrees above the horizon, and to the left of north")
    parser.add_argument("--blend")
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    place_clouds(scene, options.points)
    ground(scene)
    light(scene)
    camera(scene, options.camera, options.look)
    if options.blend:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(options.blend))
    render(scene, options.out, options.size, options.samples)


main()
