// Two fingers on an element: by what share they came together, where their middle is and how far it went, in pixels of the page.

export interface Pinch {
  factor: number; // above 1: together
  x: number;
  y: number;
  dx: number;
  dy: number;
}

export class Fingers {
  private readonly places = new Map<number, [number, number]>();

  down(event: PointerEvent): void {
    this.places.set(event.pointerId, [event.clientX, event.clientY]);
  }

  up(event: PointerEvent): void {
    this.places.delete(event.pointerId);
  }

  get several(): boolean {
    return this.places.size > 1;
  }

  move(event: PointerEvent): Pinch | undefined {
    const before = this.measure();
    if (this.places.has(event.pointerId)) this.down(event);
    const after = this.measure();
    return before && after && { factor: before.distance / after.distance, x: after.x, y: after.y, dx: after.x - before.x, dy: after.y - before.y };
  }

  private measure(): { distance: number; x: number; y: number } | undefined {
    const [a, b] = [...this.places.values()];
    return a && b && { distance: Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1])), x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2 };
  }
}
