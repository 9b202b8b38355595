#!/usr/bin/env python3
"""check_includes.py PROJECT_FOLDER: the folders of the program stand on each other in one order. No folder includes, through however
many others, from itself again; each library includes only from those that its line below names; nothing that ships includes from
tests/ or bench/. The second run, over a copy of the graph with one include turned round, has to find the cycle that this makes."""

import pathlib
import re
import sys

# What each library may include from, besides itself, as CONTRIBUTING.md's map has it.
MAY_INCLUDE = {
    "core": [],
    "noise": ["core"],
    "field": ["core", "noise"],
    "recipe": ["core", "noise", "field"],
    "geometry": ["core"],
    "image": ["core"],
    "render": ["core", "geometry", "image"],
    "analysis": ["core", "noise", "image"],
    "mesh": ["core", "noise", "field", "recipe", "geometry", "image"],
    "volume": ["core", "noise", "field", "recipe", "geometry", "image", "analysis"],
}
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def includes_of(root, roots):
    """{(folder, included folder): example} over the sources under root; paths are found under the folder itself and under roots."""
    edges = {}
    for path in sorted(root.rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        for name in INCLUDE.findall(path.read_text()):
            target = next((base / name for base in [path.parent, *roots] if (base / name).is_file()), None)
            if target and target.resolve().parent != path.resolve().parent:
                edges[path.parent, target.resolve().parent] = f"{path}: {name}"
    return edges


def cycle_in(edges):
    """The folders of one cycle, or [] where there is none."""
    following = {}
    for source, target in edges:
        following.setdefault(source, []).append(target)
    done, path = set(), []

    def visit(folder):
        if folder in path:
            return path[path.index(folder):] + [folder]
        if folder in done:
            return []
        path.append(folder)
        found = next((found for found in map(visit, following.get(folder, [])) if found), [])
        path.pop()
        done.add(folder)
        return found

    return next((found for found in map(visit, list(following)) if found), [])


def faults(project):
    source, tools = project / "src", project / "tools"
    edges = {}
    for root in (source, tools):
        edges |= includes_of(root, [source, tools, project / "tests", project / "bench"])

    found = []
    cycle = cycle_in(edges)
    if cycle:
        found.append("include cycle: " + " -> ".join(str(folder.relative_to(project)) for folder in cycle))
        found += [f"  {edges[pair]}" for pair in zip(cycle, cycle[1:])]
    for (folder, target), example in edges.items():
        if target.is_relative_to(project / "tests") or target.is_relative_to(project / "bench"):
            found.append(f"what ships includes from {target.relative_to(project)}: {example}")
        if not folder.is_relative_to(source) or folder == source / "solidnoise":
            continue  # programs, and the headers of whole components, may include all
        library = folder.relative_to(source / "solidnoise").parts[0]
        if not target.is_relative_to(source):
            found.append(f"{library} includes from {target.relative_to(project)}: {example}")
            continue
        used = target.relative_to(source / "solidnoise").parts[0]
        if used not in [library, *MAY_INCLUDE.get(library, [])]:
            found.append(f"{library} may not include from {used}: {example}")
    if not cycle and edges:
        turned = dict(edges)
        turned |= {(target, folder): "turned round" for folder, target in list(edges)[:1]}
        if not cycle_in(turned):
            found.append("the search for cycles found none where there is one")
    return found if edges else ["no include was found"]


if __name__ == "__main__":
    messages = faults(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(messages) or "no folder includes from itself through others")
    sys.exit(1 if messages else 0)
