import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { dragging, onFile } from "../drop.ts";
import { engine } from "../engine/engine.ts";
import { Follower } from "../engine/follower.ts";
import { activeNoise, commit, state, timeOf } from "../store.ts";
import { useChanges } from "./at_once.ts";
import { Orbit } from "./orbit.ts";
import { SceneCanvas, useScene } from "./scene.tsx";
import type { SurfaceData, SurfaceShot } from "./surface_renderer.ts";

// Noise on a mesh: one that comes with the page, or one that is dropped.

const kMeshes = ["wyrm.ply", "bowl.obj", "torus.obj"];
// Meshes that were dropped, for as long as the page is open; the last is there after a reload, too, where the browser keeps it.
const dropped = new Map<string, Uint8Array<ArrayBuffer>>();
const kKept = "solidnoise-mesh";
let inWorker = "";

async function keep(name: string, bytes: Uint8Array<ArrayBuffer>): Promise<void> {
  dropped.set(name, bytes);
  try {
    await caches.delete(kKept);
    await (await caches.open(kKept)).put(encodeURIComponent(name), new Response(bytes));
  } catch {
    // No room for it, or a page without https: it is to be dropped again.
  }
}

async function bytesOf(name: string): Promise<Uint8Array<ArrayBuffer>> {
  const own = dropped.get(name);
  if (own) return own.slice();
  const address = new URL(encodeURIComponent(name), document.baseURI);
  const response = (await globalThis.caches?.match(address, { cacheName: kKept })) ?? (await fetch(address));
  if (!response.ok) throw new Error(`${name} is not here any more; drop it again`);
  return new Uint8Array(await response.arrayBuffer());
}

export function SurfaceView(): JSX.Element {
  const [told, tell] = useState("");
  const [plain, setPlain] = useState(false);
  const scene = useScene<SurfaceData, SurfaceShot>("surface", new Orbit(0.6, 0.3, 2.05), () => Math.min(2, devicePixelRatio), (eye) => ({ eye, plain }));
  const { render, setTrouble } = scene;
  useEffect(render, [plain]);

  const bake = async (): Promise<void> => {
    const { bake: text, mesh } = state.value;
    if (!text || !scene.open()) return;
    const begin = performance.now();
    if (inWorker !== mesh) {
      inWorker = "";
      await engine.modeller.ask("surface", { do: "mesh", name: mesh }, { bytes: await bytesOf(mesh) });
      inWorker = mesh;
    }
    const when = timeOf(activeNoise());
    const { json, floats } = await engine.modeller.ask("surface", { do: "bake", recipe: text, ...(when === undefined ? {} : { time: when }) });
    if (!scene.open()) return;
    const [positions, normals, colors, corners] = [floats[0]!, floats[1]!, floats[2]!, new Uint32Array(floats[3]!.buffer)];
    const aliases = Number(json.cycles_per_edge) > 0.5 ? " · finer than the mesh: give refine" : "";
    scene.load({ positions, normals, colors, corners }, [positions, normals, corners], () => {
      tell(`${Number(json.vertices).toLocaleString("en")} vertices · ${(performance.now() - begin).toFixed(0)} ms${aliases}`);
      scene.canvas.current?.dispatchEvent(new CustomEvent("pictured", { bubbles: true, detail: { colors } }));
    });
    setTrouble("");
  };
  const follower = useRef<Follower<unknown>>(null);
  follower.current ??= new Follower(bake, async () => undefined, (error) => {
    inWorker = ""; // where memory has ended it is another worker
    setTrouble(error.message);
  });
  useEffect(() => () => {
    follower.current?.stop();
    engine.modeller.drop("surface");
  }, []);
  useChanges(() => [state.value.bake, state.value.mesh, timeOf(activeNoise())], () => follower.current?.want({}));
  // What is no mesh is said, and the one that was there stays.
  const take = async (file: File | undefined): Promise<void> => {
    if (!file) return;
    const bytes = new Uint8Array(await file.arrayBuffer());
    inWorker = "";
    try {
      await engine.modeller.ask("surface", { do: "mesh", name: file.name }, { bytes: bytes.slice() });
    } catch (error) {
      return setTrouble((error as Error).message);
    }
    inWorker = file.name;
    await keep(file.name, bytes);
    if (state.value.mesh === file.name) follower.current?.want({});
    else commit({ ...state.value, mesh: file.name }, "mesh");
  };
  useEffect(() => onFile("mesh", (file) => void take(file)), []);
  const names = [...kMeshes, ...dropped.keys()];
  if (!names.includes(state.value.mesh)) names.push(state.value.mesh);
  return (
    <figure class={`view surface${dragging.value ? " over" : ""}`}>
      <SceneCanvas scene={scene} what="The surface" />
      <div class="overlay">
        <select aria-label="Mesh" value={state.value.mesh} onChange={(event) => commit({ ...state.value, mesh: event.currentTarget.value }, "mesh")}>
          {names.map((name) => <option key={name}>{name}</option>)}
        </select>
        <label class="file">Open .ply, .obj, .off<input type="file" accept=".ply,.obj,.off" aria-label="A mesh" onChange={(event) => void take(event.currentTarget.files?.[0])} /></label>
        <label class="inline"><input class="toggle" type="checkbox" role="switch" checked={plain} onChange={(event) => setPlain(event.currentTarget.checked)} /> colours alone</label>
      </div>
      <figcaption><span role="status">{told}</span></figcaption>
    </figure>
  );
}
