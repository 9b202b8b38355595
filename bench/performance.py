"""performance.py DATA DOCS VERSION: docs/performance.md and its curves, from what bench.sh measured."""

import csv
import json
import os
import re
import statistics
import sys

from drawing import Page, plt, table


def rows(data, name):
    with open(os.path.join(data, name), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def nanoseconds(data):
    """Medians per sample, by the benchmark's name."""
    with open(os.path.join(data, "times.json"), encoding="utf-8") as file:
        runs = json.load(file)["benchmarks"]
    samples = {}
    for run in runs:
        if run["run_type"] == "iteration":
            name = run["run_name"].split("/repeats:")[0].split("/real_time")[0]
            samples.setdefault(name, []).append(1e9 / run["items_per_second"])
    return {name: statistics.median(values) for name, values in samples.items()}


def goal(times):
    return f"{float(times):g}" if float(times) else ""


def curve(times, pattern):
    """Times of the benchmarks whose name fits, against the number in it."""
    points = sorted((int(match[1] or 1), time) for name, time in times.items() if (match := re.fullmatch(pattern, name)))
    return [x for x, _ in points], [y for _, y in points]


def stages(data):
    """A row for each run: seconds of its stages, and the shares that are to be small."""
    runs = {}
    for row in rows(data, "stages.csv"):
        runs.setdefault((row["what"], row["threads"]), {})[row["stage"]] = (float(row["wall"]), float(row["processor"]))
    result = []
    for (what, threads), run in runs.items():
        total = run["all"][0]
        cells = [what, threads]
        for names in (("start",), ("reading", "plan"), ("noise",), ("tree", "colors"), ("writing",), ("end",)):
            cells.append(f"{sum(run[name][0] for name in names if name in run):.3f}")
        cells.append(f"{100 * (1 - run['noise'][0] / total):.0f} %")
        if threads == "2":
            # With s seconds of one thread and p of two, the clock shows s + p and the processor s + 2 p.
            alone = {name: max(0.0, 2 * wall - processor) for name, (wall, processor) in run.items() if name != "all"}
            worst = max(alone, key=alone.get)
            cells += [f"{100 * sum(alone.values()) / total:.0f} %", f"{worst}, {100 * alone[worst] / total:.0f} %"]
        else:
            cells += ["", ""]
        result.append(cells)
    return result


def mark(row):
    return " (-)" if row["at_least"] and float(row["times"]) < float(row["at_least"]) else ""


def draw_curves(times, page):
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.8), constrained_layout=True)
    for suffix, label, color in (("direct", "every voxel summed", "C0"), ("budget", "within 2 %, interpolated", "C1")):
        for radius, style in (("16", "o-"), ("64", "o--")):
            axes[0].plot(*curve(times, rf"gabor/3/isotropic/N(\d+)/R{radius}/{suffix}"), style, color=color, label=f"{label}, R{radius}")
        axes[1].plot(*curve(times, rf"gabor/3/isotropic/N32/R(\d+)/{suffix}"), "o-", label=label)
        axes[2].plot(*curve(times, rf"gabor/3/isotropic/N32/R16(?:x(\d+))?/{suffix}"), "o-", label=label)
    for axis, title in zip(axes, ("impulses per kernel N", "kernel radius in voxels R, N32", "octaves, the highest R16 N32")):
        axis.set_xscale("log", base=2)
        axis.set_xticks(axis.lines[0].get_xdata(), [str(x) for x in axis.lines[0].get_xdata()])
        axis.minorticks_off()
        axis.set_yscale("log", base=2)
        axis.yaxis.set_major_formatter("{x:g}")
        axis.set_xlabel(title)
    axes[0].set_ylabel("ns per voxel, one thread")
    axes[0].legend(fontsize=8)
    page.picture(figure, "curves", "Time per voxel against impulses, radius and octaves")


