// Reads an .x3d file (XML) into a Model: files of vs, and other files with the same nodes. In X3D Y is up; here Z is
// up.
import { Model, makeGeometry, multiply, identity } from "./model.js";
import { boxForm, sphereForm, cylinderForm, withNormals } from "./forms.js";

const upright = Float64Array.of(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0);

const numbers = (text) => text ? text.trim().split(/[\s,]+/).filter(Boolean).map(Number) : [];
const field = (node, name, otherwise) => { const v = numbers(node.getAttribute(name)); return v.length ? v : otherwise; };

function rotation([x, y, z, a]) {
  const l = Math.hypot(x, y, z) || 1, c = Math.cos(a), s = Math.sin(a), t = 1 - c;
  x /= l, y /= l, z /= l;
  return Float64Array.of(t * x * x + c, t * x * y - s * z, t * x * z + s * y, 0, t * x * y + s * z, t * y * y + c, t * y * z - s * x, 0, t * x * z - s * y, t * y * z + s * x, t * z * z + c, 0);
}
const translation = ([x, y, z]) => Float64Array.of(1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z);
const scaling = ([x, y, z]) => Float64Array.of(x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0);

function placeOf(node) {
  const centre = field(node, "center", [0, 0, 0]), way = field(node, "scaleOrientation", [0, 0, 1, 0]), back = [way[0], way[1], way[2], -way[3]];
  let m = translation(field(node, "translation", [0, 0, 0]));
  for (const next of [translation(centre), rotation(field(node, "rotation", [0, 0, 1, 0])), rotation(way), scaling(field(node, "scale", [1, 1, 1])), rotation(back), translation(centre.map((c) => -c))]) m = multiply(m, next);
  return m;
}
const point = (m, p) => [0, 1, 2].map((k) => m[4 * k] * p[0] + m[4 * k + 1] * p[1] + m[4 * k + 2] * p[2] + m[4 * k + 3]);
const vector = (m, p) => [0, 1, 2].map((k) => m[4 * k] * p[0] + m[4 * k + 1] * p[1] + m[4 * k + 2] * p[2]);

