// What to start from: the tools' presets and the examples, put in by build.mjs.
export interface Start {
  name: string;
  kind: "preset" | "example" | "surface";
  text: string;
}
declare const STARTS: Start[];
export const starts: Start[] = STARTS;
