// The gyroid of gyroid.vs by Manifold's levelSet, marching tetrahedra: node gyroid.mjs MODULE_FOLDER CELLS; fewer than
// 2 cells: loads the module only.
import path from 'path';
import { pathToFileURL } from 'url';
const [, , folder, cells] = process.argv;
const wasm = await (await import(pathToFileURL(path.resolve(folder, 'node_modules/manifold-3d/manifold.js')).href)).default();
wasm.setup();
const { sin, cos, PI } = Math;
if (cells > 1) {
  const solid = wasm.Manifold.levelSet(([x, y, z]) => -(sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x)),
    { min: [0, 0, 0], max: [2 * PI, 2 * PI, 2 * PI] }, 2 * PI / cells, 0);
  console.log(solid.numTri(), solid.volume());
}
