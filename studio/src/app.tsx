import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { CopyButton } from "./controls/copy.tsx";
import { Choice } from "./controls/choice.tsx";
import { Controls } from "./controls/controls.tsx";
import { Gallery } from "./views/gallery.tsx";
import { RecipePanel } from "./views/recipe.tsx";
import { SliceView } from "./views/slice.tsx";
import { SpectrumView } from "./views/spectrum.tsx";
import { ViewBar } from "./views/viewbar.tsx";
import { ExampleView } from "./views/example.tsx";
import { SurfaceView } from "./views/surface.tsx";
import { VolumeView } from "./views/volume.tsx";
import { addressOf } from "./engine/address.ts";
import { keep } from "./engine/kept.ts";
import { can, commit, type Mode, problem, redo, state, undo } from "./store.ts";

const kModes: [Mode, string][] = [["slice", "Slice"], ["volume", "Volume"], ["surface", "Surface"], ["example", "By example"]];

function choose(i: number): void {
  const [mode] = kModes[i]!;
  if (mode !== state.value.mode) commit({ ...state.value, mode }, `mode ${i}`);
}

export function App(): JSX.Element {
  const [gallery, setGallery] = useState(false);
  const [panel, setPanel] = useState(innerWidth > 1100 || problem.value?.text !== undefined);
  const { noises, active, mode } = state.value;
  const shown = kModes.findIndex(([own]) => own === mode);
  return (
    <div class={`app ${mode}`}>
      <header class="bar">
        <h1><Mark />Solidnoise <span>Studio</span></h1>
        <button class="wide" onClick={() => setGallery(true)}>Gallery</button>
        <Choice tabs label="Views" look="tabs" words={kModes.map(([, label]) => label)} chosen={shown} choose={choose} />
        <span class="space" />
        <button class="icon" aria-label="Undo" title="Undo (Ctrl+Z)" disabled={!can.value.undo} onClick={undo}>↶</button>
        <button class="icon" aria-label="Redo" title="Redo (Ctrl+Shift+Z)" disabled={!can.value.redo} onClick={redo}>↷</button>
        <CopyButton text={() => addressOf(state.value)} label="Copy link" />
        <button class="wide" aria-pressed={panel} disabled={mode === "example"} onClick={() => setPanel(!panel)}>Recipe</button>
        <button class="icon" aria-label="Dark or light" title="Dark or light" onClick={toggleTheme}>◐</button>
      </header>
      {mode !== "example" && <aside class="controls" aria-label="Controls"><Controls /></aside>}
      <main class={`stage ${mode}`}>
        {mode !== "example" && <ViewBar />}
        <div class={`views n${mode === "slice" ? noises.length : 1}`} role="tabpanel" aria-label={kModes[shown]![1]}>
          {mode === "slice" && noises.map((noise, index) => (
            <section key={index} class={`pane${index === active && noises.length > 1 ? " active" : ""}`}
              onPointerDown={() => index !== state.value.active && commit({ ...state.value, active: index }, `active ${index}`)}>
              {noises.length > 1 && (
                <h2><button onClick={() => commit({ ...state.value, active: index }, `active ${index}`)}>{titleOf(noise.text)}</button>
                  <button class="icon" aria-label="Remove this noise" onClick={(event) => {
                    event.stopPropagation();
                    commit({ ...state.value, noises: noises.filter((_, i) => i !== index), active: 0 }, "remove noise");
                  }}>×</button></h2>
              )}
              <SliceView index={index} />
            </section>
          ))}
          {mode === "volume" && <VolumeView />}
          {mode === "surface" && <SurfaceView />}
          {mode === "example" && <ExampleView />}
        </div>
        {mode === "slice" && <SpectrumView />}
      </main>
      {panel && mode !== "example" && <RecipePanel />}
      {gallery && <Gallery close={() => setGallery(false)} />}
    </div>
  );
}

function titleOf(text: string): string {
  const kind = /"type": "([\w-]+)"/.exec(text)?.[1] ?? "noise";
  const frequency = /"frequency": ([\d.]+)/.exec(text)?.[1];
  return frequency ? `${kind} ${Number(frequency)}` : kind;
}

function toggleTheme(): void {
  const { dataset } = document.documentElement;
  dataset.theme = dataset.theme === "dark" ? "light" : "dark";
  keep("solidnoise-theme", dataset.theme);
}

// A ring of waves, as the spectrum of the noise is.
function Mark(): JSX.Element {
  return (
    <svg class="mark" viewBox="0 0 24 24" aria-hidden="true">
      <circle cx="12" cy="12" r="10" /><circle cx="12" cy="12" r="6" /><circle cx="12" cy="12" r="2" />
    </svg>
  );
}
