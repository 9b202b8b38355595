"""Noise at points and on lattices: values, layouts, errors, closed forms, copies."""

import copy
import inspect
import pickle
import threading
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import solidnoise

KINDS = [
    solidnoise.gabor(frequency=4, octaves=2, seed=3),
    solidnoise.gabor_oriented(frequency=4, anisotropy=0.5, direction=(0, 1, 0), seed=3),
    solidnoise.kensler(frequency=4, seed=3),
    solidnoise.cellular(frequency=4, seed=3),
]
POINTS = np.random.default_rng(7).uniform(-3.0, 3.0, (2000, 3))


@pytest.mark.parametrize("noise", KINDS, ids=repr)
def test_points_and_lattice_have_the_same_field(noise: solidnoise.Noise) -> None:
    shape = (40, 33, 35)  # several blocks, the last ones cut
    values, gradient = noise.lattice((0.1, -2.0, 5.0), (0.03, 0.02, 0.04), shape, gradient=True)
    axes = [origin + step * np.arange(count) for origin, step, count in zip((0.1, -2.0, 5.0), (0.03, 0.02, 0.04), shape)]
    at_points, slopes = noise(np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1), gradient=True)
    assert values.shape == shape and values.flags.c_contiguous and values.dtype == np.float32
    assert gradient.shape == (*shape, 3)
    # Two ways of summing the same terms in single precision; slopes are larger by 2 pi times the frequency.
    np.testing.assert_allclose(values, at_points, atol=2e-5)
    np.testing.assert_allclose(gradient, slopes, atol=2e-3)


@pytest.mark.parametrize("noise", KINDS[:3], ids=repr)  # the last has creases
def test_gradient_is_the_derivative(noise: solidnoise.Noise) -> None:
    h = 1e-3
    _, gradient = noise(POINTS[:100], gradient=True)
    for axis in range(3):
        step = h * np.eye(3)[axis]
        slope = (noise(POINTS[:100] + step).astype(float) - noise(POINTS[:100] - step)) / (2 * h)
        # Rounding of floats of size 3 over 2 h, and the third derivative's h^2 / 6 at 8 cycles per unit.
        np.testing.assert_allclose(gradient[:, axis], slope, atol=0.2)


@pytest.mark.parametrize("dims", [1, 2, 3, 4])
def test_every_number_of_dimensions(dims: int) -> None:
    noise = solidnoise.gabor(dims=dims, frequency=3)
    values, gradient = noise(np.zeros((5, 2, dims)), gradient=True)
    assert noise.dims == dims and values.shape == (5, 2) and gradient.shape == (5, 2, dims)
    assert noise.lattice(0, 0.1, 6).shape == (6,) * dims
    assert noise.gradient_variance.shape == (dims,)
    assert noise(np.zeros(dims)).shape == ()


def test_arrays_of_every_layout_give_the_same_values() -> None:
    noise, expected = KINDS[0], KINDS[0](POINTS)
    wide = np.zeros((4000, 8))
    wide[::2, 1:7:2] = POINTS
    packed = np.zeros(2000, dtype=[("n", "u1"), ("p", "<f8", 3)])  # whose numbers are at odd addresses
    packed["p"] = POINTS
    for points in (np.asfortranarray(POINTS), POINTS[::-1][::-1], wide[::2, 1:7:2], packed["p"], POINTS.astype(">f8"), POINTS.tolist(),
                   POINTS.reshape(40, 50, 3).transpose(1, 0, 2).transpose(1, 0, 2).reshape(-1, 3)):
        np.testing.assert_array_equal(noise(points), expected)
    read_only = POINTS.copy()
    read_only.flags.writeable = False
    np.testing.assert_array_equal(noise(read_only), expected)
    single = POINTS.astype(np.float32)
    np.testing.assert_array_equal(noise(single), noise(single.astype(float)))
    np.testing.assert_array_equal(noise(single.astype(np.float16)), noise(single.astype(np.float16).astype(float)))
    assert noise(np.zeros((0, 3))).shape == (0,) and noise(np.zeros((4, 0, 3))).shape == (4, 0)


def test_whole_numbers_are_points() -> None:
    np.testing.assert_array_equal(KINDS[0](np.arange(9).reshape(3, 3)), KINDS[0](np.arange(9.0).reshape(3, 3)))


