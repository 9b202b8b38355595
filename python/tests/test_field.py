"""Fields of recipes at points and on lattices: values of volumes, channels, what needs voxels, copies."""

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import solidnoise

NOISE = {"type": "gabor", "frequency": 3.0, "octaves": 2, "seed": 4}
MASK = {"layers": [{"place": "height", "ramp": [[0.2, 1], [0.8, 0]]}, {"noise": {"type": "cellular", "frequency": 2}}], "combine": "product"}
RECIPES: dict[str, dict[str, Any]] = {
    "noise": {"noise": NOISE},
    "layers": {
        "noise": NOISE,
        "fields": {"billows": {"fold": "billow"}},
        "layers": [{"use": "billows", "weight": 0.5}, {"fold": "ridged", "warp": {"amount": 0.2}}, MASK],
    },
    "veins": {"noise": NOISE, "layers": [{"stretch": [1, 3, 1]}], "shaping": {"type": "veins"}},
    "wind": {"noise": NOISE, "wind": [1, 0, 0], "time": 2.5},
    "four": {"noise": NOISE, "dims": 4, "time": 0.25},
    "gradient": {"noise": NOISE, "output": "gradient"},
    "curl": {"noise": NOISE, "output": "curl", "drift": [0, 1, 0]},
    "color": {"noise": NOISE, "output": "color", "shaping": {"type": "raw", "range": "unit"}},
    "within": {"noise": NOISE, "within": MASK},
    "band limit": {"noise": {**NOISE, "frequency": 14.0}, "band_limit": True},
}


def voxels_of(grid: solidnoise.Grid) -> dict[str, Any]:
    """The lattice that a grid's box of active voxels is."""
    assert grid.bounds is not None and grid.origin is not None
    lower, upper = grid.bounds
    return {"origin": 0, "step": grid.voxel_size, "first": lower, "shape": tuple(b - a + 1 for a, b in zip(lower, upper))}


def scale_of(grid: solidnoise.Grid) -> np.float32:
    """What densities are multiplied by; of other grids 1."""
    return np.float32(grid.metadata.get("solidnoise:density_factor", 1.0))


@pytest.mark.parametrize("exact", [False, True])
@pytest.mark.parametrize("name", RECIPES)
def test_lattices_are_what_volumes_are_filled_with(name: str, exact: bool) -> None:
    recipe = {**RECIPES[name], "exact": exact, "dim": 40, "box": [-1, -0.5, -1, 1, 1, 0.7]}
    (grid,) = solidnoise.make_volume(recipe).grids.values()
    field = solidnoise.Field(recipe)
    values = field.lattice(**voxels_of(grid), interpolate=not exact)
    np.testing.assert_array_equal(values * scale_of(grid), grid.to_numpy())  # bit for bit
    assert values.dtype == np.float32 and np.std(values) > 0.0


@pytest.mark.parametrize("name", ["smoke", "cumulus", "fire", "explosion", "nebula", "marble", "velocity"])
def test_presets_are_what_volumes_are_filled_with(name: str) -> None:
    recipe = {**solidnoise.preset(name), "dim": 48}
    for grid_name, grid in solidnoise.make_volume(recipe).grids.items():
        field = solidnoise.Field(recipe, grid=grid_name)
        assert grid_name in field.grids
        values = field.lattice(**voxels_of(grid), interpolate=True)
        made = grid.to_numpy()
        kept = made != 0.0  # what is pruned is 0
        np.testing.assert_array_equal((values * scale_of(grid))[kept], made[kept])
        assert kept.mean() > 0.01


def test_several_outputs_follow_each_other() -> None:
    recipe = {"noise": NOISE, "output": "value,gradient", "exact": True, "dim": 24}
    volume = solidnoise.make_volume(recipe)
    field = solidnoise.Field(recipe)
    assert field.channels == 4 and field.grids == list(volume.grids) == ["density", "gradient"]
    values = field.lattice(**voxels_of(volume.grids["density"]))
    np.testing.assert_array_equal(values[..., 0], volume.to_numpy("density"))
    np.testing.assert_array_equal(values[..., 1:], volume.to_numpy("gradient"))


@pytest.mark.parametrize("name", [name for name in RECIPES if name != "band limit"])
def test_points_have_the_field_of_lattices(name: str) -> None:
    field = solidnoise.Field(RECIPES[name])
    axis = 0.05 * np.arange(16)
    on_lattice = field.lattice(0, 0.05, 16)
    at_points = field(np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1))
    assert at_points.shape == on_lattice.shape == (16, 16, 16) + ((field.channels,) if field.channels > 1 else ())
    # Two ways of summing the same terms in single precision; slopes are larger by 2 pi times the frequency.
    np.testing.assert_allclose(at_points, on_lattice, atol=2e-3 if name == "gradient" else 1e-4)


