// Owns the test of the playground's page in Chromium: `page.mjs FOLDER WORK`. FOLDER: what make playground made, served
// as static files. Prints lines in the form that tests/run.sh reads.
import { createServer } from "node:http";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, existsSync } from "node:fs";
import { extname, normalize } from "node:path";
import { browser } from "../page/browser.mjs";
import { LACKS } from "./lacks.mjs";

const [, , folder, work] = process.argv, only = process.env.ONLY || "";
mkdirSync(work, { recursive: true });
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".json": "application/json" };
let bytes = 0;
const server = createServer((request, response) => {
  const name = normalize(decodeURIComponent(new URL(request.url, "http://x").pathname)), path = folder + (name === "/" ? "/index.html" : name);
  if (name.includes("..") || !existsSync(path)) return response.writeHead(404).end();
  const content = readFileSync(path);
  bytes += content.length;
  return response.writeHead(200, { "Content-Type": TYPES[extname(path)] || "application/octet-stream", "Content-Length": content.length }).end(request.method === "HEAD" ? undefined : content);
});
await new Promise((go) => server.listen(0, "127.0.0.1", go));
const base = `http://127.0.0.1:${server.address().port}/`, chromium = await browser();

async function visit(address, { clean = true, context = null } = {}) {
  const visitor = context || await chromium.newContext({ viewport: { width: 1100, height: 640 }, reducedMotion: "reduce", acceptDownloads: true, serviceWorkers: clean ? "block" : "allow" });
  const page = await visitor.newPage();
  page.troubles = [];
  page.on("pageerror", (error) => page.troubles.push(String(error)));
  await page.goto(address, { waitUntil: "load", timeout: 120000 });
  await page.waitForFunction(() => window.playground, null, { timeout: 60000 });
  return page;
}
// Replaces the program's text, or a part of it, and saves it: this runs it.
const write = (page, insert, from, to) => page.evaluate(async ([insert, from, to]) => {
  const { view } = window.live.source;
  view.dispatch({ changes: { from: from ?? 0, to: to ?? view.state.doc.length, insert } });
  await window.live.save();
}, [insert, from, to]);
const good = (page) => page.waitForFunction(() => window.live?.finished > 0, null, { timeout: 240000 });

async function test(name, body) {
  if (!only.split(",").some((part) => ("playground/page:" + name).includes(part.replace(/^playground$/, "")))) return;
  const faults = [], want = (holds, why) => { if (!holds) faults.push(why); };
  try {
    await body(want);
  } catch (error) {
    faults.push(String(error).split("\n")[0]);
  }
  console.log((faults.length ? "not ok playground/page:" : "ok playground/page:") + name);
  for (const fault of faults) console.log("    " + fault);
}

await test("the first model of an empty visit", async (want) => {
  bytes = 0;
  const page = await visit(base);
  await good(page);
  const state = await page.evaluate(() => ({ good: window.live.state.good, ready: performance.now(), count: window.visualscheme.model.count, loaded: performance.getEntriesByType("navigation")[0].loadEventEnd }));
  want(state.good && state.count > 0, "no model is shown");
  want(page.troubles.length === 0, page.troubles.join("; "));
  console.log(`    ${((state.ready - state.loaded) / 1000).toFixed(2)} s after load, ${(bytes / 1e6).toFixed(1)} MB uncompressed`);
  await page.context().close();
});

