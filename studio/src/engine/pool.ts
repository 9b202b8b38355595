import type { Answer, Question } from "./library.ts";
import type { FromWorker, ToWorker } from "./worker.ts";

// Workers with an instance of the library each. Values do not depend on tiles, so that any of them may do any part of a picture. Work
// belongs to a topic; new work of a topic drops what of the old one has not begun.

export interface Timed extends Answer {
  milliseconds: number;
}

interface Task {
  question: Question;
  bytes?: Uint8Array<ArrayBuffer>;
  topic: string;
  urgent: boolean;
  progress?: (done: number) => void;
  resolve(answer: Timed): void;
  reject(error: Error): void;
}

// Work that newer work has taken the place of.
export class Dropped extends Error {}

interface Member {
  worker: Worker;
  task: Task | undefined;
}

export class Pool {
  private readonly members: Member[] = [];
  private queue: Task[] = [];
  private next = 0;

  constructor(
    private readonly module: WebAssembly.Module,
    size: number,
  ) {
    for (let i = 0; i < size; ++i) this.members.push(this.hire());
  }

  get size(): number {
    return this.members.length;
  }

  // An answer, or Dropped. `urgent` work goes before other work; `bytes` go to the worker, and are here no more.
  ask(topic: string, question: Question, options: Partial<Pick<Task, "bytes" | "urgent" | "progress">> = {}): Promise<Timed> {
    return new Promise((resolve, reject) => {
      this.queue.push({ urgent: false, ...options, question, topic, resolve, reject });
      this.assign();
    });
  }

  // Drops what of a topic has not begun.
  drop(topic: string): void {
    const stale = this.queue.filter((task) => task.topic === topic);
    this.queue = this.queue.filter((task) => task.topic !== topic);
    for (const task of stale) task.reject(new Dropped("dropped"));
  }

  // Ends what of a topic is under way, too, as there is no way to ask it to stop: its workers are replaced.
  interrupt(topic: string): void {
    this.drop(topic);
    for (const member of this.members) {
      if (member.task?.topic !== topic) continue;
      member.worker.terminate();
      member.task.reject(new Dropped("dropped"));
      Object.assign(member, this.hire());
    }
    this.assign();
  }

  private hire(): Member {
    const worker = new Worker(new URL("worker.js", document.baseURI), { type: "module" });
    const member: Member = { worker, task: undefined };
    worker.postMessage({ module: this.module } satisfies ToWorker);
    return member;
  }

  private assign(): void {
    for (const member of this.members) {
      if (member.task) continue;
      const urgent = this.queue.findIndex((task) => task.urgent);
      const task = this.queue.splice(urgent >= 0 ? urgent : 0, 1)[0];
      if (!task) return;
      member.task = task;
      const { worker } = member;
      worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
        if (member.worker !== worker) return;
        if (data.progress !== undefined) return task.progress?.(data.progress);
        member.task = undefined;
        if (data.answer) task.resolve({ ...data.answer, milliseconds: data.milliseconds });
        else task.reject(new Error(data.error));
        this.assign();
      };
      worker.onerror = (event) => {
        member.task = undefined;
        task.reject(new Error(event.message || "the library stopped"));
        worker.terminate();
        Object.assign(member, this.hire());
        this.assign();
      };
      const { question, bytes } = task;
      worker.postMessage({ id: this.next++, question, ...(bytes ? { bytes } : {}) } satisfies ToWorker, bytes ? [bytes.buffer] : []);
    }
  }
}

export async function loadModule(): Promise<WebAssembly.Module> {
  const response = await fetch(new URL("solidnoise.wasm", document.baseURI));
  if (!response.ok) throw new Error(`solidnoise.wasm: ${response.status} ${response.statusText}`);
  return WebAssembly.compile(await response.arrayBuffer());
}
