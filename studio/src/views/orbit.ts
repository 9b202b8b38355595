import { Fingers } from "./fingers.ts";

// An eye on a sphere around what is looked at: azimuth and height in radians, distance in its radii.
export class Orbit {
  constructor(
    public azimuth: number,
    public height: number,
    public distance: number,
  ) {}

  eye(): [number, number, number] {
    const c = Math.cos(this.height);
    return [this.distance * c * Math.sin(this.azimuth), this.distance * Math.sin(this.height), this.distance * c * Math.cos(this.azimuth)];
  }

  turn(x: number, y: number): void {
    this.azimuth -= x;
    this.height = Math.min(1.5, Math.max(-1.5, this.height + y));
  }

  // Listens to mouse, fingers, wheel and keys; the function ends that.
  attach(element: HTMLElement, changed: () => void): () => void {
    let from: [number, number] | undefined;
    const fingers = new Fingers();
    const down = (event: PointerEvent): void => {
      element.setPointerCapture(event.pointerId);
      fingers.down(event);
      from = [event.clientX, event.clientY];
    };
    const move = (event: PointerEvent): void => {
      const pinch = fingers.move(event);
      if (pinch) return zoom(pinch.factor);
      if (!from) return;
      this.turn((event.clientX - from[0]) / 150, (event.clientY - from[1]) / 150);
      from = [event.clientX, event.clientY];
      changed();
    };
    const up = (event: PointerEvent): void => {
      fingers.up(event);
      from = undefined;
    };
    const zoom = (factor: number): void => {
      this.distance = Math.min(12, Math.max(0.8, this.distance * factor));
      changed();
    };
    const wheel = (event: WheelEvent): void => {
      event.preventDefault();
      zoom(Math.exp(event.deltaY * 0.001));
    };
    const key = (event: KeyboardEvent): void => {
      const turns: Record<string, [number, number]> = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
      const turn = turns[event.key];
      if (turn) this.turn(...turn);
      else if (event.key === "+" || event.key === "-") return zoom(event.key === "+" ? 0.9 : 1.1);
      else return;
      event.preventDefault();
      changed();
    };
    element.addEventListener("pointerdown", down);
    element.addEventListener("pointermove", move);
    element.addEventListener("pointerup", up);
    element.addEventListener("pointercancel", up);
    element.addEventListener("wheel", wheel, { passive: false });
    element.addEventListener("keydown", key);
    return () => {
      element.removeEventListener("pointerdown", down);
      element.removeEventListener("pointermove", move);
      element.removeEventListener("pointerup", up);
      element.removeEventListener("pointercancel", up);
      element.removeEventListener("wheel", wheel);
      element.removeEventListener("keydown", key);
    };
  }
}
