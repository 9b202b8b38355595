#!/usr/bin/env python3
"""farm_test.py TOOLS_FOLDER: jobs of `vdbnoise farm` and `meshnoise farm` on a real Slurm, and without one.

A volume of 16 parts, of whose tasks 30 % are killed at random moments (the seed is printed) and whose node's daemon is begun anew in
the middle: it comes to be the same file, byte for byte, as by one run, and no task that was done is done again. Sequences of volumes and of
meshes, done job by job: the same files as by one run. Each job's template keeps the rules of Open Job Description."""

import filecmp
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from open_job_template import faults
from slurm_cluster import Cluster, wait_until

PARTS = 16
KILLED = 5  # of 16, 30 %
RECIPE = ["--preset", "cumulus", "--dim", "224"]
NEEDED = ("/usr/sbin/munged", "/usr/sbin/slurmctld", "/usr/sbin/slurmd")
SKIPPED = 77


def run(command, folder, environment=None, status=0):
    done = subprocess.run([str(word) for word in command], cwd=folder, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    assert done.returncode == status, f"{command}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done


def check_template(folder):
    template = json.loads((folder / "template.json").read_text())
    assert not faults(template), faults(template)
    # What breaks a rule is found.
    broken = [("steps", []), ("name", "a" * 129), ("specificationVersion", "jobtemplate-2024-01"), ("more", 1)]
    for key, value in broken:
        assert faults({**template, key: value}), key
    for change in (lambda step: step["script"]["actions"]["onRun"]["args"].append("{{Task.Param.Other}}"),
                   lambda step: step.update(dependencies=[{"dependsOn": step["name"]}]),
                   lambda step: step["hostRequirements"]["amounts"][0].update(min=0),
                   lambda step: step["parameterSpace"]["taskParameterDefinitions"][0].update(range="1-4,3"),
                   lambda step: step.pop("script")):
        other = json.loads(json.dumps(template))
        change(other["steps"][0])
        assert faults(other), other
    return template


def tasks_at_work(folder):
    """{number of the job: process} of the parts that are being made."""
    found = {}
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (process / "cmdline").read_bytes().split(b"\0")[:-1]
        except OSError:
            continue
        if len(words) == 6 and words[1:3] == [b"farm", b"run"] and words[3].decode() == str(folder) and words[4] == b"parts":
            found[int(words[5])] = int(process.name)
    return found


def kill_some(folder, chosen, cluster, seconds):
    """Kills each of the chosen jobs once, at a random moment of its first run; restarts the node's daemon once two are killed. A job that is
    done before its moment has another one killed in its place, as soon as it is seen. Returns the jobs that were killed."""
    spare = [job for job in range(PARTS, 0, -1) if job not in chosen]
    due, killed, seen, replacing, restarted = {}, set(), set(), set(), False
    end = time.monotonic() + 300
    while len(killed) < KILLED and time.monotonic() < end:
        at_work = tasks_at_work(folder)
        for job in at_work.keys() - seen:
            seen.add(job)
            if job in chosen:
                due[job] = (at_work[job], time.monotonic() + (0.0 if job in replacing else random.uniform(0.0, 0.8 * seconds)))
        for job, (process, moment) in list(due.items()):
            done = at_work.get(job) != process
            if not done and time.monotonic() < moment:
                continue
            del due[job]
            try:
                if not done:
                    os.kill(process, signal.SIGKILL)
                    killed.add(job)
            except ProcessLookupError:
                done = True
            if done:
                others = [one for one in spare if one not in seen | chosen][:1]
                chosen.update(others)
                replacing.update(others)
        if len(killed) >= 2 and not restarted:
            cluster.stop("slurmd")
            cluster.start_node()
            restarted = True
        time.sleep(0.01)
    assert restarted
    return killed


def identity(folder):
    return {path.name: (path.stat().st_ino, path.stat().st_mtime_ns) for path in folder.glob("*.vdb")}


def logged(folder, pattern):
    return [line for log in sorted((folder / "log").glob("parts-*.log")) for line in re.findall(pattern, log.read_text(), re.MULTILINE)]


def test_slurm(tools, folder, seed):
    random.seed(seed)
    vdbnoise = tools / "vdbnoise"
    start = time.monotonic()
    run([vdbnoise, *RECIPE, "--out", "whole.vdb", "--quiet", "--threads", "1"], folder)
    seconds = (time.monotonic() - start) / PARTS
    with Cluster(folder / "slurm", cpus=2) as cluster:
        farm = [vdbnoise, "farm", *RECIPE, "--out", "sky.vdb", "--parts", PARTS, "--job-time", 0, "--at-once", 2]
        submitted = run([*farm, "--submit"], folder, cluster.environment)
        assert re.fullmatch(r"parts: job \d+\nmerge: job \d+\n", submitted.stdout), submitted.stdout
        job = folder / "sky.farm"
        check_template(job)
        assert "#SBATCH --array=1-16%2\n" in (job / "parts.sbatch").read_text()
        killed = kill_some(job, set(random.sample(range(1, PARTS + 1), KILLED)), cluster, seconds)
        wait_until("the job's end", lambda: not cluster.ask("squeue", "-h"), 300)
        assert len(killed) == KILLED, killed
        assert (folder / "sky.vdb").is_file(), "".join(log.read_text() for log in (job / "log").glob("*.log"))
        assert filecmp.cmp(folder / "sky.vdb", folder / "whole.vdb", shallow=False), "the farm's volume is another one"

        # Each part was made once, and what was killed left nothing; but what was killed between its file's end and its own finds it again.
        made = logged(job, r"^OUTPUT_FILE: .*/parts/(sky\.part\d\d\.vdb)$")
        kept = {int(part) for part in logged(job, r"part (\d+) of \d+: is done already$")}
        assert set(made) == {path.name for path in (job / "parts").iterdir()} and len(set(made)) == PARTS, made
        assert kept <= killed, (kept, killed)
        assert {name for name in made if made.count(name) > 1} <= {f"sky.part{part:02}.vdb" for part in kept}, made

        # Submitted again, all is kept; but for what is damaged, or not there.
        before = identity(job / "parts")
        for name, change in (("sky.part03.vdb", lambda path: path.unlink()), ("sky.part07.vdb", damage)):
            change(job / "parts" / name)
        run(["bash", job / "submit.sh"], folder, cluster.environment)
        wait_until("the second job's end", lambda: not cluster.ask("squeue", "-h"), 300)
        after = identity(job / "parts")
        changed = sorted(name for name in before if before[name] != after[name])
        assert changed == ["sky.part03.vdb", "sky.part07.vdb"], changed
    status = run([vdbnoise, "farm", "status", job], folder).stdout
    assert status == "parts: 16 of 16 done\nmerge: 1 of 1 done\n", status
    (folder / "sky.vdb").unlink()
    (job / "parts" / "sky.part09.vdb").unlink()
    status = run([vdbnoise, "farm", "status", job], folder).stdout
    assert status == "parts: 15 of 16 done; not 9\nmerge: 0 of 1 done; not 1\n", status


def damage(path):
    bytes_of = bytearray(path.read_bytes())
    bytes_of[-100] ^= 1  # of the last values, which are not compressed or else make other ones
    path.write_bytes(bytes_of)


# Runs a command and says its peak of memory, KiB.
MEASURED = """import resource, subprocess, sys
status = subprocess.run(sys.argv[1:]).returncode
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, flush=True)
sys.exit(status)"""


def do_job(program, folder, job):
    """As a manager would, without any. No job takes more memory than it asks for."""
    for step in check_template(job)["steps"]:
        asked = next(amount["min"] for amount in step["hostRequirements"]["amounts"] if amount["name"] == "amount.worker.memory")
        assert f"#SBATCH --mem={asked:.0f}M\n" in (job / f"{step['name']}.sbatch").read_text()
        last = int(step["parameterSpace"]["taskParameterDefinitions"][0]["range"].split("-")[1])
        for number in range(1, last + 1):
            done = run([sys.executable, "-c", MEASURED, program, "farm", "run", job, step["name"], number], "/")
            assert "openjd_progress: 100\n" in done.stdout, done.stdout
            taken = int(done.stdout.splitlines()[-1]) / 1024
            assert 0.1 * asked < taken < asked, (step["name"], taken, asked)


def test_sequences(tools, folder, project):
    vdbnoise, meshnoise = tools / "vdbnoise", tools / "meshnoise"
    boil = ["--preset", "smoke", "--dim", "24", "--evolve", "0.5", "--frames", "7-9", "--density", "0:1,9:3"]
    run([vdbnoise, *boil, "--out", "one.##.vdb", "--quiet"], folder)
    run([vdbnoise, "farm", *boil, "--out", "boil.##.vdb", "--parts", 2, "--quiet"], folder)
    do_job(vdbnoise, folder, folder / "boil.farm")
    for frame in ("07", "08", "09"):
        assert filecmp.cmp(folder / f"one.{frame}.vdb", folder / f"boil.{frame}.vdb", shallow=False), frame
    status = run([vdbnoise, "farm", "status", "boil.farm"], folder).stdout
    assert status == "scale: 1 of 1 done\nparts: 6 of 6 done\nmerge: 3 of 3 done\n", status

    rust = [project / "meshes" / "wyrm.ply", "--preset", "rust", "--evolve", "0.5", "--frames", "1-3", "--quiet"]
    run([meshnoise, "bake", *rust, "--out", "one.#.ply"], folder)
    run([meshnoise, "farm", *rust, "--out", "rust.#.ply"], folder)
    do_job(meshnoise, folder, folder / "rust.farm")
    for frame in "123":
        assert filecmp.cmp(folder / f"one.{frame}.ply", folder / f"rust.{frame}.ply", shallow=False), frame
    assert run([meshnoise, "farm", "status", "rust.farm"], folder).stdout == "frames: 3 of 3 done\n"
    before = (folder / "rust.1.ply").stat().st_ino
    again = run([meshnoise, "farm", "run", "rust.farm", "frames", 1], folder)
    assert "is done already" in again.stdout and (folder / "rust.1.ply").stat().st_ino == before
    (folder / "rust.1.ply").write_text("ply\n")
    run([meshnoise, "farm", "run", "rust.farm", "frames", 1], folder)
    assert filecmp.cmp(folder / "one.1.ply", folder / "rust.1.ply", shallow=False)


def test_refusals(tools, folder):
    vdbnoise = tools / "vdbnoise"
    without = {**os.environ, "PATH": str(folder)}
    done = run([vdbnoise, "farm", "--dim", 16, "--out", "x.vdb", "--parts", 2, "--submit"], folder, without, status=1)
    assert done.stderr.splitlines()[-1].startswith("vdbnoise: there is no sbatch here; "), done.stderr
    assert (folder / "x.farm" / "submit.sh").is_file()
    again = run([vdbnoise, "farm", "--dim", 16, "--out", "x.vdb", "--parts", 2], folder, status=1)
    assert "x.farm has a job already; --force replaces it" in again.stderr, again.stderr
    for status, words, says in (
            (2, [], "--out is missing"),
            (2, ["--out", "-"], "--out is -; a farm makes .vdb files"),
            (2, ["--out", "y.nvdb"], "--out is y.nvdb"),
            (2, ["--out", "y.vdb", "--parts", "0"], "--parts is 0"),
            (2, ["--out", "y.vdb", "--preview", "y.png"], "--preview is not for a farm"),
            (2, ["--out", "y.####.vdb"], "give --frames"),
            (1, ["none.json", "--out", "y.vdb"], "none.json"),
            (1, ["--out", "nowhere/y.vdb"], "there is no folder"),
            (1, ["status", "nowhere"], "nowhere/job.json"),
            (2, ["run", "x.farm", "paint", "1"], "STEP is paint; the job has parts, merge"),
            (2, ["run", "x.farm", "parts", "2"], "JOB is 2; it must be between 1 and 1"),
            (1, ["run", "x.farm", "merge", "1"], "x.part1.vdb")):
        refused = run([vdbnoise, "farm", *words], folder, status=status)
        assert says in refused.stderr, (words, refused.stderr)
        assert "openjd_progress: 100" not in refused.stdout, refused.stdout
    assert not list(folder.glob("y*")), list(folder.glob("y*"))


def main():
    tools, project = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(__file__).resolve().parents[2]
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else random.randrange(10**6)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for test in (lambda: test_refusals(tools, folder), lambda: test_sequences(tools, folder, project)):
            test()
        if not all(shutil.which(program) for program in NEEDED):
            print("there is no Slurm here: install slurmctld, slurmd, slurm-client and munge")
            sys.exit(SKIPPED)
        print(f"seed {seed}")
        test_slurm(tools, folder, seed)


if __name__ == "__main__":
    main()
