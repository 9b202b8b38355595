"""Where volumes are kept: beside the .blend, in //solidnoise/, or until it is saved in Blender's temporary folder. What nothing shows any
more, after an undo or a change, goes to a bin in the temporary folder, from which a redo takes it back. What a saved .blend shows stays."""

import json
import os
import re
import shutil

import bpy
from bpy.app.handlers import persistent

from . import waits, worker
from .recipes import RECIPE

_FOLDER, _BIN = "solidnoise", "solidnoise_bin"
_KEPT = 20  # files and folders in the bin at least; as many as there are steps to undo, if those are more
SOURCES = "solidnoise_sources"  # of a volume: the files that it was made from, one before the other, a line each
_made: set[str] = set()  # absolute paths of files and folders of this session
_saved: set[str] = set()  # what .blend files show, as they were saved or opened: any of them may be opened again
restore = None  # what makes a missing file again: volumes.restore


def absolute(path: str, library=None) -> str:
    return os.path.normpath(bpy.path.abspath(path, library=library))


def _folder() -> str:
    return f"//{_FOLDER}/" if bpy.data.filepath else os.path.join(bpy.app.tempdir, _FOLDER, "")


def path_for(name: str, digest: str, ending: str = ".vdb") -> str:
    """Of a file to be, after an object's name, as a data-block has it; its folder is there."""
    label = re.sub(r"\W+", "_", re.sub(r"\.\d+$", "", name.lower()))
    os.makedirs(absolute(_folder()), exist_ok=True)
    return f"{_folder()}{label}-{digest}{ending}"


def as_here(path: str) -> str:
    """Where this .blend has a file that may be made again, as its name is of path_for(), wherever it was; empty of any other."""
    ours = re.search(rf"[\\/]{_FOLDER}[\\/](\w*-[0-9a-f]{{12}}(\.vdb|[\\/][^\\/]+))$", path)
    return _folder() + ours[1] if ours else ""


def made(path: str) -> None:
    """Notes a file, or the folder of a sequence, that is ours to remove."""
    _made.add(absolute(path))


def shown() -> set[str]:
    """The files that volumes show, or were made from."""
    paths = set()
    for volume in bpy.data.volumes:
        for path in (volume.filepath, *volume.get(SOURCES, "").split("\n")):
            if path and volume.users:  # none are left of what was deleted
                paths |= {absolute(path, volume.library), os.path.dirname(absolute(path, volume.library))}
    return paths


def is_shown(path: str) -> bool:
    return absolute(path) in shown()


def _throw_away(path: str) -> None:
    folder = os.path.join(bpy.app.tempdir, _BIN)
    os.makedirs(folder, exist_ok=True)
    thrown = os.path.join(folder, os.path.basename(path))
    shutil.rmtree(thrown, ignore_errors=True)
    shutil.move(path, thrown)
    os.utime(thrown)  # what was thrown away first goes first, however old it is
    oldest = sorted((entry.path for entry in os.scandir(folder)), key=os.path.getmtime)
    for path in oldest[:-max(_KEPT, bpy.context.preferences.edit.undo_steps)]:
        shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)


def take_back(path: str) -> bool:
    """Whether a file is there, or was in the bin, alone or in its folder."""
    for wanted in (path, os.path.dirname(path)):
        thrown = os.path.join(bpy.app.tempdir, _BIN, os.path.basename(wanted))
        if not os.path.exists(path) and os.path.exists(thrown):
            os.makedirs(os.path.dirname(wanted), exist_ok=True)
            shutil.move(thrown, wanted)
            _made.add(wanted)
    return os.path.exists(path)


def tidy() -> None:
    """Throws away what was made and nothing shows, nor any .blend."""
    keep = shown() | _saved
    folders = {os.path.dirname(path) for path in _made}
    for path in [path for path in _made if path not in keep]:
        _made.discard(path)
        if os.path.exists(path):
            _throw_away(path)
    for folder in folders:
        if os.path.basename(folder) == _FOLDER and os.path.isdir(folder) and not os.listdir(folder):
            os.rmdir(folder)


@persistent
def _after_undo(*_) -> None:
    if bpy.data.filepath:
        _bring_along()  # steps of before it was saved have the paths of then
    tidy()
    restore()


@persistent
def _after_load(*_) -> None:
    worker.stop_all()  # which is for the file that is closed
    waits.forget()
    _made.clear()
    _saved.update(shown())
    lost = restore()
    if lost:
        worker.tell("\n".join(lost))


@persistent
def _after_save(*_) -> None:
    """Takes what is in the temporary folder along to the .blend's, and saves the new paths."""
    if not bpy.data.filepath:  # Blender does not say where the copy is
        if any(path.startswith(absolute(_folder())) for path in shown()):
            worker.tell("the copy has no volumes with it: they are in the temporary folder until this scene is saved itself")
        return
    if _bring_along():
        _save_again()
    _saved.update(shown())
    restore()  # what was still being made for the other folder
    tidy()


def _save_again() -> None:
    """Without a backup, which would be of the save before and not of what that has overwritten."""
    preferences = bpy.context.preferences
    versions, is_dirty = preferences.filepaths.save_version, preferences.is_dirty
    preferences.filepaths.save_version = 0
    try:
        bpy.ops.wm.save_mainfile()
    finally:
        preferences.filepaths.save_version, preferences.is_dirty = versions, is_dirty


def _bring_along() -> bool:
    """Takes what is in the temporary folder along to the .blend's; whether a volume showed any of it."""
    before = {volume: (volume.filepath, volume.get(SOURCES, "")) for volume in bpy.data.volumes if not volume.library}
    for volume, (path, sources) in before.items():
        volume.filepath = _beside_blend(path)
        if sources:
            volume[SOURCES] = "\n".join(map(_beside_blend, sources.split("\n")))
    if all((volume.filepath, volume.get(SOURCES, "")) == was for volume, was in before.items()):
        return False
    old, new = (json.dumps(os.path.join(folder, _FOLDER, ""))[1:-1] for folder in (bpy.app.tempdir, os.path.dirname(bpy.data.filepath)))
    for obj in bpy.data.objects:
        if isinstance(obj.get(RECIPE), str) and old in obj[RECIPE] and not obj.library:
            obj[RECIPE] = obj[RECIPE].replace(old, new)
    return True


def _beside_blend(path: str) -> str:
    """The path of what was in the temporary folder, or the path."""
    folder = os.path.join(bpy.app.tempdir, _FOLDER)
    part = os.path.relpath(absolute(path), folder) if path else ".."
    if part.startswith(".."):
        return path
    top = part.split(os.sep)[0]
    old, new = os.path.join(folder, top), absolute(f"//{_FOLDER}/{top}")
    if os.path.exists(old):
        os.makedirs(os.path.dirname(new), exist_ok=True)
        if not os.path.exists(new):
            shutil.move(old, new)
        _made.discard(old)
        _made.add(new)
    return f"//{_FOLDER}/{part}".replace(os.sep, "/")


_HANDLERS = {"undo_post": _after_undo, "redo_post": _after_undo, "load_post": _after_load, "save_post": _after_save}


def register() -> None:
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).remove(handler)
    _made.clear()
    _saved.clear()
