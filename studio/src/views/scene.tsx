import type { JSX, RefObject } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import type { Orbit } from "./orbit.ts";

// A canvas that something is drawn on by WebGL, as seen by an eye that mouse, wheel and keys move around it.

interface Renderer {
  ready: Promise<void>;
  dispose(): void;
}
export interface Scene<Own extends Renderer> {
  canvas: RefObject<HTMLCanvasElement | null>;
  renderer: RefObject<Own | null>; // empty where there is no WebGL, or the view is gone
  render(): void; // with the next frame
  trouble: string;
  setTrouble(message: string): void;
}

// `draw` is called with what it needs from the last time that the view was made; `scale` says how many pixels the canvas has for each of
// the page's.
export function useScene<Own extends Renderer>(
  make: (canvas: HTMLCanvasElement) => Own, eye: Orbit, scale: (canvas: HTMLCanvasElement) => number, draw: (renderer: Own, eye: Orbit) => void,
): Scene<Own> {
  const canvas = useRef<HTMLCanvasElement>(null);
  const renderer = useRef<Own>(null);
  const orbit = useRef(eye);
  const frame = useRef(0);
  const latest = useRef(draw);
  latest.current = draw;
  const [trouble, setTrouble] = useState("");

  const render = (): void => {
    cancelAnimationFrame(frame.current);
    frame.current = requestAnimationFrame(() => renderer.current && latest.current(renderer.current, orbit.current));
  };
  useEffect(() => {
    const element = canvas.current!;
    try {
      renderer.current = make(element);
      renderer.current.ready.then(render, (error: Error) => setTrouble(error.message));
    } catch (error) {
      setTrouble((error as Error).message);
      return;
    }
    const stop = orbit.current.attach(element, render);
    const observer = new ResizeObserver(() => {
      const own = scale(element);
      element.width = Math.max(1, Math.round(element.clientWidth * own));
      element.height = Math.max(1, Math.round(element.clientHeight * own));
      render();
    });
    observer.observe(element);
    return () => {
      stop();
      observer.disconnect();
      renderer.current?.dispose();
      renderer.current = null;
    };
  }, []);
  return { canvas, renderer, render, trouble, setTrouble };
}

export function SceneCanvas<Own extends Renderer>({ scene, what }: { scene: Scene<Own>; what: string }): JSX.Element {
  return (
    <>
      <canvas ref={scene.canvas} tabIndex={0} role="img" aria-label={`${what}. Drag or arrow keys turn it, the wheel or plus and minus move the eye.`} />
      {scene.trouble && <p class="failure" role="alert">{scene.trouble}</p>}
    </>
  );
}
