"""Properties of Blender from the library's tables: a key of a recipe is a property with the key's default, range, unit and tooltip."""

import copy
from dataclasses import dataclass
from typing import Any, Optional

import bpy
import numpy as np

_MOST = 2**31 - 1
_TITLES = {"dim": "Voxels"}  # of keys whose names say little
_LEAST_ABOVE = 1e-6  # of what must be above a number, in a slider


@dataclass(frozen=True)
class Field:
    """A key of a recipe, at a path of keys and places in lists."""

    name: str
    path: tuple
    schema: dict
    types: Optional[frozenset] = None  # of the object it is a key of, that have it; none: all


def fields_of(schema: dict, prefix: str, path: tuple, keys=None) -> list[Field]:
    """Those of an object's keys (all, or these) that can be shown; of alternatives by type, each key once."""
    if "oneOf" not in schema:
        return [Field(f"{prefix}_{key}", (*path, key), value) for key, value in schema["properties"].items()
                if (keys is None or key in keys) and _kind(value)]
    found: dict[str, Field] = {}
    for alternative in schema["oneOf"]:
        word = alternative["properties"]["type"]["enum"][0]
        for field in fields_of(alternative, prefix, path, keys):
            if field.path[-1] != "type":
                before = found.get(field.name, field)
                found[field.name] = Field(field.name, field.path, before.schema, (before.types or frozenset()) | {word})
    return list(found.values())


def _kind(schema: dict) -> str:
    if "enum" in schema:
        return "enum"
    if "oneOf" in schema and schema["oneOf"][0].get("type") == "number":
        return "range"
    if schema.get("type") == "array":
        is_vector = schema["items"].get("type") == "number" and schema.get("minItems") == schema.get("maxItems") in (2, 3, 4)
        return "vector" if is_vector else ""
    return schema["type"] if schema.get("type") in ("number", "integer", "boolean", "string") else ""


def property_of(field: Field):
    """What a class of Blender has as its annotation."""
    schema, kind = field.schema, _kind(field.schema)
    number = schema["oneOf"][0] if kind == "range" else schema.get("items", schema)
    title = _TITLES.get(field.path[-1]) or field.path[-1].replace("_", " ").capitalize()
    told = {"name": title, "description": schema.get("description", ""), "default": _default(field), "options": {"SKIP_SAVE"}}
    if kind == "range":
        told["description"] += ". From, to; equal: the same everywhere; 0 and 0: left out"
    if kind == "enum":
        return bpy.props.EnumProperty(items=[(word, word.replace("-", " ").capitalize(), "") for word in schema["enum"]], **told)
    if kind in ("boolean", "string"):
        return {"boolean": bpy.props.BoolProperty, "string": bpy.props.StringProperty}[kind](**told)
    told["min"] = number.get("minimum", number["exclusiveMinimum"] + _LEAST_ABOVE if "exclusiveMinimum" in number else -_MOST)
    told["max"] = number.get("maximum", _MOST)
    if "default" not in schema:
        told["min"] = min(told["min"], 0)
    if kind == "integer":
        return bpy.props.IntProperty(**{**told, "min": max(told["min"], -_MOST), "max": min(told["max"], _MOST)})
    told |= {"precision": 3, "unit": "LENGTH" if schema.get("unit") == "world units" else "NONE"}
    if kind == "number":
        return bpy.props.FloatProperty(**told)
    return bpy.props.FloatVectorProperty(size=len(told["default"]), **told)


def annotations(fields: list[Field]) -> dict:
    return {field.name: property_of(field) for field in fields}


def _default(field: Field) -> Any:
    """What a property is where a recipe leaves its key out: by default, or 0 and the like."""
    schema, kind = field.schema, _kind(field.schema)
    if "default" in schema:
        return tuple(schema["default"]) if kind == "vector" else schema["default"]
    if kind == "range":
        return (0.0, 0.0)
    if kind == "vector":
        return (0.0,) * schema["minItems"]
    return {"enum": lambda: schema["enum"][0], "number": float, "integer": int, "boolean": bool, "string": str}[kind]()


def _walk(recipe: Any, path: tuple) -> Any:
    for key in path:
        if isinstance(recipe, list) and isinstance(key, int) and key < len(recipe):
            recipe = recipe[key]
        elif isinstance(recipe, dict) and key in recipe:
            recipe = recipe[key]
        else:
            return None
    return recipe


def value_in(recipe: dict, field: Field) -> Any:
    """As the property has it."""
    value = _walk(recipe, field.path)
    kind = _kind(field.schema)
    if value is None:
        return _default(field)
    if kind == "range":
        return tuple(value) if isinstance(value, list) else (value, value)
    if kind == "vector":
        return tuple(value)
    return min(value, _MOST) if kind == "integer" else value


def is_of(recipe: dict, field: Field) -> bool:
    """Whether what the recipe is made of has such a key."""
    if any(isinstance(key, int) for key in field.path) and _walk(recipe, field.path[:-1]) is None:
        return False
    return field.types is None or (_walk(recipe, field.path[:-1]) or {}).get("type") in field.types


def fill(holder, fields: list[Field], recipe: dict, keeps_set: bool) -> None:
    """Gives properties the recipe's values; those that the caller has set stay, where it is told so."""
    for field in fields:
        if not (keeps_set and holder.is_property_set(field.name)):
            setattr(holder, field.name, value_in(recipe, field))


def plain(value: Any) -> Any:
    """Single precision as people write it: 2.8, not 2.799999952316284."""
    if isinstance(value, float):
        return float(f"{value:.7g}")
    if isinstance(value, (bool, int, str)):
        return value
    return [plain(item) for item in value]


def _is_same(value: Any, before: Any) -> bool:
    """Whether a property still is what it was filled with, in single precision."""
    if isinstance(before, (str, bool, int)):
        return value == before
    return np.array_equal(np.float32(value), np.float32(before))


def applied(holder, fields: list[Field], recipe: dict) -> dict:
    """The recipe with those properties' values that differ from its own."""
    result = copy.deepcopy(recipe)
    for field in fields:
        value = getattr(holder, field.name)
        if not is_of(result, field) or _is_same(value, value_in(recipe, field)):
            continue
        target = result
        for key in field.path[:-1]:
            target = target[key] if isinstance(key, int) else target.setdefault(key, {})
        value = plain(value)
        if _kind(field.schema) == "range" and value[0] == value[1]:
            value = value[0]
        if "default" not in field.schema and _kind(field.schema) != "enum" and _is_same(getattr(holder, field.name), _default(field)):
            target.pop(field.path[-1], None)
        else:
            target[field.path[-1]] = value
    return result


def draw(layout, holder, fields: list[Field], recipe: dict) -> None:
    """The properties that the recipe has a use for."""
    for field in fields:
        if is_of(recipe, field):
            layout.prop(holder, field.name)


def draw_fold(layout, holder) -> bool:
    """What opens and closes all other options; whether it is open."""
    row = layout.row()
    row.use_property_split = False
    row.alignment = "LEFT"
    row.prop(holder, "advanced", icon="TRIA_DOWN" if holder.advanced else "TRIA_RIGHT", emboss=False)
    return holder.advanced
