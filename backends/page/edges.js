// Finds the edges of a geometry that are drawn dark: creases and borders.
//
// Triangles with smooth shading, or in one plane, share their corners by index. At a crease or a border, an edge
// between two indices has a triangle on one side only. Each side of a crease has such an edge. The two are kept as one,
// identified by the positions of its ends. The normals of both sides are kept beside it (g.edgeSides, six numbers for
// each edge). A border has zeros for the missing side.

// Math.hypot would take ten times as long.
export function lengthOf(x, y, z) { return Math.sqrt(x * x + y * y + z * z); }

export function featureEdges(g) {
  const { index, position } = g;
  if (g.lines) {
    const out = new Float32Array(Math.max(0, position.length / 3 - 1) * 6);
    for (let i = 0; i + 5 < position.length; i += 3) out.set(position.subarray(i, i + 6), 2 * i);
    return out;
  }
  // Collects the edges between indices in the order of first use. low, high: indices of the ends; owner: index of the
  // edge's triangle, or -1 if it has two.
  const count = index.length, low = new Uint32Array(count), high = new Uint32Array(count), owner = new Int32Array(count), slots = table(count), mask = slots.length - 1;
  let edges = 0;
  for (let i = 0; i < count; i += 3)
    for (let k = 0; k < 3; k++) {
      const a = index[i + k], b = index[k < 2 ? i + k + 1 : i], from = a < b ? a : b, to = a < b ? b : a;
      let s = mix(from, to) & mask, e;
      while ((e = slots[s]) >= 0 && (low[e] !== from || high[e] !== to)) s = (s + 1) & mask;
      if (e >= 0) owner[e] = -1;
      else slots[s] = edges, low[edges] = from, high[edges] = to, owner[edges++] = i;
    }
  let open = 0; // Edges with one triangle move to the front of the arrays.
  for (let e = 0; e < edges; e++) if (owner[e] >= 0) low[open] = low[e], high[open] = high[e], owner[open++] = owner[e];
  // Corners at the same position get the number of the first of them.
  const place = placesOf(position, low, high, open);
  // The tip of a round side may have several corners. If the normals at one end of an edge agree, the surface
  // continues.
  const N = g.normal, alike = (u, v) => {
    const x = 3 * u, y = 3 * v, dot = N[x] * N[y] + N[x + 1] * N[y + 1] + N[x + 2] * N[y + 2];
    return dot > 0 && dot * dot > 0.96 * (N[x] ** 2 + N[x + 1] ** 2 + N[x + 2] ** 2) * (N[y] ** 2 + N[y + 1] ** 2 + N[y + 2] ** 2);
  };
  const seen = table(open), seenMask = seen.length - 1, first = new Uint32Array(open), second = new Uint32Array(open), smooth = new Uint8Array(open), sides = new Float64Array(6 * open);
  let lines = 0, kept = 0;
  for (let e = 0; e < open; e++) {
    const a = low[e], b = high[e], p = place[a], q = place[b];
    if (p === q) continue;
    const from = p < q ? p : q, to = p < q ? q : p;
    let s = mix(from, to) & seenMask, before;
    while ((before = seen[s]) >= 0 && !(place[first[before]] === from && place[second[before]] === to) && !(place[first[before]] === to && place[second[before]] === from)) s = (s + 1) & seenMask;
    if (before >= 0) {
      const u = first[before], v = second[before], at = 6 * before + 3;
      if (N && !smooth[before] && (alike(u, place[u] === p ? a : b) || alike(v, place[v] === q ? b : a))) smooth[before] = 1, kept--;
      if (sides[at] === 0 && sides[at + 1] === 0 && sides[at + 2] === 0) normalOf(position, index, owner[e], sides, at);
      continue;
    }
    seen[s] = lines, first[lines] = a, second[lines] = b;
    normalOf(position, index, owner[e], sides, 6 * lines++);
    kept++;
  }
  const out = new Float32Array(6 * kept), outSides = new Float32Array(6 * kept);
  for (let l = 0, to = 0; l < lines; l++) {
    if (smooth[l]) continue;
    for (let k = 0; k < 3; k++) out[to + k] = position[3 * first[l] + k], out[to + 3 + k] = position[3 * second[l] + k];
    for (let k = 0; k < 6; k++) outSides[to + k] = sides[6 * l + k];
    to += 6;
  }
  g.edgeSides = outSides;
  return out;
}

