#!/usr/bin/env python3
"""check_headers.py PREFIX PROJECT WORK: the installed library as others include it, with their warnings as errors. By g++, and clang++ where
it is installed: all components' headers in one file. By g++: each header that has no source file of its own alone, the C++ of README and
docs/library.md with the headers that it names. By pkg-config: a program that CMake knows nothing of is built, and runs. What is not public is not installed."""

import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

WARNINGS = ["-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Wno-unused-variable", "-Werror"]
COMPILERS = [compiler for compiler in ("g++", "clang++") if shutil.which(compiler)]


def compiles(compiler, source, prefix):
    # OpenVDB's and OpenMesh's own headers warn; they are of the system.
    run = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", "-x", "c++", *WARNINGS, f"-I{prefix}/include", "-isystem",
                          "/usr/include/Imath", "-DOPENVDB_ABI_VERSION_NUMBER=10", "-"], input=source, capture_output=True, text=True)
    return "" if run.returncode == 0 else run.stderr[:2000]


def shown_sources(page):
    """A page's C++ as one file per block: its includes before a function that holds the rest."""
    for block in re.findall(r"^```cpp\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL):
        lines = block.split("\n")
        includes = [line for line in lines if line.startswith("#include")]
        yield "\n".join(includes + ["using namespace solidnoise;", "void shown() {"] + [line for line in lines if not line.startswith("#include")] + ["}"])


def main():
    prefix, project, work = (pathlib.Path(name).resolve() for name in sys.argv[1:4])
    headers = sorted((prefix / "include").rglob("*.h"))
    names = [str(header.relative_to(prefix / "include")) for header in headers]
    faults = [f"{name} is installed, and is not for others" for name in names if name.endswith("-inl.h") or "_simd" in name]

    umbrellas = [name for name in names if name.count("/") == 1]
    everything = "".join(f'#include "{name}"\n' for name in umbrellas)
    jobs = [(compiler, "all components", everything) for compiler in COMPILERS]
    for page in ("README.md", "docs/library.md"):
        jobs += [("g++", f"{page}'s block {number}", source) for number, source in enumerate(shown_sources(project / page), 1)]
    # The others stand alone: they are the first include of their .cpp files.
    jobs += [("g++", name, f'#include "{name}"\n') for name in names
             if name not in umbrellas and not (project / "src" / name).with_suffix(".cpp").exists()]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        said = pool.map(lambda job: compiles(job[0], job[2], prefix), jobs)
        faults += [f"{compiler}, {what}: {text}" for (compiler, what, _), text in zip(jobs, said) if text]

    packages = sorted(prefix.rglob("pkgconfig/solidnoise-*.pc"))
    if len(packages) != len(umbrellas):
        faults.append(f"{len(packages)} .pc files, {len(umbrellas)} components")
    environment = {**os.environ, "PKG_CONFIG_PATH": str(packages[0].parent)} if packages else {}
    for component, program in (("noise", "variance.cpp"), ("volume", "write_volume.cpp"), ("analysis", "draw_spectrum.cpp")):
        if f"solidnoise/{component}.h" not in names or not packages:
            continue
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", f"solidnoise-{component}"], env=environment, check=True,
                               capture_output=True, text=True).stdout.split()
        folder = work / "packages" / component
        folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(["g++", project / "examples/consumer" / program, "-o", folder / "program", *flags], check=True)
        # What it writes must not be there yet.
        with tempfile.TemporaryDirectory(dir=folder) as empty:
            subprocess.run([folder / "program"], cwd=empty, check=True, stdout=subprocess.DEVNULL)

    print("\n".join(faults) or f"{len(names)} headers, {len(packages)} packages, {' and '.join(COMPILERS)}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
