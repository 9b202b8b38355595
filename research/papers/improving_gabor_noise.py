"""What the page of "Improving Gabor Noise" shows (Lagae, Lefebvre, Dutre 2011)."""

import numpy as np
import solidnoise
from scipy import optimize

from papers.data import centred, columns, image, mean_of
from papers.gabor import AMPLITUDE, ERROR, FREQUENCY, GAUSSIAN, Isotropic, Oriented, impulses_for, mean_cosine, nodes
from papers.gradients import perlin
from papers.impulses import procedure, quickest
from papers.noise_sample import compare_slices, library_noise, sample_noise, slices, tilted_plane
from papers.spectra import expected, periodogram
from papers.transition import KINDS, Hierarchy, grid_weights, measured_variance, strip, variance
from papers.truncation import truncate

DIMENSIONS = (1, 2, 3, 4)


def kernels():
    """Figures 1, 2 and 6."""
    of = {n: Isotropic(n) for n in DIMENSIONS}
    r, f = np.arange(0.25, 40.1, 0.25), np.arange(0, 0.2, 0.0005)
    space = {"r": r, "gaussian": of[2].gaussian(r)}
    space |= {f"n{n}": of[n].value(r) for n in of} | {f"e{n}": of[n].envelope(r) for n in of}
    axis = np.linspace(-1, 1, 161)
    square = np.hypot(*np.meshgrid(axis, axis))
    return {"kernels": space, "transforms": {"f": f} | {f"n{n}": of[n].spectrum(f) for n in of},
            "kernel2d_gaussian": image(of[2].gaussian(40 * square)), "kernel2d_kernel": image(of[2].value(40 * square)),
            "kernel2d_harmonic": image(mean_cosine(2, 2 * np.pi * FREQUENCY * 40 * square)),
            "kernel2d_transform": image(of[2].spectrum(0.15 * square))}


def radii():
    """Sections III-C and IV-B, in two dimensions: each radius as the rule that the paper states gives it, and what printed ones really are."""
    kernel, oriented, fraction = Isotropic(2), Oriented(2), 0.05

    def where(function, level):
        return optimize.brentq(lambda r: function(r) - level, 1, 100)

    # Phase 0: the square of its cosine is (1 + J0) / 2 on the mean over directions.
    def of_phase_0(r):
        return 0.5 * (1 + mean_cosine(2, 4 * np.pi * FREQUENCY * r)) * np.exp(-2 * np.pi * (GAUSSIAN * r) ** 2)

    def share(radius):
        (r, inner), (s, outer) = nodes(2, 0, radius), nodes(2, radius, radius + 4 / GAUSSIAN)
        return 1 / (1 + (inner @ of_phase_0(r)) / (outer @ of_phase_0(s)))

    # The paper left its amplitude out of the maximum, 2 pi K F0.
    printed = where(kernel.asymptotic_envelope, fraction / AMPLITUDE)
    return {"radii": {
        "anisotropic_envelope": np.sqrt(np.log(1 / fraction) / np.pi) / GAUSSIAN,
        "isotropic_envelope": where(kernel.asymptotic_envelope, fraction),
        "isotropic_envelope_exact": where(kernel.envelope, fraction),
        "isotropic_envelope_printed": printed,
        "printed_share_of_maximum": kernel.asymptotic_envelope(printed),
        "anisotropic_error": where(share, ERROR**2),
        "random_phase_error": oriented.radius(),
        "isotropic_error": kernel.radius(),
        "isotropic_error_printed": kernel.radius(power=0)}}


def saving(small, large):
    """Fewer impulses for a smaller radius, at the same density, in two dimensions."""
    return 1 - (small / large) ** 2


def errors():
    """Figures 11 and 12."""
    r = np.arange(0.5, 40.1, 0.25)
    table = {"r": r, "anisotropic": Oriented(2).error(r)}
    return {"errors": table | {f"n{n}": np.array([Isotropic(n).error(radius) for radius in r]) for n in DIMENSIONS}}


PAPER = {"impulses": 32, "impulses_process": "poisson", "weights": "uniform"}  # the paper's own quality
BLOCK = {"frequency": 2 * FREQUENCY}  # so that a block holds more waves


