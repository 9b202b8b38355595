import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { engine } from "../engine/engine.ts";
import { across, activeNoise, commit, edit, infoOf, kFront, type Plane, state, time } from "../store.ts";

// What belongs to the pictures, not to the recipe: the plane, colours, time that plays, another noise beside.

const kFaces: [string, Partial<Plane>][] = [
  ["Front", kFront],
  ["Side", { normal: [1, 0, 0], up: [0, 1, 0] }],
  ["Top", { normal: [0, 1, 0], up: [0, 0, -1] }],
];

export function ViewBar(): JSX.Element {
  const { plane, mode, noises, ramp } = state.value;
  const info = infoOf(activeNoise());
  const raw = info?.grids.some((grid) => grid.raw) ?? false;
  const set = (part: Partial<Plane>, tag: string): void => commit({ ...state.value, plane: { ...plane, ...part } }, tag);
  return (
    <div class="viewbar" role="toolbar" aria-label="View">
      {mode === "slice" && kFaces.map(([name, face]) => <button key={name} onClick={() => set(face, `face ${name}`)}>{name}</button>)}
      {mode === "slice" && (
        <button title="All of the box" onClick={() => set(across(info?.box ?? [-1, -1, -1, 1, 1, 1], 1.25), "fit")}>Fit</button>
      )}
      {mode !== "surface" && (mode === "slice" || raw) && <label class="inline">Colours
        <select value={ramp} onChange={(event) => commit({ ...state.value, ramp: event.currentTarget.value }, "ramp")}>
          <option value="">as they are</option>
          {[...engine.ramps.keys()].map((name) => <option key={name} value={name}>{name}</option>)}
        </select>
      </label>}
      <Player changes={info?.changes ?? false} />
      <span class="space" />
      {mode === "slice" && noises.length < 3 && (
        <button title="Another noise beside, to compare" onClick={() => commit({ ...state.value, noises: [...noises, { ...activeNoise() }], active: noises.length }, "compare")}>+ Compare</button>
      )}
    </div>
  );
}

function Player({ changes }: { changes: boolean }): JSX.Element {
  const [playing, setPlaying] = useState(false);
  // From where it was held, or from the recipe's own time.
  useEffect(() => {
    if (!playing) return;
    const from = time.value ?? Number(/"time": (-?[\d.e+-]+)/.exec(activeNoise().text)?.[1] ?? 0);
    const begin = performance.now();
    let frame = 0;
    const tick = (): void => {
      time.value = Number((from + (performance.now() - begin) / 1000).toFixed(3));
      frame = requestAnimationFrame(tick);
    };
    tick();
    return () => cancelAnimationFrame(frame);
  }, [playing]);
  const reset = (): void => {
    setPlaying(false);
    time.value = undefined;
  };
  useEffect(() => reset, []);
  // What stands still has no time; so it is after undo, and for another recipe.
  useEffect(() => {
    if (!changes) reset();
  }, [changes]);
  const toggle = async (): Promise<void> => {
    // A noise that stands still gets a fourth dimension; on surfaces most evolve instead.
    if (!changes) {
      const onSurface = state.value.mode === "surface";
      const evolves = onSurface && !/"noise": "kensler-solid"/.test(activeNoise().text);
      await edit([evolves ? { path: ["surface", "evolve"], value: "0.5" } : { path: onSurface ? ["surface", "dims"] : ["dims"], value: "4" }], "moves");
    }
    setPlaying(!playing && (infoOf(activeNoise())?.changes ?? false));
  };
  const held = !playing && time.value !== undefined;
  return (
    <>
      <button aria-pressed={playing} title={changes ? "Play time, or hold it" : "Make it a noise that changes, and play time"} onClick={() => void toggle()}>
        {playing ? "❚❚ Time" : "▶ Time"}
      </button>
      {held && <button class="icon" aria-label="Back to the recipe's time" title="Back to the recipe's time" onClick={reset}>↺</button>}
    </>
  );
}
