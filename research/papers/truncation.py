"""One noise summed over the same impulses with the kernel as it is, with the kernel cut at the radius of a relative error, and with what was
cut away (Lagae et al. 2011, figures 9 and 10)."""

import numpy as np

from papers.gabor import GAUSSIAN, Isotropic
from papers.impulses import sparse_sum


def truncate(n, error, side, density=0.0415, seed=1):
    """At samples one unit apart along each axis. Weights are uniform on [-1, 1]; the noise has unit variance by eq. 16, so that the error is
    expected to be what was asked for (eq. 22)."""
    kernel = Isotropic(n)
    radius, reach = kernel.radius(error), np.sqrt(np.log(1e6) / np.pi) / GAUSSIAN
    random = np.random.default_rng(seed)
    count = round(density * (side + 2 * reach) ** n)
    places, weights = random.uniform(-reach, side + reach, (count, n)), random.uniform(-1, 1, count)
    points = np.stack(np.meshgrid(*[np.arange(side)] * n, indexing="ij"), -1).reshape(-1, n)
    scale = 1 / np.sqrt(density * kernel.energy * kernel.weights[0])
    # The table's entries are 1e-5 of the maximum apart at most.
    table = np.arange(0, reach + 1, 0.01)
    values = kernel.value(table)
    parts = [scale * sparse_sum(points, places, reach, lambda r, _, j: weights[j] * ((r < radius) == inner) * np.interp(r, table, values))
             for inner in (True, False)]
    powers = [np.mean(part**2) for part in np.array_split(parts[1], 16)]
    rms = np.sqrt(np.mean(powers))
    fields = [field.reshape([side] * n) for field in (parts[0] + parts[1], *parts)]
    return dict(zip(("whole", "truncated", "difference"), fields)) | {
        "radius": radius, "expected_rms": error, "error_rms": rms, "standard_error": np.std(powers, ddof=1) / 4 / (2 * rms)}
