import type { JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { Choice } from "../controls/choice.tsx";
import type { ComponentEdit, Model } from "../engine/example.ts";
import { during } from "../store.ts";

// The Gaussians of a sparse spectrum as discs, each with its mirror image: dragged to other frequencies, made wider or narrower by the
// wheel, taken away by Delete, added by a double click; all of it, and their strength, by keys and buttons, too.

const kSize = 360;
const kColors = ["#f2a93b", "#5db7de", "#8fcf6a", "#e0708f", "#b69cff", "#d9d05c"];
const kMostShown = 400;
const kStep = 1.15; // of a variance, or a width

interface Spot {
  band: number;
  component: number;
  x: number;
  y: number;
  a: number;
  variance: number;
  group: number;
}

export function SpectrumEditor({ model, change }: { model: Model; change: (edits: ComponentEdit[], at: number) => Promise<void> }): JSX.Element {
  const [channel, setChannel] = useState(0);
  const [chosen, choose] = useState<string | undefined>(undefined);
  const drag = useRef<Spot | undefined>(undefined);
  const pending = useRef(false);
  const next = useRef<ComponentEdit[] | undefined>(undefined);
  const svg = useRef<SVGSVGElement>(null);
  const own = model.channels[Math.min(channel, model.channels.length - 1)]!;
  const spots = useMemo(() => own.bands
    .flatMap(({ a, components }, band) => components.map(([x = 0, y = 0, variance = 0, group = 0], component): Spot => ({ band, component, x, y, a, variance, group })))
    .sort((one, other) => other.variance - one.variance)
    .slice(0, kMostShown), [own]);
  const largest = spots[0]?.variance ?? 1;
  const reach = useRef(0);
  const now = 1.15 * Math.max(1e-6, ...spots.filter(({ variance }) => variance > 2e-4 * largest).map(({ x, y }) => Math.hypot(x, y)));
  if (!drag.current) reach.current = now;
  const half = kSize / 2;
  const px = (f: number): number => (f / reach.current) * half;
  const at = (event: MouseEvent & { currentTarget: SVGSVGElement }): [number, number] => {
    const box = event.currentTarget.getBoundingClientRect();
    return [((event.clientX - box.left) / box.width * 2 - 1) * reach.current, (1 - (event.clientY - box.top) / box.height * 2) * reach.current];
  };
  // One change at a time, so that a drag is never ahead of its picture; of where it is dragged meanwhile the last counts.
  const send = (edits: ComponentEdit[]): void => {
    if (pending.current) {
      if (edits[0]?.edit === "move") next.current = edits;
      return;
    }
    pending.current = true;
    void during(async (at) => {
      for (let now: ComponentEdit[] | undefined = edits; now; now = next.current) {
        next.current = undefined;
        await change(now, at);
      }
      pending.current = false;
    });
  };
  const name = (spot: Spot): string => `${spot.band}.${spot.component}`;
  const place = ({ band, component }: Spot) => ({ channel, band, component });
  const stronger = (spot: Spot, by: number): void => send([{ edit: "variance", ...place(spot), by }]);
  // In the band of its new width it has another place, where it is chosen again.
  const widened = useRef<Spot | undefined>(undefined);
  const wider = (spot: Spot, by: number): void => {
    widened.current = spot;
    send([{ edit: "width", ...place(spot), by }]);
  };
  const insert = (to: [number, number]): void => send([{ edit: "add", channel, a: spots[0]?.a ?? 1, variance: 0.25 * largest, to }]);
  const drop = (spot: Spot): void => send([{ edit: "drop", ...place(spot) }]);
  // The one that keys reach: what was chosen, or the strongest; page keys go to the next one in strength.
  const current = Math.max(0, spots.findIndex((spot) => name(spot) === chosen));
  const focus = (i: number): void => svg.current?.querySelectorAll<SVGElement>("ellipse:nth-of-type(odd)")[i]?.focus();
  const go = (by: number): void => focus(Math.min(spots.length - 1, Math.max(0, current + by)));
  useEffect(() => {
    const from = widened.current;
    const to = spots.findIndex(({ x, y, a }) => x === from?.x && y === from.y && a !== from.a);
    if (to < 0) return;
    widened.current = undefined;
    focus(to);
  });
  // Hundreds of them, which are made anew only where they are others; what they do the whole picture hears.
  const discs = useMemo(() => spots.map((spot, i) => [1, -1].map((sign) => (
    <ellipse key={`${name(spot)}${sign}`} data-spot={i} cx={sign * px(spot.x)} cy={-sign * px(spot.y)} rx={Math.max(2.5, px(0.47 * spot.a))} ry={Math.max(2.5, px(0.47 * spot.a))}
      fill={kColors[spot.group % kColors.length]} fill-opacity={0.08 + 0.7 * Math.sqrt(spot.variance / largest)}
      class={chosen === name(spot) ? "chosen" : ""} tabindex={sign === 1 && i === current ? 0 : -1} {...(sign === 1 ? { role: "button" } : { "aria-hidden": true })}
      aria-label={`${own.groups[spot.group]}, frequency ${spot.x.toPrecision(3)} ${spot.y.toPrecision(3)}, ${(100 * spot.variance / largest).toFixed(0)} % of the strongest`} />
  ))), [spots, chosen, reach.current]);
  const spotOf = (event: Event): Spot | undefined => spots[Number((event.target as SVGElement).dataset.spot ?? -1)];
  const onKey = (event: KeyboardEvent): void => {
    const spot = spotOf(event);
    if (!spot) return;
    const step = 0.01 * reach.current;
    const [dx, dy] = ({ ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] } as Record<string, [number, number]>)[event.key] ?? [0, 0];
    if (dx !== 0 || dy !== 0) send([{ edit: "move", ...place(spot), to: [spot.x + dx, spot.y + dy] }]);
    else if (event.key === "Delete" || event.key === "Backspace") drop(spot);
    else if (event.key === "+" || event.key === "-") stronger(spot, event.key === "+" ? kStep : 1 / kStep);
    else if (event.key === "[" || event.key === "]") wider(spot, event.key === "]" ? kStep : 1 / kStep);
    else if (event.key === "PageUp" || event.key === "PageDown") go(event.key === "PageUp" ? -1 : 1);
    else return;
    event.preventDefault();
  };
  return (
    <div class="spectrum-editor">
      <Choice label="Channel" words={model.channels.map((_, i) => `Channel ${i + 1}`)} chosen={channel} choose={setChannel} />
      <svg ref={svg} viewBox={`${-half} ${-half} ${kSize} ${kSize}`} role="group" aria-label="The spectrum's Gaussians"
        onPointerDown={(event) => {
          const spot = spotOf(event);
          if (!spot) return;
          event.currentTarget.setPointerCapture(event.pointerId);
          choose(name(spot));
          drag.current = spot; // a mirror image goes where it is dragged, too: both are one wave
        }}
        onPointerMove={(event) => {
          const spot = drag.current;
          if (spot) send([{ edit: "move", ...place(spot), to: at(event) }]);
        }}
        onPointerUp={() => { drag.current = undefined; }}
        onDblClick={(event) => { if (!spotOf(event)) insert(at(event)); }}
        onWheel={(event) => {
          const spot = spotOf(event);
          if (!spot) return;
          event.preventDefault();
          wider(spot, event.deltaY < 0 ? kStep : 1 / kStep);
        }}
        onFocusIn={(event) => { const spot = spotOf(event); if (spot) choose(name(spot)); }} onKeyDown={onKey}>
        <circle class="axis" r={half * 0.5} fill="none" /><circle class="axis" r={half * 0.99} fill="none" />
        <line class="axis" x1={-half} x2={half} /><line class="axis" y1={-half} y2={half} />
        {discs}
      </svg>
      <p class="hint">{own.groups.map((group, i) => <span key={group}><i style={{ background: kColors[i % kColors.length] }} />{group} </span>)}
        <br />Drag one, the wheel makes it wider, double-click to add one; or arrows, [ and ], plus and minus for strength, page keys, Delete.</p>
      <div class="more">
        <button onClick={() => insert([0.5 * reach.current, 0])}>+ Add</button>
        {spots[current] && <>
          <button onClick={() => stronger(spots[current]!, kStep)}>Stronger</button>
          <button onClick={() => stronger(spots[current]!, 1 / kStep)}>Weaker</button>
          <button onClick={() => wider(spots[current]!, kStep)}>Wider</button>
          <button onClick={() => wider(spots[current]!, 1 / kStep)}>Narrower</button>
          <button onClick={() => drop(spots[current]!)}>Remove</button>
        </>}
      </div>
    </div>
  );
}
