// Contains the viewer's model: geometries, materials, and a list of parts. A part is a geometry at a place.
//
// A part has the origin of its own constructor call, and a path: the operations of the source that contain it, from the
// inside outwards. A path has a parent, an origin and a kind; parts of one operation have the same path. There may be a
// million of each, so all are arrays of numbers.

const PART_ARRAYS = ["geometry", "paint", "layer", "path", "kind", "made", "matrix"], PATH_ARRAYS = ["pathParent", "pathOrigin", "pathKind"], MEASURED = ["ball", "volume", "sheared"];

export class Model {
  constructor() {
    this.title = "model";
    this.units = "m";
    this.middle = [0, 0, 0]; // All positions of parts are relative to this point.
    this.view = null;
    this.sun = null;
    this.sky = null;
    // The physical sky: a table of its light, the sun's light, and the light on a horizontal surface.
    this.daylight = null;
    this.ground = null;
    this.materials = [plain()]; // Number 0 is the material of parts without a material.
    this.layers = [""];
    this.kinds = [""];
    this.geometries = [];
    this.origins = { files: [], at: new Uint32Array(0) };
    this.pathCount = 1; // Path number 0 is the drawing itself.
    this.pathParent = new Uint32Array(64);
    this.pathOrigin = new Uint32Array(64);
    this.pathKind = new Uint16Array(64);
    this.roles = new Map(); // For a scene with its steps (timeline.js): the role of each path, by its number.
    this.cuts = new Set(); // For a scene with its steps: the numbers of the parts that are subtracted.
    // True if others than the viewer use the model, so that it must remain unchanged after the next model.
    this.kept = false;
    this.count = 0;
    this.matrix = new Float32Array(12 * 64);
    this.geometry = new Uint32Array(64);
    this.paint = new Uint32Array(64);
    this.layer = new Uint32Array(64);
    this.path = new Uint32Array(64);
    this.kind = new Uint16Array(64);
    this.made = new Uint32Array(64); // The number of the part's origin, or 0.
  }

  get metres() { return { mm: 0.001, cm: 0.01, in: 0.0254, ft: 0.3048 }[this.units] || 1; } // Length of a model unit in metres.

