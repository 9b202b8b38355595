import type { JSX, RefObject } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { kNoWebGl } from "./gl.ts";
import type { Orbit } from "./orbit.ts";
import type { FromScene, ToScene, ToWorker } from "./scene_worker.ts";

// A canvas that a worker draws something on by WebGL, as seen by an eye that mouse, wheel and keys move around it.

export interface Scene<Data> {
  canvas: RefObject<HTMLCanvasElement | null>;
  open(): boolean; // not where there is no WebGL, or the view is gone
  // What of the data is `given` is here no more. Calls back when it is drawn, unless newer data is there by then.
  load(data: Data, given: (ArrayBufferView<ArrayBuffer> | undefined)[], drawn: () => void): void;
  render(): void;
  trouble: string;
  setTrouble(message: string): void;
}

let worker: Worker | undefined; // of all scenes; comes with the first

// `shot` is called with what it needs from the last time that the view was made; `scale` says how many pixels the canvas has for each of
// the page's.
export function useScene<Data, Shot>(kind: ToWorker["kind"], orbit: Orbit, scale: (canvas: HTMLCanvasElement) => number, shot: (eye: number[]) => Shot): Scene<Data> {
  const canvas = useRef<HTMLCanvasElement>(null);
  const port = useRef<MessagePort>(null);
  const waiting = useRef<(() => void)[]>([]);
  const eye = useRef(orbit);
  const latest = useRef(shot);
  latest.current = shot;
  const [trouble, setTrouble] = useState("");

  const send = (message: ToScene<Data, Shot>, given: Transferable[] = []): void => port.current?.postMessage(message, given);
  const render = (): void => send({ shot: latest.current(eye.current.eye()) });
  const load: Scene<Data>["load"] = (data, given, drawn) => {
    waiting.current.push(drawn);
    send({ data }, given.flatMap((array) => array?.buffer ?? []));
  };
  useEffect(() => {
    const element = canvas.current!;
    const close = (): void => {
      port.current?.close();
      port.current = null;
    };
    const fail = (message: string): void => {
      close();
      setTrouble(message);
    };
    if (!element.transferControlToOffscreen) return fail(kNoWebGl);
    const { port1, port2 } = new MessageChannel();
    port.current = port1;
    port1.onmessage = ({ data: { taken, trouble } }: MessageEvent<FromScene>) => {
      if (trouble !== undefined) return fail(trouble);
      waiting.current.splice(0, taken).at(-1)?.();
    };
    worker ??= new Worker(new URL("scene.js", document.baseURI), { type: "module" });
    worker.onerror = () => {
      worker = undefined;
      fail("scene.js, which draws volumes and surfaces, does not load");
    };
    const offscreen = element.transferControlToOffscreen();
    worker.postMessage({ kind, canvas: offscreen, port: port2 } satisfies ToWorker, [offscreen, port2]);
    const stop = eye.current.attach(element, render);
    const observer = new ResizeObserver(() => {
      const own = scale(element);
      send({ size: [Math.max(1, Math.round(element.clientWidth * own)), Math.max(1, Math.round(element.clientHeight * own))] });
    });
    observer.observe(element);
    return () => {
      stop();
      observer.disconnect();
      send({ end: true });
      close();
    };
  }, []);
  return { canvas, open: () => port.current !== null, load, render, trouble, setTrouble };
}

export function SceneCanvas<Data>({ scene, what }: { scene: Scene<Data>; what: string }): JSX.Element {
  return (
    <>
      <canvas ref={scene.canvas} tabIndex={0} role="img" aria-label={`${what}. Drag or arrow keys turn it, the wheel or plus and minus move the eye.`} />
      {scene.trouble && <p class="failure" role="alert">{scene.trouble}</p>}
    </>
  );
}
