// Owns the tests of .x3d files: `x3d.mjs FOLDER` with FOLDER/NAME.x3d. It checks each against X3D 4, by the nodes that
// X_ITE knows. X_ITE and our own page show it from the file's Viewpoint: the model must cover the same pixels, in
// similar colours. Prints lines in the form that tests/run.sh reads.
import { readdirSync, readFileSync } from "node:fs";
import { browser } from "./browser.mjs";

const folder = process.argv[2], only = process.env.ONLY || "", chromium = await browser(), WIDTH = 480, HEIGHT = 360;
const files = readdirSync(folder).filter((f) => f.endsWith(".x3d")).map((f) => f.slice(0, -4)).sort();

function judge(name, faults) {
  console.log((faults.length ? "not ok page/x3d:" : "ok page/x3d:") + name);
  for (const fault of faults.slice(0, 12)) console.log("    " + fault);
}

// In X_ITE's page: returns the faults of an XML text against X3D 4. The nodes, their fields, profiles and components
// are X_ITE's, from the standard's object model; the bounds of numbers are the standard's, for the fields that we
// write.
function faultsOf(text) {
  const b = document.querySelector("x3d-canvas").browser, faults = [], xml = new DOMParser().parseFromString(text, "text/xml");
  const types = new Map([...b.concreteNodes].map((n) => [n.typeName, n]));
  const bounds = { fieldOfView: [1e-9, Math.PI], intensity: [0, Infinity], ambientIntensity: [0, 1], transparency: [0, 1], shininess: [0, 1], roughness: [0, 1], metallic: [0, 1], radius: [1e-30, Infinity],
    bottomRadius: [1e-30, Infinity], height: [1e-30, Infinity], size: [1e-30, Infinity], index: [0, Infinity], coordIndex: [-1, Infinity], skyAngle: [0, Math.PI], groundAngle: [0, Math.PI / 2] };
  const width = { SFVec2f: 2, MFVec2f: 2, SFVec3f: 3, MFVec3f: 3, SFColor: 3, MFColor: 3, SFColorRGBA: 4, SFRotation: 4, MFRotation: 4 }, place = { initializeOnly: 1, inputOutput: 7 };
  const bad = (node, words) => faults.length < 20 && faults.push(`${node.nodeName}${node.getAttribute("DEF") ? " " + node.getAttribute("DEF") : ""}: ${words}`);
  if (xml.querySelector("parsererror")) return ["it is no XML"];
  const root = xml.documentElement, version = root.getAttribute("version"), profile = root.getAttribute("profile");
  if (root.nodeName !== "X3D") return [`the root is ${root.nodeName}`];
  if (!/^4\.[01]$/.test(version)) bad(root, `version ${version}`);
  const levels = new Map();
  try { for (const c of b.getProfile(profile).components) levels.set(c.name, c.level); } catch { bad(root, `profile ${profile}`); }
  if ([...root.children].map((n) => n.nodeName).join() !== "head,Scene") bad(root, "not a head and a Scene");
  for (const meta of root.children[0].children) {
    if (meta.nodeName === "component") levels.set(meta.getAttribute("name"), Math.max(levels.get(meta.getAttribute("name")) || 0, Number(meta.getAttribute("level"))));
    else if (meta.nodeName !== "meta" || !meta.hasAttribute("name") || !meta.hasAttribute("content")) bad(meta, "not a meta with name and content");
  }
  const named = new Map(), scene = xml.querySelector("Scene");
  // The name of a field's X3D type, as in X_ITE's objects.
  const kinds = new Map(), wordOf = new Map(Object.entries(X3D.X3DConstants).filter(([k]) => /^[SM]F/.test(k)).map(([k, v]) => [v, k]));
  const fieldsOf = (name) => {
    if (!kinds.has(name)) kinds.set(name, new Map([...types.get(name).fieldDefinitions].map((f) => [f.name, { type: wordOf.get(f.dataType), access: f.accessType }])));
    return kinds.get(name);
  };
  const value = (node, key, text, type) => {
    if (type === "SFBool") return void (/^(true|false)$/.test(text) || bad(node, `${key}='${text}'`));
    if (type === "SFString") return;
    if (type === "MFString") return void (/^\s*("(\\.|[^"\\])*"[\s,]*)*$/.test(text) || bad(node, `${key}='${text}'`));
    const words = text.split(/[\s,]+/).filter(Boolean), each = width[type] || 1, [least, most] = /Color$/.test(type) ? [0, 1] : bounds[key] || [-Infinity, Infinity];
    const form = /Int32$/.test(type) ? /^[-+]?\d+$/ : /^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$/;
    if (type[0] === "S" ? words.length !== each : words.length % each) bad(node, `${key} has ${words.length} numbers`);
    const wrong = words.find((w) => !form.test(w) || Number(w) < least || Number(w) > most);
    if (wrong !== undefined) bad(node, `${key} has ${wrong}`);
  };
  const stack = [[scene, null]];
  while (stack.length > 0) {
    const [node, parent] = stack.pop();
    let fields = null;
    if (node !== scene) {
      const type = types.get(node.nodeName);
      if (!type) { bad(node, "no such node"); continue; }
      const { name, level } = type.componentInfo, [from, to] = [type.specificationRange.from, type.specificationRange.to];
      if (!((levels.get(name) || 0) >= level)) bad(node, `component ${name} level ${level} is not in profile ${profile}`);
      if (Number(from) > Number(version) || (Number(to) && Number(to) < Number(version))) bad(node, `is of X3D ${from} to ${to}`);
      fields = fieldsOf(node.nodeName);
      const container = node.getAttribute("containerField") || type.containerField;
      if (parent) {
        const into = fieldsOf(parent.nodeName).get(container);
        if (!into || !/^[SM]FNode$/.test(into.type)) bad(node, `${parent.nodeName} has no field ${container}`);
        else if (into.type === "SFNode" && [...parent.children].filter((c) => (c.getAttribute("containerField") || types.get(c.nodeName)?.containerField) === container).length > 1) bad(parent, `two nodes for ${container}`);
      } else if (container !== "children") bad(node, "stands in the Scene");
      const use = node.getAttribute("USE"), def = node.getAttribute("DEF");
      if (use !== null) {
        if (named.get(use) !== node.nodeName) bad(node, `USE ${use} is of ${named.get(use)}`);
        if (node.children.length > 0 || [...node.attributes].some((a) => a.name !== "USE" && a.name !== "containerField")) bad(node, "a USE with content");
        continue;
      }
      if (def !== null) {
        if (named.has(def)) bad(node, "DEF twice");
        if (!/^[A-Za-z_][\w.-]*$/.test(def)) bad(node, "that is no name");
        named.set(def, node.nodeName);
      }
      for (const a of node.attributes) {
        if (["DEF", "containerField", "class", "id", "style"].includes(a.name)) continue;
        const f = fields.get(a.name);
        if (!f || /Node$/.test(f.type)) bad(node, `no field ${a.name}`);
        else if (f.access !== place.initializeOnly && f.access !== place.inputOutput) bad(node, `${a.name} takes no value`);
        else value(node, a.name, a.value, f.type);
      }
      if ([...node.childNodes].some((c) => c.nodeType === 3 && c.data.trim())) bad(node, "text in it");
    }
    for (const child of [...node.children].reverse()) stack.push([child, node === scene ? null : node]); // In the order of the text: a DEF stands before its USE.
  }
  return faults;
}

