"""The page and pictures of "Better Gradient Noise"."""


import numpy as np

from pages.drawing import middle_of_spectrum, plt, show, table

FIGURE = [
    ("a", "a: Perlin, classic hash"), ("b", "b: Perlin, xor hash"), ("c", "c: wide kernel"),
    ("d", "d: plane through 3D"), ("e", "e: projected"), ("f", "f: projected, half resolution"),
]
ZERO_DC = [("c_zero_dc", "c, zero-dc"), ("d_zero_dc", "d, zero-dc"), ("e_zero_dc", "e, zero-dc")]


def draw_spectra(data, kinds, axes):
    for (name, title), column in zip(kinds, axes.T):
        field = data[f"gradient_{name}"]
        show(column[0], field[:192, :192], title, -3 * field.std(), 3 * field.std())
        spectrum, extent = middle_of_spectrum(data[f"gradient_{name}_spectrum"], 76, 4 / 256)
        column[1].imshow(spectrum, cmap="gray", vmin=0, vmax=np.quantile(spectrum, 0.99), extent=extent)
        column[1].grid(False)
    axes[1][0].set_ylabel("cycles per lattice unit")


def draw_figure(data, page):
    figure, axes = plt.subplots(2, 6, figsize=(15, 5.0), constrained_layout=True)
    draw_spectra(data, FIGURE, axes)
    page.write("""
## Figure 1: six noises and their Fourier transforms
Above, 48 lattice units of each; below, magnitudes of the transforms of 256 units, the tables' full repetition, with frequency 0 in the middle. The classic hash leaves stripes in a; the wide
kernel makes a ring of the disk; a plane through 3D noise fills it with low frequencies, and the projection empties it again. c and d are the library's noises, a, b, e and f
the papers' procedures in NumPy (`research/papers/gradients.py`), f through a window of 2 units, see below.
""")
    page.photo(figure, "figure1", "Figure 1 made again")

    values = data["gradient"]
    rows = []
    for name, title in FIGURE + ZERO_DC:
        record = values[name]
        rows.append([title, f"{record['peak']:.2f}", f"{100 * record['low_share']:.3f} %",
                     f"{record['striation_x']:.3f} / {record['striation_y']:.3f}"])
    page.write(table(["noise", "peak of the density (cycles per lattice unit)", "power below a quarter of it",
                      "difference of neighbouring lines, x / y"], rows))
    page.write(f"""
The last column is the root mean square of the difference over the sum of the powers of neighbouring lines in the spectrum: stripes. The classic
hash has {values['a']['striation_x']:.2f} between lines across the axis that is looked up last, and the exclusive-or of one table per axis
{values['b']['striation_x']:.3f}, as little as chance leaves. The tables repeat after 256 units; `--hash integer` does not.
""")


def draw_zero_dc(data, page):
    closed = data["gradient_closed"]
    figure, axes = plt.subplots(1, 2, figsize=(11, 3.4))
    for name, label, color in (("c", "published, measured", "C0"), ("c_zero_dc", "zero-dc, measured", "C1")):
        radial = data[f"gradient_{name}_radial"]
        for axis in axes:
            axis.plot(radial["f"], radial["density"], ".", color=color, markersize=4, label=label)
    for axis in axes:
        axis.plot(closed["f"], closed["kensler"], "C0-", linewidth=1, label="published, closed form")
        axis.plot(closed["f"], closed["zero_dc"], "C1-", linewidth=1, label="zero-dc, closed form")
        axis.set(xlabel="cycles per lattice unit", xlim=(0, 1.3))
    axes[1].set(yscale="log", ylim=(1e-4, 2), title="the same, logarithmic")
    axes[0].set(xlim=(0, 2), ylabel="power density at unit variance", title="Radial spectrum, two dimensions", ylim=(0, None))
    axes[0].legend(fontsize=10)
    page.write("""
## The kernel without power at frequency 0
The published coefficients, s = 4 t^5 - 3 t^4, were found for one dimension, and leave power at low frequencies that grows with each dimension. Ours
(`--kernel zero-dc`) demand that the kernel's potential integrates to 0, at the same cost: in two dimensions s = (7 t^5 - 5 t^4) / 2.
The paper has no closed form of the spectrum; ours is derived at `GradientKernel` (`src/solidnoise/noise/gradient/gradient_kernel.h`).
""")
    page.picture(figure, "spectrum", "Radial spectra, measured and in closed form")
    figure, axes = plt.subplots(2, 3, figsize=(8, 5.0), constrained_layout=True)
    draw_spectra(data, ZERO_DC, axes)
    page.photo(figure, "zero-dc", "The noises c, d and e with the kernel that has no power at frequency 0")


