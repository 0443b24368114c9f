// Owns a check of a binary STL: node closed.mjs FILE.stl prints the number of triangles and whether each edge, compared
// by coordinates, occurs equally often in both directions.
import fs from 'fs';
const b = fs.readFileSync(process.argv[2]), n = b.readUInt32LE(80), place = new Map(), edges = new Map();
const corner = o => { const key = b.toString('latin1', o, o + 12); let i = place.get(key); if (i === undefined) place.set(key, i = place.size); return i; };
for (let t = 0; t < n; t++) {
  const o = 84 + 50 * t + 12, v = [corner(o), corner(o + 12), corner(o + 24)];
  for (let j = 0; j < 3; j++) { const x = v[j], y = v[(j + 1) % 3]; if (x === y) continue;
    const key = x < y ? x * 4294967296 + y : y * 4294967296 + x; edges.set(key, (edges.get(key) || 0) + (x < y ? 1 : -1)); } }
let open = 0; for (const e of edges.values()) if (e) open++;
console.log(n, open ? 'no' : 'yes');
