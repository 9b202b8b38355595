"""Noise by example: the models are those of noisefit, bit for bit; edits, textures, noises of them."""

import copy
import json
import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import solidnoise

Tool = Callable[..., str]


def texture(side: int = 48) -> "np.ndarray[tuple[int, int], np.dtype[np.float64]]":
    """A grey picture of noise of one band, 0 to 1."""
    values = solidnoise.gabor(dims=2, frequency=1.0 / 8.0, bandwidth=1.5, seed=5).lattice(0, 1.0, side).astype(float)
    return np.clip(0.5 + 0.15 * values, 0.0, 1.0)


@pytest.fixture(scope="module")
def model() -> solidnoise.ExemplarModel:
    return solidnoise.fit(texture(), raw_values=True, kappa=0.02)


def test_models_are_those_of_noisefit(tool: Tool, tmp_path: Path) -> None:
    solidnoise.write_image(tmp_path / "in.png", texture())
    tool("noisefit", "in.png", "--linear-light", "--kappa", "0.02", "--out", "linear.json", "--quiet")
    linear = solidnoise.fit(tmp_path / "in.png", kappa=0.02, raw_values=False)
    assert linear.recipe == json.loads((tmp_path / "linear.json").read_text())
    # Without a word both choose, here what is stored: a Gaussian texture is lopsided in linear light.
    tool("noisefit", "in.png", "--kappa", "0.02", "--out", "out.json", "--quiet")
    by_tool = json.loads((tmp_path / "out.json").read_text())
    by_path = solidnoise.fit(tmp_path / "in.png", kappa=0.02)
    assert by_tool["exemplar"]["raw_values"] and by_path != linear
    assert by_path.recipe == by_tool
    assert solidnoise.ExemplarModel(tmp_path / "out.json") == by_path
    # The same picture as an array of bytes.
    bytes_of_picture = np.clip(np.round(texture().astype(np.float32) * 255), 0, 255).astype(np.uint8)
    assert solidnoise.fit(bytes_of_picture, kappa=0.02).recipe == by_tool
    tool("noisefit", "edit", "out.json", "--rotate", "30", "--magnitude", "0.5", "--out", "edited.json", "--quiet")
    assert by_path.rotate(30).magnitude(0.5).recipe == json.loads((tmp_path / "edited.json").read_text())


def test_lopsided_pictures_are_learnt_as_squares() -> None:
    lawn = np.clip(texture().astype(np.float64), 0.0, 1.0) ** 4
    chosen = solidnoise.fit(lawn, kappa=0.02)
    assert chosen.recipe["exemplar"]["squares"] is True
    assert chosen == solidnoise.fit(lawn, kappa=0.02, squares=True)
    assert "squares" not in solidnoise.fit(lawn, kappa=0.02, raw_values=True).recipe["exemplar"]
    # None below black, and as bright as the picture: a sixteenth of the pixels are of their own, and their mean within 5 sigma.
    made = chosen.texture((256, 256), seed=3)
    assert made.min() >= 0.0
    assert abs(made.mean() - lawn.mean()) < 5 * lawn.std() / 64
    assert "squares" not in solidnoise.fit(lawn, kappa=0.02, squares=False).recipe["exemplar"]
    assert "squares" not in solidnoise.fit(lawn - 0.1, kappa=0.02).recipe["exemplar"]  # some are below 0
    with pytest.raises(ValueError, match="squares and raw_values are given"):
        solidnoise.fit(lawn, squares=True, raw_values=True)


def test_noises_of_a_model(model: solidnoise.ExemplarModel, tmp_path: Path) -> None:
    noise = solidnoise.spectrum(dims=2, exemplar=model, frequency=model.principal_frequency)
    assert noise.lattice(0, 1.0, 32).shape == (32, 32)
    model.write(tmp_path / "model.json")
    assert solidnoise.spectrum(dims=2, exemplar=tmp_path / "model.json", frequency=model.principal_frequency) == noise
    assert solidnoise.Noise(tmp_path / "model.json", dims=2, frequency=model.principal_frequency) == noise
    assert solidnoise.spectrum(dims=2, exemplar=model.recipe, frequency=model.principal_frequency) == noise
    with pytest.raises(FileExistsError):
        model.write(tmp_path / "model.json")
    # The variance is in the model's band: most of it within an octave of 1/8 cycles per pixel.
    spectrum = np.abs(np.fft.fft2(noise.lattice(0, 1.0, 256))) ** 2
    axis = np.arange(256) / 256.0
    axis[128:] -= 1.0
    radius = np.hypot(*np.meshgrid(axis, axis))
    assert spectrum[(radius > 1 / 16) & (radius < 1 / 4)].sum() > 0.8 * spectrum.sum()


