// Owns Manifold's side of bench/handover.sh: node handover.mjs MODULE_FOLDER sphere|boxes
// One line: triangles, MB of the arrays that getMesh returns, processor seconds from the solids to these, and of
// getMesh alone.
import path from 'path';
import { pathToFileURL } from 'url';
const [, , folder, what] = process.argv;
const module = path.resolve(folder, 'node_modules/manifold-3d/manifold.js');
const wasm = await (await import(pathToFileURL(module).href)).default();
wasm.setup();
const { Manifold } = wasm;
const seconds = () => { const u = process.cpuUsage(); return (u.user + u.system) / 1e6; };
function solid() {
  if (what === 'sphere') return Manifold.sphere(1, 1440);
  const box = Manifold.cube([1, 1, 1]), all = [];
  for (let i = 0; i < 10000; i++)
    all.push(box.scale([1, 1, 1 + (i % 7)]).translate([2 * (i % 100), 2 * Math.floor(i / 100), 0]));
  return Manifold.compose(all);
}
const began = seconds(), made = solid();
made.numTri(); // worked out here
const asked = seconds(), mesh = made.getMesh(), end = seconds();
const bytes = mesh.vertProperties.byteLength + mesh.triVerts.byteLength;
console.log(mesh.triVerts.length / 3, (bytes / 1e6).toFixed(1), (end - began).toFixed(3), (end - asked).toFixed(3));
