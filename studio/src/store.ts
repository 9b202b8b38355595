import { batch, signal } from "@preact/signals";
import { Dropped, type Pool } from "./engine/pool.ts";
import { addressOf, isPlane, readAddress, writeAddress } from "./engine/address.ts";
import { keep, kept } from "./engine/kept.ts";

// Everything that undo brings back, reload keeps, and a link carries.

export interface Plane {
  origin: Vector;
  normal: Vector;
  up: Vector;
  width: number;
}
export type Vector = [number, number, number];

export interface Noise {
  text: string; // the recipe, as the library writes it
  grid: string; // which of its grids is looked at; empty: the first
}

export const kModes = ["slice", "volume", "surface", "example"] as const;
export type Mode = (typeof kModes)[number];

export interface State {
  noises: Noise[]; // one to three, side by side
  active: number;
  plane: Plane;
  ramp: string; // of pictures of values; empty: grey
  mode: Mode;
  bake: string; // the recipe of the surface, as the library writes it
  mesh: string; // by its file's name
  example: string; // the model of a photograph, as JSON; empty: none
  groups: Record<string, GroupEdit>; // what is done to its groups
  photograph: KeptPhotograph | undefined; // of which it is, where it is known
  report: Report | undefined; // of its fit
}
export interface Report {
  text: string;
  warnings: string[];
  seconds: number;
}
export interface KeptPhotograph {
  name: string;
  url: string; // of its pixels, as it was fitted
}
export interface GroupEdit {
  magnitude: number;
  scale: number;
  rotate: number; // degrees
}

// What the library says of a recipe.
export interface Info {
  recipe: string;
  kind: "volume" | "surface";
  changes: boolean;
  box: number[];
  grids: GridInfo[];
}
export interface GridInfo {
  names: string[];
  raw: boolean;
  scalar: boolean;
  layers: boolean;
}

export type Path = (string | number)[];
export interface Edit {
  path: Path;
  value?: string; // JSON; none: the key is removed
  keep?: string[]; // keys of what was there that stay
}

export const kFront: Pick<Plane, "normal" | "up"> = { normal: [0, 0, 1], up: [0, 1, 0] };
// As much of a plane as shows all of a box, with room around it.
export const across = (box: number[], room = 1): Pick<Plane, "origin" | "width"> => ({
  origin: [0, 1, 2].map((axis) => (box[axis]! + box[axis + 3]!) / 2) as Vector,
  width: room * Math.max(...[0, 1, 2].map((axis) => box[axis + 3]! - box[axis]!)),
});

const kStart: State = {
  noises: [{ text: "", grid: "" }],
  active: 0,
  plane: { ...kFront, origin: [0, 0, 0], width: 2 },
  ramp: "",
  mode: "slice",
  bake: "",
  mesh: "wyrm.ply",
  example: "",
  groups: {},
  photograph: undefined,
  report: undefined,
};

export const state = signal<State>(kStart);
export const infos = signal<ReadonlyMap<string, Info>>(new Map());
export interface Problem {
  message: string;
  path?: Path; // of what was edited
  text?: string; // of a recipe that an address brought
}
export const problem = signal<Problem | undefined>(undefined);
export const can = signal({ undo: false, redo: false });
export const time = signal<number | undefined>(undefined); // while it plays, or is held
export const pixels = signal<[number, number]>([1024, 1024]); // of the slice that the command makes

// Which recipe: the surface's, or one of the noises'.
type Place = "surface" | number;
export const activePlace = (): Place => (state.value.mode === "surface" ? "surface" : state.value.active);
const noiseAt = (place: Place): Noise | undefined => (place === "surface" ? { text: state.value.bake, grid: "" } : state.value.noises[place]);
// What the controls and the recipe are of.
export const activeNoise = (): Noise => noiseAt(activePlace()) ?? state.value.noises[0]!;
export const infoOf = (noise: Noise): Info | undefined => infos.value.get(noise.text);
// The time that a picture of it is of, where it is not the recipe's own.
export const timeOf = (noise: Noise): number | undefined => (infoOf(noise)?.changes ? time.value : undefined);

// The grid that has the colours of a body, as in vdbnoise's previews: the last; empty where there is none.
export const colorsOf = ({ recipe, grids }: Info): string =>
  grids.length > 1 && recipe.includes('"look": "solid"') ? grids.at(-1)!.names.at(-1)! : "";
// A checked recipe, and the grid of it that is looked at: the wanted one where there is such a one.
export const noiseOf = (info: Info, wanted = ""): Noise =>
  ({ text: info.recipe, grid: info.grids.some(({ names }) => names.includes(wanted)) ? wanted : colorsOf(info) });