// In the page: shows a file, then the same without its model, and passes each to `shot`.
async function showX3D(text) {
  const b = document.querySelector("x3d-canvas").browser, scene = await b.createX3DFromString(text);
  await b.replaceWorld(scene);
  window.scene = scene;
  for (let i = 0; i < 3; i++) await new Promise((go) => requestAnimationFrame(go));
}
async function leaveGround() {
  const model = window.scene.getNamedNode("model");
  model.children = [...model.children].filter((n) => n?.getNodeName?.() === "ground");
  for (let i = 0; i < 3; i++) await new Promise((go) => requestAnimationFrame(go));
}
// In the page: returns the pixels that differ between two pictures (PNG, base 64), with the first one's colours.
async function differing([first, second]) {
  const pixels = async (png) => {
    const bitmap = await createImageBitmap(await (await fetch("data:image/png;base64," + png)).blob()), canvas = new OffscreenCanvas(bitmap.width, bitmap.height), to = canvas.getContext("2d");
    to.drawImage(bitmap, 0, 0);
    return to.getImageData(0, 0, bitmap.width, bitmap.height).data;
  };
  const a = await pixels(first), b = await pixels(second), mask = [], colour = [0, 0, 0];
  for (let i = 0; i < a.length; i += 4) {
    const differs = Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) + Math.abs(a[i + 2] - b[i + 2]) > 9;
    mask.push(differs ? 1 : 0);
    if (differs) for (let k = 0; k < 3; k++) colour[k] += a[i + k];
  }
  return { mask: mask.join(""), colour };
}

