#!/usr/bin/env python3
"""follow_docs.py TOOLS_FOLDER PROJECT_FOLDER PAGE...: does what each page says, as a reader would: every command line of its code blocks
that starts with one of the programs, a loop or python3 is run by bash, in the page's order, in one fresh folder that holds links to
the project's examples/ and meshes/. Each has to succeed, say nothing on standard error but progress, and write what it names.

Only sizes are reduced, to take seconds: --dim is at most 40 and is added to commands that make a volume and do not say how fine;
sequences have at most two frames; slices 96 samples a side; skies eight clouds in voxels
of 100. A page without a command fails."""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

PROGRAMS = ("vdbnoise", "meshnoise", "noisefit")
RUNNABLE = re.compile(r"^(?:(?:%s) |for |/usr/bin/python3 )" % "|".join(PROGRAMS))
SUBCOMMANDS = ("slice", "info", "analyze", "sky", "surface", "merge", "farm")


def commands_of(page):
    shell = False  # inside a block of commands
    fenced = False
    for line in re.sub(r"\\\n\s*", " ", page.read_text()).split("\n"):
        if line.startswith("```"):
            fenced = not fenced
            shell = fenced and line in ("```", "```sh")
        elif shell and RUNNABLE.match(line):
            yield line.strip()


def reduced(command):
    """The command with its sizes reduced."""
    command = re.sub(r"--dim (\d+)", lambda found: f"--dim {min(int(found[1]), 40)}", command)
    command = re.sub(r"--resolution (\d+)", lambda found: f"--resolution {min(int(found[1]), 96)}", command)
    command = re.sub(r"--frames (\d+)-(\d+)", lambda found: f"--frames {found[1]}-{min(int(found[1]) + 1, int(found[2]))}", command)
    words = shlex.split(command, comments=True)
    makes = words[0] == "vdbnoise" and words[1] not in SUBCOMMANDS
    command = re.sub(r"\s#\s.*", "", command)
    given = {"--dim", "--voxel", "--on", "--list-presets", "--schema", "--help"} & set(words)
    if makes and not given:
        command += " --dim 40"
    if words[:2] == ["vdbnoise", "sky"]:
        command = re.sub(r" --(?:voxel|count) [\d.]+", "", command) + " --voxel 100 --kinds 2"
        command += "" if "--points" in words else " --count 8"
    return command


def follow(page, project, environment):
    failures, count = [], 0
    with tempfile.TemporaryDirectory() as folder:
        for name in ("examples", "meshes"):
            os.symlink(project / name, pathlib.Path(folder) / name)
        for command in commands_of(page):
            count += 1
            run = subprocess.run(["bash", "-euc", reduced(command)], cwd=folder, env=environment, capture_output=True, text=True,
                                 stdin=subprocess.DEVNULL, timeout=600)
            if run.returncode != 0:
                failures.append(f"{page.name}: {command}\n    {run.stderr.strip()}")
                continue
            if shlex.split(command, comments=True)[1:2] == ["farm"]:  # of which a job makes what is named
                continue
            for flag in ("--out", "--preview", "--plot", "--spectrum", "--write-recipe", "--write-points"):
                for name in re.findall(flag + r" ([\w.-]+\.\w+)(?:\s|$)", command):
                    if not (pathlib.Path(folder) / name).is_file():
                        failures.append(f"{page.name}: {command}\n    made no {name}")
    if not count:
        failures.append(f"{page.name}: has no command")
    print(f"{page.name}: {count} commands, {len(failures)} failures")
    return failures


if __name__ == "__main__":
    tools, project = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    path = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}
    found = [failure for page in sys.argv[3:] for failure in follow(pathlib.Path(page).resolve(), project, path)]
    print("\n".join(found))
    sys.exit(1 if found else 0)
