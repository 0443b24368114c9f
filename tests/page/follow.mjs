// Owns the tests of ,view: a prompt on a terminal (util-linux' script) with a window that shows its drawing.
// `follow.mjs VS FOLDER`. Prints lines in the form that tests/run.sh reads.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import http from "node:http";

const [, , vs, folder] = process.argv, only = process.env.ONLY || "", pause = (ms) => new Promise((go) => setTimeout(go, ms));
const terminal = spawn("script", ["-qfec", `'${vs}'`, "/dev/null"], { cwd: folder, env: { ...process.env, BROWSER: "true", NO_COLOR: "1", LC_ALL: "C.UTF-8", XDG_STATE_HOME: folder, TERM: "xterm" }, stdio: ["pipe", "pipe", "inherit"] });
let screen = "";
terminal.stdout.setEncoding("utf8").on("data", (text) => { screen += text; });
const type = (text) => terminal.stdin.write(text);

async function until(what, test) {
  for (const end = Date.now() + 30000; Date.now() < end; await pause(30)) {
    const found = await test();
    if (found) return found;
  }
  throw new Error("never came: " + what);
}
const shown = (text) => until(`"${text}" on the screen, which is\n${screen.slice(-600)}`, () => screen.includes(text));

async function test(name, body) {
  if (!("live/view at the prompt:" + name).includes(only) && only && !only.startsWith("live/view")) return;
  const faults = [];
  try { await body((ok, words) => { if (!ok) faults.push(words); }); } catch (error) { faults.push(String(error.message || error)); }
  console.log((faults.length ? "not ok" : "ok") + " live/view at the prompt:" + name);
  for (const fault of faults) console.log("    " + fault.split("\n").join("\n    "));
}

