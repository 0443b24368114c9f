// Converts a model's parts to few draw calls. Copies of one geometry become instances. All other parts are merged into
// one mesh for each kind of surface.
import * as THREE from "three";
import { determinant } from "./model.js";
import { featureEdges, lengthOf, seams } from "./edges.js";
import { patternKey } from "./patterns.js";

// SEAMS_SOUGHT: greatest number of lines of a merged batch in which seams are searched
const MERGED_TRIANGLES = 150000, FEW_GROUPS = 10, SMALL = 20000, SEAMS_SOUGHT = 200000;
const FEW_KINDS = 1 << 20; // greatest number of pairs of geometry and surface for which a table is used
// If a geometry has more than twice as many copies, neighbouring copies form a cell. A cell out of sight, or too small
// to see, is omitted.
const CELL = 4096;

const linear = (c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;

// Returns the key of a material's surface. Materials with equal keys, which differ only in colour, are drawn together.
function surfaceKey(m) {
  return [Math.round(m.roughness * 20), Math.round(m.metallic * 10), Math.round(m.transparency * 20), patternKey(m)].join();
}

// Collects the shown parts in groups. Returns an array of { geometry, surface, mirrored, merge, material, parts }; the
// numbers in `parts` ascend.
function collect(model, shown) {
  const list = [], keys = model.materials.map(surfaceKey), numbers = new Map(), paints = keys.map((key) => numbers.get(key) ?? (numbers.set(key, numbers.size), numbers.size - 1));
  // groupOf[i]: index of the group of part i, plus 1; 0: the part is not shown.
  const groupOf = new Uint32Array(model.count);
  const { geometry, paint, volume, sheared } = model, lines = Uint8Array.from(model.geometries, (g) => g.lines ? 1 : 0), kinds = 4 * paints.length * model.geometries.length;
  // found[key]: index of the group with this key, plus 1
  const found = kinds <= FEW_KINDS ? new Uint32Array(kinds) : [], counts = [];
  for (let i = 0; i < model.count; i++) {
    if (shown && !shown(i)) continue;
    const number = geometry[i], mirrored = volume[i] < 0, key = 4 * (number * paints.length + (lines[number] ? 0 : paints[paint[i]])) + (mirrored ? 2 : 0) + sheared[i];
    if (!found[key]) {
      const g = model.geometries[number], surface = g.lines ? "lines" : keys[paint[i]] + (g.solid ? "" : ",open");
      list.push({ geometry: g, surface, mirrored, merge: sheared[i] > 0 || g.lines, material: model.materials[paint[i]], parts: null });
      counts.push(0);
      found[key] = list.length;
    }
    groupOf[i] = found[key];
    counts[found[key] - 1]++;
  }
  const order = new Uint32Array(model.count), next = new Uint32Array(list.length);
  for (let k = 0, from = 0; k < list.length; k++) list[k].parts = order.subarray(from, from + counts[k]), next[k] = from, from += counts[k];
  for (let i = 0; i < model.count; i++) if (groupOf[i] > 0) order[next[groupOf[i] - 1]++] = i;
  // The smallest groups are merged first, until few draw calls remain or the merged batch is large.
  list.sort((a, b) => a.geometry.triangles * a.parts.length - b.geometry.triangles * b.parts.length);
  let left = list.filter((group) => !group.merge).length, merged = 0;
  for (const group of list) {
    if (group.merge) continue;
    const cost = group.geometry.triangles * group.parts.length;
    if (group.parts.length > 1 && ((left <= FEW_GROUPS && cost > SMALL) || merged + cost > MERGED_TRIANGLES)) continue;
    group.merge = true;
    if (group.parts.length > 1) merged += cost;
    left--;
  }
  return list;
}

function edgesOf(g) {
  if (!g.edges) g.edges = featureEdges(g), g.spacing = spacingOf(g);
  return g.edges;
}

// Returns the mean distance of the lines on a geometry: its area divided by their length. Curves always show. A plain
// form's few lines count as three times as far apart. They fade later, because only they distinguish the form from its
// background. Without fading, a tree's distant leaves would be black.
const FEW_LINES = 100;
function spacingOf(g) {
  if (g.lines) return 1e30;
  const P = g.position, E = g.edges, I = g.index;
  let area = 0, length = 0;
  for (let k = 0; k < E.length; k += 6) length += lengthOf(E[k + 3] - E[k], E[k + 4] - E[k + 1], E[k + 5] - E[k + 2]);
  for (let t = 0; t < I.length; t += 3) {
    const a = 3 * I[t], b = 3 * I[t + 1], c = 3 * I[t + 2], ux = P[b] - P[a], uy = P[b + 1] - P[a + 1], uz = P[b + 2] - P[a + 2], vx = P[c] - P[a], vy = P[c + 1] - P[a + 1], vz = P[c + 2] - P[a + 2];
    area += lengthOf(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
  }
  return length > 0 ? (E.length < 6 * FEW_LINES ? 3 : 1) * area / length : 1e30;
}

// Merges the corners of some parts into one array for positions, one for normals and so on. The corners are mapped to
// the places of the parts. colors: false if no colours are needed.
export function mergeParts(model, parts, colors = true) {
  let vertices = 0, corners = 0, ends = 0;
  for (const i of parts) {
    const g = model.geometries[model.geometry[i]];
    if (!g.lines) vertices += g.position.length / 3, corners += g.index.length;
    ends += edgesOf(g).length / 3;
  }
  const position = new Float32Array(3 * vertices), normal = new Int16Array(4 * vertices), color = colors ? new Uint16Array(4 * vertices) : null;
  const index = new Uint32Array(corners), edges = new Float32Array(3 * ends), spacing = new Float32Array(ends), sides = colors && ends <= 2 * SEAMS_SOUGHT ? new Float32Array(3 * ends) : null, paints = new Uint32Array(sides ? ends / 2 : 0), edgeColor = colors ? new Uint8Array(4 * ends) : null;
  let v = 0, c = 0, e = 0;
  for (const i of parts) {
    const g = model.geometries[model.geometry[i]], m = model.matrix.subarray(12 * i, 12 * i + 12), flip = determinant(m) < 0;
    const paint = model.materials[model.paint[i]].color, rgb = paint.map((x) => Math.round(65535 * linear(x)));
    // Normals transform by the cofactors of the matrix.
    const n = new Float64Array(9);
    for (let r = 0; r < 3; r++)
      for (let k = 0; k < 3; k++) {
        const r1 = 4 * ((r + 1) % 3), r2 = 4 * ((r + 2) % 3), k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        n[3 * r + k] = (m[r1 + k1] * m[r2 + k2] - m[r1 + k2] * m[r2 + k1]) * (flip ? -1 : 1);
      }
    if (!g.lines) {
      const first = v, P = g.position, N = g.normal;
      for (let k = 0; k < P.length; k += 3, v++) {
        const x = P[k], y = P[k + 1], z = P[k + 2];
        position[3 * v] = m[0] * x + m[1] * y + m[2] * z + m[3];
        position[3 * v + 1] = m[4] * x + m[5] * y + m[6] * z + m[7];
        position[3 * v + 2] = m[8] * x + m[9] * y + m[10] * z + m[11];
        const nx = N[k], ny = N[k + 1], nz = N[k + 2];
        const ax = n[0] * nx + n[1] * ny + n[2] * nz, ay = n[3] * nx + n[4] * ny + n[5] * nz, az = n[6] * nx + n[7] * ny + n[8] * nz;
        const s = 32767 / (lengthOf(ax, ay, az) || 1);
        normal[4 * v] = ax * s, normal[4 * v + 1] = ay * s, normal[4 * v + 2] = az * s;
        if (color) color[4 * v] = rgb[0], color[4 * v + 1] = rgb[1], color[4 * v + 2] = rgb[2], color[4 * v + 3] = 65535;
      }
      const I = g.index;
      for (let k = 0; k < I.length; k += 3) {
        index[c++] = first + I[k];
        index[c++] = first + I[k + (flip ? 2 : 1)];
        index[c++] = first + I[k + (flip ? 1 : 2)];
      }
    }
    const E = edgesOf(g), own = g.lines && model.paint[i] > 0;
    spacing.fill(g.spacing * Math.cbrt(Math.abs(determinant(m))), e, e + E.length / 3);
    for (let k = 0; k < E.length; k += 3, e++) {
      const x = E[k], y = E[k + 1], z = E[k + 2];
      edges[3 * e] = m[0] * x + m[1] * y + m[2] * z + m[3];
      edges[3 * e + 1] = m[4] * x + m[5] * y + m[6] * z + m[7];
      edges[3 * e + 2] = m[8] * x + m[9] * y + m[10] * z + m[11];
      if (edgeColor) for (let q = 0; q < 3; q++) edgeColor[4 * e + q] = own ? rgb[q] >> 8 : 6 + 3 * q;
      if (edgeColor) edgeColor[4 * e + 3] = g.lines ? 255 : 140;
    }
    if (sides && !g.lines) {
      const S = g.edgeSides;
      let to = 3 * (e - E.length / 3);
      for (let k = 0; k < S.length; k += 3, to += 3) {
        const x = n[0] * S[k] + n[1] * S[k + 1] + n[2] * S[k + 2], y = n[3] * S[k] + n[4] * S[k + 1] + n[5] * S[k + 2], z = n[6] * S[k] + n[7] * S[k + 1] + n[8] * S[k + 2], s = 1 / (lengthOf(x, y, z) || 1);
        sides[to] = x * s, sides[to + 1] = y * s, sides[to + 2] = z * s;
      }
      paints.fill(model.paint[i] + 1, (e - E.length / 3) / 2, e / 2);
    }
  }
  if (sides) seams(edges, sides, paints, 1e-6 * model.diagonal).forEach((seam, line) => { if (seam) edgeColor[8 * line + 3] = edgeColor[8 * line + 7] = 0; });
  return { position, normal, color, index, edges, spacing, edgeColor };
}

export function meshGeometry(m) {
  const g = new THREE.BufferGeometry();
  g.setAttribute("position", new THREE.BufferAttribute(m.position, 3));
  const normals = new THREE.InterleavedBuffer(m.normal, 4);
  g.setAttribute("normal", new THREE.InterleavedBufferAttribute(normals, 4, 0, true));
  if (m.color) g.setAttribute("color", new THREE.InterleavedBufferAttribute(new THREE.InterleavedBuffer(m.color, 4), 4, 0, true));
  g.setIndex(new THREE.BufferAttribute(m.index, 1));
  return g;
}

function wide(normal) { // Pads each normal of three shorts to four, because graphics cards read words of four bytes.
  const out = new Int16Array(normal.length / 3 * 4);
  for (let i = 0, k = 0; i < normal.length; i += 3, k += 4) out[k] = normal[i], out[k + 1] = normal[i + 1], out[k + 2] = normal[i + 2];
  return out;
}

function matrices(model, parts, mirrored) {
  const array = new Float32Array(16 * parts.length), sign = mirrored ? -1 : 1, m = model.matrix;
  // Writes a mirrored part's matrix mirrored in x, because the parent of such parts mirrors it back.
  for (let k = 0; k < parts.length; k++) {
    const o = 12 * parts[k], t = 16 * k;
    array[t] = sign * m[o], array[t + 1] = m[o + 4], array[t + 2] = m[o + 8];
    array[t + 4] = sign * m[o + 1], array[t + 5] = m[o + 5], array[t + 6] = m[o + 9];
    array[t + 8] = sign * m[o + 2], array[t + 9] = m[o + 6], array[t + 10] = m[o + 10];
    array[t + 12] = sign * m[o + 3], array[t + 13] = m[o + 7], array[t + 14] = m[o + 11], array[t + 15] = 1;
  }
  return array;
}

function colours(model, parts, paints) {
  const array = new Float32Array(3 * parts.length);
  for (let k = 0; k < parts.length; k++) {
    const c = paints[model.paint[parts[k]]];
    array[3 * k] = c[0], array[3 * k + 1] = c[1], array[3 * k + 2] = c[2];
  }
  return array;
}

// Divides very many parts into lists of neighbours of about the same size. Returns the lists.
function cells(model, parts) {
  if (parts.length <= 2 * CELL) return [parts];
  const found = [], ball = model.ball, ends = new Uint32Array(257), order = new Uint32Array(parts.length), bits = new Uint32Array(ball.buffer, ball.byteOffset, ball.length);
  const sizeOf = (i) => (bits[4 * i + 3] + 0x400000) >>> 23; // exponent, rounded, of a part's radius as a 32-bit float
  for (let k = 0; k < parts.length; k++) ends[sizeOf(parts[k]) + 1]++;
  for (let size = 0; size < 256; size++) ends[size + 1] += ends[size];
  const next = ends.slice();
  for (let k = 0; k < parts.length; k++) order[next[sizeOf(parts[k])]++] = parts[k];
  for (let size = 0; size < 256; size++) if (ends[size] < ends[size + 1]) together(ball, order.subarray(ends[size], ends[size + 1]), found);
  return found;
}

// SPREAD[x]: the bits of x, from 0 to 31, with two free bits between them.
const SPREAD = Uint16Array.from({ length: 32 }, (_, x) => (x & 1) | ((x & 2) << 2) | ((x & 4) << 4) | ((x & 8) << 6) | ((x & 16) << 8));

// Sorts parts by their positions, once, so that neighbours are adjacent. A grid divides space into small cubes. The
// bits of a cube's number are its half along each axis, then its half of this half, and so on.
function together(ball, parts, found) {
  if (parts.length <= CELL) return found.push(parts);
  let x = Infinity, y = Infinity, z = Infinity, x1 = -Infinity, y1 = -Infinity, z1 = -Infinity;
  for (let k = 0; k < parts.length; k++) {
    const o = 4 * parts[k], u = ball[o], v = ball[o + 1], w = ball[o + 2];
    if (u < x) x = u;
    if (u > x1) x1 = u;
    if (v < y) y = v;
    if (v > y1) y1 = v;
    if (w < z) z = w;
    if (w > z1) z1 = w;
  }
  const scale = 31.999 / (Math.max(x1 - x, y1 - y, z1 - z) || 1), cubes = new Uint16Array(parts.length), ends = new Uint32Array(32769), order = new Uint32Array(parts.length);
  for (let k = 0; k < parts.length; k++) {
    const o = 4 * parts[k], cube = 4 * SPREAD[((ball[o] - x) * scale) | 0] + 2 * SPREAD[((ball[o + 1] - y) * scale) | 0] + SPREAD[((ball[o + 2] - z) * scale) | 0];
    ends[(cubes[k] = cube) + 1]++;
  }
  for (let cube = 0; cube < 32768; cube++) ends[cube + 1] += ends[cube];
  const next = ends.slice();
  for (let k = 0; k < parts.length; k++) order[next[cubes[k]]++] = parts[k];
  for (const open = [[0, 32768]]; open.length > 0;) {
    const [from, to] = open.pop(), middle = (from + to) >> 1;
    if (ends[to] - ends[from] > CELL && to - from > 1) open.push([from, middle], [middle, to]);
    else for (let k = ends[from]; k < ends[to]; k += CELL) found.push(order.subarray(k, Math.min(k + CELL, ends[to])));
  }
}

const mirrored = (sphere) => new THREE.Sphere(sphere.center.clone().setX(-sphere.center.x), sphere.radius);

// Returns a sphere around the parts, the largest radius among them, and their greatest scale.
function extent(model, parts) {
  const { ball, volume } = model;
  let most = 0, scale = 0, x0 = Infinity, y0 = Infinity, z0 = Infinity, x1 = -Infinity, y1 = -Infinity, z1 = -Infinity;
  for (let k = 0; k < parts.length; k++) {
    const o = 4 * parts[k], x = ball[o], y = ball[o + 1], z = ball[o + 2], r = ball[o + 3], v = Math.abs(volume[parts[k]]);
    if (x - r < x0) x0 = x - r;
    if (y - r < y0) y0 = y - r;
    if (z - r < z0) z0 = z - r;
    if (x + r > x1) x1 = x + r;
    if (y + r > y1) y1 = y + r;
    if (z + r > z1) z1 = z + r;
    if (r > most) most = r;
    if (v > scale) scale = v;
  }
  const sphere = new THREE.Sphere(new THREE.Vector3((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2), lengthOf(x1 - x0, y1 - y0, z1 - z0) / 2);
  return { sphere, most, scale: Math.cbrt(scale) };
}

// Returns a three.js group with the batches of a model. surfaces.get(surface, material, merged) returns a three.js
// material. lines.merged and lines.instanced are the materials of edges.
export function buildBatches(model, shown, surfaces, lines) {
  const root = new THREE.Group(), mirror = new THREE.Group();
  mirror.scale.x = -1;
  root.add(mirror);
  const merged = new Map(), paints = model.materials.map((m) => m.color.map(linear));
  let triangles = 0, mergedTriangles = 0, edgeLines = 0;
  for (const group of collect(model, shown)) {
    triangles += group.geometry.triangles * group.parts.length;
    if (group.merge) {
      if (!merged.has(group.surface)) merged.set(group.surface, { material: group.material, parts: [] });
      const list = merged.get(group.surface).parts;
      for (const i of group.parts) list.push(i);
      continue;
    }
    const g = group.geometry, geometry = meshGeometry({ position: g.position, normal: wide(g.normal), index: g.index, color: null });
    const edges = edgesOf(g), lined = edges.length > 0 ? new THREE.BufferGeometry() : null;
    if (lined) {
      lined.setAttribute("position", new THREE.BufferAttribute(edges, 3));
      lined.setAttribute("spacing", new THREE.BufferAttribute(new Float32Array(edges.length / 3).fill(g.spacing), 1));
    }
    for (const parts of cells(model, group.parts)) {
      const count = parts.length, around = extent(model, parts), place = new THREE.InstancedBufferAttribute(new Float32Array(0), 16), color = new THREE.InstancedBufferAttribute(new Float32Array(0), 3);
      // If there are very many copies, most are never visible. Therefore their places are computed when a cell is
      // visible for the first time.
      const fill = () => {
        if (place.count > 0) return;
        place.array = matrices(model, parts, group.mirrored), place.count = count;
        color.array = colours(model, parts, paints), color.count = count;
      };
      const mesh = new THREE.InstancedMesh(geometry, surfaces.get(group.surface, group.material, false), 0);
      mesh.instanceMatrix = place;
      mesh.instanceColor = color;
      mesh.count = count;
      finish(mesh, group.surface, group.material);
      mesh.frustumCulled = true;
      mesh.boundingSphere = group.mirrored ? mirrored(around.sphere) : around.sphere;
      Object.assign(mesh.userData, { around, fill, cost: count * g.triangles });
      (group.mirrored ? mirror : root).add(mesh);
      if (!lined) continue;
      edgeLines += count * edges.length / 6;
      const line = new THREE.LineSegments(lined, lines.instanced);
      // Makes a set of lines with a matrix for each copy. The renderer needs only these members for it.
      Object.assign(line, { isInstancedMesh: true, instanceMatrix: place, instanceColor: null, morphTexture: null, count, boundingSphere: mesh.boundingSphere });
      line.userData = { edges: true, around, fill, spacing: g.spacing * around.scale, cost: count * edges.length / 6 };
      (group.mirrored ? mirror : root).add(line);
    }
  }
  for (const [surface, { material, parts }] of merged) {
    const m = mergeParts(model, parts);
    if (m.index.length > 0) {
      const mesh = new THREE.Mesh(meshGeometry(m), surfaces.get(surface, material, true));
      finish(mesh, surface, material);
      mergedTriangles += m.index.length / 3;
      root.add(mesh);
    }
    if (m.edges.length > 0) {
      const line = new THREE.LineSegments(new THREE.BufferGeometry(), lines.merged);
      line.geometry.setAttribute("position", new THREE.BufferAttribute(m.edges, 3));
      line.geometry.setAttribute("spacing", new THREE.BufferAttribute(m.spacing, 1));
      line.geometry.setAttribute("color", new THREE.BufferAttribute(m.edgeColor, 4, true));
      line.userData.edges = surface !== "lines";
      if (line.userData.edges) edgeLines += m.edges.length / 6;
      line.frustumCulled = false;
      root.add(line);
    }
  }
  root.userData.triangles = triangles;
  root.userData.merged = mergedTriangles;
  root.userData.lines = edgeLines;
  return root;
}

function finish(mesh, surface, material) {
  mesh.userData.surface = surface;
  mesh.userData.solid = !surface.endsWith(",open");
  // A glass pane casts no shadow, because light passes through it.
  mesh.castShadow = mesh.userData.casts = material.transparency < 0.3;
  mesh.receiveShadow = true;
  mesh.frustumCulled = false;
}

// Omits from a picture the objects that are too small to be seen: parts smaller than half a pixel, and faded lines.
// Omits from the shadow maps parts smaller than a few of their points. If the triangles and lines in sight exceed the
// limit `most`, omits the smallest objects. pixels(distance): number of pixels of a length of 1 at this distance;
// across: length of a shadow map's point; lit: true if the shadow maps are drawn anew.
// FADED_PIXELS: distance of lines at which stage.js has faded them
const LEAST_PIXELS = 0.5, LEAST_POINTS = 4, FADED_PIXELS = 5;
const wider = new THREE.Sphere();
export function leaveOut(root, { camera, pixels, across, lined, lit, most }) {
  const found = [], eye = camera.position, frustum = new THREE.Frustum().setFromProjectionMatrix(new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
  let sum = root.userData.merged;
  root.traverse((o) => {
    const { around, edges, spacing, casts, cost } = o.userData;
    if (!around) return;
    const { center, radius } = around.sphere, distance = center.distanceTo(eye), near = pixels(Math.max(0.02 * radius, distance - radius)), size = 2 * around.most;
    if (!edges) o.castShadow = casts && size > LEAST_POINTS * across;
    o.visible = edges ? lined && spacing * near > FADED_PIXELS : size * near > LEAST_PIXELS;
    if (!o.visible || !frustum.intersectsSphere(around.sphere)) return;
    // The size is that of the nearest copy, because copies of a piece of bark may fill an entire street. Lines count as
    // smaller than faces, so they are omitted before their faces.
    found.push({ o, size: near * (edges ? size / 4 : size), cost });
    sum += cost;
  });
  if (sum > most) {
    found.sort((a, b) => a.size - b.size);
    for (const { o, cost } of found) {
      if (sum <= most) break;
      o.visible = false;
      sum -= cost;
    }
  }
  root.traverse((o) => {
    if (!o.userData.around) return;
    if (lit && o.castShadow) o.visible = true;
    if (!o.visible || !o.userData.fill) return;
    // The sphere is enlarged, so that the renderer's own test of the bounds finds no further objects.
    const { center, radius } = o.userData.around.sphere;
    if (lit || frustum.intersectsSphere(wider.set(center, 1.01 * radius))) o.userData.fill();
  });
}

export function disposeBatches(root) {
  root.traverse((o) => {
    if (o.geometry) o.geometry.dispose();
    if (o.isInstancedMesh) o.dispatchEvent({ type: "dispose" });
  });
}
