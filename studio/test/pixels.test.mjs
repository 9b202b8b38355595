// The library in WebAssembly against vdbnoise, pixel by pixel.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { recipes, textOf } from "./recipes.mjs";
import { bakeByTool, loadLibrary, root, sliceByTool } from "./tools.mjs";

const library = await loadLibrary();
const planes = [
  { origin: [0.1, 0, 0.2], normal: [0, 0, 1], up: [0, 1, 0], width: 2, columns: 96, rows: 64 },
  { origin: [0, 0, 0], normal: [1, 2, 3], up: [0, 1, 0], width: 1.5, columns: 64, rows: 64 },
];

function bytesOf(answer) {
  const values = answer.floats[0];
  let { low, high } = answer.json;
  if (low === undefined) {
    low = Math.min(...values);
    high = Math.max(...values);
  }
  return Array.from(values, (value) => Math.min(255, Math.max(0, (255 * (value - low)) / (high - low))));
}

for (const name of Object.keys(recipes)) {
  test(`${name} is what vdbnoise slices`, () => {
    for (const plane of planes) {
      const tool = sliceByTool(textOf(name), plane);
      const { columns, rows } = plane;
      // In two tiles: values do not depend on them.
      const [left, right] = [[0, 40], [40, columns - 40]].map(([first, count]) =>
        library.ask({ do: "slice", recipe: textOf(name), plane, first: [first, 0], count: [count, rows] }));
      const whole = { json: left.json, floats: [Float32Array.from([...left.floats[0], ...right.floats[0]])] };
      const own = bytesOf(whole);
      let worst = 0;
      for (let column = 0; column < columns; ++column) {
        for (let row = 0; row < rows; ++row) {
          worst = Math.max(worst, Math.abs(own[column * rows + row] - tool.pixels[(rows - 1 - row) * columns + column]));
        }
      }
      // A byte is a rounded value: half of one, and what libraries' and processors' last bits make, is allowed.
      assert.ok(worst <= 1, `differs by ${worst} of 255`);
    }
  });
}

test("the closed form of a spectrum is of the values in their range", () => {
  const plane = { ...planes[0], width: 8, columns: 192, rows: 192 };
  const spectrum = (range, more = {}) =>
    library.ask({ do: "spectrum", plane, recipe: JSON.stringify({ solidnoise: 2, noise: { type: "gabor", frequency: 4, ...more }, shaping: { type: "raw", range } }) }).floats;
  const sum = ([, frequencies, ...powers]) => powers.map((kind) => kind.reduce((total, power, i) => total + frequencies[i] * power, 0));
  const [, raw] = sum(spectrum("raw"));
  for (const [range, variance] of [["raw", 1], ["signed", 1 / 9], ["unit", 1 / 36]]) {
    const floats = spectrum(range);
    const [measured, closed] = sum(floats).map((total) => total / raw / variance);
    assert.ok(Math.abs(closed - 1) < 1e-5 && Math.abs(measured - 1) < 0.1, `${range}: ${measured} and ${closed}`);
    const [picture] = floats;
    assert.ok(picture[96 * 192 + 96] < 0.1 * Math.max(...picture), range);
  }
  // The range ends at 1.5 sigma.
  const wide = { octaves: 4, gain: 1, renormalize: false };
  assert.equal(spectrum("raw", wide).length, 4);
  assert.equal(spectrum("unit", wide).length, 3);
});

