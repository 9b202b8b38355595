import { type Answer, Broken, Library, type Question } from "./library.ts";

// One instance of the library. Messages: the compiled module first, then questions, each of which is answered.

export interface ToWorker {
  module?: WebAssembly.Module;
  id?: number;
  question?: Question;
  bytes?: Uint8Array<ArrayBuffer>;
}
export interface FromWorker {
  id: number;
  answer?: Answer;
  error?: string;
  progress?: number; // 0 to 1, of a question that is not answered yet
  milliseconds: number;
}

let module: WebAssembly.Module;
let library: Promise<Library>;
let now = -1; // the question's id

const load = (): void => {
  library = Library.load(module, (progress) => self.postMessage({ id: now, progress, milliseconds: 0 } satisfies FromWorker));
};

self.onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  if (data.module) {
    module = data.module;
    return load();
  }
  if (data.id === undefined || !data.question) return;
  const begin = performance.now();
  const reply = (rest: Partial<FromWorker>, transfer: Transferable[] = []) =>
    self.postMessage({ id: data.id, milliseconds: performance.now() - begin, ...rest }, { transfer });
  try {
    now = data.id;
    const answer = (await library).ask(data.question, data.bytes);
    reply({ answer }, answer.floats.map((array) => array.buffer));
  } catch (error) {
    if (error instanceof Broken) load();
    reply({ error: error instanceof Error ? error.message : String(error) });
  }
};
