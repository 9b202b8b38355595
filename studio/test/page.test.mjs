// The page as a person uses it, in Chromium.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { recipes, textOf } from "./recipes.mjs";
import { codeOf, dropFile, hashOf, kPatience, kPlane, kSoftwareGl, launchChromium, picture, sharp, sliceDifference, startPages, wellOf } from "./pages.mjs";
import { root, vdbnoise } from "./tools.mjs";

let pages;

before(async () => {
  pages = await startPages(() => launchChromium(kSoftwareGl));
});
after(() => pages?.end());

const open = (hash, options) => pages.open(hash, options);
const recipeOf = async (page) => JSON.parse(await page.inputValue("textarea"));

test("slices are vdbnoise's, pixel by pixel", async () => {
  const [first, ...rest] = Object.keys(recipes);
  assert.ok(rest.length >= 19);
  const page = await open(hashOf(textOf(first)), { viewport: { width: 820, height: 480 } });
  await sharp(page);
  const compare = async (name) => {
    const worst = await sliceDifference(page, textOf(name), kPlane);
    assert.ok(worst <= 1, `${name} differs by ${worst} of 255`);
  };
  await compare(first);
  for (const name of rest) {
    const before = await page.evaluate(() => globalThis.sharp);
    await page.evaluate((hash) => void (location.hash = hash), hashOf(textOf(name)));
    await sharp(page, before);
    await compare(name);
  }
  await wellOf(page);
});

test("a slider changes recipe, address and picture; undo and redo go back and forth; reload keeps it", async () => {
  const page = await open();
  await sharp(page);
  await picture(page, "slice");
  const before = await page.evaluate(() => globalThis.pictured);
  const slider = page.locator('[data-path="noise.frequency"] input[type=range]');
  const box = await slider.boundingBox();
  await page.mouse.move(box.x + box.width * 0.5, box.y + 8);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.3, box.y + 8, { steps: 6 });
  await page.mouse.up();
  await page.waitForFunction((n) => globalThis.pictured > n, before);
  // At once: what the last movements changed may still be under way, and belongs to the same step.
  await page.keyboard.press("Control+z");
  await page.waitForFunction(() => JSON.parse(document.querySelector("textarea").value).noise.frequency === 8);
  await page.keyboard.press("Control+Shift+z");
  await page.waitForFunction(() => JSON.parse(document.querySelector("textarea").value).noise.frequency < 6);
  const { frequency } = (await recipeOf(page)).noise;
  assert.ok(frequency > 1 && frequency < 6, String(frequency));
  await page.waitForTimeout(600);
  await page.reload();
  await page.waitForSelector(".app");
  assert.equal((await recipeOf(page)).noise.frequency, frequency);
  await wellOf(page);
});

test("every control can be reached by keys, has a name of its own, and is in no other", async () => {
  for (const view of ["slice", "volume", "surface", "example"]) {
    const page = await open(`#recipe=${codeOf(textOf("two layers"))}&view=${view}`);
    await page.waitForSelector("canvas");
    // All of what is closed is opened.
    for (const closed = page.locator('.controls [aria-expanded="false"]'); (await closed.count()) > 0; ) await closed.first().click();
    const { nameless, twice, nested } = await page.evaluate(() => {
      const own = (element) => element.getAttribute("aria-label") ?? (element.labels?.[0]?.textContent.trim() || element.textContent.trim());
      const all = [...document.querySelectorAll("button, input, select, textarea, summary, canvas, [tabindex]")].filter((element) => element.checkVisibility());
      const fields = all.filter((element) => element.matches("input, select, textarea, .controls button.icon, .controls .more button")).map((element) => {
        const group = element.closest("fieldset");
        return `${group?.querySelector("legend").textContent ?? ""} ${own(element)}`;
      });
      return {
        nameless: all.filter((element) => !own(element)).map((element) => element.outerHTML),
        twice: fields.filter((name, i) => fields.indexOf(name) !== i),
        nested: all.filter((element) => element.parentElement.closest("button, summary, a, select")).map((element) => element.outerHTML),
      };
    });
    assert.deepEqual({ nameless, twice, nested }, { nameless: [], twice: [], nested: [] }, view);
    const unreached = await page.evaluateHandle(() => new Set([...document.querySelectorAll("button:enabled:not([tabindex='-1']), input, select, textarea, summary, [tabindex='0']")].filter((element) => element.checkVisibility())));
    const most = 2 * (await unreached.evaluate((set) => set.size));
    for (let i = 0; i < most && (await unreached.evaluate((set) => set.size)) > 0; ++i) {
      await page.keyboard.press("Tab");
      await unreached.evaluate((set) => set.delete(document.activeElement));
    }
    assert.deepEqual(await unreached.evaluate((set) => [...set].map((element) => element.outerHTML)), [], view);
    await wellOf(page);
  }
});

