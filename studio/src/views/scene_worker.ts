import { contextOf } from "./gl.ts";
import { SurfaceRenderer } from "./surface_renderer.ts";
import { VolumeRenderer } from "./volume_renderer.ts";

// Draws the page's scenes, so that the page itself never waits for a graphics process: each scene on a canvas that the page has given
// away, as the messages on a port of its own say.

export interface ToWorker {
  kind: keyof typeof kRenderers;
  canvas: OffscreenCanvas;
  port: MessagePort;
}
// What has become another: the next frame is of the newest of each.
export interface ToScene<Data, Shot> {
  size?: [number, number]; // pixels
  data?: Data;
  shot?: Shot; // from where it is seen, and how
  end?: true;
}
export interface FromScene {
  taken?: number; // of the data that came: the last of them is drawn, those before never are
  trouble?: string; // why nothing more is drawn
}

interface Renderer {
  load(data: unknown): void;
  render(shot: unknown): void;
}
const kRenderers = { volume: VolumeRenderer, surface: SurfaceRenderer };

class Scene {
  private gl: WebGL2RenderingContext | undefined; // asked for once: Firefox fails the second time where the canvas is gone
  private renderer: Renderer | undefined;
  private newest: ToScene<unknown, unknown> = {};
  private loaded: unknown;
  private waiting = 0; // data that is not drawn
  private frame = 0;

  constructor(private readonly own: ToWorker) {
    const { canvas, port } = own;
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault()); // without which it stays lost
    canvas.addEventListener("webglcontextrestored", () => this.make());
    port.onmessage = ({ data }: MessageEvent<ToScene<unknown, unknown>>) => {
      if (data.end) return this.end();
      if (data.data) ++this.waiting;
      Object.assign(this.newest, data);
      this.want();
    };
    this.make();
  }

  private make(): void {
    this.attempt(() => {
      this.gl ??= contextOf(this.own.canvas);
      this.renderer = new kRenderers[this.own.kind](this.gl);
      this.loaded = undefined;
      this.want();
    });
  }

  private want(): void {
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0;
      this.attempt(() => this.draw());
    });
  }

  private draw(): void {
    const { renderer, newest: { size, data, shot }, own: { canvas, port } } = this;
    if (!renderer || !size || !data || !shot) return;
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
    if (data !== this.loaded) renderer.load((this.loaded = data));
    renderer.render(shot);
    if (this.waiting) port.postMessage({ taken: this.waiting } satisfies FromScene);
    this.waiting = 0;
  }

  private attempt(work: () => void): void {
    try {
      work();
    } catch (error) {
      this.own.port.postMessage({ trouble: (error as Error).message } satisfies FromScene);
      this.end();
    }
  }

  // The context does not wait for someone to collect it: browsers allow few.
  private end(): void {
    cancelAnimationFrame(this.frame);
    this.own.port.close();
    this.gl?.getExtension("WEBGL_lose_context")?.loseContext();
  }
}

self.onmessage = ({ data }: MessageEvent<ToWorker>) => void new Scene(data);
