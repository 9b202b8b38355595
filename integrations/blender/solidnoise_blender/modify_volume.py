"""Object > Solidnoise on a volume: wears it off, adds detail, or cuts it by a mesh."""

import json
import os
import re
import tempfile
from typing import Optional

import bpy
import numpy as np
import solidnoise

from . import fields, files, masks, memory, recipes, sequence, settings, volumes
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
                                           unit="LENGTH", options={"SKIP_SAVE"}),
        "suited": bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"})}  # the preset whose frequency suits the volume
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


def _main(names: list) -> str:
    """The grid that is changed where not all are."""
    return "density" if "density" in names else names[0]


def _modified(recipe: dict, mask: Optional[masks.Mask], time: float, tell):
    """A modified volume: all grids of floats where it is cut, else the main one. None where there is nothing to change."""
    file = recipe["on"]["file"]
    floats = [grid for grid in solidnoise.read_volume(file).grids.values() if grid.value_type == "float"]
    if not floats:
        raise Refused(f"{os.path.basename(file)} has no grid of floats")
    names = [grid.name for grid in floats]
    names = names if "layers" in recipe else [recipe["on"].get("grid", _main(names))]
    grids = [grid for grid in floats if grid.name in names and grid.active_voxels]
    result = None
    made = {**recipe, "time": time} if recipe["noise"].get("evolve") else recipe
    with tempfile.TemporaryDirectory() as folder:
        limits = mask.limits(folder, file, grids) if mask and grids else {grid.name: {} for grid in grids}
        for place, (name, limit) in enumerate(limits.items()):
            result = memory.make_volume({**made, **limit, "on": {"file": file, "grid": name}},
                                        progress=lambda part: tell((place + part) / len(limits)))
            if place + 1 < len(limits):
                file = os.path.join(folder, f"{place}.vdb")
                result.write(file)
    return result


def _making(recipe: dict, path: str, mask: Optional[masks.Mask]):
    """Work that makes the file of a modified volume."""

    def work(tell) -> None:
        result = _modified(recipe, mask, 0.0, tell)
        if result is None:
            raise Refused(f"{os.path.basename(recipe['on']['file'])} has no active voxels to change")
        result.write(path, force=True)

    return work


def _making_all(recipe: dict, folder: str, mask: Optional[masks.Mask], frames: dict, fps: float):
    """Work that makes those of a sequence; a frame with nothing to change, as before smoke rises, stays as it is."""

    def make(frame: int, time: float, tell):
        of_frame = {**recipe, "on": {**recipe["on"], "file": frames[frame]}}
        return _modified(of_frame, mask, time, tell) or solidnoise.read_volume(frames[frame])

    return sequence.making(make, folder, list(frames), fps)


def _shown_grids(context, obj) -> dict:
    """The grids of floats that an object shows, and the matrices that take their voxels to its coordinates."""
    volume = obj.evaluated_get(context.evaluated_depsgraph_get()).data if obj.data.is_sequence else obj.data
    volume.grids.load()
    return {grid.name: np.array(grid.matrix_object) for grid in volume.grids if grid.data_type == "FLOAT"}


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


def _mask(context, obj, chosen, matrices: dict) -> Optional[masks.Mask]:
    if not chosen.mask:
        if chosen.preset == "mask":
            raise Refused("no mask is chosen; it must be a mesh of the scene")
        return None
    other = bpy.data.objects.get(chosen.mask)
    if other is None or other.type != "MESH":
        raise Refused(f"mask is {chosen.mask}; it must be a mesh of the scene")
    return masks.Mask(other.name, obj.name, *masks.surface(context, other, obj), feather=chosen.feather / volumes.scale_of(obj),
                      is_inside=chosen.outside == (chosen.preset == "mask"), must_touch=not obj.data.is_sequence, matrices=matrices)


def modify(context, obj, chosen, source: str, sources: list) -> str:
    """Shows the source's volume, modified: all of its frames, if it is a sequence. Says which of its grids that is, if it is one of several."""
    is_sequence = obj.data.is_sequence
    if not os.path.isfile(files.absolute(source)):
        raise Refused(f"{obj.name} has no file; it must be a volume of a .vdb")
    recipe = {**chosen.recipe(), "on": {"file": files.absolute(source)}}
    shown = _shown_grids(context, obj)
    if shown and "layers" not in recipe:
        recipe["on"]["grid"] = _main(list(shown))
    mask = _mask(context, obj, chosen, shown)
    key = {**recipe, "mask": mask.key() if mask else []}
    if is_sequence:
        render = context.scene.render
        fps = render.fps / render.fps_base
        frames = _frames(obj.data, source)
        folder, job = volumes.request(obj.name, recipe, lambda recipe, path: _making_all(recipe, path, mask, frames, fps),
                                      {**key, "frames": [*frames, fps]}, ending="")
        path = f"{folder}/{os.path.basename(sequence.frame_path('', min(frames)))}"
    else:
        path, job = volumes.request(obj.name, recipe, lambda recipe, path: _making(recipe, path, mask), key)
    volumes.own_data(obj)
    volume, absolute = obj.data, files.absolute(path)
    before = volume.filepath, volume.get(files.SOURCES, ""), obj.get(volumes.RECIPE, "")

    def failed(_) -> None:
        for found in volumes.users_of(absolute):
            found.data.filepath, found.data[files.SOURCES], found[volumes.RECIPE] = before

    volume[files.SOURCES] = "\n".join([*sources, source])
    obj[volumes.RECIPE] = json.dumps(recipe)
    volumes.show(volume, path, job, failed, is_sequence)
    files.tidy()
    return recipe["on"].get("grid", "") if len(shown) > 1 else ""


def suit(chosen, obj) -> None:
    """The recipe's frequency for a volume of this size, unless another was asked for."""
    properties = chosen.properties
    is_filled, is_set = properties.filled == properties.preset, properties.is_property_set("noise_frequency")
    settings.prepare(chosen, MODIFY)
    own = np.float32(recipes.preset(MODIFY, properties.preset)["noise"]["frequency"])
    if properties.suited == properties.preset or (properties.noise_frequency != own if is_filled else is_set):
        return
    properties.suited = properties.preset
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
        grid = modify(context, obj, self, obj.data.filepath, [line for line in obj.data.get(files.SOURCES, "").split("\n") if line])
        if grid:
            self.report({"INFO"}, f"the grid {grid} of {obj.name} is changed, its others are not")
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
