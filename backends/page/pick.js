// Finds the part of the model under a point of the picture. First tests the parts' bounding spheres, then the triangles
// of the parts whose spheres the ray intersects.
import * as THREE from "three";

const ray = new THREE.Raycaster(), pointer = new THREE.Vector2();

export function rayAt(stage, x, y) {
  pointer.set(2 * x / stage.canvas.clientWidth - 1, 1 - 2 * y / stage.canvas.clientHeight);
  ray.setFromCamera(pointer, stage.camera);
  return ray.ray;
}

// Returns the nearest intersection of the ray through (x, y) with a part: { part, point, normal, triangle, distance },
// or null.
export function pick(stage, x, y) {
  const model = stage.model;
  if (!model || !stage.camera) return null;
  const { origin, direction } = rayAt(stage, x, y), ball = model.ball, near = [];
  for (let i = 0; i < model.count; i++) {
    const dx = ball[4 * i] - origin.x, dy = ball[4 * i + 1] - origin.y, dz = ball[4 * i + 2] - origin.z, r = ball[4 * i + 3];
    const along = dx * direction.x + dy * direction.y + dz * direction.z, off = dx * dx + dy * dy + dz * dz - along * along;
    if (off > r * r || (stage.shown && !stage.shown(i))) continue;
    const half = Math.sqrt(Math.max(0, r * r - off));
    if (stage.camera.isOrthographicCamera || along + half > 0) near.push([along - half, i]);
  }
  near.sort((a, b) => a[0] - b[0]);
  let best = null;
  for (const [from, i] of near) {
    if (best && from > best.distance) break;
    best = hitPart(stage, model, i, origin, direction, best) || best;
  }
  return best;
}

function hitPart(stage, model, i, origin, direction, best) {
  const g = model.geometries[model.geometry[i]];
  if (g.lines) return null;
  const m = model.matrix.subarray(12 * i, 12 * i + 12);
  const place = new THREE.Matrix4().set(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], 0, 0, 0, 1), back = place.clone().invert();
  const o = origin.clone().applyMatrix4(back), far = origin.clone().add(direction).applyMatrix4(back), d = far.sub(o);
  const P = g.position, I = g.index;
  let found = null;
  for (let t = 0; t < I.length; t += 3) {
    const a = 3 * I[t], b = 3 * I[t + 1], c = 3 * I[t + 2];
    const e1x = P[b] - P[a], e1y = P[b + 1] - P[a + 1], e1z = P[b + 2] - P[a + 2], e2x = P[c] - P[a], e2y = P[c + 1] - P[a + 1], e2z = P[c + 2] - P[a + 2];
    const px = d.y * e2z - d.z * e2y, py = d.z * e2x - d.x * e2z, pz = d.x * e2y - d.y * e2x, det = e1x * px + e1y * py + e1z * pz;
    if (det === 0) continue;
    const tx = o.x - P[a], ty = o.y - P[a + 1], tz = o.z - P[a + 2], u = (tx * px + ty * py + tz * pz) / det;
    if (u < 0 || u > 1) continue;
    const qx = ty * e1z - tz * e1y, qy = tz * e1x - tx * e1z, qz = tx * e1y - ty * e1x, v = (d.x * qx + d.y * qy + d.z * qz) / det;
    if (v < 0 || u + v > 1) continue;
    const along = (e2x * qx + e2y * qy + e2z * qz) / det;
    if (along < (stage.camera.isOrthographicCamera ? -Infinity : stage.camera.near) || (best && along >= best.distance) || (found && along >= found.distance)) continue;
    const point = origin.clone().addScaledVector(direction, along);
    if (stage.section && stage.section.normal.dot(point) + stage.section.constant < 0) continue;
    found = { part: i, triangle: t / 3, distance: along, point };
  }
  if (!found) return null;
  const corner = (k) => new THREE.Vector3().fromArray(P, 3 * I[3 * found.triangle + k]).applyMatrix4(place);
  found.corners = [corner(0), corner(1), corner(2)];
  found.normal = found.corners[1].clone().sub(found.corners[0]).cross(found.corners[2].clone().sub(found.corners[0])).normalize();
  found.place = place;
  return found;
}

export function toScreen(stage, point) {
  const p = point.clone().project(stage.camera);
  return { x: (p.x + 1) / 2 * stage.canvas.clientWidth, y: (1 - p.y) / 2 * stage.canvas.clientHeight, behind: !stage.camera.isOrthographicCamera && point.clone().applyMatrix4(stage.camera.matrixWorldInverse).z >= 0 };
}

// Returns the corner, edge or face near a pointer: { kind: "point" | "edge" | "face", ... } in the model's coordinates
// relative to its middle.
export function snap(stage, x, y) {
  const hit = pick(stage, x, y);
  if (!hit) return null;
  const g = stage.model.geometries[stage.model.geometry[hit.part]], E = g.edges || [];
  const seen = (p) => { const q = toScreen(stage, p); return Math.hypot(q.x - x, q.y - y); };
  let point = null, edge = null, nearest = 12, nearEdge = 8;
  const a = new THREE.Vector3(), b = new THREE.Vector3(), segment = new THREE.Line3(), foot = new THREE.Vector3();
  for (let k = 0; k < E.length; k += 6) {
    a.set(E[k], E[k + 1], E[k + 2]).applyMatrix4(hit.place);
    b.set(E[k + 3], E[k + 4], E[k + 5]).applyMatrix4(hit.place);
    segment.set(a, b).closestPointToPoint(hit.point, true, foot);
    const off = seen(foot);
    if (off > 14) continue;
    for (const end of [a, b]) {
      const far = seen(end);
      if (far < nearest) nearest = far, point = end.clone();
    }
    if (off < nearEdge) nearEdge = off, edge = [a.clone(), b.clone()];
  }
  if (point) return { kind: "point", at: point, part: hit.part };
  if (edge) return { kind: "edge", at: edge[0].clone().add(edge[1]).multiplyScalar(0.5), ends: edge, length: edge[0].distanceTo(edge[1]), part: hit.part };
  return { kind: "face", at: hit.point, normal: hit.normal, area: faceArea(stage.model, hit), part: hit.part };
}

// Returns the area of the flat face around a hit: the triangles of one plane that are connected through corners at
// equal positions.
function faceArea(model, hit) {
  const g = model.geometries[model.geometry[hit.part]], P = g.position, I = g.index, at = new THREE.Vector3(), n = hit.normal, level = n.dot(hit.point), most = 1e-5 * model.diagonal;
  const flat = [], corners = new Map();
  for (let t = 0; t < I.length; t += 3) {
    const c = [0, 1, 2].map((k) => new THREE.Vector3().fromArray(P, 3 * I[t + k]).applyMatrix4(hit.place));
    if (c.some((q) => Math.abs(n.dot(q) - level) > most)) continue;
    const face = { number: t / 3, area: at.copy(c[1]).sub(c[0]).cross(c[2].clone().sub(c[0])).length() / 2, names: c.map((q) => q.toArray().map((v) => Math.round(v / most)).join()) };
    flat.push(face);
    for (const name of face.names) corners.has(name) ? corners.get(name).push(face) : corners.set(name, [face]);
  }
  const open = flat.filter((f) => f.number === hit.triangle), seen = new Set(open);
  let area = 0;
  while (open.length > 0) {
    const f = open.pop();
    area += f.area;
    for (const name of f.names) for (const next of corners.get(name)) if (!seen.has(next)) seen.add(next), open.push(next);
  }
  return area;
}
