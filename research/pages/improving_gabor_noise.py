"""The page and pictures of "Improving Gabor Noise"."""


import numpy as np

from pages.drawing import middle_of_spectrum, plt, show, table

NAMES = {1: "one dimension", 2: "two", 3: "three", 4: "four"}


def draw_kernels(data, page):
    space = data["kernels"]
    transform = data["transforms"]
    figure, axes = plt.subplots(1, 2, figsize=(10, 3.6), constrained_layout=True)
    axes[0].plot(space["r"], space["gaussian"], "k:", label="Gaussian")
    for n in NAMES:
        axes[0].plot(space["r"], space[f"n{n}"], label=f"n = {n}")
        axes[1].plot(transform["f"], transform[f"n{n}"] / transform[f"n{n}"].max(), label=f"n = {n}")
    axes[0].set(xlabel="radius (pixels)", ylabel="kernel / its peak", title="In space", xlim=(0, 40))
    axes[1].set(xlabel="frequency (cycles per pixel)", ylabel="transform / its maximum", title="In frequency",
                xlim=(0, 0.16))
    axes[1].axvline(0.0625, color="gray", linestyle="--", linewidth=1)
    axes[0].legend()
    axes[1].legend()
    page.write("""
## Figures 1, 2 and 6: the kernel
The isotropic kernel in 1 to 4 dimensions with the parameters of the paper's example, F0 = 0.0625 and a = 0.0443528 per pixel; the
dashed line is F0. The transform's maximum moves towards lower frequencies as dimensions grow, and the kernel becomes more compact.
At a bandwidth of one octave the transform at frequency 0 grows to a tenth of its maximum in four.
""")
    page.picture(figure, "kernels", "Isotropic kernels and their transforms")
    draw_pictures(data, page)

    figure, axes = plt.subplots(1, 4, figsize=(12, 2.9), sharex=True, sharey=True, constrained_layout=True)
    for n, axis in zip(NAMES, axes):
        axis.plot(space["r"], np.abs(space[f"n{n}"]), label="|kernel|")
        axis.plot(space["r"], space[f"e{n}"], "r--", label="envelope")
        axis.set(title=f"n = {n}", xlabel="radius (pixels)", xlim=(0, 40), ylim=(0, 1.1))
    axes[0].legend()
    page.picture(figure, "envelopes", "Envelopes of the kernels")


def draw_pictures(data, page):
    figure, axes = plt.subplots(1, 4, figsize=(12, 3.2), constrained_layout=True)
    for axis, (name, title) in zip(axes, (("gaussian", "Gaussian"), ("harmonic", "harmonic"), ("kernel", "kernel"),
                                          ("transform", "its transform"))):
        field = data[f"kernel2d_{name}"]
        reach = 0.15 if name == "transform" else 40
        low = 0 if name in ("gaussian", "transform") else -0.5
        axis.imshow(field, cmap="gray", vmin=low * field.max(), vmax=field.max() * (1 if low == 0 else 0.5),
                    extent=(-reach, reach, -reach, reach))
        axis.set(title=title, xlabel="cycles per pixel" if name == "transform" else "pixels")
        axis.grid(False)
    page.photo(figure, "kernel2d", "The kernel of two dimensions, what it is the product of, and its transform")


