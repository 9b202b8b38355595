"""What the page of "Impulses in strata" shows, of no paper: the closed forms of strata, and the library against them over many seeds."""

import numpy as np

from papers.data import columns, mean_of
from papers.gabor import a_of
from papers.impulses import sparse_sum
from papers.strata import Overlap, kernel_of, library, mean_square
from papers.strata_ensembles import BATCHES, elsewhere, ensembles, spectra


def sides():
    """By the side of the cube that one impulse has on the mean."""
    table = {"side": np.arange(0.05, 2.01, 0.05)}
    for kind, name in enumerate(("isotropic", "directions")):
        for n in range(1, 5):
            overlap = Overlap(n, kind)
            for mirrored, suffix in ((False, ""), (True, "_mirrored")):
                larger = (2 if mirrored else 1) ** (1 / n) / a_of(1.0)
                table[f"{name}{n}{suffix}"] = np.array([overlap.share(larger * side, mirrored) for side in table["side"]])
    return {"strata_sides": table}


def bands():
    """Impulses of isotropic kernels, over those of a Poisson process of excess kurtosis 1/2: of balanced cubes and of the library."""
    rows = []
    for n in (2, 3, 4):
        for octaves in (0.2, 0.3, 0.5, 1.0, 2.0):
            overlap = Overlap(n, 0, octaves)
            mirrored = n > 2
            balanced = (2 if mirrored else 1) * overlap.balanced(mirrored) ** -n
            ours = library(n, 0, bandwidth=octaves)
            poisson = overlap.kernel.fourth / (0.5 * overlap.kernel.energy**2)
            rows.append((n, octaves, balanced / poisson, ours.description["impulse_density"] / poisson, ours.excess_kurtosis))
    return {"strata_bands": columns(("n", "octaves", "balanced", "ours", "kurtosis"), rows)}


def closed_at_place(kind, density, side, place):
    """The excess kurtosis at a place between two planes of cubes, in two dimensions: (h * M)^2 summed over the planes, on a lattice."""
    kernel = kernel_of(2, kind)
    step, n = side / 48, 1024
    axis = (np.arange(n) - n // 2) * step
    square = mean_square(kernel, np.hypot(*np.meshgrid(axis, axis, indexing="ij")))
    box = np.sinc(np.fft.fftfreq(n, step) * side)
    smooth = np.fft.ifft2(np.fft.fft2(square) * np.outer(box, box)).real
    planes = (smooth**2).sum(1) * step
    cells = np.arange(-10, 11)[:, None]
    overlap = side * np.interp((place - 0.5 + cells) * side, axis, planes).sum(0)
    return (kernel.fourth - 3 * overlap) / (density * kernel.energy**2)


def fourth_moments(kind, density, side, place, random, planes=100, along=60):
    """Of noise by its definition, with impulses in cubes whose planes begin at whole multiples of the side, at places between the planes."""
    kernel, margin = kernel_of(2, kind), 5
    reach, count = np.sqrt(np.log(1e3) / np.pi) / kernel.a, round(density * side**2)
    length = int(4 * along / side)  # of the planes, in cubes
    cubes = np.indices((planes + 2 * margin, length + 2 * margin))[..., None]
    shifts = np.stack([np.zeros(len(cubes[0])), random.uniform(0, 1, len(cubes[0]))])[:, :, None, None]
    impulses = ((cubes + shifts + random.uniform(0, 1, (*cubes.shape[:-1], count))).reshape(2, -1).T - margin) * side
    marks = kernel.draw(lambda: random.uniform(0, 1, len(impulses)))
    if kind == 0:
        marks = [np.sign(marks[0])]
    points = np.empty((planes, len(place), along, 2))
    points[..., 0] = (np.arange(planes)[:, None, None] + place[:, None]) * side
    points[..., 1] = random.uniform(1, length, points.shape[:-1]) * side
    points = points.reshape(-1, 2)
    values = sparse_sum(points, impulses, reach, lambda r, i, j: kernel.term(points[i] - impulses[j], [mark[j] for mark in marks]))
    return np.mean((values**2 / (density * kernel.energy)).reshape(planes, len(place), along) ** 2, (0, 2))


def places():
    """The library's numbers of impulses, in a simulation: where its planes of cubes are it does not tell."""
    place, rows = (np.arange(12) + 0.5) / 12, []
    for kind in (0, 1):
        density = library(2, kind).description["impulse_density"]
        side = Overlap(2, kind).cubes(density)[0]
        random = np.random.default_rng(kind)
        found = mean_of([fourth_moments(kind, density, side, place, random) - 3 for _ in range(BATCHES)])
        rows += zip(np.full(12, kind), place, closed_at_place(kind, density, side, place), *found)
    return {"strata_places": columns(("kind", "place", "closed", "kurtosis", "kurtosis_error"), rows)}


def measure_windows(kind, poisson, seeds=200):
    """The variance of the mean square over square windows with sides of 1, 2, 4, ... 16 radii, cut of squares of 32, over that of a Gaussian field of the
    same covariance C, 2 integral of C(x - y)^2 over the window and the window, over its area squared."""
    noise = library(2, kind)
    radius, per_radius, across = noise.description["kernel"]["radius"], 6, 32
    squares = np.stack([library(2, kind, seed, poisson).lattice(0, radius / per_radius, [across * per_radius] * 2) for seed in range(seeds)]) ** 2.0
    result = []
    for side in (1, 2, 4, 8, 16):
        far = min(2.0, side) * radius
        d = np.linspace(-far, far, 121)
        shares = 1 - np.abs(d) / (side * radius)
        covariance = noise.covariance(np.stack(np.meshgrid(d, d, indexing="ij"), -1))
        gaussian = 2 * (covariance**2 * np.outer(shares, shares)).sum() * (d[1] - d[0]) ** 2 / (side * radius) ** 2
        windows = squares.reshape(seeds, across // side, side * per_radius, across // side, side * per_radius).mean((2, 4))
        # About the mean that is known, 1: of few windows their own would hide a part.
        spread = ((windows - 1) ** 2).mean((1, 2)) / gaussian
        result.append((side, *mean_of(spread.reshape(-1, BATCHES).mean(0))))
    return result


def windows():
    rows = [[kind, poisson, library(2, kind).description["impulses_per_kernel"], *row]
            for kind in (0, 1) for poisson in (False, True) for row in measure_windows(kind, poisson)]
    return {"strata_windows": columns(("kind", "poisson", "impulses", "side", "spread", "spread_error"), rows)}


def drafts():
    """How far noises of larger errors are from the one of error 0.002: root mean square and correlation, 16 seeds."""
    rows = []
    for n, across in zip(range(1, 5), (1024, 64, 24, 10)):
        for kind in (0, 1):
            def values(error):
                return np.stack([library(n, kind, seed, error=error).lattice(0, 0.31, [across] * n) for seed in range(16)]).astype(float)
            final = values(0.002)
            for error in (0.2, 0.1, 0.05, 0.02):
                draft = values(error)
                power = np.mean(final**2)
                rows.append([n, kind, error, np.sqrt(np.mean((draft - final) ** 2) / power),
                             np.mean(draft * final) / np.sqrt(np.mean(draft**2) * power)])
    return {"strata_drafts": columns(("n", "kind", "error", "difference", "correlation"), rows)}


ITEMS = {"strata_sides": sides, "strata_bands": bands, "strata_ensembles": ensembles, "strata_elsewhere": elsewhere, "strata_spectra": spectra,
         "strata_places": places, "strata_windows": windows, "strata_drafts": drafts}
