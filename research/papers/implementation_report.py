"""What the page of "Gabor Noise Implementation Report" shows (Ling)."""

import numpy as np
import solidnoise

from papers.data import centred, columns, image
from papers.gabor import FREQUENCY, GAUSSIAN, Isotropic, Oriented
from papers.impulses import procedure, quickest
from papers.spectra import periodogram

CELL = np.sqrt(np.log(20) / np.pi) / GAUSSIAN  # where the Gaussian is at 5 %, the side of the report's cells
NOISES = {
    "anisotropic": (solidnoise.gabor_oriented, Oriented(2), {"anisotropy": 1, "direction": (1, 1)}),
    "isotropic": (solidnoise.gabor_oriented, Oriented(2), {"anisotropy": 0}),
    "isotropic_kernel": (solidnoise.gabor, Isotropic(2), {}),
}


def make(name, impulses=0):
    function, _, options = NOISES[name]
    return function(dims=2, frequency=FREQUENCY, impulses_process="poisson", impulses=impulses, **options)


def panels():
    """Figures 1 to 3: each noise with its kernel, and the magnitudes of the transforms of both."""
    result = {}
    x, y = np.meshgrid(np.arange(-64, 64), np.arange(-64, 64), indexing="ij")
    r = np.hypot(x, y)
    for name, (_, kernel, options) in NOISES.items():
        wave = np.array(options.get("direction", (1, 0)))
        waves = np.cos(2 * np.pi * FREQUENCY * (np.stack([x, y], -1) @ wave) / np.linalg.norm(wave))
        shape = kernel.value(r) if name == "isotropic_kernel" else np.exp(-np.pi * (GAUSSIAN * r) ** 2) * waves
        values = make(name).lattice(0, 1, [512, 512])
        result |= {f"report_{name}": image(values), f"report_{name}_shape": image(shape),
                   f"report_{name}_spectrum": np.sqrt(centred(periodogram([values]).density)),
                   f"report_{name}_transform": np.sqrt(centred(periodogram([shape], hann=False).density))}
    return result


def speed():
    """Table I: seconds of one thread, with as many impulses per unit of area."""
    rows = []
    axis = np.random.default_rng(1).uniform(0, 512, (8192, 2))
    for side in (256, 512):
        for per_cell in (64, 128, 256):
            row = [side, per_cell]
            for name, (_, kernel, _) in NOISES.items():
                noise = make(name, np.pi * kernel.radius() ** 2 / CELL**2 * per_cell)
                row.append(quickest(lambda: noise.lattice(0, 1, [side, side], threads=1)))
            for kernel in (Oriented(2), Isotropic(2)):
                # A part of the picture, as its cost per point is that of all.
                seconds = quickest(lambda: procedure(kernel, axis, CELL, np.pi * per_cell, 1), 1)
                row.append(seconds * side**2 / len(axis))
            rows.append(row)
    return {"report_speed": columns(("side", "impulses", *NOISES, "procedure_isotropic", "procedure_isotropic_kernel"), rows)}


ITEMS = {"report": panels, "report_speed": speed}
