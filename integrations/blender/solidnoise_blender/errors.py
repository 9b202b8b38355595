"""What may go wrong, told in a line."""

import functools

from .worker import Stopped


class Refused(Exception):
    """What was asked for cannot be; the text says why."""


def reported(execute):
    """An operator's execute() whose errors are reported, in the library's words, and leave nothing behind."""

    @functools.wraps(execute)
    def execute_or_report(self, context):
        try:
            return execute(self, context)
        except (Refused, ValueError, OSError, MemoryError, Stopped) as error:
            self.report({"ERROR"}, str(error) or "stopped")
            return {"CANCELLED"}

    return execute_or_report


def require_object(obj, kind: str) -> None:
    """That it is there, of the kind, local, and in object mode."""
    if obj is None or obj.type != kind:
        raise Refused(f"the active object is {obj.type.lower() if obj else 'none'}; it must be a {kind.lower()}")
    for owner in (obj, obj.data):
        if owner.library or owner.override_library:
            source = owner.library.filepath if owner.library else "another file"
            raise Refused(f"{owner.name} is linked from {source}; make it local first")
    if obj.mode != "OBJECT":
        raise Refused(f"{obj.name} is in {obj.mode.lower()} mode; leave it first")
