"""What can be set of a volume and of a bake: a few properties that matter, and all others of the library's tables. An operator has them,
and so has the object that it made, where the side panel shows them."""

import bpy
import solidnoise

from . import fields, recipes
from .recipes import BAKE, MODIFY, VOLUME

_volume = solidnoise.schema("volume")
_bake = solidnoise.schema("bake")
_grid = _volume["properties"]["grids"]["items"]
_domain = _volume["properties"]["domain"]
_noises = {"oneOf": [kind for kind in _volume["$defs"]["noise"]["oneOf"] if "exemplar" not in kind["properties"]]}
_words = [kind["properties"]["type"]["enum"][0] for kind in _noises["oneOf"]]
TYPE = fields.Field("noise_type", ("noise", "type"), {"enum": _words, "description": "Which noise it is"})
_SHAPE = fields.Field("domain_shape", ("domain", "shape", "type"),
                      {"enum": ["box", "sphere", "ellipsoid"], "description": _domain["properties"]["shape"]["description"]})

NOISE = fields.fields_of(_noises, "noise", ("noise",))
SHAPING = fields.fields_of(_grid["properties"]["shaping"], "shaping", ("grids", 0, "shaping"))
SCALE = fields.fields_of(_grid["properties"]["scale"], "scale", ("grids", 0, "scale"), {"optical_depth"})
REST = [_SHAPE, *fields.fields_of(_domain, "domain", ("domain",), {"dim", "edge"}),
        *fields.fields_of(_grid, "grid", ("grids", 0), {"prune", "half"}),
        *fields.fields_of(_volume, "volume", (), {"time", "offset", "wind", "band_limit", "exact"})]
OF_VOLUME = [TYPE, *NOISE, *SHAPING, *SCALE, *REST]

SURFACE = fields.fields_of(_bake["properties"]["surface"], "surface", ("surface",))
STEERING = [field for key in ("by", "direction") for field in fields.fields_of(_bake["properties"][key], key, (key,))]
OF_BAKE = [*SURFACE, *[field for field in fields.fields_of(_bake, "bake", ()) if field.path[0] not in
                       ("$schema", "solidnoise", "algorithm", "description", "displace", "up")], *STEERING]

OF_MODIFY = [*fields.fields_of(_volume, "modify", (), {"amount"}), TYPE, *NOISE]
FIELDS = {VOLUME: OF_VOLUME, BAKE: OF_BAKE, MODIFY: OF_MODIFY}


def named(field_list, *names):
    return [next(field for field in field_list if field.name == name) for name in names]


_items = {}  # Blender keeps no reference to what a function returns


def _presets(kind: str):
    def items(self, context):
        from . import pictures
        _items[kind] = [(name, name.capitalize(), told, pictures.icon(name, kind), place)
                        for place, (name, told) in enumerate(recipes.presets(kind))]
        return _items[kind]
    return items


def prepare(settings, kind: str) -> None:
    """Takes over the values of a preset that was chosen; what a caller has set before stays."""
    settings = getattr(settings, "properties", settings)  # of an operator
    if settings.filled == settings.preset:
        return
    is_first, settings.filled = not settings.filled, settings.preset
    fields.fill(settings, FIELDS[kind], recipes.preset(kind, settings.preset), keeps_set=is_first)


def _preset(kind: str):
    return bpy.props.EnumProperty(name="Preset", description="What to start from", items=_presets(kind), options={"SKIP_SAVE"},
                                  update=lambda self, context: prepare(self, kind))


def shared(kind: str, field_list) -> dict:
    return {"preset": _preset(kind),
            "filled": bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"}),
            "advanced": bpy.props.BoolProperty(name="Advanced", description="All options", options={"SKIP_SAVE"}),
            **fields.annotations(field_list)}


def with_keys_of_its_noise(recipe: dict) -> dict:
    """Without those that noises of another type have."""
    allowed = next(kind["properties"] for kind in _noises["oneOf"] if kind["properties"]["type"]["enum"][0] == recipe["noise"]["type"])
    return {**recipe, "noise": {key: value for key, value in recipe["noise"].items() if key in allowed}}


class VolumeSettings:
    __annotations__ = {
        **shared(VOLUME, OF_VOLUME),
        "detail": bpy.props.FloatProperty(name="Detail", description="How many times finer all noises are than the preset's", default=1.0,
                                          min=0.01, max=100.0, soft_min=0.25, soft_max=4.0, options={"SKIP_SAVE"})}

    SHARED = tuple(__annotations__)

    def recipe(self) -> dict:
        prepare(self, VOLUME)
        return recipes.finer(with_keys_of_its_noise(fields.applied(self, OF_VOLUME, recipes.preset(VOLUME, self.preset))), self.detail)

    def draw_settings(self, layout, *others) -> None:
        recipe = fields.applied(self, [TYPE], recipes.preset(VOLUME, self.preset))
        layout.use_property_split = True
        layout.prop(self, "preset")
        main = named(OF_VOLUME, "noise_seed", "domain_dim", "scale_optical_depth")
        fields.draw(layout, self, main[:1], recipe)
        for name in (*others, "detail"):
            layout.prop(self, name)
        fields.draw(layout, self, main[1:2], recipe)
        if "scale" in recipe["grids"][0]:
            fields.draw(layout, self, main[2:], recipe)
        is_open = fields.draw_fold(layout, self)
        for title, group in (("Noise", [TYPE, *NOISE]), ("Shaping", SHAPING), ("Volume", REST)) if is_open else ():
            column = layout.column()
            column.label(text=title)
            fields.draw(column, self, [field for field in group if field not in main], recipe)


class BakeSettings:
    __annotations__ = shared(BAKE, OF_BAKE)
    SHARED = tuple(__annotations__)

    def recipe(self) -> dict:
        prepare(self, BAKE)
        return fields.applied(self, OF_BAKE, recipes.preset(BAKE, self.preset))

    def draw_settings(self, layout, *others) -> None:
        recipe = recipes.preset(BAKE, self.preset)
        layout.use_property_split = True
        layout.prop(self, "preset")
        for name in others:
            layout.prop(self, name)
        main = named(OF_BAKE, "surface_seed", "surface_octaves", "bake_feature_size", "bake_detail", "bake_bias", "by_source")
        fields.draw(layout, self, main, recipe)
        if fields.draw_fold(layout, self):
            fields.draw(layout.column(), self, [field for field in OF_BAKE if field not in main], recipe)
