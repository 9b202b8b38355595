"""Volumes in the scene: their files are made behind the window, and shown when they are there."""

import json
import math
import os
from typing import Callable, Optional

import bpy

from . import files, memory, recipes, worker
from .errors import Refused
from .recipes import RECIPE


def making(recipe: dict, path: str) -> Callable:
    """Work that makes a recipe's file, whole or not at all."""

    def work(tell: Callable) -> None:
        memory.make_volume(recipe, progress=tell).write(path, force=True)

    return work


def _start(work: Callable, path: str) -> worker.Job:
    """Work on a file, which stops when no volume shows it any more."""
    return worker.Job(path, work, done=lambda _: arrived(path), wanted=lambda: files.is_shown(path))


def request(name: str, recipe: dict, work_for: Callable = making, key: Optional[dict] = None,
            ending: str = ".vdb") -> tuple[str, Optional[worker.Job]]:
    """The path of a recipe's file, after a name, and the job that still makes it, if any. `key`: what it is the file of, if not of the recipe alone.
    Without an ending it is the folder of a sequence. Raises what the library does of a recipe."""
    path = files.path_for(name, recipes.digest(key or recipe), ending)
    absolute = files.absolute(path)
    job = worker.at_work(absolute)
    if job:
        return path, job
    if files.take_back(absolute):
        return path, None
    job = _start(work_for(recipe, absolute), absolute)
    if worker.wait_a_little(job):
        job.settle()
        files.made(absolute)
        return path, None
    return path, job


def arrived(path: str) -> None:
    """Shows a file, or the files of a folder, in the volumes that wait for it."""
    files.made(path)
    for volume in bpy.data.volumes:
        own = files.absolute(volume.filepath)
        if path in (own, os.path.dirname(own)):
            volume.filepath = volume.filepath  # reads it
            if not volume.is_sequence:  # whose grids only evaluated copies have
                volume.grids.load()
    files.tidy()


def show(volume, path: str, job: Optional[worker.Job], failed: Callable, is_sequence: bool = False) -> None:
    """Gives a volume its file, or the first of a sequence, now or when the job is over."""
    volume.is_sequence = is_sequence
    volume.filepath = path
    if job is None and not is_sequence:
        volume.grids.load()
    elif job and job not in worker.jobs:
        job.failed = failed
        worker.go_on(job)


def longest_side(recipe: dict) -> float:
    box = recipe["domain"].get("box", [-1, -1, -1, 1, 1, 1])
    return max(box[axis + 3] - box[axis] for axis in range(3))


def require_collection(context) -> None:
    """That there may be another object."""
    if context.collection.library:
        raise Refused(f"the active collection, {context.collection.name}, is linked; choose one of this file")


def add_object(context, name: str):
    """A volume at the cursor, upright, and the only one selected."""
    obj = bpy.data.objects.new(name, bpy.data.volumes.new(name))
    obj.location = context.scene.cursor.location
    obj.rotation_euler = (math.pi / 2, 0, 0)  # up is y in a file, and z in Blender
    context.collection.objects.link(obj)
    for other in context.selected_objects:
        other.select_set(False)
    obj.select_set(True)
    context.view_layer.objects.active = obj
    return obj


def remove_object(obj) -> None:
    """With its volume and materials, as if they had never been."""
    volume, materials = obj.data, [material for material in obj.data.materials if material]
    bpy.data.objects.remove(obj)
    for block, owner in [(volume, bpy.data.volumes), *[(material, bpy.data.materials) for material in materials]]:
        if block.users == 0:
            owner.remove(block)


def own_data(obj) -> None:
    """Gives an object a volume of its own where others show the same, as after Shift-D: they stay as they are."""
    if obj.data.users - obj.data.use_fake_user > 1:
        obj.data = obj.data.copy()


def scale_of(obj) -> float:
    """How many units of the scene one of the volume is."""
    return abs(obj.matrix_world.to_3x3().determinant()) ** (1 / 3) or 1.0


def users_of(path: str) -> list:
    return [obj for obj in bpy.data.objects if obj.type == "VOLUME" and files.absolute(obj.data.filepath) == path]


def remake(obj, recipe: dict) -> None:
    """Gives an object of a preset another recipe."""
    path, job = request(obj.name, recipe)
    own_data(obj)
    before = obj.data.filepath, obj.get(RECIPE)
    obj[RECIPE] = json.dumps(recipe)
    absolute = files.absolute(path)

    def failed(_) -> None:
        for other in users_of(absolute):
            other.data.filepath, other[RECIPE] = before

    show(obj.data, path, job, failed)


def restore() -> list[str]:
    """Has files again that are missing, from the bin or by the recipes of their objects: after an undo, or where a .blend came alone. Says in a
    line each which cannot be."""
    lost = []
    for obj in bpy.data.objects:
        if obj.type == "VOLUME" and RECIPE in obj and not obj.library and not obj.data.library:
            try:
                _restore(obj)
            except Exception as error:  # of the one object: the others have theirs all the same
                lost.append(f"{obj.name}: {error}")
    return lost


def _is_there(path: str) -> bool:
    """Or will be."""
    return os.path.exists(path) or any(map(worker.at_work, (path, os.path.dirname(path))))


def _restore(obj) -> None:
    volume = obj.data
    here = files.as_here(files.absolute(volume.filepath))
    if not here or _is_there(files.absolute(volume.filepath)):
        return
    if volume.filepath != here:
        volume.filepath = here
    path = files.absolute(here)
    if _is_there(path):
        return
    if files.take_back(path):
        return arrived(path)
    recipe = recipes.of_object(obj)
    if "on" in recipe or volume.is_sequence:
        raise Refused(f"{here} is missing, and {'what was modified' if 'on' in recipe else 'a sequence'} is not made again by itself")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    job = _start(making(recipe, path), path)
    if not worker.wait_a_little(job):
        return worker.go_on(job)
    job.settle()
    arrived(path)
