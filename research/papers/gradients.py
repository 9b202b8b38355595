"""The procedures of Kensler, Knoll and Shirley 2008, in lattice units, over many points at once, and the closed form that the paper lacks."""

import itertools

import numpy as np
from scipy import optimize, special

from papers.gabor import mean_cosine, nodes

PUBLISHED, ZERO_DC = (4.0, 3.0), (3.5, 2.5)  # coefficients of t^5 and -t^4 in two dimensions


def tables(n, seed):
    """A permutation of 0 to 255 for each axis, and 256 unit gradients, half of them the opposites of the others."""
    random = np.random.default_rng(seed)
    gradients = random.normal(size=(128, n))
    gradients /= np.linalg.norm(gradients, axis=1, keepdims=True)
    return [random.permutation(256) for _ in range(n)], random.permutation(np.concatenate([gradients, -gradients]))


def gradient_at(corner, permutations, gradients, chained=False):
    """The classic chain of look-ups in one permutation, or the exclusive-or of one for each axis."""
    index = 0
    for axis, permutation in enumerate(permutations):
        coordinate = corner[..., axis]
        index = permutations[0][(index + coordinate) & 255] if chained else index ^ permutation[coordinate & 255]
    return gradients[index]


def perlin(points, seed, chained):
    """Perlin's noise with the quintic interpolant (Perlin 2002)."""
    n = points.shape[-1]
    lattice = tables(n, seed)
    cells = np.floor(points).astype(int)
    total = 0
    for step in itertools.product((0, 1), repeat=n):
        offset = points - cells - step
        t = 1 - np.abs(offset)
        total += (t**3 * (t * (6 * t - 15) + 10)).prod(-1) * (offset * gradient_at(cells + step, *lattice, chained)).sum(-1)
    return total


def kensler(points, seed, normal=None, stride=1, window=1.0, coefficients=PUBLISHED):
    """The pseudocode of section 4 as it is printed: a stencil of 4 lattice points per axis, 2 for half resolution (stride 2: even coordinates), and
    with a normal the window 3 o^2 - 2 o^3 of the distance to the plane, o = 1 - distance / window; the printed window is 1."""
    lattice = tables(3, seed)
    cells = np.floor(points / stride).astype(int) * stride
    total = np.zeros(points.shape[:-1])
    for step in itertools.product((-1, 0, 1, 2) if stride == 1 else (0, 1), repeat=3):
        corner = cells + np.array(step) * stride
        d, weight = points - corner, 1.0
        if normal is not None:
            along = d @ normal
            d = d - along[..., None] * normal
            o = np.maximum(0, 1 - np.abs(along) / window)
            weight = o * o * (3 - 2 * o)
        t = np.maximum(0, 1 - (d**2).sum(-1) / 4)
        total += weight * t**4 * (coefficients[0] * t - coefficients[1]) * (d * gradient_at(corner, *lattice)).sum(-1)
    return total


def power_spectrum(n, f, coefficients=PUBLISHED):
    """Of the wide kernel, averaged over a lattice cell: (4 pi^2 f^2 / n) psi^2, psi the transform of the potential of which s(|x|) x is the gradient,
    2 c2 / 5 t^5 - c1 / 3 t^6, t = 1 - r^2 / 4."""
    def transform(p):
        at_zero = 2**n * np.pi ** (n / 2) * special.gamma(p + 1) / special.gamma(n / 2 + p + 1)
        return at_zero * mean_cosine(n + 2 * p + 2, 4 * np.pi * f)

    c1, c2 = coefficients
    return (2 * np.pi * f * (0.4 * c2 * transform(5) - c1 / 3 * transform(6))) ** 2 / n


def variance(n, coefficients=PUBLISHED):
    f, weights = nodes(n, 0, 4)  # it falls as f^-(n + 9)
    return weights @ power_spectrum(n, f, coefficients)


def zero_dc(n):
    """The coefficients for which the potential integrates to 0."""
    ratio = 5 / (n / 2 + 6)
    return 1 / (1 - ratio), ratio / (1 - ratio)


def radial_peak(n, coefficients=PUBLISHED):
    """Where the power of all directions is largest, which the library calls the noise's frequency."""
    return optimize.minimize_scalar(lambda f: -(f ** (n - 1)) * power_spectrum(n, f, coefficients), bounds=(0.2, 1), method="bounded",
                                    options={"xatol": 1e-10}).x
