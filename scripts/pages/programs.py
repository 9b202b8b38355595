"""programs.py TOOLS DATA: times whole runs of the programs, into DATA/programs.csv: wall and processor seconds, medians, and MB.
programs.py sphere FILE.ply: writes a sphere of a million vertices, in a process of its own: what a parent holds counts as its children's."""

import csv
import os
import statistics
import subprocess
import sys
import tempfile
import time

REPETITIONS = 5


def vdbnoise(side, threads):
    return ["vdbnoise", "--raw", "--dim", str(side), "--out", "out.vdb", "--force", "--quiet", "--threads", str(threads)]


def meshnoise(threads):
    return ["meshnoise", "bake", "sphere.ply", "--out", "out.ply", "--force", "--quiet", "--threads", str(threads)]


def write_sphere(path, rings=708, segments=1412):
    import numpy as np

    theta = np.linspace(0.0, np.pi, rings + 2)[1:-1]
    phi = np.linspace(0.0, 2.0 * np.pi, segments, endpoint=False)
    t, p = np.meshgrid(theta, phi, indexing="ij")
    points = np.stack([np.sin(t) * np.cos(p), np.cos(t), np.sin(t) * np.sin(p)], axis=-1).reshape(-1, 3)
    points = np.concatenate([points, [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]]]).astype("<f4")
    i, j = np.meshgrid(np.arange(rings - 1), np.arange(segments), indexing="ij")
    a, b = i * segments + j, i * segments + (j + 1) % segments
    quads = [np.stack([a, b, b + segments], -1), np.stack([a, b + segments, a + segments], -1)]
    j = np.arange(segments)
    k = (j + 1) % segments
    top, bottom, last = rings * segments, rings * segments + 1, (rings - 1) * segments
    caps = [np.stack([np.full_like(j, top), k, j], -1), np.stack([np.full_like(j, bottom), last + j, last + k], -1)]
    faces = np.concatenate([part.reshape(-1, 3) for part in quads + caps])
    rows = np.empty(len(faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    with open(path, "wb") as file:
        file.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
                    f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n").encode())
        points.tofile(file)
        rows.tofile(file)


def measure(tools, command, folder):
    walls, processors, memory = [], [], 0
    for _ in range(REPETITIONS):
        begin = time.monotonic()
        process = subprocess.Popen([os.path.join(tools, command[0])] + command[1:], cwd=folder)
        _, status, usage = os.wait4(process.pid, 0)
        walls.append(time.monotonic() - begin)
        if status != 0:
            raise SystemExit(f"programs: {' '.join(command)} failed")
        processors.append(usage.ru_utime + usage.ru_stime)
        memory = max(memory, usage.ru_maxrss / 1024)
    return statistics.median(walls), statistics.median(processors), memory


def main():
    tools, data = os.path.abspath(sys.argv[1]), sys.argv[2]
    runs = [(f"vdbnoise, {side}^3", threads, vdbnoise(side, threads)) for side in (64, 128, 256, 512) for threads in (1, 2)]
    runs += [("meshnoise, 1 M vertices", threads, meshnoise(threads)) for threads in (1, 2)]
    with tempfile.TemporaryDirectory() as folder, open(os.path.join(data, "programs.csv"), "w", encoding="utf-8") as file:
        subprocess.run([sys.executable, __file__, "sphere", os.path.join(folder, "sphere.ply")], check=True)
        table = csv.writer(file)
        table.writerow(["what", "threads", "wall", "processor", "memory", "command"])
        for what, threads, command in runs:
            wall, processor, memory = measure(tools, command, folder)
            table.writerow([what, threads, f"{wall:.3f}", f"{processor:.3f}", f"{memory:.0f}", " ".join(command)])
            print(f"{what}, {threads} threads: {wall:.3f} s")


if sys.argv[1] == "sphere":
    write_sphere(sys.argv[2])
else:
    main()
