// What the tools write for other programs, by other people's parsers: Khronos' validator of glTF, and the reader of USD in three.js.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { validateBytes } from "gltf-validator";
import { USDAParser } from "three/examples/jsm/loaders/usd/USDAParser.js";

const root = path.resolve(import.meta.dirname, "../..");
const folder = mkdtempSync(path.join(tmpdir(), "solidnoise-scenes-"));
after(() => rmSync(folder, { recursive: true }));

const run = (tool, ...words) => execFileSync(path.join(root, "build/release/tools", tool), [...words, "--quiet"], { cwd: folder });
const mesh = (name) => path.join(root, "meshes", name);
const bytes = (name) => new Uint8Array(readFileSync(path.join(folder, name)));

function glb(name) {
  const all = Buffer.from(bytes(name));
  const length = all.readUInt32LE(12);
  const json = JSON.parse(all.subarray(20, 20 + length));
  const data = all.subarray(20 + length + 8);
  const numbers = (attribute) => {
    const { attributes, indices } = json.meshes[0].primitives[0];
    const accessor = json.accessors[attribute ? attributes[attribute] : indices];
    const { byteOffset, byteLength } = json.bufferViews[accessor.bufferView];
    const kind = { 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array }[accessor.componentType];
    return new kind(new Uint8Array(data.subarray(byteOffset, byteOffset + byteLength)).buffer);
  };
  return { json, numbers };
}

// A .ply of floats and bytes, as text: its header's names, and a row per vertex.
function ply(name) {
  const text = Buffer.from(bytes(name)).toString("latin1");
  const end = text.indexOf("end_header\n") + 11;
  const header = text.slice(0, end).split("\n");
  const count = Number(header.find((line) => line.startsWith("element vertex")).split(" ")[2]);
  const first = header.findIndex((line) => line.startsWith("element vertex"));
  const names = header.slice(first + 1, header.findIndex((line) => line.startsWith("element face"))).map((line) => line.split(" "));
  const data = Buffer.from(bytes(name)).subarray(end);
  const size = { float: 4, float32: 4, uchar: 1, uint8: 1 };
  const columns = {};
  let offset = 0;
  const stride = names.reduce((sum, [, type]) => sum + size[type], 0);
  for (const [, type, column] of names) {
    columns[column] = Array.from({ length: count }, (_, v) =>
      size[type] === 4 ? data.readFloatLE(v * stride + offset) : data.readUInt8(v * stride + offset));
    offset += size[type];
  }
  return columns;
}

const linear = (byte) => (byte / 255 <= 0.04045 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);

