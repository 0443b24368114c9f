// Finds the edges of a geometry that are drawn dark: creases and borders.
//
// Triangles that are shaded smoothly, or lie in one plane, share their corners by index; where a surface has a crease or ends, an index edge
// has a triangle on one side only. Both sides of a crease say so: an edge is kept once, told apart by the place of its ends. The normals of both
// sides are kept beside it (g.edgeSides, six numbers an edge; zeros for a border's missing side).

export function featureEdges(g) {
  const { index, position } = g;
  if (g.lines) {
    const out = new Float32Array(Math.max(0, position.length / 3 - 1) * 6);
    for (let i = 0; i + 5 < position.length; i += 3) out.set(position.subarray(i, i + 6), 2 * i);
    return out;
  }
  const vertices = position.length / 3, uses = new Map(); // Of an index edge: its triangle, or -1 where it has two.
  for (let i = 0; i < index.length; i += 3)
    for (let k = 0; k < 3; k++) {
      const a = index[i + k], b = index[i + (k + 1) % 3], key = a < b ? a * vertices + b : b * vertices + a;
      uses.set(key, uses.has(key) ? -1 : i);
    }
  // Corners at one place get one number.
  const places = new Map(), place = new Uint32Array(vertices);
  const words = new Uint32Array(position.buffer, position.byteOffset, position.length);
  const placeOf = (v) => {
    if (place[v] > 0) return place[v];
    const key = words[3 * v] + "," + words[3 * v + 1] + "," + words[3 * v + 2];
    let number = places.get(key);
    if (number === undefined) places.set(key, number = places.size + 1);
    return place[v] = number;
  };
  // A round side's corners may be several at its tip: where the normals at one end agree, the surface goes on.
  const N = g.normal, seen = new Map(), out = [], sides = [], corners = [], alike = (u, v) => {
    const x = 3 * u, y = 3 * v, dot = N[x] * N[y] + N[x + 1] * N[y + 1] + N[x + 2] * N[y + 2];
    return dot > 0 && dot * dot > 0.96 * (N[x] ** 2 + N[x + 1] ** 2 + N[x + 2] ** 2) * (N[y] ** 2 + N[y + 1] ** 2 + N[y + 2] ** 2);
  };
  for (const [key, triangle] of uses) {
    if (triangle < 0) continue;
    const b = key % vertices, a = (key - b) / vertices, p = placeOf(a), q = placeOf(b);
    if (p === q) continue;
    const name = p < q ? p * 0x4000000 + q : q * 0x4000000 + p, before = seen.get(name);
    if (before !== undefined) {
      const [u, v] = [corners[before / 3], corners[before / 3 + 1]];
      if (N && (alike(u, placeOf(u) === p ? a : b) || alike(v, placeOf(v) === q ? b : a))) corners[before / 3] = -1;
      if (sides[before + 3] === 0 && sides[before + 4] === 0 && sides[before + 5] === 0) normalOf(position, index, triangle, sides, before + 3);
      continue;
    }
    seen.set(name, sides.length);
    normalOf(position, index, triangle, sides, sides.length);
    sides.push(0, 0, 0);
    corners.push(a, b);
    out.push(position[3 * a], position[3 * a + 1], position[3 * a + 2], position[3 * b], position[3 * b + 1], position[3 * b + 2]);
  }
  const kept = (_, i) => corners[2 * Math.floor(i / 6)] >= 0;
  g.edgeSides = Float32Array.from(sides.filter(kept));
  return Float32Array.from(out.filter(kept));
}

function normalOf(P, I, t, to, at) {
  const a = 3 * I[t], b = 3 * I[t + 1], c = 3 * I[t + 2], ux = P[b] - P[a], uy = P[b + 1] - P[a + 1], uz = P[b + 2] - P[a + 2], vx = P[c] - P[a], vy = P[c + 1] - P[a + 1], vz = P[c + 2] - P[a + 2];
  const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx, s = 1 / (Math.hypot(x, y, z) || 1);
  to[at] = x * s, to[at + 1] = y * s, to[at + 2] = z * s;
}

// Which of many lines are seams: where two bodies of one colour abut, one side of both goes on as a plane and the others lie on each other. ends and
// sides: six numbers a line; paint: a number a line; step: what counts as one place. Returns a byte a line, 1 for a seam.
export function seams(ends, sides, paint, step) {
  const count = ends.length / 6, found = new Uint8Array(count), first = new Map(), next = new Int32Array(count).fill(-1), near = (x, y, sign) => Math.abs(sides[x] - sign * sides[y]) + Math.abs(sides[x + 1] - sign * sides[y + 1]) + Math.abs(sides[x + 2] - sign * sides[y + 2]) < 0.01;
  for (let i = 0; i < count; i++) {
    const e = 6 * i;
    // The middle of a line is the same from both ends.
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