type("(draw (make-box (xyz 0 0 0) (xyz 1 2 3)))\r");
type(",view\r");
const address = (await until("the address", () => /http:\/\/127\.0\.0\.1:(\d+)\/#([0-9a-f]{32})/.exec(screen))), port = Number(address[1]), token = address[2];
function ask(path, { method = "GET", headers = { "X-VS-Token": token }, body } = {}) {
  return new Promise((go, no) => {
    const request = http.request({ host: "127.0.0.1", port, path, method, headers }, (answer) => {
      const parts = [];
      answer.on("data", (d) => parts.push(d)).on("end", () => go({ status: answer.statusCode, body: Buffer.concat(parts) }));
    });
    request.on("error", no);
    request.end(body);
  });
}
const states = [];
http.get({ host: "127.0.0.1", port, path: "/events", headers: { "X-VS-Token": token } }, (answer) => {
  let rest = "";
  answer.setEncoding("utf8").on("error", () => {}).on("data", (text) => {
    const blocks = (rest + text).split("\n\n");
    rest = blocks.pop();
    for (const block of blocks) {
      const data = /^event: state\ndata: (.*)$/m.exec(block);
      if (data) states.push(JSON.parse(data[1]));
    }
  });
}).on("error", () => {});
const state = (what, wanted) => until(what + ", after " + JSON.stringify(states[states.length - 1])?.slice(0, 300), () => { const s = states[states.length - 1]; return s && wanted(s) ? s : null; });
let version = 0;

await test("it opens on the drawing as it is", async (expect) => {
  const s = await state("the first state", (x) => x.version > 0);
  version = s.version;
  expect(s.follows && s.good && s.model === "prompt", JSON.stringify(s).slice(0, 200));
  const scene = await ask("/scene?have=0");
  expect(scene.status === 200 && scene.body.length > 100, `the scene: ${scene.status}, ${scene.body.length} bytes`);
});
await test("it follows what is typed", async (expect) => {
  type("(draw (make-sphere (xyz 5 0 0) 1))\r");
  version = (await state("a new version", (x) => x.version > version)).version;
  type('(begin (display "said") (volume (make-box (xyz 0 0 0) (xyz 2 3 7))))\r');
  const s = await state("what was printed", (x) => x.printed.includes("said"));
  expect(s.values.includes("42") && s.version === version, `values ${s.values}, version ${s.version} after ${version}`);
  const told = states.length;
  type(",help make-box\r");
  await shown("make-box");
  await pause(300);
  expect(states.length === told, "a command that draws nothing is told to windows");
});
await test("an error has its message there, too, and the drawing stays", async (expect) => {
  type("(make-sphere (xyz 0 0 0) -2)\r");
  const s = await state("the message", (x) => x.messages.length > 0);
  expect(/must be positive/.test(s.messages[0].message) && s.version === version, JSON.stringify(s.messages).slice(0, 200));
  await shown("must be positive");
});
await test("a window types as well, and a line half typed stays", async (expect) => {
  type("(string-length \"h\u00e4\u20ac");
  await pause(200);
  await ask("/prompt", { method: "POST", body: "(draw (make-cylinder (xyz 9 0 0) 2 1))" });
  version = (await state("its version", (x) => x.version > version)).version;
  await shown("; from the window: (draw (make-cylinder");
  type("!\")\r");
  await shown("= 4");
  type(",undo\r");
  await shown("taken back");
  expect(true);
});
await test("parameters and outputs are asked of the prompt", async (expect) => {
  type("(define-parameter side 2.0 #:min 1 #:max 9)\r");
  await state("the parameter", (x) => x.parameters.some((p) => p.name === "side"));
  await ask("/set?name=side", { method: "POST", body: "3.0" });
  await shown("; from the window: ,set side 3.0");
  const stl = await ask("/export?format=stl");
  expect(stl.status === 200 && stl.body.length > 84, `an output: ${stl.status}, ${stl.body.length} bytes`);
});
await test("the same locks", async (expect) => {
  for (const [what, options, path, status] of [["no token", { headers: {} }, "/scene", 403], ["another host", { headers: { "X-VS-Token": token, Host: "evil.example" } }, "/scene", 403],
    ["another origin", { headers: { "X-VS-Token": token, Origin: "http://evil.example" } }, "/scene", 403], ["a source", {}, "/source", 404],
    ["a source to write", { method: "POST", body: "x" }, "/source?hash=0", 404], ["a file", {}, "/../../etc/passwd", 404], ["an output of a text", { method: "POST", body: "" }, "/export?format=stl", 404]]) {
    const answer = await ask(path, options);
    expect(answer.status === status, `${what}: ${answer.status} ${String(answer.body).slice(0, 80)}`);
  }
});
if (existsSync("tests/node_modules/playwright-core") && ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].some(existsSync)) {
  const { browser } = await import("./browser.mjs"), chromium = await browser();
  try {
    await test("the page shows it without a source", async (expect) => {
      const page = await chromium.newPage({ viewport: { width: 1000, height: 640 }, reducedMotion: "reduce" }), troubles = [];
      page.on("pageerror", (error) => troubles.push(String(error)));
      await page.goto(address[0]);
      await page.waitForFunction(() => window.live?.finished > 0 && window.visualscheme.stage.drawCalls > 0, null, { timeout: 60000 });
      const seen = await page.evaluate(() => ({ parts: window.visualscheme.model.count, editor: document.querySelector("#live .editor").offsetParent !== null, prompt: document.querySelector("#live .console input").offsetParent !== null }));
      expect(seen.parts === 3 && !seen.editor && seen.prompt, JSON.stringify(seen));
      type("(draw (make-cone (xyz 0 6 3) (xyz 0 6 0) 1))\r");
      await page.waitForFunction(() => window.visualscheme.model.count === 4, null, { timeout: 30000 });
      if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/follow.png` });
      type(",clear\r");
      await page.waitForFunction(() => window.visualscheme.model.count === 0, null, { timeout: 30000 });
      await page.locator("#live .console input").fill("(draw (make-box (xyz 0 0 0) (xyz 1 1 1)))");
      await page.locator("#live .console input").press("Enter");
      await page.waitForFunction(() => window.visualscheme.model.count === 1, null, { timeout: 30000 });
      expect(troubles.length === 0, troubles.join("; "));
      await page.close();
    });
  } finally {
    await chromium.close();
  }
}
await test("it ends with the prompt", async (expect) => {
  const ended = new Promise((go) => terminal.on("exit", go));
  type(",quit\r");
  expect(await Promise.race([ended, pause(10000).then(() => "it lives on")]) === 0, "the prompt did not end with 0");
  expect(await ask("/scene").then(() => false, () => true), "the server still answers");
});
terminal.kill();
process.exit(0);
