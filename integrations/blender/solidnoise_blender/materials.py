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


_PRESET = "solidnoise_preset"  # of a volume's material: whose look it is


def is_of_another(material, preset: str) -> bool:
    """Whether it was made here for another preset."""
    return bool(material) and material.get(_PRESET, preset) != preset


def of_volume(name: str, preset: str, recipe: dict):
    """A Principled Volume. What has temperatures glows as a black body; a nebula glows in its own colours; marble has the colours of its
    veins, and raw noise and velocities those of their values. Scaled up it looks the same: the volume's space is the object's, so that
    Blender makes it thinner by as much."""
    grids = [grid.get("name") or ("vel" if grid.get("output") == "curl" else "density") for grid in recipe["grids"]]
    material, nodes, links = _new(name)
    material[_PRESET] = preset
    shader = _place(nodes.new("ShaderNodeVolumePrincipled"), 2)
    links.new(shader.outputs["Volume"], _place(nodes.new("ShaderNodeOutputMaterial"), 3).inputs["Volume"])
    inputs = shader.inputs
    inputs["Density"].default_value = 1.0
    inputs["Anisotropy"].default_value = 0.3
    inputs["Color"].default_value = (0.95, 0.95, 0.95, 1)
    is_raw = recipe["grids"][0].get("shaping", {}).get("type") == "raw" and recipe["grids"][0].get("output", "value") == "value"
    if "temperature" in grids:
        inputs["Color"].default_value = (0.25, 0.24, 0.23, 1)
        inputs["Temperature Attribute"].default_value = "temperature"
        inputs["Temperature"].default_value = 1.0
        inputs["Blackbody Intensity"].default_value = 5.0
    elif recipe.get("look") == "smoke":
        inputs["Color"].default_value = (0.4, 0.39, 0.38, 1)
    elif recipe.get("look") == "nebula":
        density = _attribute(nodes, "density", 0)
        glow = _ramp(nodes, [(0.0, (0.1, 0.2, 0.9)), (0.35, (0.9, 0.15, 0.3)), (1.0, (1.0, 0.75, 0.3))], 0)
        peak = recipe["grids"][0].get("scale", {}).get("optical_depth", 1.0)
        links.new(_scaled(nodes, links, density.outputs["Fac"], 0.5 / peak, 1), glow.inputs["Fac"])
        links.new(glow.outputs["Color"], inputs["Emission Color"])
        links.new(_scaled(nodes, links, density.outputs["Fac"], 0.2, 2), inputs["Emission Strength"])
        inputs["Density"].default_value = 0.3
    elif len(grids) > 1:
        veins = _ramp(nodes, [(0.0, (0.9, 0.88, 0.85)), (1.0, (0.05, 0.06, 0.08))], 0)
        links.new(_attribute(nodes, grids[1], 0).outputs["Fac"], veins.inputs["Fac"])
        links.new(veins.outputs["Color"], inputs["Color"])
    elif "vel" in grids:
        velocity = _attribute(nodes, "velocity", 0)  # as Cycles has the grid that Blender takes for the volume's velocities: vel
        sizes = _place(nodes.new("ShaderNodeVectorMath"), 1)
        sizes.operation = "ABSOLUTE"  # there is no light of less than nothing
        links.new(velocity.outputs["Color"], sizes.inputs[0])
        links.new(sizes.outputs["Vector"], inputs["Emission Color"])
        inputs["Emission Strength"].default_value = 1.0
        inputs["Density Attribute"].default_value = ""
        inputs["Density"].default_value = 0.0
    elif is_raw:
        values = _attribute(nodes, grids[0], 0)
        colors = _ramp(nodes, [(0.0, (0.02, 0.1, 0.8)), (0.5, (0.9, 0.9, 0.9)), (1.0, (0.8, 0.05, 0.02))], 0)
        links.new(_scaled(nodes, links, values.outputs["Fac"], 1 / 6, 1, 0.5), colors.inputs["Fac"])
        links.new(colors.outputs["Color"], inputs["Color"])
        links.new(_scaled(nodes, links, values.outputs["Fac"], 8, 2), inputs["Density"])
        inputs["Density Attribute"].default_value = ""
    return material


def of_mesh(name: str, colors: str):
    """A Principled BSDF whose colour is a colour attribute."""
    material, nodes, links = _new(name)
    shader = _place(nodes.new("ShaderNodeBsdfPrincipled"), 2)
    links.new(shader.outputs["BSDF"], _place(nodes.new("ShaderNodeOutputMaterial"), 3).inputs["Surface"])
    links.new(_attribute(nodes, colors, 0).outputs["Color"], shader.inputs["Base Color"])
    return material


_GREY, _ROUGH = "Solidnoise grey", "Solidnoise roughness"


def _principled(material):
    return next((node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"), None)


def set_roughness(material, noise: str, roughness: str) -> None:
    """Has the roughness be an attribute, or go a little with the noise where there is none, unless it was changed by hand."""
    shader, nodes, links = _principled(material), material.node_tree.nodes, material.node_tree.links
    ours = [node for node in nodes if node.name.startswith(_ROUGH)]
    made = [link.from_node for link in shader.inputs["Roughness"].links] if shader else []
    if shader is None or (made or ours) and not set(made) & set(ours):
        return
    for node in ours:
        nodes.remove(node)
    attribute = _attribute(nodes, roughness or noise, 1)
    rough = attribute.outputs["Fac"] if roughness else _scaled(nodes, links, attribute.outputs["Fac"], 0.1, 1, 0.6)
    if not roughness:
        rough.node.use_clamp = True
    attribute.name = rough.node.name = _ROUGH
    links.new(rough, shader.inputs["Roughness"])


def _base_color(material):
    shader = _principled(material)
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
