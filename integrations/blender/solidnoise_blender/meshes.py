"""Meshes of the scene as the library's arrays, and what it makes of them as attributes and shape keys."""

import bpy
import numpy as np

from . import materials
from .errors import Refused

COLOR, NOISE, DISPLACEMENT, KEY = "solidnoise", "noise", "displacement", "Solidnoise"
_OURS = "solidnoise_attributes"  # of a mesh: the attributes that were made here, a line each


def scale_of(obj) -> np.ndarray:
    """Of the object in the world, so that features are as large along every axis. A mirrored one has the noise of what it mirrors."""
    scale = np.abs(np.array(obj.matrix_world.to_scale()))
    if not scale.all():
        raise Refused(f"{obj.name} is scaled to 0 along an axis; its surface has no extent")
    return scale


def up_of(obj) -> str:
    """The axis of the mesh that is up in the scene, or down: y of what was imported from a file that has y up."""
    upwards = obj.matrix_world.to_3x3()[2]
    return "y" if abs(upwards[1]) > abs(upwards[2]) else "z"


def read(obj) -> tuple[np.ndarray, np.ndarray]:
    """Vertices, at the size they have in the world, and faces: of equal numbers of corners, else triangles."""
    mesh = obj.data
    count = len(mesh.vertices)
    if count == 0:
        raise Refused(f"{mesh.name}: the mesh has no vertices")
    if len(mesh.polygons) == 0:
        raise Refused(f"{mesh.name}: the mesh has {count} vertices but no faces")
    positions = np.empty(3 * count, np.float32)
    (mesh.shape_keys.key_blocks[0].data if mesh.shape_keys else mesh.vertices).foreach_get("co", positions)
    corners = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("loop_total", corners)
    if (corners == corners[0]).all():
        faces = np.empty(len(mesh.loops), np.int32)
        mesh.loops.foreach_get("vertex_index", faces)
        faces = faces.reshape(-1, corners[0])
    else:
        mesh.calc_loop_triangles()
        faces = np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("vertices", faces)
        faces = faces.reshape(-1, 3)
    return positions.reshape(-1, 3) * scale_of(obj), faces


def number(obj, name: str) -> np.ndarray:
    """A number of each vertex: an attribute, or the weights of a vertex group."""
    mesh = obj.data
    values = np.zeros(len(mesh.vertices), np.float32)
    attribute = mesh.attributes.get(name)
    if attribute and attribute.domain == "POINT" and attribute.data_type in ("FLOAT", "INT"):
        attribute.data.foreach_get("value", values)
        return values
    group = obj.vertex_groups.get(name)
    if not group:
        raise Refused(f"{mesh.name} has no number {name} of its vertices, and no vertex group")
    for vertex in mesh.vertices:
        values[vertex.index] = next((member.weight for member in vertex.groups if member.group == group.index), 0.0)
    return values


_KINDS = {COLOR: "FLOAT_COLOR", NOISE: "FLOAT", DISPLACEMENT: "FLOAT_VECTOR"}


def _properties(baked: dict) -> dict:
    """Those that the recipe has names for: roughness, height."""
    return {name: numbers for name, numbers in baked.items() if name not in ("vertices", "faces", "normals", "colors", NOISE)}


def _ours(mesh) -> set[str]:
    return set(filter(mesh.attributes.get, mesh.get(_OURS, "").split("\n")))


def require_room(mesh, *names: str) -> None:
    """That what is to be written is not there already as something else, or somebody else's."""
    for name in names:
        found = mesh.attributes.get(name)
        if found and (found.data_type, found.domain) != (_KINDS.get(name, "FLOAT"), "POINT"):
            raise Refused(f"{mesh.name} has an attribute {name} of another kind; rename or remove it")
        if found and name not in _ours(mesh):
            raise Refused(f"{mesh.name} has an attribute {name} that was not made here; rename or remove it")


def _set(mesh, name: str, key: str, values: np.ndarray) -> None:
    if name not in mesh.attributes:
        mesh.attributes.new(name, _KINDS.get(name, "FLOAT"), "POINT")
    mesh.attributes[name].data.foreach_set(key, values.ravel())
    mesh[_OURS] = "\n".join(sorted(_ours(mesh) | {name}))


def write(obj, baked: dict) -> None:
    """Colours, in linear light as Blender has them, the noise and the recipe's properties, and a material that shows them."""
    mesh = obj.data
    properties = _properties(baked)
    require_room(mesh, COLOR, NOISE, *properties)
    for name in _ours(mesh) - _KINDS.keys() - properties.keys():  # of another recipe
        mesh.attributes.remove(mesh.attributes[name])
    with_alpha = np.ones((len(mesh.vertices), 4), np.float32)
    with_alpha[:, :3] = baked["colors"]
    _set(mesh, COLOR, "color", with_alpha)
    for name, numbers in {NOISE: baked["noise"], **properties}.items():
        _set(mesh, name, "value", numbers)
    mesh.color_attributes.active_color = mesh.color_attributes[COLOR]
    mesh.color_attributes.render_color_index = mesh.color_attributes.active_color_index
    before = obj.active_material
    if not before or not before.get(COLOR):
        obj.active_material = materials.of_mesh(f"{obj.name} noise", COLOR)
        obj.active_material[COLOR] = True
        if before and not before.users and not before.library:
            before.use_fake_user = True  # the user's own, which would go with the next save
    materials.set_roughness(obj.active_material, NOISE, "roughness" if "roughness" in properties else "")
    materials.set_range(obj.active_material, float(baked["noise"].min()), float(baked["noise"].max()))
    mesh.update()


def displace(obj, baked: dict, as_key: bool) -> None:
    """Moved vertices as a shape key, or how far they move as an attribute for Geometry Nodes; and the noise."""
    mesh = obj.data
    require_room(mesh, NOISE, *([] if as_key else [DISPLACEMENT]))
    moved = np.float32(baked["vertices"] / scale_of(obj))
    _set(mesh, NOISE, "value", baked["noise"])
    if not as_key:
        _set(mesh, DISPLACEMENT, "vector", moved - np.float32(read(obj)[0] / scale_of(obj)))
    else:
        if not mesh.shape_keys:
            obj.shape_key_add(name="Basis")
        key = mesh.shape_keys.key_blocks.get(KEY) or obj.shape_key_add(name=KEY, from_mix=False)
        key.data.foreach_set("co", moved.ravel())
        key.value = 1.0
    mesh.update()


def show(obj, what: str) -> None:
    """Has the material that a bake made show the colours, or the noise in greys."""
    material, noise = obj.active_material, obj.data.attributes.get(NOISE)
    if noise is None or not material or not material.get(COLOR):
        raise Refused(f"{obj.name} has no noise, or its active material is another one; bake noise on it first")
    if what == "COLORS":
        return materials.show_colors(material, COLOR)
    values = np.empty(len(obj.data.vertices), np.float32)
    noise.data.foreach_get("value", values)
    materials.show_number(material, NOISE, float(values.min()), float(values.max()))


def _shadings(screen) -> list:
    return [area.spaces.active.shading for area in (screen.areas if screen else ()) if area.type == "VIEW_3D"]


def view_colors(screen) -> None:
    """Has the viewports of a window show colour attributes where they show no materials."""
    for shading in _shadings(screen):
        shading.color_type = "VERTEX"


def view_materials(screen) -> None:
    """Has the viewports of a window show materials: alone they show numbers, which are no colours."""
    for shading in _shadings(screen):
        shading.type = "MATERIAL" if shading.type in ("SOLID", "WIREFRAME") else shading.type
