// What a page meets in a browser's life: denied or strange storage, other tabs, links, files that are dropped anywhere, shells.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { codeOf, dropFile, kPatience, kSoftwareGl, launchChromium, sharp, startPages, wellOf } from "./pages.mjs";
import { textOf } from "./recipes.mjs";
import { folder, readPng, root, vdbnoise } from "./tools.mjs";

let pages;
before(async () => {
  pages = await startPages(() => launchChromium([...kSoftwareGl, "--host-resolver-rules=MAP studio.test 127.0.0.1"]));
});
after(() => pages.end());
const open = (...args) => pages.open(...args);
const recipeOf = async (page) => JSON.parse(await page.inputValue("textarea"));
const commandsOf = (page) => page.evaluate(async () => {
  const copied = [];
  navigator.clipboard.writeText = async (text) => void copied.push(text);
  for (const button of document.querySelectorAll(".command button")) button.click();
  await new Promise((done) => setTimeout(done, 50));
  return copied;
});
const kTorus = readFileSync(join(root, "studio/../build/studio/torus.obj"));

test("a browser that keeps nothing shows the page", async () => {
  const page = await open("", {}, (own) => own.addInitScript(() => {
    for (const name of ["localStorage", "sessionStorage"]) {
      Object.defineProperty(globalThis, name, { get() { throw new DOMException("denied", "SecurityError"); } });
    }
  }));
  await sharp(page);
  await page.click('[aria-label="Dark or light"]');
  await wellOf(page);
});

test("what was kept in another shape is left out", async () => {
  const good = JSON.stringify({ solidnoise: 2, noise: { type: "gabor", frequency: 7.5 } });
  for (const kept of ["{", '{"noises":5,"mode":"zzz","plane":null,"report":null}', '{"noises":[{"text":"{}"}],"active":7}',
    `{"plane":{"width":-2},"groups":{"a":null},"noises":[{"text":${JSON.stringify(good)},"grid":""}]}`]) {
    const page = await open("", {}, (own) => own.addInitScript((text) => localStorage.setItem("solidnoise-studio", text), kept));
    await sharp(page);
    assert.equal((await recipeOf(page)).noise.frequency, kept.includes("7.5") ? 7.5 : 8, kept);
    await wellOf(page);
  }
});

test("each tab has its own work after a reload", async () => {
  const page = await open(`#recipe=${codeOf(JSON.stringify({ solidnoise: 2, noise: { type: "kensler" } }))}`);
  await page.click("text=Surface");
  await page.waitForSelector("figure.surface");
  await page.selectOption('[aria-label="Mesh"]', "torus.obj");
  await page.click("text=Slice");
  await page.waitForTimeout(400);
  const other = await page.context().newPage();
  await other.goto(`${pages.address}#recipe=${codeOf(JSON.stringify({ solidnoise: 2, noise: { type: "cellular" } }))}`);
  await other.waitForSelector(".app");
  await other.waitForTimeout(400);
  await page.reload();
  await page.waitForSelector(".app");
  assert.equal((await recipeOf(page)).noise.type, "kensler");
  await page.click("text=Surface");
  await page.waitForSelector("figure.surface");
  assert.equal(await page.inputValue('[aria-label="Mesh"]'), "torus.obj");
  await wellOf(page);
});

test("a link changes what it says, and nothing else", async () => {
  const page = await open(`#recipe=${codeOf('{"solidnoise": 2, "surface": {"noise": "kensler"}, "frequency": 3.5}')}`);
  await page.waitForSelector("figure.surface"); // without a view it is that of its kind
  await page.selectOption('[aria-label="Mesh"]', "torus.obj");
  const noise = JSON.stringify({ solidnoise: 2, noise: { type: "gabor", frequency: 6.5 } });
  await page.evaluate((hash) => void (location.hash = hash), `#recipe=${codeOf(noise)}&view=surface&plane=0_0_0_0_0_0_0_1_0_2`);
  await page.waitForSelector("figure.slice");
  await sharp(page);
  assert.equal((await recipeOf(page)).noise.frequency, 6.5);
  await page.click("text=Surface");
  await page.waitForSelector("figure.surface");
  assert.equal((await recipeOf(page)).frequency, 3.5);
  assert.equal(await page.inputValue('[aria-label="Mesh"]'), "torus.obj");
  await wellOf(page);
});