def noise(n):
    """Figures 3, 4 and 5, and the same in 4 dimensions, which the paper leaves out."""
    side, seeds = (1024, 512) if n == 1 else (256, 64)
    fields, ours = sample_noise(n, side, seeds, {})
    _, paper = sample_noise(n, side, seeds if n == 1 else 32, PAPER)
    result = {f"noise{n}d_{name}": field for name, field in fields.items()} | {f"noise{n}d": {"ours": ours, "paper": paper}}
    if n > 2:
        result[f"noise{n}d_block"] = compare_slices(n, 3, slices(n, 3, 96, 12, BLOCK), BLOCK)[2]
    return result


def truncation():
    """Figures 9 and 10."""
    result = {}
    for percent in (25, 1):
        result[f"truncation1d_{percent}"] = truncate(1, percent / 100, 16384, density=0.4)
        plane = truncate(2, percent / 100, 256)
        result[f"truncation2d_{percent}"] = {name: image(value) if np.ndim(value) else value for name, value in plane.items()}
    return result


def transition():
    """Figure 14."""
    alpha = np.linspace(0, 1, 101)
    paper, power = grid_weights("paper", 2, alpha), grid_weights("power", 2, alpha)
    rows = [[a, *np.ravel([measured_variance(kind, a, 100000, 7) for kind in KINDS])]
            for a in (0.001, 0.1, 0.2, 1 / 3, 0.5, 0.65, 0.8, 0.999)]
    return {"transition_weights": {"alpha": alpha, "paper_fine": paper[0], "paper_coarse": paper[1],
                                   "power_fine": power[0], "power_coarse": power[1]},
            "transition_variance": {"alpha": alpha, "paper": variance(paper, 2, alpha), "power": variance(power, 2, alpha)},
            "transition_measured": columns(["alpha"] + [k + e for k in KINDS for e in ("", "_error")], rows)}


def impulses():
    """Figure 13: impulses of the grids of cells of 1 and 2 units, and their weights where the kernel's radius is 1 + alpha."""
    rows = []
    for kind in ("paper", "fade"):
        for alpha in (0.0, 0.2, 0.4, 0.6, 0.8, 1.0):
            grids = Hierarchy(kind, [6, 6], 0, 1, impulses=8)
            for level in (0, 1):
                places, weights = grids.level(level)[0], grids.weights(level, min(1 + alpha, 1.9999))
                rows += [[kind == "fade", alpha, level, *place, weight]
                         for place, weight in zip(places, np.broadcast_to(weights, len(places)))]
    return {"impulses": columns(("kind", "alpha", "level", "x", "y", "weight"), rows)}


def library_strip(width, rows, seed):
    """The library's own spatially varying noise, of a plane, along which the frequency goes as in transition.strip()."""
    points = np.stack(np.broadcast_arrays(np.arange(width)[:, None], np.arange(rows)[None], 0.0), -1).reshape(-1, 3)
    frequency = np.repeat(0.5 * FREQUENCY * 2 ** (3 * np.arange(width) / (width - 1)), rows)
    return solidnoise.surface_noise(points, np.broadcast_to([0.0, 0.0, 1.0], points.shape), frequency=frequency, seed=seed).reshape(width, rows)


def varying():
    """Figure 15."""
    ours = library_strip(1024, 2048, 6)
    paper, alpha, level = strip("paper", 1024, 1024, 6)
    return {"strip_fade": image(ours[:, :192]), "strip_paper": image(paper[:, :192]),
            "strip": {"alpha": alpha, "level": level, "fade": np.sqrt(np.mean(ours.astype(float) ** 2, 1)),
                      "paper": np.sqrt(np.mean(paper**2, 1))}}


def plane():
    fields, table = tilted_plane(256, 192, 12)
    return {f"plane_{name}": np.array(rows)[::-1] for name, rows in fields.items()} | {"plane": table}


def impulses_of(n, comparison):
    """Under the isotropic and the oriented kernel, cut at an error of 2 % both: 32 under the isotropic one and as many per volume under the
    other, which is the paper's comparison; 32 under both; or those that bring the excess kurtosis of a Poisson process to 0.5."""
    isotropic, oriented = Isotropic(n), Oriented(n)
    if comparison == 0:
        return 32, 32 * (oriented.radius() / isotropic.radius()) ** n
    return (32, 32) if comparison == 1 else (np.ceil(impulses_for(isotropic, 0.5)), np.ceil(impulses_for(oriented, 0.5)))


