// The page in Firefox: what differs between browsers is there, and right.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { firefox } from "playwright-core";
import { codeOf, hashOf, kPatience, kPlane, picture, sliceDifference, sharp, startPages, wellOf } from "./pages.mjs";
import { textOf } from "./recipes.mjs";

let pages;
before(async () => {
  pages = await startPages(() => firefox.launch({ channel: "moz-firefox", executablePath: process.env.STUDIO_FIREFOX ?? "/usr/bin/firefox-esr" }));
});
after(() => pages?.end());

test("Firefox shows vdbnoise's slices", async () => {
  for (const name of ["gabor", "two layers"]) {
    const page = await pages.open(hashOf(textOf(name)));
    await sharp(page);
    const worst = await sliceDifference(page, textOf(name), kPlane);
    assert.ok(worst <= 1, `${name} differs by ${worst} of 255`);
    await wellOf(page);
  }
});

test("Firefox has sliders that answer, and undo", async () => {
  const page = await pages.open();
  await sharp(page);
  await picture(page, "firefox");
  const frequency = (low, high) => page.waitForFunction(([a, b]) => {
    const { noise } = JSON.parse(document.querySelector("textarea").value);
    return noise.frequency >= a && noise.frequency <= b;
  }, [low, high], kPatience);
  const before = await page.evaluate(() => globalThis.pictured);
  const box = await page.locator('[data-path="noise.frequency"] input[type=range]').boundingBox();
  await page.mouse.move(box.x + box.width * 0.5, box.y + 8);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.3, box.y + 8, { steps: 6 });
  await page.mouse.up();
  await page.waitForFunction((n) => globalThis.pictured > n, before);
  await frequency(1, 7);
  await page.keyboard.press("Control+z");
  await frequency(8, 8);
  await wellOf(page);
});

test("Firefox shows surfaces and volumes, or says why it does not", async () => {
  const surface = JSON.stringify({ solidnoise: 2, surface: { noise: "kensler" }, frequency: 3, ramp: "marble" });
  for (const [view, text] of [["surface", surface], ["volume", textOf("kensler")]]) {
    const page = await pages.open(`#recipe=${codeOf(text)}&view=${view}`);
    if (await page.evaluate(() => new OffscreenCanvas(1, 1).getContext("webgl2") !== null)) {
      await page.waitForFunction((own) => /\d/.test(document.querySelector(`.${own} figcaption`)?.textContent ?? ""), view, kPatience);
      assert.equal(await page.locator(".failure").count(), 0);
      await page.waitForTimeout(500);
      await picture(page, `firefox_${view}`);
      await page.click(`[role=tab]:text-is("${view === "volume" ? "Surface" : "Volume"}")`);
      await page.waitForFunction((own) => /\d/.test(document.querySelector(`.view:not(.${own}) figcaption`)?.textContent ?? ""), view, kPatience);
      assert.equal(await page.locator(".failure").count(), 0);
    } else {
      await page.waitForSelector(".failure");
      assert.match(await page.textContent(".failure"), /no WebGL 2.*Slices/);
    }
    await wellOf(page);
  }
});
