"""The page and pictures of "Gabor Noise Implementation Report"."""

import numpy as np

from pages.drawing import middle_of_spectrum, plt, show, table

PRINTED = {
    (256, 64): (0.4718, 0.5158, 0.4269), (256, 128): (0.7509, 0.9037, 0.6426), (256, 256): (1.5623, 1.6565, 1.3088),
    (512, 64): (1.6646, 1.7880, 1.4999), (512, 128): (2.9524, 3.42392, 2.72044), (512, 256): (5.6698, 6.9188, 5.2503),
}


def write(data, page):
    page.write("""
# Gabor Noise Implementation Report
Ling, a report for a course. Its figures and its table, made again by `scripts/reproduce.sh`. F0 = 0.0625 and a = 0.0443528 per pixel, as in
[Improving Gabor Noise](improving-gabor-noise.md).

## Figures 1 to 3: three noises
From above: the noise, its kernel, and the magnitudes of the Fourier transforms of both, frequency 0 in the middle.
""")
    names = {"anisotropic": "anisotropic noise", "isotropic": "isotropic noise, anisotropic kernel", "isotropic_kernel": "isotropic noise, isotropic kernel"}
    figure, axes = plt.subplots(4, 3, figsize=(9, 12.6), constrained_layout=True)
    for (name, title), column in zip(names.items(), axes.T):
        noise, shape = data[f"report_{name}"], data[f"report_{name}_shape"]
        show(column[0], noise[:384, :384], title, -3 * noise.std(), 3 * noise.std())
        column[0].title.set_fontsize(10.5)
        show(column[1], shape, "its kernel", -1, 1)
        for axis, transform in ((column[2], data[f"report_{name}_spectrum"]), (column[3], data[f"report_{name}_transform"])):
            part, extent = middle_of_spectrum(transform, round(0.15 * len(transform)), 1 / len(transform))
            axis.imshow(part, cmap="gray", vmin=0, vmax=np.quantile(part, 0.998), extent=extent)
            axis.set(title="transform of the " + ("noise" if axis is column[2] else "kernel"), xlabel="cycles per pixel")
            axis.grid(False)
    page.photo(figure, "noises", "Three noises and their kernels, with their transforms")
    page.write("""
The transforms of the noises fill those of their kernels: a pair of spots, a ring of spots from all directions, and a ring. The kernel in the middle is that
of one direction.

## Table I: seconds
Printed: four threads of a Core i7-6500U at 2.5 GHz. Ours: processor time of one thread of the machine below, through the Python module, making of the impulses included, with the same impulses per unit of
area. A cell of the report is as wide as the radius at which the Gaussian is at 5 %, 22 pixels. "Procedure" is the papers' way in NumPy, for thousands of points at once
(`research/papers/impulses.py`, double precision).
""")
    speed = data["report_speed"]
    rows = []
    for i in range(len(speed["side"])):
        key = (int(speed["side"][i]), int(speed["impulses"][i]))
        printed = PRINTED[key]
        rows.append([f"{key[0]} x {key[0]}", key[1]]
                    + [f"{printed[k]:.4g} / **{speed[name][i]:.3f}**"
                       for k, name in enumerate(("anisotropic", "isotropic", "isotropic_kernel"))]
                    + [f"{speed['procedure_isotropic'][i]:.2f}", f"{speed['procedure_isotropic_kernel'][i]:.2f}"])
    page.write(table(["size", "impulses per cell", "anisotropic, printed / ours", "isotropic, printed / ours",
                      "isotropic kernel, printed / ours", "procedure, isotropic", "procedure, isotropic kernel"], rows))
    page.write("""
The report finds the isotropic kernel quicker by a factor of 1.2 only, because its setting "error" is the radius where the Gaussian is at 5 %, for all kernels: the
isotropic one's smaller radius, which is what the paper gains by, is never used. The papers' way to draw
Poisson numbers, by products down to exp(-mean), ends in single precision at 87 impulses per cell: the procedure here is in double precision for that.
""")
