// A canvas's pixels, in memory: what is put there often would otherwise wait each time for the graphics card, or for what stands for one.
export function paint(canvas: HTMLCanvasElement): CanvasRenderingContext2D;
export function paint(canvas: OffscreenCanvas): OffscreenCanvasRenderingContext2D;
export function paint(canvas: HTMLCanvasElement | OffscreenCanvas): unknown {
  return canvas.getContext("2d", { willReadFrequently: true });
}
