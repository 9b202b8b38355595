"""The presets' pictures, as icons of menus."""

import os

import bpy.utils.previews

_FOLDER = os.path.join(os.path.dirname(__file__), "pictures")
_previews = None


def icon(name: str, kind: str) -> int:
    """Of a preset of a kind: its own, as bake_raw_icon.png, or that of its name; 0, none, where there is no picture."""
    own = f"{kind}_{name}"
    picture = own if _previews and own in _previews else name
    return _previews[picture].icon_id if _previews and picture in _previews else 0


def register() -> None:
    global _previews
    _previews = bpy.utils.previews.new()
    for file in sorted(os.listdir(_FOLDER)):
        name, _, ending = file.rpartition("_")
        if ending == "icon.png":
            tuple(_previews.load(name, os.path.join(_FOLDER, file), "IMAGE").icon_size)  # reads it now: drawn first, some never come


def unregister() -> None:
    global _previews
    bpy.utils.previews.remove(_previews)
    _previews = None
