import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { engine } from "../engine/engine.ts";
import { drawSlice, sampleSlice } from "../engine/slice.ts";
import { across, check, kFront, noiseOf, setText, state } from "../store.ts";
import { paint } from "./paint.ts";
import { type Start, starts } from "../starts.ts";

// Presets and examples, each with a picture that is made while one looks.

export function Gallery({ close }: { close: () => void }): JSX.Element {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    dialog.current?.showModal();
    return () => engine.pool.drop("gallery");
  }, []);
  const part = (kind: Start["kind"], title: string): JSX.Element => (
    <section>
      <h3>{title}</h3>
      <div class="grid">{starts.filter((start) => start.kind === kind).map((start) => <Card key={start.name} start={start} close={close} />)}</div>
    </section>
  );
  return (
    <dialog class="gallery" ref={dialog} onClose={close} onClick={(event) => event.target === dialog.current && close()}>
      <header><h2>Start from</h2><button class="icon" aria-label="Close" onClick={close}>×</button></header>
      {part("preset", "Presets")}
      {part("surface", "Surfaces")}
      {part("example", "Examples")}
    </dialog>
  );
}

const known = new Map<string, ImageData>();

function Card({ start, close }: { start: Start; close: () => void }): JSX.Element | null {
  const canvas = useRef<HTMLCanvasElement>(null);
  const card = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    const put = (image: ImageData): void => {
      if (canvas.current) paint(canvas.current).putImageData(image, 0, 0);
    };
    const ready = known.get(start.name);
    if (ready) return put(ready);
    void (async () => {
      try {
        const info = await check(start.text);
        if (info.kind === "surface") return canvas.current?.remove();
        const noise = noiseOf(info);
        const picture = await sampleSlice(engine.pool, "gallery", { noise, plane: { ...kFront, ...across(info.box) }, time: undefined, columns: 96, rows: 96 }, { draft: true });
        const image = drawSlice(picture, noise.grid ? engine.body : undefined);
        known.set(start.name, image);
        put(image);
      } catch {
        // What needs a file is not for the page.
        card.current?.remove();
      }
    })();
  }, []);
  const description = /"description":\s*"([^"]*)"/.exec(start.text)?.[1] ?? "";
  return (
    <button ref={card} class="start" title={description} onClick={async () => {
      const info = await check(start.text);
      await setText(start.text, `start ${start.name}`, info.kind === "surface" ? {} : {
        plane: { ...kFront, ...across(info.box) }, ...(state.value.mode === "example" ? { mode: "slice" } : {}),
      });
      close();
    }}>
      <canvas ref={canvas} width="96" height="96" aria-hidden="true" />
      <span>{start.name.replaceAll("_", " ")}</span>
      <small>{description}</small>
    </button>
  );
}
