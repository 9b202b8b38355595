"""The page and pictures of "Impulses in strata"."""

import math

from pages.drawing import plt, table

KINDS = ("isotropic kernels", "random directions")
BEYOND = {3: math.erfc(3 / math.sqrt(2)), 4: math.erfc(4 / math.sqrt(2))}  # shares of a Gaussian


def measured(value, error, digits):
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def draw_sides(data, page):
    sides = data["strata_sides"]
    figure, axes = plt.subplots(1, 2, figsize=(10, 3.4), sharey=True, constrained_layout=True)
    for axis, name, kind in zip(axes, ("isotropic", "directions"), KINDS):
        for n in range(1, 5):
            line, = axis.plot(sides["side"], sides[f"{name}{n}"], label=f"n = {n}")
            axis.plot(sides["side"], sides[f"{name}{n}_mirrored"], color=line.get_color(), linestyle="dashed")
        axis.axhline(0, color="black", linewidth=1)
        axis.set(title=kind, xlabel="side of an impulse's own cube, times a", xlim=(0, 2))
    axes[0].set(ylabel="fourth cumulant / Poisson's", ylim=(-2.1, 1.1))
    axes[0].legend()
    page.write("""
## Theory
A Gabor noise is the sum of w g(x - x_i) at random places x_i, their weights w or phases independent and of mean 0. The papers take the
places from a Poisson process. Here space is cut into cubes of side c with the same number m of impulses each, at independent uniform places or in pairs of a place and its mirror image
at the cube's centre (isotropic kernels and waves of a given direction, from three dimensions on); planes, rows and cubes of them are shifted at random, so that the process is stationary over the seeds. Directions are spread over the impulses of a cube, each uniform over all. Two different impulses are independent in their signs or phases and never correlate, so

- the covariance, and so the spectrum, is density x autocorrelation of g, exactly that of the Poisson process;
- the fourth cumulant is not. With M(x) = E g(x)^2 and Q(x) = E g(x)^4, means over the marks, and h the uniform density of a cube,

      kappa_4 = density (integral of Q - 3 integral of (h * M)^2),

  of independent places, for of the pairs of impulses that a Poisson process has in a cube, m^2 on the mean, strata have m (m - 1); and with P(p) the mean over places x in a cube of M(p - x) M(p + x)

      kappa_4 = density (integral of Q - 3 integral of (2 (h * M)^2 - P))

  of mirrored ones.

What is taken falls as the cubes grow, from infinitely fine ones, which are too even, to none at all, which is the Poisson process. Where the two terms cancel, the cubes are *balanced*: the
excess kurtosis is 0 whatever the density. Below, kappa_4 over that of a Poisson process, in closed form (`research/papers/strata.py`, again), F0 = 1, one octave, against density^(-1/n); dashed lines are of mirrored impulses. Narrow peaks of isotropic kernels need smaller cubes.

Two impulses that are mirrored are farther apart than two that are not, the square of their distance is twice as large: of mirrored ones larger cubes are balanced. Isotropic kernels take 0.83 times the impulses in 3D and 0.69 times in 4D, waves of random phase
0.71 and 0.54 times, on surfaces 0.78 and 0.71 times. In two dimensions they would take 0.95 times, with tails that are too short (0.4 of a Gaussian's values past four standard deviations, or fewer), on a line more. Waves in random directions are mirrored in four dimensions alone, where there are many: in three, 14 in place of 19 leave the values as near to Gaussian, but not their directions. Folds of single waves would be seen.
""")
    page.picture(figure, "sides", "The fourth cumulant against the side of the cubes")
    page.write("""
## Each kernel
What enters is M, Q and S(x) = E g(x)^6, means over the marks:

- **Waves of random phase** under an envelope E: M = E^2 / 2, Q = 3 E^4 / 8, S = 5 E^6 / 16, whatever their directions and frequencies are. One direction, cones and all directions have the same kurtosis, and so has a band of a spectrum
  whose components share an envelope. Under exp(-pi a^2 r^2), kappa_4 is 1 - 2 T of the Poisson process', T = (E sinc^2(f c))^n, f normal of variance a^2 / 2 pi.
- **Isotropic kernels** with weights w: M = E w^2 g^2, Q = E w^4 g^4. Signs have E w^4 = (E w^2)^2. Of uniform weights it is 9 / 5 of that: so much more of the first term, smaller balanced cubes and more impulses.
- **Sums of independent noises**, octaves and the bands of spectra: fourth and sixth cumulants add up, so that the excess kurtosis is the sum of A_i^4 kurtosis_i over the square of the sum of A_i^2.
- **Surfaces** take kernels of the tangent plane from a layer around it: M is that of the plane times the square of a window of the distance. The layer lies in any direction in the cubes: the overlap is the mean over all, the kurtosis given the place that of a layer along the planes, where it is most.
- **Parameters that vary** have impulses in two grids of sides 2 : 1, which fade into each other as the frequency changes. A cell has one impulse in each of its 2^n orthants, and one with its turn in each 2^-n-th of the fade; which orthant has which turn is random (narrow bands: of 4^n or 8^n pieces).
  So what fades together is as even as in large cubes, all of it as in small ones, with F the mean of fade^2 over the turns and V the variance of its means over the parts: density x 3 ((F^2 - V / (2^n - 1)) o(c / 2) + 2^n / (2^n - 1) V o(c)), o(c) the integral of (h * M)^2 for cubes of side c. Cubes are balanced on the mean over an octave of
  frequencies; within it the excess kurtosis goes up and down by 0.06 in three dimensions and 0.02 in four. Whole cubes with turns in parts would need more than twice the impulses for that; impulses are not mirrored here, which would save a fifth of them, but with ups and downs twice as large.

The sixth cumulant adds up cube by cube, too:

    kappa_6 = density (integral of S - 15 integral of (h * Q)(h * M) + 30 integral of (h * M)^3)

of independent places, of mirrored ones density x the integral of S + 15 R - 30 (h * Q)(h * M) - 90 P (h * M) + 120 (h * M)^3, R(p) the mean of Q(p - x) M(p + x).
Over the cube of the variance, of waves in balanced cubes: 0.18, 0.64 and 1.02 times (a^n / density)^2 in 2, 3 and 4 dimensions, mirrored 0.15 and 0.62 times in 3 and 4; 3.3, 3.8 and 4.4 times of a Poisson process. By Edgeworth's series there are 1 + 9.2 kurtosis + 2.6 kappa_6 times as many values beyond four
standard deviations as a Gaussian field has.

*What gave nothing*: signs or phases that are balanced in each cube. kappa_4 is of how the sum of squared kernels differs from place to place, and squares stay what they are, while impulses of one cube would correlate and change the spectrum. Nor did four or eight impulses that are each other's images in planes or by half turns, which take more impulses, or pairs half a cube apart, which take fewer, but leave 1.5 (random directions) and 1.7 times (isotropic kernels) a Gaussian's values past four standard deviations in 3D. *What was not needed*: counts that are not whole. Any density is met by the side,
(count / density)^(1/n) with the count rounded, off from balanced by half an impulse in a cube at most.

## Where it ends
Narrow bands of isotropic kernels, most in 4D, would need cubes far smaller than a wave. Where balanced cubes would take more impulses than a Poisson process of excess kurtosis 1/2, as random directions in 4D do, too, or four times as many where parameters vary, there are as few as leave
0.02, but at most ten times, which is enough in three dimensions from 0.1 octaves on, where parameters vary from 0.2, and leaves 0.05 at most. What is left is told as the noise's excess kurtosis. In wide bands cubes have more than balanced ones need, for the place's sake (below). Isotropic kernels,
impulses over those of a Poisson process of excess kurtosis 1/2:
""")
    bands = data["strata_bands"]
    page.write(table(("dimensions", "octaves", "balanced cubes", "ours", "our excess kurtosis"),
                     [(f"{n:.0f}", f"{octaves:.1f}", f"{balanced:.2f}", f"{ours:.2f}", f"{kurtosis:.3f}")
                      for n, octaves, balanced, ours, kurtosis in zip(*bands.values())]))


