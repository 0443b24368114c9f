// Owns the model as the viewer holds it: geometries, materials, and one flat list of parts, each a geometry at a place.
//
// A part has the origin of its own constructor call, and a path: the operations of the source that it came through, from the inside outwards.
// A path has a parent, an origin and a kind; parts that stand in one operation share their path. There may be a million of each: all are arrays
// of numbers.

export class Model {
  constructor() {
    this.title = "model";
    this.units = "m";
    this.middle = [0, 0, 0]; // All places of parts are relative to it.
    this.view = null;
    this.sun = null;
    this.sky = null;
    this.daylight = null; // The physical sky: a table of its light, the sun's, and what a level surface gets.
    this.ground = null;
    this.materials = [plain()]; // Number 0 is that of parts without a material.
    this.layers = [""];
    this.kinds = [""];
    this.geometries = [];
    this.origins = { files: [], at: new Uint32Array(0) };
    this.pathCount = 1; // Number 0 is the drawing itself.
    this.pathParent = new Uint32Array(64);
    this.pathOrigin = new Uint32Array(64);
    this.pathKind = new Uint16Array(64);
    this.roles = new Map(); // Of a scene that shows how it is made (timeline.js): what a path stands for.
    this.cuts = new Set(); // And the parts that are taken away.
    this.count = 0;
    this.matrix = new Float32Array(12 * 64);
    this.geometry = new Uint32Array(64);
    this.paint = new Uint32Array(64);
    this.layer = new Uint32Array(64);
    this.path = new Uint32Array(64);
    this.kind = new Uint16Array(64);
    this.made = new Uint32Array(64); // The number of its origin, or 0.
  }

  get metres() { return { mm: 0.001, cm: 0.01, in: 0.0254, ft: 0.3048 }[this.units] || 1; } // How many metres a length of 1 is.

  grow(need) {
    if (need <= this.geometry.length) return;
    const room = Math.max(need, 2 * this.geometry.length);
    for (const key of ["geometry", "paint", "layer", "path", "kind", "made", "matrix"]) {
      const was = this[key], now = new was.constructor(key === "matrix" ? 12 * room : room);
      now.set(was);
      this[key] = now;
    }
  }

  growPaths(need) {
    if (need <= this.pathParent.length) return;
    const room = Math.max(need, 2 * this.pathParent.length);
    for (const key of ["pathParent", "pathOrigin", "pathKind"]) {
      const was = this[key];
      this[key] = new was.constructor(room);
      this[key].set(was);
    }
  }

  addPath(parent, origin, kind) {
    const p = this.pathCount++;
    this.growPaths(p + 1);
    this.pathParent[p] = parent;
    this.pathOrigin[p] = origin;
    this.pathKind[p] = kind;
    return p;
  }

  // m from its number `at` on: three rows of an affine map.
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

  // Bounds of each part as a ball, and of everything as a box; relative to the middle.
  measure() {
    const n = this.count, m = this.matrix, ball = this.ball = new Float32Array(4 * n);
    this.box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
    const { min, max } = this.box;
    for (let i = 0, o = 0; i < n; i++, o += 12) {
      const g = this.geometries[this.geometry[i]];
      let square = 0;
      for (let k = 0; k < 3; k++) {
        const r = o + 4 * k;
        let low = m[r + 3], high = low;
        for (let c = 0; c < 3; c++) {
          const a = m[r + c] * g.min[c], b = m[r + c] * g.max[c];
          if (a < b) low += a, high += b;
          else low += b, high += a;
        }
        if (low < min[k]) min[k] = low;
        if (high > max[k]) max[k] = high;
        ball[4 * i + k] = (low + high) / 2;
        square += (high - low) * (high - low);
      }
      ball[4 * i + 3] = Math.sqrt(square) / 2;
    }
    if (n === 0) this.box = { min: [-1, -1, -1], max: [1, 1, 1] };
    this.size = [0, 1, 2].map((k) => this.box.max[k] - this.box.min[k]);
    this.diagonal = Math.hypot(...this.size) || 1;
    this.outer = null;
    return this;
  }

  // Points that everything lies between, three numbers each: all corners of the parts' triangles, of large models the corners of the parts' boxes, of
  // very large ones those of the one box. A dome fills its box in no direction but six, and is framed by its own points.
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

  // The places in the source that made part i: { file, line, column, number } from the innermost call outwards.
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

// The box of several models, about a middle.
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

// A number of the bytes, by which a picture is known again when the model has changed.
function sumOf(bytes) {
  let sum = bytes.length;
  for (let i = 0; i < bytes.length; i++) sum = (31 * sum + bytes[i]) | 0;
  return sum;
}

const none = [];
const makesPath = (f) => f.origin !== undefined || f.kind !== undefined || !!(f.item || f.result || f.operation || f.cut);

// How many parts and paths there are below a node, a template's as often as it is used. { parts, paths } is kept at each node, and counted once.
function counted(root, nodes) {
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
    if (node.type === "Shape") sum.parts = 1;
    else for (const child of children) sum.parts += child.counted.parts, sum.paths += child.counted.paths;
    if ((node.type === "Transform" || node.type === "Group") && makesPath(node.fields)) sum.paths++;
  }
  return root.counted;
}

