import type { GroupEdit, KeptPhotograph } from "../store.ts";
import { base64, bytesOf } from "./address.ts";
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
  mean: number[];
}

// As large as a fit needs: a photograph of 40 megapixels is made smaller while it is decoded.
export async function readPhotograph(file: Blob, name: string, side: number): Promise<Photograph> {
  const whole = await createImageBitmap(file).catch(() => {
    throw new Error(`${name} is not a picture that this browser reads`);
  });
  const scale = Math.min(1, side / Math.max(whole.width, whole.height));
  return pixelsOf(whole, name, Math.max(16, Math.round(whole.width * scale)), Math.max(16, Math.round(whole.height * scale)));
}

function pixelsOf(picture: ImageBitmap, name: string, width: number, height: number): Photograph {
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true })!;
  context.imageSmoothingQuality = "high";
  context.drawImage(picture, 0, 0, width, height);
  picture.close();
  return { name, width, height, bytes: new Uint8Array(context.getImageData(0, 0, width, height).data.buffer) };
}

// As undo and reload keep it, and back.
export async function keepPhotograph({ name, width, height, bytes }: Photograph): Promise<KeptPhotograph> {
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext("2d")!.putImageData(new ImageData(new Uint8ClampedArray(bytes), width, height), 0, 0);
  const png = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
  return { name, url: `data:image/png;base64,${base64(png)}` };
}

export async function restoredPhotograph(name: string, url: string): Promise<Photograph> {
  const png = bytesOf(url.slice(url.indexOf(",") + 1));
  const whole = await createImageBitmap(new Blob([png], { type: "image/png" }));
  return pixelsOf(whole, name, whole.width, whole.height);
}

const sized = ({ width, height }: { width: number; height: number }) => ({ width, height, pixel: 1 / width });

export async function fitPhotograph(photograph: Photograph, axes: string, progress: (done: number) => void): Promise<{ exemplar: string; report: string; warnings: string[] }> {
  const { json } = await engine.fitter.ask("fit", { do: "fit", ...sized(photograph), axes }, { bytes: photograph.bytes.slice(), progress });
  return { exemplar: String(json.exemplar), report: String(json.report), warnings: json.warnings as string[] };
}

export async function versionOf(photograph: Photograph): Promise<ImageData> {
  const { json, floats } = await engine.pool.ask("version", { do: "version", ...sized(photograph) }, { bytes: photograph.bytes.slice() });
  return imageOf(json, floats[0]!);
}

// Of a model with what is done to it: the sparse spectrum's texture, whole; the noise in strips, by all workers.
export async function textureOf(exemplar: string, edits: ComponentEdit[], width: number, height: number, pixel: number, sparse: boolean): Promise<ImageData> {
  const strips = sparse ? 1 : engine.pool.size;
  const image = new ImageData(width, height);
  await Promise.all(Array.from({ length: strips }, async (_, i) => {
    const first = Math.floor((i * width) / strips);
    const question = { do: "texture", exemplar, edits, first, width: Math.floor(((i + 1) * width) / strips) - first, height, pixel, sparse };
    const { json, floats } = await engine.pool.ask(sparse ? "sparse" : "texture", question, { urgent: true });
    put(image, first, Number(json.width), floats[0]!);
  }));
  return image;
}

function imageOf(json: Record<string, unknown>, pixels: Float32Array): ImageData {
  const image = new ImageData(Number(json.width), Number(json.height));
  put(image, 0, image.width, pixels);
  return image;
}

// Colours, row by row, into columns of a picture.
function put({ data, width, height }: ImageData, first: number, columns: number, pixels: Float32Array): void {
  for (let from = 0, y = 0; y < height; ++y) {
    for (let x = first; x < first + columns; ++x) {
      const to = 4 * (y * width + x);
      for (let c = 0; c < 3; ++c) data[to + c] = 255 * pixels[from++]!;
      data[to + 3] = 255;
    }
  }
}

export type ComponentEdit = { edit: string; channel?: number; band?: number; component?: number; to?: [number, number]; by?: number; group?: string; a?: number; variance?: number };

export async function edited(exemplar: string, edits: ComponentEdit[]): Promise<string> {
  if (edits.length === 0) return exemplar;
  const { json } = await engine.desk.ask("example", { do: "edit example", exemplar, edits });
  return String(json.exemplar);
}

export const groupEdits = (groups: Record<string, GroupEdit>): ComponentEdit[] =>
  Object.entries(groups).flatMap(([group, { magnitude, scale, rotate }]) => [
    ...(magnitude !== 1 ? [{ edit: "magnitude", group, by: magnitude }] : []),
    ...(scale !== 1 ? [{ edit: "scale", group, by: scale }] : []),
    ...(rotate !== 0 ? [{ edit: "rotate", group, by: rotate }] : []),
  ]);
