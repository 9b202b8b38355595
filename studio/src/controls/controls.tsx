import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { engine } from "../engine/engine.ts";
import { activeNoise, infoOf, problem, replaceNoise, state } from "../store.ts";
import { Choice } from "./choice.tsx";
import { Field, Fold, KindField, ObjectFields } from "./fields.tsx";
import { isObject, type Json, read, resolved, type Schema } from "./schema.ts";

// The recipe's parts as sections; what is in them comes from the table of fields.

const kMotion = ["dims", "time", "offset", "wind"];
const kAtoms = ["noise", "grids", "domain", "fields", "solidnoise", "algorithm", "$schema", "description"];

const kUndescribed = [{ path: ["description"] }]; // another noise is not what was described

const section = (title: string, open: boolean, children: JSX.Element): JSX.Element => (
  <Fold look="section" title={title} open={open}>{children}</Fold>
);

function SurfaceControls({ json, root }: { json: { [key: string]: Json }; root: Schema }): JSX.Element {
  const { surface, layers, ...others } = root.properties ?? {};
  const apart = ["solidnoise", "algorithm", "$schema", "description", "refine", "direction"];
  return (
    <>
      {typeof json.description === "string" && json.description && <p class="description">{json.description}</p>}
      {problem.value && <p class="problem" role="alert">{problem.value.message}</p>}
      {section("Noise on the surface", true, <ObjectFields schema={surface ?? {}} root={root} value={json.surface} path={["surface"]} name="surface" skip={["exemplar"]} />)}
      {section("Look", true, <ObjectFields schema={{ properties: others }} root={root} value={json} path={[]} name="look" skip={apart} />)}
      {section("Layers", json.layers !== undefined, <ObjectFields schema={{ properties: { layers: layers ?? {} } }} root={root} value={json} path={[]} name="layers" />)}
      {section("Mesh", false, <ObjectFields schema={{ properties: { refine: others.refine ?? {}, direction: others.direction ?? {} } }} root={root} value={json} path={[]} name="mesh" />)}
    </>
  );
}

// Between surfaces and others all controls are made anew: after the view is, in a task of their own.
export function Controls(): JSX.Element | null {
  const onSurface = state.value.mode === "surface";
  const [are, become] = useState(onSurface);
  useEffect(() => become(onSurface), [onSurface]);
  const last = useRef<JSX.Element | null>(null);
  if (are === onSurface) last.current = made(onSurface);
  return last.current;
}

function made(onSurface: boolean): JSX.Element | null {
  const root = onSurface ? engine.bakeSchema : engine.schema;
  const json = read(activeNoise().text || "{}");
  if (!isObject(json) || !root.properties) return null;
  if (onSurface) return <SurfaceControls json={json} root={root} />;
  const { properties } = root;
  const grids = Array.isArray(json.grids) ? json.grids : [];
  const names = infoOf(activeNoise())?.grids.flatMap((grid) => grid.names) ?? [];
  const place = Math.max(0, grids.findIndex((grid) => isObject(grid) && grid.name === activeNoise().grid));
  const grid = grids[place];
  const gridSchema = resolved(resolved(properties.grids ?? {}, root).items ?? {}, root);
  const own = gridSchema.properties ?? {};
  const gridPath = ["grids", place];
  const noiseSchema = resolved(properties.noise ?? {}, root);
  const others = Object.keys(properties).filter((key) => key in json && !kMotion.includes(key) && !kAtoms.includes(key));
  return (
    <>
      {typeof json.description === "string" && <p class="description">{json.description}</p>}
      {problem.value && <p class="problem" role="alert">{problem.value.message}</p>}
      {section("Noise", true, <KindField schema={noiseSchema} root={root} value={json.noise} path={["noise"]} name="noise" along={kUndescribed} />)}
      {grids.length > 1 && (
        <Choice label="Grid" look="kinds grids" words={names} chosen={place} choose={(i) => replaceNoise({ ...activeNoise(), grid: names[i]! }, `grid ${i}`)} />
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