def write_radii(data, page):
    radii = data["radii"]

    def saving(small, large):
        return 100 * (1 - (small / large) ** 2)

    iso, aniso = radii["isotropic_envelope"], radii["anisotropic_envelope"]
    iso_error, aniso_error = radii["isotropic_error"], radii["anisotropic_error"]
    page.write("""
## Sections III-C and IV-B: radii and numbers of impulses
Two dimensions, K = 0.709645, a = 0.0443528, F0 = 0.0625; radii in pixels. "Printed" is the paper's number, "its rule" what the rule in
the text gives.
""")
    page.write(table(["what", "printed", "its rule", "difference"], [
        ["radius where the envelope is 5 % of the maximum, anisotropic", "22.0169", f"{aniso:.4f}", "none"],
        ["the same, isotropic (eq. 52)", "15.6741", f"**{iso:.4f}**",
         f"K was left out of the maximum: at 15.6741 the envelope is at {100 * radii['printed_share_of_maximum']:.2f} %. "
         f"By the envelope itself, not its approximation: {radii['isotropic_envelope_exact']:.4f}"],
        ["smaller radius", "28.8086 %", f"**{100 * (1 - iso / aniso):.1f} %**", "follows"],
        ["impulses per anisotropic kernel, for 32 per isotropic one", "63.1386", f"**{32 * (aniso / iso) ** 2:.2f}**",
         "follows"],
        ["fewer impulses", "49.3179 %", f"**{saving(iso, aniso):.1f} %**", "follows"],
        ["radius where the relative error is 2 %, isotropic (eq. 23)", "20.8984", f"{iso_error:.4f}",
         f"none; but eqs. 21 and 23 as printed lack r^(n-1), and would give {radii['isotropic_error_printed']:.4f}"],
        ["the same, anisotropic", "25.25", f"{aniso_error:.4f}",
         f"a coarse search; phase 0, mean over directions. For a random phase {radii['random_phase_error']:.4f}"],
        ["smaller radius", "17.2341 %", f"{100 * (1 - iso_error / aniso_error):.2f} %", "follows"],
        ["impulses per anisotropic kernel, for 32 per isotropic one", "46.7139",
         f"{32 * (aniso_error / iso_error) ** 2:.3f}", "follows"],
        ["fewer impulses", "31.498 %", f"{saving(iso_error, aniso_error):.2f} %", "follows"],
    ]))
    page.write("""
So the isotropic kernel saves 39 % of the impulses by the rule of the envelope, not 49 %, and 31 % at the same error. It still needs
as many impulses *per kernel* or more for the same likeness to a Gaussian field; see the table under figures 3 to 5. The derivations are at
`IsotropicGaborKernel` (`src/solidnoise/noise/kernel/isotropic_gabor_kernel.h`).
""")


def write_speed(data, page):
    speed = data["kernel_speed"]
    names = ("impulses per area (the paper's)", "impulses per kernel", "excess kurtosis, 0.5")
    rows = []
    for i in range(len(speed["n"])):
        kind = int(speed["comparison"][i])
        row = [f"{speed['n'][i]:.0f}", names[kind],
               f"{speed['anisotropic_impulses'][i]:.0f}, {speed['isotropic_impulses'][i]:.0f}"]
        for way in ("procedure", "block"):
            anisotropic, isotropic = speed[f"anisotropic_{way}"][i], speed[f"isotropic_{way}"][i]
            digits = 0 if way == "procedure" else 1
            row.append(f"{anisotropic:.{digits}f} / {isotropic:.{digits}f} = **{anisotropic / isotropic:.2f}**")
        rows.append(row)
    page.write("""
### Speed-up of the isotropic kernel
Printed for two dimensions: 2.50 by the envelope's rule and 2.44 at an error of 2 % (CPU), 1.87 (GPU). Here both kernels have an error of 2 %, and the same number of
the thing in the second column. Nanoseconds per value of the anisotropic over the isotropic kernel, processor time of one thread; the procedure in NumPy, for thousands of points
at once, the library through its Python module, on lattices of 2048 x 2048 samples in two dimensions and of 128 x 128 x 128 in three and in four:
""")
    page.write(table(["n", "equal", "impulses per kernel, anisotropic and isotropic", "the papers' procedure, in NumPy",
                      "the library's lattices"], rows))
    page.write("""
The procedure (weights uniform on [-1, 1]; double precision) gains as long as the density of impulses is what counts; compiled code, point by point, is in
the [benchmark](../performance.md). For the same likeness to a Gaussian field the anisotropic kernel with a random phase is quicker in any number of
dimensions, the more so the more there are: the isotropic kernel gathers its energy in a central spike. The library has both: `--noise gabor` and
`--noise gabor-oriented`; its numbers for equal kurtosis are those of weights of ±1.
""")


