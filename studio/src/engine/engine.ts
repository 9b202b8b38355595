import type { Schema } from "../controls/schema.ts";
import { loadModule, Pool } from "./pool.ts";

let module: WebAssembly.Module | undefined;
let fitter: Pool | undefined;

// What all views share: workers, the table of fields, ramps.
export const engine = {
  pool: undefined as unknown as Pool,
  desk: undefined as unknown as Pool, // for what must answer at once: recipes
  modeller: undefined as unknown as Pool, // which has the mesh, and measures spectra
  // Of photographs, which takes longer than others may wait.
  get fitter(): Pool {
    return (fitter ??= new Pool(module!, 1));
  },
  schema: {} as Schema,
  bakeSchema: {} as Schema,
  ramps: new Map<string, Float32Array>(),
  body: undefined as Float32Array | undefined, // the ramp of a body's colours: white where they are 0
  times: { start: 0, slice: 0 } as Record<string, number>,
};

export async function startEngine(): Promise<void> {
  module = await loadModule();
  const cores = navigator.hardwareConcurrency || 4;
  engine.desk = new Pool(module, 1);
  engine.pool = new Pool(module, Math.max(1, Math.min(8, cores > 2 ? cores - 1 : cores)));
  engine.modeller = new Pool(module, 1);
  const { json, floats } = await engine.desk.ask("desk", { do: "fields" });
  engine.schema = json.volume as Schema;
  engine.bakeSchema = (json.surface ?? {}) as Schema;
  (json.ramps as string[]).forEach((name, i) => engine.ramps.set(name, floats[i]!));
  engine.body = engine.ramps.get("marble")!.map((_, i, marble) => marble[765 - i + 2 * (i % 3)]!);
}
