"""blender_sky.py POINTS.csv OUT.png [--size W H] [--samples N] [--camera X Y Z] [--look PITCH YAW] [--blend FILE]: a sky of `vdbnoise sky --up z
--write-points POINTS.csv` as a landscape, in Cycles. Each .vdb is one volume, which the objects at its points share. Metres, z up. --blend keeps the
scene. Run by blender -b --factory-startup --python-exit-code 3 -P blender_sky.py -- ..."""

import argparse
import csv
import math
import os
import sys

import bpy


HAZE = (0.56, 0.66, 0.78)  # at the horizon
HAZY = 30000.0  # metres, at which two thirds of what is seen is haze
GROUND = 1  # its index in the pictures
BOUNCES = 3  # of the sun's light in clouds
DENSITY = 0.5  # which lets as much light through as clouds that scatter forward
BASE, TOPS = 950.0, 1900.0  # metres; between them the light of the sky in clouds becomes what it is outside


class Nodes:
    """Nodes of a tree, with numbers or sockets for their inputs."""

    def __init__(self, tree):
        self.tree = tree

    def add(self, kind, inputs, **properties):
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in properties.items():
            setattr(node, name, value)
        for name, value in inputs.items():
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[name])
            else:
                node.inputs[name].default_value = value
        return node

    def math(self, operation, *values):
        return self.add("Math", dict(enumerate(values)), operation=operation).outputs[0]

    def ramp(self, factor, *stops):
        node = self.add("ValToRGB", {"Fac": factor})
        elements = node.color_ramp.elements
        for i, (position, color) in enumerate(stops):
            element = elements[i] if i < 2 else elements.new(position)
            element.position, element.color = position, (*color, 1)
        return node.outputs["Color"]

    def haze(self, camera):
        """The share of haze in what is seen from the camera at the place that is shaded."""
        place = self.add("NewGeometry", {}).outputs["Position"]
        far = self.add("VectorMath", {0: place, 1: camera}, operation="DISTANCE").outputs["Value"]
        return place, self.math("SUBTRACT", 1.0, self.math("POWER", math.exp(-1.0 / HAZY), far))


def new_material(name):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    return material, Nodes(material.node_tree)


def cloud_material(camera):
    """Scatters the sun's light. What the sky and later bounces add is an emission, which makes little noise: darker toward the base, and haze far
    away."""
    material, nodes = new_material("cloud")
    place, haze = nodes.haze(camera)
    density = nodes.add("VolumeInfo", {}).outputs["Density"]
    height = nodes.add("MapRange", {"Value": nodes.add("SeparateXYZ", {"Vector": place}).outputs["Z"], "From Min": BASE, "From Max": TOPS})
    sky = nodes.ramp(height.outputs["Result"], (0, (0.07, 0.09, 0.125)), (1, (0.2, 0.235, 0.29)), (0.25, (0.12, 0.15, 0.195)))
    glow = nodes.add("MixRGB", {"Fac": haze, "Color1": sky, "Color2": (*HAZE, 1)}).outputs["Color"]
    white = nodes.ramp(haze, (0, (0.99, 0.99, 0.99)), (1, (0, 0, 0)))
    thick = nodes.math("MULTIPLY", density, DENSITY)
    scatter = nodes.add("VolumeScatter", {"Color": white, "Density": thick, "Anisotropy": 0.2})
    absorb = nodes.add("VolumeAbsorption", {"Color": white, "Density": thick})
    shine = nodes.add("Emission", {"Color": glow, "Strength": thick})
    both = nodes.add("AddShader", {0: scatter.outputs["Volume"], 1: absorb.outputs["Volume"]})
    shader = nodes.add("AddShader", {0: both.outputs[0], 1: shine.outputs["Emission"]})
    nodes.add("OutputMaterial", {"Volume": shader.outputs[0]})
    return material


def place_clouds(scene, points, camera):
    material, volumes = cloud_material(camera), {}
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


