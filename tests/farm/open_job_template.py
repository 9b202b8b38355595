"""The rules of Open Job Description's job templates, version 2023-09, without its extensions, as far as templates use them that have no
environments and no embedded files: as a JSON Schema, and what a schema cannot say. After the published "Template Schemas"."""

import re

import jsonschema

IDENTIFIER = "[A-Za-z_][A-Za-z0-9_]{0,63}"
NO_CONTROLS = r"^[^\x00-\x1f\x7f-\x9f]*$"
DESCRIPTION = {"type": "string", "minLength": 1, "maxLength": 2048}
NAME = {"type": "string", "pattern": f"^{IDENTIFIER}$"}
TEXT = {"type": "string", "pattern": NO_CONTROLS}


def closed(properties, required):
    return {"type": "object", "properties": properties, "required": required, "additionalProperties": False}


def parameter(kind, value, more):
    return closed({"name": NAME, "type": {"const": kind}, "description": DESCRIPTION, "default": value,
                   "allowedValues": {"type": "array", "items": value, "minItems": 1}, **more}, ["name", "type"])


VALUE = {"type": "string", "maxLength": 1024}
LENGTHS = {"minLength": {"type": "integer", "minimum": 0}, "maxLength": {"type": "integer", "minimum": 1}}
JOB_PARAMETER = {"oneOf": [
    parameter("STRING", VALUE, LENGTHS),
    parameter("PATH", VALUE, {**LENGTHS, "objectType": {"enum": ["FILE", "DIRECTORY"]}, "dataFlow": {"enum": ["NONE", "IN", "OUT", "INOUT"]}}),
    parameter("INT", {"type": "integer"}, {"minValue": {"type": "integer"}, "maxValue": {"type": "integer"}}),
    parameter("FLOAT", {"type": "number"}, {"minValue": {"type": "number"}, "maxValue": {"type": "number"}}),
]}
AMOUNT = {**closed({"name": {"type": "string", "maxLength": 100, "pattern": rf"^({IDENTIFIER}:)?amount(\.{IDENTIFIER})+$"},
                    "min": {"type": "number", "minimum": 0}, "max": {"type": "number", "exclusiveMinimum": 0}}, ["name"]),
          "anyOf": [{"required": ["min"]}, {"required": ["max"]}]}
VALUES = {"type": "array", "minItems": 1, "maxItems": 50, "items": {"type": "string", "pattern": "^[A-Za-z_][A-Za-z0-9_-]{0,99}$"}}
ATTRIBUTE = {**closed({"name": {"type": "string", "maxLength": 100, "pattern": rf"^({IDENTIFIER}:)?attr(\.{IDENTIFIER})+$"},
                       "anyOf": VALUES, "allOf": VALUES}, ["name"]),
             "anyOf": [{"required": ["anyOf"]}, {"required": ["allOf"]}]}
REQUIREMENTS = {**closed({"amounts": {"type": "array", "items": AMOUNT, "minItems": 1},
                          "attributes": {"type": "array", "items": ATTRIBUTE, "minItems": 1}}, []),
                "anyOf": [{"required": ["amounts"]}, {"required": ["attributes"]}]}
CANCELATION = {"oneOf": [
    closed({"mode": {"const": "TERMINATE"}}, ["mode"]),
    closed({"mode": {"const": "NOTIFY_THEN_TERMINATE"}, "notifyPeriodInSeconds": {"type": "integer", "minimum": 1, "maximum": 600}}, ["mode"]),
]}
ACTION = closed({"command": {**TEXT, "minLength": 1}, "args": {"type": "array", "items": TEXT, "minItems": 1},
                 "timeout": {"type": "integer", "minimum": 1}, "cancelation": CANCELATION}, ["command"])
RANGE = r"\s*-?\d+\s*(-\s*-?\d+\s*(:\s*-?[1-9]\d*\s*)?)?"


def listed(item):
    return {"type": "array", "items": item, "minItems": 1, "maxItems": 1024}


def task_parameter(kind, values):
    return closed({"name": NAME, "type": {"const": kind}, "range": values}, ["name", "type", "range"])


TASK_VALUE = {"type": "string", "minLength": 1, "maxLength": 1024}
TASK_PARAMETER = {"oneOf": [
    task_parameter("INT", {"oneOf": [listed({"type": ["integer", "string"]}), {"type": "string", "pattern": f"^{RANGE}(,{RANGE})*$"}]}),
    task_parameter("FLOAT", listed({"type": ["number", "string"]})),
    task_parameter("STRING", listed(TASK_VALUE)),
    task_parameter("PATH", listed(TASK_VALUE)),
]}
STEP = closed({
    "name": {**TEXT, "minLength": 1, "maxLength": 64},
    "description": DESCRIPTION,
    "dependencies": {"type": "array", "minItems": 1, "items": closed({"dependsOn": {**TEXT, "minLength": 1, "maxLength": 64}}, ["dependsOn"])},
    "hostRequirements": REQUIREMENTS,
    "parameterSpace": closed({"taskParameterDefinitions": {"type": "array", "items": TASK_PARAMETER, "minItems": 1, "maxItems": 16},
                              "combination": {"type": "string", "minLength": 1, "maxLength": 1280}}, ["taskParameterDefinitions"]),
    "script": closed({"actions": closed({"onRun": ACTION}, ["onRun"])}, ["actions"]),
}, ["name", "script"])
SCHEMA = closed({
    "specificationVersion": {"const": "jobtemplate-2023-09"},
    "$schema": {"type": "string"},
    "name": {**TEXT, "minLength": 1, "maxLength": 128},
    "description": DESCRIPTION,
    "parameterDefinitions": {"type": "array", "items": JOB_PARAMETER, "minItems": 1, "maxItems": 50},
    "steps": {"type": "array", "items": STEP, "minItems": 1},
}, ["specificationVersion", "name", "steps"])