// Makes a Model of the tree that readPacked returns.
export function modelFromPacked(root) {
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
  // What a node does, told once however often it is walked over: a million parts are made of few nodes.
  const stepOf = (node) => {
    const step = { children: none, place: null, paint: 0, layer: -1, path: false, origin: 0, kind: 0, role: "", cut: false, item: 0, geometry: -1, leaf: undefined, plain: false }, f = node.fields;
    node.step = step;
    if (node.use !== undefined) step.children = nodes.get(node.use)?.children || none, step.plain = true;
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

  // A stack of its own, in arrays by depth: templates may be nested as deeply as the user likes, and used a million times.
  const lists = [], nexts = [], paints = [], layersAt = [], paths = [], placesAt = []; // placesAt: where the depth's place begins, which may be its parent's
  let places = Float64Array.from(identity), depth = -1;
  // Works a place out within that of the depth at hand; where it begins.
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
  // The step of the one shape that a node places, as most nodes do: it goes without the stack.
  const leafOf = (step) => {
    const alone = (list) => list.length === 1 ? list[0].step || stepOf(list[0]) : null;
    let leaf = alone(step.children);
    while (leaf && leaf.geometry < 0) leaf = leaf.plain ? alone(leaf.children) : null;
    return step.leaf = leaf;
  };
  const walk = (children) => {
    depth = -1;
    push(children, null, 0, 0, 0);
    while (depth >= 0) {
      const list = lists[depth];
      if (nexts[depth] >= list.length) {
        depth--;
        continue;
      }
      const node = list[nexts[depth]++], step = node.step || stepOf(node), layer = step.layer < 0 ? layersAt[depth] : step.layer, paint = step.paint || paints[depth];
      if (step.geometry >= 0) {
        if (step.cut) model.cuts.add(model.count);
        model.add(step.geometry, places, placesAt[depth], paint, layer, paths[depth], step.kind, step.origin);
      } else {
        const path = step.path ? model.addPath(paths[depth], step.origin, step.kind) : paths[depth];
        if (step.role || step.cut) model.roles.set(path, { role: step.role, cut: step.cut, item: step.item });
        const leaf = step.leaf === undefined ? leafOf(step) : step.leaf;
        if (leaf) {
          if (leaf.cut) model.cuts.add(model.count);
          const to = within(step.place); // Which may move the places: this comes first.
          model.add(leaf.geometry, places, to, leaf.paint || paint, leaf.layer < 0 ? layer : leaf.layer, path, leaf.kind, leaf.origin);
        } else push(step.children, step.place, paint, layer, path);
      }
    }
  };
  // Geometries may be defined anywhere, also within templates that are used later.
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
  model.grow(parts);
  model.growPaths(1 + pathsMade);
  for (const node of root.children) {
    const f = node.fields;
    switch (node.type) {
      case "WorldInfo": model.title = f.title; model.units = f.units; model.middle = Array.from(f.middle); break;
      case "Viewpoint": model.view = { eye: f.eye, target: f.target, up: f.up, parallel: !!f.parallel, width: f.width[0], angle: f.angle[0], aspect: f.aspect[0], given: !!f.given }; break;
      case "DirectionalLight": model.sun = { direction: Array.from(f.direction), given: !!f.given }; break;
      case "Background":
        if (f.skyColor) model.sky = Array.from(f.skyColor);
        if (f.table) model.daylight = { table: f.table, columns: f.columns, rows: f.rows, sun: f.sun, level: f.level };
        break;
      case "Ground": model.ground = { z: f.z[0], paint: f.paint || 0 }; break;
      case "PhysicalMaterial": model.materials.push({ name: f.name, color: Array.from(f.baseColor), roughness: f.roughness[0], metallic: f.metallic[0], transparency: f.transparency[0], ior: f.ior[0], pattern: f.pattern ? { name: f.pattern, color: Array.from(f.patternColor), size: f.patternSize[0], angle: f.patternAngle[0], picture: f.picture ? { sum: sumOf(f.picture), type: f.pictureType, bytes: f.picture, height: f.pictureHeight[0] } : null } : null }); break;
      case "Origins": model.origins = { files: f.file || [], at: f.at }; break;
      default: if (node.use !== undefined || node.type === "Transform" || node.type === "Group") walk([node]);
    }
  }
  return model.measure();
}