test("keys move a slider, which goes back to its default by a button", async () => {
  const page = await open();
  const frequency = () => page.evaluate(() => JSON.parse(document.querySelector("textarea").value).noise.frequency);
  const slider = page.locator('[data-path="noise.bandwidth"] input[type=range]');
  const bandwidth = (least, most) => page.waitForFunction(([from, to]) => {
    const now = JSON.parse(document.querySelector("textarea").value).noise.bandwidth;
    return now >= from && now <= to;
  }, [least, most], kPatience);
  assert.equal(await frequency(), 8);
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await bandwidth(1.001, 4);
  assert.match(await slider.getAttribute("aria-description"), /octaves.*at least 0.05.*default 1/);
  await page.click('[aria-label="Bandwidth back to the default"]');
  await bandwidth(1, 1);
  assert.equal(await page.locator('[aria-label="Bandwidth back to the default"]').count(), 0);
  await wellOf(page);
});

test("arrow keys choose kinds and views", async () => {
  const page = await open();
  await page.locator('[role=radio][aria-checked=true]:text-is("gabor")').focus();
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction(() => JSON.parse(document.querySelector("textarea").value).noise.type === "cellular");
  assert.equal(await page.textContent(":focus"), "cellular");
  // The description was of another noise.
  assert.equal(await page.locator(".description").count(), 0);
  await page.locator('[role=tab][aria-selected=true]').focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForSelector('[role=tabpanel][aria-label="Volume"] figure.volume');
  await wellOf(page);
});

test("numbers are typed with a point or a comma; what is none, or refused, goes back", async () => {
  const page = await open();
  const number = page.locator('[data-path="noise.frequency"] input.number');
  const typed = async (text, shown) => {
    await number.fill(text);
    await number.blur();
    await page.waitForFunction((own) => document.querySelector('[data-path="noise.frequency"] input.number').value === own, shown, kPatience);
  };
  await typed("1,5", "1.5");
  assert.equal((await recipeOf(page)).noise.frequency, 1.5);
  for (const text of ["", "x", "-3"]) await typed(text, "1.5");
  await page.waitForSelector('.controls .problem:has-text("noise.frequency is -3")');
  assert.equal((await recipeOf(page)).noise.frequency, 1.5);
  await wellOf(page);
});

test("a layer without layers of its own has nothing to combine", async () => {
  const page = await open(`#recipe=${codeOf(textOf("two layers"))}&view=slice`);
  await page.waitForSelector('[data-path="grids.0.layers.1.fold"]');
  assert.equal(await page.locator('[data-path$=".combine"]').count(), 0);
  await wellOf(page);
});

test("a plane is moved and turned by mouse and by keys", async () => {
  const page = await open();
  await sharp(page);
  const planeOf = () => page.evaluate(() => location.hash.match(/plane=([^&]*)/)?.[1].split("_").map(Number));
  // Acts until the number of the plane's is on the side of a bound that it should come to.
  const until = async (act, place, sign, bound) => {
    await act();
    await page.waitForFunction(([at, way, most]) => way * (Number(location.hash.match(/plane=([^&]*)/)?.[1].split("_")[at]) - most) > 0, [place, sign, bound], kPatience);
  };
  const box = await page.locator(".slice canvas").first().boundingBox();
  const drag = async (x, y) => {
    await page.mouse.move(box.x + 200, box.y + 200);
    await page.mouse.down();
    await page.mouse.move(box.x + 200 + x, box.y + 200 + y, { steps: 3 });
    await page.mouse.up();
  };
  await until(() => drag(100, 0), 0, -1, -0.1);
  await page.keyboard.down("Alt");
  await until(() => drag(50, 0), 3, -1, -0.1);
  await page.keyboard.up("Alt");
  await page.click("text=Front");
  await page.locator(".slice canvas").first().focus();
  await until(() => page.keyboard.press("Shift+ArrowRight"), 3, -1, 0);
  const width = (await planeOf())[9];
  await until(() => page.keyboard.press("+"), 9, -1, width);
  await wellOf(page);
});

