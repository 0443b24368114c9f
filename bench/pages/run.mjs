// Measures web pages of models: ours, and X_ITE, <model-viewer> and x3dom showing the same model. `run.mjs VS FOLDER
// [MODEL ...]` writes the pages into FOLDER and prints a table for bench/README.md. The other viewers are npm packages:
// `npm ci --ignore-scripts` here, at the root and in tests.
//
// Seconds are processor time (user and system) of all of Chromium's processes, so that other load on the machine
// matters little: the time until the first picture, and the time of a frame while the model turns, a mean of a few.
// WebGL runs in software. A viewer that shows nothing within LIMIT seconds of elapsed time (120) has no figure.
// VIEWER="our page" measures one viewer alone; SHOTS=NAME keeps pictures.
import { createServer } from "node:http";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { browser } from "../../tests/page/browser.mjs";

const here = dirname(fileURLToPath(import.meta.url)), root = resolve(here, "../.."), [, , vs, out, ...only] = process.argv, folder = resolve(out), LIMIT = Number(process.env.LIMIT || 120);
mkdirSync(folder, { recursive: true });
const models = [["gare", "examples/gare-do-oriente.vs"], ["grid 51 x 51", "examples/cylinder-grid.vs"], ["vaulted hall", "examples/vaulted-hall.vs"], ["city", "examples/city.vs"]]
  .filter(([name]) => only.length === 0 || only.some((o) => name.startsWith(o)));

// Returns the processor seconds of a process and of all its descendants, including ended ones.
function seconds(pid) {
  const children = new Map(), ticks = new Map();
  for (const entry of readdirSync("/proc")) {
    if (!/^\d+$/.test(entry)) continue;
    try {
      const text = readFileSync(`/proc/${entry}/stat`, "utf8"), f = text.slice(text.lastIndexOf(")") + 2).split(" ");
      ticks.set(Number(entry), f.slice(11, 15).reduce((sum, t) => sum + Number(t), 0));
      if (!children.has(Number(f[1]))) children.set(Number(f[1]), []);
      children.get(Number(f[1])).push(Number(entry));
    } catch { /* it has ended since */ }
  }
  let sum = 0;
  for (const open = [...(children.get(pid) || [])]; open.length > 0;) {
    const p = open.pop();
    sum += ticks.get(p) || 0;
    open.push(...(children.get(p) || []));
  }
  return sum / 100;
}

const page = (head, body) => `<!DOCTYPE html><html><head><meta charset="utf-8"><link rel="icon" href="data:,"><style>html,body{margin:0;height:100%}x3d-canvas,model-viewer,x3d{display:block;width:960px;height:600px;border:0}</style>${head}</head><body>${body}</body></html>`;
// Each sets window.first, a promise of the first picture, and window.turn, which draws one frame of the model turned a
// little. A frame ends when a pixel has been read back.
const viewers = {
  "our page": { file: "html", html: null },
  "X_ITE": { file: "x3d", html: page('<script src="/x_ite/x_ite.min.js"></script>', `<x3d-canvas></x3d-canvas><script>
    const b = document.querySelector("x3d-canvas").browser, frame = () => new Promise((go) => requestAnimationFrame(go));
    window.first = (async () => { await b.loadURL(new X3D.MFString("/model")); if (!b.currentScene.rootNodes.length) throw new Error("nothing was loaded"); await frame(); await frame(); })();
    let angle = 0;
    window.turn = async () => { const m = b.currentScene.getNamedNode("model"); angle += 0.05; m.rotation = new X3D.SFRotation(0, 1, 0, angle).multiply(new X3D.SFRotation(1, 0, 0, -Math.PI / 2)); await b.nextFrame(); };
  </script>`) },
  "<model-viewer>": { file: "glb", html: page('<script src="/model-viewer.min.js" type="module"></script>', `<model-viewer src="/model" camera-controls interaction-prompt="none" style="width:960px;height:600px"></model-viewer><script>
    const v = document.querySelector("model-viewer"), frame = () => new Promise((go) => requestAnimationFrame(go));
    window.first = new Promise((go, no) => { v.addEventListener("load", async () => { await frame(); await frame(); go(); }); v.addEventListener("error", (e) => no(new Error(e.detail?.type || "error"))); });
    let angle = 0;
    window.turn = async () => { angle += 3; v.cameraOrbit = angle + "deg 75deg 105%"; v.jumpCameraToGoal(); await frame(); await frame(); };
  </script>`) },
  "x3dom": { file: "x3d", html: page('<link rel="stylesheet" href="/x3dom/x3dom.css"><script src="/x3dom/x3dom.js"></script>', `<x3d width="960px" height="600px"><scene><inline id="model" url="/model.x3d"></inline></scene></x3d><script>
    const frame = () => new Promise((go) => requestAnimationFrame(go));
    window.first = (async () => {
      const x = document.querySelector("x3d");
      while (!x.runtime?.canvas?.doc?._scene?.getVolume().isValid()) await new Promise((go) => setTimeout(go, 20));
      x.runtime.canvas.doc.needRender = true;
      await frame(); await frame(); await frame();
    })();
    window.turn = async () => { const x = document.querySelector("x3d"), c = x.runtime.canvas; c.doc._viewarea._rotMat = x3dom.fields.SFMatrix4f.rotationY(0.05).mult(c.doc._viewarea._rotMat); c.doc.needRender = true; await frame(); await frame(); };
  </script>`) },
};
const types = { js: "text/javascript", css: "text/css", xml: "text/xml" };
let model = "";
const server = createServer((request, answer) => {
  const path = decodeURIComponent(new URL(request.url, "http://x").pathname);
  const found = path === "/" ? null : path.startsWith("/model") && !path.endsWith(".js") ? model : path.startsWith("/x_ite/") ? `${root}/tests/node_modules/x_ite/dist/${path.slice(7)}` : path.startsWith("/x3dom/") ? `${here}/node_modules/x3dom/${path.slice(7)}`
    : path === "/model-viewer.min.js" ? `${here}/node_modules/@google/model-viewer/dist/model-viewer.min.js` : null;
  if (path === "/") return answer.setHeader("Content-Type", "text/html").end(server.html);
  if (!found || !existsSync(found)) return answer.writeHead(404).end();
  answer.setHeader("Content-Type", types[found.split(".").pop()] || (found.endsWith("x3d") ? "model/x3d+xml" : "model/gltf-binary"));
  answer.end(readFileSync(found));
});
await new Promise((go) => server.listen(0, "127.0.0.1", go));
const address = `http://127.0.0.1:${server.address().port}/`;

