// What tests share: the library in Node, the tools, their pictures.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { inflateSync } from "node:zlib";
import { buildSync } from "esbuild";

export const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
export const folder = mkdtempSync(join(tmpdir(), "studio-"));

// A module of the page.
export function loadModule(path) {
  const outfile = join(folder, `${basename(path, ".ts")}.mjs`);
  buildSync({ entryPoints: [join(root, "studio/src", path)], outfile, bundle: true, format: "esm", platform: "node", logLevel: "error" });
  return import(pathToFileURL(outfile).href);
}

export async function loadLibrary() {
  const { Library } = await loadModule("engine/library.ts");
  return Library.load(await WebAssembly.compile(readFileSync(join(root, "build/wasm/solidnoise.wasm"))));
}

// 8 bits a channel, without interlacing, as the tools write them.
export function readPng(path) {
  const bytes = readFileSync(path);
  const [width, height] = [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
  const channels = { 0: 1, 2: 3, 6: 4 }[bytes[25]];
  if (bytes[24] !== 8 || !channels || bytes[28] !== 0) throw new Error(`${path}: another kind of PNG`);
  const parts = [];
  for (let at = 8; at < bytes.length; ) {
    const length = bytes.readUInt32BE(at);
    if (bytes.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(bytes.subarray(at + 8, at + 8 + length));
    at += length + 12;
  }
  const raw = inflateSync(Buffer.concat(parts));
  const stride = width * channels;
  const pixels = new Uint8Array(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (stride + 1)];
    for (let x = 0; x < stride; ++x) {
      const left = x >= channels ? pixels[y * stride + x - channels] : 0;
      const above = y > 0 ? pixels[(y - 1) * stride + x] : 0;
      const corner = x >= channels && y > 0 ? pixels[(y - 1) * stride + x - channels] : 0;
      const [a, b, c] = [Math.abs(above - corner), Math.abs(left - corner), Math.abs(left + above - 2 * corner)];
      const paeth = a <= b && a <= c ? left : b <= c ? above : corner;
      pixels[y * stride + x] = raw[y * (stride + 1) + 1 + x] + [0, left, above, (left + above) >> 1, paeth][filter];
    }
  }
  return { width, height, channels, pixels };
}

export const vdbnoise = (...args) => run("vdbnoise", args);
export const meshnoise = (...args) => run("meshnoise", args);
function run(tool, args) {
  return execFileSync(join(process.env.STUDIO_TOOLS ?? join(root, "build/release/tools"), tool), args, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
}

// The picture that `vdbnoise slice` makes of a recipe.
export function sliceByTool(text, { origin, normal, up, width, columns, rows }, more = []) {
  const recipe = join(folder, "recipe.json");
  const out = join(folder, "slice.png");
  writeFileSync(recipe, text);
  vdbnoise("slice", "--recipe", recipe, "--origin", ...origin.map(String), "--normal", ...normal.map(String), "--up", ...up.map(String),
    "--width", String(width), "--resolution", String(columns), String(rows), "--out", out, "--force", "--quiet", ...more);
  return readPng(out);
}

// The vertices of a .ply in binary, little endian, as meshnoise writes it: name -> numbers.
export function readPlyVertices(path) {
  const bytes = readFileSync(path);
  const end = bytes.indexOf("end_header\n") + 11;
  const lines = bytes.toString("latin1", 0, end).split("\n");
  const reads = { uchar: [1, "readUInt8"], uint8: [1, "readUInt8"], float: [4, "readFloatLE"], float32: [4, "readFloatLE"], double: [8, "readDoubleLE"], float64: [8, "readDoubleLE"] };
  const properties = [];
  let count = 0;
  for (const line of lines.slice(lines.findIndex((text) => text.startsWith("element vertex")))) {
    const words = line.split(" ");
    if (words[0] === "element" && words[1] === "vertex") count = Number(words[2]);
    else if (words[0] === "property") properties.push([words[2], ...reads[words[1]]]);
    else break;
  }
  const columns = Object.fromEntries(properties.map(([name]) => [name, new Float64Array(count)]));
  let at = end;
  for (let i = 0; i < count; ++i) {
    for (const [name, size, read] of properties) {
      columns[name][i] = bytes[read](at);
      at += size;
    }
  }
  return columns;
}

// Of what a recipe bakes onto the torus by meshnoise, by how many of 255 these colours, in linear light, differ at the most; and the vertices.
export function bakeByTool(recipe) {
  const [file, out] = [join(folder, "bake.json"), join(folder, "baked.ply")];
  writeFileSync(file, recipe);
  meshnoise("bake", join(root, "meshes/torus.obj"), "--recipe", file, "--out", out, "--force", "--quiet");
  const vertices = readPlyVertices(out);
  const encoded = (c) => 255 * Math.min(1, Math.max(0, c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
  const colorDifference = (colors) => {
    if (colors.length !== 3 * vertices.red.length) return 255;
    return colors.reduce((worst, color, i) => Math.max(worst, Math.abs(encoded(color) - vertices[["red", "green", "blue"][i % 3]][Math.floor(i / 3)])), 0);
  };
  return { vertices, colorDifference };
}
