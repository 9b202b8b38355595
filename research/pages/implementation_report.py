"""implementation_report.py DATA DOCS VERSION: the page and pictures of "Gabor Noise Implementation Report"."""

import os
import sys

from PIL import Image

from drawing import Data, Page, table

PRINTED = {
    (256, 64): (0.4718, 0.5158, 0.4269), (256, 128): (0.7509, 0.9037, 0.6426), (256, 256): (1.5623, 1.6565, 1.3088),
    (512, 64): (1.6646, 1.7880, 1.4999), (512, 128): (2.9524, 3.42392, 2.72044), (512, 256): (5.6698, 6.9188, 5.2503),
}


def main():
    folder, docs = sys.argv[1], sys.argv[2]
    data, page = Data(folder), Page("implementation-report", docs)
    page.write("""
# Gabor Noise Implementation Report
Ling, a report for a course. Its figures and its table, made again by `scripts/reproduce.sh`. F0 = 0.0625 and a = 0.0443528 per pixel, as in
[Improving Gabor Noise](improving-gabor-noise.md).

## Figures 1 to 3: three noises
Each has four panels: the noise, its kernel, and the magnitudes of their Fourier transforms below, frequency 0 in the middle.
""")
    names = (("report_anisotropic", "anisotropic"), ("report_isotropic", "isotropic"),
             ("report_isotropic_kernel", "isotropic-kernel"))
    cells = []
    for source, name in names:
        image = Image.open(os.path.join(folder, source + ".png")).convert("RGB")
        image.save(os.path.join(docs, f"{page.name}-{name}.jpg"), quality=75, optimize=True)
        cells.append(f"![{name}]({page.name}-{name}.jpg)")
    page.write(table(["anisotropic noise", "isotropic noise, anisotropic kernel", "isotropic noise, isotropic kernel"], [cells]))
    page.write("""
The transforms of the noises fill those of their kernels: a pair of spots, a ring of spots from all directions, and a ring. The second panel of the middle one is
the kernel of one direction.

## Table I: seconds
Printed: four threads of a Core i7-6500U at 2.5 GHz. Ours: processor time of one thread of the machine below, making of the impulses included, with the same impulses per unit of
area. A cell of the report is as wide as the radius at which the Gaussian is at 5 %, 22 pixels. "Procedure" is the papers' way, point by point
(`tests/reference/gabor_reference.h`, double precision).
""")
    speed = data.table("report_speed")
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
    page.save(sys.argv[3])


main()
