// Puts the functions of a module of WebAssembly into an order in which gzip finds more to repeat: node order_functions.mjs INPUT OUTPUT
// What templates make alike is spread over the module, and gzip sees no further back than 32 KB. Nothing else of the module changes, but
// names that it has for people are left out.
import { readFileSync, writeFileSync } from "node:fs";

const kSection = { custom: 0, import: 2, function: 3, export: 7, start: 8, element: 9, code: 10 };
const kWindow = 32000; // bytes that gzip looks back, less than a few of its own
const kPiece = 6; // bytes that are looked for together
const kMostOwners = 64; // what more functions have is everywhere, and says nothing

// Unsigned LEB128: [the number at `at`, where it ends]. Its end alone is that of signed ones, too.
function unsigned(bytes, at) {
  let number = 0;
  for (let shift = 0; ; shift += 7) {
    const byte = bytes[at++];
    number += (byte & 127) * 2 ** shift;
    if (byte < 128) return [number, at];
  }
}
function past(bytes, at, count = 1) {
  for (; count > 0; --count) while (bytes[at++] >= 128);
  return at;
}
function encoded(number) {
  const bytes = [];
  for (; number >= 128; number = Math.floor(number / 128)) bytes.push((number % 128) | 128);
  return [...bytes, number];
}

// Where the operands of an instruction of 128 bits end that `at` stands behind.
function pastVector(bytes, code, at) {
  if (code <= 11 || code === 92 || code === 93) return past(bytes, at, 2); // loads, stores
  if (code <= 13) return at + 16; // constants, shuffles
  if (code >= 21 && code <= 34) return at + 1; // of one lane
  if (code >= 84 && code <= 91) return past(bytes, at, 2) + 1; // loads and stores of one lane
  return at;
}

// Where the operands of an instruction end that `at` stands behind.
function pastOperands(bytes, code, at) {
  if (code >= 0x28 && code <= 0x3e) return past(bytes, at, 2); // loads, stores
  if (code >= 0x45 && code <= 0xc4) return at; // arithmetic
  if (code >= 0x20 && code <= 0x26) return past(bytes, at); // variables
  switch (code) {
    case 0x00: case 0x01: case 0x05: case 0x0b: case 0x0f: case 0x19: case 0x1a: case 0x1b: case 0xd1:
      return at;
    case 0x02: case 0x03: case 0x04: case 0x06: case 0x07: case 0x08: case 0x09: case 0x0c: case 0x0d: case 0x18: // blocks, branches
    case 0x10: case 0x3f: case 0x40: case 0x41: case 0x42: case 0xd0: case 0xd2: // calls, sizes of memory, integers, references
      return past(bytes, at);
    case 0x0e: {
      const [targets, first] = unsigned(bytes, at);
      return past(bytes, first, targets + 1);
    }
    case 0x11:
      return past(bytes, at, 2);
    case 0x1c: {
      const [types, first] = unsigned(bytes, at);
      return first + types;
    }
    case 0x43:
      return at + 4;
    case 0x44:
      return at + 8;
    case 0xfc: {
      const [more, first] = unsigned(bytes, at);
      return past(bytes, first, more < 8 ? 0 : [8, 10, 12, 14].includes(more) ? 2 : 1);
    }
    case 0xfd: {
      const [more, first] = unsigned(bytes, at);
      return pastVector(bytes, more, first);
    }
  }
  throw new Error(`instruction ${code.toString(16)} is not known`);
}

// Where a function names others: [begin, end] of each index.
function findIndices(body) {
  let [locals, at] = unsigned(body, 0);
  for (; locals > 0; --locals) at = past(body, at) + 1;
  const indices = [];
  while (at < body.length) {
    const code = body[at++];
    const end = pastOperands(body, code, at);
    if (code === 0x10 || code === 0xd2) indices.push([at, end]);
    at = end;
  }
  return indices;
}

function readModule(bytes) {
  const sections = [];
  for (let at = 8; at < bytes.length; ) {
    const [size, first] = unsigned(bytes, at + 1);
    sections.push({ id: bytes[at], bytes: bytes.subarray(first, first + size) });
    at = first + size;
  }
  const items = (id, read) => {
    const section = sections.find((found) => found.id === id).bytes;
    let [count, at] = unsigned(section, 0);
    return Array.from({ length: count }, () => {
      let item;
      [item, at] = read(section, at);
      return item;
    });
  };
  const skipText = (section, at) => {
    const [size, first] = unsigned(section, at);
    return first + size;
  };
  const imported = items(kSection.import, (section, at) => {
    const kind = skipText(section, skipText(section, at));
    if (section[kind] !== 0) throw new Error("more than functions is imported");
    return [undefined, past(section, kind + 1)];
  }).length;
  const types = items(kSection.function, unsigned);
  const bodies = items(kSection.code, (section, at) => {
    const [size, first] = unsigned(section, at);
    return [section.subarray(first, first + size), first + size];
  });
  return { sections, imported, functions: bodies.map((body, i) => ({ type: types[i], body, indices: findIndices(body) })) };
}

