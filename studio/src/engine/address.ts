import type { Noise, Plane, State } from "../store.ts";

// The whole state in the address: #recipe=..., which vdbnoise reads, too (base64url of the JSON), and what the view adds to it.

export const base64 = (bytes: Uint8Array): string => {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
};
export const bytesOf = (code: string): Uint8Array<ArrayBuffer> => Uint8Array.from(atob(code), (c) => c.charCodeAt(0));
const encode = (text: string): string => base64(new TextEncoder().encode(text)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
// Of a link that was cut off, what there is of it.
const decode = (code: string): string => {
  const whole = code.replaceAll("-", "+").replaceAll("_", "/").replace(/[^\w+/]/g, "");
  return new TextDecoder().decode(bytesOf(whole.slice(0, whole.length - (whole.length % 4 === 1 ? 1 : 0))));
};

// Without blanks outside of strings; numbers stay as they are written.
const compact = (text: string): string => text.replace(/("(?:[^"\\]|\\.)*")|\s+/g, "$1");

export function addressOf(state: State): string {
  const order = [state.active, ...state.noises.keys()].filter((index, place, all) => index < state.noises.length && all.indexOf(index) === place);
  const parts = order.map((index) => {
    const noise = state.noises[index] as Noise;
    return `recipe=${encode(compact(noise.text))}${noise.grid ? `&grid=${encodeURIComponent(noise.grid)}` : ""}`;
  });
  const { origin, normal, up, width } = state.plane;
  parts.push(`plane=${[...origin, ...normal, ...up, width].map((x) => Number(x.toPrecision(6))).join("_")}`);
  if (state.ramp) parts.push(`ramp=${encodeURIComponent(state.ramp)}`);
  if (state.bake && state.mode === "surface") parts.unshift(`recipe=${encode(compact(state.bake))}`);
  if (state.example && state.mode === "example") parts.push(`example=${encode(state.example)}`, `groups=${encode(JSON.stringify(state.groups))}`);
  parts.push(`view=${state.mode}`);
  return `${location.href.split("#")[0]}#${parts.join("&")}`;
}

// Browsers keep some 2 MB; a noise of a photograph takes some 50 KB.
export function writeAddress(state: State): void {
  history.replaceState(null, "", addressOf(state));
}

// Whether something that was read is a plane that a picture can be made of.
export function isPlane(value: unknown): value is Plane {
  const { origin, normal, up, width } = (value ?? {}) as Partial<Plane>;
  const areNumbers = [origin, normal, up].every((vector) => vector?.length === 3 && vector.every((x) => Math.abs(x) < 1e9));
  if (!areNumbers || !(width! > 1e-9 && width! < 1e9)) return false;
  const [a, b] = [normal!, up!];
  return Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]) > 1e-6 * Math.hypot(...a) * Math.hypot(...b);
}

// Throws an Error where a part of it cannot be read.
export function readAddress(): Partial<State> | undefined {
  const hash = location.hash.slice(1);
  if (!hash.includes("recipe=")) return undefined;
  const read: Partial<State> = { noises: [], active: 0 };
  for (const part of hash.split("&")) {
    const [key, value = ""] = [part.slice(0, part.indexOf("=")), part.slice(part.indexOf("=") + 1)];
    if (key === "recipe") read.noises!.push({ text: decode(value), grid: "" });
    if (key === "grid" && read.noises!.length > 0) read.noises![read.noises!.length - 1]!.grid = decodeURIComponent(value);
    if (key === "example") read.example = decode(value);
    if (key === "groups") read.groups = JSON.parse(decode(value)) as State["groups"];
    if (key === "ramp") read.ramp = decodeURIComponent(value);
    if (key === "view" && ["slice", "volume", "surface", "example"].includes(value)) read.mode = value as State["mode"];
    if (key === "plane") {
      const n = value.split("_").map(Number);
      const plane = { origin: n.slice(0, 3), normal: n.slice(3, 6), up: n.slice(6, 9), width: n[9] };
      if (isPlane(plane)) read.plane = plane;
    }
  }
  // On surfaces their own recipe comes first.
  if (read.mode === "surface") read.bake = read.noises!.shift()?.text ?? "";
  return read;
}