def repeated(names):
    return sorted({name for name in names if names.count(name) > 1})


def references(value):
    """The names in {{ }} of all strings; None for what is no such name."""
    if isinstance(value, dict):
        return [name for inner in value.values() for name in references(inner)]
    if isinstance(value, list):
        return [name for inner in value for name in references(inner)]
    if not isinstance(value, str):
        return []
    found = [inner.strip() for inner in re.findall(r"\{\{(.*?)\}\}", value)]
    return [name if re.fullmatch(rf"{IDENTIFIER}(\.{IDENTIFIER})*", name) else None for name in found]


def unknown(value, scope):
    return [f"{{{{{name}}}}} is not known there" for name in references(value) if name not in scope]


def overlaps(text):
    seen = set()
    for part in text.split(","):
        first, last, skip = re.fullmatch(r"\s*(-?\d+)\s*(?:-\s*(-?\d+)\s*)?(?::\s*(-?\d+)\s*)?", part).groups()
        skip = int(skip or 1)
        values = set(range(int(first), int(last or first) + (1 if skip > 0 else -1), skip))
        if values & seen:
            return True
        seen |= values
    return False


def step_faults(step, earlier, job_scope, raw_scope):
    found = []
    space = step.get("parameterSpace", {"taskParameterDefinitions": []})
    tasks = space["taskParameterDefinitions"]
    names = [one["name"] for one in tasks]
    found += [f"{step['name']}: two task parameters are called {name}" for name in repeated(names)]
    found += [f"{step['name']}: the ranges of {one['name']} overlap" for one in tasks
              if one["type"] == "INT" and isinstance(one["range"], str) and overlaps(one["range"])]
    for amount in step.get("hostRequirements", {}).get("amounts", []):
        if amount["name"].lower() == "amount.worker.vcpu" and amount.get("min", 1) < 1:
            found.append(f"{step['name']}: less than one processor")
    amounts = [one["name"].lower() for one in step.get("hostRequirements", {}).get("amounts", [])]
    found += [f"{step['name']}: two amounts of {name}" for name in repeated(amounts)]
    depends = [one["dependsOn"] for one in step.get("dependencies", [])]
    found += [f"{step['name']}: depends on {name} twice" for name in repeated(depends)]
    found += [f"{step['name']}: depends on {name}, which is no other step" for name in depends if name not in earlier]
    scope = job_scope | {f"Task.{raw}Param.{name}" for raw in ("", "Raw") for name in names} | {"Session.WorkingDirectory"}
    return found + unknown(step["script"], scope) + unknown(space, raw_scope)


def cycles(steps):
    """The names of steps that wait for themselves."""
    waits = {step["name"]: {one["dependsOn"] for one in step.get("dependencies", [])} for step in steps}
    while True:
        free = [name for name, others in waits.items() if not others & waits.keys()]
        if not free:
            return sorted(waits)
        for name in free:
            del waits[name]


def faults(template):
    """What breaks the rules, one line each."""
    validator = jsonschema.Draft202012Validator(SCHEMA)
    found = [f"{'/'.join(map(str, error.path))}: {error.message[:200]}" for error in validator.iter_errors(template)]
    if found:
        return found
    parameters = template.get("parameterDefinitions", [])
    names = [one["name"] for one in parameters]
    found += [f"two job parameters are called {name}" for name in repeated(names)]
    found += [f"{one['name']}: its default is not allowed" for one in parameters
              if "allowedValues" in one and one.get("default", one["allowedValues"][0]) not in one["allowedValues"]]
    # Where a step's script is not, paths have no mapping yet.
    raw_scope = {f"RawParam.{name}" for name in names} | {f"Param.{one['name']}" for one in parameters if one["type"] != "PATH"}
    job_scope = raw_scope | {f"Param.{name}" for name in names}
    found += unknown(template["name"], raw_scope)
    step_names = [step["name"] for step in template["steps"]]
    found += [f"two steps are called {name}" for name in repeated(step_names)]
    found += [f"{name}: waits for itself" for name in cycles(template["steps"])]
    for step in template["steps"]:
        found += step_faults(step, set(step_names) - {step["name"]}, job_scope, raw_scope)
    return found