export function modelFromX3D(text, name = "model") {
  const xml = new DOMParser().parseFromString(text, "text/xml"), broken = xml.querySelector("parsererror");
  if (broken) throw new Error("the XML is broken: " + broken.textContent.trim().split("\n")[0]);
  const scene = xml.getElementsByTagName("Scene")[0];
  if (!scene) throw new Error("there is no Scene in it");
  const model = new Model(), named = new Map(), geometries = new Map(), materials = new Map(), lights = [];
  for (const node of xml.getElementsByTagName("*")) if (node.hasAttribute("DEF")) named.set(node.getAttribute("DEF"), node);
  const resolve = (node) => node.hasAttribute("USE") ? named.get(node.getAttribute("USE")) || node : node;
  model.title = [...xml.getElementsByTagName("meta")].find((m) => m.getAttribute("name") === "title")?.getAttribute("content") || name;

  const materialOf = (shape) => {
    const appearance = [...shape.children].map(resolve).find((n) => n.nodeName === "Appearance"), node = appearance && [...appearance.children].map(resolve).find((n) => /Material$/.test(n.nodeName));
    if (!node) return 0;
    if (materials.has(node)) return materials.get(node);
    const one = (key, otherwise) => field(node, key, [otherwise])[0];
    let m;
    if (node.nodeName === "PhysicalMaterial") m = { name: "", color: field(node, "baseColor", [1, 1, 1]), roughness: one("roughness", 1), metallic: one("metallic", 1), transparency: one("transparency", 0), ior: 1.5 };
    else {
      // backends/x3d/x3d_scene.c writes materials in this way: the highlight's colour identifies metals, and its
      // sharpness is the roughness.
      const diffuse = field(node, "diffuseColor", [0.8, 0.8, 0.8]), glow = field(node, "emissiveColor", [0, 0, 0]), shine = field(node, "specularColor", [0, 0, 0]);
      const gloss = Math.sqrt(Math.max(0, one("shininess", 0.2) - 0.05) / 0.75), metal = Math.max(...shine) - Math.min(...shine) > 0.05 || Math.max(...shine) > 0.46;
      const color = Math.max(...diffuse) > 0 ? diffuse.map((c) => metal ? Math.min(1, c / 0.8) : c) : glow;
      m = { name: "", color, roughness: Math.min(1, Math.max(0, 1 - gloss)), metallic: metal ? 1 : 0, transparency: Math.min(1, one("transparency", 0) / 0.72), ior: 1.5 };
    }
    materials.set(node, model.materials.length);
    model.materials.push(m);
    return model.materials.length - 1;
  };

  const geometryOf = (node) => {
    if (geometries.has(node)) return geometries.get(node);
    const child = (type) => [...node.children].map(resolve).find((n) => n.nodeName === type);
    const points = () => Float32Array.from(numbers(child("Coordinate")?.getAttribute("point")));
    const solid = node.getAttribute("solid") !== "false", made = [];
    const add = (g) => { made.push(model.geometries.length); model.geometries.push(g); };
    const one = (key, otherwise) => field(node, key, [otherwise])[0];
    switch (node.nodeName) {
      case "Box": { const s = field(node, "size", [2, 2, 2]); add(boxForm(s[0], s[1], s[2])); break; }
      case "Sphere": add(sphereForm(one("radius", 1))); break;
      case "Cylinder": add(cylinderForm(one("radius", 1), one("radius", 1), one("height", 2))); break;
      case "Cone": add(cylinderForm(one("bottomRadius", 1), 0, one("height", 2))); break;
      case "IndexedTriangleSet": {
        const at = points(), index = Uint32Array.from(numbers(node.getAttribute("index"))), given = numbers(child("Normal")?.getAttribute("vector"));
        if (given.length === at.length) add(makeGeometry(at, Int16Array.from(given, (x) => Math.round(32767 * Math.max(-1, Math.min(1, x)))), index, solid, false));
        else add(withNormals(at, index, solid));
        break;
      }
      case "IndexedFaceSet": {
        const at = points(), corners = [], face = [];
        for (const i of [...numbers(node.getAttribute("coordIndex")), -1]) {
          if (i >= 0) { face.push(i); continue; }
          for (let k = 2; k < face.length; k++) corners.push(face[0], face[k - 1], face[k]);
          face.length = 0;
        }
        add(withNormals(at, Uint32Array.from(corners), solid));
        break;
      }
      case "IndexedLineSet": {
        const at = points(), line = [];
        for (const i of [...numbers(node.getAttribute("coordIndex")), -1]) {
          if (i >= 0) { line.push(at[3 * i], at[3 * i + 1], at[3 * i + 2]); continue; }
          if (line.length > 3) add(makeGeometry(Float32Array.from(line), null, null, false, true));
          line.length = 0;
        }
        break;
      }
    }
    geometries.set(node, made);
    return made;
  };

  const stack = [{ nodes: [...scene.children], next: 0, m: upright, depth: 0 }];
  while (stack.length > 0) {
    const top = stack[stack.length - 1];
    if (top.next >= top.nodes.length) {
      stack.pop();
      continue;
    }
    const node = resolve(top.nodes[top.next++]);
    if (stack.length > 2000) throw new Error("its nodes use one another without end");
    switch (node.nodeName) {
      case "Transform": stack.push({ nodes: [...node.children], next: 0, m: multiply(top.m, placeOf(node)) }); break;
      case "Group": case "StaticGroup": case "Collision": case "Anchor": case "LOD": stack.push({ nodes: node.nodeName === "LOD" ? [...node.children].slice(0, 1) : [...node.children], next: 0, m: top.m }); break;
      case "Switch": { const chosen = node.children[Number(node.getAttribute("whichChoice") ?? -1)]; if (chosen) stack.push({ nodes: [chosen], next: 0, m: top.m }); break; }
      case "Shape": {
        const g = [...node.children].map(resolve).find((n) => n.nodeName !== "Appearance");
        // The ground of .x3d files that vs writes is not a part of the model.
        if (g && node.getAttribute("DEF") === "ground") {
          model.ground = { z: point(top.m, [...model.geometries[geometryOf(g)[0]].position.slice(0, 3)])[2], paint: materialOf(node) };
          break;
        }
        if (g) for (const number of geometryOf(g)) model.add(number, top.m, 0, materialOf(node), 0, 0, 0, 0);
        break;
      }
      case "DirectionalLight": lights.push({ power: field(node, "intensity", [1])[0], direction: vector(top.m, field(node, "direction", [0, 0, -1])) }); break;
      case "Background": { const c = numbers(node.getAttribute("skyColor")); if (c.length >= 3) model.found = c.slice(0, 3); break; }
      case "Viewpoint": {
        if (model.view) break;
        const turn = rotation(field(node, "orientation", [0, 0, 1, 0])), eye = field(node, "position", [0, 0, 10]), centre = field(node, "centerOfRotation", [0, 0, 0]);
        const ahead = vector(turn, [0, 0, -1]), far = Math.max(1e-6, ahead.reduce((sum, a, k) => sum + a * (centre[k] - eye[k]), 0)) || 1, short = field(node, "fieldOfView", [Math.PI / 4])[0];
        model.view = { eye: point(top.m, eye), target: point(top.m, eye.map((e, k) => e + ahead[k] * far)), up: vector(top.m, vector(turn, [0, 1, 0])), parallel: short < 0.11, width: 1, angle: 2 * Math.atan(Math.tan(short / 2) * 4 / 3), aspect: 4 / 3, given: short >= 0.11 };
        break;
      }
    }
  }
  lights.sort((a, b) => b.power - a.power);
  if (lights.length > 0) model.sun = { direction: lights[0].direction, given: true };
  // 32-bit numbers are finest near zero. Therefore positions become relative to the middle of the model.
  model.measure();
  const middle = [0, 1, 2].map((k) => (model.box.min[k] + model.box.max[k]) / 2);
  for (let i = 0; i < model.count; i++) for (let k = 0; k < 3; k++) model.matrix[12 * i + 4 * k + 3] -= middle[k];
  model.middle = middle;
  return model.measure();
}

export { identity };
