// The surface view, with meshes of one's own: small, of other formats, broken, large, and too large for the memory there is.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { codeOf, dropFile, kPatience, kSoftwareGl, launchChromium, picture, sharp, startPages, wellOf } from "./pages.mjs";
import { bakeByTool, folder, meshnoise, root } from "./tools.mjs";

let pages;
before(async () => {
  pages = await startPages(() => launchChromium(kSoftwareGl));
});
after(() => pages?.end());

const kQuick = JSON.stringify({ solidnoise: 2, surface: { noise: "kensler" }, frequency: 3, ramp: "marble" });
const surfaces = (prepare) => pages.open(`#recipe=${codeOf(kQuick)}&view=surface`, {}, prepare);
const baked = (page) => page.waitForFunction(() => globalThis.last?.colors, null, { timeout: 180_000 });

// A mesh that is dropped: waits until the view has another picture, or refuses it, and says what is expected.
async function drop(page, name, buffer, expected) {
  const before = await page.evaluate(() => [globalThis.pictured, document.querySelector(".failure")?.textContent]);
  await page.setInputFiles('input[aria-label="A mesh"]', { name, mimeType: "application/octet-stream", buffer });
  await page.waitForFunction(([count, failure, pattern]) => {
    const now = document.querySelector(".failure")?.textContent;
    const says = `${document.querySelector("figure.surface figcaption").textContent} ${now ?? ""}`;
    return (globalThis.pictured > count || now !== failure) && new RegExp(pattern).test(says);
  }, [...before, expected.source], { timeout: 180_000 });
}

// A wavy square of side x side vertices, as a binary .ply.
function square(side) {
  const faces = (side - 1) ** 2;
  const header = Buffer.from(`ply\nformat binary_little_endian 1.0\nelement vertex ${side * side}\nproperty float x\nproperty float y\nproperty float z\nelement face ${faces}\nproperty list uchar int vertex_indices\nend_header\n`);
  const body = Buffer.alloc(12 * side * side + 17 * faces);
  let at = 0;
  for (let i = 0; i < side * side; ++i) {
    const [x, y] = [(2 * (i % side)) / side - 1, (2 * Math.floor(i / side)) / side - 1];
    for (const coordinate of [x, y, 0.1 * Math.sin(5 * x)]) at = body.writeFloatLE(coordinate, at);
  }
  for (let i = 0; i < faces; ++i) {
    const corner = (i % (side - 1)) + Math.floor(i / (side - 1)) * side;
    at = body.writeUInt8(4, at);
    for (const vertex of [corner, corner + 1, corner + side + 1, corner + side]) at = body.writeInt32LE(vertex, at);
  }
  return Buffer.concat([header, body]);
}

test("the surface is shown as it is baked", async () => {
  const page = await pages.open();
  await page.click('[role=tab]:text-is("Surface")');
  await baked(page);
  await page.waitForTimeout(700);
  await picture(page, "surface");
  await wellOf(page);
});

test("a mesh that was dropped is there after a reload", async () => {
  const page = await surfaces();
  await baked(page);
  await drop(page, "tetra.obj", Buffer.from("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"), /^4 vertices/);
  await page.waitForTimeout(600);
  await page.reload();
  await page.waitForFunction(() => /^4 vertices/.test(document.querySelector("figure.surface figcaption")?.textContent ?? ""), null, kPatience);
  await wellOf(page);
});

test("a surface has the colours that meshnoise bakes", async () => {
  const page = await surfaces();
  await baked(page);
  await dropFile(page, "figure.surface", "own.obj", readFileSync(join(root, "meshes/torus.obj")));
  await page.waitForFunction(() => globalThis.last.colors.length === 3 * 2016, null, kPatience);
  const compare = async (recipe) => {
    const worst = bakeByTool(recipe).colorDifference(await page.evaluate(() => Array.from(globalThis.last.colors)));
    assert.ok(worst <= 1, `colours differ by ${worst} of 255`);
  };
  await compare(kQuick);
  const rust = readFileSync(join(root, "tools/meshnoise/presets/rust.json"), "utf8");
  const before = await page.evaluate(() => globalThis.pictured);
  await page.fill("textarea", rust);
  await page.waitForFunction((n) => globalThis.pictured > n, before, kPatience);
  await compare(rust);
  await wellOf(page);
});

test("meshes can be dropped: .obj, .ply and .off, which is the same mesh", async () => {
  const page = await surfaces();
  await baked(page);
  await drop(page, "tetra.obj", Buffer.from("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"), /^4 vertices/);
  const colors = () => page.evaluate(() => Array.from(globalThis.last.colors));
  await drop(page, "torus.obj", readFileSync(join(root, "meshes/torus.obj")), /vertices/);
  const expected = await colors();
  const off = join(folder, "torus.off");
  meshnoise("bake", join(root, "meshes/torus.obj"), "--frequency", "3", "--out", off, "--force", "--quiet");
  await drop(page, "torus.off", readFileSync(off), /vertices/);
  const own = await colors();
  assert.equal(own.length, expected.length);
  // The digits of positions in text: a thousandth of a feature at the most.
  assert.ok(own.every((value, i) => Math.abs(value - expected[i]) < 1e-3));
  await wellOf(page);
});

test("broken meshes and those of other formats are refused in a line", async () => {
  const page = await surfaces();
  await baked(page);
  await drop(page, "broken.ply", Buffer.from("ply\nformat ascii 1.0\n"), /broken\.ply/);
  await drop(page, "broken.off", Buffer.from("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"), /broken\.off:6: face 0: it has vertex 7/);
  await drop(page, "solid.stl", Buffer.from("solid x\n"), /meshnoise reads \.stl/);
  await wellOf(page);
});

test("a mesh of a million vertices is baked and shown", async () => {
  const page = await surfaces();
  await baked(page);
  await drop(page, "million.ply", square(1000), /^1,000,000 vertices/);
  await wellOf(page);
});

test("where memory ends the page says so, and goes on", async () => {
  const page = await surfaces((own) => own.route("**/solidnoise.wasm", (route) => route.fulfill({ contentType: "application/wasm", body: withLittleMemory() })));
  await baked(page);
  await drop(page, "million.ply", square(1000), /not enough memory/);
  await page.selectOption('[aria-label="Mesh"]', "torus.obj");
  await page.waitForSelector(".failure", { state: "detached" });
  await page.click('[role=tab]:text-is("Slice")');
  await sharp(page);
  await wellOf(page);
});

// The library with 64 MB in place of 2 GB: the greatest number of pages in the section of memories, in three bytes as before.
function withLittleMemory() {
  const wasm = readFileSync(join(root, "build/studio/solidnoise.wasm"));
  const most = wasm.indexOf(Buffer.from([0x80, 0x80, 0x02]), wasm.indexOf(Buffer.from([0x01, 0x01, 0x80, 0x04])));
  assert.ok(most > 0);
  Buffer.from([0x80, 0x88, 0x00]).copy(wasm, most);
  return wasm;
}
