"""Isotropic Gabor noise as the library makes it: its values and spectra against the closed forms of the papers, and a plane under it."""

import numpy as np
import solidnoise

from papers.data import centred, columns, image, mean_of
from papers.gabor import FREQUENCY, GAUSSIAN, Isotropic
from papers.spectra import compare, expected, periodogram


def library_noise(n, seed=0, **options):
    return solidnoise.gabor(dims=n, **({"frequency": FREQUENCY} | options), seed=seed)


def slices(n, axes, side, seeds, options):
    """Blocks of the first axes of the noise."""
    shape = [side] * axes + [1] * (n - axes)
    return np.stack([library_noise(n, seed, **options).lattice(0, 1, shape).reshape([side] * axes) for seed in range(seeds)])


def compare_slices(n, axes, blocks, options):
    """The spectrum of slices with the closed form's. What makes the power of all frequencies scatter together are the impulses that a
    slice sees: those within about half a radius of it."""
    noise = library_noise(n, **options)
    kernel = Isotropic(n, noise.recipe["frequency"], GAUSSIAN * noise.recipe["frequency"] / FREQUENCY)
    about = noise.description
    fourth = 9 / 5 if noise.recipe["weights"] == "uniform" else 1  # E[w^4] / E[w^2]^2
    seen = about["impulse_density"] * about["kernel"]["radius"] ** (n - axes) / fourth
    measured = periodogram(blocks)
    model = expected(kernel.correlation, measured)
    return measured, model, *compare(measured, model, seen, noise.recipe["error"])


def sample_noise(n, side, seeds, options):
    """What is measured of a noise on a plane, or a line, and what the closed forms say."""
    axes = min(n, 2)
    blocks = slices(n, axes, side, seeds, options).astype(float)
    measured, model, rings, record = compare_slices(n, axes, blocks, options)
    noise = library_noise(n, **options)
    record |= {"impulses": noise.description["impulses_per_kernel"], "expected_excess_kurtosis": noise.excess_kurtosis,
               "variance": blocks.var(), "variance_error": mean_of((blocks**2).reshape(seeds, -1).mean(1))[1],
               "excess_kurtosis": np.mean((blocks - blocks.mean()) ** 4) / blocks.var() ** 2 - 3}
    density, edges = np.histogram(blocks, 80, (-5, 5))
    value = (edges[1:] + edges[:-1]) / 2
    histogram = {"value": value, "density": density / blocks.size / (10 / 80), "gaussian": np.exp(-(value**2) / 2) / np.sqrt(2 * np.pi)}
    fields = {"picture": image(blocks[0].reshape(side, -1)), "histogram": histogram, "radial": rings}
    if axes == 2:
        magnitude = np.sqrt(periodogram([blocks[0]]).density)
        fields |= {"transform": centred(np.log1p(200 * magnitude / magnitude.max()) / np.log(201)),
                   "estimated": centred(measured.density), "expected": centred(model.density)}
    return fields, record


def tilted_plane(width, rows, samples, seed=3):
    """Figure 8: a plane under noise that runs to the horizon, seen three times: a sample per pixel; the noise filtered in closed form for each
    row of pixels; and the mean of many samples per pixel, weighted by the same filter, a Gaussian of half a pixel's footprint along the view."""
    frequency, focus = 2.5, 1.2  # cycles per unit of the eye's height; distance of the picture, in its widths
    u, v = np.meshgrid(*[6 * (np.arange(samples) + 0.5) / samples - 3] * 2)
    weights = np.exp(-(u**2 + v**2) / 2)
    options = {"frequency": frequency, "error": 0.005, "impulses": 32}
    noise = library_noise(2, seed, **options)
    fields, table = {"sampled": [], "filtered": [], "averaged": []}, []
    for row in range(rows):
        below = (rows - row + 0.5) / width  # the horizon, which is just above the picture
        depth = focus / below
        across, along = depth / width / focus, depth / width / below
        line = np.stack([across * (np.arange(width) + 0.5 * (1 - width)), np.full(width, depth)], 1)
        spread = 0.5 * along * np.stack([u, v], -1)
        filtered = library_noise(2, seed, filter=0.5 * along, **options)(line)
        averaged = np.tensordot(weights, noise(line + spread[:, :, None]), 2) / weights.sum()
        for name, values in zip(fields, (noise(line), filtered, averaged)):
            fields[name].append(values)
        table.append([frequency * along] + [np.sqrt(np.mean(v.astype(float) ** 2)) for v in (noise(line), filtered, filtered - averaged)])
    return fields, columns(("cycles_per_pixel", "sampled", "filtered", "difference"), table)
