import { useComputed } from "@preact/signals";
import type { JSX } from "preact";
import { engine } from "../engine/engine.ts";
import { activeNoise, infoOf, problem, replaceNoise } from "../store.ts";
import { Field, KindField, ObjectFields } from "./fields.tsx";
import { isObject, type Json, resolved } from "./schema.ts";

// The recipe's parts as sections; what is in them comes from the table of fields.

const kMotion = ["dims", "time", "offset", "wind"];
const kAtoms = ["noise", "grids", "domain", "fields", "solidnoise", "algorithm", "$schema", "description"];

export function Controls(): JSX.Element | null {
  const recipe = useComputed(() => JSON.parse(activeNoise().text || "{}") as Json);
  const root = engine.schema;
  const json = recipe.value;
  if (!isObject(json) || !root.properties) return null;
  const { properties } = root;
  const grids = Array.isArray(json.grids) ? json.grids : [];
  const info = infoOf(activeNoise());
  const place = Math.max(0, grids.findIndex((grid) => isObject(grid) && grid.name === activeNoise().grid));
  const grid = grids[place];
  const gridSchema = resolved(resolved(properties.grids ?? {}, root).items ?? {}, root);
  const own = gridSchema.properties ?? {};
  const gridPath = ["grids", place];
  const noiseSchema = resolved(properties.noise ?? {}, root);
  const others = Object.keys(properties).filter((key) => key in json && !kMotion.includes(key) && !kAtoms.includes(key));
  const section = (title: string, open: boolean, children: JSX.Element): JSX.Element => (
    <details class="section" open={open}><summary>{title}</summary>{children}</details>
  );
  return (
    <>
      {typeof json.description === "string" && <p class="description">{json.description}</p>}
      {problem.value && <p class="problem" role="alert">{problem.value.message}</p>}
      {section("Noise", true, <KindField schema={noiseSchema} root={root} value={json.noise} path={["noise"]} name="noise" />)}
      {grids.length > 1 && (
        <div class="kinds grids" role="radiogroup" aria-label="Grid">
          {(info?.grids ?? []).flatMap(({ names }) => names).map((name, i) => (
            <button key={name} role="radio" aria-checked={i === place} class={i === place ? "on" : ""}
              onClick={() => replaceNoise({ ...activeNoise(), grid: name }, `grid ${name}`)}>{name}</button>
          ))}
        </div>
      )}
      {section("Shaping", true, <KindField schema={resolved(own.shaping ?? {}, root)} root={root} value={isObject(grid) ? grid.shaping : undefined} path={[...gridPath, "shaping"]} name="shaping" />)}
      {section("Layers", isObject(grid) && grid.layers !== undefined, (
        <>
          {isObject(json.fields) && <Field schema={properties.fields ?? {}} root={root} value={json.fields} path={["fields"]} name="fields" />}
          {isObject(grid) && grid.layers !== undefined
            ? <Field schema={own.layers ?? {}} root={root} value={grid.layers} path={[...gridPath, "layers"]} name="layers" />
            : <ObjectFields schema={{ properties: { layers: own.layers ?? {} } }} root={root} value={grid} path={gridPath} name="layers" />}
        </>
      ))}
      {section("Motion", false, <ObjectFields schema={{ properties: Object.fromEntries(kMotion.map((key) => [key, properties[key] ?? {}])) }} root={root} value={json} path={[]} name="motion" />)}
      {section("Grid", false, <ObjectFields schema={gridSchema} root={root} value={grid} path={gridPath} name="grid" skip={["layers", "shaping"]} />)}
      {section("Domain", false, <ObjectFields schema={resolved(properties.domain ?? {}, root)} root={root} value={json.domain} path={["domain"]} name="domain" />)}
      {section("File", false, <ObjectFields schema={{ properties: Object.fromEntries(others.map((key) => [key, properties[key]!])) }} root={root} value={json} path={[]} name="file" />)}
    </>
  );
}