test("the texture of a model with what is done to it is that of the model it becomes", () => {
  const side = 32;
  const bytes = Buffer.alloc(4 * side * side, 255);
  for (let i = 0; i < side * side; ++i) bytes.set([128 + 80 * Math.sin(0.7 * i) * Math.sin(0.013 * i * i), 100 + 50 * Math.sin(0.37 * i * i), 90], 4 * i);
  const { exemplar } = library.ask({ do: "fit", width: side, height: side, pixel: 1 / side }, bytes).json;
  const edits = [{ edit: "scale", by: 1.3 }, { edit: "magnitude", by: 2 }];
  const texture = (question) => library.ask({ do: "texture", first: 0, width: 16, height: 16, pixel: 1 / 16, ...question }).floats[0];
  const changed = library.ask({ do: "edit example", exemplar, edits }).json.exemplar;
  assert.deepEqual(texture({ exemplar, edits }), texture({ exemplar: changed }));
  assert.notDeepEqual(texture({ exemplar }), texture({ exemplar: changed }));
});

test("bytes that are no text are quoted in an answer", () => {
  const place = library.put(Buffer.from('{"do": "\xff"}\0', "latin1"));
  assert.match(library.textAt(library.exports.ask(place, 0, 0)), /"error":".*\ufffd/);
});

test("a recipe comes out as it went in", () => {
  for (const name of Object.keys(recipes)) {
    const once = library.ask({ do: "check", recipe: textOf(name) }).json.recipe;
    assert.equal(library.ask({ do: "check", recipe: once }).json.recipe, once);
  }
});

test("a seed keeps its digits where another field is edited", () => {
  const text = '{"solidnoise": 2, "noise": {"type": "gabor", "seed": 18446744073709551557}}';
  const edited = library.ask({ do: "edit", recipe: text, edits: [{ path: ["noise", "frequency"], value: "3.25" }] }).json.recipe;
  assert.match(edited, /"seed": 18446744073709551557/);
  assert.match(edited, /"frequency": 3.25/);
});

test("what is wrong is said with its line", () => {
  const text = '{\n  "solidnoise": 2,\n  "noise": {"type": "gabor",\n  "bandwidth": -1}\n}';
  assert.throws(() => library.ask({ do: "check", recipe: text }), /^Error: line 4: noise\.bandwidth is -1/);
  assert.throws(() => library.ask({ do: "check", recipe: "{" }), /line 1/);
  const grid = '{"solidnoise": 2, "frequency_grid": {"file": "paint.vdb"}}';
  assert.throws(() => library.ask({ do: "check", recipe: grid }), /frequency_grid needs a file.*vdbnoise/);
});

test("every preset is known, and has its schema's fields", () => {
  for (const name of ["cumulus", "explosion", "fire", "marble", "nebula", "raw", "smoke", "velocity"]) {
    const text = readFileSync(join(root, "tools/vdbnoise/presets", `${name}.json`), "utf8");
    const { recipe } = library.ask({ do: "check", recipe: text }).json;
    const { properties } = library.ask({ do: "fields" }).json.volume;
    for (const key of Object.keys(JSON.parse(recipe))) assert.ok(key in properties, key);
  }
});

for (const [name, recipe] of Object.entries({
  rust: readFileSync(join(root, "tools/meshnoise/presets/rust.json"), "utf8"),
  solid: '{"solidnoise": 2, "surface": {"noise": "solid"}, "frequency": 4, "ramp": "viridis"}',
  kensler: '{"solidnoise": 2, "surface": {"noise": "kensler", "octaves": 3}, "frequency": 3, "ramp": "marble", "displace": 0.02}',
})) {
  test(`${name} has the colours that meshnoise bakes`, () => {
    const { vertices, colorDifference } = bakeByTool(recipe);
    library.ask({ do: "mesh", name: "torus.obj" }, readFileSync(join(root, "meshes/torus.obj")));
    const { floats } = library.ask({ do: "bake", recipe });
    // Half of one is rounding; the other half is for vertices at a hard edge of a ramp.
    const worst = colorDifference(floats[2]);
    assert.ok(worst <= 1, `colours differ by ${worst} of 255`);
    const farthest = floats[0].reduce((most, x, i) => Math.max(most, Math.abs(x - vertices["xyz"[i % 3]][Math.floor(i / 3)])), 0);
    assert.ok(farthest <= 1e-5, `vertices are ${farthest} apart`);
  });
}
