"""The recipes that come with the package, those of vdbnoise and of meshnoise."""

import json
from pathlib import Path
from typing import Any

_FOLDER = Path(__file__).parent / "presets"


def presets() -> dict[str, str]:
    """The names of all presets, each with a line that says what it is."""
    return {file.stem: str(json.loads(file.read_text())["description"]) for file in sorted(_FOLDER.glob("*.json"))}


def preset(name: str) -> dict[str, Any]:
    """A preset's recipe, to be changed and made, by make_volume() or by bake(). Raises ValueError for a name that there is none of."""
    file = _FOLDER / f"{name}.json"
    if name not in presets():
        raise ValueError(f"preset is {name}; it must be one of {', '.join(presets())}")
    recipe: dict[str, Any] = json.loads(file.read_text())
    return recipe
