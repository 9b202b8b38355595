"""Impulses in strata: the closed forms of src/solidnoise/noise/kernel/impulse_strata.h again, and the library's noises. Kernels in 1 to 4 dimensions, a wave a unit, one
octave."""

import numpy as np
import solidnoise
from scipy import optimize, special

from papers.gabor import Isotropic, Oriented, a_of, mean_cosine, nodes

KERNELS, MAKERS = (Isotropic, Oriented), (solidnoise.gabor, solidnoise.gabor_oriented)


def kernel_of(n, kind):
    """With weights of 1 or -1, where it has weights."""
    return KERNELS[kind](n, 1.0, a_of(1.0))


def mean_square(kernel, r):
    return kernel.value(r) ** 2 if isinstance(kernel, Isotropic) else kernel.mean_square(r)


def library(n, kind, seed=0, poisson=False, **options):
    """The default, or the Poisson process of as many impulses."""
    noise = MAKERS[kind](dims=n, frequency=1.0, seed=seed, **options)
    if not poisson:
        return noise
    return MAKERS[kind](dims=n, frequency=1.0, seed=seed, impulses=noise.description["impulses_per_kernel"], impulses_process="poisson", **options)


class Overlap:
    """The integral of (h * M)^2, h the uniform density of a cube: that of the cube's autocorrelation, triangles, times M's, which is radial, as is its
    transform."""

    def __init__(self, n, kind):
        self.n, self.kernel = n, kernel_of(n, kind)
        (r, weights), (f, of_f) = nodes(n, 0, 4 / self.kernel.a), nodes(n, 0, 8.0)
        waves = mean_cosine(n, 2 * np.pi * np.multiply.outer(f, r))
        transform = waves @ (weights * mean_square(self.kernel, r))
        self.r = np.linspace(0, 8, 2000)
        self.correlation = mean_cosine(n, 2 * np.pi * np.multiply.outer(self.r, f)) @ (of_f * transform**2)

    def __call__(self, side):
        x, weights = np.polynomial.legendre.leggauss(20)
        x, weights = (x + 1) / 2, weights * (1 - (x + 1) / 2)  # both halves of the triangle
        distance = side * np.sqrt(sum(axis**2 for axis in np.meshgrid(*[x] * self.n)))
        return (np.prod(np.meshgrid(*[weights] * self.n), 0) * np.interp(distance, self.r, self.correlation, right=0)).sum()

    def share(self, side):
        """The fourth cumulant over that of a Poisson process."""
        return 1 - 3 * self(side) / self.kernel.fourth

    def cubes(self, density):
        """Their side, and how many impulses each has: as near to where the fourth cumulant is 0 as whole numbers allow."""
        balanced = optimize.brentq(self.share, 0.05, 3)
        count = max(1, round(density * balanced**self.n))
        return (count / density) ** (1 / self.n), count


class Cumulants:
    """The fourth and the sixth of strata, over powers of the variance: the integrals by sums over a lattice, on which cubes are smoothed with by their transforms."""

    def __init__(self, n, kind):
        self.n, kernel = n, kernel_of(n, kind)
        self.count = {1: 2048, 2: 256, 3: 96, 4: 40}[n]
        self.step = 3 / kernel.a / self.count
        axis = (np.arange(self.count) - self.count // 2) * self.step
        square = mean_square(kernel, np.sqrt(sum(x**2 for x in np.meshgrid(*[axis] * n, indexing="ij", sparse=True))))
        # The means over phases of the fourth and sixth powers of a wave are 3/2 and 5/2 of the powers of its mean square.
        self.square, self.fourth, self.sixth = square, (1.0, 1.5)[kind] * square**2, (1.0, 2.5)[kind] * square**3

    def integral(self, values):
        return values.sum() * self.step**self.n

    def __call__(self, side, count):
        frequencies = [np.fft.fftfreq(self.count, self.step)] * (self.n - 1) + [np.fft.rfftfreq(self.count, self.step)]
        cube = np.prod(np.meshgrid(*[np.sinc(side * f) for f in frequencies], indexing="ij"), 0)
        smooth, smooth_fourth = (np.fft.irfftn(cube * np.fft.rfftn(values), values.shape) for values in (self.square, self.fourth))
        density = count / side**self.n
        fourth = density * self.integral(self.fourth - 3 * smooth**2)
        sixth = density * self.integral(self.sixth - 15 * smooth_fourth * smooth + 30 * smooth**3)
        variance = density * self.integral(self.square)
        return fourth / variance**2, sixth / variance**3


def beyond(limit, fourth, sixth):
    """The share of values beyond a limit over that of a Gaussian field, of these cumulants, by Edgeworth's series."""
    hermite = [special.hermitenorm(degree)(limit) for degree in (3, 5, 7)]
    terms = np.dot(hermite, (fourth / 24, sixth / 720, fourth**2 / 1152))
    return 1 + terms * np.exp(-0.5 * limit**2) / np.sqrt(2 * np.pi) / special.ndtr(-limit)
