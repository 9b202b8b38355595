"""check_schemas.py VDBNOISE MESHNOISE SOURCE: the JSON Schemas that the programs print accept every recipe that ships and
every recipe that the programs write, and refuse what the programs refuse."""

import copy
import json
import pathlib
import subprocess
import sys

import jsonschema

vdbnoise, meshnoise, source = sys.argv[1:]
Validator = jsonschema.Draft202012Validator


def run(*command):
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)


schemas = {"volume": run(vdbnoise, "--schema"), "sky": run(vdbnoise, "sky", "--schema"), "bake": run(meshnoise, "--schema")}
for schema in schemas.values():
    Validator.check_schema(schema)
failures = []


def expect(accepted, recipe, name):
    kind = "bake" if "surface" in recipe else "sky" if "cloud" in recipe else "volume"
    error = next(Validator(schemas[kind]).iter_errors(recipe), None)
    if (error is None) != accepted:
        failures.append(f"{name}: {error.message if error else 'is accepted'}")


# What ships, and what comes of it when it is written again.
files = [file for folder in ("examples/recipes", "tools/vdbnoise/presets", "tools/vdbnoise/skies", "tools/meshnoise/presets")
         for file in sorted((pathlib.Path(source) / folder).glob("*.json"))]
recipes = {file.stem: json.loads(file.read_text()) for file in files}
for name, recipe in recipes.items():
    expect(True, recipe, name)
for file in files:
    if file.parent.parent.name != "vdbnoise":
        continue
    sky = ["sky"] if file.parent.name == "skies" else []
    expect(True, run(vdbnoise, *sky, "--recipe", str(file), "--write-recipe", "-"), f"{file.stem}, written")


def changed(name, change):
    recipe = copy.deepcopy(recipes[name])
    change(recipe)
    return recipe


# What the programs refuse.
for what, name, change in (
    ("unknown key", "smoke", lambda r: r.update(dmi=3)),
    ("unknown key of a noise", "smoke", lambda r: r["noise"].update(frequncy=3)),
    ("key of another noise", "smoke", lambda r: r["noise"].update(hash="integer")),
    ("unknown word", "smoke", lambda r: r["noise"].update(type="perlin")),
    ("below the range", "smoke", lambda r: r["noise"].update(bandwidth=-1)),
    ("at an end that is left out", "smoke", lambda r: r["noise"].update(frequency=0)),
    ("wrong type", "smoke", lambda r: r["noise"].update(octaves=2.5)),
    ("too few numbers", "smoke", lambda r: r.update(box=[0, 0, 0])),
    ("unknown key of a layer", "layered_smoke", lambda r: r["layers"][0].update(wieght=1)),
    ("no version", "smoke", lambda r: r.pop("solidnoise")),
    ("out of a range of a range", "rust", lambda r: r.update(bandwidth=[1, 9])),
    ("unknown key of a sky's cloud", "cumulus_field", lambda r: r["cloud"].update(dmi=3)),
    ("points of another kind", "cumulus_field", lambda r: r["points"].update(type="poisson")),
    ("source and attribute", "rust", lambda r: r.update(by={"source": "height", "attribute": "x"})),
):
    expect(False, changed(name, change), what)

print("\n".join(failures) or f"{len(recipes)} recipes are accepted")
sys.exit(bool(failures))
