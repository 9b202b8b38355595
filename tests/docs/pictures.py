#!/usr/bin/env python3
"""pictures.py TOOLS_FOLDER PROJECT_FOLDER [--write [PICTURE...]]: docs/pictures.json says by which commands each picture of the README and
of the docs was made, and of which values. Fails where a picture is older than the values, the recipes or the commands, where it is not in the list,
and where a page prints a command that makes a picture and is not the one that did. --write makes all pictures, or those that are named, by their
commands, each set in a fresh folder that holds links to the project's examples/, meshes/ and scripts/."""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from follow_docs import commands_of

ELSEWHERE = ("docs/papers/", "docs/performance", "docs/studio/")  # scripts/reproduce.sh, bench.sh and studio.sh make these
SHOWN = re.compile(r"!\[[^]]*\]\(([^)]+)\)")
PRINTED = re.compile(r"`((?:vdbnoise|meshnoise|noisefit) [^`]+)`")
OUTPUTS = r"--(?:out|preview|spectrum) %s(?:\s|$)"


def algorithm(tools):
    """The version of the values that the programs make."""
    described = subprocess.run([tools / "vdbnoise", "--describe", "--raw"], capture_output=True, text=True, check=True)
    return json.loads(described.stdout)["recipe"]["algorithm"]


def digest(project, commands):
    """Of commands and of all that they read of the project: its files that they name, and presets."""
    state = hashlib.sha256("\n".join(commands).encode())
    for word in re.findall(r"(?<![^\s])[\w][\w./-]*", " ".join(commands)):
        for path in (project / word, *project.glob(f"tools/*/presets/{word}.json"), *project.glob(f"tools/*/skies/{word}.json")):
            if path.is_file():
                state.update(path.read_bytes())
    return state.hexdigest()[:16]


def pages(project):
    return [project / "README.md", *sorted((project / "docs").glob("*.md")), project / "examples/README.md"]


def check(tools, project, record):
    failures = []
    if record["algorithm"] != algorithm(tools):
        failures.append(f"the pictures are of algorithm {record['algorithm']}, the values of {algorithm(tools)}")
    made = {name: entry for entry in record["pictures"] for name in entry["makes"]}
    for entry in record["pictures"]:
        if entry["digest"] != digest(project, entry["by"]):
            failures.append(f"{', '.join(entry['makes'])}: older than its recipes or commands")
    shown, printed = set(), {}
    for page in pages(project):
        text = page.read_text()
        shown |= {os.path.relpath(page.parent / name, project) for name in SHOWN.findall(text)}
        for command in [re.sub(r"\s+#\s.*", "", line) for line in commands_of(page)] + PRINTED.findall(text):
            for name in made:
                if re.search(OUTPUTS % re.escape(os.path.basename(name)), command):
                    printed.setdefault(name, set()).add(command)
    shown = {name for name in shown if not name.startswith(ELSEWHERE)}
    failures += [f"{name}: not in docs/pictures.json" for name in sorted(shown - set(made))]
    failures += [f"{name}: shown nowhere" for name in sorted(set(made) - shown)]
    failures += [f"{name}: made by none of the commands that pages print" for name, commands in printed.items()
                 if not commands & set(made[name]["by"])]
    return failures


def make(tools, project, entry):
    environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "PYTHONPATH": str(tools.parent / "python")}
    with tempfile.TemporaryDirectory() as folder:
        for name in ("examples", "meshes", "scripts"):
            os.symlink(project / name, pathlib.Path(folder) / name)
        for command in entry["by"]:
            print(command, flush=True)
            subprocess.run(["bash", "-euc", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL, check=True)
        for name in entry["makes"]:
            shutil.copyfile(pathlib.Path(folder) / os.path.basename(name), project / name)
    entry["digest"] = digest(project, entry["by"])


def make_all(tools, project, path, wanted):
    """Writes the record after each, so that what was made stays made."""
    record = json.loads(path.read_text())
    wanted = {os.path.basename(name) for name in wanted}
    if unknown := wanted - {os.path.basename(name) for entry in record["pictures"] for name in entry["makes"]}:
        sys.exit(f"pictures: {', '.join(sorted(unknown))}: not in docs/pictures.json")
    for entry in record["pictures"]:
        if not wanted or wanted & {os.path.basename(name) for name in entry["makes"]}:
            make(tools, project, entry)
            path.write_text(json.dumps(record, indent=1) + "\n")
    if not wanted:
        record["algorithm"] = algorithm(tools)
        path.write_text(json.dumps(record, indent=1) + "\n")


def main():
    tools, project = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    path = project / "docs/pictures.json"
    if sys.argv[3:4] == ["--write"]:
        make_all(tools, project, path, set(sys.argv[4:]))
    failures = check(tools, project, json.loads(path.read_text()))
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