for (const [name, input, ...flags] of [
  ["wyrm", "wyrm.ply"],
  ["torus", "torus.obj", "--up", "z", "--keep", "frequency,steering", "--frequency", "4..8"],
]) {
  test(`${name}.glb is glTF without faults, and has the colours in linear light and the noise`, async () => {
    run("meshnoise", "bake", mesh(input), "--out", `${name}.ply`, ...flags);
    run("meshnoise", "bake", mesh(input), "--out", `${name}.glb`, ...flags);
    const report = await validateBytes(bytes(`${name}.glb`));
    assert.equal(report.issues.numErrors, 0, JSON.stringify(report.issues.messages));
    assert.equal(report.issues.numWarnings, 0, JSON.stringify(report.issues.messages));

    const expected = ply(`${name}.ply`);
    const { json, numbers } = glb(`${name}.glb`);
    assert.deepEqual([...numbers("_NOISE")], expected.noise);
    const color = numbers("COLOR_0");
    expected.red.forEach((byte, v) => assert.ok(Math.abs(color[4 * v] / 65535 - linear(byte)) <= 0.5 / 65535 + 1e-9));
    assert.ok(color.every((value, i) => i % 4 < 3 || value === 65535));
    assert.deepEqual([...numbers("POSITION")].filter((_, i) => i % 3 === 1), expected.y);
    assert.ok(numbers(null).every((corner) => corner < expected.y.length));
    assert.ok(json.asset.extras.comments.some((comment) => comment.includes('"solidnoise"')), "the recipe is kept");
    assert.equal("rotation" in json.nodes[0], flags.includes("z"));
    assert.equal("_FREQUENCY" in json.meshes[0].primitives[0].attributes, flags.includes("--keep"));
  });

  test(`${name}.usda is the mesh, its colours in linear light and its noise`, () => {
    run("meshnoise", "bake", mesh(input), "--out", `${name}.ply`, "--usd", "--force", ...flags);
    const text = readFileSync(path.join(folder, `${name}.usda`), "utf8");
    const { specsByPath } = new USDAParser().parseData(text);
    const value = (attribute) => specsByPath[`/mesh.${attribute}`].fields.default;
    const expected = ply(`${name}.ply`);
    assert.equal(specsByPath["/mesh"].fields.typeName, "Mesh");
    assert.equal(specsByPath["/"].fields.upAxis, flags.includes("z") ? "Z" : "Y");
    assert.equal(specsByPath["/"].fields.metersPerUnit, 1);
    assert.equal(specsByPath["/"].fields.defaultPrim, "mesh");
    assert.deepEqual([...value("primvars:noise")].map(Math.fround), expected.noise);
    const color = [...value("primvars:displayColor")];
    expected.green.forEach((byte, v) => assert.ok(Math.abs(color[3 * v + 1] - linear(byte)) < 1e-6));
    const points = [...value("points")].map(Math.fround);
    assert.deepEqual(points.filter((_, i) => i % 3 === 2), expected.z);
    const corners = [...value("faceVertexCounts")].reduce((sum, count) => sum + count, 0);
    assert.equal(value("faceVertexIndices").length, corners);
    assert.ok(value("faceVertexIndices").every((corner) => corner < expected.z.length));
  });
}

test("a scene keeps its nodes, materials and animations", async () => {
  const scene = path.join(root, "tests/fuzz/corpus/gltf/scene.gltf");
  run("meshnoise", "bake", scene, "--out", "scene.glb");
  const report = await validateBytes(bytes("scene.glb"));
  assert.equal(report.issues.numErrors, 0, JSON.stringify(report.issues.messages));
  const before = JSON.parse(readFileSync(scene));
  const { json } = glb("scene.glb");
  for (const key of ["nodes", "materials", "animations", "scenes"]) assert.deepEqual(json[key], before[key]);
  assert.ok("_NOISE" in json.meshes[0].primitives[0].attributes && "COLOR_0" in json.meshes[0].primitives[0].attributes);
  run("meshnoise", "bake", "scene.glb", "--recipe", "scene.glb", "--out", "again.glb");
  assert.equal((await validateBytes(bytes("again.glb"))).issues.numErrors, 0);
});

test("vectors of a mesh are vectors in a scene", () => {
  run("meshnoise", "bake", mesh("torus.obj"), "--out", "vectors.ply", "--usd", "--keep", "gradient,curl");
  const expected = ply("vectors.ply");
  const gradient = [...parse("vectors.usda")["/mesh.primvars:gradient"].fields.default].map(Math.fround);
  assert.deepEqual(gradient.filter((_, i) => i % 3 === 1), expected.gradient_y);
  assert.ok("/mesh.primvars:curl" in parse("vectors.usda"));
});

const parse = (name) => new USDAParser().parseData(readFileSync(path.join(folder, name), "utf8")).specsByPath;