async function measure(viewer, file) {
  model = file;
  server.html = viewer.html ?? readFileSync(file);
  const chromium = await browser();
  try {
    const tab = await chromium.newPage({ viewport: { width: 960, height: 600 }, reducedMotion: "reduce" });
    const before = seconds(process.pid), clock = Date.now();
    tab.setDefaultTimeout(1000 * LIMIT);
    const work = (async () => {
      await tab.goto(address, { waitUntil: "load", timeout: 1000 * LIMIT });
      if (viewer.html === null) {
        await tab.waitForFunction(() => window.visualscheme?.stage.drawCalls > 0, null, { timeout: 1000 * LIMIT });
        await tab.evaluate(() => {
          const v = window.visualscheme, gl = v.stage.renderer.getContext();
          v.stage.options.refine = false;
          window.turn = async () => { v.control.turn(8, 0); v.stage.draw(); gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); };
        });
      } else await tab.evaluate(() => window.first);
      const first = seconds(process.pid) - before, elapsed = (Date.now() - clock) / 1000;
      await tab.waitForTimeout(500);
      const frames = 5, from = seconds(process.pid);
      for (let i = 0; i < frames; i++) await tab.evaluate(() => window.turn());
      const frame = (seconds(process.pid) - from) / frames, calls = await tab.evaluate(() => window.visualscheme?.stage.drawCalls ?? null);
      if (process.env.SHOTS) await tab.screenshot({ path: `${folder}/${process.env.SHOTS}-${viewer.name}.png`, timeout: 100000 }).catch(() => {});
      return { first, elapsed, frame, calls };
    })();
    return await Promise.race([work, new Promise((_, no) => setTimeout(() => no(new Error(`no picture in ${LIMIT} s`)), 1000 * LIMIT).unref())]);
  } catch (error) {
    return { why: String(error.message).split("\n")[0].slice(0, 60) };
  } finally {
    await chromium.close().catch(() => {});
  }
}

console.log("| model | viewer | file MB | first picture, processor s | by the clock s | a frame, processor ms | draw calls |\n|---|---|--:|--:|--:|--:|--:|");
for (const [name, source] of models) {
  for (const [title, viewer] of Object.entries(viewers)) {
    if (process.env.VIEWER && title !== process.env.VIEWER) continue;
    const file = `${folder}/${name.split(" ")[0]}.${viewer.file}`;
    viewer.name = title.replace(/\W/g, "");
    if (!existsSync(file)) execFileSync(resolve(vs), ["--quiet", resolve(root, source), "-o", file]);
    const r = await measure(viewer, file), mb = (statSync(file).size / 1e6).toFixed(1);
    console.log(r.why ? `| ${name} | ${title} | ${mb} | ${r.why} | | | |` : `| ${name} | ${title} | ${mb} | ${r.first.toFixed(1)} | ${r.elapsed.toFixed(1)} | ${(1000 * r.frame).toFixed(0)} | ${r.calls ?? ""} |`);
  }
}
server.close();
process.exit(0);
