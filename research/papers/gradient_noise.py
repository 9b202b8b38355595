"""What the page of "Better Gradient Noise" shows (Kensler, Knoll, Shirley 2008). Lengths are in lattice units."""

import numpy as np
import solidnoise

from papers.data import columns, image
from papers.gradients import PUBLISHED, ZERO_DC, kensler, perlin, power_spectrum, radial_peak, variance, zero_dc
from papers.impulses import quickest
from papers.spectra import periodogram

# Two directions of the plane across (1, 1, 1), and its normal.
RIGHT, UP, NORMAL = np.array([1, -1, 0]) / np.sqrt(2), np.array([1, 1, -2]) / np.sqrt(6), np.ones(3) / np.sqrt(3)


def library_noise(n, kernel, seed):
    """Of lattice spacing 1."""
    coefficients = zero_dc(n) if kernel == "zero-dc" else PUBLISHED
    return solidnoise.kensler(dims=n, kernel=kernel, frequency=radial_peak(n, coefficients), seed=seed)


def sample(kind, side=1024, step=0.25, seed=1):
    """The noises of figure 1, a to f, and those of the kernel without power at frequency 0, on a plane: the library's, and the printed pseudocode's
    where lattice points are projected (of half resolution through the window of 2 units). Perlin's and c repeat after 256 units."""
    letter, kernel = kind[0], "zero-dc" if kind.endswith("zero_dc") else "kensler"
    axis = step * np.arange(side)
    if letter == "c":
        return library_noise(2, kernel, seed).lattice(0, step, [side, side])
    x, y = np.meshgrid(axis, axis, indexing="ij")
    if letter in "ab":
        return perlin(np.stack([x, y], -1), seed, chained=letter == "a")
    points = x[..., None] * RIGHT + y[..., None] * UP
    if letter == "d":
        return library_noise(3, kernel, seed)(points)
    half = {"stride": 2, "window": 2.0} if letter == "f" else {}
    coefficients = ZERO_DC if kernel == "zero-dc" else PUBLISHED
    return np.concatenate([kensler(part, seed, NORMAL, coefficients=coefficients, **half) for part in np.array_split(points, 16)])


def spectrum(kind, values, step=0.25):
    """Through no window where the plane repeats."""
    return periodogram([values], step, hann=kind[0] not in "abc")


def low_share(spectrum):
    """The frequency where the mean density over all directions is highest, and the share of the power below a quarter of it."""
    rings = spectrum.radial(0.05)
    peak = rings["f"][np.argmax(rings["density"])]
    return peak, spectrum.density[spectrum.lengths() < 0.25 * peak].sum() / spectrum.density.sum()


def striation(spectrum, axis):
    """How much neighbouring lines of the spectrum across an axis differ: the root mean square of their powers' differences over their sums, of the
    frequencies up to half a cycle per unit. 0: along x, lines of constant frequency y."""
    power = spectrum.density.sum(axis)
    n = len(power)
    power = power[1:min(int(0.5 * n * spectrum.step), n // 2) + 1]
    return np.sqrt(np.mean((np.diff(power) / (power[1:] + power[:-1])) ** 2))


def pool(density, factor):
    """The amplitude spectrum, mean squares of squares of so many frequencies, as an image with frequency 0 in the middle."""
    n = len(density) // factor
    return image(np.sqrt(np.fft.fftshift(density).reshape(n, factor, n, factor).mean((1, 3))))


KINDS = ("a", "b", "c", "d", "e", "f", "c_zero_dc", "d_zero_dc", "e_zero_dc")


def figure():
    """Figure 1, and the radial spectra of c against closed forms at unit variance."""
    f = np.arange(0.005, 2, 0.01)
    result = {"gradient": {}, "gradient_closed": {"f": f} | {
        name: power_spectrum(2, f, c) / variance(2, c) for name, c in (("kensler", PUBLISHED), ("zero_dc", ZERO_DC))}}
    for kind in KINDS:
        values = sample(kind)
        found = spectrum(kind, values)
        peak, share = low_share(found)
        result["gradient"][kind] = {"peak": peak, "low_share": share, "striation_x": striation(found, 0), "striation_y": striation(found, 1)}
        rings = found.radial(0.02)
        result |= {f"gradient_{kind}": image(values), f"gradient_{kind}_spectrum": pool(found.density, 4),
                   f"gradient_{kind}_radial": {"f": rings["f"], "density": rings["density"] / found.variance()}}
    return result


def plane_variance(stride, height, window, side=64, seeds=16):
    """Of the pseudocode, with unit gradients, on the plane z = height; the mean over seeds, as those of 256 gradients scatter by some 5 %."""
    axis = 0.36 * stride * np.arange(side)  # a step that visits all places in a cell alike
    points = np.stack(np.broadcast_arrays(axis[:, None], axis[None], float(height)), -1)
    return np.mean([kensler(points, seed, np.array([0.0, 0.0, 1.0]), stride, window) ** 2 for seed in range(seeds)])


def planes():
    """Half resolution with the window as printed, and as wide as it must be."""
    rows = [[height] + [plane_variance(stride, height, window) for stride, window in ((1, 1), (2, 1), (2, 2))]
            for height in np.arange(0, 2.1, 0.25)]
    return {"gradient_planes": columns(("height", "full", "half_printed", "half_wide"), rows)}


def costs():
    """Section 5: nanoseconds per sample of the procedures, at scattered points of three dimensions."""
    points = np.arange(100000)[:, None] * [0.131, 0.073, 0.047]
    runs = {"chained": lambda: perlin(points, 1, True), "xor_tables": lambda: perlin(points, 1, False), "wide": lambda: kensler(points, 1),
            "projected": lambda: kensler(points, 1, NORMAL), "half": lambda: kensler(points, 1, NORMAL, 2, 2.0)}
    return {"gradient_costs": {name: 1e9 * quickest(run) / len(points) for name, run in runs.items()}}


ITEMS = {"gradient": figure, "gradient_planes": planes, "gradient_costs": costs}