def write_planes(data, page):
    planes = data["gradient_planes"]
    rows = [[f"{planes['height'][i]:g}"] + [f"{planes[name][i]:.4f}" for name in ("full", "half_printed", "half_wide")]
            for i in range(len(planes["height"]))]
    zero = planes["half_printed"][list(planes["height"]).index(1.0)]
    page.write(f"""
## Half resolution: a plane that vanishes
Variance of projected noise on a plane at a height over a layer of the lattice, normal to z, by the printed pseudocode with unit gradients. With half resolution
and the printed window, which reaches one unit, the plane half-way between two layers is {zero:g}: none of them is in reach. The window has to be
twice as wide. What is left of the modulation is the window's: the squares of the published one do not add up to 1, as those of
cos(pi/2 (3 u^2 - 2 u^3)), u the distance, would.
""")
    page.write(table(["height", "full resolution", "half, as printed", "half, window of 2 units"], rows))


def write_costs(data, page):
    costs = data["gradient_costs"]
    perlin = costs["chained"]
    page.write("""
## Section 5: costs
Three dimensions, over Perlin's noise with the classic hash; the procedures in NumPy, all points at once, processor time of one thread. All of ours read their gradients
from a table of 256; how the paper's Perlin noise was made it does not say.
""")
    page.write(table(["", "printed", "measured", "ns"], [
        ["xor hash", "about 0.95", f"{costs['xor_tables'] / perlin:.2f}", f"{costs['xor_tables']:.0f}"],
        ["wide kernel", "about 6", f"{costs['wide'] / perlin:.1f}", f"{costs['wide']:.0f}"],
        ["projected", "about 14", f"{costs['projected'] / perlin:.1f}", f"{costs['projected']:.0f}"],
        ["projected, half resolution", "2.4", f"{costs['half'] / perlin:.2f}", f"{costs['half']:.0f}"],
    ]))
    page.write("The library's own evaluation, in blocks and with SIMD, and compiled procedures are in the [README](../../README.md#speed).")


def write(data, page):
    page.write("""
# Better Gradient Noise
Kensler, Knoll and Shirley, SCI Institute technical report UUSCI-2008-001. The figure and numbers of the paper, made again by
`scripts/reproduce.sh`; the numbers are asserted, in smaller versions, by `tests/papers`. Lengths are in lattice units.
""")
    draw_figure(data, page)
    draw_zero_dc(data, page)
    write_planes(data, page)
    write_costs(data, page)
    page.write("""
## Slips of the paper, for whoever implements it
| where | what is meant |
|---|---|
| pseudocode | v begins with 0 |
| pseudocode | the stencil of 4 x 4 x 4 leaves out lattice points whose projection is nearer than 2 but which are farther than 2 along an axis, 0.8 % of the terms: the value jumps by up to 0.0003, its standard deviation being 0.19. Harmless for colours, not for derivatives; a stencil of 6 is exact |
| section 3 | "separable radial filter" is radial, as in the pseudocode |
| section 2 | with the exclusive-or, H(i, j) ^ H(i+1, j) ^ H(i, j+1) ^ H(i+1, j+1) is always 0; nothing of it shows |
""")
