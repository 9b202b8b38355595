import type { Noise, Plane } from "../store.ts";
import { Follower } from "./follower.ts";
import type { Pool, Timed } from "./pool.ts";

// A picture of a plane by the pool, in strips: as soon as a change comes, a draft of the size that is done within the time of a
// glance, and sharper when nothing more comes.

export interface Shown {
  low?: number;
  high?: number;
  colors?: boolean;
  encoded?: boolean;
  vector?: boolean;
}
export interface SlicePicture {
  columns: number;
  rows: number;
  channels: Float32Array[]; // column by column, from the bottom up
  shown: Shown;
  plane: Plane;
  milliseconds: number; // from the question to the picture
  ready: number; // of them, until the first pixel was begun
  work: number; // on pixels, of all workers together
}

export interface SliceRequest {
  noise: Noise;
  plane: Plane;
  time: number | undefined;
  columns: number;
  rows: number;
}

// `draft` is for few pixels, at once; `parts` is into how many strips it is cut, if they are wide enough.
export async function sampleSlice(pool: Pool, topic: string, request: SliceRequest, { urgent = false, draft = false, parts = pool.size } = {}): Promise<SlicePicture> {
  const { noise, plane, time, columns, rows } = request;
  const begin = performance.now();
  const strips = Math.max(1, Math.min(parts, Math.floor(columns / 12)));
  const question = {
    do: "slice", recipe: noise.text, grid: noise.grid, plane: { ...plane, columns, rows }, draft,
    ...(time === undefined ? {} : { time }),
  };
  const jobs: Promise<[number, Timed]>[] = [];
  for (let i = 0; i < strips; ++i) {
    const first = Math.floor((i * columns) / strips);
    const count = Math.floor(((i + 1) * columns) / strips) - first;
    jobs.push(pool.ask(topic, { ...question, first: [first, 0], count: [count, rows] }, { urgent }).then((answer) => [first, answer]));
  }
  const answers = await Promise.all(jobs);
  const channels = answers[0]![1].floats.map(() => new Float32Array(columns * rows));
  let work = 0;
  let ready = 0;
  for (const [first, answer] of answers) {
    work += answer.milliseconds - Number(answer.json.ready);
    ready = Math.max(ready, Number(answer.json.ready));
    answer.floats.forEach((values, channel) => channels[channel]?.set(values, first * rows));
  }
  return { columns, rows, channels, shown: answers[0]![1].json as Shown, plane, milliseconds: performance.now() - begin, ready, work };
}

// What is black and what is white.
export function rangeOf({ channels, shown }: SlicePicture): [number, number] {
  if (shown.low !== undefined && shown.high !== undefined) return [shown.low, shown.high];
  let low = Infinity;
  let high = -Infinity;
  for (const values of channels) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low < high ? [low, high] : [low - 1, low + 1];
}

const encodedByte = new Uint8ClampedArray(4097);
for (let i = 0; i <= 4096; ++i) {
  const linear = i / 4096;
  encodedByte[i] = 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
}

// Pixels, the first row at the top: grey in proportion to the value, by a ramp of 256 colours, or as colours.
export function drawSlice(picture: SlicePicture, ramp: Float32Array | undefined): ImageData {
  const { columns, rows, channels, shown } = picture;
  const [low, high] = rangeOf(picture);
  const image = new ImageData(columns, rows);
  const bytes = image.data;
  const scale = 1 / (high - low);
  const color = channels.length === 3;
  for (let column = 0; column < columns; ++column) {
    for (let row = 0; row < rows; ++row) {
      const from = column * rows + row;
      const to = 4 * ((rows - 1 - row) * columns + column);
      bytes[to + 3] = 255;
      if (color) {
        for (let c = 0; c < 3; ++c) {
          const value = channels[c]![from]!;
          if (shown.colors && !shown.encoded) bytes[to + c] = encodedByte[Math.min(4096, Math.max(0, Math.round(4096 * value)))]!;
          else bytes[to + c] = Math.round(255 * (value - low) * scale);
        }
        continue;
      }
      const t = Math.min(1, Math.max(0, (channels[0]![from]! - low) * scale));
      if (!ramp) {
        bytes[to] = bytes[to + 1] = bytes[to + 2] = Math.round(255 * t);
      } else {
        const entry = 3 * Math.round(255 * t);
        for (let c = 0; c < 3; ++c) bytes[to + c] = Math.round(255 * ramp[entry + c]!);
      }
    }
  }
  return image;
}

