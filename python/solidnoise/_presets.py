"""The recipes that come with the package: those of vdbnoise, of volumes, and those of meshnoise, of bakes."""

import json
from pathlib import Path
from typing import Any, Literal

_FOLDER = Path(__file__).parent / "presets"
_KINDS = ("volume", "bake")


def _files(kind: str | None) -> dict[str, Path]:
    if kind not in (*_KINDS, None):
        raise ValueError(f"kind is {kind}; it must be one of {', '.join(_KINDS)}")
    kinds = _KINDS if kind is None else (kind,)
    # Of two of a name that of a volume, which comes last.
    return {file.stem: file for each in reversed(kinds) for file in sorted((_FOLDER / each).glob("*.json"))}


def _read(file: Path) -> dict[str, Any]:
    recipe: dict[str, Any] = json.loads(file.read_text())
    return recipe


def presets(kind: Literal["volume", "bake"] | None = None) -> dict[str, str]:
    """The names of all presets, or of those of a kind, "volume" or "bake", each with a line that says what it is."""
    return {name: str(_read(file)["description"]) for name, file in sorted(_files(kind).items())}


def preset(name: str, kind: Literal["volume", "bake"] | None = None) -> dict[str, Any]:
    """A preset's recipe, to be changed and made, by make_volume() or by bake(). Where both kinds have the name, as they have raw, it is the
    volume's, unless kind is "bake". Raises ValueError for a name that there is none of."""
    files = _files(kind)
    if name not in files:
        raise ValueError(f"preset is {name}; it must be one of {', '.join(sorted(files))}")
    return _read(files[name])