test("a kind of noise keeps what both have", async () => {
  const page = await open(`#recipe=${codeOf('{"solidnoise": 2, "noise": {"type": "gabor", "frequency": 5.5, "seed": 9}}')}`);
  await page.click('[role=radio]:text-is("kensler")');
  await page.waitForFunction(() => JSON.parse(document.querySelector("textarea").value).noise.type === "kensler");
  const { noise } = await recipeOf(page);
  assert.equal(noise.frequency, 5.5);
  assert.equal(noise.seed, 9);
  await wellOf(page);
});

test("typing in the recipe changes the controls; what is wrong is shown at its line", async () => {
  const page = await open();
  await sharp(page);
  const area = page.locator("textarea");
  const text = await area.inputValue();
  await area.fill(text.replace('"bandwidth": 1.0', '"bandwidth": -1'));
  await page.waitForSelector(".recipe .problem");
  assert.match(await page.textContent(".recipe .problem"), /^line 8: noise\.bandwidth is -1/);
  assert.equal(await page.textContent(".gutter .wrong"), "8");
  await picture(page, "error");
  await area.fill(text.replace('"bandwidth": 1.0', '"bandwidth": 2.25'));
  await page.waitForSelector(".recipe .problem", { state: "detached" });
  assert.equal(await page.inputValue('[data-path="noise.bandwidth"] input.number'), "2.25");
  await wellOf(page);
});

test("the link brings the same picture to a new page, and vdbnoise the same recipe", async () => {
  const page = await open(`#recipe=${codeOf(textOf("ridged"))}&plane=0.5_0_0_1_0_0_0_1_0_1.5&view=slice`, { permissions: ["clipboard-read", "clipboard-write"] });
  await sharp(page);
  const text = await page.inputValue("textarea");
  await page.click("text=Copy link");
  await page.waitForSelector("text=Copied");
  const link = await page.evaluate(() => navigator.clipboard.readText());
  const other = await open(link.slice(pages.address.length));
  assert.equal(await other.inputValue("textarea"), text);
  const described = vdbnoise("--describe", "--recipe", link, "--quiet");
  assert.equal(JSON.parse(described).recipe?.noise?.frequency ?? JSON.parse(described).noise?.frequency ?? 3, 3);
  await wellOf(other);
  await wellOf(page);
});

test("a link of a surface is taken by a page that is open, and undone", async () => {
  const page = await open();
  await sharp(page);
  const surface = '{"solidnoise": 2, "surface": {"noise": "kensler"}, "frequency": 3.5}';
  await page.evaluate((hash) => void (location.hash = hash), `#recipe=${codeOf(surface)}&view=surface`);
  await page.waitForSelector("figure.surface");
  assert.equal((await recipeOf(page)).frequency, 3.5);
  await page.keyboard.press("Control+z");
  await page.waitForSelector("figure.slice");
  await wellOf(page);
});

