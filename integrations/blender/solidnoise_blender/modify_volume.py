"""Object > Solidnoise on a volume: wears it off, adds detail, or cuts it by a mesh."""

import hashlib
import json
import os
import re
import tempfile

import bpy
import solidnoise

from . import fields, files, masks, recipes, sequence, settings, volumes
from .add_volume import copy
from .errors import Refused, reported, require_object
from .recipes import MODIFY

_FITS = 2.0  # world units: the longest side of the volume that the recipes' frequencies are for


class ModifySettings:
    __annotations__ = {
        **settings.shared(MODIFY, settings.OF_MODIFY),
        "mask": bpy.props.StringProperty(name="Mask", description="A closed mesh of the scene, which limits the change", options={"SKIP_SAVE"}),
        "outside": bpy.props.BoolProperty(name="Outside", description="Of the mask: out of the mesh, in place of in it", options={"SKIP_SAVE"}),
        "feather": bpy.props.FloatProperty(name="Feather", description="Width over which the mask ends; 0: two voxels", default=0.0, min=0.0,
                                           unit="LENGTH", options={"SKIP_SAVE"})}
    SHARED = tuple(__annotations__)

    def recipe(self) -> dict:
        settings.prepare(self, MODIFY)
        return settings.with_keys_of_its_noise(fields.applied(self, settings.OF_MODIFY, recipes.preset(MODIFY, self.preset)))

    def draw_settings(self, layout) -> None:
        recipe = fields.applied(self, [settings.TYPE], recipes.preset(MODIFY, self.preset))
        layout.use_property_split = True
        layout.prop(self, "preset")
        layout.prop_search(self, "mask", bpy.data, "objects")
        for name in ("outside", "feather") if self.mask else ():
            layout.prop(self, name)
        if self.preset == "mask":
            return
        main = settings.named(settings.OF_MODIFY, "modify_amount", "noise_seed", "noise_frequency", "noise_octaves")
        fields.draw(layout, self, main, recipe)
        if fields.draw_fold(layout, self):
            fields.draw(layout, self, [field for field in settings.OF_MODIFY if field not in main], recipe)


class SolidnoiseModifySettings(ModifySettings, bpy.types.PropertyGroup):
    """Of an object: how it was modified last."""


def _modified(recipe: dict, mesh, mask: dict, time: float, tell):
    """A modified volume: all grids of floats where it is cut, else the first."""
    volume = solidnoise.read_volume(recipe["on"]["file"])
    floats = [grid for grid in volume.grids.values() if grid.value_type == "float"]
    names = [grid.name for grid in floats] if "layers" in recipe else [""]
    with tempfile.TemporaryDirectory() as folder:
        made = {**recipe, "time": time} if recipe["noise"].get("evolve") else dict(recipe)
        if mesh and floats:
            made["mask"] = {"file": masks.make(folder, mesh, floats[0], **mask)}
        for place, name in enumerate(names):
            made["on"] = {**made["on"], "grid": name}
            result = solidnoise.make_volume(made, progress=lambda part: tell((place + part) / len(names)))
            if place + 1 < len(names):
                made["on"] = {"file": os.path.join(folder, f"{place}.vdb")}
                result.write(made["on"]["file"])
        return result


def _making(recipe: dict, path: str, mesh, mask: dict):
    """Work that makes the file of a modified volume."""
    return lambda tell: _modified(recipe, mesh, mask, 0.0, tell).write(path, force=True)


def _making_all(recipe: dict, folder: str, mesh, mask: dict, frames: dict, fps: float):
    """Work that makes those of a sequence."""
    return sequence.making(lambda frame, time, tell: _modified({**recipe, "on": {"file": frames[frame]}}, mesh, mask, time, tell),
                           folder, list(frames), fps)


def _frames(volume, source: str) -> dict:
    """The files of a sequence's frames, by their numbers, as far as they are there."""
    folder, name = os.path.split(files.absolute(source))
    parts = re.fullmatch(r"(.*?)(\d+)(\D*)", name)
    first = volume.frame_offset + 1
    paths = {frame: os.path.join(folder, f"{parts[1]}{frame:0{len(parts[2])}d}{parts[3]}") if parts else ""
             for frame in range(first, first + volume.frame_duration)}
    found = {frame: path for frame, path in paths.items() if os.path.isfile(path)}
    if not found:
        raise Refused(f"{volume.name} has no files of frames {first} to {first + volume.frame_duration - 1}")
    return found


