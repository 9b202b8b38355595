"""The add-on comes and goes without a trace, and says what its properties are in the library's words."""

import addon_utils
import bpy
import solidnoise
from solidnoise_blender import fields, files, sequence, settings, worker


def trace() -> tuple:
    handlers = [len(getattr(bpy.app.handlers, name)) for name in ("undo_post", "redo_post", "load_post", "save_post")]
    names = [name for name in dir(bpy.types) if "solidnoise" in name.lower()]
    return handlers, names, "solidnoise_volume" in bpy.types.Object.bl_rna.properties, dir(bpy.ops.object).count("solidnoise_volume_add")


def test_it_is_registered_and_unregistered_twice() -> None:
    there = trace()
    for _ in range(2):
        addon_utils.disable("solidnoise_blender", default_set=True)
        gone = trace()
        assert gone[1:] == ([], False, 0) and gone[0] != there[0]
        addon_utils.enable("solidnoise_blender", default_set=True)
        assert trace() == there


def test_disabled_it_stops_a_sequence_and_forgets_its_files(tmp_path) -> None:
    def work(tell) -> None:
        while True:
            tell(0.5)

    job = worker.Job("sequence", work)
    sequence._jobs.append(job)
    files.made(str(tmp_path))
    addon_utils.disable("solidnoise_blender", default_set=True)
    assert job.is_over() and not sequence._jobs and not files._made
    addon_utils.enable("solidnoise_blender", default_set=True)


def test_properties_have_the_tables_words_ranges_and_defaults() -> None:
    properties = bpy.ops.object.solidnoise_volume_add.get_rna_type().properties
    table = solidnoise.schema("volume")["$defs"]["noise"]["oneOf"][0]["properties"]
    for key in ("bandwidth", "octaves", "gain", "evolve"):
        made = properties[f"noise_{key}"]
        assert made.description == table[key]["description"]
        assert abs(made.default - table[key]["default"]) < 1e-6 and abs(made.hard_max - table[key]["maximum"]) < 1e-6 * table[key]["maximum"]
    assert {item.identifier for item in properties["noise_impulses_process"].enum_items} == {"strata", "poisson"}
    assert all(properties[name].description for name in settings.VolumeSettings.SHARED if name != "filled")


def test_all_plain_keys_of_noises_and_shapings_can_be_set() -> None:
    for alternatives, made in ((settings._noises, settings.NOISE), (settings._grid["properties"]["shaping"], settings.SHAPING)):
        keys = {key for kind in alternatives["oneOf"] for key in kind["properties"]} - {"type"}
        assert {field.path[-1] for field in made} == keys
    seed = next(field for field in settings.NOISE if field.name == "noise_seed")
    assert seed.types == frozenset(settings._words)
    assert fields.value_in({"noise": {"seed": 2**60}}, seed) == 2**31 - 1
