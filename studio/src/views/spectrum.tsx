import { useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { engine } from "../engine/engine.ts";
import { Dropped } from "../engine/pool.ts";
import { activeNoise, state, timeOf } from "../store.ts";
import { paint } from "./paint.ts";

// The spectrum of the slice: its periodogram, and the mean over directions over what the noise's closed form says.

const kSide = 192;

interface Spectrum {
  picture: Float32Array;
  frequencies: Float32Array;
  powers: Float32Array;
  expected: Float32Array | undefined;
  nyquist: number;
}

export function SpectrumView(): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [spectrum, setSpectrum] = useState<Spectrum | undefined>(undefined);
  const waiting = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);

  useSignalEffect(() => {
    const noise = activeNoise();
    const { plane } = state.value;
    const when = timeOf(noise);
    if (!noise.text) return;
    clearTimeout(waiting.current);
    waiting.current = setTimeout(async () => {
      engine.modeller.drop("spectrum");
      try {
        const { json, floats } = await engine.modeller.ask("spectrum", {
          do: "spectrum", recipe: noise.text, grid: noise.grid, plane: { ...plane, columns: kSide, rows: kSide }, ...(when === undefined ? {} : { time: when }),
        });
        setSpectrum({ picture: floats[0]!, frequencies: floats[1]!, powers: floats[2]!, expected: floats[3], nyquist: Number(json.nyquist) });
      } catch (error) {
        if (!(error instanceof Dropped)) setSpectrum(undefined);
      }
    }, 180);
  });

  useEffect(() => {
    if (!canvas.current) return;
    const context = paint(canvas.current);
    if (!spectrum) return context.clearRect(0, 0, kSide, kSide);
    const image = context.createImageData(kSide, kSide);
    let highest = 0;
    for (const value of spectrum.picture) highest = Math.max(highest, value);
    for (let x = 0; x < kSide; ++x) {
      for (let y = 0; y < kSide; ++y) {
        const t = Math.min(1, Math.max(0, 1 + Math.log10(Math.max(spectrum.picture[x * kSide + y]! / highest, 1e-30)) / 6));
        const to = 4 * ((kSide - 1 - y) * kSide + x);
        // Dark blue, amber, white.
        image.data[to] = 255 * Math.min(1, 1.7 * t ** 1.6);
        image.data[to + 1] = 255 * Math.min(1, 1.15 * t ** 2.1);
        image.data[to + 2] = 255 * Math.min(1, 0.22 * t + t ** 5);
        image.data[to + 3] = 255;
      }
    }
    context.putImageData(image, 0, 0);
  }, [spectrum]);

  return (
    <section class="spectrum" aria-label="Spectrum">
      <canvas ref={canvas} width={kSide} height={kSide} role="img" aria-label="Periodogram of the slice, frequency 0 in the middle" />
      {spectrum && <Chart spectrum={spectrum} />}
    </section>
  );
}

const kWidth = 300;
const kHeight = 150;
const kLeft = 26;
const kBottom = 18;
const kTop = 32; // of the words

function Chart({ spectrum }: { spectrum: Spectrum }): JSX.Element {
  const { frequencies, powers, expected } = spectrum;
  // Densities on a circle of this radius weigh by its length: the area under the line is the variance.
  const weigh = (values: Float32Array): number[] => Array.from(values, (power, i) => 2 * Math.PI * frequencies[i]! * power);
  const measured = weigh(powers);
  const closed = expected && weigh(expected);
  const highest = Math.max(...(closed ?? measured), ...measured, 1e-12);
  // Up to where all but a hundredth of it is.
  const total = (closed ?? measured).reduce((a, b) => a + b, 0);
  let sum = 0;
  let end = (closed ?? measured).findIndex((value) => (sum += value) > 0.995 * total);
  if (end < 0) end = frequencies.length - 1;
  const most = Math.min(spectrum.nyquist, 1.25 * (frequencies[end] ?? 1));
  const x = (f: number): number => kLeft + (f / most) * (kWidth - kLeft - 6);
  const y = (value: number): number => kHeight - kBottom - (value / highest) * (kHeight - kBottom - kTop);
  const points = Array.from(frequencies, (f, i) => [f, i] as const).filter(([f]) => f <= most);
  const ticks = [0.25, 0.5, 0.75, 1].map((t) => Number((t * most).toPrecision(2)));
  return (
    <svg viewBox={`0 0 ${kWidth} ${kHeight}`} role="img" aria-label="Power over frequency: measured points over the closed form">
      <line class="axis" x1={kLeft} x2={kWidth - 6} y1={kHeight - kBottom} y2={kHeight - kBottom} />
      {ticks.filter((tick) => tick <= most).map((tick) => (
        <text key={tick} x={x(tick)} y={kHeight - 5} text-anchor="middle">{tick}</text>
      ))}
      <text x={kLeft - 6} y={kHeight - 5} text-anchor="middle">0</text>
      {closed && <polyline class="closed" points={points.map(([f, i]) => `${x(f)},${y(closed[i]!)}`).join(" ")} />}
      {points.map(([f, i]) => <circle key={i} cx={x(f)} cy={y(measured[i]!)} r="1.9" />)}
      <text class="legend" x={kWidth - 8} y="14" text-anchor="end">{closed ? "● measured   — closed form" : "● measured"}</text>
      <text class="legend" x={kWidth - 8} y="27" text-anchor="end">cycles per unit</text>
    </svg>
  );
}
