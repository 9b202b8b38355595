import type { GroupEdit } from "../store.ts";
import { engine } from "./engine.ts";

// The model of a photograph: its fit, its pictures, what is done to it. All of it is the library's.

export interface Photograph {
  name: string;
  width: number;
  height: number;
  bytes: Uint8Array<ArrayBuffer>; // red, green, blue, alpha
}
export interface Model {
  channels: { axis: number[]; dimensions: number; groups: string[]; bands: { a: number; components: number[][] }[] }[];
  raw_values: boolean;
  mean: number[];
}

// As large as a fit needs: a photograph of 40 megapixels is made smaller while it is decoded.
export async function readPhotograph(file: Blob, name: string, side: number): Promise<Photograph> {
  const whole = await createImageBitmap(file).catch(() => {
    throw new Error(`${name} is not a picture that this browser reads`);
  });
  const scale = Math.min(1, side / Math.max(whole.width, whole.height));
  const [width, height] = [Math.max(16, Math.round(whole.width * scale)), Math.max(16, Math.round(whole.height * scale))];
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  context.imageSmoothingQuality = "high";
  context.drawImage(whole, 0, 0, width, height);
  whole.close();
  const { data } = context.getImageData(0, 0, width, height);
  return { name, width, height, bytes: new Uint8Array(data.buffer) };
}

const sized = ({ width, height }: { width: number; height: number }) => ({ width, height, pixel: 1 / width });

export async function fitPhotograph(photograph: Photograph, axes: string, progress: (done: number) => void): Promise<{ exemplar: string; report: string; warnings: string[] }> {
  const { json } = await engine.modeller.ask("fit", { do: "fit", ...sized(photograph), axes, raw: true }, { bytes: photograph.bytes.slice(), progress });
  return { exemplar: JSON.stringify(json.exemplar), report: String(json.report), warnings: json.warnings as string[] };
}

export async function versionOf(photograph: Photograph): Promise<ImageData> {
  const { json, floats } = await engine.pool.ask("version", { do: "version", ...sized(photograph), raw: true }, { bytes: photograph.bytes.slice() });
  return imageOf(json, floats[0]!);
}

export async function textureOf(exemplar: string, width: number, height: number, pixel: number, sparse: boolean): Promise<ImageData> {
  const { json, floats } = await engine.pool.ask(sparse ? "sparse" : "texture", { do: "texture", exemplar: JSON.parse(exemplar), width, height, pixel, sparse }, { urgent: true });
  return imageOf(json, floats[0]!);
}

function imageOf(json: Record<string, unknown>, pixels: Float32Array): ImageData {
  const image = new ImageData(Number(json.width), Number(json.height));
  for (let i = 0; i < pixels.length; ++i) image.data[4 * Math.floor(i / 3) + (i % 3)] = Math.round(255 * Math.min(1, Math.max(0, pixels[i]!)));
  for (let i = 3; i < image.data.length; i += 4) image.data[i] = 255;
  return image;
}

export type ComponentEdit = { edit: string; channel?: number; band?: number; component?: number; to?: [number, number]; by?: number; group?: string; a?: number; variance?: number };

export async function edited(exemplar: string, edits: ComponentEdit[]): Promise<string> {
  if (edits.length === 0) return exemplar;
  const { json } = await engine.desk.ask("example", { do: "edit example", exemplar: JSON.parse(exemplar), edits });
  return JSON.stringify(json.exemplar);
}

export const groupEdits = (groups: Record<string, GroupEdit>): ComponentEdit[] =>
  Object.entries(groups).flatMap(([group, { magnitude, scale, rotate }]) => [
    ...(magnitude !== 1 ? [{ edit: "magnitude", group, by: magnitude }] : []),
    ...(scale !== 1 ? [{ edit: "scale", group, by: scale }] : []),
    ...(rotate !== 0 ? [{ edit: "rotate", group, by: rotate }] : []),
  ]);