  grow(need) {
    if (need <= this.geometry.length) return;
    const room = Math.max(need, 2 * this.geometry.length);
    for (const key of PART_ARRAYS) this.#enlarge(key, key === "matrix" ? 12 * room : room);
  }
  growPaths(need) {
    if (need <= this.pathParent.length) return;
    const room = Math.max(need, 2 * this.pathParent.length);
    for (const key of PATH_ARRAYS) this.#enlarge(key, room);
  }
  #enlarge(key, room) {
    const was = this[key];
    this[key] = new was.constructor(room);
    this[key].set(was);
  }

  // Takes over the arrays of a model that is no longer in use. Otherwise the system would take as long to clear a
  // hundred megabytes as the viewer takes to fill them.
  inherit(other) {
    for (const key of [...PART_ARRAYS, ...PATH_ARRAYS, ...MEASURED]) this[key] = other[key], other[key] = null;
  }

  addPath(parent, origin, kind) {
    const p = this.pathCount++;
    this.growPaths(p + 1);
    this.pathParent[p] = parent;
    this.pathOrigin[p] = origin;
    this.pathKind[p] = kind;
    return p;
  }

  // Adds a part. m contains, from index `at`, the three rows of its affine map.
  add(geometry, m, at, paint, layer, path, kind, made) {
    const i = this.count;
    this.grow(i + 1);
    for (let k = 0, to = 12 * i; k < 12; k++) this.matrix[to + k] = m[at + k];
    this.geometry[i] = geometry;
    this.paint[i] = paint;
    this.layer[i] = layer;
    this.path[i] = path;
    this.kind[i] = kind;
    this.made[i] = made;
    this.count = i + 1;
  }

  // Computes the properties of each part that depend on its matrix: bounds as a sphere, the volume of a unit cube
  // (negative if mirrored), and whether it is sheared. Also computes the bounds of all parts as a box, relative to the
  // middle. It does so in one pass, because a million matrices exceed the processor's cache.
  measure() {
    const n = this.count, m = this.matrix, geometry = this.geometry;
    if (!this.sheared || this.sheared.length < n) this.ball = new Float32Array(4 * n), this.volume = new Float32Array(n), this.sheared = new Uint8Array(n);
    const { ball, volume, sheared } = this;
    const half = new Float64Array(6 * this.geometries.length); // for each geometry's box: its centre, and half its size
    this.geometries.forEach((g, at) => { for (let k = 0; k < 3; k++) half[6 * at + k] = (g.min[k] + g.max[k]) / 2, half[6 * at + 3 + k] = (g.max[k] - g.min[k]) / 2; });
    let x0 = Infinity, y0 = Infinity, z0 = Infinity, x1 = -Infinity, y1 = -Infinity, z1 = -Infinity;
    for (let i = 0, o = 0; i < n; i++, o += 12) {
      const a = m[o], b = m[o + 1], c = m[o + 2], d = m[o + 4], e = m[o + 5], f = m[o + 6], g = m[o + 8], h = m[o + 9], l = m[o + 10];
      const at = 6 * geometry[i], p = half[at], q = half[at + 1], r = half[at + 2], u = half[at + 3], v = half[at + 4], w = half[at + 5];
      const x = a * p + b * q + c * r + m[o + 3], y = d * p + e * q + f * r + m[o + 7], z = g * p + h * q + l * r + m[o + 11];
      const dx = Math.abs(a) * u + Math.abs(b) * v + Math.abs(c) * w, dy = Math.abs(d) * u + Math.abs(e) * v + Math.abs(f) * w, dz = Math.abs(g) * u + Math.abs(h) * v + Math.abs(l) * w;
      if (x - dx < x0) x0 = x - dx;
      if (y - dy < y0) y0 = y - dy;
      if (z - dz < z0) z0 = z - dz;
      if (x + dx > x1) x1 = x + dx;
      if (y + dy > y1) y1 = y + dy;
      if (z + dz > z1) z1 = z + dz;
      const to = 4 * i;
      ball[to] = x, ball[to + 1] = y, ball[to + 2] = z, ball[to + 3] = Math.sqrt(dx * dx + dy * dy + dz * dz);
      volume[i] = a * (e * l - f * h) - b * (d * l - f * g) + c * (d * h - e * g);
      const first = a * a + d * d + g * g, second = b * b + e * e + h * h, third = c * c + f * f + l * l, most = 1e-5 * (first > second ? first > third ? first : third : second > third ? second : third);
      sheared[i] = Math.abs(a * b + d * e + g * h) > most || Math.abs(a * c + d * f + g * l) > most || Math.abs(b * c + e * f + h * l) > most ? 1 : 0;
    }
    this.box = n === 0 ? { min: [-1, -1, -1], max: [1, 1, 1] } : { min: [x0, y0, z0], max: [x1, y1, z1] };
    this.size = [0, 1, 2].map((k) => this.box.max[k] - this.box.min[k]);
    this.diagonal = Math.hypot(...this.size) || 1;
    this.outer = null;
    return this;
  }

  // Returns points whose hull contains the model, three numbers each. They are all corners of the parts' triangles; for
  // large models the corners of the parts' boxes; for very large models the corners of the model's box. A dome fills
  // its box only in six directions, so its own points frame it better.
  outerPoints() {
    if (this.outer) return this.outer;
    const n = this.count, m = this.matrix, { min, max } = this.box, MOST = 200000;
    let all = 0;
    for (let i = 0; i < n && all <= MOST; i++) all += this.geometries[this.geometry[i]].position.length / 3;
    const each = all <= MOST ? null : 8, at = [];
    const corners = (low, high) => Array.from({ length: 24 }, (_, j) => ((Math.floor(j / 3) >> (j % 3)) & 1 ? high : low)[j % 3]);
    if (n === 0 || (each && 8 * n > MOST)) at.push(...corners(min, max));
    else
      for (let i = 0, o = 0; i < n; i++, o += 12) {
        const g = this.geometries[this.geometry[i]], P = each ? corners(g.min, g.max) : g.position;
        for (let v = 0; v < P.length; v += 3)
          for (let k = 0; k < 3; k++) at.push(m[o + 4 * k] * P[v] + m[o + 4 * k + 1] * P[v + 1] + m[o + 4 * k + 2] * P[v + 2] + m[o + 4 * k + 3]);
      }
    return this.outer = new Float32Array(at);
  }

  // Returns the places in the source that made part i, as { file, line, column, number }, from the innermost call
  // outwards.
  chain(i) {
    const found = [], seen = new Set();
    const climb = (o) => {
      for (; o > 0 && !seen.has(o); o = this.origins.at[4 * (o - 1) + 3]) {
        seen.add(o);
        found.push(this.origin(o));
      }
    };
    climb(this.made[i]);
    for (let path = this.path[i]; path > 0; path = this.pathParent[path]) climb(this.pathOrigin[path]);
    return found;
  }
  origin(o) {
    const at = this.origins.at;
    const file = this.origins.files[at[4 * (o - 1)]];
    return { file, name: file.replace(/.*\//, ""), line: at[4 * (o - 1) + 1], column: at[4 * (o - 1) + 2], number: o };
  }
  where(i) { return this.made[i] > 0 ? this.origin(this.made[i]) : null; }
}

// Returns the box that contains several models, relative to `middle`.
export function togetherBox(models, middle) {
  const box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
  for (const m of models) for (let k = 0; k < 3; k++) {
    box.min[k] = Math.min(box.min[k], m.box.min[k] + m.middle[k] - middle[k]);
    box.max[k] = Math.max(box.max[k], m.box.max[k] + m.middle[k] - middle[k]);
  }
  return box;
}

export function plain() {
  return { name: "", color: [0.86, 0.85, 0.83], roughness: 0.9, metallic: 0, transparency: 0, ior: 1.5 };
}

export function makeGeometry(position, normal, index, solid, lines) {
  const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < position.length; i += 3)
    for (let k = 0; k < 3; k++) {
      if (position[i + k] < min[k]) min[k] = position[i + k];
      if (position[i + k] > max[k]) max[k] = position[i + k];
    }
  if (position.length === 0) min.fill(0), max.fill(0);
  return { position, normal, index, solid, lines, min, max, triangles: lines ? 0 : index.length / 3 };
}

