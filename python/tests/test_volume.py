"""Volumes: the values are those of vdbnoise, bit for bit; files, arrays, parts, measurements, slices."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import solidnoise

PROJECT = Path(__file__).resolve().parents[2]
Tool = Callable[..., str]
RECIPES: list[tuple[str, dict[str, Any]]] = [
    ("raw", {"noise": {"frequency": 3, "seed": 5}, "dim": 48}),
    ("cumulus", {"dim": 40}),
    ("fire", {"domain": {"dim": 40}}),
    ("velocity", {"dim": 24}),
    ("marble", {"domain": {"dim": 32}}),
]



@pytest.mark.parametrize("name, keys", RECIPES, ids=[name for name, _ in RECIPES])
def test_values_are_those_of_vdbnoise(name: str, keys: dict[str, Any], tool: Tool, tmp_path: Path) -> None:
    made = solidnoise.make_volume(solidnoise.preset(name), **keys)
    (tmp_path / "made.json").write_text(json.dumps(made.recipe))
    tool("vdbnoise", "--recipe", "made.json", "--out", "tool.vdb")
    by_tool = solidnoise.read_volume(tmp_path / "tool.vdb")
    assert list(made.grids) == list(by_tool.grids)
    for grid in made.grids.values():
        other = by_tool.grids[grid.name]
        assert (grid.bounds, grid.voxel_size, grid.origin, grid.active_voxels) == (
            other.bounds, other.voxel_size, other.origin, other.active_voxels)
        assert (grid.value_type, grid.grid_class) == (other.value_type, other.grid_class)
        np.testing.assert_array_equal(grid.to_numpy(), other.to_numpy())
    assert by_tool.recipe == made.recipe


@pytest.mark.parametrize("dim", [32, 96])
def test_a_raw_volume_is_the_noise_on_its_lattice(dim: int) -> None:
    recipe = {"noise": {"type": "gabor", "frequency": 3, "seed": 5}, "exact": True, "dim": dim}
    grid = solidnoise.make_volume(recipe).grids["density"]
    noise = solidnoise.Noise(recipe["noise"])  # type: ignore[arg-type]
    assert grid.bounds is not None
    lower, upper = grid.bounds
    shape = [b - a + 1 for a, b in zip(lower, upper)]
    np.testing.assert_array_equal(noise.lattice(0, grid.voxel_size, shape, first=lower), grid.to_numpy())
    # And as they are interpolated by default.
    quick = solidnoise.make_volume(recipe, exact=False).to_numpy()
    np.testing.assert_array_equal(noise.lattice(0, grid.voxel_size, shape, first=lower, interpolate=True), quick)


def test_files_hold_what_was_made(tmp_path: Path) -> None:
    path = tmp_path / "cloud.vdb"
    volume = solidnoise.make_volume(solidnoise.preset("cumulus"), dim=32)
    volume.write(path, frame=7, fps=25)
    again = solidnoise.read_volume(path)
    np.testing.assert_array_equal(again.to_numpy("density"), volume.to_numpy("density"))
    assert again.recipe == volume.recipe
    np.testing.assert_array_equal(solidnoise.make_volume(path).to_numpy(), volume.to_numpy())
    with pytest.raises(FileExistsError, match="cloud.vdb: exists already"):
        volume.write(path)
    volume.write(path, force=True)
    with pytest.raises(OSError, match="missing"):
        volume.write(tmp_path / "missing" / "cloud.vdb")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["cloud.vdb"]


def test_a_nvdb_is_nanovdb(tool: Tool, tmp_path: Path) -> None:
    volume = solidnoise.make_volume(solidnoise.preset("raw"), dim=24)
    volume.write(tmp_path / "noise.nvdb")
    assert (tmp_path / "noise.nvdb").read_bytes().startswith(b"NanoVDB")
    np.testing.assert_array_equal(solidnoise.read_volume(tmp_path / "noise.nvdb").to_numpy(), volume.to_numpy())


def test_parts_join_to_the_whole(tmp_path: Path) -> None:
    recipe = {**solidnoise.preset("smoke"), "dim": 64}
    paths = [tmp_path / f"{i}.vdb" for i in (1, 2)]
    for i, path in enumerate(paths):
        solidnoise.make_volume(recipe, shard=(i + 1, 2)).write(path)
    merged = solidnoise.merge(paths)
    np.testing.assert_array_equal(merged.to_numpy(), solidnoise.make_volume(recipe).to_numpy())
    with pytest.raises(OSError, match="parts are missing"):
        solidnoise.merge(paths[:1])


def test_arrays_have_vectors_last_and_boxes_are_cut() -> None:
    grid = solidnoise.make_volume(solidnoise.preset("velocity"), dim=16).grids["vel"]
    values = grid.to_numpy()
    assert values.shape == (16, 16, 16, 3) and values.flags.c_contiguous and grid.bounds is not None
    lower = grid.bounds[0]
    corner = (lower, (lower[0] + 1, lower[1] + 2, lower[2] + 3))
    np.testing.assert_array_equal(grid.to_numpy(corner), values[:2, :3, :4])
    outside = ((1000, 0, 0), (1001, 0, 0))
    long = solidnoise.make_volume(dim=200, box=[0.0, 0.0, 0.0, 1.0, 0.04, 0.04]).grids["density"]  # copied in slabs
    assert long.bounds is not None
    (x, y, z), upper = long.bounds
    fractions: list[float] = []
    whole = long.to_numpy(progress=fractions.append)
    assert whole.shape[0] > 190 and fractions[-1] == 1.0
    for cut in range(0, whole.shape[0], 50):
        np.testing.assert_array_equal(long.to_numpy(((x + cut, y, z), (x + cut, *upper[1:]))), whole[cut : cut + 1])
    np.testing.assert_array_equal(grid.to_numpy(outside), np.zeros((2, 1, 1, 3), np.float32))


def test_pyopenvdb_has_the_same_grid() -> None:
    pytest.importorskip("pyopenvdb")
    volume = solidnoise.make_volume(solidnoise.preset("cumulus"), dim=32)
    (grid,) = volume.to_pyopenvdb()
    assert grid.name == "density" and grid.activeVoxelCount() == volume.grids["density"].active_voxels
    array = np.zeros([b - a + 1 for a, b in zip(*volume.grids["density"].bounds)], np.float32)  # type: ignore[misc]
    grid.copyToArray(array, ijk=volume.grids["density"].bounds[0])  # type: ignore[index]
    np.testing.assert_array_equal(array, volume.to_numpy())


def test_analysis_and_description_are_those_of_vdbnoise(tool: Tool, tmp_path: Path) -> None:
    recipe: dict[str, Any] = {"noise": {"type": "gabor", "frequency": 4}, "dim": 64}
    volume = solidnoise.make_volume(recipe)
    volume.write(tmp_path / "noise.vdb")
    (tmp_path / "noise.json").write_text(json.dumps(volume.recipe))
    printed = json.loads(tool("vdbnoise", "analyze", "noise.vdb"))
    for measured in (solidnoise.analyze(volume), solidnoise.analyze(volume.grids["density"]), solidnoise.analyze(tmp_path / "noise.vdb")):
        assert measured == printed
    assert solidnoise.describe(volume.recipe) == json.loads(tool("vdbnoise", "--recipe", "noise.json", "--describe"))


def test_slices_are_those_of_the_noise(tmp_path: Path) -> None:
    recipe: dict[str, Any] = {"noise": {"type": "gabor", "frequency": 3}, "exact": True}
    picture = solidnoise.slice(recipe, origin=(1, 2, 3), width=1.5, resolution=(60, 40))
    assert picture.shape == (40, 60) and picture.dtype == np.float32
    x = 1 + (np.arange(60) + 0.5 - 30) * 0.025
    y = 2 - (np.arange(40) + 0.5 - 20) * 0.025
    points = np.stack([*np.meshgrid(x, y), np.full((40, 60), 3.0)], axis=-1)
    # Sums at points and on lattices differ in the last bits.
    np.testing.assert_allclose(picture, solidnoise.Noise(recipe["noise"])(points), atol=2e-5)
    assert solidnoise.slice(recipe, resolution=16, color=True).shape == (16, 16, 3)
    assert solidnoise.slice(recipe, resolution=16, output="curl").shape == (16, 16, 3)
    assert solidnoise.slice(recipe, resolution=16, output="curl", component="length").min() > 0.0
    fire = solidnoise.slice(solidnoise.preset("fire"), grid="temperature", resolution=24)
    assert fire.shape == (24, 24) and 0.0 < fire.max()
    volume = solidnoise.make_volume(solidnoise.preset("cumulus"), dim=24)
    volume.write(tmp_path / "cloud.vdb")
    by_file = solidnoise.slice(tmp_path / "cloud.vdb", resolution=32)
    assert by_file.max() > 0.0
    sources: list[solidnoise.Volume | solidnoise.Grid] = [volume, volume.grids["density"], solidnoise.read_volume(tmp_path / "cloud.vdb")]
    for of in sources:
        np.testing.assert_array_equal(solidnoise.slice(of, resolution=32), by_file)


@pytest.mark.parametrize("given, message", [
    ({"of": "volume", "noise": {"seed": 7}}, "noise has no effect where a grid is sliced"),
    ({"of": "grid", "grid": "density"}, "grid has no effect where a Grid is sliced"),
    ({"of": "volume", "color": True}, "color has no effect where a grid is sliced"),
    ({"of": "recipe", "component": "x"}, "component is of vectors; density has none"),
    ({"of": "recipe", "grid": "heat"}, "grid is heat; it must be one of density"),
    ({"of": "recipe", "color": True, "shaping": {"type": "cloud"}}, "color is of a noise alone"),
])
def test_slices_take_nothing_that_would_have_no_effect(given: dict[str, Any], message: str) -> None:
    volume = solidnoise.make_volume(dim=8)
    sources: dict[str, Any] = {"volume": volume, "grid": next(iter(volume.grids.values())), "recipe": None}
    with pytest.raises(ValueError, match=message):
        solidnoise.slice(sources[given.pop("of")], resolution=8, **given)


def test_pictures_of_bytes_are_written_as_they_are(tmp_path: Path) -> None:
    pixels = np.arange(256).reshape(16, 16)
    solidnoise.write_image(tmp_path / "x.png", pixels / 255.0)
    for kind, scale in (("uint8", 1), ("uint16", 257)):
        solidnoise.write_image(tmp_path / "y.png", (scale * pixels).astype(kind), force=True)
        assert (tmp_path / "y.png").read_bytes() == (tmp_path / "x.png").read_bytes()


def test_pictures_are_of_floats_or_bytes(tmp_path: Path) -> None:
    pixels = np.arange(256).reshape(16, 16)  # int64, as sums of bytes are
    calls: list[Callable[[], object]] = [lambda: solidnoise.write_image(tmp_path / "x.png", pixels), lambda: solidnoise.fit(pixels)]
    for call in calls:
        with pytest.raises(TypeError, match="must be of floats, uint8 or uint16"):
            call()


def test_pictures_are_written(tmp_path: Path) -> None:
    picture = solidnoise.make_volume(solidnoise.preset("cumulus"), dim=24).preview()
    assert picture.shape == (480, 480, 3)
    assert solidnoise.make_volume(dim=8, output="curl", shaping={"type": "raw"}).preview().shape[2] == 3
    assert 0.0 <= picture.min() < picture.max() <= 1.0
    solidnoise.write_image(tmp_path / "cloud.png", picture)
    assert (tmp_path / "cloud.png").stat().st_size > 1000
    with pytest.raises(FileExistsError):
        solidnoise.write_image(tmp_path / "cloud.png", picture)
    with pytest.raises(ValueError, match="rows"):
        solidnoise.write_image(tmp_path / "line.png", np.zeros(3))


REFUSED: list[tuple[Callable[[], object], type[Exception], str]] = [
    (lambda: solidnoise.make_volume(dim=0), ValueError, r"dim is 0; it must be between 1 and 1048576 \(voxels\)"),
    (lambda: solidnoise.make_volume({"noise": {"type": "gabor", "bandwidth": 9}}), ValueError, "noise.bandwidth is 9; it must be"),
    (lambda: solidnoise.make_volume(codek="zip"), ValueError, r"codek is unknown; did you mean codec\?"),
    (lambda: solidnoise.make_volume(dimm=8), ValueError, r"dimm is unknown; did you mean dim\?"),
    (lambda: solidnoise.make_volume(noise={"type": "spectrum"}), ValueError, "noise.exemplar is missing"),
    (lambda: solidnoise.make_volume(dim=8).write("x.foo"), ValueError, "path is x.foo; it must end in .vdb or .nvdb"),
    (lambda: solidnoise.make_volume(dim=8).write("x.vdb", fps=-1), ValueError, "fps is -1; it must be greater than 0"),
    (lambda: solidnoise.make_volume(dim=8).write("x.nvdb", frame=1), ValueError, "a .nvdb has no place for them"),
    (lambda: solidnoise.make_volume(dim=8).write(3), TypeError, "a path cannot be a int"),  # type: ignore[arg-type]
    (lambda: solidnoise.make_volume(dim=8).grids["density"].to_numpy(bounds=((-(2**31), 0, 0), (2**31 - 1, 0, 0))), ValueError, "bounds are of 4294967296 voxels"),
    (lambda: solidnoise.analyze(3), TypeError, "what is a int; it must be a Grid, a Volume or the path"),  # type: ignore[arg-type]
    (lambda: solidnoise.make_volume(dim=8).grids["density"].to_numpy("x"), TypeError, "bounds must be two tuples"),  # type: ignore[arg-type]
    (lambda: solidnoise.make_volume(dim=8).grids["density"].to_numpy(((0, 0), (1, 1))), TypeError, "bounds must be"),  # type: ignore[arg-type]
    (lambda: solidnoise.Grid.__new__(solidnoise.Grid), TypeError, "Grid cannot be made by itself"),
    (lambda: solidnoise.Volume(), TypeError, "Volume cannot be made by itself"),
    (lambda: solidnoise.write_image("x.png", [[1, 2], [3]]), ValueError, "pixels must be an array, or lists"),
    (lambda: solidnoise.slice(solidnoise.make_volume(dim=8), grid="vel"), ValueError, "grid is vel; it must be one of density"),
    (lambda: solidnoise.make_volume({"solidnoise": 9}), ValueError, "solidnoise is 9"),
    (lambda: solidnoise.make_volume("missing.json"), OSError, "missing.json: cannot be read"),
    (lambda: solidnoise.make_volume(shape={"type": "mesh", "file": "missing.ply"}, dim=8), OSError, "missing.ply"),
    (lambda: solidnoise.make_volume(shard=(3, 2), dim=8), ValueError, "shard"),
    (lambda: solidnoise.read_volume("missing.vdb"), OSError, "missing.vdb"),
    (lambda: solidnoise.merge("part.vdb"), TypeError, "paths is a str; it must be several paths"),
    (lambda: solidnoise.merge([]), (ValueError, OSError), ""),  # type: ignore[list-item]
    (lambda: solidnoise.make_volume(dim=8).to_numpy("vel"), ValueError, "grid is vel; it must be one of density"),
    (lambda: solidnoise.analyze(solidnoise.make_volume(solidnoise.preset("velocity"), dim=8)), ValueError, "vec3s"),
    (lambda: solidnoise.slice({}, width=-1), ValueError, "width is -1; it must be greater than 0"),
    (lambda: solidnoise.slice({}, resolution=0), ValueError, "resolution is 0; it must be between 1 and 16384"),
    (lambda: solidnoise.slice({}, shape={"type": "mesh", "file": "x.ply"}), ValueError, "slice the volume"),
]


@pytest.mark.parametrize("call, error, message", REFUSED)
def test_what_is_wrong_is_said(call: Callable[[], object], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message) as raised:
        call()
    assert "\n" not in str(raised.value)


def test_a_damaged_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "cloud.vdb"
    solidnoise.make_volume(solidnoise.preset("cumulus"), dim=24).write(path)
    path.write_bytes(path.read_bytes()[:2000])
    with pytest.raises(OSError, match="cloud.vdb"):
        solidnoise.read_volume(path)


@pytest.mark.parametrize("kind, program", [("volume", "vdbnoise"), ("bake", "meshnoise")])
def test_the_presets_are_those_of_the_program(kind: Any, program: str) -> None:
    files = {file.stem: json.loads(file.read_text()) for file in (PROJECT / "tools" / program / "presets").glob("*.json")}
    assert {name: solidnoise.preset(name, kind) for name in solidnoise.presets(kind)} == files
    for name in solidnoise.presets():
        assert solidnoise.preset(name) == solidnoise.preset(name, "volume" if name in solidnoise.presets("volume") else "bake")


@pytest.mark.parametrize("kind, program", [("volume", "vdbnoise"), ("bake", "meshnoise")])
def test_the_schema_is_that_of_the_program(kind: Any, program: str, tool: Tool) -> None:
    assert solidnoise.schema(kind) == json.loads(tool(program, "--schema"))


def test_a_schema_that_there_is_none_of_is_refused() -> None:
    with pytest.raises(ValueError, match="kind is mesh; it must be one of volume, bake"):
        solidnoise.schema("mesh")  # type: ignore[arg-type]


# Where smoke begins it must not step: a stair of voxels is seen as terraces. Of the faces that bound it, as many as have half of the peak
# on one side more than on the other, within it too, are under 2 %.
@pytest.mark.parametrize("name, keys", [("cumulus", {"dim": 128}), ("explosion", {"domain": {"dim": 128}})], ids=["cumulus", "explosion"])
def test_bodies_have_hardly_any_steps_from_voxel_to_voxel(name: str, keys: dict[str, Any]) -> None:
    values = solidnoise.make_volume(solidnoise.preset(name), **keys).to_numpy("density")
    faces = steps = 0
    for axis in range(3):
        beside = np.moveaxis(values, axis, 0)
        faces += np.count_nonzero((beside[1:] > 0) != (beside[:-1] > 0))
        steps += np.count_nonzero(np.abs(np.diff(beside, axis=0)) > 0.5 * values.max())
    assert 10000 < faces and steps < 0.02 * faces


# What an error is allowed for does not move impulses. One of 0.05 allows a correlation of 1 - 0.05^2 / 2 = 0.99875 with the noise itself.
@pytest.mark.parametrize("noise", [{"type": "gabor"}, {"type": "gabor-oriented"}, {"type": "gabor-oriented", "anisotropy": 1}], ids=str)
def test_a_draft_shows_the_final(noise: dict[str, Any]) -> None:
    draft, final = (solidnoise.make_volume(noise={**noise, "frequency": 5, "error": error}, dim=96).to_numpy() for error in (0.05, 0.002))
    assert np.corrcoef(draft.ravel(), final.ravel())[0, 1] > 0.9985
