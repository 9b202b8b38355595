"""Materials that show right away what was made: volumes by their grids, meshes by their attribute."""

import bpy

from .errors import Refused


def _new(name: str):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    return material, material.node_tree.nodes, material.node_tree.links


def _place(node, column: int, row: int = 0):
    node.location = (column * 300 - 900, 300 - row * 300)
    return node


def _attribute(nodes, name: str, row: int):
    node = _place(nodes.new("ShaderNodeAttribute"), 0, row)
    node.attribute_name = name
    return node


def _ramp(nodes, stops: list, row: int):
    node = _place(nodes.new("ShaderNodeValToRGB"), 1, row)
    while len(node.color_ramp.elements) < len(stops):
        node.color_ramp.elements.new(0.5)
    for element, (position, color) in zip(node.color_ramp.elements, stops):
        element.position, element.color = position, (*color, 1)
    return node


def _scaled(nodes, links, socket, factor: float, row: int, bias: float = 0.0):
    node = _place(nodes.new("ShaderNodeMath"), 1, row)
    node.operation = "MULTIPLY_ADD"
    node.inputs[1].default_value, node.inputs[2].default_value = factor, bias
    links.new(socket, node.inputs[0])
    return node.outputs[0]


def of_volume(name: str, recipe: dict, scale: float):
    """A Principled Volume. What has temperatures glows as a black body; a nebula glows in its own colours; marble has the colours of its
    veins, and raw noise and velocities those of their values. An object scaled up is thinner, so that it looks the same."""
    grids = [grid.get("name") or ("vel" if grid.get("output") == "curl" else "density") for grid in recipe["grids"]]
    material, nodes, links = _new(name)
    shader = _place(nodes.new("ShaderNodeVolumePrincipled"), 2)
    links.new(shader.outputs["Volume"], _place(nodes.new("ShaderNodeOutputMaterial"), 3).inputs["Volume"])
    inputs = shader.inputs
    inputs["Density"].default_value = 1 / scale
    inputs["Anisotropy"].default_value = 0.3
    inputs["Color"].default_value = (0.95, 0.95, 0.95, 1)
    is_raw = recipe["grids"][0].get("shaping", {}).get("type") == "raw" and recipe["grids"][0].get("output", "value") == "value"
    if "temperature" in grids:
        inputs["Color"].default_value = (0.25, 0.24, 0.23, 1)
        inputs["Temperature Attribute"].default_value = "temperature"
        inputs["Temperature"].default_value = 1.0
        inputs["Blackbody Intensity"].default_value = 5.0
    elif recipe.get("look") == "nebula":
        density = _attribute(nodes, "density", 0)
        glow = _ramp(nodes, [(0.0, (0.1, 0.2, 0.9)), (0.35, (0.9, 0.15, 0.3)), (1.0, (1.0, 0.75, 0.3))], 0)
        peak = recipe["grids"][0].get("scale", {}).get("optical_depth", 1.0)
        links.new(_scaled(nodes, links, density.outputs["Fac"], 0.5 / peak, 1), glow.inputs["Fac"])
        links.new(glow.outputs["Color"], inputs["Emission Color"])
        links.new(_scaled(nodes, links, density.outputs["Fac"], 0.2 / scale, 2), inputs["Emission Strength"])
        inputs["Density"].default_value = 0.3 / scale
    elif len(grids) > 1:
        veins = _ramp(nodes, [(0.0, (0.9, 0.88, 0.85)), (1.0, (0.05, 0.06, 0.08))], 0)
        links.new(_attribute(nodes, grids[1], 0).outputs["Fac"], veins.inputs["Fac"])
        links.new(veins.outputs["Color"], inputs["Color"])
    elif "vel" in grids:
        velocity = _attribute(nodes, "vel", 0)
        links.new(velocity.outputs["Color"], inputs["Emission Color"])
        inputs["Emission Strength"].default_value = 1 / scale
        inputs["Density Attribute"].default_value = ""
        inputs["Density"].default_value = 0.0
    elif is_raw:
        values = _attribute(nodes, grids[0], 0)
        colors = _ramp(nodes, [(0.0, (0.02, 0.1, 0.8)), (0.5, (0.9, 0.9, 0.9)), (1.0, (0.8, 0.05, 0.02))], 0)
        links.new(_scaled(nodes, links, values.outputs["Fac"], 1 / 6, 1, 0.5), colors.inputs["Fac"])
        links.new(colors.outputs["Color"], inputs["Color"])
        links.new(_scaled(nodes, links, values.outputs["Fac"], 8 / scale, 2), inputs["Density"])
        inputs["Density Attribute"].default_value = ""
    return material


def of_mesh(name: str, colors: str, noise: str, roughness: str | None):
    """A Principled BSDF whose colour is a colour attribute, and whose roughness is an attribute, or goes a little with the noise."""
    material, nodes, links = _new(name)
    shader = _place(nodes.new("ShaderNodeBsdfPrincipled"), 2)
    links.new(shader.outputs["BSDF"], _place(nodes.new("ShaderNodeOutputMaterial"), 3).inputs["Surface"])
    links.new(_attribute(nodes, colors, 0).outputs["Color"], shader.inputs["Base Color"])
    if roughness:
        rough = _attribute(nodes, roughness, 1).outputs["Fac"]
    else:
        rough = _scaled(nodes, links, _attribute(nodes, noise, 1).outputs["Fac"], 0.1, 1, 0.6)
        rough.node.use_clamp = True
    links.new(rough, shader.inputs["Roughness"])
    return material


_GREY = "Solidnoise grey"


def _base_color(material):
    shader = next((node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    if shader is None:
        raise Refused(f"{material.name} has no Principled BSDF any more, whose colour could be shown")
    return shader.inputs["Base Color"]


def show_colors(material, colors: str) -> None:
    """Has the base colour be a colour attribute."""
    base, nodes = _base_color(material), material.node_tree.nodes
    known = (node for node in nodes if node.type == "ATTRIBUTE" and node.attribute_name == colors)
    material.node_tree.links.new((next(known, None) or _attribute(nodes, colors, 0)).outputs["Color"], base)


def show_number(material, number: str, low: float, high: float) -> None:
    """Has the base colour be a float attribute: black at its least value, white at its greatest."""
    base, nodes, links = _base_color(material), material.node_tree.nodes, material.node_tree.links
    if _GREY not in nodes:
        grey = _place(nodes.new("ShaderNodeMapRange"), 1, -1)
        grey.name = grey.label = _GREY
        links.new(_attribute(nodes, number, -1).outputs["Fac"], grey.inputs["Value"])
    links.new(nodes[_GREY].outputs["Result"], base)
    set_range(material, low, high)


def set_range(material, low: float, high: float) -> None:
    """Of the number that a material shows, or could."""
    if _GREY in material.node_tree.nodes:
        inputs = material.node_tree.nodes[_GREY].inputs
        inputs["From Min"].default_value, inputs["From Max"].default_value = low, max(high, low + 1e-6)