def draw_perlin(data, page):
    record = data["perlin"]
    figure, axes = plt.subplots(1, 4, figsize=(13, 3.5), constrained_layout=True)
    for i, (name, title) in enumerate((("noise", "Perlin"), ("gabor", "Gabor, isotropic kernel"))):
        field = data[f"perlin_{name}"]
        show(axes[2 * i], field[:192, :192], title, -3 * field.std(), 3 * field.std())
        power, extent = middle_of_spectrum(data[f"perlin_{name}_spectrum"], 40, 1 / 256)
        axes[2 * i + 1].imshow(np.sqrt(power), cmap="gray", vmin=0, vmax=np.sqrt(np.quantile(power, 0.995)), extent=extent)
        axes[2 * i + 1].set(title="its amplitude spectrum", xlabel="cycles per pixel")
        axes[2 * i + 1].grid(False)
    page.write("""
## Figure 7: against Perlin noise
Two dimensions, both with the peak at the same frequency; spectra are means over 256 seeds. (Wavelet noise, the paper's third, is not implemented here.)
""")
    page.photo(figure, "perlin", "Perlin noise and Gabor noise with their spectra")
    rows = [[title] + [f"{mean:.3f} ± {error:.3f}" for mean, error in (record[name][band] for band in ("below_peak", "above_peak"))]
            for name, title in (("noise", "Perlin"), ("gabor", "Gabor"))]
    rows.append(["Gabor, closed form"] + [f"{record['expected'][band]:.3f}" for band in ("below_peak", "above_peak")])
    page.write("""
Perlin noise prefers the axes, and is no band. Power within 15 degrees of the diagonals over that within 15 degrees of the axes; the closed form, which is isotropic, is summed over
the same discrete frequencies:
""")
    page.write(table(["", "from 0.5 to 1.3 of the peak's frequency", "from 1.3 to 2"], rows))


def draw_spectra(data, page, n, axes):
    stem = f"noise{n}d"
    histogram = data[stem + "_histogram"]
    radial = data[stem + "_radial"]
    picture = data[stem + "_picture"]
    if n == 1:
        axes[0].plot(picture[0][:256], linewidth=1)
        axes[0].set(title="noise, n = 1", xlabel="position (pixels)", ylim=(-4, 4))
        for axis in axes[2:5]:
            axis.axis("off")
    else:
        show(axes[0], picture[:192, :192], f"noise, n = {n}", -3, 3)
        estimated = data[stem + "_estimated"]
        expected = data[stem + "_expected"]
        high = expected.max()
        part, extent = middle_of_spectrum(data[stem + "_transform"], 32, 1 / 256)
        axes[2].imshow(part, cmap="gray", vmin=0, vmax=1, extent=extent)
        axes[2].set(title="Fourier transform, log", xlabel="cycles per pixel")
        axes[2].grid(False)
        for axis, field, name in ((axes[3], estimated, "estimated spectrum"), (axes[4], expected, "expected spectrum")):
            part, extent = middle_of_spectrum(field, 32, 1 / 256)
            axis.imshow(part, cmap="gray", vmin=0, vmax=1.1 * high, extent=extent)
            axis.set(title=name, xlabel="cycles per pixel")
            axis.grid(False)
    axes[1].plot(histogram["value"], histogram["density"], label="measured")
    axes[1].plot(histogram["value"], histogram["gaussian"], "k--", linewidth=1, label="Gaussian")
    axes[1].set(title="distribution of values", xlim=(-4.5, 4.5), ylim=(0, 0.75), xlabel="sigmas")
    axes[5].errorbar(radial["f"], radial["measured"], 2 * radial["error"], fmt=".", markersize=4, label="measured")
    axes[5].plot(radial["f"], radial["expected"], "k-", linewidth=1, label="expected")
    axes[5].set(title="radial spectrum", xlim=(0, 0.15), ylim=(0, 1.6 * radial["expected"].max()), xlabel="cycles per pixel")


