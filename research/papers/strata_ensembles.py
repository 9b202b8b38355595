"""Moments, tails and spectra of the library's noises over many seeds."""

import math
import pathlib

import numpy as np
import solidnoise

from papers.data import columns, mean_of
from papers.gabor import a_of
from papers.strata import Cumulants, Overlap, beyond, library

BATCHES, SEEDS = 20, 400
MOMENTS = [name + error for name in ("mean", "variance", "kurtosis", "beyond_3", "beyond_4") for error in ("", "_error")]
EXEMPLAR = pathlib.Path(__file__).parents[2] / "examples/exemplars/moss.jpg"


def measure_moments(values_of, seeds=SEEDS):
    """Mean, variance, excess kurtosis and shares beyond 3 and 4 of the values of many seeds; and their errors."""
    batches = []
    for batch in range(BATCHES):
        values = np.stack([values_of(seed) for seed in range(batch, seeds, BATCHES)]).astype(float)
        central = values - values.mean()
        batches.append([values.mean(), values.var(), np.mean(central**4) / values.var() ** 2 - 3,
                        np.mean(np.abs(values) > 3), np.mean(np.abs(values) > 4)])
    return mean_of(batches)


def measure_ensemble(n, kind, poisson, seeds=SEEDS, octaves=1):
    """At 4096 places of each seed, 1.1 radii apart."""
    step = 1.1 * library(n, kind).description["kernel"]["radius"]
    side = round(4096 ** (1 / n))
    return measure_moments(lambda seed: library(n, kind, seed, poisson, octaves=octaves).lattice(0, step, [side] * n), seeds)


def ensembles():
    rows = []
    for n in range(1, 5):
        for kind in (0, 1):
            for poisson in (False, True):
                noise = library(n, kind, poisson=poisson)
                about = noise.description
                side, tails = math.nan, (math.nan, math.nan)
                if not poisson:  # whose cumulants are too large for a series
                    cubes = Overlap(n, kind).cubes(about["impulse_density"])
                    side, cumulants = cubes[0], Cumulants(n, kind)(*cubes)
                    tails = [beyond(limit, *cumulants) for limit in (3, 4)]
                found = np.ravel(np.transpose(measure_ensemble(n, kind, poisson)))
                rows.append([n, kind, poisson, about["impulses_per_kernel"], side * a_of(1.0), noise.excess_kurtosis, *tails, *found])
    return {"strata_ensembles": columns(["n", "kind", "poisson", "impulses", "side", "closed", "closed_3", "closed_4", *MOMENTS], rows)}


def on_plane(random, step):
    """64 by 64 places of a plane in any direction, and its normals."""
    axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
    places = np.stack(np.meshgrid(*[np.arange(64) * step] * 2), -1).reshape(-1, 2)
    return random.uniform(-50, 50, 3) + places @ axes[:2], np.broadcast_to(axes[2], (4096, 3))


def surface_values(seed, kind, varies):
    """On a plane, of frequencies 1, or from 1 to 2."""
    random = np.random.default_rng(seed)
    points, normals = on_plane(random, 1.1 * library(3, 0).description["kernel"]["radius"])
    frequency = np.exp2(random.uniform(0, 1, len(points))) if varies else 1.0
    directions = random.normal(size=points.shape) if kind == "oriented" else None
    return solidnoise.surface_noise(points, normals, noise=kind, seed=seed, frequency=frequency, directions=directions)


def measure_elsewhere(name, seeds=SEEDS):
    """Of noise on surfaces by its name, or by example in 2 or 3 dimensions, or of octaves."""
    kind, _, form = name.partition(", ")
    if kind == "four octaves":
        return measure_ensemble(int(form[0]), int(form.endswith("random directions")), False, seeds, octaves=4)
    if kind != "by example":
        return measure_moments(lambda seed: surface_values(seed, kind, form == "varying"), seeds)
    n = int(form[0])
    model = solidnoise.fit(EXEMPLAR, grey=True, solid=n == 3)
    # At 8 waves a unit, the default, no kernel reaches from one place to the next.
    return measure_moments(lambda seed: solidnoise.spectrum(exemplar=model, dims=n, seed=seed).lattice(0, 45.0, [round(4096 ** (1 / n))] * n), seeds)


ELSEWHERE = ("surface, constant", "surface, varying", "oriented, constant", "oriented, varying", "solid, constant", "solid, varying", "by example, 2D", "by example, 3D",
             *[f"four octaves, {n}D {kind}" for n in (2, 3, 4) for kind in ("isotropic kernels", "random directions")])


def elsewhere():
    rows = [np.ravel(np.transpose(measure_elsewhere(name))) for name in ELSEWHERE]
    return {"strata_elsewhere": {"names": ELSEWHERE, **columns(MOMENTS, rows)}}


def powers(n, kind, poisson, seeds):
    """Power of windowed lattices of many seeds, in bands of a quarter of F0 from 1/4 to 2."""
    count = {1: 4096, 2: 128, 3: 40}[n]
    window = 1.0
    for axis in range(n):
        window = np.multiply.outer(window, np.hanning(count))
    frequency = np.sqrt(sum(f**2 for f in np.meshgrid(*[np.fft.fftfreq(count, 0.2)] * n, indexing="ij")))
    band = np.minimum(frequency / 0.25, 9).astype(int)
    sums = []
    for seed in seeds:
        power = np.abs(np.fft.fftn(window * library(n, kind, seed, poisson).lattice(0, 0.2, [count] * n))) ** 2
        sums.append(np.bincount(band.ravel(), power.ravel(), 10)[1:8])
    return np.mean(sums, 0)


def measure_spectra(n, kind, seeds=SEEDS):
    """The strata's power in bands over that of a Poisson process of as many impulses."""
    (strata, error), (poisson, its_error) = (mean_of([powers(n, kind, process, range(batch, seeds, BATCHES)) for batch in range(BATCHES)]) for process in (False, True))
    return strata / poisson, np.hypot(error / strata, its_error / poisson)


def spectra():
    rows = [[n, kind, *np.ravel(np.transpose(measure_spectra(n, kind)))] for n in (1, 2, 3) for kind in (0, 1)]
    return {"strata_spectra": columns(["n", "kind", *[f"band_{band}{error}" for band in range(1, 8) for error in ("", "_error")]], rows)}