test("a scene shows all grids of a volume, by a path beside it", () => {
  run("vdbnoise", "--preset", "fire", "--dim", "24", "--out", "fire.vdb", "--usd", "--up", "z");
  const specs = parse("fire.usda");
  assert.equal(specs["/"].fields.upAxis, "Z");
  assert.equal(specs["/"].fields.defaultPrim, "fire");
  assert.equal(specs["/fire"].fields.typeName, "Volume");
  const types = { density: "float", temperature: "float", flame: "float", vel: "float3" };
  assert.deepEqual(specs["/fire"].fields.primChildren, Object.keys(types));
  for (const [grid, type] of Object.entries(types)) {
    const value = (attribute) => specs[`/fire/${grid}.${attribute}`].fields.default;
    assert.deepEqual(specs[`/fire.field:${grid}`].fields.targetPaths, [`/fire/${grid}`]);
    assert.equal(specs[`/fire/${grid}`].fields.typeName, "OpenVDBAsset");
    assert.equal(value("filePath"), "./fire.vdb");
    assert.equal(value("fieldName"), grid);
    assert.equal(value("fieldDataType"), type);
  }
  assert.equal(specs["/fire/density.fieldClass"].fields.default, "fogVolume");
  assert.equal(specs["/fire/vel.vectorDataRoleHint"].fields.default, "Vector");
  // The box of the recipe is 2 along its longest side, and a voxel more.
  const extent = specs["/fire.extent"].fields.default;
  for (let axis = 0; axis < 3; ++axis) assert.ok(extent[axis + 3] > extent[axis] && extent[axis + 3] - extent[axis] < 2.2);
});

test("a scene of a sequence has a file for each frame", () => {
  run("vdbnoise", "--dim", "12", "--evolve", "1", "--frames", "9-11", "--fps", "25", "--out", "boil.##.vdb", "--usd");
  const specs = parse("boil.usda");
  assert.equal(specs["/"].fields.timeCodesPerSecond, 25);
  const samples = specs["/boil/density.filePath"].fields.timeSamples;
  assert.deepEqual(samples.times, [9, 10, 11]);
  // This parser leaves the comma after an item, which USD's own files have too.
  assert.deepEqual(samples.values, ["./boil.09.vdb,", "./boil.10.vdb,", "./boil.11.vdb,"]);
  assert.equal(specs["/boil.extent"].fields.timeSamples.values.length, 3);
});

test("a sky places an instance of a cloud at each point, each cloud by a scene of its own", () => {
  run("vdbnoise", "sky", "--count", "12", "--kinds", "3", "--voxel", "100", "--out", "sky.usda", "--write-points", "sky.csv", "--up", "z");
  const specs = parse("sky.usda");
  assert.equal(specs["/"].fields.upAxis, "Z");
  assert.equal(specs["/"].fields.defaultPrim, "sky");
  const points = readFileSync(path.join(folder, "sky.csv"), "utf8").trim().split("\n").slice(1).map((row) => row.split(","));
  assert.equal(points.length, 12);
  points.forEach(([x, y, z, , turn, , file, scale], i) => {
    const prim = `/sky/point_${String(i).padStart(5, "0")}`;
    const value = (attribute) => specs[`${prim}.${attribute}`].fields.default;
    assert.equal(specs[prim].fields.typeName, "Xform");
    assert.deepEqual([...value("xformOp:translate")], [x, y, z].map(Number));
    assert.equal(value("xformOp:rotateZ"), Number(turn));
    assert.deepEqual([...value("xformOp:scale")], [scale, scale, scale].map(Number));
    // Which this parser passes over.
    assert.ok(readFileSync(path.join(folder, "sky.usda"), "utf8").includes(
      'xformOpOrder = ["xformOp:translate", "xformOp:rotateZ", "xformOp:scale"]'));
    const cloud = path.basename(file, ".vdb");
    assert.ok(readFileSync(path.join(folder, "sky.usda"), "utf8").includes(`@./sky/${cloud}.usda@`));
    const own = parse(`sky/${cloud}.usda`);
    assert.equal(own[`/${cloud}/density.filePath`].fields.default, `./${cloud}.vdb`);
    assert.ok(readdirSync(path.join(folder, "sky")).includes(`${cloud}.vdb`));
  });
});

test("what has no place in a format is refused, and nothing is made", () => {
  const refused = (...words) => assert.throws(() => run("vdbnoise", "--dim", "8", ...words), (error) => error.status === 2);
  refused("--out", "x.nvdb", "--usd");
  refused("--out", "-", "--usd");
  refused("--out", "x.vdb", "--usd", "--skip-existing");
  assert.throws(() => run("meshnoise", "bake", mesh("torus.obj"), "--out", "x.usda", "--usd"), (error) => error.status === 2);
  assert.deepEqual(readdirSync(folder).filter((name) => name.startsWith("x.")), []);
});
