"""Noise whose kernel's radius changes from place to place, with the impulses of two grids at each (Lagae et al. 2011, section V), by its
definition. Between the grids of cells of 2^l and 2^(l+1), for a radius (1 + alpha) 2^l:
- paper: weights (1 - alpha) / (1 + alpha)^n and 2^n alpha / (1 + alpha)^n (eqs. 25 and 26), here of amplitudes as printed;
- power: their square roots, smoothed: a cosine and a sine;
- fade: ours. Each impulse has its turn y, a density in units of what the radius asks for, and a weight that is 0 unless 2^-n < y < 1
  (ScaleFade, src/solidnoise/noise/point/scale_fade.h)."""

import numpy as np
from scipy import integrate

from papers.gabor import FREQUENCY, GAUSSIAN, Isotropic, ball
from papers.impulses import sparse_sum

KINDS = ("paper", "power", "fade")
IMPULSES = 32


def smooth(x):
    x = np.clip(x, 0, 1)
    return x * x * (3 - 2 * x)


def fade(n, y):
    return smooth(np.minimum((y - 0.5**n) / 0.5 ** (n + 1), (1 - y) / 0.25))


def grid_weights(kind, n, alpha):
    """Of all impulses of the finer and of the coarser grid."""
    growth = (1 + alpha) ** n
    if kind == "paper":
        return (1 - alpha) / growth, 2**n * alpha / growth
    angle = np.pi / 2 * smooth(alpha)
    return np.cos(angle) / np.sqrt(growth), np.sin(angle) * np.sqrt(2**n / growth)


def variance(weights, n, alpha):
    """Of the noise with these weights, which should be 1: independent sums add up in their squares."""
    return weights[0] ** 2 * (1 + alpha) ** n + weights[1] ** 2 * (1 + alpha) ** n / 2**n


class Hierarchy:
    """Impulses of unit grids of cells 2^l, as a Poisson process in a box from -margin to side + margin, with weights of 1 or -1."""

    def __init__(self, kind, lengths, margin, seed, n=2, impulses=IMPULSES):
        self.kind, self.n, self.levels, self.lengths, self.margin = kind, n, {}, np.asarray(lengths, float), margin
        self.random = np.random.default_rng([seed, 1 + KINDS.index(kind)])
        # The noise of full density has as many impulses in the ball, weighted by fade^2 those of the two grids have.
        second = integrate.quad(lambda y: fade(n, y) ** 2, 0, 1)[0]
        fourth = integrate.quad(lambda y: fade(n, y) ** 4, 0, 1)[0]
        self.second = second if kind == "fade" else 1.0
        self.density = impulses / ball(n) * (fourth / second**2 * (1 - 0.5**n) if kind == "fade" else 1)
        self.effective = self.density / (1 - 0.5**n) * second if kind == "fade" else self.density

    def level(self, level):
        if level not in self.levels:
            lengths = self.lengths + 2 * self.margin
            count = self.random.poisson(self.density / 2.0 ** (level * self.n) * lengths.prod())
            places = self.random.uniform(0, 1, (count, self.n)) * lengths - self.margin
            self.levels[level] = places, self.random.choice((-1.0, 1.0), count), self.random.uniform(0, 1, count)
        return self.levels[level]

    def weights(self, level, radius):
        """Of the impulses of a level, without their signs."""
        finest = int(np.floor(np.log2(radius)))
        if self.kind == "fade":
            turn = (radius / 2.0**level) ** self.n * (0.5**self.n + (1 - 0.5**self.n) * self.level(level)[2])
            return fade(self.n, turn)
        return grid_weights(self.kind, self.n, radius / 2.0**finest - 1)[level - finest]

    def evaluate(self, points, radius):
        """At points with one radius; the frequency is inversely proportional to it."""
        scale = RADIUS[self.n] / radius
        kernel = Isotropic(self.n, FREQUENCY * scale, GAUSSIAN * scale)
        total = 0
        for level in np.arange(2) + int(np.floor(np.log2(radius))):
            places, signs, _ = self.level(level)
            weights = signs * self.weights(level, radius)
            used = np.flatnonzero(weights)
            weights, places = weights[used], places[used]
            total = total + sparse_sum(points, places, radius, lambda r, _, j: weights[j] * kernel.value(r))
        return total / np.sqrt(self.effective / radius**self.n * kernel.energy)


RADIUS = {n: Isotropic(n).radius() for n in (2, 3)}


def measured_variance(kind, alpha, points, seed, n=2):
    """Measured at a lattice of points half a radius apart, in 16 parts; and its standard error."""
    radius = 16 * (1 + alpha)
    side = int(np.ceil((points / 16) ** (1 / n)))
    lattice = np.stack(np.meshgrid(*[0.5 * radius * np.arange(side)] * n, indexing="ij"), -1).reshape(-1, n)
    parts = [np.mean(Hierarchy(kind, [0.5 * radius * side] * n, radius, seed + part, n).evaluate(lattice, radius) ** 2)
             for part in range(16)]
    return np.mean(parts), np.std(parts, ddof=1) / 4


def strip(kind, columns, rows, seed):
    """Noise whose frequency goes from F0 / 2 to 4 F0 from left to right in equal ratios: values[x, y], and alpha and level of each column."""
    radii = RADIUS[2] / (0.5 * 2 ** (3 * np.arange(columns) / (columns - 1)))
    noise = Hierarchy(kind, [columns, rows], radii.max(), seed)
    level = np.floor(np.log2(radii))
    values = [noise.evaluate(np.stack([np.full(rows, x), np.arange(rows)], 1), radius) for x, radius in enumerate(radii)]
    return np.array(values), radii / 2**level - 1, level