test("a link with a fault, or cut off, stays, and its text is there to mend", async () => {
  const text = JSON.stringify({ solidnoise: 2, noise: { type: "gabor", frequency: 5, bandwith: 2 } });
  const faulty = await open(`#recipe=${codeOf(text)}&view=slice`);
  await faulty.waitForTimeout(600);
  assert.ok((await faulty.evaluate(() => location.hash)).includes(codeOf(text)));
  assert.match(await faulty.textContent(".recipe .problem"), /bandwith is unknown/);
  const area = faulty.locator("textarea");
  await area.fill((await area.inputValue()).replace("bandwith", "bandwidth"));
  await faulty.waitForSelector(".recipe .problem", { state: "detached" });
  assert.equal(await faulty.inputValue('[data-path="noise.bandwidth"] input.number'), "2");
  const cut = await open(`#recipe=${codeOf(text).slice(0, 41)}`);
  await cut.waitForTimeout(600);
  assert.equal(await cut.inputValue("textarea"), text.slice(0, 30));
  assert.ok((await cut.evaluate(() => location.hash)).endsWith(codeOf(text).slice(0, 41)));
  await wellOf(faulty);
  await wellOf(cut);
});

test("three noises stand side by side", async () => {
  const page = await open();
  await page.click("text=+ Compare");
  await page.click("text=+ Compare");
  await page.click('[role=radio]:text-is("kensler")');
  await page.waitForFunction(() => document.querySelectorAll('figcaption [data-sharp="true"]').length === 3, null, kPatience);
  assert.equal(await page.locator(".pane canvas").count(), 3);
  await picture(page, "compare");
  await wellOf(page);
});

test("the gallery starts from every preset that needs no file", async () => {
  const page = await open();
  await page.click("text=Gallery");
  await page.waitForTimeout(500);
  await page.click('.start:has-text("Perlin"), .start:has-text("marble") >> nth=0');
  await page.waitForFunction(() => /Marble/.test(document.querySelector(".description")?.textContent ?? ""));
  await wellOf(page);
});

test("a volume is marched through", async () => {
  const page = await open("", {});
  await page.click("text=Gallery");
  await page.click('.start:has-text("cumulus") >> nth=0');
  await page.click('[role=tab]:text-is("Volume")');
  await page.waitForFunction(() => globalThis.last?.dim === 128, null, kPatience);
  await page.waitForTimeout(1500);
  await picture(page, "volume");
  // A cloud on a sky: not of one colour.
  const colors = await page.evaluate(async () => new Set((await globalThis.shown(".volume canvas")).data.filter((_, i) => i % 4 === 0)).size);
  assert.ok(colors > 60, `${colors} greys`);
  await wellOf(page);
});

test("a volume is lit alike with either axis up, and so is its sky", async () => {
  const [y, z] = await Promise.all(["y", "z"].map(async (up) => {
    // Of one density everywhere, so that it looks the same but for what rounding to voxels makes.
    const recipe = { solidnoise: 2, up, noise: { type: "gabor" }, shaping: { type: "remap", threshold: -10 }, domain: { shape: { type: "sphere" } } };
    const page = await open(`#recipe=${codeOf(JSON.stringify(recipe))}&view=volume`, { viewport: { width: 820, height: 480 } });
    await page.waitForFunction(() => globalThis.last?.dim === 128, null, kPatience);
    await page.waitForTimeout(1500);
    const bytes = await page.evaluate(async () => Array.from((await globalThis.shown(".volume canvas")).data));
    await wellOf(page);
    return bytes;
  }));
  const mean = y.reduce((sum, byte, i) => sum + Math.abs(byte - z[i]), 0) / y.length;
  assert.ok(y.length === z.length && mean < 3, `differs by ${mean} of 255`);
});

test("a fire glows before black", async () => {
  const page = await open(`#recipe=${codeOf(readFileSync(join(root, "tools/vdbnoise/presets/fire.json"), "utf8"))}&view=volume`);
  await page.waitForFunction(() => globalThis.last?.dim === 128, null, kPatience);
  await page.waitForTimeout(1500);
  await picture(page, "fire");
  const { corner, hot } = await page.evaluate(async () => {
    const pixels = (await globalThis.shown(".volume canvas")).data;
    let hot = 0;
    for (let i = 0; i < pixels.length; i += 4) if (pixels[i] > 180 && pixels[i] > 1.3 * pixels[i + 2]) ++hot;
    return { corner: Array.from(pixels.slice(0, 3)), hot: hot / (pixels.length / 4) };
  });
  assert.ok(Math.max(...corner) < 8 && hot > 0.01 && hot < 0.5, `${corner} at the corner, ${hot} glows`);
  await wellOf(page);
});