def test_out_is_written_to_and_returned() -> None:
    out = np.full((20, 20, 20), 9.0, np.float32)
    assert KINDS[0].lattice(0, 0.1, 20, out=out) is out
    np.testing.assert_array_equal(out, KINDS[0].lattice(0, 0.1, 20))
    for wrong, message in ((np.zeros((20, 20), np.float32), "out has the shape"), (np.zeros((20,) * 3, np.float32).T, "contiguous")):
        with pytest.raises(ValueError, match=message):
            KINDS[0].lattice(0, 0.1, 20, out=wrong)
    out.flags.writeable = False
    with pytest.raises(ValueError, match="cannot be written"):
        KINDS[0].lattice(0, 0.1, 20, out=out)
    with pytest.raises(TypeError, match="float32"):
        KINDS[0].lattice(0, 0.1, 20, out=np.zeros((20,) * 3))  # type: ignore[arg-type]


def test_parts_of_a_lattice_agree_to_the_last_bit() -> None:
    for interpolate in (False, True):
        whole = KINDS[0].lattice(0.3, 0.01, 60, interpolate=interpolate)
        part = KINDS[0].lattice(0.3, 0.01, (11, 20, 30), first=(40, 7, 13), interpolate=interpolate)
        np.testing.assert_array_equal(part, whole[40:51, 7:27, 13:43])


def test_interpolation_stays_within_the_error() -> None:
    noise = solidnoise.gabor(frequency=4, error=0.02)
    difference = noise.lattice(0, 0.01, 64, interpolate=True) - noise.lattice(0, 0.01, 64)
    assert 0.0 < difference.std() < 0.02  # of a standard deviation of 1


def test_threads_change_no_bit() -> None:
    many = np.tile(POINTS, (10, 1))
    for threads in (2, None):
        np.testing.assert_array_equal(KINDS[0].lattice(0, 0.01, 70, threads=threads), KINDS[0].lattice(0, 0.01, 70, threads=1))
        np.testing.assert_array_equal(KINDS[0](many, threads=threads), KINDS[0](many, threads=1))


