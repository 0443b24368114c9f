// node families.mjs FOLDER: writes the families in which many solids lie in one place to FOLDER/sx, one file for each
// member; run.sh takes them by name. Deterministic.
//   spheres  N spheres of 4,096 triangles about one centre, turned by i * 1e-5 radians about an oblique axis
//   balls    the same, of 256 triangles each
//   boxes    N boxes about one centre, turned by up to 0.01 degrees about each axis
//   rods     N rods of 16 sides through one point
//   wedges   N thin wedges around one axis, each overlapping its two neighbours on either side
//   screw    N boxes that climb around one axis, fifty of them above each point
//   holes    a block from which the rods are subtracted
//   cone     a cone of N sides, all of which meet in one vertex; in its union with a box there
import fs from 'fs';
const out = (process.argv[2] || '.') + '/sx/';
fs.mkdirSync(out, { recursive: true });
let seed = 7;
const random = () => { // xorshift32
  seed ^= seed << 13; seed >>>= 0; seed ^= seed >>> 17; seed ^= seed << 5; seed >>>= 0; return seed / 4294967296; };
const text = x => (+x).toFixed(12).replace(/\.?0+$/, '').replace(/^-0$/, '0');
const node = (name, numbers, ...kids) => `(${name}${numbers.map(x => ' ' + text(x)).join('')}${kids.length ? ' ' + kids.join('\n ') : ''})`;
const list = (n, make) => { seed = 7; return Array.from({ length: n }, (_, i) => make(i)); };
const write = (name, n, root) => fs.writeFileSync(`${out}${name}_${n}.sx`, root + '\n');

const degrees = 180 / Math.PI, s = Math.SQRT1_2;
const sphere = sides => i => { // about (1, 1, 0): columns of Rodrigues' matrix
  const a = i * 1e-5, c = Math.cos(a), t = 1 - c, k = Math.sin(a) * s;
  return node('multmatrix', [c + t / 2, t / 2, k, 0, t / 2, c + t / 2, -k, 0, -k, k, c, 0], `(sphere 10 ${sides})`); };
const box = () => node('rotate', [0, 0, 0].map(() => (2 * random() - 1) * 0.01), node('translate', [-5, -5, -5], '(box 10 10 10)'));
const rod = () => node('rotate', [0, degrees * Math.acos(2 * random() - 1), 360 * random()], node('translate', [0, 0, -10], '(cyl 20 0.3 0.3 16)'));
const wedge = (i, n) => node('rotate', [0, 0, 360 * i / n], node('scale', [10 / 1.5, 100 * Math.PI / n / Math.sqrt(0.75) / 5 * 1.2, 5], node('translate', [1, 0, 0], node('rotate', [0, 0, 180], '(cyl 1 1 1 3)'))));
const step = i => node('translate', [0, 0, i * 0.02], node('rotate', [0, 0, 3.7 * i], node('translate', [-1, -0.5, 0], '(box 10 1 1)')));
for (const n of [25, 50, 100]) write('spheres', n, node('union', [], ...list(n, sphere(64))));
for (const n of [50, 100, 200]) write('balls', n, node('union', [], ...list(n, sphere(16))));
for (const n of [50, 100, 200, 400]) write('boxes', n, node('union', [], ...list(n, box)));
for (const n of [100, 200, 400]) write('rods', n, node('union', [], ...list(n, rod)));
for (const n of [250, 500, 1000]) write('wedges', n, node('union', [], ...list(n, i => wedge(i, n))));
for (const n of [250, 500, 1000]) write('screw', n, node('union', [], ...list(n, step)));
for (const n of [100, 200]) write('holes', n, node('difference', [], node('translate', [-4, -4, -4], '(box 8 8 8)'), ...list(n, rod)));
for (const n of [8000, 32000, 100000]) write('cone', n, node('union', [], `(cyl 10 5 0 ${n})`, node('translate', [0, 0, 10], '(box 1 1 1)')));
