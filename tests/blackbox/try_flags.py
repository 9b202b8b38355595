#!/usr/bin/env python3
"""try_flags.py TOOLS_FOLDER PROJECT_FOLDER [--every N] [--only COMMAND] [--seed S]: reads --help-all of each program and subcommand, and gives
every flag that takes a value each of the values that break things, one at a time, to a small run that works without it.

Whatever the value: no signal, an end within 10 s and 1 GB, status 0, 1 or 2; a failure says one line, without control characters, and
leaves nothing behind; one of the command line (status 2) names the flag; a volume that was written holds finite numbers.
--every N tries every N-th case, from the seed on, for short runs; --only a single command, such as "vdbnoise slice"."""

import argparse
import concurrent.futures
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SECONDS, BYTES = 10.0, 1 << 30
NUMBERS = ["0", "-1", "1e-320", "1e-308", "1e-30", "1e-6", "0.05", "1e6", "1e9", "1.8e19", "18446744073709551616", "1e30", "1e300",
           "1e308", "-1e308", "1e309", "nan", "inf", "", "x", "1e", "0x1p3"]
WORDS = ["", "x", "nan", "-1", "1e308", "../..", "/", "a\x1b[31mb", "é" * 2000, "%s%n", "8 8", ","]
EXTREMES = {"FILE": WORDS + ["/dev/null", "/dev/zero", "missing.vdb", "{project}/README.md", "{project}/meshes"]}
NUMBER_NAMES = re.compile(r"^(?:[XYZT][01]?|LOW|HIGH|A|B|COUNT|NUMBER|INTEGER|CYCLES|UNITS|OCTAVES|FREQUENCY|SPEED|RATE|TIME|DEPTH|PEAK|FACTOR|SIZE|"
                          r"DEGREES|PIXELS|TIMES|WIDTH|SAMPLES|VERTICES|EDGE|SIGMAS?|KAPPA|DENSITY|LENGTH|SECONDS|AMOUNT|MINIMUM|MAXIMUM|"
                          r"VOXELS|TURNS|SPACINGS|WAVELENGTHS|EXTINCTION|COLUMNS|ROUNDS|VARIANCE)$")

# A run of each command that works, with {out} in a folder of its own; {mesh}, {picture}, {volume} and {model} are small inputs.
BASES = {
    "vdbnoise": ["--dim", "12", "--out", "{out}.vdb"],
    "vdbnoise --raw": ["--dim", "12", "--out", "{out}.vdb"],
    "vdbnoise --on": ["{volume}", "--out", "{out}.vdb"],
    "vdbnoise slice": ["--resolution", "12", "--out", "{out}.png"],
    "vdbnoise sky": ["--count", "2", "--voxel", "100", "--out", "{out}.vdb"],
    "vdbnoise surface": ["{mesh}", "--dim", "12", "--out", "{out}.vdb"],
    "vdbnoise analyze": ["{volume}"],
    "meshnoise bake": ["{mesh}", "--out", "{out}.ply"],
    "meshnoise curvature": ["{mesh}", "--out", "{out}.ply"],
    "noisefit": ["{picture}", "--out", "{out}.json"],
    "noisefit edit": ["{model}", "--scale", "2", "--out", "{out}.json"],
}
INPUT_NEXT = re.compile(r"^  (-[\w-]+,)?(--[\w-]+)((?: [^\s]+)*?)(?:\s{2,}|$)")


def flags_of(program):
    """[(flag, [placeholder])] of a command's --help-all."""
    text = subprocess.run([*program, "--help-all"], capture_output=True, text=True, check=True).stdout
    found = [(match[2], match[3].split()) for match in map(INPUT_NEXT.match, text.split("\n")) if match]
    return [(flag, values) for flag, values in found if values and flag not in ("--threads", "--max-memory", "--out")]


def cases_of(flag, placeholders):
    needed = re.sub(r"\[[^\]]*\]", "", " ".join(placeholders)).split()  # what may be left out, such as [DEGREES SPREAD], is
    if all(NUMBER_NAMES.match(name) for name in needed):
        for value in NUMBERS:
            yield [flag, *[value] * len(needed)]
        if len(needed) > 1:
            for value in NUMBERS:
                yield [flag, *["1"] * (len(needed) - 1), value]
    else:
        for value in EXTREMES["FILE"]:
            yield [flag, *[value] * len(needed)]


