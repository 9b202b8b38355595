import { useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useRef, useState } from "preact/hooks";
import { CopyButton, saveAs } from "../controls/copy.tsx";
import { addressOf } from "../engine/address.ts";
import { activeNoise, infoOf, problem, setText, state } from "../store.ts";

// The recipe as text, live both ways, with errors at their lines; and the commands that make what is seen.

export function RecipePanel(): JSX.Element {
  const area = useRef<HTMLTextAreaElement>(null);
  const gutter = useRef<HTMLDivElement>(null);
  const [text, write] = useState("");
  const [wrong, setWrong] = useState<{ line: number; message: string } | undefined>(undefined);
  const waiting = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
  const own = useRef("");

  const mark = (message: string): void => {
    const found = /^(?:line (\d+)|.*line (\d+))/.exec(message);
    setWrong({ line: Number(found?.[1] ?? found?.[2] ?? 0), message });
  };
  useSignalEffect(() => {
    const now = activeNoise().text;
    const faulty = problem.value;
    if (faulty?.text !== undefined) {
      own.current = now;
      write(faulty.text);
      mark(faulty.message);
      return;
    }
    // What is being typed stays as it is typed.
    if (now === own.current) return;
    own.current = now;
    write(now);
    setWrong(undefined);
  });
  const type = (typed: string): void => {
    write(typed);
    clearTimeout(waiting.current);
    waiting.current = setTimeout(async () => {
      const taken = await setText(typed, "typed");
      if (taken) {
        own.current = activeNoise().text;
        setWrong(undefined);
      } else {
        mark(problem.value?.message ?? "");
      }
    }, 160);
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
          onInput={(event) => type(event.currentTarget.value)}
          onBlur={() => { if (!wrong && own.current !== text) { write(activeNoise().text); own.current = activeNoise().text; } }}
          onScroll={(event) => { if (gutter.current) gutter.current.scrollTop = event.currentTarget.scrollTop; }} />
      </div>
      {wrong && <p class="problem" role="alert">{wrong.message}</p>}
      <Commands />
    </aside>
  );
}

function Commands(): JSX.Element {
  const { plane } = state.value;
  const info = infoOf(activeNoise());
  const grid = info?.grids.find(({ names }) => names.includes(activeNoise().grid)) ?? info?.grids[0];
  const numbers = (values: readonly number[]): string => values.map((x) => Number(x.toPrecision(6))).join(" ");
  const sliced = grid?.raw && info?.grids.length === 1;
  const commands = state.value.mode === "surface" ? [
    `meshnoise bake ${state.value.mesh} --recipe recipe.json --out baked.ply --preview baked.png`,
  ] : [
    "vdbnoise --recipe recipe.json --out noise.vdb --preview noise.png",
    ...(sliced ? [`vdbnoise slice --recipe recipe.json --origin ${numbers(plane.origin)} --normal ${numbers(plane.normal)} --up ${numbers(plane.up)} --width ${numbers([plane.width])} --resolution 1024 --out slice.png`] : []),
    `vdbnoise --recipe '${addressOf(state.value)}' --out noise.vdb`,
  ];
  return (
    <section class="commands">
      <h2>In the shell</h2>
      {commands.map((command) => (
        <div class="command" key={command}>
          <code>{command.replace(/(#.{14})[^']*/, "$1…")}</code>
          <CopyButton label="Copy" text={() => command} />
        </div>
      ))}
      <p class="hint">Volumes of more than 128 voxels a side, files and meshes of your own are made there.</p>
    </section>
  );
}
