// Finds the edges of a geometry that are drawn dark: creases and borders.
//
// Triangles that are shaded smoothly, or lie in one plane, share their corners by index; where a surface has a crease or ends, an index edge
// has a triangle on one side only. Both sides of a crease say so: an edge is kept once, told apart by the place of its ends.

export function featureEdges(g) {
  const { index, position } = g;
  if (g.lines) {
    const out = new Float32Array(Math.max(0, position.length / 3 - 1) * 6);
    for (let i = 0; i + 5 < position.length; i += 3) out.set(position.subarray(i, i + 6), 2 * i);
    return out;
  }
  const vertices = position.length / 3, uses = new Map();
  for (let i = 0; i < index.length; i += 3)
    for (let k = 0; k < 3; k++) {
      const a = index[i + k], b = index[i + (k + 1) % 3], key = a < b ? a * vertices + b : b * vertices + a;
      uses.set(key, (uses.get(key) || 0) + 1);
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
  const seen = new Set(), out = [];
  for (const [key, count] of uses) {
    if (count !== 1) continue;
    const b = key % vertices, a = (key - b) / vertices, p = placeOf(a), q = placeOf(b);
    if (p === q) continue;
    const name = p < q ? p * 0x4000000 + q : q * 0x4000000 + p;
    if (seen.has(name)) continue;
    seen.add(name);
    out.push(position[3 * a], position[3 * a + 1], position[3 * a + 2], position[3 * b], position[3 * b + 1], position[3 * b + 2]);
  }
  return Float32Array.from(out);
}
