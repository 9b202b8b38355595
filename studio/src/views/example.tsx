import { batch, signal, useComputed } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import {
  edited, fitPhotograph, groupEdits, keepPhotograph, type Model, type Photograph, readPhotograph, restoredPhotograph, textureOf, versionOf,
} from "../engine/example.ts";
import { Commands, fileWord, saveAs } from "../controls/copy.tsx";
import { dragging, onFile } from "../drop.ts";
import { engine } from "../engine/engine.ts";
import { Follower } from "../engine/follower.ts";
import { Dropped } from "../engine/pool.ts";
import { commit, type GroupEdit, type KeptPhotograph, setText, type State, state } from "../store.ts";
import { useEffectAtOnce } from "./at_once.ts";
import { paint } from "./paint.ts";
import { SpectrumEditor } from "./spectrum_editor.tsx";

// A noise from a photograph: the exemplar, the best that noise can do of it, its sparse spectrum, the noise; and the spectrum by hand.

const kPhotographs = ["earth", "leaves", "moss", "rock", "sand", "soil", "wood"];
const kGlance = 36; // milliseconds that the picture may take that follows a slider
const kLeastShare = 0.125;
const kNeutral: GroupEdit = { magnitude: 1, scale: 1, rotate: 0 };
let photograph: Photograph | undefined; // the one that is shown
// A fit goes on while another view is looked at.
const fitting = signal<{ photograph: KeptPhotograph; done: number } | undefined>(undefined);
const trouble = signal("");

const stop = (): void => {
  engine.fitter.interrupt("fit");
  fitting.value = undefined;
};

async function take(file: Blob | undefined, name: string, side: number, axes: string): Promise<void> {
  if (!file) return;
  stop();
  trouble.value = "";
  try {
    const taken = await readPhotograph(file, name, side);
    const kept = await keepPhotograph(taken);
    fitting.value = { photograph: kept, done: 0 };
    const begin = performance.now();
    const found = await fitPhotograph(taken, axes, (done) => {
      fitting.value = { photograph: kept, done };
    });
    engine.times.fit = performance.now() - begin;
    const report = { text: found.report, warnings: found.warnings, seconds: engine.times.fit / 1000 };
    batch(() => {
      fitting.value = undefined;
      commit({ ...state.value, example: found.exemplar, groups: {}, photograph: kept, report }, "fit");
    });
  } catch (error) {
    if (error instanceof Dropped) return;
    fitting.value = undefined;
    trouble.value = (error as Error).message;
  }
}