def test_recipes_of_volumes_and_meshes_take_models(tmp_path: Path) -> None:
    model = solidnoise.fit(texture(), raw_values=True, kappa=0.02, solid=True)
    model.write(tmp_path / "model.json")
    vertices = np.random.default_rng(1).normal(size=(50, 3))
    faces = [[i, i + 1, i + 2] for i in range(48)]

    def made(exemplar: object) -> list["np.ndarray[tuple[int, ...], np.dtype[np.float32]]"]:
        noise = {"type": "spectrum", "exemplar": exemplar, "frequency": 4}
        return [solidnoise.make_volume(noise=noise, dim=16).to_numpy(),
                solidnoise.slice({"noise": noise}, resolution=16),
                solidnoise.bake(vertices, faces, surface={"noise": "spectrum", "exemplar": exemplar})["noise"],
                solidnoise.surface_noise(vertices, vertices, noise="spectrum", exemplar=exemplar)]

    expected = made(model.recipe["exemplar"])
    for exemplar in (model, model.recipe, tmp_path / "model.json", str(tmp_path / "model.json")):
        for values, right in zip(made(exemplar), expected):
            assert values.std() > 0
            np.testing.assert_array_equal(values, right)
    # In the place of another, as a whole.
    recipe = {"noise": {"type": "spectrum", "exemplar": model.scale(2), "frequency": 4}, "dim": 16}
    np.testing.assert_array_equal(solidnoise.make_volume(recipe, noise={"exemplar": model}).to_numpy(), expected[0])


def test_selected_components_are_those_of_noisefit(model: solidnoise.ExemplarModel, tool: Tool, tmp_path: Path) -> None:
    model.write(tmp_path / "model.json")
    tool("noisefit", "edit", "model.json", "--select", "0.05", "0.3", "90", "60", "--out", "selected.json", "--quiet")
    chosen = model.select(0.05, 0.3, direction=90, spread=60)
    assert chosen.recipe == json.loads((tmp_path / "selected.json").read_text()) and "selected" in chosen.group_names
    assert "coarse" in model.select(0, 0.2, name="coarse").group_names
    with pytest.raises(ValueError, match="."):
        model.select(0.3, 0.05)


def test_edits_return_other_models(model: solidnoise.ExemplarModel) -> None:
    before = model.recipe
    assert model.scale(2).principal_frequency > 1.5 * model.principal_frequency
    assert model.rotate(90).rotate(-90).components == model.components
    assert model.add(0.02, 0.1, (0.2, 0.0)).components == model.components + 1
    assert "added" in model.add(0.02, 0.1, (0.2, 0.0)).group_names
    assert model.add(0.02, 0.1, (0.2, 0.0)).remove("added").components == model.components
    assert model.add(0.02, 0.1, (0.2, 0.0), group="x").rename("x", "y").group_names[-1] == "y"
    assert model.copy_from(model).components >= model.components
    assert model.translate((0.01, 0.0)) != model and model.bandwidth(2) != model
    assert model.regroup().components == model.components
    assert model.recipe == before
    refused: list[tuple[Callable[[], object], str]] = [
        (lambda: model.remove("bricks"), "group is bricks; it must be one of"),
        (lambda: model.copy_from(model, group="bricks"), "group is bricks; of the other model it must be one of"),
        (lambda: model.scale(-1), "factor|scale"),
        (lambda: model.rotate(9, channel=3), "channel is 3; it must be between 0 and 0"),
    ]
    for call, message in refused:
        with pytest.raises(ValueError, match=message):
            call()


def test_models_are_copied_pickled_and_compared(model: solidnoise.ExemplarModel) -> None:
    pickled = [pickle.loads(pickle.dumps(model, protocol)) for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
    for again in (*pickled, copy.deepcopy(model), copy.copy(model), solidnoise.ExemplarModel(model.recipe)):
        assert again == model and hash(again) == hash(model) and repr(again) == repr(model)
    assert model != model.scale(2)
    assert "components" in repr(model) and model.description


def test_textures_and_sheets(model: solidnoise.ExemplarModel) -> None:
    picture = model.texture((40, 30))
    assert picture.shape == (30, 40, 3)
    np.testing.assert_array_equal(picture[..., 0], picture[..., 1])
    assert abs(picture.mean() - texture().mean()) < 0.1
    sheet = model.sheet(texture(), title="noise")
    assert sheet.ndim == 3 and sheet.shape[2] == 3 and sheet.shape[1] > 3 * 48


REFUSED: list[tuple[Callable[[], object], type[Exception], str]] = [
    (lambda: solidnoise.fit("missing.png"), OSError, "missing.png"),
    (lambda: solidnoise.fit(np.zeros((32, 32))), ValueError, "pictures: is constant"),
    (lambda: solidnoise.fit(np.zeros((4, 4))), ValueError, "pictures"),
    (lambda: solidnoise.fit(np.zeros(9)), ValueError, "pictures must have the shape"),
    (lambda: solidnoise.fit([]), ValueError, "pictures is empty"),
    (lambda: solidnoise.fit(texture(), kapa=1), ValueError, r"kapa is unknown; did you mean kappa\?"),
    (lambda: solidnoise.fit(texture(), kappa=2), ValueError, "kappa is 2; it must be"),
    (lambda: solidnoise.ExemplarModel({"solidnoise": 1}), ValueError, "exemplar is missing"),
]


@pytest.mark.parametrize("call, error, message", REFUSED)
def test_what_is_wrong_is_said(call: Callable[[], object], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message) as raised:
        call()
    assert "\n" not in str(raised.value)