def write_ensembles(data, page):
    values = data["strata_ensembles"]
    rows = []
    tails = []
    for i, n in enumerate(values["n"]):
        name = f"{n:.0f}D, {KINDS[int(values['kind'][i])]}"
        process = "Poisson" if values["poisson"][i] else "strata"
        rows.append([name, process, f"{values['impulses'][i]:.1f}", "" if values["poisson"][i] else f"{values['side'][i]:.2f}",
                     measured(1e4 * values["mean"][i], 1e4 * values["mean_error"][i], 1),
                     measured(values["variance"][i], values["variance_error"][i], 4), f"{values['closed'][i]:.3f}",
                     measured(values["kurtosis"][i], values["kurtosis_error"][i], 3)])
        tails.append([name, process])
        for k, share in BEYOND.items():
            closed = "" if values["poisson"][i] else f"{values[f'closed_{k}'][i]:.2f}"
            tails[-1] += [closed, measured(values[f"beyond_{k}"][i] / share, values[f"beyond_{k}_error"][i] / share, 2)]
    page.write("""
## Ensembles
400 seeds of 4096 places each, 1.1 radii apart; errors are those of 20 batches of seeds. Each noise is beside the Poisson process of as many impulses. Impulses are those in the ball that a kernel fills at an
error of 2 %.
""")
    page.write(table(["noise", "process", "impulses", "c a", "mean, 10^-4", "variance", "excess kurtosis, closed form", "measured"], rows))
    page.write(f"""
The variance is 1 by the closed form. The share of values beyond 3 and 4 standard deviations over a Gaussian's, {BEYOND[3]:.3g} and {BEYOND[4]:.3g}; what is not 1 is the sixth
cumulant's. The closed form is Edgeworth's series of both cumulants, where they are small:
""")
    page.write(table(["noise", "process", "beyond 3, closed form", "measured", "beyond 4, closed form", "measured"], tails))


