// Changes of the page's state while others are under way, with a library that takes its time.
import assert from "node:assert/strict";
import { test } from "node:test";
import { setTimeout as wait } from "node:timers/promises";
import { textOf } from "./recipes.mjs";
import { loadLibrary, loadModule } from "./tools.mjs";

Object.assign(globalThis, {
  addEventListener() {},
  localStorage: { getItem: () => null, setItem() {} },
  location: { href: "", hash: "" },
  history: { replaceState() {} },
});
const library = await loadLibrary();
const { begin, commit, during, edit, redo, setText, state, undo } = await loadModule("store.ts");
const ask = async (_, question) => {
  await wait(20);
  return library.ask(question);
};
await begin({ ask }, textOf("gabor"), '{"solidnoise": 2, "surface": {"noise": "solid"}}');

const change = (part) => commit({ ...state.value, ...part }, Object.keys(part).join());
const setFrequency = (to) => edit([{ path: ["noise", "frequency"], value: String(to) }], "frequency");
const frequencies = () => state.value.noises.map(({ text }) => JSON.parse(text).noise.frequency);

test("an edit is of the noise that was looked at", async () => {
  const { noises: [noise], bake } = state.value;
  change({ noises: [noise, { ...noise }], active: 0 });
  const done = setFrequency(5);
  await wait(5);
  setFrequency(6);
  change({ active: 1 });
  setFrequency(7);
  change({ mode: "surface" });
  await done;
  assert.deepEqual(frequencies(), [6, 7]);
  assert.equal(state.value.bake, bake);
  change({ mode: "slice", active: 0 });
  const taken = setText(textOf("gabor fine"), "typed");
  change({ active: 1 });
  await taken;
  assert.deepEqual(frequencies(), [16, 7]);
});

test("an edit goes with its noise, where that is taken away", async () => {
  const [first, second] = state.value.noises;
  change({ noises: [first, second], active: 1 });
  const done = setFrequency(9);
  await wait(5);
  change({ noises: [first], active: 0 });
  await done;
  assert.deepEqual(frequencies(), [16]);
});

test("edits wait for what else is under way, and undo for all of it", async () => {
  const slow = during(async () => {
    await wait(40);
    change({ ramp: "viridis" });
  });
  during(() => wait(10));
  await setFrequency(3);
  assert.deepEqual([state.value.ramp, ...frequencies()], ["viridis", 3]);
  await slow;
  during(() => wait(10));
  during(async () => {
    await wait(40);
    change({ ramp: "fire" });
  });
  await wait(20);
  await undo();
  assert.equal(state.value.ramp, "viridis");
  await redo();
  assert.equal(state.value.ramp, "fire");
});