def run(command, folder):
    """(status or -signal, stderr, seconds, peak bytes) of a command that is ended after SECONDS."""
    with open(os.path.join(folder, ".err"), "w+b") as errors:
        began = time.monotonic()
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CORE, (0, 0)))
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - began > SECONDS * 3:  # processor time is what counts; machines may be busy
                os.kill(process.pid, signal.SIGKILL)
            time.sleep(0.005)
        errors.seek(0)
        text = errors.read().decode(errors="replace")
    os.unlink(os.path.join(folder, ".err"))
    return os.waitstatus_to_exitcode(status), text, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def faults_of(command, flag, output, folder):
    status, said, seconds, peak = run(command, folder)
    found = []
    if status < 0:
        found.append(f"signal {-status}")
    elif status not in (0, 1, 2):
        found.append(f"status {status}")
    if seconds > SECONDS:
        found.append(f"{seconds:.0f} s")
    if peak > BYTES:
        found.append(f"{peak / BYTES:.1f} GiB")
    lines = [line for line in said.replace("\r", "\n").split("\n") if line and not line.startswith("Try ")]
    if status in (1, 2):
        if len(lines) != 1 and not any("warning" in line for line in lines):
            found.append(f"{len(lines)} lines: {said[:200]!r}")
        if re.search(r"[\x00-\x08\x0b-\x1f\x7f]", said.replace("\r", "")) or any(len(line) > 600 for line in lines):
            found.append(f"says {said[:200]!r}")
        if status == 2 and flag.lstrip("-").replace("-", "_") not in said.replace("-", "_"):
            found.append(f"does not name {flag}: {said[:200]!r}")
        if re.search(r"vector::|ArithmeticError|std::|basic_string|bad_alloc|stoi|what\(\)", said):
            found.append(f"says {said[:200]!r}")
        left = sorted(os.listdir(folder))
        if left:
            found.append(f"leaves {left}")
    if status == 0 and output.endswith(".vdb") and os.path.exists(output):
        found += [f"holds {what}" for what in not_finite(output)]
    return found


def not_finite(path):
    script = ("import sys, pyopenvdb as vdb\n"
              "for grid in vdb.readAll(sys.argv[1])[0]:\n"
              "  low, high = grid.evalMinMax()\n"
              "  for value in (low, high):\n"
              "    for number in (value if isinstance(value, tuple) else (value,)):\n"
              "      if not abs(number) < 3.5e38: print(grid.name, number)\n")
    checked = subprocess.run(["/usr/bin/python3", "-c", script, path], capture_output=True, text=True)
    return checked.stdout.split("\n")[:-1] + ([checked.stderr[-200:]] if checked.returncode else [])


def inputs(tools, project, folder):
    made = {"mesh": f"{folder}/in.ply", "picture": f"{folder}/in.png", "volume": f"{folder}/in.vdb", "model": f"{folder}/in.json"}
    pathlib.Path(made["mesh"]).write_text(
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\nelement face 8\n"
        "property list uchar int vertex_indices\nend_header\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n"
        "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n")
    for command in (["vdbnoise", "--dim", "12", "--preset", "smoke", "--out", made["volume"]],
                    ["vdbnoise", "slice", "--resolution", "32", "--out", made["picture"]],
                    ["noisefit", made["picture"], "--out", made["model"]]):
        done = subprocess.run([tools / command[0], *command[1:]], capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{' '.join(command)}: {done.stderr}")
    return made


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tools", type=pathlib.Path)
    parser.add_argument("project", type=pathlib.Path)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--only")
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    tools, project = arguments.tools.resolve(), arguments.project.resolve()

    scratch = pathlib.Path(tempfile.mkdtemp())
    made = inputs(tools, project, scratch)
    cases = []
    for name, base in BASES.items():
        if arguments.only and name != arguments.only:
            continue
        program, *subcommand = name.split()
        help_of = [str(tools / program), *[word for word in subcommand if not word.startswith("-")]]
        for flag, placeholders in flags_of(help_of):
            cases += [(name, [str(tools / program), *subcommand], base, flag, words) for words in cases_of(flag, placeholders)]
    cases = cases[arguments.seed % arguments.every::arguments.every]

    def attempt(number):
        name, program, base, flag, words = cases[number]
        folder = scratch / str(number)
        folder.mkdir()
        fill = {**made, "out": str(folder / "out")}
        words = [word.replace("{project}", str(project)) for word in words]
        given = [word.format(**fill) for word in base]
        output = next((word for word in given if word.startswith(fill["out"])), "")
        found = faults_of([*program, *given, *words], flag, output, folder)
        shutil.rmtree(folder)
        return [f"{name} {' '.join(repr(word)[:40] for word in words)}: {what}" for what in found]

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [fault for faults in pool.map(attempt, range(len(cases))) for fault in faults]
    shutil.rmtree(scratch)
    print("\n".join(found))
    print(f"{len(cases)} cases, {len(found)} faults")
    sys.exit(1 if found or not cases else 0)


if __name__ == "__main__":
    main()