def test_a_field_of_noise_is_the_noise() -> None:
    field, noise = solidnoise.Field(noise=NOISE), solidnoise.Noise(NOISE)
    points = np.random.default_rng(7).uniform(-3.0, 3.0, (2000, 3))
    for ours, its in zip(field(points, gradient=True), noise(points, gradient=True)):
        np.testing.assert_array_equal(ours, its)
    for ours, its in zip(field.lattice(0.5, 0.02, 30, gradient=True), noise.lattice(0.5, 0.02, 30, gradient=True)):
        np.testing.assert_array_equal(ours, its)
    out = np.full((30, 30, 30), 9.0, np.float32)
    assert field.lattice(0.5, 0.02, 30, out, threads=1) is out
    np.testing.assert_array_equal(out, noise.lattice(0.5, 0.02, 30))


def test_parameters_are_from_grids(tmp_path: Path) -> None:
    paint = tmp_path / "paint.vdb"
    solidnoise.make_volume(noise={"type": "kensler", "frequency": 1}, dim=24, shaping={"type": "raw", "range": "unit"}).write(paint)
    recipe = {"noise": NOISE, "exact": True, "dim": 20, "magnitude_grid": {"file": str(paint)}, "frequency_grid": {"file": str(paint), "map": [0, 1, 2, 6]}}
    (grid,) = solidnoise.make_volume(recipe).grids.values()
    np.testing.assert_array_equal(solidnoise.Field(recipe).lattice(**voxels_of(grid)), grid.to_numpy())


def test_a_volume_has_its_field() -> None:
    volume = solidnoise.make_volume(solidnoise.preset("smoke"), dim=32)
    assert solidnoise.Field(volume) == solidnoise.Field(solidnoise.preset("smoke"), dim=32)


@pytest.mark.parametrize("field", [solidnoise.Field(RECIPES["layers"]), solidnoise.Field(solidnoise.preset("fire"), grid="flame")], ids=repr)
def test_fields_are_copied_pickled_and_compared(field: solidnoise.Field) -> None:
    points = np.random.default_rng(7).uniform(-0.5, 0.5, (9, 3))
    pickled = [pickle.loads(pickle.dumps(field, protocol)) for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
    for again in (*pickled, copy.copy(field), copy.deepcopy(field)):
        assert again == field and hash(again) == hash(field) and repr(again) == repr(field) and again.grid == field.grid
        np.testing.assert_array_equal(again(points), field(points))
    other: object = 3
    assert field != solidnoise.Field(noise=NOISE) and field != other


def test_a_field_says_what_it_is() -> None:
    assert repr(solidnoise.Field(RECIPES["layers"])) == "<solidnoise.Field density, 1 channel, of cellular, gabor>"
    assert repr(solidnoise.Field(RECIPES["curl"])) == "<solidnoise.Field vel, 3 channels, of gabor>"
    recipe = solidnoise.Field(noise=NOISE).recipe
    assert recipe["noise"]["seed"] == 4
    recipe["noise"]["seed"] = 99  # a copy, not the field's own
    assert solidnoise.Field(recipe) != solidnoise.Field(noise=NOISE)


REFUSED: list[tuple[Callable[[], object], type[Exception], str]] = [
    (lambda: solidnoise.Field(noise=NOISE, layers=[{"fold": "rigded"}]), ValueError, r"layers\[0\].fold is \"rigded\"; .*ridged"),
    (lambda: solidnoise.Field(solidnoise.preset("fire"), grid="flames"), ValueError, "grid is flames; it must be one of density, "),
    (lambda: solidnoise.Field(shape={"type": "sphere"}), ValueError, "shape is sphere; a field has no voxels: it must be box"),
    (lambda: solidnoise.Field(edge=0.1), ValueError, "edge is 0.1; a field has no voxels: it must be left out, or 0"),
    (lambda: solidnoise.Field(on={"file": "a.vdb"}), ValueError, "a field has no voxels; it does not go with a grid that exists"),
    (lambda: solidnoise.Field("missing.json"), OSError, "missing.json: cannot be read: No such file"),
    (lambda: solidnoise.Field(magnitude_grid={"file": "missing.vdb"}), OSError, "missing.vdb: cannot be read"),
    (lambda: solidnoise.Field(RECIPES["band limit"])(np.zeros((1, 3))), ValueError, "band_limit needs the size of the voxels"),
    (lambda: solidnoise.Field(RECIPES["curl"])(np.zeros((1, 3)), gradient=True), ValueError, "gradient is True; this field has none"),
    (lambda: solidnoise.Field()(np.zeros((3, 2))), ValueError, r"points has the shape \(3, 2\); it must be \(\.\.\., 3\)"),
    (lambda: solidnoise.Field().lattice(0, 0, 4), ValueError, "step is 0; it must be greater than 0"),
    (lambda: solidnoise.Field().lattice(0, 0.1, 4, out=np.zeros((4, 4, 3), np.float32)), ValueError, "out has the shape"),
]


@pytest.mark.parametrize("call, error, message", REFUSED)
def test_what_is_wrong_is_said(call: Callable[[], object], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message) as raised:
        call()
    assert "\n" not in str(raised.value)
