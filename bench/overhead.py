"""overhead.py LATTICE_CASE: what a call from Python takes more than the library's, for 128^3 samples by one thread. Both are run in turn, and the
quickest of each counts, in time of the processor; PYTHONPATH says where the package is."""

import subprocess
import sys
import time

import solidnoise

ROUNDS, EACH = 12, 5


def python_seconds(noise):
    begin = time.process_time()
    noise.lattice(0, 0.01, 128, threads=1)
    return time.process_time() - begin


def main():
    noise = solidnoise.gabor(frequency=4, impulses=32)
    library, python = [], []
    for _ in range(ROUNDS):
        printed = subprocess.run([sys.argv[1], str(EACH)], capture_output=True, text=True, check=True).stdout
        library += map(float, printed.split())
        python += [python_seconds(noise) for _ in range(EACH)]
    best, from_python = min(library), min(python)
    print(f"128^3 samples, one thread: {1e3 * best:.2f} ms, from Python {1e3 * from_python:.2f} ms, {100 * (from_python / best - 1):+.1f} %")


main()