def kernel_speed():
    """Sections III-C and IV-B: nanoseconds per value of the procedure, and of the library at 2048^2, 128^3 and 128^3 in four dimensions."""
    rows = []
    for n in (2, 3, 4):
        points = np.random.default_rng(1).uniform(0, 1000, (4000 if n == 4 else 20000, n))
        shape = [2048] * 2 if n == 2 else [128] * 3 + [1] * (n - 3)
        for comparison in range(3):
            row = [n, comparison]
            for kernel, impulses, make in zip((Isotropic(n), Oriented(n)), impulses_of(n, comparison),
                                              (solidnoise.gabor, solidnoise.gabor_oriented)):
                # The library's weights are signs, so that the same kurtosis takes fewer.
                ours = np.ceil(impulses_for(kernel, 0.5, (1, 1))) if comparison == 2 else impulses
                noise = make(dims=n, frequency=FREQUENCY, impulses=ours, impulses_process="poisson")
                row += [impulses, 1e9 * quickest(lambda: procedure(kernel, points, kernel.radius(), impulses, 1), 2) / len(points),
                        1e9 * quickest(lambda: noise.lattice(0, 1, shape, threads=1)) / np.prod(shape)]
            rows.append(row)
    names = [f"{kernel}_{what}" for kernel in ("isotropic", "anisotropic") for what in ("impulses", "procedure", "block")]
    return {"kernel_speed": columns(["n", "comparison", *names], rows)}


def compare_with_perlin(side, seeds):
    """Perlin's noise and Gabor noise whose spectra have their maxima at the same frequency: a picture of each, and spectra of 16 groups of seeds. Perlin's
    is at half a cycle per lattice unit."""
    axis = np.arange(side) * FREQUENCY / 0.5
    points = np.stack(np.meshgrid(axis, axis, indexing="ij"), -1)
    makers = {"noise": lambda seed: perlin(points, seed, chained=False), "gabor": lambda seed: library_noise(2, seed).lattice(0, 1, [side] * 2)}
    return {name: (make(0), [periodogram(make(seed) for seed in range(group, seeds, 16)) for group in range(16)]) for name, make in makers.items()}


def diagonal_over_axis(spectrum, lower, upper):
    """How much the power depends on the direction: that within 15 degrees of the diagonals over that within 15 degrees of the axes."""
    x, y = np.meshgrid(*spectrum.axes(), indexing="ij")
    length, angle = np.hypot(x, y), np.arctan2(y, x) % (np.pi / 2)
    inside, wedge = (lower <= length) & (length < upper), np.pi / 12
    axis = inside & (np.minimum(angle, np.pi / 2 - angle) < wedge)
    return spectrum.density[inside & (np.abs(angle - np.pi / 4) < wedge)].sum() / spectrum.density[axis].sum()


def perlin_comparison():
    """Figure 7."""
    result = {"perlin": {}}
    bands = {"below_peak": (0.5 * FREQUENCY, 1.3 * FREQUENCY), "above_peak": (1.3 * FREQUENCY, 2 * FREQUENCY)}
    for name, (picture, spectra) in compare_with_perlin(256, 256).items():
        density = np.mean([spectrum.density for spectrum in spectra], 0)
        result |= {f"perlin_{name}": image(picture), f"perlin_{name}_spectrum": centred(density)}
        result["perlin"][name] = {band: mean_of([diagonal_over_axis(spectrum, *limits) for spectrum in spectra]) for band, limits in bands.items()}
    model = expected(Isotropic(2).correlation, spectra[0])
    result["perlin"]["expected"] = {band: diagonal_over_axis(model, *limits) for band, limits in bands.items()}
    return result


ITEMS = {"kernels": kernels, "radii": radii, "errors": errors, "noise1d": lambda: noise(1), "noise2d": lambda: noise(2),
         "noise3d": lambda: noise(3), "noise4d": lambda: noise(4), "truncation": truncation, "transition": transition, "strip": varying,
         "plane": plane, "kernel_speed": kernel_speed, "perlin": perlin_comparison, "impulses": impulses}
