#!/usr/bin/env python3
"""reference.py TOOLS_FOLDER PROJECT_FOLDER [--write]: docs/reference.md is what the programs say of themselves: the keys of recipes by
--schema, the flags of all commands by --help-all. Fails where it is not; --write makes it so. Every flag that a page or the README
names must be one of them."""

import json
import pathlib
import re
import subprocess
import sys

COMMANDS = ["vdbnoise", "vdbnoise slice", "vdbnoise sky", "vdbnoise surface", "vdbnoise merge", "vdbnoise analyze", "meshnoise bake", "meshnoise curvature",
            "noisefit", "noisefit edit", "noisefit volume"]
# Of commands that have all flags of another one: what they have besides.
MORE = {"vdbnoise farm": ("vdbnoise", "Farm"), "meshnoise farm": ("meshnoise bake", "Farm")}
ALWAYS = {"--help", "--help-all"}
OTHER_PROGRAMS = {"--array", "--install", "--prefix", "--write", "--gtest_filter", "--tool", "--cflags", "--libs"}  # sbatch, cmake, scripts, ...
FLAG = re.compile(r"^  (--[\w-]+)((?: \S+)*?)(?:  |$) *(.*)$")


def say(tools, *words):
    return subprocess.run([tools / words[0], *words[1:]], capture_output=True, text=True, check=True).stdout


def cell(text):
    return text.replace("|", "\\|")


def flags_of(text):
    """[(group, flag, values, what)] of a page of help."""
    rows, group = [], ""
    for line in text.split("\n"):
        found = FLAG.match(line)
        if found:
            rows.append([group, found[1], found[2].strip(), found[3]])
        elif line.endswith(":") and not line.startswith(" "):
            group = line[:-1]
        elif rows and line.startswith(" " * 30):
            rows[-1][3] = (rows[-1][3] + " " + line.strip()).strip()
    return rows


def flag_tables(tools, command):
    lines, last = [f"## Flags of `{command}`", ""], None
    like, only = MORE.get(command, (None, None))
    if like:
        lines += [f"Those of `{like}`, and:", ""]
    for group, flag, values, what in flags_of(say(tools, *command.split(), "--help-all")):
        if only and group != only:
            continue
        if group != last:
            lines += [*([""] if last is not None else []), f"| {group} | |", "|---|---|"]
            last = group
        lines.append(f"| `{flag}{' ' if values else ''}{cell(values)}` | {cell(what)} |")
    return lines + [""]


def number(value):
    return f"{value:.10g}"


def values_of(schema):
    if "enum" in schema:
        return ", ".join(f"`{word}`" for word in schema["enum"])
    kind = schema.get("type", "object")
    if kind == "array":
        if "minItems" in schema and schema["minItems"] == schema.get("maxItems"):
            return f"{schema['minItems']} numbers" + limits_of(schema["items"])
        return "a list"
    if "oneOf" in schema or "anyOf" in schema:
        return "a number, or `[A, B]`" if any(one.get("type") == "number" for one in schema.get("oneOf", schema.get("anyOf"))) else ""
    words = {"number": "a number", "integer": "a whole number", "boolean": "`true`, `false`", "string": "a text", "object": ""}
    return words.get(kind, "") + limits_of(schema)


def limits_of(schema):
    text = ""
    if "exclusiveMinimum" in schema:
        text += f", above {number(schema['exclusiveMinimum'])}"
    if "minimum" in schema:
        text += f", {number(schema['minimum'])}" if "maximum" in schema else f", at least {number(schema['minimum'])}"
    if "maximum" in schema:
        text += (" to " if "minimum" in schema else ", at most ") + number(schema["maximum"])
    return text


def rows_of(schema, path, rows, listed):
    """Adds {path: [(values, what, kind)]} of the keys of an object. What has been listed before is not listed again."""
    for one in schema.get("oneOf", [schema]):
        kind = one.get("properties", {}).get("type", {}).get("enum", [None])[0] if "oneOf" in schema else None
        for key, inner in one.get("properties", {}).items():
            if kind and key == "type":
                rows.setdefault(path + "type", []).append((f"`{kind}`", "", kind))
            else:
                add(inner, path + key, kind, rows, listed)


def add(schema, path, kind, rows, listed):
    default, what = schema.get("default"), schema.get("description", "")
    if default not in (None, "", [], False) and not isinstance(default, dict):
        what += f"; default `{default}`" if isinstance(default, str) else f"; default {json.dumps(default)}"
    inner = schema["items"] if schema.get("type") == "array" and "properties" in schema.get("items", {}) else schema
    shape = json.dumps({key: inner.get(key) for key in ("properties", "oneOf")})
    has_keys = "properties" in inner or "oneOf" in inner
    if has_keys and shape in listed:
        what += f"; keys as of `{listed[shape]}`"
    rows.setdefault(path, []).append((values_of(schema), what, kind))
    if has_keys and shape not in listed and not path.endswith("exemplar"):
        listed[shape] = path
        rows_of(inner, path + ("." if inner is schema else "[]."), rows, listed)


def key_table(schema, what, listed):
    lines = [f"## Keys of {what}", "", "| key | values | what |", "|---|---|---|"]
    rows = {}
    for name, inner in schema.get("$defs", {}).items():
        if name not in listed:
            listed[name] = name
            rows_of(inner, f"({name}).", rows, listed)
    rows_of(schema, "", rows, listed)
    for path, entries in rows.items():
        by_text = {}
        for _, text, kind in entries:
            by_text.setdefault(text, []).append(kind)
        texts = [", ".join(kinds) + ": " + text if kinds[0] and text else text for text, kinds in by_text.items()]
        values = dict.fromkeys(values for values, _, _ in entries)
        lines.append(f"| `{path}` | {cell(', '.join(values))} | {cell('; '.join(texts))} |")
    return lines + [""]


def reference(tools):
    lines = ["# Reference", "Made by `tests/docs/reference.py --write` of what the programs say of themselves (`--schema`, `--help-all`); a test "
             "checks that it is so.", "`(noise).` and `(layer).` stand for the keys of a noise and of a layer, wherever one is; `[]` for each item "
             "of a list.", ""]
    listed = {}
    lines += key_table(json.loads(say(tools, "vdbnoise", "--schema")), "a volume's recipe", listed)
    lines += key_table(json.loads(say(tools, "vdbnoise", "sky", "--schema")), "a sky's recipe", listed)
    lines += key_table(json.loads(say(tools, "meshnoise", "--schema")), "a recipe for a mesh", listed)
    for command in [*COMMANDS, *MORE]:
        lines += flag_tables(tools, command)
    return "\n".join(lines).rstrip() + "\n"


def main():
    tools, project = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    page = project / "docs" / "reference.md"
    made = reference(tools)
    if "--write" in sys.argv:
        page.write_text(made)
    faults = [] if page.read_text() == made else ["docs/reference.md is not what the programs say; make it by reference.py --write"]
    known = {row[1] for command in [*COMMANDS, *MORE] for row in flags_of(say(tools, *command.split(), "--help-all"))} | ALWAYS | OTHER_PROGRAMS
    for text in [project / "README.md", *sorted((project / "docs").glob("*.md"))]:
        for flag in sorted(set(re.findall(r"(?<![\w-])--[a-z][\w-]*", text.read_text())) - known):
            faults.append(f"{text.name} names {flag}, which no command has")
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
