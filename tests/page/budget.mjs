// Owns the test of the parts that a page omits when the model exceeds a picture's limit: near objects stay, also those
// whose copies are far apart.
import * as THREE from "three";
import { leaveOut } from "../../backends/page/batches.js";

const camera = new THREE.PerspectiveCamera(40, 1.5, 0.1, 2000);
camera.position.set(0, 0, 2);
camera.lookAt(500, 0, 2);
camera.updateMatrixWorld();
camera.updateProjectionMatrix();

// Makes copies of an object of radius `most`, from `from` to `to` along the street that the camera looks down.
function batch(from, to, most, cost, edges = false) {
  const o = new THREE.Object3D(), sphere = new THREE.Sphere(new THREE.Vector3((from + to) / 2, 0, 1), (to - from) / 2 + most);
  o.userData = { around: { sphere, most }, edges, spacing: most, casts: true, cost };
  return o;
}
function left(things, most, lined = true) {
  const root = new THREE.Group();
  root.userData.merged = 1000;
  for (const o of Object.values(things)) root.add(o);
  leaveOut(root, { camera, pixels: (distance) => 900 / Math.max(1e-9, distance), across: 0.01, lined, lit: false, most });
  return Object.keys(things).filter((name) => !things[name].visible).join(" ");
}
function check(name, got, want) {
  console.log(`${got === want ? "ok" : "not ok"} page/budget:${name}`);
  if (got !== want) console.log(`    left out: ${got}, not ${want}`);
}

const street = () => ({ bark: batch(-20, 900, 0.3, 1000), near: batch(5, 60, 0.4, 40000), middle: batch(150, 300, 0.4, 40000), far: batch(500, 900, 0.4, 40000), lines: batch(-20, 900, 0.3, 2000, true) });
check("all that there is room for", left(street(), 1e6), "");
check("the farthest goes before a piece of bark at hand", left(street(), 90000), "far");
check("and the next", left(street(), 50000), "middle far");
check("lines before the faces that they lie on", left({ faces: batch(5, 60, 0.4, 3000), lines: batch(5, 60, 0.4, 3000, true) }, 5000), "lines");
check("behind the camera nothing counts", left({ behind: batch(-900, -500, 0.4, 90000), near: batch(5, 60, 0.4, 40000) }, 50000), "");
check("less than half a pixel", left({ dust: batch(800, 900, 0.2, 10), near: batch(5, 60, 0.4, 40000) }, 1e6), "dust");