// In our page: a file dropped on it, drawn from its Viewpoint without the sky and the ground.
async function dropped(text) {
  const v = window.visualscheme, data = new DataTransfer(), was = v.model;
  v.stage.options.refine = false;
  data.items.add(new File([text], "model.x3d"));
  dispatchEvent(new DragEvent("drop", { dataTransfer: data }));
  while (v.model === was) await new Promise((go) => setTimeout(go, 50));
  const { stage } = v;
  stage.draw(); // The canvas has all of its points.
  const gl = stage.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, bytes = new Uint8Array(4 * w * h), mask = new Uint8Array(w * h), colour = [0, 0, 0];
  stage.dome.visible = false;
  if (stage.groundMesh) stage.groundMesh.visible = false;
  stage.renderer.setClearColor(0xff00ff, 1);
  v.control.reset();
  stage.draw();
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  for (let i = 0; i < w * h; i++) {
    if (bytes[4 * i] > 250 && bytes[4 * i + 1] < 5 && bytes[4 * i + 2] > 250) continue;
    mask[(h - 1 - Math.floor(i / w)) * w + i % w] = 1;
  }
  stage.renderer.setClearColor(0xd8e0ea, 1); // Glass shows what is behind it.
  stage.draw();
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  for (let i = 0; i < w * h; i++) if (mask[(h - 1 - Math.floor(i / w)) * w + i % w]) for (let k = 0; k < 3; k++) colour[k] += bytes[4 * i + k];
  return { mask: mask.join(""), colour };
}

try {
  const context = await chromium.newContext({ viewport: { width: WIDTH, height: HEIGHT }, reducedMotion: "reduce" });
  const theirs = await context.newPage(), troubles = [];
  theirs.on("pageerror", (error) => troubles.push(String(error)));
  theirs.on("console", (message) => { if (["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text())) troubles.push(message.text().slice(0, 200)); });
  const html = `<!DOCTYPE html><title>X_ITE</title><link rel="icon" href="data:,"><style>body{margin:0}x3d-canvas{display:block;width:${WIDTH}px;height:${HEIGHT}px}</style><script src="/x_ite.min.js"></script><x3d-canvas></x3d-canvas>`;
  await theirs.route("http://viewer.test/**", (route) => {
    const path = new URL(route.request().url()).pathname;
    return path === "/" ? route.fulfill({ contentType: "text/html", body: html }) : route.fulfill({ path: "tests/node_modules/x_ite/dist" + path });
  });
  await theirs.goto("http://viewer.test/");
  await theirs.waitForFunction(() => document.querySelector("x3d-canvas").browser);
  await theirs.evaluate(async () => {
    const b = document.querySelector("x3d-canvas").browser;
    for (const [name, on] of [["SplashScreen", false], ["Notifications", false], ["ContextMenu", false]]) b.setBrowserOption(name, on);
    await b.loadComponents(b.getProfile("Full"));
  });
  const ours = await context.newPage();
  await ours.goto(`file://${folder}/reader.html`);
  for (const name of files) {
    if (!("page/x3d:" + name).includes(only) && !only.startsWith("page/x3d")) continue;
    const text = readFileSync(`${folder}/${name}.x3d`, "utf8"), faults = await theirs.evaluate(faultsOf, text);
    troubles.length = 0;
    await theirs.evaluate(showX3D, text);
    const full = (await theirs.screenshot({ timeout: 120000 })).toString("base64");
    await theirs.evaluate(leaveGround);
    const a = await theirs.evaluate(differing, [full, (await theirs.screenshot({ timeout: 120000 })).toString("base64")]), b = await ours.evaluate(dropped, text);
    let both = 0, either = 0, x = 0, y = 0;
    for (let i = 0; i < a.mask.length; i++) {
      const p = a.mask[i] === "1", q = b.mask[i] === "1";
      x += p, y += q, both += p && q, either += p || q;
    }
    if (process.env.TELL) console.log(`# ${name}: X_ITE ${x} pixels, the page ${y}, in common ${(100 * both / either).toFixed(1)} %, colours ${a.colour.map((c) => Math.round(c / x))} and ${b.colour.map((c) => Math.round(c / y))}`);
    if (x < 0.01 * a.mask.length) faults.push(`X_ITE shows ${x} pixels of it`);
    if (!(both > 0.9 * either)) faults.push(`of ${x} pixels that X_ITE shows and ${y} of the page ${both} are the same`);
    const shade = (c, n) => c.map((s) => s / Math.max(1, n)), [p, q] = [shade(a.colour, x), shade(b.colour, y)];
    if (p.some((c, k) => Math.abs(c - q[k]) > 48)) faults.push(`X_ITE's mean colour is ${p.map(Math.round)}, the page's ${q.map(Math.round)}`);
    judge(name, [...faults, ...troubles]);
  }
} catch (error) {
  judge("run", [String(error.stack || error)]);
} finally {
  await chromium.close();
}
