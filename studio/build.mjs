// Makes the static folder: node build.mjs OUTPUT WASM
import { build } from "esbuild";
import { copyFileSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "..");
const [output = join(root, "build/studio"), wasm = join(root, "build/wasm/solidnoise.wasm")] = process.argv.slice(2);
mkdirSync(output, { recursive: true });

// Presets and examples to start from: the very files of the tools, without their blanks.
const recipes = (folder, kind) =>
  readdirSync(join(root, folder))
    .filter((name) => name.endsWith(".json"))
    .map((name) => ({ name: name.replace(".json", ""), kind, text: readFileSync(join(root, folder, name), "utf8").replace(/("(?:[^"\\]|\\.)*")|\s+/g, "$1") }));
const starts = [
  ...recipes("tools/vdbnoise/presets", "preset"),
  ...recipes("examples/recipes", "example"),
  ...recipes("tools/meshnoise/presets", "surface"),
];

await build({
  entryPoints: { studio: join(here, "src/main.tsx"), worker: join(here, "src/engine/worker.ts"), scene: join(here, "src/views/scene_worker.ts") },
  outdir: output,
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  legalComments: "none",
  jsx: "automatic",
  jsxImportSource: "preact",
  define: { STARTS: JSON.stringify(starts) },
  loader: { ".css": "css" },
});
copyFileSync(join(here, "index.html"), join(output, "index.html"));
copyFileSync(wasm, join(output, "solidnoise.wasm"));
for (const photograph of ["earth", "leaves", "moss", "rock", "sand", "soil", "wood"]) {
  copyFileSync(join(root, `examples/exemplars/${photograph}.jpg`), join(output, `${photograph}.jpg`));
}
for (const mesh of ["wyrm.ply", "bowl.obj", "torus.obj"]) copyFileSync(join(root, "meshes", mesh), join(output, mesh));

// What a visitor downloads: all but the last before the first picture.
let total = 0;
for (const name of ["index.html", "studio.js", "studio.css", "worker.js", "solidnoise.wasm", "scene.js"]) {
  const size = gzipSync(readFileSync(join(output, name)), { level: 9 }).length;
  total += size;
  console.log(`${name.padEnd(16)} ${(size / 1024).toFixed(1).padStart(7)} KB gzipped`);
}
console.log(`${"all".padEnd(16)} ${(total / 1024).toFixed(1).padStart(7)} KB gzipped`);
writeFileSync(join(output, "size.json"), JSON.stringify({ gzipped: total }));
const kMost = 600 * 1024;
if (total > kMost) {
  console.error(`studio: more than ${kMost / 1024} KB gzipped`);
  process.exit(1);
}