test("smoke is grey before an overcast sky", async () => {
  const page = await open(`#recipe=${codeOf(readFileSync(join(root, "tools/vdbnoise/presets/smoke.json"), "utf8"))}&view=volume`);
  await page.waitForFunction(() => globalThis.last?.dim === 128, null, kPatience);
  await page.waitForTimeout(1500);
  await picture(page, "smoke");
  const { corner, dark, colored } = await page.evaluate(async () => {
    const pixels = (await globalThis.shown(".volume canvas")).data;
    let [dark, colored] = [0, 0];
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i] < 0.7 * pixels[0]) ++dark;
      if (Math.abs(pixels[i] - pixels[i + 2]) > 24) ++colored;
    }
    return { corner: Array.from(pixels.slice(0, 3)), dark: dark / (pixels.length / 4), colored };
  });
  assert.ok(Math.min(...corner) > 150 && dark > 0.05 && dark < 0.6 && colored === 0, `${corner} at the corner, ${dark} dark, ${colored} in colour`);
  await wellOf(page);
});

test("a body of marble has dark veins", async () => {
  const page = await open();
  await page.click("text=Gallery");
  await page.click('.start:has-text("marble") >> nth=0');
  await page.click('[role=tab]:text-is("Volume")');
  await page.waitForFunction(() => globalThis.last?.dim === 128, null, kPatience);
  await page.waitForTimeout(1000);
  const greys = await page.evaluate(async () => {
    const { data, width, height } = await globalThis.shown(".volume canvas");
    const isNear = (i) => Math.abs((i % width) - width / 2) < 100 && Math.abs(Math.floor(i / width) - height / 2) < 100;
    return Array.from(data.filter((_, i) => i % 4 === 0).filter((_, i) => isNear(i))).sort((a, b) => a - b);
  });
  const median = greys[greys.length >> 1];
  assert.ok(median > 150 && greys[0] < 0.6 * median, `${greys[0]} to ${median}`);
  await wellOf(page);
});

test("a photograph becomes a noise, whose spectrum is changed by hand", async () => {
  const page = await open();
  await page.click('[role=tab]:text-is("By example")');
  await page.selectOption("label:has-text('Side') select", "128");
  await dropFile(page, ".byexample", "sand.jpg", readFileSync(join(root, "examples/exemplars/sand.jpg")));
  await page.waitForSelector(".workbench", { timeout: 240_000 });
  await page.waitForTimeout(1500);
  await picture(page, "example");
  const count = await page.locator(".spectrum-editor ellipse").count();
  assert.ok(count > 10, `${count} ellipses`);
  // The uppermost where the strongest is, by the mouse; undo brings it back.
  const strongest = page.locator(".spectrum-editor ellipse[tabindex='0']");
  const box = await strongest.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  const before = await page.locator(".spectrum-editor .chosen").first().getAttribute("aria-label");
  await page.mouse.move(x + 40, y - 60, { steps: 20 });
  await page.mouse.up();
  await page.waitForFunction((label) => document.querySelector(".spectrum-editor .chosen").getAttribute("aria-label") !== label, before, kPatience);
  await page.keyboard.press("Control+z");
  await page.waitForFunction((label) => document.querySelector(".spectrum-editor .chosen").getAttribute("aria-label") === label, before, kPatience);
  await strongest.focus();
  await page.keyboard.press("PageDown");
  assert.equal(await page.evaluate(() => document.activeElement.tagName), "ellipse");
  // The wheel makes it wider, by a step, and it stays chosen.
  const width = () => page.locator(".spectrum-editor .chosen").first().getAttribute("rx").then(Number);
  const narrow = await width();
  await strongest.dispatchEvent("wheel", { deltaY: -100 });
  await page.waitForFunction((rx) => document.querySelector(".spectrum-editor .chosen").getAttribute("rx") > 1.1 * rx, narrow, kPatience);
  await page.click(".spectrum-editor >> text=+ Add");
  await page.waitForFunction((n) => document.querySelectorAll(".spectrum-editor ellipse").length > n || n >= 800, count, kPatience);
  await page.click(".spectrum-editor >> text=Remove");
  await page.waitForFunction((n) => document.querySelectorAll(".spectrum-editor ellipse").length === n, count, kPatience);
  await strongest.focus();
  await page.keyboard.press("Delete");
  await page.waitForFunction((n) => document.querySelectorAll(".spectrum-editor ellipse").length < n || n >= 800, count, kPatience);
  const pictured = await page.evaluate(() => globalThis.pictured);
  const slider = page.locator("fieldset input[type=range]").first();
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction((n) => globalThis.pictured > n, pictured, kPatience);
  const strength = await slider.inputValue();
  // The link has the spectrum and what was done to it; a reload keeps the photograph, too.
  await page.waitForTimeout(600);
  const other = await open((await page.evaluate(() => location.href)).slice(pages.address.length));
  for (const own of [other, page]) {
    if (own === page) await page.reload();
    await own.waitForSelector(".workbench");
    assert.equal(await own.locator("fieldset input[type=range]").first().inputValue(), strength);
  }
  await page.waitForFunction(() => {
    const canvas = document.querySelector('canvas[aria-label="Exemplar"]');
    return new Set(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data).size > 20;
  }, null, kPatience);
  await wellOf(other);
  await wellOf(page);
});