let desk: Pool;
const past: State[] = [];
const future: State[] = [];
let lastTag = "";
// Changes of one kind are one step of undo while the pointer is down, or keys follow each other.
let gesture = 0;
let lastKey = 0;
addEventListener("pointerdown", () => void ++gesture, true);
addEventListener("keydown", () => {
  const now = performance.now();
  if (now - lastKey > 700) ++gesture;
  lastKey = now;
}, true);
const kMostSteps = 200;
const kStorage = "solidnoise-studio";

// Makes a new state; changes with one tag in one gesture are undone together.
export function commit(next: State, kind: string, at = gesture): void {
  const tag = `${kind} ${at}`;
  if (tag !== lastTag) {
    past.push(state.value);
    if (past.length > kMostSteps) past.shift();
  }
  future.length = 0;
  lastTag = tag;
  show(next);
}

function show(next: State): void {
  batch(() => {
    state.value = next;
    can.value = { undo: past.length > 0, redo: future.length > 0 };
  });
  clearTimeout(saving);
  saving = setTimeout(save, 250);
}

let saving: ReturnType<typeof setTimeout> | undefined;
function save(): void {
  keep(kStorage, JSON.stringify(state.value));
  setTimeout(() => writeAddress(state.value)); // which by itself is long enough for a task
}

// What is still being edited is done first: one undo takes all of a gesture back, and redo brings all of it.
async function step(from: State[], to: State[]): Promise<void> {
  await editing;
  const there = from.pop();
  if (!there) return;
  to.push(state.value);
  lastTag = "";
  problem.value = undefined;
  show(there);
  void knowAll();
}
export const undo = (): Promise<void> => step(past, future);
export const redo = (): Promise<void> => step(future, past);

function learn(text: string, info: Info): void {
  const known = new Map(infos.value);
  known.set(text, info);
  known.set(info.recipe, info);
  while (known.size > 400) known.delete(known.keys().next().value!);
  infos.value = known;
}

export async function check(text: string): Promise<Info> {
  const info = (await desk.ask("desk", { do: "check", recipe: text })).json as unknown as Info;
  learn(text, info);
  return info;
}

async function knowAll(): Promise<void> {
  for (const text of [state.value.bake, ...state.value.noises.map((noise) => noise.text)]) {
    if (text && !infos.value.has(text)) await check(text);
  }
}

export function replaceNoise(noise: Noise, tag: string, place = activePlace(), rest: Partial<State> = {}, at = gesture): void {
  const next = { ...state.value, ...rest };
  if (place === "surface") return commit({ ...next, bake: noise.text }, tag, at);
  commit({ ...next, noises: next.noises.map((old, index) => (index === place ? noise : old)) }, tag, at);
}

// A recipe by its text, checked; says what is wrong with it in `problem`.
export async function setText(text: string, tag: string, rest: Partial<State> = {}): Promise<boolean> {
  try {
    const { active } = state.value;
    const { grid } = activeNoise();
    const info = await check(text);
    batch(() => {
      problem.value = undefined;
      // A recipe of the other kind turns to the view that shows it.
      const { mode } = state.value;
      const fitting: Mode = info.kind === "surface" ? "surface" : mode === "surface" ? "slice" : mode;
      const place = info.kind === "surface" ? "surface" : active;
      if (noiseAt(place)?.text === info.recipe && fitting === mode && Object.keys(rest).length === 0) return;
      replaceNoise(noiseOf(info, grid), tag, place, { mode: fitting, ...rest });
    });
    return true;
  } catch (error) {
    if (!(error instanceof Dropped)) problem.value = { message: (error as Error).message };
    return false;
  }
}

// What undo waits for.
let editing: Promise<void> | undefined;

// Something that changes the state, of the gesture that it is told, and is waited for by undo.
export function during(work: (at: number) => Promise<void>): Promise<void> {
  const before = editing;
  const own = work(gesture).finally(() => before).finally(() => {
    if (editing === own) editing = undefined;
  });
  return (editing = own);
}

// Edits wait for what is under way; of one path the last counts, so that a slider is never ahead of its picture.
const waiting: { place: Place; at: number; edits: Edit[] }[] = [];
let applying: Promise<void> | undefined; // which takes what waits
export function edit(edits: Edit[], tag: string): Promise<void> {
  const place = activePlace();
  let last = waiting.at(-1);
  if (last?.place !== place) waiting.push((last = { place, at: gesture, edits: [] }));
  last.at = gesture;
  for (const one of edits) {
    const key = JSON.stringify(one.path);
    if (one.value !== undefined && !one.keep) last.edits = last.edits.filter((other) => JSON.stringify(other.path) !== key);
    last.edits.push(one);
  }
  return (applying ??= during(() => Promise.resolve(editing).finally(() => apply(tag))));
}

