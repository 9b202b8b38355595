import { busy, idle } from "./calm.ts";
import { Dropped } from "./pool.ts";

// What follows something that is moved: a coarse picture at once, one at a time, of the newest that is wanted; a fine one when it rests.

const kRest = 90; // milliseconds

export class Follower<Request> {
  private request: Request | undefined;
  private running = false;
  private again = false;
  private rest: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly coarse: (request: Request) => Promise<void>,
    // Asks now and then whether it is still `wanted`.
    private readonly fine: (request: Request, wanted: () => boolean) => Promise<void>,
    private readonly fail: (error: Error) => void,
  ) {}

  want(request: Request): void {
    this.request = request;
    this.again = true;
    clearTimeout(this.rest);
    if (!this.running) void this.follow();
  }

  stop(): void {
    clearTimeout(this.rest);
    this.request = undefined;
  }

  private async follow(): Promise<void> {
    this.running = true;
    while (this.again && this.request) {
      this.again = false;
      busy();
      await this.unlessDropped(this.coarse(this.request));
      idle();
    }
    this.running = false;
    const { request } = this;
    if (request) this.rest = setTimeout(() => void this.unlessDropped(this.fine(request, () => this.request === request)), kRest);
  }

  private async unlessDropped(work: Promise<void>): Promise<void> {
    try {
      await work;
    } catch (error) {
      if (!(error instanceof Dropped) && this.request) this.fail(error as Error);
    }
  }
}
