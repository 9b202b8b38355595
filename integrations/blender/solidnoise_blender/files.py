"""Where volumes are kept: beside the .blend, in //solidnoise/, or until it is saved in Blender's temporary folder. What nothing shows any
more, after an undo or a change, goes to a bin in the temporary folder, from which a redo takes it back."""

import os
import re
import shutil

import bpy
from bpy.app.handlers import persistent

_FOLDER, _BIN = "solidnoise", "solidnoise_bin"
_KEPT = 20  # files and folders in the bin
SOURCES = "solidnoise_sources"  # of a volume: the files that it was made from, one before the other, a line each
_made: set[str] = set()  # absolute paths of files and folders of this session
restore = None  # what makes a missing file again: volumes.restore


def absolute(path: str, library=None) -> str:
    return os.path.normpath(bpy.path.abspath(path, library=library))


def path_for(name: str, digest: str, ending: str = ".vdb") -> str:
    """Of a file to be, after an object's name, as a data-block has it; its folder is there."""
    label = re.sub(r"\W+", "_", re.sub(r"\.\d+$", "", name.lower()))
    folder = f"//{_FOLDER}/" if bpy.data.filepath else os.path.join(bpy.app.tempdir, _FOLDER, "")
    os.makedirs(absolute(folder), exist_ok=True)
    return f"{folder}{label}-{digest}{ending}"


def made(path: str) -> None:
    """Notes a file, or the folder of a sequence, that is ours to remove."""
    _made.add(absolute(path))


def shown() -> set[str]:
    """The files that volumes show, or were made from."""
    paths = set()
    for volume in bpy.data.volumes:
        for path in (volume.filepath, *volume.get(SOURCES, "").split("\n")):
            if path:
                paths |= {absolute(path, volume.library), os.path.dirname(absolute(path, volume.library))}
    return paths


def is_shown(path: str) -> bool:
    return absolute(path) in shown()


def _throw_away(path: str) -> None:
    folder = os.path.join(bpy.app.tempdir, _BIN)
    os.makedirs(folder, exist_ok=True)
    shutil.rmtree(os.path.join(folder, os.path.basename(path)), ignore_errors=True)
    shutil.move(path, os.path.join(folder, os.path.basename(path)))
    oldest = sorted((entry.path for entry in os.scandir(folder)), key=os.path.getmtime)
    for path in oldest[:-_KEPT]:
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
    """Throws away what was made and nothing shows."""
    keep = shown()
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
    tidy()
    restore()


@persistent
def _after_load(*_) -> None:
    _made.clear()
    restore()


@persistent
def _after_save(*_) -> None:
    """Takes what is in the temporary folder along to the .blend's, and saves the new paths."""
    if not bpy.data.filepath:
        return
    before = {volume: (volume.filepath, volume.get(SOURCES, "")) for volume in bpy.data.volumes if not volume.library}
    for volume, (path, sources) in before.items():
        volume.filepath = _beside_blend(path)
        if sources:
            volume[SOURCES] = "\n".join(map(_beside_blend, sources.split("\n")))
    if any(volume.filepath != path for volume, (path, _) in before.items()):
        bpy.ops.wm.save_mainfile()
    restore()  # what was still being made for the other folder


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