test("a photograph of forty megapixels is made smaller on its way", async () => {
  const page = await open();
  await page.click('[role=tab]:text-is("By example")');
  await page.selectOption("label:has-text('Side') select", "128");
  await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(8000, 5000);
    const context = canvas.getContext("2d");
    for (let i = 0; i < 4000; ++i) {
      context.fillStyle = `hsl(${(i * 47) % 60} 40% ${20 + ((i * 31) % 60)}%)`;
      context.fillRect((i * 7919) % 8000, (i * 104729) % 5000, 400, 120);
    }
    const blob = await canvas.convertToBlob({ type: "image/jpeg" });
    const files = new DataTransfer();
    files.items.add(new File([blob], "large.jpg", { type: "image/jpeg" }));
    const input = document.querySelector('input[aria-label="A photograph"]');
    input.files = files.files;
    input.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await page.waitForSelector(".workbench", { timeout: 240_000 });
  assert.match(await page.textContent(".report"), /^128 x 80 pixels/);
  await wellOf(page);
});

test("a file that is no photograph is refused in a line", async () => {
  const page = await open();
  await page.click('[role=tab]:text-is("By example")');
  await page.setInputFiles('input[aria-label="A photograph"]', { name: "notes.txt", mimeType: "image/png", buffer: Buffer.from("no picture") });
  await page.waitForSelector(".byexample .problem");
  assert.match(await page.textContent(".byexample .problem"), /notes\.txt is not a picture/);
  await wellOf(page);
});

// Waits until a canvas shows pixels that were there before, or others.
const isShown = (page, canvas, pixels, expected) =>
  page.waitForFunction(async ([own, before, same]) => (String((await globalThis.shown(own)).data) === before) === same, [canvas, pixels, expected], kPatience);

