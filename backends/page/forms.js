// Makes the triangles of X3D's forms, and normals for files without normals.
import { makeGeometry } from "./model.js";

const CREASE = 0.6; // least angle of a sharp edge in radians, as in backends/shade.h

// Returns a geometry with normals. Two faces with an angle of less than the crease between them have a common normal
// and a common index at their corner. edges.js finds edges by these indices.
export function withNormals(at, index, solid, crease = CREASE) {
  const count = index.length / 3, face = new Float64Array(3 * count), places = new Map(), place = new Uint32Array(at.length / 3), around = [];
  for (let v = 0; v < place.length; v++) {
    const key = at[3 * v] + "," + at[3 * v + 1] + "," + at[3 * v + 2];
    if (!places.has(key)) places.set(key, around.push([]) - 1);
    place[v] = places.get(key);
  }
  for (let t = 0; t < count; t++) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * index[3 * t + k]);
    const e = [0, 1, 2].map((k) => at[b + k] - at[a + k]), f = [0, 1, 2].map((k) => at[c + k] - at[a + k]);
    const n = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]], l = Math.hypot(...n) || 1;
    for (let k = 0; k < 3; k++) face[3 * t + k] = n[k] / l, around[place[index[3 * t + k]]].push(t);
  }
  const position = [], normal = [], out = new Uint32Array(index.length), made = new Map(), least = Math.cos(crease);
  for (let c = 0; c < index.length; c++) {
    const t = (c / 3) | 0, sum = [0, 0, 0];
    for (const u of around[place[index[c]]]) {
      const dot = face[3 * t] * face[3 * u] + face[3 * t + 1] * face[3 * u + 1] + face[3 * t + 2] * face[3 * u + 2];
      if (dot >= least) for (let k = 0; k < 3; k++) sum[k] += face[3 * u + k];
    }
    const l = Math.hypot(...sum) || 1, n = sum.map((x) => Math.round(32767 * x / l)), key = place[index[c]] + "," + n;
    let v = made.get(key);
    if (v === undefined) {
      made.set(key, v = position.length / 3);
      position.push(at[3 * index[c]], at[3 * index[c] + 1], at[3 * index[c] + 2]);
      normal.push(...n);
    }
    out[c] = v;
  }
  return makeGeometry(Float32Array.from(position), Int16Array.from(normal), out, solid, false);
}

export function boxForm(x, y, z) {
  const at = [], index = [];
  for (let i = 0; i < 8; i++) at.push((i & 1 ? x : -x) / 2, (i & 2 ? y : -y) / 2, (i & 4 ? z : -z) / 2);
  for (const [a, b, c, d] of [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]) index.push(a, b, c, a, c, d);
  return withNormals(Float32Array.from(at), Uint32Array.from(index), true);
}

function turned(rings, steps) { // rotates rings, [radius, y] from below, about Y; a ring with radius 0 is a pole
  const at = [], index = [];
  for (const [r, y] of rings) for (let i = 0; i < steps; i++) at.push(r * Math.sin(2 * Math.PI * i / steps), y, r * Math.cos(2 * Math.PI * i / steps));
  for (let k = 0; k + 1 < rings.length; k++)
    for (let i = 0; i < steps; i++) {
      const a = k * steps + i, b = k * steps + (i + 1) % steps;
      if (rings[k][0] > 0) index.push(a, b, b + steps);
      if (rings[k + 1][0] > 0) index.push(a, b + steps, a + steps);
    }
  return [Float32Array.from(at), Uint32Array.from(index)];
}

export function sphereForm(r, steps = 48) {
  const rings = [];
  for (let k = 0; k <= steps / 2; k++) rings.push([k === 0 || k === steps / 2 ? 0 : r * Math.sin(2 * Math.PI * k / steps), -r * Math.cos(2 * Math.PI * k / steps)]);
  return withNormals(...turned(rings, steps), true);
}

export function cylinderForm(bottom, top, height, steps = 48) {
  return withNormals(...turned([[0, -height / 2], [bottom, -height / 2], [top, height / 2], [0, height / 2]], steps), true);
}
