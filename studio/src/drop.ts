import { batch, signal } from "@preact/signals";
import { commit, type Mode, problem, setText, state } from "./store.ts";

// Files that are dropped anywhere on the page: recipes are taken, meshes and pictures go to the view that shows them.

type Kind = "mesh" | "picture";
const kViews: Record<Kind, Mode> = { mesh: "surface", picture: "example" };
const takers = new Map<Kind, (file: File) => void>();
const waiting = new Map<Kind, File>();

export const dragging = signal(false);

// The function that takes such files while a view is there; what it returns ends that.
export function onFile(kind: Kind, take: (file: File) => void): () => void {
  takers.set(kind, take);
  const file = waiting.get(kind);
  waiting.delete(kind);
  if (file) take(file);
  return () => {
    if (takers.get(kind) === take) takers.delete(kind);
  };
}

const kindOf = ({ name, type }: File): Kind | undefined =>
  /\.(ply|obj|off|stl|om|glb|gltf)$/i.test(name) ? "mesh" : type.startsWith("image/") || /\.(png|jpe?g|webp|gif|bmp|avif)$/i.test(name) ? "picture" : undefined;

async function take(file: File): Promise<void> {
  // In the view that shows them files are what it takes, so that it says what is wrong with others.
  const { mode } = state.value;
  const isRecipe = /\.json$/i.test(file.name);
  const kind = kindOf(file) ?? (mode === "surface" && !isRecipe ? "mesh" : mode === "example" && !isRecipe ? "picture" : undefined);
  if (!kind) {
    const taken = isRecipe && (await setText(await file.text(), "dropped"));
    if (!taken) problem.value = { message: isRecipe ? `${file.name}: ${problem.value?.message}` : `${file.name} is no recipe (.json), mesh (.ply, .obj, .off) or picture` };
    return;
  }
  const taker = takers.get(kind);
  if (taker) return taker(file);
  batch(() => {
    waiting.set(kind, file);
    commit({ ...state.value, mode: kViews[kind] }, `mode ${kind}`);
  });
}

addEventListener("dragover", (event) => {
  event.preventDefault();
  dragging.value = event.dataTransfer?.types.includes("Files") ?? false;
});
addEventListener("dragleave", (event) => {
  if (!event.relatedTarget) dragging.value = false;
});
addEventListener("drop", async (event) => {
  event.preventDefault();
  dragging.value = false;
  for (const file of event.dataTransfer?.files ?? []) await take(file);
});