test("a shell takes a command as it was meant, whatever a file is called", async () => {
  const page = await open(`#recipe=${codeOf('{"solidnoise": 2, "surface": {"noise": "kensler"}, "frequency": 3.5}')}`);
  await page.waitForSelector("figure.surface");
  for (const name of ["my mesh $(touch pwned)`id`.obj", "it's ü#1.obj", "-rf.obj"]) {
    await dropFile(page, "figure.surface", name, kTorus);
    await page.waitForFunction((own) => document.querySelector('[aria-label="Mesh"]').value === own, name, kPatience);
    const [command] = await commandsOf(page);
    const words = execFileSync("sh", ["-c", `for word in ${command}; do printf '%s\\0' "$word"; done`], { encoding: "utf8" }).split("\0");
    assert.deepEqual(words.slice(0, 4), ["meshnoise", "bake", name.startsWith("-") ? `./${name}` : name, "--recipe"]);
  }
  await wellOf(page);
});

test("the command makes the slice that is seen", async () => {
  const text = textOf("gabor");
  const page = await open(`#recipe=${codeOf(text)}&view=slice&plane=0.1_0.2_0.3_1_1_2_0_1_0_2`);
  await page.selectOption(".viewbar select", "viridis");
  await sharp(page);
  const own = await page.evaluate(() => {
    const canvas = document.querySelector(".slice canvas");
    return { width: canvas.width, height: canvas.height, bytes: Array.from(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data) };
  });
  const command = (await commandsOf(page)).find((one) => one.startsWith("vdbnoise slice")).split(" ").slice(1);
  const recipe = join(folder, "visit.json");
  const out = join(folder, "visit.png");
  execFileSync("sh", ["-c", `cat > '${recipe}'`], { input: await page.inputValue("textarea") });
  command[command.indexOf("recipe.json")] = recipe;
  command[command.indexOf("slice.png")] = out;
  vdbnoise(...command, "--force", "--quiet");
  const tool = readPng(out);
  assert.deepEqual([tool.width, tool.height], [own.width, own.height]);
  let worst = 0;
  for (let i = 0; i < own.width * own.height; ++i) {
    for (let c = 0; c < 3; ++c) worst = Math.max(worst, Math.abs(own.bytes[4 * i + c] - tool.pixels[tool.channels * i + c]));
  }
  assert.ok(worst <= 2, `${worst} of 255`); // the ramp's 256 colours
  for (const more of [{ domain: { shape: { type: "sphere" } } }, { grids: [{ output: "curl" }] }]) {
    await page.fill("textarea", JSON.stringify({ ...JSON.parse(text), ...more }));
    await page.waitForFunction(() => document.querySelectorAll(".command").length === 2, null, kPatience);
  }
  await wellOf(page);
});

test("files are taken wherever they are dropped, or refused in a line", async () => {
  const page = await open();
  await sharp(page);
  await dropFile(page, ".bar", "fine.json", Buffer.from(JSON.stringify({ solidnoise: 2, noise: { type: "gabor", frequency: 11 } })));
  await page.waitForFunction(() => JSON.parse(document.querySelector("textarea").value).noise.frequency === 11, null, kPatience);
  await dropFile(page, ".view.slice canvas", "cloud.vdb", Buffer.from("x"));
  await page.waitForFunction(() => /cloud\.vdb is no recipe/.test(document.querySelector(".controls .problem")?.textContent ?? ""), null, kPatience);
  await dropFile(page, ".controls", "torus two.obj", kTorus);
  await page.waitForSelector("figure.surface");
  await page.waitForFunction(() => /vertices/.test(document.querySelector("figure.surface figcaption").textContent), null, kPatience);
  assert.equal(await page.inputValue('[aria-label="Mesh"]'), "torus two.obj");
  await dropFile(page, "figure.surface", "bad.ply", Buffer.from("ply\nformat ascii 1.0\n"));
  await page.waitForFunction(() => /bad\.ply/.test(document.querySelector(".failure")?.textContent ?? ""), null, kPatience);
  assert.equal(await page.inputValue('[aria-label="Mesh"]'), "torus two.obj");
  await wellOf(page);
});

