import { useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { edited, fitPhotograph, groupEdits, type Model, type Photograph, readPhotograph, textureOf, versionOf } from "../engine/example.ts";
import { engine } from "../engine/engine.ts";
import { Dropped } from "../engine/pool.ts";
import { commit, type GroupEdit, setText, state } from "../store.ts";
import { SpectrumEditor } from "./spectrum_editor.tsx";

// A noise from a photograph: the exemplar, the best that noise can do of it, its sparse spectrum, the noise; and the spectrum by hand.

const kPhotographs = ["earth", "leaves", "moss", "rock", "sand", "soil", "wood"];
const kNeutral: GroupEdit = { magnitude: 1, scale: 1, rotate: 0 };
let photograph: Photograph | undefined; // for as long as the page is open

export function ExampleView(): JSX.Element {
  const [busy, setBusy] = useState<number | undefined>(undefined);
  const [trouble, setTrouble] = useState("");
  const [report, setReport] = useState<{ text: string; warnings: string[]; seconds: number } | undefined>(undefined);
  const [over, setOver] = useState(false);
  const [side, setSide] = useState(256);
  const [axes, setAxes] = useState("independent");
  const [model, setModel] = useState(""); // with what is done to the groups
  const [ms, setMs] = useState(0);
  const panels = { exemplar: useRef<HTMLCanvasElement>(null), version: useRef<HTMLCanvasElement>(null), sparse: useRef<HTMLCanvasElement>(null), noise: useRef<HTMLCanvasElement>(null) };

  const put = (panel: keyof typeof panels, image: ImageData): void => {
    const canvas = panels[panel].current;
    if (!canvas) return;
    canvas.width = image.width;
    canvas.height = image.height;
    canvas.getContext("2d")!.putImageData(image, 0, 0);
    canvas.dispatchEvent(new CustomEvent("pictured", { bubbles: true, detail: { panel } }));
  };
  const showPhotograph = (): void => {
    if (!photograph) return;
    const { width, height, bytes } = photograph;
    put("exemplar", new ImageData(new Uint8ClampedArray(bytes), width, height));
  };
  useEffect(showPhotograph, []);

  const fit = async (taken: Photograph): Promise<void> => {
    photograph = taken;
    showPhotograph();
    engine.modeller.interrupt("fit");
    setBusy(0);
    setTrouble("");
    const begin = performance.now();
    try {
      void versionOf(taken).then((image) => put("version", image), () => undefined);
      const found = await fitPhotograph(taken, axes, setBusy);
      const seconds = (performance.now() - begin) / 1000;
      engine.times.fit = 1000 * seconds;
      setReport({ text: found.report, warnings: found.warnings, seconds });
      commit({ ...state.value, example: found.exemplar, groups: {} }, "fit");
    } catch (error) {
      if (!(error instanceof Dropped)) setTrouble((error as Error).message);
    } finally {
      setBusy(undefined);
    }
  };
  const take = async (file: Blob | undefined, name: string): Promise<void> => {
    if (!file) return;
    try {
      await fit(await readPhotograph(file, name, side));
    } catch (error) {
      setTrouble((error as Error).message);
    }
  };

  // The model with what is done to its groups, and its pictures: a small one that follows, then a large one.
  const generation = useRef(0);
  useSignalEffect(() => {
    const { example, groups } = state.value;
    const own = ++generation.current;
    if (!example) return setModel("");
    void (async () => {
      try {
        const changed = await edited(example, groupEdits(groups));
        if (own !== generation.current) return;
        setModel(changed);
        setTrouble("");
        const [width, height] = photograph ? [photograph.width, photograph.height] : [256, 256];
        for (const scale of [0.5, 1]) {
          const begin = performance.now();
          const image = await textureOf(changed, Math.round(width * scale), Math.round(height * scale), 1 / (width * scale), false);
          if (own !== generation.current) return;
          put("noise", image);
          setMs(performance.now() - begin);
        }
        put("sparse", await textureOf(changed, width, height, 1 / width, true));
      } catch (error) {
        if (!(error instanceof Dropped) && own === generation.current) setTrouble((error as Error).message);
      }
    })();
  });

  const parsed = model ? (JSON.parse(model) as Model) : undefined;
  const groups = [...new Set(parsed?.channels.flatMap((channel) => channel.groups) ?? [])];
  const change = (group: string, part: Partial<GroupEdit>): void =>
    commit({ ...state.value, groups: { ...state.value.groups, [group]: { ...kNeutral, ...state.value.groups[group], ...part } } }, `group ${group}`);
  const download = (): void => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([JSON.stringify({ solidnoise: 2, exemplar: parsed }, null, 1)], { type: "application/json" }));
    link.download = `${(photograph?.name ?? "noise").replace(/\.\w+$/, "")}.json`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  const onMesh = (): void => {
    const recipe = { solidnoise: 2, surface: { noise: "spectrum", exemplar: parsed }, frequency: Number((8).toFixed(1)), ramp: "exemplar" };
    void setText(JSON.stringify(recipe), "example on a mesh", { mode: "surface" });
  };

  return (
    <div class={`byexample${over ? " over" : ""}`}
      onDragOver={(event) => { event.preventDefault(); setOver(true); }} onDragLeave={() => setOver(false)}
      onDrop={(event) => { event.preventDefault(); setOver(false); const file = event.dataTransfer?.files[0]; void take(file, file?.name ?? ""); }}>
      <div class="sources">
        <label class="file">Open a photograph<input type="file" accept="image/*" aria-label="A photograph" onChange={(event) => { const file = event.currentTarget.files?.[0]; void take(file, file?.name ?? ""); }} /></label>
        {kPhotographs.map((name) => (
          <button key={name} class="photo" title={name} onClick={async () => void take(await (await fetch(new URL(`${name}.jpg`, document.baseURI))).blob(), `${name}.jpg`)}>
            <img src={`${name}.jpg`} alt="" loading="lazy" />{name}
          </button>
        ))}
        <label class="inline">Side <select value={side} onChange={(event) => setSide(Number(event.currentTarget.value))}>{[128, 256, 384, 512].map((n) => <option key={n} value={n}>{n} pixels</option>)}</select></label>
        <label class="inline">Colour axes <select value={axes} onChange={(event) => setAxes(event.currentTarget.value)}>{["independent", "pca", "rgb"].map((word) => <option key={word}>{word}</option>)}</select></label>
        {busy !== undefined && <><progress value={busy} aria-label="Fitting" /><button onClick={() => { engine.modeller.interrupt("fit"); setBusy(undefined); }}>Stop</button></>}
      </div>
      {trouble && <p class="problem" role="alert">{trouble}</p>}
      <div class="panels">
        {([["exemplar", "Exemplar"], ["version", "Gaussian version: the best that noise can do"], ["sparse", "Sparse spectrum"], ["noise", `Noise · ${ms.toFixed(0)} ms`]] as const).map(([panel, title]) => (
          <figure key={panel}><canvas ref={panels[panel]} width="256" height="256" role="img" aria-label={title} /><figcaption>{title}</figcaption></figure>
        ))}
      </div>
      {!parsed && busy === undefined && <p class="invite">Drop a photograph here, or take one of those above: sand, soil, moss and their like become a noise without seams.</p>}
      {report && (
        <div class="report"><p>{report.text.replace(/[;,]? (in )?0(\.0+)? s(econds)?\b/, "")} · {report.seconds.toFixed(1)} s</p>{report.warnings.map((warning) => <p key={warning} class="warning">{warning}</p>)}</div>
      )}
      {parsed && (
        <div class="workbench">
          <SpectrumEditor model={parsed} change={async (edits) => {
            // What was done to groups stays done: sliders begin anew.
            try {
              commit({ ...state.value, example: await edited(model, edits), groups: {} }, `spectrum ${edits[0]?.edit}`);
            } catch (error) {
              setTrouble((error as Error).message);
            }
          }} />
          <div class="groups">
            {groups.map((group) => {
              const now = { ...kNeutral, ...state.value.groups[group] };
              return (
                <fieldset key={group}><legend>{group}</legend>
                  <GroupSlider label="Strength" value={now.magnitude} low={0} high={3} step={0.01} write={(magnitude) => change(group, { magnitude })} />
                  <GroupSlider label="Scale" value={Math.log2(now.scale)} shown={now.scale} low={-2} high={2} step={0.02} write={(octaves) => change(group, { scale: Number((2 ** octaves).toPrecision(4)) })} />
                  <GroupSlider label="Angle" value={now.rotate} low={-180} high={180} step={1} write={(rotate) => change(group, { rotate })} />
                </fieldset>
              );
            })}
            <div class="more">
              <button class="wide" onClick={onMesh}>On a mesh</button>
              <button class="wide" onClick={download}>Download for vdbnoise and meshnoise</button>
            </div>
          </div>
        </div>
      )}
    </div>
  );
}

function GroupSlider({ label, value, shown = value, low, high, step, write }: { label: string; value: number; shown?: number; low: number; high: number; step: number; write: (value: number) => void }): JSX.Element {
  return (
    <label class="row"><span class="name">{label}</span>
      <span class="slide" style={{ "--t": `${(100 * (value - low)) / (high - low)}%` }}>
        <input type="range" min={low} max={high} step={step} value={value} onInput={(event) => write(Number(event.currentTarget.value))} />
      </span>
      <output class="number">{Number(shown.toFixed(2))}</output>
    </label>
  );
}
