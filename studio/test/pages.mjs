// What tests and measurements in browsers share: pages of the built folder, and how they are waited for.
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { serve } from "../serve.mjs";
import { root, sliceByTool } from "./tools.mjs";

export const kPatience = { timeout: 60_000 };
export const codeOf = (text) => Buffer.from(text).toString("base64url");

export const launchChromium = (args) => chromium.launch({ executablePath: process.env.STUDIO_BROWSER ?? "/usr/bin/chromium", args: ["--no-sandbox", ...args] });

export const kSoftwareGl = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

const pictures = join(root, "build/studio-pictures");
const kInDocs = ["slice", "compare", "volume", "surface", "example"];
export function picture(page, name) {
  mkdirSync(pictures, { recursive: true });
  const to = process.env.STUDIO_PICTURES && kInDocs.includes(name) ? process.env.STUDIO_PICTURES : pictures;
  return page.screenshot({ path: join(to, `${name}.jpg`), type: "jpeg", quality: 88 });
}

// A server of the folder, as a sub-folder of a host, as many pages are, and a browser.
export async function startPages(launch) {
  const server = await serve(join(root, "build"), 0);
  const address = `http://localhost:${server.address().port}/studio/`;
  const browser = await launch();
  return {
    address,
    browser,
    // A page of its own; wellOf() fails the test by its errors and by requests to other hosts. `prepare` is called with it before it loads.
    async open(hash = "", options = {}, prepare = async () => undefined) {
      const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, colorScheme: "dark", acceptDownloads: true, ...options });
      const page = await context.newPage();
      page.setDefaultTimeout(kPatience.timeout);
      page.troubles = [];
      page.on("pageerror", (error) => page.troubles.push(error.message));
      page.on("request", (request) => {
        if (!request.url().startsWith(address) && !/^(data|blob):/.test(request.url())) page.troubles.push(`asks ${request.url()}`);
      });
      await page.addInitScript(() => {
        globalThis.pictured = 0;
        globalThis.sharp = 0;
        addEventListener("pictured", (event) => {
          ++globalThis.pictured;
          if (event.detail?.sharp) ++globalThis.sharp;
          globalThis.last = event.detail;
        }, true);
        // What is seen on a canvas that a worker draws on, row by row from the top.
        globalThis.shown = async (selector) => {
          const picture = await createImageBitmap(document.querySelector(selector));
          const context = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
          context.drawImage(picture, 0, 0);
          return context.getImageData(0, 0, picture.width, picture.height);
        };
      });
      await prepare(page);
      await page.goto(address + hash);
      await page.waitForSelector(".app");
      return page;
    },
    async end() {
      await browser.close();
      server.close();
    },
  };
}

// Waits for a sharp slice, the first or one after so many.
export const sharp = (page, after = 0) =>
  page.waitForFunction((n) => globalThis.sharp > n && document.querySelector('figcaption [data-sharp="true"]'), after, kPatience);

export async function wellOf(page) {
  assert.deepEqual(page.troubles, []);
  await page.context().close();
}

// Drops a file on what a selector finds, as a hand does.
export async function dropFile(page, selector, name, bytes) {
  const dataTransfer = await page.evaluateHandle(([own, code]) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([Uint8Array.from(atob(code), (c) => c.charCodeAt(0))], own));
    return transfer;
  }, [name, bytes.toString("base64")]);
  for (const event of ["dragover", "drop"]) await page.dispatchEvent(selector, event, { dataTransfer });
}

// A plane askew, for comparisons, and as an address has it.
export const kPlane = { origin: [0.1, 0.2, 0.3], normal: [1, 1, 2], up: [0, 1, 0], width: 2 };
export const hashOf = (text, { origin, normal, up, width } = kPlane) => `#recipe=${codeOf(text)}&plane=${[...origin, ...normal, ...up, width].join("_")}&view=slice`;

// By how many of 255 the slice that is shown differs from that of vdbnoise.
export async function sliceDifference(page, text, plane) {
  const own = await page.evaluate(() => {
    const canvas = document.querySelector(".slice canvas");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return { columns: canvas.width, rows: canvas.height, grey: Array.from(data).filter((_, i) => i % 4 === 0) };
  });
  const tool = sliceByTool(text, { ...plane, columns: own.columns, rows: own.rows });
  return own.grey.reduce((worst, grey, i) => Math.max(worst, Math.abs(grey - tool.pixels[i])), 0);
}