def _mesh_of_mask(context, obj, name: str):
    if not name:
        return None
    other = bpy.data.objects.get(name)
    if other is None or other.type != "MESH":
        raise Refused(f"mask is {name}; it must be a mesh of the scene")
    return masks.surface(context, other, obj)


def modify(context, obj, chosen, source: str, sources: list) -> None:
    """Shows the source's volume, modified: all of its frames, if it is a sequence."""
    volume, is_sequence = obj.data, obj.data.is_sequence
    if not os.path.isfile(files.absolute(source)):
        raise Refused(f"{obj.name} has no file; it must be a volume of a .vdb")
    recipe = {**chosen.recipe(), "on": {"file": files.absolute(source)}}
    mesh = _mesh_of_mask(context, obj, chosen.mask)
    if chosen.preset == "mask" and mesh is None:
        raise Refused("no mask is chosen; it must be a mesh of the scene")
    mask = {"feather": chosen.feather, "is_inside": chosen.outside == (chosen.preset == "mask")}
    shape = hashlib.sha256(b"".join(part.tobytes() for part in mesh)).hexdigest() if mesh else ""
    key = {**recipe, "mask": [shape, mask]}
    if is_sequence:
        render = context.scene.render
        fps = render.fps / render.fps_base
        frames = _frames(volume, source)
        folder, job = volumes.request(obj.name, recipe, lambda recipe, path: _making_all(recipe, path, mesh, mask, frames, fps),
                                      {**key, "frames": [*frames, fps]}, ending="")
        path = f"{folder}/{os.path.basename(sequence.frame_path('', min(frames)))}"
    else:
        path, job = volumes.request(obj.name, recipe, lambda recipe, path: _making(recipe, path, mesh, mask), key)
    before = volume.filepath, volume.get(files.SOURCES, ""), obj.get(volumes.RECIPE, "")
    name = obj.name

    def failed(_) -> None:
        found = bpy.data.objects.get(name)
        if found is not None:
            found.data.filepath, found.data[files.SOURCES], found[volumes.RECIPE] = before

    volume[files.SOURCES] = "\n".join([*sources, source])
    obj[volumes.RECIPE] = json.dumps(recipe)
    volumes.show(volume, path, job, failed, is_sequence)
    files.tidy()


def suit(chosen, obj) -> None:
    """The recipe's frequency for a volume of this size, unless another was asked for."""
    properties = chosen.properties
    if properties.filled == properties.preset or properties.is_property_set("noise_frequency"):
        return
    settings.prepare(chosen, MODIFY)
    side = max(max(corner[axis] for corner in obj.bound_box) - min(corner[axis] for corner in obj.bound_box) for axis in range(3))
    if side > 0:
        properties.noise_frequency = float(f"{properties.noise_frequency * _FITS / side:.2g}")


class OBJECT_OT_solidnoise_volume_modify(ModifySettings, bpy.types.Operator):
    """Change a volume by noise, or cut it by a mesh; its file stays, and so do its other grids"""

    bl_idname, bl_label = "object.solidnoise_volume_modify", "Modify Volume"
    bl_options = {"REGISTER", "UNDO"}

    @reported
    def execute(self, context):
        obj = context.object
        require_object(obj, "VOLUME")
        suit(self, obj)
        modify(context, obj, self, obj.data.filepath, [line for line in obj.data.get(files.SOURCES, "").split("\n") if line])
        copy(self, obj.solidnoise_modify)
        return {"FINISHED"}

    def draw(self, context):
        self.draw_settings(self.layout)


class OBJECT_OT_solidnoise_volume_modify_again(bpy.types.Operator):
    """Modify the volume again from what it was, with the values of the side panel"""

    bl_idname, bl_label = "object.solidnoise_volume_modify_again", "Remake"
    bl_options = {"REGISTER", "UNDO"}

    @reported
    def execute(self, context):
        obj = context.object
        require_object(obj, "VOLUME")
        sources = [line for line in obj.data.get(files.SOURCES, "").split("\n") if line]
        if not sources:
            raise Refused(f"{obj.name} is not modified")
        modify(context, obj, obj.solidnoise_modify, sources[-1], sources[:-1])
        return {"FINISHED"}


CLASSES = (SolidnoiseModifySettings, OBJECT_OT_solidnoise_volume_modify, OBJECT_OT_solidnoise_volume_modify_again)


def register() -> None:
    bpy.types.Object.solidnoise_modify = bpy.props.PointerProperty(type=SolidnoiseModifySettings)


def unregister() -> None:
    del bpy.types.Object.solidnoise_modify
