// How quick the page is, in Chromium on this machine: prints a table, and puts it into docs/studio.md with --write.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { codeOf, kSoftwareGl, launchChromium, sharp, startPages } from "./test/pages.mjs";
import { root } from "./test/tools.mjs";

const kPatience = { timeout: 240_000 };
const pages = await startPages(() => launchChromium(kSoftwareGl));
const median = (numbers) => numbers.toSorted((a, b) => a - b)[Math.floor(numbers.length / 2)];
const seconds = (ms) => (ms < 1000 ? `${ms.toFixed(0)} ms` : `${(ms / 1000).toFixed(1)} s`);
const preset = (name) => readFileSync(join(root, `tools/vdbnoise/presets/${name}.json`), "utf8");
const rows = [];
const row = (what, ms, goal = "") => {
  rows.push([what, ms, goal]);
  console.log(`${what.padEnd(64)} ${ms.padStart(24)}`);
};

// A browser that has nothing yet, until the first picture is on the canvas.
const cold = [];
for (let i = 0; i < 5; ++i) {
  const page = await pages.open("", {}, (own) => own.addInitScript(() => addEventListener("pictured", () => (globalThis.first ??= performance.now()), true)));
  await page.waitForFunction(() => globalThis.first);
  cold.push(await page.evaluate(() => globalThis.first));
  await page.context().close();
}
row("First picture, from a cold start", seconds(median(cold)));

// From a step of the slider to the draft that follows it, and to the sharp picture of all pixels; how long the page answers nothing.
const presets = readdirSync(join(root, "tools/vdbnoise/presets")).filter((name) => name !== "raw.json").map((name) => name.replace(".json", ""));
const noises = {
  "Gabor noise": { noise: { type: "gabor", frequency: 8 } },
  "oriented Gabor noise": { noise: { type: "gabor-oriented", frequency: 8, anisotropy: 0.5 } },
  "Kensler's noise of 4 octaves": { noise: { type: "kensler", frequency: 3, octaves: 4 } },
  "Gabor noise of 4 octaves, ridged": { noise: { type: "gabor", frequency: 3, octaves: 4 }, layers: [{ fold: "ridged" }] },
  ...Object.fromEntries(presets.map((name) => [`preset ${name}`, name])),
};
let longest = 0;
for (const [name, recipe] of Object.entries(noises)) {
  const text = typeof recipe === "string" ? preset(recipe) : JSON.stringify({ solidnoise: 2, shaping: { type: "raw" }, ...recipe });
  const page = await pages.open(`#recipe=${codeOf(text)}&view=slice`);
  await sharp(page);
  await page.locator('[data-path="noise.frequency"] input[type=range]').focus();
  await page.evaluate(() => {
    globalThis.steps = [];
    globalThis.longest = 0;
    new PerformanceObserver((list) => list.getEntries().forEach(({ duration }) => (globalThis.longest = Math.max(globalThis.longest, duration)))).observe({ type: "longtask" });
    let begin = 0;
    addEventListener("input", () => (begin = performance.now()), true);
    addEventListener("pictured", ({ detail: { picture, sharp } }) => globalThis.steps.push({ ms: performance.now() - begin, begin, side: Math.max(picture.columns, picture.rows), sharp }), true);
  });
  for (let i = 0; i < 15; ++i) {
    const before = await page.evaluate(() => globalThis.sharp);
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction((n) => globalThis.sharp > n, before);
    await page.waitForTimeout(250); // for the spectrum
  }
  const steps = await page.evaluate(() => globalThis.steps);
  const first = steps.filter(({ begin }, i) => begin !== steps[i - 1]?.begin);
  const fine = steps.filter((step) => step.sharp);
  row(`Slider to slice of ${median(first.map(({ side }) => side))} pixels, ${name}`, seconds(median(first.map(({ ms }) => ms))), "50 ms");
  row(`… to the sharp one of ${fine[0].side} pixels, with the rest before it`, seconds(median(fine.map(({ ms }) => ms))));
  if (typeof recipe === "string") {
    longest = Math.max(longest, await page.evaluate(() => globalThis.longest));
    await page.context().close();
    continue;
  }
  // Dragged: how often there is a picture, and how late the latest of them is.
  const box = await page.locator('[data-path="noise.frequency"] input[type=range]').boundingBox();
  await page.evaluate(() => (globalThis.steps = []));
  await page.mouse.move(box.x + 0.3 * box.width, box.y + 8);
  await page.mouse.down();
  const began = performance.now();
  for (let i = 0; i < 60; ++i) await page.mouse.move(box.x + (0.3 + 0.005 * i) * box.width, box.y + 8);
  const took = performance.now() - began;
  const drawn = await page.evaluate(() => globalThis.steps.length);
  await page.mouse.up();
  row("… pictures a second while it is dragged", ((1000 * drawn) / took).toFixed(0));
  longest = Math.max(longest, await page.evaluate(() => globalThis.longest));
  await page.context().close();
}
row("Longest time for which the page answered nothing meanwhile", longest > 0 ? seconds(longest) : "less than 50 ms", "50 ms");

for (const name of ["cumulus", "raw"]) {
  const page = await pages.open(`#recipe=${codeOf(preset(name))}&view=volume`);
  await page.waitForFunction(() => globalThis.last?.dim === 128, null, kPatience);
  row(`Volume of 128 voxels, ${name}`, seconds((await page.evaluate(() => globalThis.studioTimes))["volume 128"]));
  await page.context().close();
}

const page = await pages.open("#recipe=eyJzb2xpZG5vaXNlIjoyfQ&view=example");
await page.setInputFiles('input[aria-label="A photograph"]', join(root, "examples/exemplars/sand.jpg"));
await page.waitForSelector(".workbench", kPatience);
row("Fit of a photograph of 256 x 256 pixels", seconds((await page.evaluate(() => globalThis.studioTimes)).fit));
const machine = `${cpus().length} threads of ${cpus()[0].model.replace(/\((R|TM)\)/g, "").replace(/ CPU @.*/, "")}, Chromium ${pages.browser.version().split(".")[0]} without a graphics card`;
await pages.end();

if (process.argv.includes("--write")) {
  const path = join(root, "docs/studio.md");
  const table = ["| | took | goal |", "|---|---|---|", ...rows.map((cells) => `| ${cells.join(" | ")} |`)].join("\n");
  const text = readFileSync(path, "utf8");
  const section = `## Speed\nOn ${machine}; \`scripts/studio.sh bench\` measures it and writes this.\n\n${table}\n\n`;
  writeFileSync(path, text.replace(/## Speed\n[^]*?(?=## )/, section));
}
