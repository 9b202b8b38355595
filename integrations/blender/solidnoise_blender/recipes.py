"""The recipes that ship, and what properties make of them."""

import functools
import hashlib
import json
import textwrap

import solidnoise

from . import fields
from .errors import Refused

VOLUME, BAKE, MODIFY = "volume", "bake", "modify"
RECIPE = "solidnoise_recipe"  # the custom property of an object that keeps its recipe, JSON
WIDTH = 28  # letters of a line of the side panel
_DIM = solidnoise.schema(VOLUME)["properties"]["domain"]["properties"]["dim"]["default"]
_DETAIL = {"type": "gabor", "bandwidth": 1, "octaves": 3, "lacunarity": 2, "gain": 0.5}
_MODIFICATIONS = {
    "erode": {"description": "Wears thin parts off and leaves what is dense", "noise": {**_DETAIL, "frequency": 3.5, "seed": 4},
              "combine": "erode", "amount": 2.5},
    "detail": {"description": "Adds lumps, strong where it is dense", "noise": {**_DETAIL, "frequency": 5, "seed": 1},
               "combine": "multiply", "amount": 0.9},
    "mask": {"description": "Cuts it by a mesh: what is out of it goes", "noise": {"type": "gabor", "frequency": 1},
             "layers": [{"weight": 0, "bias": 0}], "shaping": {"type": "raw"}, "combine": "replace"},
}


@functools.lru_cache(maxsize=None)
def presets(kind: str) -> list[tuple[str, str]]:
    """Names, and what they are, of volumes, bakes or modifications; the library's default first."""
    if kind == MODIFY:
        return [(name, recipe["description"]) for name, recipe in _MODIFICATIONS.items()]
    return sorted(solidnoise.presets(kind).items(), key=lambda preset: preset[0] not in ("cumulus", "rust"))


@functools.lru_cache(maxsize=None)
def preset(kind: str, name: str) -> dict:
    """A preset with all of its values, as the library completes it."""
    if kind == MODIFY:
        return _MODIFICATIONS[name]
    recipe = solidnoise.preset(name, kind)
    if kind == BAKE:
        return recipe
    completed = solidnoise.describe(recipe, dim=1)["recipe"]  # to plan few voxels takes no time
    completed["domain"]["dim"] = recipe.get("domain", recipe).get("dim", _DIM)
    return completed


def finer(recipe, factor: float):
    """The same with all of its noises so many times finer."""
    if factor == 1.0:
        return recipe
    if isinstance(recipe, list):
        return [finer(item, factor) for item in recipe]
    if not isinstance(recipe, dict):
        return recipe
    result = {key: finer(value, factor) for key, value in recipe.items()}
    if "type" in result and "frequency" in result:
        result["frequency"] = float(f"{result['frequency'] * factor:.7g}")
    return result


def of_object(obj) -> dict:
    """The one that it keeps. Raises Refused where that was changed to what is none."""
    try:
        recipe = json.loads(obj[RECIPE])
    except (TypeError, ValueError):
        recipe = None
    if not isinstance(recipe, dict):
        raise Refused(f"its custom property {RECIPE} is no recipe any more, an object in JSON")
    return recipe


def digest(recipe: dict) -> str:
    """The same for the same values, of this version of the library."""
    text = json.dumps([solidnoise.algorithm, recipe], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def words(recipe: dict) -> list[str]:
    """What a recipe is, in short lines."""
    noise = recipe.get("noise") or recipe.get("surface") or {}
    kind = noise.get("type") or noise.get("noise")
    grids = [grid["name"] for grid in recipe.get("grids", []) if "name" in grid]
    octaves = noise.get("octaves", 1)
    lines = [recipe.get("description", ""), f"{kind}, {octaves} {'octave' if octaves == 1 else 'octaves'}" if kind else "",
             f"Grids: {', '.join(grids)}" if grids else ""]
    return [part for line in lines for part in textwrap.wrap(line, WIDTH)]
