// How quick the page is, in Chromium on this machine: prints tables, and puts them into docs/studio.md with --write.
import { readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { codeOf, kSoftwareGl, launchChromium, sharp, startPages } from "./test/pages.mjs";
import { textOf } from "./test/recipes.mjs";
import { root } from "./test/tools.mjs";

const kPatience = { timeout: 240_000 };
const kSteps = 15;
const pages = await startPages(() => launchChromium(kSoftwareGl));
const median = (numbers) => numbers.toSorted((a, b) => a - b)[Math.floor(numbers.length / 2)];
const seconds = (ms) => (ms < 1000 ? `${ms.toFixed(0)} ms` : `${(ms / 1000).toFixed(1)} s`);
const preset = (name) => readFileSync(join(root, `tools/vdbnoise/presets/${name}.json`), "utf8");
const table = (head, rows) => [head, head.map(() => "---"), ...rows].map((cells) => `| ${cells.join(" | ")} |`).join("\n");
const told = (cells) => {
  console.log(cells.join(" | "));
  return cells;
};

// Pictures after an input: how long after it each was on the screen, and the longest time for which the page answered nothing.
function watch() {
  Object.assign(globalThis, { steps: [], longest: 0 });
  new PerformanceObserver((list) => list.getEntries().forEach(({ duration }) => (globalThis.longest = Math.max(globalThis.longest, duration)))).observe({ type: "longtask" });
  let begin = 0;
  addEventListener("input", ({ timeStamp }) => (begin = timeStamp), true);
  addEventListener("pictured", ({ detail: { side, sharp } }) => {
    const since = begin;
    requestAnimationFrame(() => {
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = () => globalThis.steps.push({ begin: since, ms: performance.now() - since, side, sharp });
      port2.postMessage(0);
    });
  }, true);
}

// A slider is moved a step, again and again, each time after the picture of the last step has come to rest; then it is dragged.
async function slide(page, slider) {
  await page.evaluate(watch);
  await slider.focus();
  for (let i = 0; i < kSteps; ++i) {
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction((n) => new Set(globalThis.steps.filter((step) => step.sharp).map(({ begin }) => begin)).size > n, i, kPatience);
    await page.waitForTimeout(350); // for the spectrum
  }
  const steps = await page.evaluate(() => globalThis.steps);
  const first = steps.filter(({ begin }, i) => begin !== steps[i - 1]?.begin);
  const fine = steps.filter((step) => step.sharp);

  const box = await slider.boundingBox();
  await page.evaluate(() => (globalThis.steps = []));
  await page.mouse.move(box.x + 0.3 * box.width, box.y + 8);
  await page.mouse.down();
  const began = performance.now();
  for (let i = 0; i < 60; ++i) {
    await page.mouse.move(box.x + (0.3 + 0.005 * i) * box.width, box.y + 8);
    await page.waitForTimeout(16);
  }
  const took = performance.now() - began;
  const drawn = await page.evaluate(() => globalThis.steps.length);
  await page.mouse.up();
  const quickest = Math.min(...first.map(({ ms }) => ms));
  return [
    `${median(first.map(({ side }) => side))}`, `${seconds(median(first.map(({ ms }) => ms)))} (${seconds(quickest)})`,
    `${fine[0].side}`, seconds(median(fine.map(({ ms }) => ms))), ((1000 * drawn) / took).toFixed(0), seconds(await page.evaluate(() => globalThis.longest)),
  ];
}

// A browser that has nothing yet, until the first picture is on the canvas.
const others = [];
const cold = [];
for (let i = 0; i < 5; ++i) {
  const page = await pages.open("", {}, (own) => own.addInitScript(() => addEventListener("pictured", () => (globalThis.first ??= performance.now()), true)));
  await page.waitForFunction(() => globalThis.first);
  cold.push(await page.evaluate(() => globalThis.first));
  await page.context().close();
}
others.push(told(["First picture, from a cold start", seconds(median(cold))]));

const sliders = [];
const noises = {
  "Gabor noise, the start": "gabor fine",
  "Gabor noise of 4 octaves": "gabor octaves",
  "oriented Gabor noise": "oriented half",
  "Kensler's noise of 4 octaves": "kensler octaves",
  "cellular noise": "cellular",
  "Gabor noise in 4D": "four dimensions",
  "ridged and warped, 3 octaves": "ridged",
  "two layers": "two layers",
  "preset marble": "marble",
  "preset smoke": "smoke",
  "preset cumulus": "cumulus",
};
for (const [name, recipe] of Object.entries(noises)) {
  const page = await pages.open(`#recipe=${codeOf(["marble", "smoke", "cumulus"].includes(recipe) ? preset(recipe) : textOf(recipe))}&view=slice`);
  await sharp(page);
  sliders.push(told([name, ...(await slide(page, page.locator('[data-path="noise.frequency"] input[type=range]')))]));
  await page.context().close();
}

const page = await pages.open("#recipe=eyJzb2xpZG5vaXNlIjoyfQ&view=example");
await page.setInputFiles('input[aria-label="A photograph"]', join(root, "examples/exemplars/sand.jpg"));
await page.waitForSelector(".workbench", kPatience);
others.push(told(["Fit of a photograph of 256 x 256 pixels", seconds((await page.evaluate(() => globalThis.studioTimes)).fit)]));
await page.waitForTimeout(3000);
sliders.push(told(["by example: scale of a group of sand", ...(await slide(page, page.locator("fieldset input[type=range]").nth(1)))]));
await page.context().close();

for (const name of ["cumulus", "smoke", "raw"]) {
  const page = await pages.open(`#recipe=${codeOf(preset(name))}&view=volume`, {}, (own) => own.addInitScript(watch));
  await page.waitForFunction(() => globalThis.last?.dim === 128, null, kPatience);
  const { times, longest } = await page.evaluate(() => ({ times: globalThis.studioTimes, longest: globalThis.longest }));
  const shown = [32, 64, 128].filter((dim) => times[`volume ${dim}`] !== undefined); // where WebGL is not there yet the first is passed by
  others.push(told([`Volume, ${name}: so many voxels a side; longest block`, `${shown.map((dim) => `${dim}: ${seconds(times[`volume ${dim}`])}`).join(", ")}; ${seconds(longest)}`]));
  await page.context().close();
}
const machine = `${cpus().length} threads of ${cpus()[0].model.replace(/\((R|TM)\)/g, "").replace(/ CPU @.*/, "")}, Chromium ${pages.browser.version().split(".")[0]} without a graphics card`;
await pages.end();

if (process.argv.includes("--write")) {
  const path = join(root, "docs/studio.md");
  const section = `## Speed
On ${machine}; \`scripts/studio.sh bench\` measures it and writes this. A slider moves a step, ${kSteps} times: from the event to
the first picture on the screen, as the median and (the quickest); to the sharp one, with the rest of 90 ms before it; then pictures a second
while it is dragged, and the longest time for which the page answered nothing, of which browsers report 50 ms and more. The goal is a
first picture within 50 ms.

${table(["slider", "first picture, pixels", "on the screen after", "sharp picture, pixels", "after", "pictures a second", "longest block"], sliders)}

${table(["", "took"], others)}

`;
  writeFileSync(path, readFileSync(path, "utf8").replace(/## Speed\n[^]*?(?=## )/, section));
}