async function apply(tag: string): Promise<void> {
  for (let now = waiting.shift(); now; now = waiting.shift()) {
    const { place, at, edits } = now;
    const noise = noiseAt(place);
    if (!noise) continue;
    try {
      const answer = await desk.ask("desk", { do: "edit", recipe: noise.text, edits });
      const info = answer.json as unknown as Info;
      batch(() => {
        learn(info.recipe, info);
        problem.value = undefined;
        // What has been taken away or replaced meanwhile stays so.
        if (noiseAt(place)?.text === noise.text) replaceNoise(noiseOf(info, noise.grid), tag, place, {}, at);
      });
    } catch (error) {
      problem.value = { message: (error as Error).message, ...(edits[0] ? { path: edits[0].path } : {}) };
    }
  }
  applying = undefined; // before anything else can wait
}

let first: State; // where an address or what was kept has nothing else

// A recipe that is not one; `text` is what it says.
class Faulty extends Error {
  constructor(message: string, readonly text: string) {
    super(message);
  }
}
const problemOf = (error: unknown): Problem => (error instanceof Faulty ? { message: error.message, text: error.text } : { message: (error as Error).message });

// A state of what an address or the browser kept has, and of `rest` for what it has not. A recipe of the other kind turns to the view that
// shows it. Throws a Faulty that says what is wrong with a recipe of it.
async function whole(from: Partial<State>, rest: State): Promise<State> {
  const known = (text: string): Promise<Info> => check(text).catch((error: Error) => {
    throw new Faulty(error.message, text);
  });
  const noises: Noise[] = [];
  let bake = "";
  for (const { text, grid } of [...(from.bake ? [{ text: from.bake, grid: "" }] : []), ...(from.noises ?? [])]) {
    const info = await known(text);
    if (info.kind === "surface") bake ||= info.recipe;
    else if (noises.length < 3) noises.push(noiseOf(info, grid));
  }
  let mode = from.mode ?? rest.mode;
  if (bake && noises.length === 0) mode = "surface";
  else if (!bake && mode === "surface" && from.noises) mode = "slice";
  if (noises.length === 0) for (const { text, grid } of rest.noises) noises.push(noiseOf(await known(text), grid));
  if (!bake) bake = (await known(rest.bake)).recipe;
  return { ...rest, ...from, noises, bake, mode, active: Math.min(from.active ?? 0, noises.length - 1) };
}

// What was kept, as far as it has the shape of a state: it may be that of another version of the page.
function stored(): Partial<State> | undefined {
  try {
    const read = JSON.parse(kept(kStorage) ?? "null") as Partial<State>;
    const isNoise = (noise: Noise | null): boolean => typeof noise?.text === "string" && typeof noise.grid === "string";
    const isEdit = (one: GroupEdit | null): boolean => [one?.magnitude, one?.scale, one?.rotate].every(Number.isFinite);
    const fits: Record<keyof State, (value: never) => boolean> = {
      noises: (value: Noise[]) => Array.isArray(value) && value.length > 0 && value.every(isNoise),
      active: (value: number) => Number.isInteger(value) && value >= 0,
      plane: isPlane,
      ramp: (value: unknown) => typeof value === "string",
      mode: (value: Mode) => kModes.includes(value),
      bake: (value: unknown) => typeof value === "string",
      mesh: (value: unknown) => typeof value === "string",
      example: (value: unknown) => typeof value === "string",
      groups: (value: State["groups"] | null) => typeof value === "object" && Object.values(value ?? {}).every(isEdit),
      report: (value: Report | null) => typeof value?.text === "string" && Array.isArray(value.warnings) && Number.isFinite(value.seconds),
      photograph: (value: KeptPhotograph | null) => typeof value?.name === "string" && typeof value.url === "string",
    };
    return Object.fromEntries(Object.entries(read).filter(([key, value]) => fits[key as keyof State]?.(value as never) ?? false));
  } catch {
    return undefined;
  }
}

// What the page begins with: its address, what was there before, or a preset. Of an address that is that of what was there before, all
// of it is taken, as an address does not have everything.
export async function begin(pool: Pool, preset: string, surface: string): Promise<void> {
  desk = pool;
  first = { ...kStart, noises: [{ text: preset, grid: "" }], bake: surface };
  const was = stored();
  for (const from of [() => (was && addressOf({ ...first, ...was }) === location.href ? was : readAddress()), () => was, () => ({})]) {
    try {
      const asked = from();
      if (!asked) continue;
      const next = await whole(asked, first);
      // An address with a fault stays, until something is changed, and its text is in the panel of recipes.
      if (problem.value) state.value = { ...next, mode: next.mode === "example" ? "slice" : next.mode };
      else show(next);
      return;
    } catch (error) {
      problem.value ??= problemOf(error);
    }
  }
}

// Another address in the same page: a link that was pasted, or the browser's way back. What it does not say stays.
addEventListener("hashchange", async () => {
  try {
    const from = readAddress();
    if (!from) return;
    const next = await whole({ ...from, ...(from.example ? { photograph: undefined, report: undefined } : {}) }, state.value);
    problem.value = undefined;
    commit(next, "address");
  } catch (error) {
    problem.value = problemOf(error);
  }
});
