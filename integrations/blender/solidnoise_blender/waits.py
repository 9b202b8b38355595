"""Objects that wait for work behind the window: found whatever they are called by then, and not after an undo."""

import bpy

_WAITS = "solidnoise_waits"  # of an object: which work it waits for


def mark(obj, job) -> str:
    """What the object is found by."""
    obj[_WAITS] = str(id(job))
    return obj[_WAITS]


def found(token: str) -> list:
    return [obj for obj in bpy.data.objects if obj.get(_WAITS) == token]


def forget(token: str = "") -> None:
    """Has no object wait for it; without it, for anything."""
    for obj in bpy.data.objects:
        if _WAITS in obj and not obj.library and token in ("", obj[_WAITS]):
            del obj[_WAITS]