def draw_noises(data, page):
    page.write("""
## Figures 3, 4 and 5: the noise, its distribution and its spectrum
Also in four dimensions, which the paper leaves out. Noises of 3 and 4 dimensions are seen on a plane: the plane's spectrum is the
kernel's, integrated over the frequencies that it does not see, and no ring any more. Spectra are means of Hann-windowed
periodograms of 256 x 256 samples and 64 seeds; bars are two standard errors, lines and "expected" pictures the closed form
through the same window. The third column is the transform of the one picture, its magnitude in logarithms.
""")
    figure, axes = plt.subplots(4, 6, figsize=(13, 9.4), constrained_layout=True)
    for n, row in zip(NAMES, axes):
        draw_spectra(data, page, n, row)
    axes[0][1].legend(loc="upper left", fontsize=10)
    axes[0][5].legend(fontsize=10)
    page.photo(figure, "noise", "Noise of 1 to 4 dimensions")

    figure, axes = plt.subplots(1, 2, figsize=(10, 3.2), constrained_layout=True)
    for n, axis in zip((3, 4), axes):
        block = data[f"noise{n}d_block"]
        axis.errorbar(block["f"], block["measured"], 2 * block["error"], fmt=".", markersize=5, label="measured")
        axis.plot(block["f"], block["expected"], "k-", linewidth=1, label="expected")
        axis.set(title="blocks of n = 3" if n == 3 else "frames of n = 4", xlim=(0, 0.32), xlabel="cycles per pixel",
                 ylabel="power density")
    axes[0].legend()
    page.write("In blocks of 96 x 96 x 96 samples, with F0 = 0.125, the ring of three dimensions, a shell, is seen; frames of four have none.")
    page.picture(figure, "blocks", "Radial spectra in three dimensions")

    rows = []
    for n in NAMES:
        record = data[f"noise{n}d"]
        for key, who in (("ours", "default"), ("paper", "the paper's")):
            sample = record[key]
            rows.append([n, f"{who}: {sample['impulses']:.0f}",
                         f"{sample['variance']:.4f} ± {sample['variance_error']:.4f}",
                         *(f"{round(sample[name], 2) + 0.0:.2f}" for name in ("excess_kurtosis", "expected_excess_kurtosis")),
                         f"{sample['chi_square']:.1f} / {sample['degrees_of_freedom']}", f"{sample['significance']:.2f}"])
    page.write(table(["n", "impulses per kernel", "variance (expected 1)", "excess kurtosis", "expected",
                      "chi-square of the radial spectrum", "probability of more"], rows))
    page.write("""
The paper's numbers of impulses (32, weights uniform on [-1, 1]) do in one and two dimensions. In three and four its isotropic kernel gathers
its energy in a central spike: at 32 impulses values are far from Gaussian, and the distribution that the paper shows needs more of them.
Our default takes weights of ±1, and impulses in strata, which bring the excess kurtosis to 0. Variance and spectrum are right for any number.
""")


def draw_errors(data, page):
    errors = data["errors"]
    figure, axes = plt.subplots(1, 2, figsize=(10, 3.6), constrained_layout=True)
    for n in NAMES:
        axes[0].semilogy(errors["r"], 100 * errors[f"n{n}"], label=f"n = {n}")
    axes[1].semilogy(errors["r"], 100 * errors["anisotropic"], label="anisotropic, n = 2")
    axes[1].semilogy(errors["r"], 100 * errors["n2"], label="isotropic, n = 2")
    for axis in axes:
        axis.axhline(2, color="gray", linestyle="--", linewidth=1)
        axis.set(xlabel="kernel radius (pixels)", ylabel="relative error (%)", xlim=(0, 35), ylim=(0.01, 120))
        axis.legend()
    page.write("""
## Figures 11 and 12: error against radius
The relative error of the noise for a kernel cut at a radius, eq. 23 with the factor r^(n-1) of a volume integral; dashed: 2 %. A radius for an
error is read off the same curves. The isotropic kernel's error is below the anisotropic one's at every radius, as the paper says.
""")
    page.picture(figure, "errors", "Relative error against kernel radius")


def draw_truncation(data, page):
    figure, axes = plt.subplots(1, 2, figsize=(12, 3.2), sharey=True, constrained_layout=True)
    rows = []
    for percent, axis in zip((25, 1), axes):
        record = data[f"truncation1d_{percent}"]
        part = slice(0, 400)
        axis.plot(record["whole"][part], label="untruncated")
        axis.plot(record["truncated"][part], label="truncated", linewidth=1)
        axis.plot(record["difference"][part], label="difference", linewidth=1)
        for sign in (1, -1):
            axis.axhline(sign * record["expected_rms"], color="gray", linestyle="--", linewidth=1,
                         label="expected RMS error" if sign == 1 else None)
        axis.set(title=f"relative error {percent} %", xlabel="position (pixels)", ylim=(-4.5, 3))
    axes[0].legend(fontsize=10, ncol=2, loc="lower left")
    page.write("""
## Figures 9 and 10: the truncation error, seen and predicted
One noise, summed over the same impulses by the definition, with the kernel whole and cut off. (Solidnoise's own kernels end with value
and slope 0 instead; their error is the same relative RMS.)
""")
    page.picture(figure, "truncation1d", "Truncation in one dimension")
    figure, axes = plt.subplots(2, 3, figsize=(9, 6.2))
    for percent, row in zip((25, 1), axes):
        record = data[f"truncation2d_{percent}"]
        show(row[0], record["whole"][:160, :160], "untruncated", -3, 3)
        show(row[1], record["truncated"][:160, :160], f"truncated, {percent} %", -3, 3)
        show(row[2], record["difference"][:160, :160],
             "difference" if percent == 25 else "difference, 25 times", -3 if percent == 25 else -0.12,
             3 if percent == 25 else 0.12)
    page.photo(figure, "truncation2d", "Truncation in two dimensions")
    for n in (1, 2):
        for percent in (25, 1):
            record = data[f"truncation{n}d_{percent}"]
            rows.append([n, f"{percent} %", f"{record['radius']:.2f}", f"{record['expected_rms']:.4f}",
                         f"{record['error_rms']:.4f} ± {record['standard_error']:.4f}"])
    page.write(table(["n", "relative error", "radius (pixels)", "expected RMS of the difference", "measured"], rows))