def write_elsewhere(data, page):
    values = data["strata_elsewhere"]
    rows = []
    for i, name in enumerate(values["names"]):
        tails = [measured(values[f"beyond_{k}"][i] / share, values[f"beyond_{k}_error"][i] / share, 2) for k, share in BEYOND.items()]
        rows.append([name, measured(1e4 * values["mean"][i], 1e4 * values["mean_error"][i], 1), measured(values["variance"][i], values["variance_error"][i], 4),
                     measured(values["kurtosis"][i], values["kurtosis_error"][i], 3), *tails])
    page.write("""
The same on surfaces, planes of any direction, with a frequency or with one of its own at each place, over an octave, and of noise by example, of `examples/exemplars/moss.jpg`; and of
four octaves, a gain of 0.5, whose later ones have fewer impulses (an excess kurtosis within 0.15 each, which counts little in the sum). Each with the impulses that it has by default:
""")
    page.write(table(["noise", "mean, 10^-4", "variance", "excess kurtosis", "beyond 3", "beyond 4"], rows))


def write_spectra(data, page):
    values = data["strata_spectra"]
    rows = [[f"{n:.0f}D, {KINDS[int(values['kind'][i])]}"] + [measured(values[f"band_{band}"][i], values[f"band_{band}_error"][i], 3) for band in range(1, 8)]
            for i, n in enumerate(values["n"])]
    page.write("""
The power spectrum over that of the Poisson process, in bands of frequencies, 400 seeds each:
""")
    page.write(table(["noise"] + [f"{band / 4:g} to {(band + 1) / 4:g} F0" for band in range(1, 8)], rows))


