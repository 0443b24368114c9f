// Damages a mesh: `node damaged.mjs SEED MESH.off...` prints one of the meshes as .off, with random faults: holes,
// flipped and repeated faces, shifted and split corners, stray triangles, faces with a wrong corner, and a second copy
// a little beside the first.
import { readFileSync } from "node:fs";

let state = BigInt(process.argv[2]);
function dice() { // SplitMix64
  state = (state + 0x9e3779b97f4a7c15n) & 0xffffffffffffffffn;
  let z = state;
  z = ((z ^ (z >> 30n)) * 0xbf58476d1ce4e5b9n) & 0xffffffffffffffffn;
  z = ((z ^ (z >> 27n)) * 0x94d049bb133111ebn) & 0xffffffffffffffffn;
  return Number((z ^ (z >> 31n)) >> 11n) / 2 ** 53;
}
const pick = (n) => Math.floor(dice() * n), some = (list) => list[pick(list.length)];
const times = (n, f) => { for (let i = 0; i <= pick(n); i++) f(); };

const lines = readFileSync(some(process.argv.slice(3)), "utf8").split("\n").filter((l) => l && !l.startsWith("#"));
const [count, faceCount] = lines[1].split(" ").map(Number);
const corners = lines.slice(2, 2 + count).map((l) => l.split(" ").slice(0, 3).map(Number));
let faces = lines.slice(2 + count, 2 + count + faceCount).map((l) => l.split(" ").slice(1, 1 + Number(l.split(" ")[0])).map(Number));
const size = Math.max(...corners.flat().map(Math.abs));
const near = (least, most) => { const s = size * 10 ** (least + (most - least) * dice()); return () => s * (2 * dice() - 1); };

const faults = [
  () => times(faces.length / 15, () => faces.splice(pick(faces.length), 1)),
  () => times(5, () => some(faces).reverse()),
  () => times(5, () => faces.push([...some(faces)])),
  () => times(6, () => { const p = some(corners), off = near(-8, -0.3); for (let k = 0; k < 3; k++) p[k] += off(); }),
  () => times(6, () => { const f = some(faces), k = pick(f.length), off = near(-9, -2); f[k] = corners.push(corners[f[k]].map((x) => x + off())) - 1; }),
  () => faces.push([pick(corners.length), pick(corners.length), pick(corners.length)]),
  () => { const f = some(faces); f[pick(f.length)] = pick(corners.length); },
  () => {
    const off = near(-9, 0), by = [off(), off(), off()], n = corners.length, m = faces.length;
    corners.push(...corners.slice(0, n).map((p) => p.map((x, k) => x + by[k])));
    faces.push(...faces.slice(0, m).map((f) => f.map((c) => c + n)));
  },
];
times(4, () => some(faults)());
faces = faces.filter((f) => new Set(f).size === f.length);
console.log(["OFF", `${corners.length} ${faces.length} 0`, ...corners.map((p) => p.join(" ")), ...faces.map((f) => [f.length, ...f].join(" "))].join("\n"));
