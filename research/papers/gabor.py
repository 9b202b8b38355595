"""Closed forms of the papers' Gabor kernels in 1 to 4 dimensions, which share nothing with the library. Lengths are in world units,
frequencies in cycles per unit; n is the number of dimensions."""

import numpy as np
from scipy import optimize, special

# The example of Lagae et al. 2011, sections III-C and IV-B: pixels, a bandwidth of one octave.
AMPLITUDE, FREQUENCY, GAUSSIAN = 0.709645, 0.0625, 0.0443528
ERROR = 0.02  # the library's numbers of impulses are those in the ball outside of which a kernel has this relative error


def a_of(frequency, octaves=1.0):
    """The Gaussian of a bandwidth at half amplitude."""
    return frequency * np.sqrt(np.pi / np.log(2)) * (2**octaves - 1) / (2**octaves + 1)


def sphere(n):
    return 2 * np.pi ** (n / 2) / special.gamma(n / 2)  # area of the unit sphere


def ball(n):
    return sphere(n) / n


def mean_cosine(n, z):
    """Mean of cos(z u.e) over all unit vectors u."""
    if n == 1:
        return np.cos(z)
    if n == 2:
        return special.j0(z)
    if n == 3:
        return np.sinc(z / np.pi)
    if n == 4:
        z = np.maximum(z, 1e-9)
        return 2 * special.j1(z) / z
    return special.hyp0f1(n / 2, -z * z / 4)


LEGENDRE = np.polynomial.legendre.leggauss(200)


def nodes(n, low, high):
    """Radii and weights of integrals over a shell of n-dimensional space, by Gauss and Legendre."""
    x, weights = LEGENDRE
    r = low + (high - low) * (x + 1) / 2
    return r, weights * (high - low) / 2 * sphere(n) * r ** (n - 1)


class Isotropic:
    """A Gaussian times waves of one frequency from all directions, of peak 1 (Lagae et al. 2011, eqs. 10 and 35 to 38)."""

    weights = (1 / 3, 1 / 5)  # E[w^2] and E[w^4], uniform on [-1, 1], as the papers draw them

    def __init__(self, n, frequency=FREQUENCY, a=GAUSSIAN):
        self.n, self.frequency, self.a = n, frequency, a
        r, weights = nodes(n, 0, 4 / a)
        self.energy, self.fourth = weights @ self.value(r) ** 2, weights @ self.value(r) ** 4

    def gaussian(self, r):
        return np.exp(-np.pi * (self.a * r) ** 2)

    def value(self, r):
        return self.gaussian(r) * mean_cosine(self.n, 2 * np.pi * self.frequency * r)

    def mean_square(self, r):
        return self.value(r) ** 2 * self.weights[0]

    def draw(self, uniform):
        return [2 * uniform() - 1]

    def term(self, offsets, marks):
        return marks[0] * self.value(np.sqrt((offsets**2).sum(1)))

    def spectrum(self, f):
        """Eqs. 14 and 39 to 42: mean_cosine of an imaginary number, scaled so that nothing overflows."""
        z = np.maximum(2 * np.pi * self.frequency * f / self.a**2, 1e-9)
        order = self.n / 2 - 1
        mean = special.gamma(self.n / 2) * (2 / z) ** order * special.ive(order, z)
        return self.a**-self.n * np.exp(-np.pi * ((f - self.frequency) / self.a) ** 2) * mean

    def correlation(self, r):
        """Of values of the noise r apart: on any slice of it, too."""
        f, weights = nodes(self.n, 0, self.frequency + 4 * self.a)
        return mean_cosine(self.n, 2 * np.pi * np.multiply.outer(r, f)) @ (weights * self.spectrum(f) ** 2) / self.energy

    def envelope(self, r):
        z, order = 2 * np.pi * self.frequency * r, self.n / 2 - 1
        waves = np.hypot(special.jv(order, z), special.yv(order, z))
        return self.gaussian(r) * special.gamma(self.n / 2) * (2 / z) ** order * waves

    def asymptotic_envelope(self, r):
        """Eqs. 47 to 51, with the factor 2 that 47 lacks."""
        amplitude = 1 / (sphere(self.n) * self.frequency ** (self.n - 1))
        return 2 * amplitude * (self.frequency / r) ** ((self.n - 1) / 2) * self.gaussian(r)

    def error(self, radius, power=None):
        """Relative RMS error of a noise whose kernel is cut, eq. 23 with the factor r^(n-1), or of another power, which it lacks."""
        power = self.n - 1 if power is None else power
        inner, outer = nodes(1, 0, radius), nodes(1, radius, radius + 4 / self.a)
        share = [w @ (self.value(r) ** 2 * r**power) for r, w in (inner, outer)]
        return np.sqrt(share[1] / sum(share))

    def radius(self, error=ERROR, power=None):
        return optimize.brentq(lambda r: self.error(r, power) - error, 0.01 / self.a, 3 / self.a)


def direction(u):
    """Uniform on the unit sphere, from numbers uniform on [0, 1), one less than it has dimensions."""
    if len(u) == 0:
        return np.ones(1)
    turns = [np.exp(2j * np.pi * v) for v in u]
    if len(u) == 1:
        parts = [turns[0]]
    elif len(u) == 2:
        height = 2 * u[0] - 1
        return np.stack([*(np.sqrt(1 - height**2) * [turns[1].real, turns[1].imag]), height], 1)
    else:
        parts = [np.sqrt(u[0]) * turns[1], np.sqrt(1 - u[0]) * turns[2]]
    return np.stack([axis for part in parts for axis in (part.real, part.imag)], 1)


class Oriented:
    """A Gaussian times a wave of random direction and phase (Lagae et al. 2009, eq. 1 with a phase): means over the marks."""

    weights = (1, 1)

    def __init__(self, n, frequency=FREQUENCY, a=GAUSSIAN):
        self.n, self.frequency, self.a = n, frequency, a
        self.energy, self.fourth = 0.5 * (np.sqrt(2) * a) ** -n, 3 / 8 * (2 * a) ** -n

    def mean_square(self, r):
        return np.exp(-2 * np.pi * (self.a * r) ** 2) / 2

    def draw(self, uniform):
        return [uniform() for _ in range(self.n)]

    def term(self, offsets, marks):
        waves = self.frequency * (direction(marks[1:]) * offsets).sum(1) + marks[0]
        return np.exp(-np.pi * self.a**2 * (offsets**2).sum(1)) * np.cos(2 * np.pi * waves)

    def error(self, radius):
        return np.sqrt(special.gammaincc(self.n / 2, 2 * np.pi * (self.a * radius) ** 2))

    def radius(self, error=ERROR):
        return np.sqrt(special.gammainccinv(self.n / 2, error**2) / (2 * np.pi)) / self.a


def impulses_for(kernel, kurtosis, weights=None):
    """Impulses in the ball of the kernel's radius that bring the excess kurtosis of a Poisson process to this number."""
    second, fourth = weights or kernel.weights
    return ball(kernel.n) * kernel.radius() ** kernel.n * kernel.fourth * fourth / (kurtosis * (kernel.energy * second) ** 2)