def main():
    data, docs, version = sys.argv[1:]
    times = nanoseconds(data)
    page = Page("performance", docs)
    page.write("""
# Performance
`scripts/bench.sh` makes this page. Times are nanoseconds per sample of one thread, medians, with everything that a volume needs
included: random impulses, culling, sums. "Scalar" are the papers' procedures, in single precision, point by point, in the same
run; so are all ratios. Repetitions of the two sides take turns; intervals hold the median with a probability of 95 %, whatever
the scatter. R is the kernel's radius in voxels, N the impulses in it. "At least" and "aim" are what was to be reached; what
is below it is marked (-).
""")
    page.write(table(["", "ns, slow", "ns, fast", "times", "95 % interval", "at least", "aim"],
                     [[r["title"], f"{float(r['slow']):.4g}", f"{float(r['fast']):.3g}", f"**{float(r['times']):.3g}**{mark(r)}",
                       f"{float(r['lower']):.3g} to {float(r['upper']):.3g}", goal(r["at_least"]), goal(r["aim"])]
                      for r in rows(data, "ratios.csv")]))
    page.write("""
## What noise costs within an error of 2 %
Each voxel summed, or, as volumes are made, from as few samples as the error allows and interpolated: the larger the kernel in voxels, the
fewer samples there are, so that lower octaves cost next to nothing. Small kernels are summed at every voxel; they are a little larger
than those that have the whole error for themselves. Gradients are made from samples of the values, and have the values with them.

"Equal quality" are noises that look alike: Kensler's at 12 voxels per cell, and Gabor noises of its frequency, of its width (0.9 octaves). Kensler's
has an excess kurtosis of -0.14, is not stationary and cannot be interpolated. Gabor noises have the impulses of the default, of excess kurtosis 0,
or Poisson processes of 0.01 (isotropic) and 0.03, with as many values past four standard deviations, or a few more. FastNoise2 1.1.1 takes 2.3 ns for its Perlin noise in 3D
(AVX-512, one thread of the machine whose direct isotropic R16 N32 took 10.8).
""")
    draw_curves(times, page)
    page.write("""
## Whole runs
Start, noise, tree, statistics, compression and file; the quickest of ten. The noise is of one octave, 8 cycles per unit in a box of 2 units, as
`--raw` makes it. The memory of the result is that of the voxels' values, or of the mesh's positions and corners. The rest is, of volumes,
what a grid has beside values (5 %), the mask of its voxels and lists of its leaves (10 %), samples to interpolate from, and 36 MB of
OpenVDB's libraries; of meshes, connectivity and curvature, some 600 bytes per vertex while it is measured and smoothed.
""")
    page.write(table(["", "threads", "seconds", "of processor", "MB at most", "of the result", "command"],
                     [[r["what"], r["threads"], r["wall"], r["processor"], r["memory"], r["result"] if r["result"] != "0" else "",
                       f"`{r['command']}`"] for r in rows(data, "programs.csv")]))
    page.write("""
## Where the time of a run goes
Seconds of the stages that `--timings` prints, of the same runs. *Noise* has making and measuring the leaves in it;
*tree* joins them (of meshes: colours and displacement); *writing* compresses and writes. The file is in memory: a disk adds its own time.
*Outside* is all that is not noise. *One thread* is the share of the time in which only one of two works, or none, and in which stage most
of it: what else runs on the machine adds to it. The start is loading OpenVDB's library, whose references are resolved by name.
""")
    page.write(table(["", "threads", "start", "plan", "noise", "tree", "writing", "end", "outside", "one thread", "most of it"], stages(data)))
    page.write("""
## Instructions
Of one block, counted by `valgrind --tool=callgrind` on the instruction set that it knows (AVX2): the same number on every run and under any load,
so that a change for the worse shows on any machine.
""")
    page.write(table(["case", "voxels", "instructions per voxel"],
                     [[r["case"], r["voxels"], f"{float(r['instructions']) / float(r['voxels']):.1f}"]
                      for r in rows(data, "instructions.csv")]))
    page.save(version, "scripts/bench.sh")


main()
