"""Volumes of no more memory than there is: the system would end Blender, and what was not saved."""

from typing import Optional

import solidnoise


def available() -> Optional[int]:
    """Bytes that can be taken without swapping, where the system says so."""
    try:
        with open("/proc/meminfo") as file:
            return next(1024 * int(line.split()[1]) for line in file if line.startswith("MemAvailable:"))
    except (OSError, StopIteration):
        return None


def make_volume(recipe: dict, **options):
    """As the library's. Raises MemoryError, in its words, for what may take more."""
    return solidnoise.make_volume(recipe, max_memory=available(), **options)