test("scenes are drawn beside the page: by keys, in their size, and again when a context was lost", async () => {
  const surface = JSON.stringify({ solidnoise: 2, surface: { noise: "kensler" }, frequency: 3, ramp: "marble" });
  for (const [view, text] of [["volume", textOf("kensler")], ["surface", surface]]) {
    const page = await pages.open(`#recipe=${codeOf(text)}&view=${view}`, { viewport: { width: 900, height: 480 } }, async (own) => {
      await own.addInitScript(() => {
        globalThis.contexts = new Set();
        for (const { prototype } of [HTMLCanvasElement, OffscreenCanvas]) {
          const { getContext } = prototype;
          prototype.getContext = function (kind, ...rest) {
            globalThis.contexts.add(kind);
            return getContext.call(this, kind, ...rest);
          };
        }
      });
      await own.route("**/scene.js", async (route) => {
        const keep = "const { getContext } = OffscreenCanvas.prototype; OffscreenCanvas.prototype.getContext = function (kind) { return (self.kept = getContext.call(this, kind)); };";
        await route.fulfill({ contentType: "text/javascript", body: keep + readFileSync(join(root, "build/studio/scene.js"), "utf8") });
      });
    });
    const canvas = `.${view} canvas`;
    const settled = async () => {
      await page.waitForTimeout(1500);
      return page.evaluate(async (own) => String((await globalThis.shown(own)).data), canvas);
    };
    await page.waitForFunction(() => globalThis.last?.dim === 128 || globalThis.last?.colors, null, kPatience);
    const first = await settled();
    await page.focus(canvas);
    await page.keyboard.press("ArrowRight");
    await isShown(page, canvas, first, false);
    const turned = await settled();
    const scene = page.workers().find((worker) => worker.url().endsWith("scene.js"));
    await scene.evaluate(() => void (self.loss = self.kept.getExtension("WEBGL_lose_context")).loseContext());
    await page.waitForTimeout(300);
    await scene.evaluate(() => self.loss.restoreContext());
    await page.keyboard.press("ArrowRight");
    await isShown(page, canvas, turned, false);
    await page.keyboard.press("ArrowLeft");
    await isShown(page, canvas, turned, true);
    await page.setViewportSize({ width: 900, height: 600 });
    await page.waitForFunction(async (own) => {
      const { width, height } = await globalThis.shown(own);
      const { clientWidth, clientHeight } = document.querySelector(own);
      return Math.abs(width / height - clientWidth / clientHeight) < 0.01;
    }, canvas, kPatience);
    assert.deepEqual(await page.evaluate(() => [...globalThis.contexts].filter((kind) => kind.startsWith("webgl"))), []);
    await wellOf(page);
  }
});

test("volumes and surfaces are gone between in haste", async () => {
  const page = await open("", { viewport: { width: 900, height: 480 } });
  const show = (view) => page.click(`[role=tab]:text-is("${view}")`);
  for (let i = 0; i < 8; ++i) await show(i % 2 === 0 ? "Volume" : "Surface");
  await page.waitForFunction(() => globalThis.last?.colors, null, kPatience);
  assert.equal(await page.locator(".failure").count(), 0);
  await wellOf(page);
});

test("without WebGL slices work, and volumes say why they do not", async () => {
  const bare = await launchChromium(["--disable-gpu", "--disable-software-rasterizer"]);
  const page = await bare.newPage();
  await page.goto(pages.address);
  await page.waitForFunction(() => document.querySelector('figcaption [data-sharp="true"]'), null, kPatience);
  await page.click('[role=tab]:text-is("Volume")');
  await page.waitForSelector(".failure");
  assert.match(await page.textContent(".failure"), /no WebGL 2.*Slices/);
  await bare.close();
});

test("the recipe has its place beside the picture on a tablet", async () => {
  const page = await open("", { viewport: { width: 1024, height: 768 } });
  await page.click('text="Recipe"');
  await page.waitForFunction(() => {
    const [picture, panel] = [".slice canvas", ".recipe"].map((own) => document.querySelector(own)?.getBoundingClientRect());
    return picture?.width > 0 && panel?.width > 0 && picture.right <= panel.left;
  }, null, kPatience);
  await wellOf(page);
});

test("it fits a tablet, in the light", async () => {
  const page = await open("", { viewport: { width: 820, height: 1100 }, colorScheme: "light" });
  await sharp(page);
  await picture(page, "tablet");
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(width <= 820, `is ${width} wide`);
  await wellOf(page);
});

test("a visitor downloads 600 KB at most, gzipped", async () => {
  const { gzipped } = JSON.parse(readFileSync(join(root, "build/studio/size.json"), "utf8"));
  assert.ok(gzipped <= 600 * 1024, `${(gzipped / 1024).toFixed(1)} KB`);
  // All of what is asked for up to the first picture has been counted.
  const page = await pages.open("", {}, (own) => {
    own.asked = new Set();
    own.on("request", (request) => own.asked.add(request.url().slice(pages.address.length)));
  });
  await sharp(page);
  for (const name of page.asked) assert.ok(["", "studio.js", "studio.css", "worker.js", "solidnoise.wasm"].includes(name), name);
  await wellOf(page);
});
