import type { JSX } from "preact";
import { useRef } from "preact/hooks";
import type { Path } from "../store.ts";
import { nameOf, set } from "./fields.tsx";
import type { Json } from "./schema.ts";

// Pairs of a value and what it becomes, as a curve whose points are dragged; a double click adds one or takes one away; of the one that
// has the focus arrow keys, Insert and Delete do the same.

const kWidth = 240;
const kHeight = 110;
const kBorder = 8;

export function RampEditor({ value, path, name }: { value: Json | undefined; path: Path; name: string }): JSX.Element {
  const points = (Array.isArray(value) ? value : []).map((pair) => (Array.isArray(pair) ? [Number(pair[0]), Number(pair[1])] : [0, 0]) as [number, number]);
  const dragged = useRef<number | undefined>(undefined);
  const frame = useRef<[number, number, number, number] | undefined>(undefined);
  const xs = points.map(([x]) => x);
  const ys = points.map(([, y]) => y);
  const room = (low: number, high: number): [number, number] => {
    const margin = 0.15 * (high - low || 1);
    return [low - margin, high + margin];
  };
  const own: [number, number, number, number] = [...room(Math.min(...xs), Math.max(...xs)), ...room(Math.min(...ys), Math.max(...ys))];
  const [x0, x1, y0, y1] = frame.current ?? own;
  const left = (x: number): number => kBorder + ((x - x0) / (x1 - x0)) * (kWidth - 2 * kBorder);
  const top = (y: number): number => kHeight - kBorder - ((y - y0) / (y1 - y0)) * (kHeight - 2 * kBorder);
  const at = (event: MouseEvent & { currentTarget: SVGSVGElement }): [number, number] => {
    const box = event.currentTarget.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * kWidth;
    const y = ((event.clientY - box.top) / box.height) * kHeight;
    return [x0 + ((x - kBorder) / (kWidth - 2 * kBorder)) * (x1 - x0), y0 + ((kHeight - kBorder - y) / (kHeight - 2 * kBorder)) * (y1 - y0)];
  };
  const short = (x: number): number => Number(x.toPrecision(4));
  // Values stay in order.
  const moveTo = (i: number, [x, y]: [number, number]): void => {
    const gap = 1e-3 * (x1 - x0);
    const low = i > 0 ? points[i - 1]![0] + gap : -Infinity;
    const high = i + 1 < points.length ? points[i + 1]![0] - gap : Infinity;
    set(path, points.map((point, k) => (k === i ? [short(Math.min(high, Math.max(low, x))), short(y)] : point)));
  };
  const insert = (x: number, y: number): void => set(path, [...points, [short(x), short(y)] as [number, number]].sort((a, b) => a[0] - b[0]));
  const drop = (i: number): void => {
    if (points.length > 2) set(path, points.filter((_, k) => k !== i));
  };
  const line = points.map(([x, y]) => `${left(x)},${top(y)}`).join(" ");
  return (
    <svg class="ramp" viewBox={`0 0 ${kWidth} ${kHeight}`} role="group" aria-label={`${nameOf(path, name)}: points of a curve`}
      onPointerMove={(event) => dragged.current !== undefined && moveTo(dragged.current, at(event))}
      onPointerUp={() => { dragged.current = undefined; frame.current = undefined; }}
      onDblClick={(event) => insert(...at(event))}>
      <line class="axis" x1={left(0)} x2={left(0)} y1="0" y2={kHeight} />
      <line class="axis" y1={top(0)} y2={top(0)} x1="0" x2={kWidth} />
      <polyline points={`0,${top(ys[0] ?? 0)} ${line} ${kWidth},${top(ys[ys.length - 1] ?? 0)}`} />
      {points.map(([x, y], i) => (
        <circle key={i} cx={left(x)} cy={top(y)} r="5" tabindex={0} role="slider" aria-label={`Point ${i + 1} of ${nameOf(path, name)}`} aria-valuenow={y} aria-valuetext={`${x} becomes ${y}`}
          onPointerDown={(event) => {
            event.currentTarget.ownerSVGElement?.setPointerCapture(event.pointerId);
            dragged.current = i;
            frame.current = own;
          }}
          onDblClick={(event) => {
            event.stopPropagation();
            drop(i);
          }}
          onKeyDown={(event) => {
            const [dx, dy] = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] } as Record<string, [number, number]>)[event.key] ?? [0, 0];
            const [x2, y2] = points[i + 1] ?? points[i - 1] ?? [x, y];
            if (dx !== 0 || dy !== 0) moveTo(i, [x + 0.02 * dx * (x1 - x0), y + 0.02 * dy * (y1 - y0)]);
            else if (event.key === "Insert") insert((x + x2) / 2, (y + y2) / 2);
            else if (event.key === "Delete" || event.key === "Backspace") drop(i);
            else return;
            event.preventDefault();
          }} />
      ))}
      {points.map(([x, y], i) => <title key={i}>{`${x} → ${y}`}</title>)}
    </svg>
  );
}
