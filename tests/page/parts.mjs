// Owns the test of turning the packed tree into a model's parts, and these into objects to draw: templates within
// templates equal their expansion one by one, arrays of an old model are used for the next, and of very many copies
// each is drawn once, within its bounding ball.
import * as THREE from "three";
import { Model, modelFromPacked } from "../../backends/page/model.js";
import { buildBatches, mergeParts } from "../../backends/page/batches.js";
import { boxForm } from "../../backends/page/forms.js";

let seed = 11;
const random = (n) => (seed = seed * 48271 % 2147483647) % n;
function check(name, faults) {
  console.log(`${faults.length === 0 ? "ok" : "not ok"} page/parts:${name}`);
  for (const fault of faults.slice(0, 5)) console.log("    " + fault);
}

// ---- a tree of templates ----

const node = (type, fields, children = [], def = -1) => ({ type, def, fields, children }), use = (number) => ({ use: number });
const SHAPES = 3, FIRST = 1000;
function tree(templates, wide) {
  const root = node("Scene", {});
  for (let k = 0; k < SHAPES; k++) root.children.push(node("IndexedTriangleSet", { point: Float32Array.of(k, 0, 0, k + 1, 0, 0, 0, 1, k), vector: new Int16Array(9), index: Uint32Array.of(0, 1, 2), solid: 1 }, [], FIRST + k));
  for (let k = 0; k < 3; k++) root.children.push(node("PhysicalMaterial", { name: "m" + k, baseColor: [0, 0, k / 3], roughness: [1], metallic: [0], transparency: [0], ior: [1.5] }));
  const shape = () => node("Shape", { ...(random(2) && { paint: 1 + random(3) }), ...(random(3) === 0 && { layer: "l" + random(3) }), ...(random(2) && { origin: 1 + random(50) }), kind: "k" + random(4), ...(random(5) === 0 && { cut: 1 }) }, [use(FIRST + random(SHAPES))]);
  const place = () => random(3) === 0 ? { matrix: Float64Array.from({ length: 12 }, (_, k) => (k % 5 === 0 ? 1 : 0) + (random(100) - 50) / 100) } : random(2) ? { translation: Float64Array.of(random(9), random(9), random(9)) } : {};
  const inner = (below) => node(random(2) ? "Transform" : "Group", { ...place(), ...(random(3) === 0 && { paint: 1 + random(3) }), ...(random(4) === 0 && { layer: "l" + random(3) }), ...(random(2) && { origin: 1 + random(50), kind: "o" + random(3) }),
    ...(random(6) === 0 && { operation: 1 }) }, [random(3) > 0 && below > 0 ? use(random(below)) : shape(), ...(random(2) ? [shape()] : [])]);
  for (let t = 0; t < templates; t++) root.children.push(node("Template", {}, Array.from({ length: 1 + random(3) }, () => inner(t)), t));
  root.children.push(node("Group", {}, Array.from({ length: wide }, () => inner(templates))));
  return root;
}
// Expands the tree in the slow way: a word for each part.
function slowly(root) {
  const defs = new Map(), found = [], E = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
  for (const child of root.children) if (child.def >= 0) defs.set(child.def, child);
  const within = (a, f) => {
    const b = f.matrix || (f.translation ? [1, 0, 0, f.translation[0], 0, 1, 0, f.translation[1], 0, 0, 1, f.translation[2]] : E), c = [];
    for (let i = 0; i < 12; i += 4) for (let k = 0; k < 4; k++) c.push(a[i] * b[k] + a[i + 1] * b[4 + k] + a[i + 2] * b[8 + k] + (k === 3 ? a[i + 3] : 0));
    return c;
  };
  const walk = (n, m, paint, layer, path) => {
    if (n.use !== undefined) return defs.get(n.use).children.forEach((child) => walk(child, m, paint, layer, path));
    const f = n.fields;
    paint = f.paint || paint, layer = f.layer ?? layer;
    if (n.type === "Shape") return found.push({ m, said: [defs.get(n.children[0].use).fields.point[0], paint, layer, f.kind, f.origin || 0, !!f.cut, ...path].join(" ") });
    if (f.origin !== undefined || f.kind !== undefined || f.operation) path = [`${f.origin || 0}/${f.kind || ""}/${f.operation ? "operation" : ""}`, ...path];
    n.children.forEach((child) => walk(child, within(m, f), paint, layer, path));
  };
  for (const child of root.children) if (child.type === "Group" || child.type === "Transform") walk(child, E, 0, "", []);
  return found;
}
function told(model, i) {
  const path = [];
  for (let p = model.path[i]; p > 0; p = model.pathParent[p]) path.push(`${model.pathOrigin[p]}/${model.kinds[model.pathKind[p]]}/${model.roles.get(p)?.role || ""}`);
  return [model.geometries[model.geometry[i]].position[0], model.paint[i], model.layers[model.layer[i]], model.kinds[model.kind[i]], model.made[i], model.cuts.has(i), ...path].join(" ");
}
function compared(model, root) {
  const want = slowly(root), faults = [];
  if (model.count !== want.length) return [`${model.count} parts, not ${want.length}`];
  for (let i = 0; i < want.length; i++) {
    const got = told(model, i), { m, said } = want[i], apart = Math.max(...m.map((x, k) => Math.abs(x - model.matrix[12 * i + k]) / (1 + Math.abs(x))));
    if (got !== said) faults.push(`part ${i}: ${got}, not ${said}`);
    if (!(apart < 1e-6)) faults.push(`part ${i} lies off by ${apart}`);
  }
  return faults;
}
{
  const faults = [];
  let parts = 0, spare = null;
  for (let round = 0; round < 60; round++) {
    const root = tree(1 + random(9), 1 + random(40)), model = modelFromPacked(root, spare);
    faults.push(...compared(model, root).map((f) => `tree ${round}: ${f}`));
    parts += model.count;
    spare = random(3) ? model : null;
  }
  if (parts < 5000) faults.push(`only ${parts} parts were looked at`);
  check("templates within templates", faults);
}
{
  const root = tree(4, 20), first = modelFromPacked(root);
  first.kept = true;
  modelFromPacked(tree(4, 20), first);
  check("a model that somebody looks at keeps its arrays", first.matrix ? compared(first, root) : ["they are gone"]);
}