def draw_places(data, page):
    values = data["strata_places"]
    figure, axes = plt.subplots(1, 2, figsize=(10, 3.2), sharey=True, constrained_layout=True)
    for kind, axis in enumerate(axes):
        rows = values["kind"] == kind
        axis.errorbar(values["place"][rows], values["kurtosis"][rows], values["kurtosis_error"][rows], fmt="o", markersize=4, label="measured")
        axis.plot(values["place"][rows], values["closed"][rows], label="closed form")
        axis.set(title=KINDS[kind] + ", 2D", xlabel="place between two planes of cubes", xlim=(0, 1))
    axes[0].set_ylabel("excess kurtosis")
    axes[0].legend()
    page.write("""
## Given the place
All cubes along the first axis are shifted by one number, so that in one noise a plane of them is a place like no other: given how far it is from there, the variance is what it is everywhere, but the fourth
cumulant has the harmonics of (h * M)^2 along the planes' normal. Measured by a sum of kernels in such cubes, in NumPy, with the library's numbers of impulses. The library takes the fewest impulses for which the excess kurtosis is within 1/4 of its mean wherever in the planes one is.
""")
    page.picture(figure, "places", "The excess kurtosis given the place")


def write_windows(data, page):
    values = data["strata_windows"]
    rows = []
    for kind, name in enumerate(KINDS):
        for poisson in (0, 1):
            these = (values["kind"] == kind) & (values["poisson"] == poisson)
            rows.append([f"{name}, {'Poisson' if poisson else 'strata'}, {values['impulses'][these][0]:.0f} impulses"]
                        + [measured(value, error, 2) for value, error in zip(values["spread"][these], values["spread_error"][these])])
            sides = values["side"][these]
    page.write("""
## Windows
The variance of a square window's mean square, over that of a Gaussian field of the same covariance, 2 integral of C(x - y)^2 over the window squared; 2D, 200 seeds of 32 radii squared.
""")
    page.write(table(["side of the window, radii"] + [f"{side:.0f}" for side in sides], rows))
    page.write("""
Where this is below 1, pieces of the noise are more alike than those of a Gaussian field, whose spread no normalisation by closed form can take away; those of a Poisson process are less alike.
""")


def write_drafts(data, page):
    values = data["strata_drafts"]
    errors = list(dict.fromkeys(values["error"]))
    rows = []
    for n in range(1, 5):
        for kind, name in enumerate(KINDS):
            these = (values["n"] == n) & (values["kind"] == kind)
            rows.append([f"{n}D, {name}"] + [f"{difference:.4f}, {correlation:.5f}" for difference, correlation
                                             in zip(values["difference"][these], values["correlation"][these])])
    page.write("""
## Drafts and finals
Impulses are chosen by the kernel of unlimited support, so that the error that is allowed (`--error`) moves none of them: a draft shows the final. The root mean square of the difference from the noise of
error 0.002, over its own, and the correlation with it, 16 seeds. Truncation takes 0.87 of what is allowed, interpolation, which is not used here, the rest:
""")
    page.write(table(["error of the draft"] + [f"{error:g}" for error in errors], rows))


def write(data, page):
    page.write("""
# Impulses in strata
How the library places the impulses of Gabor noise, and what that does; of no paper, but after what the papers on [Gabor noise](improving-gabor-noise.md) leave open. Made by `scripts/reproduce.sh`; the numbers are asserted, in smaller versions, by
`tests/papers/`. Kernels in 1 to 4 dimensions, one wave a unit (F0 = 1), bandwidth one octave; *isotropic kernels* have random signs, *random directions* are waves of random direction and phase under a Gaussian.
""")
    draw_sides(data, page)
    write_ensembles(data, page)
    write_elsewhere(data, page)
    write_spectra(data, page)
    draw_places(data, page)
    write_windows(data, page)
    write_drafts(data, page)
    page.write("The derivations are in `src/solidnoise/noise/kernel/impulse_strata.h` and `cube_averages.h`.")
