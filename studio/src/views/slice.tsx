import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { drawSlice, rangeOf, SliceMaker, type SlicePicture } from "../engine/slice.ts";
import { engine } from "../engine/engine.ts";
import { commit, pixels, type Plane, state, time, timeOf, type Vector } from "../store.ts";
import { areOthers, useEffectAtOnce } from "./at_once.ts";
import { Fingers } from "./fingers.ts";
import { paint } from "./paint.ts";

// A plane through one of the noises: dragged with the mouse, zoomed with the wheel or two fingers, turned with the right button or Alt; by keys, too.

const add = (a: Vector, b: Vector, k = 1): Vector => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a: Vector): Vector => {
  const length = Math.hypot(...a) || 1;
  return [a[0] / length, a[1] / length, a[2] / length];
};
const tidy = (a: Vector): Vector => a.map((x) => Number(x.toPrecision(6))) as Vector;

function axesOf(plane: Plane): { right: Vector; up: Vector; normal: Vector } {
  const normal = unit(plane.normal);
  const right = unit(cross(plane.up, normal));
  return { right, up: cross(normal, right), normal };
}

// Turned by so much to the right and up, in radians while that is little.
function turned(plane: Plane, across: number, upwards: number): Plane {
  const { right, up, normal } = axesOf(plane);
  const facing = unit(add(add(normal, right, across), up, upwards));
  return { ...plane, normal: tidy(facing), up: tidy(unit(add(up, facing, -dot(up, facing)))) };
}

const setPlane = (plane: Plane, tag: string): void => commit({ ...state.value, plane }, tag);