// ---- very many copies ----

{
  const root = node("Scene", {}), copies = 60000, faults = [];
  root.children.push(node("IndexedTriangleSet", { point: Float32Array.of(-1, -1, -1, 1, 1, 1, 1, -1, 1), vector: new Int16Array(9), index: Uint32Array.of(0, 1, 2), solid: 1 }, [], FIRST));
  root.children.push(node("Group", {}, Array.from({ length: copies }, () => node("Transform", { matrix: Float64Array.of(...[0, 1, 2].flatMap((k) => [0, 1, 2].map((c) => c === k ? 1 : 0).concat(random(2) ? random(900) : 900 * (random(1000) / 1000) ** 6))) },
    [node("Shape", {}, [use(FIRST)])]))));
  const model = modelFromPacked(root), plain = new THREE.MeshBasicMaterial(), batches = buildBatches(model, (i) => i % 7 > 0, { get: () => plain }, { merged: plain, instanced: plain }), places = new Map();
  for (let i = 0; i < model.count; i++) if (i % 7 > 0) { const at = [3, 7, 11].map((k) => model.matrix[12 * i + k]).join(); places.set(at, (places.get(at) || 0) + 1); }
  let things = 0, most = 0;
  batches.traverse((o) => {
    if (!o.isMesh || !o.isInstancedMesh) return;
    o.userData.fill();
    things++;
    most = Math.max(most, o.count);
    const { center, radius } = o.boundingSphere;
    for (let k = 0; k < o.count; k++) {
      const at = [12, 13, 14].map((c) => o.instanceMatrix.array[16 * k + c]), left = places.get(at.join());
      if (!left) faults.push(`at ${at} one too many`);
      places.set(at.join(), left - 1);
      if (Math.hypot(at[0] - center.x, at[1] - center.y, at[2] - center.z) > radius) faults.push(`at ${at} one lies outside of what is told of it`);
    }
  });
  const missing = [...places.values()].filter((left) => left !== 0).length;
  if (missing > 0) faults.push(`${missing} places are not drawn`);
  if (most > 4096 || things < 14 || things > 60) faults.push(`${things} things to draw of ${most} copies at most`);
  check("very many copies", faults);
}

// ---- seams: no line is drawn between two bodies of one colour that continue each other ----

{
  const faults = [];
  // Two boxes side by side, the second higher by `higher`, of this paint, at the distance `apart`: returns the number
  // of visible lines of their 24.
  const lines = (paint, higher = 0, apart = 0) => {
    const model = new Model();
    model.materials.push({ ...model.materials[0], color: [1, 0, 0] });
    model.geometries.push(boxForm(1, 1, 1));
    for (const k of [0, 1]) model.add(0, [1, 0, 0, k * (1 + apart), 0, 1, 0, 0, 0, 0, 1 + k * higher, k * higher / 2], 0, k * paint, 0, 0, 0, 0);
    const { edgeColor } = mergeParts(model.measure(), [0, 1]);
    let shown = 0;
    for (let k = 3; k < edgeColor.length; k += 8) if (edgeColor[k] > 0) shown++;
    return shown;
  };
  for (const [what, got, want] of [["two alike", lines(0), 16], ["of two colours", lines(1), 24], ["one higher", lines(0, 1), 22], ["a gap between them", lines(0, 0, 0.1), 24]]) if (got !== want) faults.push(`${what}: ${got} lines show, not ${want}`);
  check("seams", faults);
}
