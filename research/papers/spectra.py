"""Periodograms, and how measured spectra compare with closed forms."""

import dataclasses
import itertools

import numpy as np
from scipy import special



@dataclasses.dataclass
class Spectrum:
    """A two-sided power density on the frequencies of a discrete Fourier transform, 0 first; with the cell of a frequency it sums up to the variance."""

    density: np.ndarray
    step: float = 1.0  # between samples
    hann: bool = True
    blocks: int = 1

    def axes(self):
        return [np.fft.fftfreq(n, self.step) for n in self.density.shape]

    def lengths(self):
        return np.sqrt(sum(f**2 for f in np.meshgrid(*self.axes(), indexing="ij")))

    def cell(self):
        return 1 / np.prod([n * self.step for n in self.density.shape])

    def variance(self):
        return self.density.sum() * self.cell()

    def bins(self, width=None):
        """The number of each frequency's ring, of 2 frequencies' width or another; -1 beyond the Nyquist frequency."""
        width = width or 2 / (min(self.density.shape) * self.step)
        lengths = self.lengths()
        return np.where(lengths < 0.5 / self.step, (lengths / width).astype(int), -1)

    def radial(self, width=None):
        """Mean frequencies and densities of rings, those without frequencies left out."""
        frequency, density = ring_means(self.bins(width), self.lengths(), self.density)
        return {"f": frequency, "density": density}


def ring_means(bins, *fields):
    inside = bins >= 0
    counts = np.bincount(bins[inside])
    return [(np.bincount(bins[inside], field[inside]) / np.maximum(counts, 1))[counts > 0] for field in fields]


def window(n):
    return np.sin(np.pi * np.arange(n) / n) ** 2


def block_window(shape, hann=True):
    return np.prod(np.meshgrid(*[window(n) if hann else np.ones(n) for n in shape], indexing="ij"), axis=0)


def periodogram(blocks, step=1.0, hann=True):
    """The mean periodogram of blocks of one size, through Hann's window or none, which is for what repeats."""
    total, count = 0.0, 0
    for block in blocks:
        weights = block_window(block.shape, hann)
        total, count = total + np.abs(np.fft.fftn(weights * block)) ** 2, count + 1
    return Spectrum(total * step**weights.ndim / (weights**2).sum() / count, step, hann, count)


def expected(correlation, like):
    """The periodogram, through the same window, that a field has on the mean whose covariance is a function of the distance."""
    n = like.density.shape
    lags = [np.arange(2 * m) for m in n]
    lags = [np.where(lag < m, lag, lag - 2 * m) for lag, m in zip(lags, n)]
    distance = np.sqrt(sum(lag.astype(float) ** 2 for lag in np.meshgrid(*lags, indexing="ij"))) * like.step
    r = np.linspace(0, distance.max() + 1e-9, 20000)  # between which values are within 1e-5
    values = np.interp(distance, r, correlation(r))
    for axis, m in enumerate(n):
        w = window(m) if like.hann else np.ones(m)
        overlap = np.fft.ifft(np.abs(np.fft.fft(w, 2 * m)) ** 2).real / (w @ w)
        values *= overlap.reshape([-1 if i == axis else 1 for i in range(len(n))])
    folded = values.reshape([size for m in n for size in (2, m)]).sum(tuple(range(0, 2 * len(n), 2)))
    return dataclasses.replace(like, density=np.maximum(0, np.fft.fftn(folded).real) * like.step ** len(n))


def compare(measured, model, impulse_density, kernel_error):
    """Rings of a measured spectrum against what expected() gives, with chi-square. Periodogram values of a Gaussian field are exponentially
    distributed, and correlate through the window; the number of impulses scatters, and with it all power; kernels that differ by a
    relative error e change a spectrum S by some e sqrt(S S_max) + e^2 S_max. Rings below 1e-4 of the highest, or with errors above
    15 %, do not count."""
    bins = measured.bins()
    f, power, mean = ring_means(bins, measured.lengths(), measured.density, model.density)
    _, number = np.unique(bins[bins >= 0], return_inverse=True)
    ring = np.full(bins.shape, -1)
    ring[bins >= 0] = number
    size, flat = len(f), model.density
    covariance = np.zeros(size * size)
    # A Hann window's spectrum at -2 to 2 frequencies is 1/6, -2/3, 1, -2/3, 1/6 of the middle; values correlate by the squares.
    hann = {0: 1.0, 1: 4 / 9, 2: 1 / 36}
    for shift in itertools.product(range(-2, 3) if measured.hann else (0,), repeat=flat.ndim):
        other = np.roll(ring, shift, range(flat.ndim))
        both = (ring >= 0) & (other >= 0)
        product = (flat * np.roll(flat, shift, range(flat.ndim)))[both] * np.prod([hann[abs(s)] for s in shift])
        covariance += np.bincount(ring[both] * size + other[both], product, size * size)
    counts = np.bincount(number)
    # The 2: values at f and -f are the same.
    covariance = 2 * covariance.reshape(size, size) / (measured.blocks * np.outer(counts, counts))
    squares = block_window(measured.density.shape, measured.hann) ** 2
    volume = measured.blocks * squares.sum() ** 2 / (squares**2).sum() * measured.step**flat.ndim
    covariance += np.outer(mean, mean) / (impulse_density * volume)
    tolerance = kernel_error * np.sqrt(mean * mean.max()) + kernel_error**2 * mean.max()
    covariance += np.diag(tolerance**2)
    error = np.sqrt(covariance.diagonal())
    counted = np.flatnonzero((mean > 1e-4 * mean.max()) & (error <= 0.15 * mean))
    difference = (power - mean)[counted]
    chi_square = difference @ np.linalg.solve(covariance[np.ix_(counted, counted)], difference)
    rings = {"f": f, "measured": power, "error": error, "expected": mean}
    return rings, {"chi_square": chi_square, "degrees_of_freedom": len(counted),
                   "significance": special.gammaincc(len(counted) / 2, chi_square / 2)}