def test_two_threads_at_once() -> None:
    expected = KINDS[0].lattice(0, 0.01, 64)
    results: list[np.ndarray] = []  # type: ignore[type-arg]
    threads = [threading.Thread(target=lambda: results.append(KINDS[0].lattice(0, 0.01, 64))) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 6
    for result in results:
        np.testing.assert_array_equal(result, expected)


def test_closed_forms() -> None:
    noise = solidnoise.gabor(dims=2, frequency=4)
    # The spectrum is known; its integral is the variance. It is smooth on the scale of this lattice, and 0 beyond.
    axis = np.linspace(-16.0, 16.0, 257)
    density = noise.power_spectrum(np.stack(np.meshgrid(axis, axis), axis=-1))
    assert density.shape == (257, 257)
    assert abs(density.sum() * (axis[1] - axis[0]) ** 2 - noise.variance) < 2e-3
    assert noise.power_spectrum([4.0, 0.0]).shape == ()
    lower, upper = noise.band
    assert 0.0 < lower < 4.0 < upper
    assert abs(noise.covariance([0.0, 0.0]) - noise.variance) < 1e-6
    assert abs(noise.excess_kurtosis) < 0.1


@pytest.mark.parametrize("dims", [3, 4])
def test_description_is_what_describe_says(dims: int) -> None:
    for noise in KINDS:
        told = solidnoise.describe({"noise": noise.recipe, "dims": dims})["noise"]
        about = solidnoise.Noise(noise.recipe, dims=dims).description
        assert about and about == {key: told[key] for key in about}


@pytest.mark.parametrize("dims", [1, 2, 3, 4])
def test_description_has_the_impulses_of_all_dimensions(dims: int) -> None:
    about = solidnoise.gabor(dims=dims, frequency=2, impulses=40, impulses_process="poisson").description
    assert abs(about["impulses_per_kernel"] - 40) < 1e-9
    # Frequencies twice as high make everything half as large.
    finer = solidnoise.gabor(dims=dims, frequency=4, impulses=40, impulses_process="poisson").description
    assert finer["impulse_density"] / about["impulse_density"] == pytest.approx(2**dims)
    assert about["kernel"]["radius"] / finer["kernel"]["radius"] == pytest.approx(2)


def test_time() -> None:
    evolving = solidnoise.gabor(frequency=4, evolve=0.5)
    assert not np.array_equal(evolving.at_time(0.0)(POINTS), evolving.at_time(1.0)(POINTS))
    four = solidnoise.gabor(dims=4, frequency=4)
    frame = four.at_time(0.25)
    assert frame.dims == 3 and frame.time == 0.25
    np.testing.assert_allclose(frame(POINTS), four(np.concatenate([POINTS, np.full((2000, 1), 0.25)], axis=1)), atol=2e-5)
    with pytest.raises(ValueError, match="time is 1"):
        solidnoise.gabor().at_time(1.0)


@pytest.mark.parametrize("noise", [*KINDS, solidnoise.gabor(dims=4).at_time(0.5), solidnoise.gabor(evolve=1, time=2)], ids=repr)
def test_noises_are_copied_pickled_and_compared(noise: solidnoise.Noise) -> None:
    pickled = [pickle.loads(pickle.dumps(noise, protocol)) for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
    for again in (*pickled, copy.copy(noise), copy.deepcopy(noise), eval(repr(noise))):
        assert again == noise and hash(again) == hash(noise) and repr(again) == repr(noise)
        np.testing.assert_array_equal(again(POINTS[:9]), noise(POINTS[:9]))
    other: object = 3
    assert noise != solidnoise.gabor(seed=99) and noise != other


def test_a_noise_that_is_changed_keeps_its_dimensions_and_its_time() -> None:
    for noise in (solidnoise.gabor(dims=2), solidnoise.gabor(evolve=1, time=0.5), solidnoise.gabor(dims=4).at_time(0.5)):
        changed = solidnoise.Noise(noise, seed=8)
        assert (changed.dims, changed.time) == (noise.dims, noise.time) and solidnoise.Noise(noise) == noise
    signed = solidnoise.gabor(period=(-0.0, 0, 0, 0))
    assert signed == solidnoise.gabor() and hash(signed) == hash(solidnoise.gabor())


def test_few_points_tell_their_progress_too() -> None:
    told: list[float] = []
    solidnoise.gabor()(POINTS[:9], progress=told.append)
    assert told == [1.0]


def test_recipes_are_plain_data() -> None:
    noise = solidnoise.gabor(frequency=np.float32(4), seed=np.int64(2), period=np.array([2.0, 2.0, 2.0]), renormalize=bool(1))
    recipe = noise.recipe
    assert recipe["type"] == "gabor" and recipe["seed"] == 2 and recipe["period"] == [2.0, 2.0, 2.0, 0.0]
    assert solidnoise.Noise(recipe) == noise == solidnoise.Noise(noise)
    assert solidnoise.Noise(recipe, seed=5).recipe == {**recipe, "seed": 5}
    recipe["seed"] = 99  # a copy, not the noise's own
    assert noise.recipe["seed"] == 2


REFUSED: list[tuple[Callable[[], object], type[Exception], str]] = [
    (lambda: solidnoise.gabor(bandwidth=-1), ValueError, r"bandwidth is -1; it must be between 0.05 and 4 \(octaves\)"),
    (lambda: solidnoise.gabor(frequncy=1), ValueError, r"frequncy is unknown; did you mean frequency\?"),  # type: ignore[call-arg]
    (lambda: solidnoise.gabor(seed="x"), ValueError, "seed is \"x\"; it must be a whole number"),  # type: ignore[arg-type]
    (lambda: solidnoise.gabor(seed=-1), ValueError, "seed is -1; it must be a whole number"),
    (lambda: solidnoise.gabor(seed=2**70), ValueError, "seed is .*; it must be a whole number"),
    (lambda: solidnoise.gabor(frequency=float("nan")), ValueError, "frequency is .*; it must be"),
    (lambda: solidnoise.gabor(dims=5), ValueError, "dims is 5; it must be between 1 and 4"),
    (lambda: solidnoise.gabor(time=1), ValueError, "time is 1"),
    (lambda: solidnoise.gabor(dims=4, evolve=1), ValueError, "dims is 4; it must be 1 to 3 where the noise evolves"),
    (lambda: solidnoise.gabor(dims=2).covariance([[np.nan, 0]]), ValueError, "displacement is nan"),
    (lambda: solidnoise.gabor(dims=2).power_spectrum([[0, np.inf]]), ValueError, "frequency is inf"),
    (lambda: solidnoise.Noise("a\0.json"), ValueError, "a path must be without null bytes"),
    (lambda: solidnoise.Noise({"type": "\ud800"}), ValueError, "surrogates"),
    (lambda: solidnoise.Noise("a\udcff.json"), OSError, r"a\\xff.json: cannot be read"),
    (lambda: solidnoise.Noise({"type": "gabr"}), ValueError, "type is \"gabr\"; it must be one of gabor"),
    (lambda: solidnoise.Noise({1: 2}), TypeError, "keys must be texts"),  # type: ignore[dict-item]
    (lambda: solidnoise.Noise({"type": object()}), TypeError, "cannot hold a object"),
    (lambda: solidnoise.Noise("missing.json"), OSError, "missing.json: cannot be read: No such file"),
    (lambda: KINDS[0](np.zeros((3, 2))), ValueError, r"points has the shape \(3, 2\); it must be \(\.\.\., 3\)"),
    (lambda: KINDS[0](1.0), ValueError, r"points has the shape \(\)"),
    (lambda: KINDS[0]([[0.0, np.nan, 0.0]]), ValueError, r"points\[0\] is nan"),
    (lambda: KINDS[0]([[0.0, 0.0, 2e9]]), ValueError, r"points\[0\] is 2e\+09|points\[0\] is 2000000000"),
    (lambda: KINDS[0]("abc"), TypeError, "points must be numbers"),
    (lambda: KINDS[0](np.zeros((2, 3), complex)), TypeError, "points must be numbers"),
    (lambda: KINDS[0].lattice(0, 0, 4), ValueError, "step is 0; it must be greater than 0"),
    (lambda: KINDS[0].lattice(0, 1, 0), ValueError, "shape is 0; it must be"),
    (lambda: KINDS[0].lattice(0, 1, (4, 4)), ValueError, "shape has 2 numbers; it must have 3, or one for all axes"),
    (lambda: KINDS[0].lattice([[0, 0, 0], [1, 1, 1]], 0.1, 4), ValueError, "origin has 6 numbers; it must have 3"),  # type: ignore[list-item]
    (lambda: KINDS[0]([[0, 0, 0], [1]]), ValueError, "points must be an array, or lists that are as long as each other"),
    (lambda: solidnoise.spectrum(), ValueError, "exemplar is missing; it must be the model of an exemplar"),  # type: ignore[call-arg]
    (lambda: KINDS[0].lattice(0, 1, 2.5), ValueError, "shape is 2.5; it must be whole"),  # type: ignore[call-overload]
    (lambda: KINDS[0].lattice(0, 1, 100000), MemoryError, ""),
    (lambda: KINDS[0](POINTS, threads=0), ValueError, "threads is 0; it must be between 1 and 4096"),
    (lambda: KINDS[0](POINTS, progress=3), TypeError, "progress must be a function"),  # type: ignore[call-overload]
    (lambda: solidnoise.preset("cumulos"), ValueError, "preset is cumulos; it must be one of bark, "),
    (lambda: solidnoise.preset("rust", "volume"), ValueError, "preset is rust; it must be one of cumulus, "),
    (lambda: solidnoise.presets("mesh"), ValueError, "kind is mesh; it must be one of volume, bake"),  # type: ignore[arg-type]
]


@pytest.mark.parametrize("call, error, message", REFUSED)
def test_what_is_wrong_is_said(call: Callable[[], object], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message) as raised:
        call()
    assert "\n" not in str(raised.value)


def test_a_list_that_holds_itself_is_refused() -> None:
    endless: list[object] = []
    endless.append(endless)
    with pytest.raises(ValueError, match="nested too deeply"):
        solidnoise.Noise({"type": "gabor", "period": endless})


def test_files_name_the_line(tmp_path: Path) -> None:
    path = tmp_path / "noise.json"
    path.write_text('{"type": "gabor",\n "bandwidth": -1}\n')
    with pytest.raises(OSError, match="noise.json: line 2: bandwidth is -1"):
        solidnoise.Noise(path)


def test_help_reads_like_a_manual() -> None:
    text = inspect.getdoc(solidnoise.gabor)
    assert text is not None
    assert "frequency : float, 1e-12 to 1e+12, default 8.0\n    Principal frequency (cycles per world unit)" in text
    assert inspect.signature(solidnoise.gabor).parameters["frequency"].default == 8.0
    for name in solidnoise.__all__:
        assert inspect.getdoc(getattr(solidnoise, name))