def draw_impulses(data, page):
    impulses = data["impulses"]
    alphas = np.unique(impulses["alpha"])
    figure, axes = plt.subplots(2, len(alphas), figsize=(13, 4.7), constrained_layout=True)
    for kind, row in enumerate(axes):
        for alpha, axis in zip(alphas, row):
            for level, color in ((0, "C3"), (1, "C0")):
                chosen = ((impulses["kind"] == kind) & (impulses["alpha"] == alpha) & (impulses["level"] == level)
                          & (impulses["weight"] > 0.01))
                axis.scatter(impulses["x"][chosen], impulses["y"][chosen], s=14 * impulses["weight"][chosen] ** 2, color=color,
                             linewidths=0)
            axis.set(xlim=(0, 6), ylim=(0, 6), xticks=range(0, 7, 2), yticks=range(0, 7, 2), aspect="equal")
            axis.set_title(f"alpha = {alpha:.1f}")
            axis.tick_params(labelbottom=False, labelleft=False)
    axes[0][0].set_ylabel("the paper's weights")
    axes[1][0].set_ylabel("ours (fade)")
    page.write("""
## Figure 13: impulses of two grids
Impulses of the grids of cells of 1 (red) and 2 units (blue) as the kernel's radius goes from 1 to 2; areas are squared weights, which is what adds up. With the paper's
weights all impulses of both grids are there half-way, all weak; with ours they come and go one by one. This and the next figure's measurements are sums by
the definition (`research/papers/transition.py`), which share nothing with the library.
""")
    page.picture(figure, "impulses", "Impulses of two grids and their weights")


def draw_transition(data, page):
    weights = data["transition_weights"]
    curves = data["transition_variance"]
    measured = data["transition_measured"]
    figure, axes = plt.subplots(1, 2, figsize=(12, 4))
    axes[0].plot(weights["alpha"], weights["paper_fine"], "C0-", label="paper: w0")
    axes[0].plot(weights["alpha"], weights["paper_coarse"], "C0--", label="paper: w1")
    axes[0].plot(weights["alpha"], weights["power_fine"], "C1-", label="power: w0")
    axes[0].plot(weights["alpha"], weights["power_coarse"], "C1--", label="power: w1")
    axes[0].set(xlabel="alpha, between two grids", title="Weights")
    axes[1].plot(curves["alpha"], curves["paper"], "C0-", label="paper")
    axes[1].plot(curves["alpha"], curves["power"], "C1-", label="power")
    for name, color, mark in (("paper", "C0", "o"), ("power", "C1", "s"), ("fade", "C2", "^")):
        axes[1].errorbar(measured["alpha"], measured[name], 2 * measured[name + "_error"], fmt=mark, color=color,
                         label=f"{name}, measured")
    axes[1].set(xlabel="alpha, between two grids", title="Variance, which should be 1", ylim=(0, 2))
    axes[0].legend(fontsize=10)
    axes[1].legend(fontsize=10, ncol=2, loc="upper center", columnspacing=0.8, handlelength=1.4)
    page.write("""
## Figure 14: the weights between two grids
""")
    page.picture(figure, "transition", "Weights between two grids and the variance they give")
    third = np.argmin(np.abs(measured["alpha"] - 1 / 3))
    page.write(f"""
The paper's weights, eqs. 25 and 26, are right for powers and printed for amplitudes: independent grids add up in their squares, and the
variance falls to a half at alpha = 1/3 (closed form 0.5, measured {measured['paper'][third]:.3f} ±
{measured['paper_error'][third]:.3f}). Their square roots keep it at 1, smoothed ones are `power`. Ours, `fade`, lets impulses come and go
one by one instead, which keeps all statistics, the kurtosis too. Bars are two standard errors. The derivation is at `ScaleFade`
(`src/solidnoise/noise/point/scale_fade.h`).
""")