export const identity = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);

export function multiply(a, b) {
  const c = new Float64Array(12);
  for (let i = 0; i < 12; i += 4) {
    for (let k = 0; k < 4; k++) c[i + k] = a[i] * b[k] + a[i + 1] * b[4 + k] + a[i + 2] * b[8 + k];
    c[i + 3] += a[i + 3];
  }
  return c;
}

export function determinant(m, o = 0) {
  return m[o] * (m[o + 5] * m[o + 10] - m[o + 6] * m[o + 9]) - m[o + 1] * (m[o + 4] * m[o + 10] - m[o + 6] * m[o + 8]) + m[o + 2] * (m[o + 4] * m[o + 9] - m[o + 5] * m[o + 8]);
}

// Returns a hash of the bytes of a picture, so that the picture is recognized after the model has changed.
function sumOf(bytes) {
  let sum = bytes.length;
  for (let i = 0; i < bytes.length; i++) sum = (31 * sum + bytes[i]) | 0;
  return sum;
}

const none = [];
const makesPath = (f) => f.origin !== undefined || f.kind !== undefined || !!(f.item || f.result || f.operation || f.cut);

// Counts the parts and paths below a node. A template counts at each use. { parts, paths } is kept at each node, and
// computed once. Templates with more than one use keep their counts as `again`.
function counted(root, nodes) {
  const used = new Set();
  for (const open = [root]; open.length > 0;) {
    const node = open[open.length - 1], children = node.use !== undefined ? nodes.get(node.use)?.children || none : node.children;
    if (!node.counted) {
      node.counted = { parts: 0, paths: 0, ready: false };
      for (const child of children) if (!child.counted) open.push(child);
      continue;
    }
    open.pop();
    if (node.counted.ready) continue;
    const sum = node.counted;
    sum.ready = true;
    if (node.use !== undefined) {
      const template = nodes.get(node.use);
      if (used.has(template)) template.again = sum;
      else if (template) used.add(template);
    }
    if (node.type === "Shape") sum.parts = 1;
    else for (const child of children) if (child.type !== "Template") sum.parts += child.counted.parts, sum.paths += child.counted.paths;
    if ((node.type === "Transform" || node.type === "Group") && makesPath(node.fields)) sum.paths++;
  }
  return root.counted;
}