test("time plays, is held, and stops for what stands still", async () => {
  for (const [start, figure] of [[textOf("gabor"), "slice"], ['{"solidnoise": 2, "surface": {"noise": "kensler"}, "frequency": 3.5}', "surface"]]) {
    const page = await open(`#recipe=${codeOf(start)}`);
    await page.waitForSelector(`figure.${figure}`);
    await page.click("text=▶ Time");
    await page.waitForSelector("text=❚❚ Time");
    await page.waitForTimeout(300);
    await page.click("text=❚❚ Time");
    await page.click(`[aria-label="Back to the recipe's time"]`);
    await page.click("text=▶ Time");
    await page.waitForSelector("text=❚❚ Time");
    await page.keyboard.press("Control+z"); // of what made it change
    await page.waitForSelector("text=▶ Time");
    await page.waitForTimeout(500);
    assert.equal(await page.locator(".failure, .controls .problem").count(), 0);
    await wellOf(page);
  }
});

test("what is typed and cannot be is left by a button, and is not another noise's", async () => {
  const page = await open(`#recipe=${codeOf(JSON.stringify({ solidnoise: 2, noise: { type: "gabor", seed: 0 } }).replace('"seed":0', '"seed":12345678901234567891'))}`);
  await sharp(page);
  assert.equal(await page.inputValue('[data-path="noise.seed"] input'), "12345678901234567891");
  const text = await page.inputValue("textarea");
  await page.fill("textarea", text.slice(0, 40));
  await page.waitForSelector(".recipe .problem");
  await page.click("text=+ Compare");
  await page.waitForFunction((whole) => document.querySelector("textarea").value === whole, text, kPatience);
  await page.fill("textarea", text.slice(0, 40));
  await page.waitForSelector(".recipe .problem");
  await page.click("text=Back to what is shown");
  await page.waitForFunction((whole) => document.querySelector("textarea").value === whole, text, kPatience);
  const input = page.locator('[data-path="noise.frequency"] input.number');
  const was = await input.inputValue();
  for (const typed of ["1,000", "0x10"]) {
    await input.fill(typed);
    await input.press("Tab");
    await page.waitForFunction((own) => document.querySelector('[data-path="noise.frequency"] input.number').value === own, was, kPatience);
  }
  await wellOf(page);
});

test("a link is copied where there is no clipboard", async () => {
  const page = await open();
  await sharp(page);
  const plain = await page.context().newPage();
  await plain.goto(pages.address.replace("localhost", "studio.test"));
  await plain.waitForSelector(".app");
  await plain.click("text=Copy link");
  await plain.waitForSelector("text=Copied");
  await wellOf(page);
});

test("two fingers zoom", async () => {
  const page = await open("", { viewport: { width: 820, height: 1180 }, hasTouch: true });
  await sharp(page);
  const box = await page.locator(".view.slice canvas").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const session = await page.context().newCDPSession(page);
  const touch = (type, apart) => session.send("Input.dispatchTouchEvent", { type, touchPoints: apart === 0 ? [] : [{ x: x - apart, y, id: 0 }, { x: x + apart, y, id: 1 }] });
  await touch("touchStart", 40);
  for (const apart of [50, 60, 70, 80]) await touch("touchMove", apart);
  await touch("touchEnd", 0);
  await page.waitForTimeout(500);
  const plane = /plane=([^&]*)/.exec(await page.evaluate(() => location.hash))[1].split("_").map(Number);
  assert.ok(Math.abs(plane[9] - 1) < 0.03, `width ${plane[9]}`);
  assert.ok(Math.hypot(...plane.slice(0, 3)) < 0.02);
  await wellOf(page);
});

test("by example: undo of the first takes its pictures back; a fit goes on beside other views", async () => {
  const page = await open("", { viewport: { width: 390, height: 844 } });
  await page.click("text=By example");
  await page.click(".photo[title=sand]");
  await page.click("text=Slice"); // which is in reach on a telephone
  await page.waitForSelector("figure.slice");
  await page.click("text=By example");
  await page.waitForSelector(".report", kPatience);
  const drawn = () => page.evaluate(() => [...document.querySelectorAll(".panels canvas")].some((canvas) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((x) => x > 0)));
  await page.waitForFunction(() => /^Noise · [1-9]/.test([...document.querySelectorAll(".panels figcaption")].at(-1).textContent), null, kPatience);
  assert.ok(await drawn());
  await page.click('[aria-label="Undo"]');
  await page.waitForSelector(".report", { state: "detached" });
  await page.waitForTimeout(300);
  assert.ok(!(await drawn()));
  await wellOf(page);
});
