// Measures the time from a save to pixels in the live view: `save.mjs VS [NAME ...]`. The script changes a number of
// the source and saves the file as an editor does. The time ends when the first picture of the new model has been read
// back (for slow pictures a coarse one; then also the time until the full one). Prints a table for bench/README.md:
// medians of RUNS saves (7).
//
// The parts of the page's time are elapsed time of its single thread. Processor time is given by process: vs, the page,
// and the process that draws (WebGL in software). PROFILE=FILE writes V8's samples during the saves, for a browser's
// developer tools.
import { copyFileSync, mkdtempSync, readFileSync, readdirSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { spawn } from "node:child_process";
import { tmpdir } from "node:os";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { browser, open } from "../../tests/page/browser.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../.."), [, , vs, ...only] = process.argv, RUNS = Number(process.env.RUNS || 7);
// A model, its parameters, and the change: the text before a number, and the sequence of its values.
const models = [
  ["gare 2 x 2", "examples/gare-do-oriente.vs", ["-D", "rows=2", "-D", "columns=2"], /(define-parameter rho )([\d.]+)/, 0.05],
  ["city", "examples/city.vs", [], /(define storey-height )([\d.]+)/, 0.01],
].filter(([name]) => only.length === 0 || only.some((o) => name.startsWith(o)));

// Returns the processor milliseconds of a process so far; for a browser, by type of process.
const ticks = (pid) => { const text = readFileSync(`/proc/${pid}/stat`, "utf8"), f = text.slice(text.lastIndexOf(")") + 2).split(" "); return 10 * (Number(f[11]) + Number(f[12])); };
function spent(server) {
  const all = { vs: ticks(server), page: 0, drawing: 0, browser: 0 }, parents = new Map(), kinds = new Map();
  for (const entry of readdirSync("/proc")) {
    if (!/^\d+$/.test(entry)) continue;
    try {
      const text = readFileSync(`/proc/${entry}/stat`, "utf8"), words = readFileSync(`/proc/${entry}/cmdline`, "utf8");
      parents.set(entry, text.slice(text.lastIndexOf(")") + 2).split(" ")[1]);
      kinds.set(entry, /--type=renderer/.test(words) ? "page" : /--type=gpu/.test(words) ? "drawing" : /chrom/.test(words) ? "browser" : "");
    } catch { /* it has ended since */ }
  }
  for (const [pid, kind] of kinds) {
    let up = pid;
    while (up && up !== String(process.pid)) up = parents.get(up);
    if (up && kind) try { all[kind] += ticks(pid); } catch { /* it has ended since */ }
  }
  return all;
}
const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];

console.log("| model | KB sent | save to pixels ms | noticed | evaluated, encoded | fetched, read | made ready | drawn | whole picture | vs cpu ms | page cpu ms | drawing cpu ms |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
for (const [name, source, options, number, step] of models) {
  const folder = mkdtempSync(`${tmpdir()}/vs-save-`), model = `${folder}/model.vs`;
  copyFileSync(resolve(root, source), model);
  const server = spawn(resolve(vs), ["view", "-q", ...options, model], { stdio: ["ignore", "pipe", "inherit"] });
  const url = await new Promise((go) => server.stdout.once("data", (d) => go(String(d).trim())));
  const chromium = await browser();
  try {
    const context = await chromium.newContext({ viewport: { width: 1280, height: 800 }, reducedMotion: "reduce" }), page = await open(context, url);
    await page.evaluate(() => {
      const { live, visualscheme: viewer } = window, { stage } = viewer, gl = stage.renderer.getContext(), times = window.times = {};
      const now = () => performance.timeOrigin + performance.now();
      stage.options.refine = false; // What follows the first picture is no part of it.
      const show = viewer.show.bind(viewer), set = stage.setModel.bind(stage), draw = stage.draw.bind(stage);
      viewer.show = (...a) => { times.told = performance.timeOrigin + live.heard; times.read = now(); show(...a); };
      stage.setModel = (...a) => { set(...a); times.ready = now(); };
      stage.draw = (coarse) => {
        draw(coarse);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        if (!times.ready) return;
        times.drawn ||= now();
        if (!coarse) times.whole ||= now();
      };
    });
    const profiler = process.env.PROFILE && await context.newCDPSession(page);
    if (profiler) await profiler.send("Profiler.enable").then(() => profiler.send("Profiler.setSamplingInterval", { interval: 500 })).then(() => profiler.send("Profiler.start"));
    const rows = [];
    for (let run = 0; run <= RUNS; run++) {
      await page.waitForTimeout(400);
      await page.evaluate(() => { for (const key of Object.keys(window.times)) delete window.times[key]; });
      const text = readFileSync(model, "utf8").replace(number, (_, words, value) => words + (Number(value) + step).toFixed(2)), before = spent(server.pid);
      writeFileSync(model + ".new", text);
      const from = Date.now();
      renameSync(model + ".new", model);
      await page.waitForFunction(() => window.times.drawn, null, { timeout: 300000, polling: 50 });
      const after = spent(server.pid);
      await page.waitForFunction(() => window.times.whole, null, { timeout: 300000, polling: 50 });
      const t = await page.evaluate(() => ({ ...window.times, run: 1000 * window.live.state.seconds, sent: window.live.travelled / 1000 }));
      const row = [t.sent, t.drawn - from, t.told - from - t.run, t.run, t.read - t.told, t.ready - t.read, t.drawn - t.ready, t.whole - from, ...["vs", "page", "drawing"].map((key) => after[key] - before[key])];
      if (run > 0) rows.push(row); // The first warms the compilers up.
    }
    if (profiler) writeFileSync(process.env.PROFILE, JSON.stringify((await profiler.send("Profiler.stop")).profile));
    console.log(`| ${name} | ${rows[0].map((_, k) => median(rows.map((r) => r[k])).toFixed(0)).join(" | ")} |`);
  } finally {
    await chromium.close().catch(() => {});
    server.kill();
    rmSync(folder, { recursive: true });
  }
}
process.exit(0);