// The parts and paths of a template, in arrays like those of a Model. They are copied to each use of the template. A
// layer INHERITED, and a paint or path 0, are replaced by those of the use.
const INHERITED = 0xffffffff;
function room(parts, paths) {
  return { count: 0, matrix: new Float64Array(12 * parts), geometry: new Uint32Array(parts), paint: new Uint32Array(parts), layer: new Uint32Array(parts), path: new Uint32Array(parts), kind: new Uint16Array(parts), made: new Uint32Array(parts),
    pathCount: 1, pathParent: new Uint32Array(1 + paths), pathOrigin: new Uint32Array(1 + paths), pathKind: new Uint16Array(1 + paths), roles: new Map(), cuts: new Set() };
}

// Copies a template's parts into the model, which has room for them. The matrix of the use is in the array `place` from
// index `at`.
function copyParts(from, to, place, at, paint, layer, path) {
  const { matrix, count } = from, into = to.matrix, first = to.count, before = to.pathCount - 1;
  const a = place[at], b = place[at + 1], c = place[at + 2], x = place[at + 3], d = place[at + 4], e = place[at + 5], f = place[at + 6], y = place[at + 7], g = place[at + 8], h = place[at + 9], l = place[at + 10], z = place[at + 11];
  for (let i = 0, o = 0, t = 12 * first; i < count; i++, o += 12, t += 12) {
    for (let k = 0; k < 3; k++) {
      const p = matrix[o + k], q = matrix[o + 4 + k], r = matrix[o + 8 + k];
      into[t + k] = a * p + b * q + c * r, into[t + 4 + k] = d * p + e * q + f * r, into[t + 8 + k] = g * p + h * q + l * r;
    }
    const p = matrix[o + 3], q = matrix[o + 7], r = matrix[o + 11];
    into[t + 3] = a * p + b * q + c * r + x, into[t + 7] = d * p + e * q + f * r + y, into[t + 11] = g * p + h * q + l * r + z;
  }
  for (let i = 0, t = first; i < count; i++, t++) {
    const own = from.paint[i], level = from.layer[i], way = from.path[i];
    to.paint[t] = own > 0 ? own : paint;
    to.layer[t] = level === INHERITED ? layer : level;
    to.path[t] = way > 0 ? before + way : path;
    to.geometry[t] = from.geometry[i], to.kind[t] = from.kind[i], to.made[t] = from.made[i];
  }
  to.count += count;
  for (let p = 1, t = before + 1; p < from.pathCount; p++, t++) {
    const parent = from.pathParent[p];
    to.pathParent[t] = parent > 0 ? before + parent : path;
    to.pathOrigin[t] = from.pathOrigin[p], to.pathKind[t] = from.pathKind[p];
  }
  to.pathCount += from.pathCount - 1;
  for (const i of from.cuts) to.cuts.add(first + i);
  for (const [p, role] of from.roles) to.roles.set(before + p, role);
}