def ground(scene, camera):
    """Fields, woods between them, and haze far away."""
    bpy.ops.mesh.primitive_plane_add(size=400000)
    material, nodes = new_material("ground")
    place, haze = nodes.haze(camera)
    field = nodes.add("TexVoronoi", {"Vector": place, "Scale": 1 / 450.0}, distance="CHEBYCHEV").outputs["Color"]
    crop = nodes.ramp(nodes.add("SeparateXYZ", {"Vector": field}).outputs["X"], (0, (0.035, 0.06, 0.02)), (1, (0.19, 0.16, 0.08)), (0.45, (0.07, 0.1, 0.03)),
                      (0.75, (0.12, 0.13, 0.05)))
    woods = nodes.add("TexNoise", {"Vector": place, "Scale": 1 / 1500.0, "Detail": 8.0}).outputs["Fac"]
    wooded = nodes.ramp(woods, (0.53, (0, 0, 0)), (0.57, (1, 1, 1)))
    color = nodes.add("MixRGB", {"Fac": wooded, "Color1": crop, "Color2": (0.018, 0.032, 0.014, 1)}).outputs["Color"]
    earth = nodes.add("BsdfDiffuse", {"Color": color})
    air = nodes.add("Emission", {"Color": (*HAZE, 1)})
    shader = nodes.add("MixShader", {0: haze, 1: earth.outputs["BSDF"], 2: air.outputs["Emission"]})
    nodes.add("OutputMaterial", {"Surface": shader.outputs[0]})
    bpy.context.object.data.materials.append(material)
    bpy.context.object.pass_index = GROUND


def light(scene):
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy = 10
    sun.color = (1, 0.94, 0.85)
    lamp = bpy.data.objects.new("sun", sun)
    lamp.rotation_euler = (math.radians(52), 0, math.radians(-62))
    scene.collection.objects.link(lamp)
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    nodes = Nodes(scene.world.node_tree)
    up = nodes.add("SeparateXYZ", {"Vector": nodes.add("TexCoord", {}).outputs["Generated"]}).outputs["Z"]
    sky = nodes.ramp(up, (0, HAZE), (0.6, (0.045, 0.12, 0.36)), (0.1, (0.36, 0.5, 0.72)), (0.25, (0.15, 0.29, 0.58)))
    nodes.tree.links.new(sky, nodes.tree.nodes["Background"].inputs["Color"])
    # Of all lights only the sun is sampled, and the sky's is in what clouds emit.
    scene.world.cycles.sampling_method = "NONE"
    scene.world.cycles_visibility.scatter = False


def camera(scene, place, look):
    pitch, yaw = (math.radians(angle) for angle in look)
    eye = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    eye.data.lens = 26
    eye.data.clip_start, eye.data.clip_end = 1, 400000
    eye.location = place
    eye.rotation_euler = (math.pi / 2 + pitch, 0, yaw)
    scene.collection.objects.link(eye)
    scene.camera = eye


def smooth_noise(scene):
    """Blurs clouds where they are alike, as their emission says, which has their outlines and little noise; of the ground only takes
    bright dots. The blur darkens the outermost 5 pixels."""
    layer = scene.view_layers[0]
    layer.use_pass_emit = layer.use_pass_object_index = True
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()

    def add(kind, inputs, **properties):
        node = tree.nodes.new("CompositorNode" + kind)
        for name, value in properties.items():
            setattr(node, name, value)
        for name, value in inputs.items():
            tree.links.new(value, node.inputs[name])
        return node.outputs[0] if node.outputs else None

    passes = tree.nodes.new("CompositorNodeRLayers").outputs
    alike = add("Bilateralblur", {"Image": passes["Emit"], "Determinator": passes["Emit"]}, iterations=2, sigma_space=3, sigma_color=0.3)
    sky = add("Bilateralblur", {"Image": passes["Image"], "Determinator": alike}, iterations=2, sigma_space=2, sigma_color=0.1)
    earth = add("Despeckle", {"Image": passes["Image"]}, threshold=0.1, threshold_neighbor=0.5)
    on_earth = add("IDMask", {"ID value": passes["IndexOB"]}, index=GROUND)
    add("Composite", {"Image": add("MixRGB", {0: on_earth, 1: sky, 2: earth})})


def render(scene, out, size, samples):
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 6
    scene.cycles.volume_bounces = BOUNCES
    scene.cycles.sample_clamp_indirect = 6
    scene.cycles.volume_step_rate = 3
    scene.cycles.volume_max_steps = 256
    smooth_noise(scene)
    scene.view_settings.view_transform = "Filmic"
    scene.view_settings.look = "Medium High Contrast"
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
    place_clouds(scene, options.points, options.camera)
    ground(scene, options.camera)
    light(scene)
    camera(scene, options.camera, options.look)
    if options.blend:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(options.blend))
    render(scene, options.out, options.size, options.samples)


main()
