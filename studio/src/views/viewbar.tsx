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
  const set = (part: Partial<Plane>, tag: string): void => commit({ ...state.value, plane: { ...plane, ...part } }, tag);
  return (
    <div class="viewbar" role="toolbar" aria-label="View">
      {mode === "slice" && kFaces.map(([name, face]) => <button key={name} onClick={() => set(face, `face ${name}`)}>{name}</button>)}
      {mode === "slice" && (
        <button title="All of the box" onClick={() => set(across(info?.box ?? [-1, -1, -1, 1, 1, 1], 1.25), "fit")}>Fit</button>
      )}
      {mode !== "surface" && <label class="inline">Colours
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
  useEffect(() => {
    if (!playing) {
      time.value = undefined;
      return;
    }
    const begin = performance.now();
    let frame = 0;
    const tick = (): void => {
      time.value = Number(((performance.now() - begin) / 1000).toFixed(3));
      frame = requestAnimationFrame(tick);
    };
    tick();
    return () => cancelAnimationFrame(frame);
  }, [playing]);
  const toggle = async (): Promise<void> => {
    // A noise that stands still gets a fourth dimension.
    if (!changes && !playing) await edit([{ path: ["dims"], value: "4" }], "dims");
    setPlaying(!playing);
  };
  return (
    <button aria-pressed={playing} title={changes ? "Play time" : "Make it a noise of four dimensions, and play time"} onClick={() => void toggle()}>
      {playing ? "❚❚ Time" : "▶ Time"}
    </button>
  );
}
