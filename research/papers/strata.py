"""Impulses in strata: the closed forms of src/solidnoise/noise/kernel/impulse_strata.h again, and the library's noises. Kernels in 1 to 4 dimensions, a wave a unit, one
octave."""

import itertools

import numpy as np
import solidnoise
from scipy import optimize, special

from papers.gabor import Isotropic, Oriented, a_of, mean_cosine, nodes

KERNELS, MAKERS = (Isotropic, Oriented), (solidnoise.gabor, solidnoise.gabor_oriented)


def kernel_of(n, kind, octaves=1.0):
    """With weights of 1 or -1, where it has weights."""
    return KERNELS[kind](n, 1.0, a_of(1.0, octaves))


def mean_square(kernel, r):
    return kernel.value(r) ** 2 if isinstance(kernel, Isotropic) else kernel.mean_square(r)


def library(n, kind, seed=0, poisson=False, **options):
    """The default, or the Poisson process of as many impulses."""
    noise = MAKERS[kind](dims=n, frequency=1.0, seed=seed, **options)
    if not poisson:
        return noise
    return MAKERS[kind](dims=n, frequency=1.0, seed=seed, impulses=noise.description["impulses_per_kernel"], impulses_process="poisson", **options)


class Overlap:
    """What is taken from the fourth cumulant: the integral of (h * M)^2, h the uniform density of a cube, that is of the cube's autocorrelation, triangles, times M's, which
    is radial, as is its transform; of impulses that are mirrored in pairs twice that, less the mean of M's autocorrelation over the distances of two such impulses, which
    are uniform in a cube twice as large."""

    def __init__(self, n, kind, octaves=1.0):
        self.n, self.kind, self.kernel = n, kind, kernel_of(n, kind, octaves)
        (r, weights), (f, of_f) = nodes(n, 0, 4 / self.kernel.a), nodes(n, 0, 8.0)
        waves = mean_cosine(n, 2 * np.pi * np.multiply.outer(f, r))
        transform = waves @ (weights * mean_square(self.kernel, r))
        self.r = np.linspace(0, 8, 2000)
        self.correlation = mean_cosine(n, 2 * np.pi * np.multiply.outer(self.r, f)) @ (of_f * transform**2)

    def __call__(self, side, mirrored=False):
        x, weights = np.polynomial.legendre.leggauss(20)
        x = (x + 1) / 2
        distance = side * np.sqrt(sum(axis**2 for axis in np.meshgrid(*[x] * self.n)))
        correlation = np.interp(distance, self.r, self.correlation, right=0)

        def mean(of_axis):
            return (np.prod(np.meshgrid(*[of_axis] * self.n), 0) * correlation).sum()

        independent = mean(weights * (1 - x))  # both halves of the triangle
        return 2 * independent - mean(weights / 2) if mirrored else independent

    def share(self, side, mirrored=False):
        """The fourth cumulant over that of a Poisson process."""
        return 1 - 3 * self(side, mirrored) / self.kernel.fourth

    def balanced(self, mirrored):
        """The side where the fourth cumulant is 0."""
        return optimize.brentq(self.share, 0.05, 3, args=(mirrored,))

    def cubes(self, density):
        """Their side, how many impulses each has, and whether these are mirrored, as isotropic kernels from three dimensions on, waves in four: as near to balanced as whole
        numbers allow."""
        mirrored = self.n > 2 + self.kind
        least = 2 if mirrored else 1
        count = least * max(1, round(density * self.balanced(mirrored) ** self.n / least))
        return (count / density) ** (1 / self.n), count, mirrored


class Cumulants:
    """The fourth and the sixth of strata, over powers of the variance: the integrals by sums over a lattice, on which cubes are smoothed with by their transforms, and
    mirrored places are summed over by Gauss's rule; kernels are radial, so that a part of the places does for all."""

    def __init__(self, n, kind, octaves=1.0):
        self.n, kernel = n, kernel_of(n, kind, octaves)
        self.count = {1: 2048, 2: 256, 3: 96, 4: 40}[n]
        self.step = 3 / kernel.a / self.count
        self.axis = (np.arange(self.count) - self.count // 2) * self.step
        self.r = np.linspace(0, 6 / kernel.a, 4000)
        self.of_r = mean_square(kernel, self.r)
        square = self.around(np.zeros(n))
        # The means over phases of the fourth and sixth powers of a wave are 3/2 and 5/2 of the powers of its mean square.
        self.of_fourth = (1.0, 1.5)[kind]
        self.square, self.fourth, self.sixth = square, self.of_fourth * square**2, (1.0, 2.5)[kind] * square**3

    def around(self, place):
        """The mean square of a kernel at a place, on the lattice."""
        axes = np.meshgrid(*[self.axis - at for at in place], indexing="ij", sparse=True)
        return np.interp(np.sqrt(sum(x**2 for x in axes)), self.r, self.of_r)

    def mirrored(self, side):
        """The means over places x of M(p - x) M(p + x), and with a fourth power in place of the first M."""
        x, weights = np.polynomial.legendre.leggauss(6)
        x, weights = side * (x + 1) / 4, weights / 2
        square, fourth = np.zeros_like(self.square), np.zeros_like(self.square)
        for chosen in itertools.combinations_with_replacement(range(len(x)), self.n):  # all orders are alike
            orders = len(set(itertools.permutations(chosen)))
            one, other = self.around(x[list(chosen)]), self.around(-x[list(chosen)])
            weight = orders * np.prod(weights[list(chosen)])
            square += weight * one * other
            fourth += weight * self.of_fourth * one**2 * other
        return square, fourth

    def integral(self, values):
        return values.sum() * self.step**self.n

    def __call__(self, side, count, mirrored=False):
        frequencies = [np.fft.fftfreq(self.count, self.step)] * (self.n - 1) + [np.fft.rfftfreq(self.count, self.step)]
        cube = np.prod(np.meshgrid(*[np.sinc(side * f) for f in frequencies], indexing="ij"), 0)
        smooth, smooth_fourth = (np.fft.irfftn(cube * np.fft.rfftn(values), values.shape) for values in (self.square, self.fourth))
        density = count / side**self.n
        pair, of_fourth = self.mirrored(side) if mirrored else (smooth**2, smooth_fourth * smooth)
        fourth = density * self.integral(self.fourth + 3 * pair - 6 * smooth**2)
        sixth = density * self.integral(self.sixth + 15 * of_fourth - 30 * smooth_fourth * smooth - 90 * pair * smooth + 120 * smooth**3)
        variance = density * self.integral(self.square)
        return fourth / variance**2, sixth / variance**3


def beyond(limit, fourth, sixth):
    """The share of values beyond a limit over that of a Gaussian field, of these cumulants, by Edgeworth's series."""
    hermite = [special.hermitenorm(degree)(limit) for degree in (3, 5, 7)]
    terms = np.dot(hermite, (fourth / 24, sixth / 720, fourth**2 / 1152))
    return 1 + terms * np.exp(-0.5 * limit**2) / np.sqrt(2 * np.pi) / special.ndtr(-limit)
