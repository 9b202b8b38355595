import type { JSX } from "preact";
import { useRef, useState } from "preact/hooks";
import { Commands, CopyButton, fileWord, quoted, saveAs } from "../controls/copy.tsx";
import { addressOf } from "../engine/address.ts";
import { activeNoise, activePlace, infoOf, pixels, problem, setText, state } from "../store.ts";
import { useEffectAtOnce } from "./at_once.ts";

// The recipe as text, live both ways, with errors at their lines; and the commands that make what is seen.

export function RecipePanel(): JSX.Element {
  const area = useRef<HTMLTextAreaElement>(null);
  const gutter = useRef<HTMLDivElement>(null);
  const [text, write] = useState(() => activeNoise().text);
  const [wrong, setWrong] = useState<{ line: number; message: string } | undefined>(undefined);
  const waiting = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
  const own = useRef(text);
  const typing = useRef(false); // what is typed is being taken
  const place = useRef(activePlace());

  const mark = (message: string): void => {
    const found = /^(?:line (\d+)|.*line (\d+))/.exec(message);
    setWrong({ line: Number(found?.[1] ?? found?.[2] ?? 0), message });
  };
  useEffectAtOnce(() => {
    const now = activeNoise().text;
    const faulty = problem.value;
    const moved = place.current !== activePlace();
    place.current = activePlace();
    if (faulty?.text !== undefined) {
      own.current = now;
      write(faulty.text);
      mark(faulty.message);
      return;
    }
    // What is being typed stays as it is typed.
    const stays = !moved && (now === own.current || typing.current);
    if (moved) clearTimeout(waiting.current);
    own.current = now;
    if (stays) return;
    write(now);
    setWrong(undefined);
  });
  const type = (typed: string): void => {
    write(typed);
    clearTimeout(waiting.current);
    waiting.current = setTimeout(async () => {
      typing.current = true;
      const taken = await setText(typed, "typed");
      typing.current = false;
      if (taken) {
        own.current = activeNoise().text;
        setWrong(undefined);
      } else {
        mark(problem.value?.message ?? "");
      }
    }, 160);
  };
  // Back to the recipe that is shown.
  const revert = (): void => {
    clearTimeout(waiting.current);
    problem.value = undefined;
    own.current = activeNoise().text;
    write(own.current);
    setWrong(undefined);
  };
  const lines = text.split("\n").length;
  return (
    <aside class="recipe" aria-label="Recipe">
      <header>
        <h2>Recipe</h2>
        <CopyButton text={() => activeNoise().text} label="Copy" />
        <button class="wide" onClick={() => saveAs("recipe.json", activeNoise().text)}>Download</button>
      </header>
      <div class="editor">
        <div class="gutter" ref={gutter} aria-hidden="true">
          {Array.from({ length: lines }, (_, i) => <div key={i} class={wrong?.line === i + 1 ? "wrong" : ""}>{i + 1}</div>)}
        </div>
        <textarea ref={area} spellcheck={false} aria-label="The recipe as JSON" aria-invalid={wrong !== undefined} value={text}
          onInput={(event) => type(event.currentTarget.value)} onKeyDown={(event) => event.key === "Escape" && wrong && revert()}
          onBlur={() => { if (!wrong && own.current !== text) { write(activeNoise().text); own.current = activeNoise().text; } }}
          onScroll={(event) => { if (gutter.current) gutter.current.scrollTop = event.currentTarget.scrollTop; }} />
      </div>
      {wrong && <p class="problem" role="alert">{wrong.message} <button onClick={revert}>Back to what is shown</button></p>}
      <Commands commands={commandsOf()} hint="Volumes of more than 128 voxels a side, files and meshes of your own are made there." />
    </aside>
  );
}

function commandsOf(): string[] {
  const { mode, mesh, plane, ramp } = state.value;
  if (mode === "surface") return [`meshnoise bake ${fileWord(mesh)} --recipe recipe.json --out baked.ply --preview baked.png`];
  const { text, grid: name } = activeNoise();
  const info = infoOf(activeNoise());
  const grid = info?.grids.find(({ names }) => names.includes(name)) ?? info?.grids[0];
  const commands = ["vdbnoise --recipe recipe.json --out noise.vdb --preview noise.png"];
  // The tool's slices are of noises, in all of space.
  const shape = (JSON.parse(text || "{}") as { domain?: { shape?: { type?: string } } }).domain?.shape?.type ?? "box";
  const colors = /"output": "color"/.test(text);
  if (grid?.raw && info?.grids.length === 1 && shape === "box" && (grid.scalar || colors)) {
    const numbers = (values: readonly number[]): string => values.map((x) => Number(x.toPrecision(6))).join(" ");
    const look = ramp && !colors ? ` --ramp ${quoted(ramp)}` : "";
    commands.push(`vdbnoise slice --recipe recipe.json --origin ${numbers(plane.origin)} --normal ${numbers(plane.normal)} --up ${numbers(plane.up)} --width ${numbers([plane.width])} --resolution ${pixels.value.join(" ")}${look} --out slice.png`);
  }
  commands.push(`vdbnoise --recipe ${quoted(addressOf(state.value))} --out noise.vdb`);
  return commands;
}