def draw_strip(data, page):
    figure, axes = plt.subplots(3, 1, figsize=(11, 6.2), height_ratios=(2, 2, 1.3), constrained_layout=True)
    show(axes[0], data["strip_fade"], "ours", -3, 3)
    show(axes[1], data["strip_paper"], "with the paper's weights", -3, 3)
    for axis in axes[:2]:
        axis.set_aspect("auto")
    strip = data["strip"]
    axes[2].plot(strip["fade"], label="RMS of a column, ours")
    axes[2].plot(strip["paper"], label="RMS, the paper's weights")
    axes[2].plot(strip["alpha"], "k:", linewidth=1, label="alpha")
    axes[2].set(xlim=(0, len(strip["alpha"]) - 1), ylim=(0, 1.5), xlabel="column (pixels)")
    axes[2].legend(fontsize=10, ncol=3, loc="upper center")
    page.write("""
## Figure 15: a strip over four levels
F0 goes from 0.03125 at the left to 0.25 cycles per pixel at the right in equal ratios, as in the paper, with a bandwidth of one octave. Alpha is
where between two grids a column is. With the paper's weights the contrast falls and rises between any two grids; with ours it stays.
Ours is the library's noise of surfaces, on a plane; the paper's is summed by the definition. The curves are means over 2048 and 1024 rows.
""")
    page.photo(figure, "strip", "Spatially varying noise over four grid levels")


def draw_plane(data, page):
    rows = data["plane"]
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.4), constrained_layout=True)
    for axis, name, title in ((axes[0], "sampled", "one sample per pixel"),
                              (axes[1], "filtered", "filtered, closed form"),
                              (axes[2], "averaged", "the same filter, 144 samples per pixel")):
        show(axis, data["plane_" + name], title, -3, 3)
    page.write("""
## Figure 8: a tilted plane, filtered
The plane runs towards the horizon at the top. The paper filters with a Gaussian in the place of the isotropic kernel; the product of an isotropic
kernel and an isotropic Gaussian filter is an isotropic kernel again, exactly (`gaussian_filter.h`), so nothing is approximated here
but the filter's footprint, which is round as in the paper: half a pixel along the view.
""")
    page.photo(figure, "plane", "A tilted plane, unfiltered, filtered and averaged")
    near = rows["cycles_per_pixel"] < 1
    page.write(f"""
Filtered and averaged differ by an RMS of {np.sqrt(np.mean(rows['difference'][near] ** 2)):.4f} standard deviations of the noise where a pixel along
the view holds less than one cycle; beyond, 144 samples are too few, and the closed form is still right.
""")


def write(data, page):
    page.write("""
# Improving Gabor Noise
Lagae, Lefebvre and Dutré, IEEE TVCG 17 (8), 2011. Figures and numbers of the paper, made again by
`scripts/reproduce.sh`; the numbers below are asserted, in smaller versions, by `tests/papers`. Lengths are in pixels and frequencies in cycles per
pixel, as in the paper.
""")
    write_radii(data, page)
    write_speed(data, page)
    draw_kernels(data, page)
    draw_noises(data, page)
    draw_perlin(data, page)
    draw_plane(data, page)
    draw_errors(data, page)
    draw_truncation(data, page)
    draw_impulses(data, page)
    draw_transition(data, page)
    draw_strip(data, page)
    page.write("""
## Figure 16: rust and scales
Spatially varying noise on surfaces, steered by curvature: [meshnoise](../meshnoise.md) has the commands, and our own meshes.

| ![Rust](../rust.png) | ![Scales](../scales.png) |
|---|---|

## Slips of the paper, for whoever implements it
| equation | what is meant |
|---|---|
| 4 | the sum of the two Gaussians, at plus and minus the frequency |
| 12 | the factor is 2 pi^((n-1)/2) / Gamma((n-1)/2); the printed one is right for n = 3 only |
| 18, 19 | the conditions are the other way round |
| 21, 23 | integrals over a volume need r^(n-1) |
| 25, 26 | weights of powers; amplitudes take their square roots |
| 43, 45 | the exponent has the square of F0 |
| 47 | the envelope has a factor of 2, as in eq. 51 |
| 4D radius | said to have no solution; Lambert's W solves it as in 2D and 3D |
""")