export function SliceView({ index }: { index: number }): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const maker = useRef<SliceMaker | undefined>(undefined);
  const last = useRef<SlicePicture | undefined>(undefined);
  const [size, setSize] = useState<[number, number]>([0, 0]);
  const [told, tell] = useState<{ ms: number; range: [number, number]; sharp: boolean; size: string } | undefined>(undefined);
  const [failure, fail] = useState("");
  const [value, setValue] = useState<string>("");

  // A picture in its colours, made once.
  const colored = useRef<{ picture: SlicePicture; ramp: string; store: OffscreenCanvas } | undefined>(undefined);
  const inColors = (picture: SlicePicture): OffscreenCanvas => {
    const { ramp } = state.value;
    if (colored.current?.picture !== picture || colored.current.ramp !== ramp) {
      const store = new OffscreenCanvas(picture.columns, picture.rows);
      paint(store).putImageData(drawSlice(picture, engine.ramps.get(ramp)), 0, 0);
      colored.current = { picture, ramp, store };
    }
    return colored.current.store;
  };

  // What is drawn while a picture of another plane is on its way: the last one, where it lies now.
  const drawn = useRef<unknown[]>([]);
  const draw = (): void => {
    const element = canvas.current;
    const picture = last.current;
    if (!element || !picture) return;
    if (!areOthers([picture, state.value.plane, state.value.ramp, element.width, element.height], drawn)) return;
    const context = paint(element);
    const store = inColors(picture);
    context.imageSmoothingEnabled = true;
    context.imageSmoothingQuality = "high";
    const now = state.value.plane;
    const { right, up } = axesOf(now);
    const scale = picture.plane.width / now.width;
    const shift: Vector = [picture.plane.origin[0] - now.origin[0], picture.plane.origin[1] - now.origin[1], picture.plane.origin[2] - now.origin[2]];
    const unitLength = element.width / now.width;
    const width = element.width * scale;
    const height = (width * picture.rows) / picture.columns;
    if (scale !== 1 || Math.hypot(...shift) > 0) context.clearRect(0, 0, element.width, element.height);
    context.drawImage(store, (element.width - width) / 2 + dot(shift, right) * unitLength, (element.height - height) / 2 - dot(shift, up) * unitLength, width, height);
  };

  useEffect(() => {
    maker.current = new SliceMaker(engine.pool, `slice ${index}`, (picture, sharp) => {
      last.current = picture;
      draw();
      fail("");
      tell({ ms: picture.milliseconds, range: rangeOf(picture), sharp, size: `${picture.columns} × ${picture.rows}` });
      engine.times.slice = picture.milliseconds;
      canvas.current?.dispatchEvent(new CustomEvent("pictured", { bubbles: true, detail: { sharp, picture, side: Math.max(picture.columns, picture.rows) } }));
    }, (error) => {
      fail(error.message);
      tell(undefined);
    });
    const observer = new ResizeObserver(([entry]) => {
      const ratio = Math.min(2, devicePixelRatio);
      const limit = Math.min(1, 1100 / Math.max(entry!.contentRect.width * ratio, entry!.contentRect.height * ratio));
      setSize([Math.round(entry!.contentRect.width * ratio * limit), Math.round(entry!.contentRect.height * ratio * limit)]);
    });
    observer.observe(canvas.current!);
    return () => {
      observer.disconnect();
      maker.current?.stop();
    };
  }, []);

  const asked = useRef<unknown[]>([]);
  const want = (): void => {
    const noise = state.value.noises[index];
    if (!noise?.text || size[0] < 8 || size[1] < 8) return;
    if (!areOthers([noise.text, noise.grid, state.value.plane, timeOf(noise), ...size], asked)) return;
    maker.current?.want({ noise, plane: state.value.plane, time: timeOf(noise), columns: size[0], rows: size[1] });
  };
  useEffectAtOnce(() => {
    state.value;
    time.value;
    want();
    if (last.current) draw();
  });
  useEffect(() => {
    draw();
    want();
    if (size[0] > 0) pixels.value = size;
  }, [size]);

  const fingers = useRef(new Fingers());
  const drag = useRef<{ x: number; y: number; plane: Plane; turns: boolean } | undefined>(undefined);
  const unitsPerPixel = (): number => state.value.plane.width / (canvas.current?.clientWidth || 1);
  // What lies at a place of the page stays there.
  const zoomAt = (clientX: number, clientY: number, factor: number): void => {
    const box = canvas.current!.getBoundingClientRect();
    const { plane } = state.value;
    const { right, up } = axesOf(plane);
    const k = unitsPerPixel() * (1 - factor);
    const x = clientX - box.left - box.width / 2;
    const y = box.top + box.height / 2 - clientY;
    setPlane({ ...plane, width: Number((plane.width * factor).toPrecision(5)), origin: tidy(add(add(plane.origin, right, x * k), up, y * k)) }, "zoom");
  };
  const onMove = (event: PointerEvent): void => {
    const pinch = fingers.current.move(event);
    if (pinch) {
      const { plane } = state.value;
      const { right, up } = axesOf(plane);
      const k = unitsPerPixel();
      setPlane({ ...plane, origin: tidy(add(add(plane.origin, right, -pinch.dx * k), up, pinch.dy * k)) }, "zoom");
      return zoomAt(pinch.x, pinch.y, pinch.factor);
    }
    const begin = drag.current;
    if (begin) {
      const dx = event.clientX - begin.x;
      const dy = event.clientY - begin.y;
      const { right, up } = axesOf(begin.plane);
      if (begin.turns) return setPlane(turned(begin.plane, -dx / 200, dy / 200), "turn");
      const k = unitsPerPixel();
      return setPlane({ ...begin.plane, origin: tidy(add(add(begin.plane.origin, right, -dx * k), up, dy * k)) }, "pan");
    }
    const picture = last.current;
    if (!picture || !canvas.current) return;
    const box = canvas.current.getBoundingClientRect();
    const column = Math.floor(((event.clientX - box.left) / box.width) * picture.columns);
    const row = picture.rows - 1 - Math.floor(((event.clientY - box.top) / box.height) * picture.rows);
    const at = column * picture.rows + row;
    setValue(picture.channels.map((channel) => channel[at]?.toFixed(3) ?? "").join(" "));
  };
  const onUp = (event: PointerEvent): void => {
    fingers.current.up(event);
    drag.current = undefined;
  };
  const onWheel = (event: WheelEvent): void => {
    event.preventDefault();
    if (event.shiftKey) {
      const { plane } = state.value;
      const { normal } = axesOf(plane);
      return setPlane({ ...plane, origin: tidy(add(plane.origin, normal, Math.sign(event.deltaY || event.deltaX) * plane.width * 0.01)) }, "depth");
    }
    zoomAt(event.clientX, event.clientY, Math.exp(event.deltaY * 0.0015));
  };
  useEffect(() => {
    const element = canvas.current!;
    element.addEventListener("wheel", onWheel, { passive: false });
    return () => element.removeEventListener("wheel", onWheel);
  });
  const onKey = (event: KeyboardEvent): void => {
    const { plane } = state.value;
    const { right, up, normal } = axesOf(plane);
    const step = 0.05 * plane.width;
    const moves: Record<string, () => Plane> = {
      ArrowLeft: () => ({ ...plane, origin: tidy(add(plane.origin, right, -step)) }),
      ArrowRight: () => ({ ...plane, origin: tidy(add(plane.origin, right, step)) }),
      ArrowUp: () => ({ ...plane, origin: tidy(add(plane.origin, up, step)) }),
      ArrowDown: () => ({ ...plane, origin: tidy(add(plane.origin, up, -step)) }),
      PageUp: () => ({ ...plane, origin: tidy(add(plane.origin, normal, step / 4)) }),
      PageDown: () => ({ ...plane, origin: tidy(add(plane.origin, normal, -step / 4)) }),
      "+": () => ({ ...plane, width: plane.width / 1.2 }),
      "-": () => ({ ...plane, width: plane.width * 1.2 }),
    };
    const turns: Record<string, () => Plane> = {
      ArrowLeft: () => turned(plane, 0.05, 0), ArrowRight: () => turned(plane, -0.05, 0), ArrowUp: () => turned(plane, 0, -0.05), ArrowDown: () => turned(plane, 0, 0.05),
    };
    const move = (event.shiftKey && turns[event.key]) || moves[event.key];
    if (!move) return;
    event.preventDefault();
    setPlane(move(), "keys");
  };

  return (
    <figure class="view slice">
      <canvas ref={canvas} width={size[0]} height={size[1]} tabIndex={0} role="img"
        aria-label="A slice of the noise. Arrow keys move it, with Shift they turn it; plus and minus zoom, page keys go deeper."
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          fingers.current.down(event);
          drag.current = fingers.current.several ? undefined : { x: event.clientX, y: event.clientY, plane: state.value.plane, turns: event.altKey || event.button === 2 };
        }}
        onPointerMove={onMove} onPointerUp={onUp} onPointerCancel={onUp} onPointerLeave={() => setValue("")}
        onContextMenu={(event) => event.preventDefault()} onKeyDown={onKey} />
      {failure && <p class="failure" role="alert">{failure}</p>}
      <figcaption>
        {told && <span data-sharp={told.sharp} aria-live={told.sharp ? "polite" : "off"}>{told.size} · {told.ms.toFixed(0)} ms</span>}
        {told && <span>{told.range[0].toPrecision(3)} … {told.range[1].toPrecision(3)}</span>}
        {value && <span class="value">{value}</span>}
      </figcaption>
    </figure>
  );
}