await test("a slider, the prompt and an error", async (want) => {
  const page = await visit(base + "#example=arcade.vs");
  await good(page);
  const after = async (action) => {
    const before = await page.evaluate(() => window.live.finished);
    await action();
    await page.waitForFunction((n) => window.live.finished > n, before, { timeout: 60000 });
  };
  const name = await page.evaluate(() => window.live.state.parameters.find((p) => p.min !== undefined)?.name);
  if (name) {
    const before = await page.evaluate(() => window.live.version);
    await after(() => page.evaluate((n) => { const p = window.live.state.parameters.find((q) => q.name === n); return window.live.set(n, String(p.min)); }, name));
    want(await page.evaluate(() => window.live.version) > before, "the slider made no other model");
  }
  await after(() => page.evaluate(() => { window.live.prompt.value = "(+ 1 2)"; window.live.prompt.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter" })); }));
  want((await page.evaluate(() => window.live.printed.textContent)).includes("3"), "the prompt has no answer");
  await after(() => write(page, "(draw (make-box (xyz 0 0 0) 1 2 3))\n(make-sphere 1)\n"));
  const messages = await page.evaluate(() => window.live.state.messages);
  want(messages.length === 1 && messages[0].at.line === 2, `messages ${JSON.stringify(messages)}`);
  await page.context().close();
});

await test("a saved program, and an opened file, are there after a reload", async (want) => {
  const page = await visit(base + "#example=arcade.vs"), box = (size) => `(draw (make-box (xyz 0 0 0) 1 2 ${size}))`;
  const shown = (text) => page.waitForFunction((text) => window.live?.source?.text === text && window.live.finished > 0, text, { timeout: 60000 });
  await good(page);
  await write(page, box(3));
  await page.reload();
  await shown(box(3));
  for (const size of [4, 5]) { // The address is the same the second time.
    await page.evaluate((text) => { window.playground.add([new File([text], "box.vs")]); }, box(size));
    await shown(box(size));
  }
  want(page.troubles.length === 0, page.troubles.join("; "));
  await page.context().close();
});

await test("Stop ends an endless program", async (want) => {
  const page = await visit(base + "#example=arcade.vs");
  await good(page);
  await write(page, "(let loop () (loop))");
  await page.waitForFunction(() => !window.live.stopButton.disabled, null, { timeout: 20000 });
  await page.evaluate(() => window.live.stopButton.click());
  await page.waitForFunction(() => window.live.stopButton.disabled, null, { timeout: 20000 });
  await page.waitForTimeout(500);
  want(await page.evaluate(() => window.live.status.textContent) === "stopped", "the status: " + await page.evaluate(() => window.live.status.textContent));
  await write(page, "(draw (make-box (xyz 0 0 0) 1 2 3))");
  await page.waitForFunction(() => window.live.state?.good && window.visualscheme.model.count === 1 && window.visualscheme.model.size[2] === 3, null, { timeout: 60000 });
  want(page.troubles.length === 0, page.troubles.join("; "));
  await page.context().close();
});

await test("a shared program waits to be run", async (want) => {
  const page = await visit(base + "#example=arcade.vs");
  await good(page);
  const text = "; " + "a comment of words that differ, 0123456789 ".repeat(20) + "\n(define-parameter height 3 #:min 1 #:max 9)\n(draw (make-box (xyz 0 0 0) 1 2 height))\n";
  const address = await page.evaluate(async (text) => {
    const { view } = window.live.source;
    view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
    return window.playground.link([["height", "7"]]);
  }, text);
  const other = await visit(address);
  await other.waitForFunction(() => window.live?.source.text !== undefined && window.live.source.text.length > 0);
  want(await other.evaluate(() => window.live.source.text) === text, "another text arrives");
  await write(other, text.replace("make-box", "make-box "));
  await new Promise((go) => setTimeout(go, 1000));
  want(!await other.evaluate(() => window.live.state), "the program ran before it was asked to");
  await other.evaluate(() => document.querySelector(".stranger button").click());
  await good(other);
  await other.waitForFunction(() => window.visualscheme.model?.size?.[2] === 7, null, { timeout: 20000 });
  await other.context().close();
  for (const damaged of [address.slice(0, -20), base + "#program=", base + "#program=%"]) {
    const instead = await visit(damaged);
    await good(instead);
    want(/damaged/.test(await instead.locator(".tools [role=status]").textContent()), damaged.slice(-20) + " is not said to be damaged");
    await instead.context().close();
  }
  await page.context().close();
});

await test("an address of 5 kB of source has at most 4 kB", async (want) => {
  const page = await visit(base + "#example=arcade.vs");
  await page.waitForFunction(() => window.live?.source.text);
  for (const name of readdirSync("examples").filter((n) => n.endsWith(".vs"))) {
    const text = readFileSync("examples/" + name, "utf8").slice(0, 5000);
    const length = await page.evaluate(async (text) => {
      const { view } = window.live.source;
      view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
      return (await window.playground.link([])).length;
    }, text);
    want(length <= 4096, `${name}: ${text.length} characters make an address of ${length}`);
  }
  await page.context().close();
});

await test("all examples", async (want) => {
  for (const name of readdirSync("examples").filter((n) => n.endsWith(".vs"))) {
    const page = await visit(base + "#example=" + name);
    await good(page).catch(() => want(false, `${name}: nothing is shown`));
    const state = await page.evaluate(() => ({ good: window.live.state?.good, messages: window.live.state?.messages.map((m) => m.message), count: window.visualscheme.model?.count }));
    want(LACKS[name] ? state.messages?.some((m) => m.includes(LACKS[name])) : state.good && state.count > 0, `${name}: ${state.messages?.join("; ")}`);
    want(page.troubles.length === 0, `${name}: ${page.troubles.join("; ")}`);
    await page.context().close();
  }
});

await test("a download has all files", async (want) => {
  const page = await visit(base + "#example=arcade.vs");
  await good(page);
  const [download] = await Promise.all([page.waitForEvent("download"), page.evaluate(() => window.playground.download())]);
  await download.saveAs(work + "/all.zip");
  const listed = execFileSync("python3", ["-m", "zipfile", "-l", work + "/all.zip"], { encoding: "utf8" });
  want(listed.includes("examples/arcade.vs"), listed);
  await page.context().close();
});

await test("without a network after the first visit", async (want) => {
  const context = await chromium.newContext({ viewport: { width: 1100, height: 640 } }), page = await visit(base, { context, clean: false });
  await good(page);
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.reload();
  await good(page);
  await page.reload();
  await good(page);
  await context.setOffline(true);
  await page.reload();
  await good(page);
  want(await page.evaluate(() => window.live.state.good), "no model is shown");
  await context.close();
});

await test("an element on another page", async (want) => {
  const page = await (await chromium.newContext({ viewport: { width: 1000, height: 700 } })).newPage();
  await page.route("**/other.html", (route) => route.fulfill({ contentType: "text/html", body: `<script src="${base}element.js"></script><visual-scheme src="tower.vs" height="400"></visual-scheme>` }));
  await page.route("**/tower.vs", (route) => route.fulfill({ contentType: "text/plain", body: "(draw (make-box (xyz 0 0 0) 1 2 5))" }));
  await page.goto(base + "other.html");
  await page.waitForSelector("iframe", { timeout: 20000 });
  const frame = await (await page.$("iframe")).contentFrame();
  await frame.waitForFunction(() => window.visualscheme?.model?.size?.[2] === 5, null, { timeout: 60000 });
  want(true, "");
  await page.context().close();
});

await test("the page as a file", async (want) => {
  const page = await visit("file://" + folder + "/index.html");
  await good(page);
  want(await page.evaluate(() => window.live.state.good), "no model is shown");
  want(page.troubles.length === 0, page.troubles.join("; "));
  await page.context().close();
});

await chromium.close();
server.close();
process.exit(0);
