import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { engine } from "../engine/engine.ts";
import { Dropped } from "../engine/pool.ts";
import { activeNoise, colorsOf, infoOf, state, timeOf } from "../store.ts";
import { useChanges } from "./at_once.ts";
import { Orbit } from "./orbit.ts";
import { SceneCanvas, useScene } from "./scene.tsx";
import { turned, type VolumeData, type VolumeLook, type VolumeShot } from "./volume_renderer.ts";

// The voxels of a preview, marched through: a cloud under a sun, a fire or nebula that glows, or a body with the values' colours.

const kSun = [0.5, 0.75, 0.45]; // where it is from, with the Y axis up

// A grid's values, by all workers.
async function voxels(question: Record<string, unknown>, columns: number): Promise<Pick<VolumeData, "size" | "values" | "range">> {
  const thick = Math.max(4, Math.ceil(columns / Math.max(4, 2 * engine.pool.size)));
  const jobs = [];
  for (let first = 0; first < columns; first += thick) jobs.push(engine.pool.ask("volume", { do: "volume", ...question, first, count: thick }));
  const parts = await Promise.all(jobs);
  const size = parts[0]!.json.size as [number, number, number];
  const values = new Float32Array(size[0] * size[1] * size[2]);
  const slabs = parts.filter(({ floats }) => floats[0]);
  for (const { json, floats } of slabs) values.set(floats[0]!, Number(json.first) * size[1] * size[2]);
  return { size, values, range: [Math.min(...slabs.map(({ json }) => Number(json.low))), Math.max(...slabs.map(({ json }) => Number(json.high)))] };
}

export function VolumeView(): JSX.Element {
  const [told, tell] = useState("");
  const [cut, setCut] = useState(0.5);
  const generation = useRef(0);
  const scene = useScene<VolumeData, VolumeShot>("volume", new Orbit(0.55, 0.22, 2.15),
    (canvas) => Math.min(1, 900 / Math.max(canvas.clientWidth, canvas.clientHeight)), (eye) => ({ eye, cut }));
  const { render, setTrouble } = scene;
  useEffect(() => () => engine.pool.drop("volume"), []);
  useEffect(render, [cut]);

  // Coarse first, then fine: 32, 64, 128 voxels along the longest side.
  const make = async (own: number): Promise<void> => {
    const noise = activeNoise();
    const info = infoOf(noise);
    const single = info?.grids.find((grid) => grid.names.includes(noise.grid)) ?? info?.grids[0];
    if (!info || !single || !scene.open()) return; // a surface's recipe, as this view is left for it, has no grids
    const looksLike = /"look": "(\w+)"/.exec(noise.text)?.[1] ?? "automatic";
    // A fire is seen by the light of its temperature, and of its flame where it has one.
    const hot = single === info.grids[0] && !single.raw && ["automatic", "fire"].includes(looksLike) && info.grids.some(({ names }) => names.includes("temperature"));
    const look: VolumeLook = single.raw ? "solid" : hot ? "fire" : looksLike === "nebula" ? "glow" : looksLike === "smoke" ? "smoke" : "cloud";
    const up = /"up": "z"/.test(noise.text) ? 2 : 1;
    const sun = turned(kSun, up);
    const begin = performance.now();
    const when = timeOf(noise);
    try {
      for (const dim of [32, 64, 128]) {
        const { box } = info;
        const sides = [0, 1, 2].map((axis) => box[axis + 3]! - box[axis]!) as [number, number, number];
        const ask = (grid: string) => ({ recipe: noise.text, grid, dim, ...(when === undefined ? {} : { time: when }) });
        const { size, values, range } = await voxels(ask(noise.grid), Math.ceil((dim * sides[0]) / Math.max(...sides)) + 1);
        const kinds = hot ? ["temperature", "flame"].filter((name) => info.grids.some(({ names }) => names.includes(name))) : [];
        const glow: VolumeData["glow"] = [];
        for (const name of kinds) glow.push((await voxels(ask(name), size[0])).values);
        let light: VolumeData["light"];
        let factor = 1;
        if (!single.raw) {
          const bytes = new Uint8Array(values.slice().buffer);
          const lit = await engine.pool.ask("volume", { do: "light", ...ask(noise.grid), size, sun }, { bytes });
          light = lit.floats[0];
          factor = Number(lit.json.factor);
        }
        if (own !== generation.current || !scene.open()) return;
        const ramp = engine.ramps.get(state.value.ramp) ?? (colorsOf(info) ? engine.body! : engine.ramps.get(single.raw ? "marble" : "grey")!);
        scene.load({ size, values, range, light, glow, factor, sides, look, sun, up, ramp }, [values, light, ...glow], () => {
          const took = performance.now() - begin;
          tell(`${size.join(" × ")} voxels · ${took.toFixed(0)} ms`);
          engine.times[`volume ${dim}`] = took;
          scene.canvas.current?.dispatchEvent(new CustomEvent("pictured", { bubbles: true, detail: { dim } }));
        });
        if (when !== undefined) return;
        setTrouble("");
      }
    } catch (error) {
      if (!(error instanceof Dropped)) setTrouble((error as Error).message);
    }
  };
  useChanges(() => {
    const noise = activeNoise();
    return [noise.text, noise.grid, state.value.ramp, timeOf(noise), infoOf(noise) !== undefined];
  }, () => {
    engine.pool.drop("volume");
    void make(++generation.current);
  });
  const raw = infoOf(activeNoise())?.grids.find((grid) => grid.names.includes(activeNoise().grid || grid.names[0]!))?.raw ?? false;
  return (
    <figure class="view volume">
      <SceneCanvas scene={scene} what="The volume" />
      <figcaption>
        <span role="status">{told}</span>
        {raw && <label class="inline">Cut <input type="range" min="0" max="1" step="0.01" value={cut} onInput={(event) => setCut(Number(event.currentTarget.value))} /></label>}
      </figcaption>
    </figure>
  );
}