// Returns a hash table for `count` items. An element is an item's number; -1: the slot is free.
function table(count) { return new Int32Array(2 << Math.max(2, 32 - Math.clz32(count))).fill(-1); }
function mix(a, b) {
  let h = Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca77);
  h = Math.imul(h ^ (h >>> 15), 0x2c1b3c6d);
  return h ^ (h >>> 13);
}

// Returns, for each corner at the end of an edge, the first corner at the same position.
function placesOf(position, low, high, count) {
  const words = new Uint32Array(position.buffer, position.byteOffset, position.length), vertices = position.length / 3;
  const place = new Uint32Array(vertices), known = new Uint8Array(vertices), slots = table(2 * count < vertices ? 2 * count : vertices), mask = slots.length - 1;
  const find = (v) => {
    if (known[v]) return;
    const x = words[3 * v], y = words[3 * v + 1], z = words[3 * v + 2];
    let s = mix(mix(x, y), z) & mask, w;
    while ((w = slots[s]) >= 0 && (words[3 * w] !== x || words[3 * w + 1] !== y || words[3 * w + 2] !== z)) s = (s + 1) & mask;
    if (w < 0) slots[s] = v;
    known[v] = 1, place[v] = w < 0 ? v : w;
  };
  for (let e = 0; e < count; e++) find(low[e]), find(high[e]);
  return place;
}

function normalOf(P, I, t, to, at) {
  const a = 3 * I[t], b = 3 * I[t + 1], c = 3 * I[t + 2], ux = P[b] - P[a], uy = P[b + 1] - P[a + 1], uz = P[b + 2] - P[a + 2], vx = P[c] - P[a], vy = P[c + 1] - P[a + 1], vz = P[c + 2] - P[a + 2];
  const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx, s = 1 / (lengthOf(x, y, z) || 1);
  to[at] = x * s, to[at + 1] = y * s, to[at + 2] = z * s;
}

// Returns a byte for each line: 1 if it is a seam. At a seam two bodies of one colour touch: a face of each continues a
// face of the other in the same plane, and the two other faces coincide. ends and sides: six numbers for each line;
// paint: a number for each line; step: distance within which positions count as equal.
export function seams(ends, sides, paint, step) {
  const count = ends.length / 6, found = new Uint8Array(count), first = new Map(), next = new Int32Array(count).fill(-1), near = (x, y, sign) => Math.abs(sides[x] - sign * sides[y]) + Math.abs(sides[x + 1] - sign * sides[y + 1]) + Math.abs(sides[x + 2] - sign * sides[y + 2]) < 0.01;
  for (let i = 0; i < count; i++) {
    const e = 6 * i;
    // The midpoint of a line does not depend on its direction.
    const key = Math.round((ends[e] + ends[e + 3]) / step) * 73856093 + Math.round((ends[e + 1] + ends[e + 4]) / step) * 19349663 + Math.round((ends[e + 2] + ends[e + 5]) / step) * 83492791;
    for (let k = first.get(key) ?? -1; k >= 0; k = next[k]) {
      const o = 6 * k, apart = (a, b) => Math.abs(ends[e + a] - ends[o + b]) + Math.abs(ends[e + a + 1] - ends[o + b + 1]) + Math.abs(ends[e + a + 2] - ends[o + b + 2]);
      if (paint[i] !== paint[k] || !(apart(0, 0) + apart(3, 3) < 4 * step || apart(0, 3) + apart(3, 0) < 4 * step)) continue;
      const flat = (a, b) => near(e + a, o + b, 1) && near(e + 3 - a, o + 3 - b, -1);
      if (flat(0, 0) || flat(0, 3) || flat(3, 0) || flat(3, 3)) found[i] = found[k] = 1;
    }
    next[i] = first.get(key) ?? -1;
    first.set(key, i);
  }
  return found;
}