export function ExampleView(): JSX.Element {
  const [side, setSide] = useState(256);
  const [axes, setAxes] = useState("independent");
  const [model, setModel] = useState(""); // with what is done to the groups
  const [ms, setMs] = useState(0);
  const panels = { exemplar: useRef<HTMLCanvasElement>(null), version: useRef<HTMLCanvasElement>(null), sparse: useRef<HTMLCanvasElement>(null), noise: useRef<HTMLCanvasElement>(null) };

  const put = (panel: keyof typeof panels, image: ImageData, sharp = false): void => {
    const canvas = panels[panel].current;
    // What was on its way when the model was undone comes too late.
    if (!canvas || ((panel === "noise" || panel === "sparse") && !state.value.example)) return;
    canvas.width = image.width;
    canvas.height = image.height;
    paint(canvas).putImageData(image, 0, 0);
    canvas.dispatchEvent(new CustomEvent("pictured", { bubbles: true, detail: { panel, side: image.width, sharp } }));
  };
  // What a photograph is, beside the best that noise can do of it.
  const shown = useRef("");
  const showPhotograph = async ({ name, url }: KeptPhotograph): Promise<void> => {
    if (shown.current === url) return;
    shown.current = url;
    const own = await restoredPhotograph(name, url);
    if (shown.current !== url) return;
    photograph = own;
    put("exemplar", new ImageData(new Uint8ClampedArray(own.bytes), own.width, own.height));
    engine.pool.drop("version");
    const version = await versionOf(own);
    if (shown.current === url) put("version", version);
  };
  const clear = (): void => {
    shown.current = "";
    photograph = undefined;
    for (const { current } of Object.values(panels)) if (current) paint(current).clearRect(0, 0, current.width, current.height);
  };
  const wanted = useComputed(() => fitting.value?.photograph ?? state.value.photograph);
  const isEmpty = useComputed(() => !wanted.value && !state.value.example);
  useEffectAtOnce(() => {
    if (wanted.value) void showPhotograph(wanted.value).catch(() => undefined);
    else if (isEmpty.value) clear();
  });

  // The noise, a small picture that follows, then a large one; and the model with what is done to its groups, which others show.
  type Asked = Pick<State, "example" | "groups">;
  const drawNoise = async ({ example, groups }: Asked, scale: number, wanted = () => true): Promise<void> => {
    const { width, height } = photograph ?? { width: 256, height: 256 };
    const begin = performance.now();
    const edits = groupEdits(groups);
    const image = await textureOf(example, edits, Math.round(width * scale), Math.round(height * scale), 1 / (width * scale), false);
    if (!wanted()) return;
    put("noise", image, scale === 1);
    setMs(performance.now() - begin);
    trouble.value = "";
    void edited(example, edits).then((text) => state.value.example === example && state.value.groups === groups && setModel(text), () => undefined);
    if (scale < 1) return;
    const sparse = await textureOf(example, edits, width, height, 1 / width, true);
    if (wanted()) put("sparse", sparse);
  };
  const share = useRef(kLeastShare); // of the photograph's side, of the next small one
  const follow = async (asked: Asked): Promise<void> => {
    const begin = performance.now();
    await drawNoise(asked, share.current);
    const took = performance.now() - begin;
    if (took > kGlance) share.current = Math.max(kLeastShare, share.current / 2);
    else if (took < kGlance / 3) share.current = Math.min(0.5, share.current * 2);
  };
  const follower = useRef<Follower<Asked>>(null);
  follower.current ??= new Follower(follow, (asked, wanted) => drawNoise(asked, 1, wanted), (error) => {
    trouble.value = error.message;
  });
  useEffect(() => () => follower.current?.stop(), []);
  useEffect(() => onFile("picture", (file) => void take(file, file.name, side, axes)), [side, axes]);
  useEffectAtOnce(() => {
    const { example, groups } = state.value;
    if (example) follower.current?.want({ example, groups });
    else {
      follower.current?.stop();
      setModel("");
    }
  });

  const parsed = useMemo(() => (model ? (JSON.parse(model) as Model) : undefined), [model]);
  const { report } = state.value;
  const busy = fitting.value?.done;
  const groups = [...new Set(parsed?.channels.flatMap((channel) => channel.groups) ?? [])];
  const change = (group: string, part: Partial<GroupEdit>): void =>
    commit({ ...state.value, groups: { ...state.value.groups, [group]: { ...kNeutral, ...state.value.groups[group], ...part } } }, `group ${group}`);
  const name = (state.value.photograph?.name ?? "noise").replace(/\.\w+$/, "");
  const download = (): void =>
    saveAs(`${name}.json`, JSON.stringify({ solidnoise: 2, exemplar: parsed }, null, 1));
  const onMesh = (): void => {
    const recipe = { solidnoise: 2, surface: { noise: "spectrum", exemplar: parsed }, frequency: 8, ramp: "exemplar" };
    void setText(JSON.stringify(recipe), "example on a mesh", { mode: "surface" });
  };

  return (
    <div class={`byexample${dragging.value ? " over" : ""}`}>
      <div class="sources">
        <label class="file">Open a photograph<input type="file" accept="image/*" aria-label="A photograph" onChange={(event) => { const file = event.currentTarget.files?.[0]; void take(file, file?.name ?? "", side, axes); }} /></label>
        {kPhotographs.map((name) => (
          <button key={name} class="photo" title={name} onClick={async () => void take(await (await fetch(new URL(`${name}.jpg`, document.baseURI))).blob(), `${name}.jpg`, side, axes)}>
            <img src={`${name}.jpg`} alt="" loading="lazy" />{name}
          </button>
        ))}
        <label class="inline">Side <select value={side} onChange={(event) => setSide(Number(event.currentTarget.value))}>{[128, 256, 384, 512].map((n) => <option key={n} value={n}>{n} pixels</option>)}</select></label>
        <label class="inline">Colour axes <select value={axes} onChange={(event) => setAxes(event.currentTarget.value)}>{["independent", "pca", "rgb"].map((word) => <option key={word}>{word}</option>)}</select></label>
        {busy !== undefined && <><progress value={busy} aria-label="Fitting" /><button onClick={stop}>Stop</button></>}
      </div>
      {trouble.value && <p class="problem" role="alert">{trouble.value}</p>}
      <div class="panels">
        {([["exemplar", "Exemplar"], ["version", "Gaussian version: the best that noise can do"], ["sparse", "Sparse spectrum"], ["noise", `Noise · ${ms.toFixed(0)} ms`]] as const).map(([panel, title]) => (
          <figure key={panel}><canvas ref={panels[panel]} width="256" height="256" role="img" aria-label={title} /><figcaption>{title}</figcaption></figure>
        ))}
      </div>
      {!parsed && busy === undefined && <p class="invite">Drop a photograph here, or take one of those above: sand, soil, moss and their like become a noise without seams.</p>}
      {report && parsed && (
        <div class="report" role="status"><p>{report.text.replace(/[;,]? (in )?0(\.0+)? s(econds)?\b/, "")} · {report.seconds.toFixed(1)} s</p>{report.warnings.map((warning) => <p key={warning} class="warning">{warning}</p>)}</div>
      )}
      {parsed && (
        <div class="workbench">
          <SpectrumEditor model={parsed} change={async (edits, at) => {
            // What was done to groups stays done: sliders begin anew.
            const { example, groups } = state.value;
            try {
              const changed = await edited(example, [...groupEdits(groups), ...edits]);
              commit({ ...state.value, example: changed, groups: {} }, `spectrum ${edits[0]?.edit}`, at);
            } catch (error) {
              trouble.value = (error as Error).message;
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
              <button class="wide" onClick={download}>Download</button>
            </div>
            <Commands hint="A volume of it is learnt from the photograph itself: noisefit --solid." commands={[
              `vdbnoise slice --dims 2 --color --noise ${fileWord(`${name}.json`)} --width 2 --out slice.png`,
              `meshnoise bake wyrm.ply --noise ${fileWord(`${name}.json`)} --out baked.ply --preview baked.png`,
            ]} />
          </div>
        </div>
      )}
    </div>
  );
}

function GroupSlider({ label, value, shown = value, low, high, step, write }: { label: string; value: number; shown?: number; low: number; high: number; step: number; write: (value: number) => void }): JSX.Element {
  const text = String(Number(shown.toFixed(2)));
  return (
    <label class="row"><span class="name">{label}</span>
      <span class="slide" style={{ "--t": `${(100 * (value - low)) / (high - low)}%` }}>
        <input type="range" min={low} max={high} step={step} value={value} aria-valuetext={text} onInput={(event) => write(Number(event.currentTarget.value))} />
      </span>
      <output class="number">{text}</output>
    </label>
  );
}
