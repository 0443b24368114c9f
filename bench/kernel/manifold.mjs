// Owns Manifold's side of the comparison: evaluates a workload with manifold-3d. node manifold.mjs MODULE_FOLDER
// FILE.sx
// It uses the same facets as vs: spheres, tori and stars are handed over as meshes, boxes and cylinders by Manifold's
// own constructors; sets as batches. Prints one line of JSON: seconds from the parsed tree to the triangles in
// JavaScript's memory, their number, and whether they are closed by coordinates.
import fs from 'fs';
import path from 'path';
import { pathToFileURL } from 'url';
const [, , folder, file] = process.argv;
const wasm = await (await import(pathToFileURL(path.resolve(folder, 'node_modules/manifold-3d/manifold.js')).href)).default();
wasm.setup();
const { Manifold, Mesh } = wasm;

const tokens = fs.readFileSync(file, 'utf8').replace(/;[^\n]*/g, '').match(/[()]|[^\s()]+/g);
let at = 0;
const stack = [[]];
for (; at < tokens.length; at++) { // no recursion: chains are hundreds deep
  if (tokens[at] === '(') stack.push([]);
  else if (tokens[at] === ')') { const list = stack.pop(); stack.at(-1).push(list); }
  else stack.at(-1).push(isNaN(tokens[at]) ? tokens[at] : Number(tokens[at]));
}
const program = stack[0], defined = new Map();

const mesh = (points, faces) => ({ numProp: 3, vertProperties: Float32Array.from(points.flat()), triVerts: Uint32Array.from(faces.flat()) });
function sphere(r, n) {
  const b = Math.floor(n / 2), top = 1 + (b - 1) * n, p = [[0, 0, -r]], f = [];
  for (let j = 1; j < b; j++) for (let i = 0; i < n; i++) {
    const t = Math.PI * j / b, u = 2 * Math.PI * i / n;
    p.push([r * Math.sin(t) * Math.cos(u), r * Math.sin(t) * Math.sin(u), -r * Math.cos(t)]); }
  p.push([0, 0, r]);
  const v = (j, i) => 1 + j * n + i % n;
  for (let i = 0; i < n; i++) { f.push([0, v(0, i + 1), v(0, i)], [top, v(b - 2, i), v(b - 2, i + 1)]);
    for (let j = 0; j < b - 2; j++) f.push([v(j, i), v(j, i + 1), v(j + 1, i + 1)], [v(j, i), v(j + 1, i + 1), v(j + 1, i)]); }
  return mesh(p, f); }
function torus(R, r, n, m) {
  const p = [], f = [], v = (i, j) => (i % n) * m + j % m;
  for (let i = 0; i < n; i++) for (let j = 0; j < m; j++) {
    const u = 2 * Math.PI * i / n, w = 2 * Math.PI * j / m, d = R + r * Math.cos(w);
    p.push([d * Math.cos(u), d * Math.sin(u), r * Math.sin(w)]); f.push([v(i, j), v(i + 1, j), v(i + 1, j + 1)], [v(i, j), v(i + 1, j + 1), v(i, j + 1)]); }
  return mesh(p, f); }
function star(ro, ri, k2, h, tw, s) {
  const k = 2 * k2, p = [], f = [], low = (s + 1) * k, v = (l, i) => l * k + i % k;
  for (let l = 0; l <= s; l++) for (let i = 0; i < k; i++) {
    const a = Math.PI / 180 * (180 * i / k2 + tw * l / s), q = i % 2 ? ri : ro; p.push([q * Math.cos(a), q * Math.sin(a), h * l / s]); }
  p.push([0, 0, 0], [0, 0, h]);
  for (let i = 0; i < k; i++) { f.push([low, v(0, i + 1), v(0, i)], [low + 1, v(s, i), v(s, i + 1)]);
    for (let l = 0; l < s; l++) f.push([v(l, i), v(l, i + 1), v(l + 1, i + 1)], [v(l, i), v(l + 1, i + 1), v(l + 1, i)]); }
  return mesh(p, f); }

const rows = a => [a[0], a[4], a[8], 0, a[1], a[5], a[9], 0, a[2], a[6], a[10], 0, a[3], a[7], a[11], 1]; // column by column
const facets = new Map(); // of a node: made before the clock starts, as they are for us
function make(node, kids) {
  const [op, ...rest] = node;
  const n = rest.filter(x => typeof x === 'number');
  switch (op) {
    case 'box': return Manifold.cube(n); case 'cbox': return Manifold.cube(n, true);
    case 'cyl': return Manifold.cylinder(n[0], n[1], n[2], n[3]);
    case 'sphere': case 'torus': case 'startwist': return Manifold.ofMesh(new Mesh(facets.get(node)));
    case 'translate': return kids[0].translate(n); case 'rotate': return kids[0].rotate(n); case 'scale': return kids[0].scale(n);
    case 'multmatrix': return kids[0].transform(rows(n));
    case 'union': return Manifold.union(kids);
    case 'difference': return kids.length > 1 ? Manifold.difference(kids) : kids[0];
    case 'intersection': return Manifold.intersection(kids); }
  throw Error(op); }
function evaluate(root) { // depth first, by a stack of its own
  const work = [{ node: root, kids: [], next: 0, list: root.filter(Array.isArray) }];
  for (;;) {
    const top = work.at(-1);
    let made;
    if (top.node[0] === 'use') made = defined.get(top.node[1]);
    else if (top.next < top.list.length) { const child = top.list[top.next++]; work.push({ node: child, kids: [], next: 0, list: child.filter(Array.isArray) }); continue; }
    else made = make(top.node, top.kids);
    work.pop();
    if (!work.length) return made;
    work.at(-1).kids.push(made);
  } }

const shapes = { sphere, torus, startwist: star }, walk = [...program];
while (walk.length) { const node = walk.pop(); if (shapes[node[0]]) facets.set(node, shapes[node[0]](...node.slice(1))); else walk.push(...node.filter(Array.isArray)); }
const begin = process.cpuUsage();
let result;
for (const form of program) { if (form[0] === 'def') defined.set(form[1], evaluate(form[2])); else result = evaluate(form); }
const out = result.getMesh(), spent = process.cpuUsage(begin), seconds = (spent.user + spent.system) / 1e6;
const place = new Map(), id = new Uint32Array(out.numVert), edges = new Map(); // closed: each directed edge has its opposite
for (let i = 0; i < out.numVert; i++) { const key = out.vertProperties.slice(i * out.numProp, i * out.numProp + 3).join(); if (!place.has(key)) place.set(key, i); id[i] = place.get(key); }
for (let i = 0; i < out.triVerts.length; i++) { const a = id[out.triVerts[i]], b = id[out.triVerts[i % 3 === 2 ? i - 2 : i + 1]]; if (a === b) continue;
  const key = a < b ? a * 4294967296 + b : b * 4294967296 + a; edges.set(key, (edges.get(key) || 0) + (a < b ? 1 : -1)); }
let open = 0; for (const n of edges.values()) if (n) open++;
console.log(JSON.stringify({ seconds, triangles: out.numTri, closed: open === 0, volume: result.volume() }));
