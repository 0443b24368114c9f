// Compares a file of the program in WebAssembly with the native program's. The two have different mathematical functions
// (musl's and glibc's), whose results may differ in the last bit: files may differ in such numbers, and in nothing else.

const TEXT = 1e-9, FLOAT = 2e-6; // Greatest relative difference of numbers in a text, and of numbers of 32 bits.
const SMALL = 1e-9; // Numbers below this are rounding errors of 0.
const NUMBER = /-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?/g;

const near = (a, b, most) => Math.abs(a - b) <= most * Math.max(Math.abs(a), Math.abs(b)) + SMALL;

// Returns why two texts differ, or null.
function textsDiffer(a, b) {
  const words = a.split(NUMBER), others = b.split(NUMBER);
  if (words.length !== others.length) return `${words.length - 1} numbers, not ${others.length - 1}`;
  const at = words.findIndex((word, i) => word !== others[i]);
  if (at >= 0) return `“${words[at].trim().slice(0, 40)}”, not “${others[at].trim().slice(0, 40)}”`;
  const mine = a.match(NUMBER) || [], theirs = b.match(NUMBER) || [], wrong = mine.findIndex((x, i) => !near(Number(x), Number(theirs[i]), TEXT));
  return wrong < 0 ? null : `the number ${mine[wrong]}, not ${theirs[wrong]}`;
}

function glb(bytes) {
  const length = bytes.readUInt32LE(12), json = bytes.subarray(20, 20 + length).toString();
  return { json, data: JSON.parse(json), binary: bytes.subarray(28 + length) };
}
function glbsDiffer(a, b) {
  const mine = glb(a), theirs = glb(b), why = textsDiffer(mine.json.replace(/"byteLength":\d+/g, ""), theirs.json.replace(/"byteLength":\d+/g, ""));
  if (why) return why;
  const { accessors = [], bufferViews = [] } = mine.data, SIZES = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };
  for (const accessor of accessors) {
    const from = (bufferViews[accessor.bufferView]?.byteOffset || 0) + (accessor.byteOffset || 0), count = accessor.count * SIZES[accessor.type];
    for (let i = 0; i < count; i++) {
      const read = (x) => accessor.componentType === 5126 ? x.binary.readFloatLE(from + 4 * i) : accessor.componentType === 5125 ? x.binary.readUInt32LE(from + 4 * i) : accessor.componentType === 5123 ? x.binary.readUInt16LE(from + 2 * i) : x.binary.readUInt8(from + i);
      if (accessor.componentType === 5126 ? !near(read(mine), read(theirs), FLOAT) : read(mine) !== read(theirs)) return `the number ${read(mine)}, not ${read(theirs)}`;
    }
  }
  return null;
}

function stlsDiffer(a, b) {
  if (a.length !== b.length) return `${a.length} bytes, not ${b.length}`;
  for (let at = 84; at + 50 <= a.length; at += 50)
    for (let i = 0; i < 48; i += 4) if (!near(a.readFloatLE(at + i), b.readFloatLE(at + i), FLOAT)) return `the number ${a.readFloatLE(at + i)}, not ${b.readFloatLE(at + i)}`;
  return null;
}

// Returns { bytes: whether the files have the same bytes, why: how they differ in more than the last bits, or null }.
export function compare(format, a, b) {
  if (a.equals(b)) return { bytes: true, why: null };
  const why = format === "stl" ? stlsDiffer(a, b) : format === "glb" ? glbsDiffer(a, b) : textsDiffer(a.toString(), b.toString());
  return { bytes: false, why };
}
