"""programs.py TOOLS DATA: times whole runs of the programs, into DATA/programs.csv: wall and processor seconds of the quickest, MB at
most and MB of the result in memory; and its stages, into DATA/stages.csv. Files are in memory where there is room: disks differ.
programs.py pebble FILE.ply: writes a mesh of a million vertices, in a process of its own: what a parent holds counts as its children's."""

import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

REPETITIONS = 10


COMMANDS = [  # what, its command, MB of the result: 4 bytes a voxel; positions and corners in double precision and 32 bits
    *((f"vdbnoise, {side}^3", f"vdbnoise --raw --dim {side} --out out.vdb", 4 * side**3 / 2**20) for side in (64, 128, 256, 512)),
    *((f"vdbnoise --exact, {side}^3", f"vdbnoise --raw --exact --dim {side} --out out.vdb", 4 * side**3 / 2**20) for side in (256, 512)),
    *((f"vdbnoise --codec none, {side}^3", f"vdbnoise --raw --codec none --dim {side} --out out.vdb", 4 * side**3 / 2**20)
      for side in (256, 512)),
    ("vdbnoise, the default cloud", "vdbnoise --out out.vdb", 0.0),
    ("meshnoise, 1 M vertices", "meshnoise bake pebble.ply --out out.ply", (24 + 2 * 3 * 4) * 1e6 / 2**20),
]


def write_pebble(path, rings=708, segments=1412):
    """A sphere with dents. On a perfect one, the noise would follow the digits in which curvatures differ."""
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
    dents = np.prod(np.sin(points * (7.0, 6.0, 8.0) + (0.0, 1.0, 2.0)), axis=1, keepdims=True)
    points = (points * (1.0 + 0.08 * dents)).astype("<f4")
    with open(path, "wb") as file:
        file.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
                    f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n").encode())
        points.tofile(file)
        rows.tofile(file)


def stages_of(printed):
    """What --timings printed: seconds and seconds of processor by stage."""
    found = re.findall(r"^(\w+) +([\d.]+) s +([\d.]+) s of processor", printed, re.MULTILINE)
    return {name: (float(wall), float(processor)) for name, wall, processor in found}


def measure(tools, command, folder):
    walls, processors, memory, stages = [], [], 0, []
    for _ in range(REPETITIONS):
        begin = time.monotonic()
        with open(os.path.join(folder, "timings"), "w+", encoding="utf-8") as printed:
            process = subprocess.Popen([os.path.join(tools, command[0])] + command[1:] + ["--timings"], cwd=folder, stderr=printed)
            _, status, usage = os.wait4(process.pid, 0)
            printed.seek(0)
            stages.append(stages_of(printed.read()))
        walls.append(time.monotonic() - begin)
        if status != 0:
            raise SystemExit(f"programs: {' '.join(command)} failed")
        processors.append(usage.ru_utime + usage.ru_stime)
        memory = max(memory, usage.ru_maxrss / 1024)
    quickest = walls.index(min(walls))
    return walls[quickest], processors[quickest], memory, stages[quickest]


def roomy_folder():
    room = 2 * 2**30
    return "/dev/shm" if os.path.isdir("/dev/shm") and shutil.disk_usage("/dev/shm").free > room else None


def main():
    tools, data = os.path.abspath(sys.argv[1]), sys.argv[2]
    with (tempfile.TemporaryDirectory(dir=roomy_folder()) as folder,
          open(os.path.join(data, "programs.csv"), "w", encoding="utf-8") as runs_file,
          open(os.path.join(data, "stages.csv"), "w", encoding="utf-8") as stages_file):
        subprocess.run([sys.executable, __file__, "pebble", os.path.join(folder, "pebble.ply")], check=True)
        runs, of_runs = csv.writer(runs_file), csv.writer(stages_file)
        runs.writerow(["what", "threads", "wall", "processor", "memory", "result", "command"])
        of_runs.writerow(["what", "threads", "stage", "wall", "processor"])
        for what, command, result in COMMANDS:
            for threads in (1, 2):
                run = command.split() + ["--force", "--quiet", "--threads", str(threads)]
                wall, processor, memory, stages = measure(tools, run, folder)
                runs.writerow([what, threads, f"{wall:.3f}", f"{processor:.3f}", f"{memory:.0f}", f"{result:.0f}", " ".join(run)])
                for stage, (stage_wall, stage_processor) in stages.items():
                    of_runs.writerow([what, threads, stage, stage_wall, stage_processor])
                print(f"{what}, {threads} threads: {wall:.3f} s")


if sys.argv[1] == "pebble":
    write_pebble(sys.argv[2])
else:
    main()
