// The library in WebAssembly: one instance, which answers one question after the other (studio/wasm/binding.cpp).

export interface Answer {
  json: Record<string, unknown>;
  floats: Float32Array<ArrayBuffer>[];
}

export type Question = { do: string } & Record<string, unknown>;

interface Exports {
  memory: WebAssembly.Memory;
  reserve(bytes: number): number;
  release(memory: number): void;
  ask(question: number, bytes: number, count: number): number;
  array_values(index: number): number;
  array_size(index: number): number;
  _initialize(): void;
}

// The library can answer nothing more: it has no memory left, or a fault stopped it. Another instance can.
export class Broken extends Error {}

const kNoMemory = "there is not enough memory in the browser for this; make it smaller, or let the tools do it";
const kBadFile = 8;
const kNoCall = 52;

// What the C library asks of a system. There are no files: whatever opens or reads one is told that there is none.
function system(memory: () => WebAssembly.Memory, progress: (done: number) => void): WebAssembly.ModuleImports {
  const view = () => new DataView(memory().buffer);
  const known: Record<string, (...numbers: number[]) => number> = {
    fd_write: (_file, _vectors, _count, written) => {
      view().setUint32(written ?? 0, 0, true);
      return kBadFile;
    },
    clock_time_get: (_clock, ...rest) => {
      view().setBigUint64(rest[rest.length - 1] ?? 0, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    environ_sizes_get: (count, size) => {
      view().setUint32(count ?? 0, 0, true);
      view().setUint32(size ?? 0, 0, true);
      return 0;
    },
    environ_get: () => 0,
    progress: (done) => {
      progress(done ?? 0);
      return 0;
    },
    emscripten_notify_memory_growth: () => 0,
    proc_exit: (status) => {
      throw new Error(`the library ended with status ${status}`);
    },
  };
  return new Proxy(known as WebAssembly.ModuleImports, {
    get: (target, name: string) => target[name] ?? (() => kNoCall),
    has: () => true,
  });
}

export class Library {
  private constructor(private readonly exports: Exports) {}

  // `progress` is told how far a long answer is, 0 to 1.
  static async load(module: WebAssembly.Module, progress: (done: number) => void = () => undefined): Promise<Library> {
    let exports: Exports | undefined;
    const imports = system(() => exports!.memory, progress);
    // Every import is a function: the proxy has one of any name.
    const instance = await WebAssembly.instantiate(module, { env: imports, wasi_snapshot_preview1: imports });
    exports = instance.exports as unknown as Exports;
    exports._initialize();
    return new Library(exports);
  }

  // Throws an Error that says what is wrong with the question.
  ask(question: Question, bytes?: Uint8Array): Answer {
    const { exports } = this;
    const text = new TextEncoder().encode(JSON.stringify(question) + "\0");
    const place = this.put(text);
    const bytesPlace = bytes?.length ? this.put(bytes) : 0;
    let answer: Answer;
    try {
      const json = JSON.parse(this.textAt(exports.ask(place, bytesPlace, bytes?.length ?? 0))) as Record<string, unknown>;
      answer = { json, floats: Array.from({ length: Number(json.arrays) }, (_, i) => this.arrayAt(i)) };
    } catch (error) {
      throw new Broken(error instanceof WebAssembly.RuntimeError ? `the library stopped: ${error.message}` : kNoMemory);
    }
    exports.release(place);
    if (bytesPlace) exports.release(bytesPlace);
    if (answer.json.memory) throw new Broken(kNoMemory);
    if (typeof answer.json.error === "string") throw new Error(answer.json.error);
    return answer;
  }

  private arrayAt(index: number): Float32Array<ArrayBuffer> {
    const place = this.exports.array_values(index);
    return new Float32Array(this.exports.memory.buffer.slice(place, place + 4 * this.exports.array_size(index)) as ArrayBuffer);
  }

  private put(bytes: Uint8Array): number {
    const place = this.exports.reserve(bytes.length);
    if (place === 0) throw new Broken(kNoMemory);
    new Uint8Array(this.exports.memory.buffer).set(bytes, place);
    return place;
  }

  private textAt(place: number): string {
    const memory = new Uint8Array(this.exports.memory.buffer);
    return new TextDecoder().decode(memory.subarray(place, memory.indexOf(0, place)));
  }
}