// Each of the functions after those that it shares the most pieces with, for its size, of what gzip has still in view.
function similarOrder(bodies) {
  const owners = new Map();
  bodies.forEach((body, f) => {
    for (let at = 0; at + kPiece <= body.length; ++at) {
      const piece = body.toString("latin1", at, at + kPiece);
      const found = owners.get(piece);
      if (found === undefined) owners.set(piece, [f]);
      else if (found[found.length - 1] !== f) found.push(f);
    }
  });
  const pieces = bodies.map(() => []);
  for (const list of owners.values()) {
    if (list.length < 2 || list.length > kMostOwners) continue;
    const piece = { owners: list, inView: 0 };
    for (const f of list) pieces[f].push(piece);
  }

  const shared = new Int32Array(bodies.length);
  const enter = (f) => pieces[f].forEach((piece) => piece.inView++ === 0 && piece.owners.forEach((other) => ++shared[other]));
  const leave = (f) => pieces[f].forEach((piece) => --piece.inView === 0 && piece.owners.forEach((other) => --shared[other]));
  const likeness = (f) => shared[f] / (pieces[f].length + 20); // small ones, of which little is repeated, are not first
  const rest = new Set(bodies.keys());
  const order = [];
  for (let [viewed, oldest] = [0, 0]; rest.size > 0; ) {
    let [next] = rest;
    for (const f of rest) if (likeness(f) > likeness(next)) next = f;
    rest.delete(next);
    order.push(next);
    enter(next);
    viewed += bodies[next].length;
    for (; viewed > kWindow && oldest < order.length - 1; ++oldest) {
      leave(order[oldest]);
      viewed -= bodies[order[oldest]].length;
    }
  }
  return order;
}

// The module with its functions in another order: the section of each thing that names functions is written anew, all else is as it was.
function reordered({ sections, imported, functions }, order) {
  const places = new Map(order.map((f, place) => [f + imported, place + imported]));
  const renamed = (section, at) => encoded(places.get(unsigned(section, at)[0]) ?? unsigned(section, at)[0]);
  const write = {
    [kSection.function]: () => [encoded(order.length), ...order.map((f) => encoded(functions[f].type))],
    [kSection.start]: (section) => [renamed(section, 0)],
    [kSection.export]: (section) => {
      let [count, at] = unsigned(section, 0);
      const parts = [encoded(count)];
      for (; count > 0; --count) {
        const [size, first] = unsigned(section, at);
        const kind = first + size;
        parts.push(section.subarray(at, kind + 1), section[kind] === 0 ? renamed(section, kind + 1) : section.subarray(kind + 1, past(section, kind + 1)));
        at = past(section, kind + 1);
      }
      return parts;
    },
    [kSection.element]: (section) => {
      let [count, at] = unsigned(section, 0);
      const parts = [encoded(count)];
      for (; count > 0; --count) {
        if (section[at] !== 0 || section[at + 1] !== 0x41) throw new Error("elements of a kind that is not known");
        const place = past(section, at + 2) + 1; // after the constant and its end
        let [length, index] = unsigned(section, place);
        parts.push(section.subarray(at, index));
        for (; length > 0; --length, index = past(section, index)) parts.push(renamed(section, index));
        at = index;
      }
      return parts;
    },
    [kSection.code]: () => {
      const parts = [encoded(order.length)];
      for (const f of order) {
        const { body, indices } = functions[f];
        const pieces = indices.flatMap(([begin], i) => [body.subarray(i > 0 ? indices[i - 1][1] : 0, begin), renamed(body, begin)]);
        pieces.push(body.subarray(indices.at(-1)?.[1] ?? 0));
        parts.push(encoded(pieces.reduce((size, { length }) => size + length, 0)), ...pieces);
      }
      return parts;
    },
  };
  const joined = (parts) => Buffer.concat(parts.map((part) => Buffer.from(part)));
  return joined([
    "\0asm\x01\0\0\0",
    ...sections.filter(({ id }) => id !== kSection.custom).flatMap(({ id, bytes }) => {
      const section = write[id] === undefined ? bytes : joined(write[id](bytes));
      return [[id, ...encoded(section.length)], section];
    }),
  ]);
}

const [input, output] = process.argv.slice(2);
const module = readModule(readFileSync(input));
const result = reordered(module, similarOrder(module.functions.map(({ body }) => body)));
if (!WebAssembly.validate(result)) throw new Error(`${input}: its functions in another order are no module`);
writeFileSync(output, result);