// Makes a Model from the tree that readPacked returns. spare: a model that is no longer in use, whose arrays the new
// model takes over, or null.
export function modelFromPacked(root, spare = null) {
  const model = new Model(), nodes = new Map(), layers = new Map([["", 0]]), kinds = new Map([["", 0]]);
  const numbered = (map, list, word) => {
    let number = map.get(word);
    if (number === undefined) {
      number = list.length;
      map.set(word, number);
      list.push(word);
    }
    return number;
  };
  const geometryOf = (node) => {
    if (node.geometry === undefined) {
      const f = node.fields, lines = node.type === "LineSet";
      let normal = null;
      if (f.vector) normal = f.vector;
      node.geometry = model.geometries.length;
      model.geometries.push(makeGeometry(f.point, normal, lines ? null : f.index, !!f.solid, lines));
    }
    return node.geometry;
  };
  // Returns the data of a node that all walks need. They are computed once, because a million parts come from few
  // nodes.
  const stepOf = (node) => {
    const step = { children: none, place: null, paint: 0, layer: -1, path: false, origin: 0, kind: 0, role: "", cut: false, item: 0, geometry: -1, leaf: undefined, plain: false, template: null }, f = node.fields;
    node.step = step;
    if (node.use !== undefined) step.children = nodes.get(node.use)?.children || none, step.plain = true, step.template = nodes.get(node.use) || null;
    else if (node.type === "Transform" || node.type === "Group") {
      step.children = node.children;
      step.place = f.matrix || f.translation || null;
      step.role = f.item ? "item" : f.result ? "result" : f.operation ? "operation" : "";
      step.path = makesPath(f);
      step.item = f.item || 0;
    } else if (node.type === "Shape") {
      const used = nodes.get(node.children[0].use);
      if (used) step.geometry = geometryOf(used);
    }
    if (!f) return step;
    if (f.layer !== undefined) step.layer = numbered(layers, model.layers, f.layer);
    if (step.path || step.geometry >= 0) step.kind = numbered(kinds, model.kinds, f.kind || "");
    step.paint = f.paint || 0, step.origin = f.origin || 0, step.cut = !!f.cut;
    return step;
  };

  // An explicit stack, as arrays that are indexed by depth. Templates may be nested to any depth, and used a million
  // times.
  const lists = [], nexts = [], paints = [], layersAt = [], paths = [], placesAt = []; // placesAt: the index of the depth's place, which may be its parent's
  let places = Float64Array.from(identity), depth = -1;
  // Multiplies a place by that of the current depth. Returns the index of the product in `places`.
  const within = (place) => {
    const from = depth < 0 ? 0 : placesAt[depth], to = place ? from + 12 : from;
    if (places.length < to + 12) {
      const grown = new Float64Array(2 * places.length + 12 * 64);
      grown.set(places);
      places = grown;
    }
    if (place) {
      const p = places, whole = place.length !== 3;
      for (let k = 0; k < 12; k += 4) {
        const a = p[from + k], b = p[from + k + 1], c = p[from + k + 2], d = p[from + k + 3];
        if (whole) {
          p[to + k] = a * place[0] + b * place[4] + c * place[8];
          p[to + k + 1] = a * place[1] + b * place[5] + c * place[9];
          p[to + k + 2] = a * place[2] + b * place[6] + c * place[10];
          p[to + k + 3] = a * place[3] + b * place[7] + c * place[11] + d;
        } else {
          p[to + k] = a, p[to + k + 1] = b, p[to + k + 2] = c;
          p[to + k + 3] = d + (a * place[0] + b * place[1] + c * place[2]);
        }
      }
    }
    return to;
  };
  const push = (children, place, paint, layer, path) => {
    const to = within(place);
    depth++;
    lists[depth] = children, nexts[depth] = 0, paints[depth] = paint, layersAt[depth] = layer, paths[depth] = path, placesAt[depth] = to;
  };
  // Returns the step of a node's only shape, or null. Most nodes have a single shape, and then need no stack.
  const leafOf = (step) => {
    const alone = (list) => list.length === 1 ? list[0].step || stepOf(list[0]) : null;
    let leaf = alone(step.children);
    while (leaf && leaf.geometry < 0) leaf = leaf.plain ? alone(leaf.children) : null;
    return step.leaf = leaf;
  };
  const add = (to, leaf, at, paint, layer, path) => {
    const i = to.count++, m = to.matrix;
    for (let k = 0, o = 12 * i; k < 12; k++) m[o + k] = places[at + k];
    if (leaf.cut) to.cuts.add(i);
    to.geometry[i] = leaf.geometry, to.paint[i] = paint, to.layer[i] = layer, to.path[i] = path, to.kind[i] = leaf.kind, to.made[i] = leaf.origin;
  };
  // Adds the parts of nodes to the model or to a template's parts, which have room for them.
  const walk = (children, to, outerLayer) => {
    // Templates are walked inside another walk, when their parts are requested.
    const bottom = depth, still = depth < 0 ? 0 : placesAt[depth] + 12;
    push(children, identity, 0, outerLayer, 0);
    places.set(identity, placesAt[depth] = still);
    while (depth > bottom) {
      const list = lists[depth];
      if (nexts[depth] >= list.length) {
        depth--;
        continue;
      }
      const node = list[nexts[depth]++], step = node.step || stepOf(node), layer = step.layer < 0 ? layersAt[depth] : step.layer, paint = step.paint || paints[depth];
      if (step.geometry >= 0) add(to, step, placesAt[depth], paint, layer, paths[depth]);
      else if (to === model && step.template?.again) copyParts(step.template.copied || partsOf(step.template), to, places, placesAt[depth], paint, layer, paths[depth]);
      else {
        let path = paths[depth];
        if (step.path) {
          path = to.pathCount++;
          to.pathParent[path] = paths[depth], to.pathOrigin[path] = step.origin, to.pathKind[path] = step.kind;
        }
        if (step.role || step.cut) to.roles.set(path, { role: step.role, cut: step.cut, item: step.item });
        const leaf = step.leaf === undefined ? leafOf(step) : step.leaf;
        if (leaf) add(to, leaf, within(step.place), leaf.paint || paint, leaf.layer < 0 ? layer : leaf.layer, path);
        else push(step.children, step.place, paint, layer, path);
      }
    }
  };
  const partsOf = (template) => {
    const { parts, paths: own } = template.again;
    template.copied = room(parts, own);
    walk(template.children, template.copied, INHERITED);
    return template.copied;
  };
  // Geometries may be defined anywhere, even within templates that are used later.
  const define = (list) => {
    for (const open = [list]; open.length > 0;) {
      for (const node of open.pop()) {
        if (node.use !== undefined) continue;
        if (node.def >= 0) nodes.set(node.def, node);
        if (node.children.length > 0) open.push(node.children);
      }
    }
  };
  define(root.children);
  const { parts, paths: pathsMade } = counted(root, nodes);
  if (spare && !spare.kept) model.inherit(spare);
  model.grow(parts);
  model.growPaths(1 + pathsMade);
  for (const node of root.children) {
    const f = node.fields;
    switch (node.type) {
      case "WorldInfo": model.title = f.title; model.units = f.units; model.middle = Array.from(f.middle); break;
      case "Viewpoint": model.view = { eye: f.eye, target: f.target, up: f.up, parallel: !!f.parallel, width: f.width[0], angle: f.angle[0], aspect: f.aspect[0], given: !!f.given }; break;
      case "DirectionalLight": model.sun = { direction: Array.from(f.direction), given: !!f.given, off: !!f.off }; break;
      case "Background":
        if (f.skyColor) model.sky = Array.from(f.skyColor);
        if (f.table) model.daylight = { table: f.table, columns: f.columns, rows: f.rows, sun: f.sun, level: f.level };
        break;
      case "Ground": model.ground = { z: f.z[0], paint: f.paint || 0 }; break;
      case "PhysicalMaterial": model.materials.push({ name: f.name, color: Array.from(f.baseColor), roughness: f.roughness[0], metallic: f.metallic[0], transparency: f.transparency[0], ior: f.ior[0], pattern: f.pattern ? { name: f.pattern, color: Array.from(f.patternColor), size: f.patternSize[0], angle: f.patternAngle[0], picture: f.picture ? { sum: sumOf(f.picture), type: f.pictureType, bytes: f.picture, height: f.pictureHeight[0] } : null } : null }); break;
      case "Origins": model.origins = { files: f.file || [], at: f.at }; break;
      default: if (node.use !== undefined || node.type === "Transform" || node.type === "Group") walk([node], model, 0);
    }
  }
  return model.measure();
}
