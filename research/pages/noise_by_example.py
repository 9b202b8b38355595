"""The page and pictures of "Gabor Noise by Example"."""

import numpy as np
from PIL import Image

from pages.drawing import plt, show, table


def show_spectrum(axes, field, title, reference):
    """Four decades below a reference, as the paper's insets."""
    decades = np.log10(np.maximum(field, 1e-12) / reference)
    show(axes, decades, title, -4, 0)


def draw_bands(data, page):
    bands = data["bands"]
    count = len(bands["a"])
    figure, axes = plt.subplots(2, count + 1, figsize=(2.1 * (count + 1), 4.9), constrained_layout=True)
    reference = data["bands_all_spectrum"].max()
    noise = data["bands_all_noise"]
    show_spectrum(axes[0][0], data["bands_all_spectrum"], "all bands", reference)
    show(axes[1][0], noise, "noise", -3 * noise.std(), 3 * noise.std())
    for i in range(count):
        band = data[f"bands_{i}_noise"]
        share = 100 * bands["share"][i]
        show_spectrum(axes[0][i + 1], data[f"bands_{i}_spectrum"], f"{bands['components'][i]:.0f} Gaussians", reference)
        show(axes[1][i + 1], band, f"{share:.1f} % of the power", -3 * band.std(), 3 * band.std())
    page.write("""
## Figure 2: noise of quantized bandwidths
The spectrum of 128 x 128 pixels of soil as a sum of Gaussians of six widths, each half of the one before; the bands alone, and the noise of each, scaled to the
same contrast. Brightness of spectra is logarithmic, over four decades; frequency 0 is in the middle, half a cycle per pixel at the edges.
""")
    page.photo(figure, "bands", "Bands of a noise, and their noises")


def draw_kappas(data, page):
    kappas = data["kappa"]
    figure, axes = plt.subplots(2, 5, figsize=(13, 5.8), constrained_layout=True)
    flat = axes.flat
    exemplar = data["kappa_exemplar"]
    periodogram = data["kappa_periodogram"]
    show(flat[0], exemplar, "exemplar", exemplar.mean() - 3 * exemplar.std(), exemplar.mean() + 3 * exemplar.std())
    show_spectrum(flat[1], periodogram, "periodogram", periodogram.max())
    for i, inverse in enumerate(kappas["inverse_kappa"]):
        show_spectrum(flat[i + 2], data[f"kappa_{inverse:.0f}"],
                      f"1/{inverse:.0f}: {kappas['components'][i]:.0f}, off by {100 * kappas['residual'][i]:.0f} %",
                      periodogram.max())
        flat[i + 2].title.set_fontsize(11)
    page.write("""
## Figure 3: ever more Gaussians
The sparse decompositions of the periodogram for kappa = 1/2 to 1/256. Titles say kappa and the number of Gaussians; "off by" is the distance to the periodogram, relative to its length, with the power of the lowest frequencies and of the others at their best. A periodogram
of one exemplar scatters by as much as the spectrum itself, so that less is not always better: see [noisefit](../noisefit.md).
""")
    page.photo(figure, "kappa", "Decompositions for falling kappa")


def draw_sheets(data, page):
    page.write("""
## Figures 4 and 5: from exemplar to noise
Grey, 128 x 128 pixels, kappa = 1/256, all bands. Left to right: exemplar, its Gaussian version, Gaussian texture of the sparse spectrum, procedural noise.
Sheets of seven photographs in colour are on the page of [noisefit](../noisefit.md).
""")
    for name in ("sand", "moss", "wood"):
        image = Image.fromarray((255 * data[f"sheet_{name}"]).round().astype("uint8"))
        image.thumbnail((900, 900))
        page.show(image, f"{name}.jpg", name, quality=75, optimize=True)


def write_numbers(data, page):
    numbers = data["example_numbers"]
    rows = []
    for name, record in numbers.items():
        rows.append([name, record["paper_components"], f"{100 * record['paper_sparseness']:.2f} %",
                     f"{record['paper_seconds']:.1f} s", f"{100 * record['sparseness']:.2f} %", f"{record['seconds']:.1f} s",
                     ", ".join(f"{record['j'][kind][0]:.4f}" for kind in ("rgb", "pca")),
                     ", ".join(f"{record['j'][kind][1]:.2f}" for kind in ("rgb", "pca", "independent"))])
    mean = np.mean([record["paper_sparseness"] for record in numbers.values()])
    ours = np.mean([record["sparseness"] for record in numbers.values()])
    seconds = np.mean([record["paper_seconds"] for record in numbers.values()])
    rows.append(["**mean**", "", f"**{100 * mean:.2f} %**", f"**{seconds:.1f} s**", f"{100 * ours:.2f} %", "", "", ""])
    rows.append(["**printed**", "", "**3.5 %**", "**2 minutes**", "", "", "0.9962, 0.0067", ""])
    page.write("""
## Sparseness, time, independence of colours
128 x 128 pixels in grey, kappa = 1/256, processor time; J of the whole photographs in colour.
""")
    page.write(table(["exemplar", "Gaussians, paper's parameters", "of the pixels", "time", "our defaults", "time",
                      "J of RGB, PCA", "J at unit variance of RGB, PCA, independent axes"], rows))
    page.write("""
Sparseness is the ratio of Gaussians to pixels. The paper's 44 textures are not ours, so that the means need not agree. Our defaults leave out the band of a single
frequency, which follows the scatter of the periodogram; the fine detail that they add (`--no-fill` leaves it out) is not counted. J (eq. 10) is printed for one texture,
0.0028 for independent axes; here it is the share of the squared correlations at all distances that is between channels. It depends on the scale of the channels, as the one that is
much stronger hides the others; scaled to unit variance, which is what our independent axes are sought for, they leave more than it shows. In a single periodogram independent channels
of one spectrum have 1/2, by their scatter. The order is the paper's: RGB above PCA, and the independent axes never above PCA.
""")


def write_literal(data, page):
    literal = data["literal"]
    lengths, squares = literal["lengths"], literal["squared_magnitudes"]
    page.write("""
## Equation 8, taken literally
The penalty of eq. 8 is the sum of alpha, the kernels' squared magnitudes. An atom of a band half as wide is 8 times as long then, and costs the same: the narrowest
band wins, always. With atoms of unit length, which is what we do (`GaussianAtoms`), all bands are used. Gaussians per band, the widest first, of
soil at kappa = 1/256:
""")
    page.write(table(["penalty", "band 2", "3", "4", "5", "6", "7", "off by"], [
        ["squared magnitudes, as printed", *squares["components"], f"{100 * squares['residual']:.0f} %"],
        ["lengths of the atoms", *lengths["components"], f"{100 * lengths['residual']:.0f} %"],
    ]))
    page.write("""
## Slips of the paper, for whoever implements it
| equation | what is meant |
|---|---|
| 7 | summed over the whole plane it lists each pair of Gaussians twice; over a half of it, as section 5.3 does |
| 8 | atoms of unit length, see above |
| 9 | divide by the number of pixels; 1/M^2 is that of an M x M image |
""")


def write(data, page):
    page.write("""
# Gabor Noise by Example
Galerne, Lagae, Lefebvre and Drettakis, ACM Transactions on Graphics 31 (4), 2012. Figures and numbers of the paper, made again by `scripts/reproduce.sh`, on
[our own photographs](../../examples/exemplars). `tests/papers/` asserts what is said of kappa and of equation 8, on an exemplar whose spectrum is known.
""")
    draw_bands(data, page)
    draw_kappas(data, page)
    draw_sheets(data, page)
    write_numbers(data, page)
    write_literal(data, page)