const kGlance = 28; // milliseconds that the picture may take that follows a slider
const kSmallest = 24; // pixels along the longest side of a draft
const kLargest = 256;
// What of a recipe stays where a slider moves: of another form it is not known yet how long pictures take.
const formOf = ({ text, grid }: Noise): string => `${grid} ${text.replace(/-?\d[\d.e+-]*/g, "")}`;

const kPatience = 2000; // milliseconds that a draft may take while another is wanted

const kStrip = 25; // that a strip of the sharp one may, which cannot be stopped when there is something newer

// Pictures of one view: a coarse one that follows, and a fine one when it rests.
export class SliceMaker {
  private side = kSmallest; // of the next draft
  private shown = 0; // of the last one
  private parts = 1; // strips of it: where it takes longer to begin pixels than to make them, one worker does it
  private form = ""; // of its recipe
  private cost = 0; // of a pixel, milliseconds of one worker
  private began = 0; // when the draft that is under way was asked for; 0: there is none
  private hurry: ReturnType<typeof setTimeout> | undefined;
  private readonly follower: Follower<SliceRequest>;

  constructor(
    private readonly pool: Pool,
    private readonly topic: string,
    private readonly show: (picture: SlicePicture, sharp: boolean) => void,
    fail: (error: Error) => void,
  ) {
    this.follower = new Follower((request) => this.follow(request), (request, wanted) => this.sharpen(request, wanted), fail);
  }

  // `request` has the size of the fine picture.
  want(request: SliceRequest): void {
    this.pool.drop(`${this.topic} sharp`);
    const { began } = this;
    if (began > 0) {
      clearTimeout(this.hurry);
      this.hurry = setTimeout(() => this.began === began && this.pool.interrupt(this.topic), kPatience - (performance.now() - began));
    }
    this.follower.want(request);
  }

  stop(): void {
    this.follower.stop();
    clearTimeout(this.hurry);
    this.pool.drop(this.topic);
    this.pool.drop(`${this.topic} sharp`);
  }

  private async follow(request: SliceRequest): Promise<void> {
    const form = formOf(request.noise);
    if (form !== this.form) [this.side, this.parts] = [kSmallest, 1];
    this.form = form;
    this.shown = this.side;
    this.began = performance.now();
    const asked = sampleSlice(this.pool, this.topic, sized(request, this.side), { urgent: true, draft: true, parts: this.parts });
    const picture = await asked.finally(() => (this.began = 0));
    this.show(picture, false);
    this.cost = picture.work / (picture.columns * picture.rows);
    const left = Math.max(1, kGlance - picture.ready);
    this.parts = picture.work > picture.ready ? this.pool.size : 1;
    const most = this.side * Math.sqrt(left / Math.max(1, picture.milliseconds - picture.ready));
    this.side = Math.min(kLargest, Math.max(kSmallest, 8 * Math.floor(most / 8)));
  }

  private async sharpen(request: SliceRequest, wanted: () => boolean): Promise<void> {
    for (const side of [kLargest, 2048]) {
      if (!wanted()) return;
      const draft = side === kLargest;
      if (draft && (this.shown === kLargest || Math.max(request.columns, request.rows) <= kLargest)) continue;
      const whole = sized(request, side);
      const parts = Math.max(this.pool.size, Math.ceil((this.cost * whole.columns * whole.rows) / kStrip));
      const picture = await sampleSlice(this.pool, `${this.topic} sharp`, whole, { draft, parts });
      if (wanted()) this.show(picture, !draft);
    }
  }
}

function sized(request: SliceRequest, side: number): SliceRequest {
  const scale = Math.min(1, side / Math.max(request.columns, request.rows));
  return { ...request, columns: Math.max(8, Math.round(request.columns * scale)), rows: Math.max(8, Math.round(request.rows * scale)) };
}
