// Owns the common part of the live view's tests in a browser: a server, its page, and tests that print lines in the
// form that tests/run.sh reads.
import { spawn } from "node:child_process";
import { browser, open } from "./browser.mjs";

// Shares a given browser; otherwise the session starts one. drawn: waits until the page shows something.
export async function session(vs, model, options = [], shared = null, drawn = true) {
  const server = spawn(vs, ["view", "-q", ...options, model], { stdio: ["ignore", "pipe", "pipe"] });
  const url = await new Promise((go) => server.stdout.once("data", (d) => go(String(d).trim())));
  const chromium = shared || await browser(), context = await chromium.newContext({ viewport: { width: 1100, height: 640 }, reducedMotion: "reduce", acceptDownloads: true });
  const page = await open(context, url, false, drawn), only = process.env.ONLY || "", pictures = process.env.PICTURES;

  async function test(name, body) {
    if (!("live/browser:" + name).includes(only)) return;
    const faults = [];
    const want = (holds, why) => { if (!holds) faults.push(why); };
    try {
      await body(want);
    } catch (error) {
      faults.push(String(error).split("\n")[0]);
    }
    if (pictures) await page.screenshot({ path: `${pictures}/${name.replace(/\W+/g, "-")}.png` });
    console.log((faults.length ? "not ok live/browser:" : "ok live/browser:") + name);
    for (const fault of faults) console.log("    " + fault);
  }
  // Waits until the page shows the state that follows an action.
  async function after(action) {
    const before = await page.evaluate(() => window.live.finished || 0);
    await action();
    await page.waitForFunction((n) => (window.live.finished || 0) > n, before, { timeout: 20000 });
  }
  // Returns the position of a model's point on the page.
  const onScreen = (p) => page.evaluate(([p]) => {
    const v = window.visualscheme, m = v.model.middle, r = v.canvas.getBoundingClientRect(), q = v.stage.camera.position.clone().set(p[0] - m[0], p[1] - m[1], p[2] - m[2]).project(v.stage.camera);
    return { x: r.left + (q.x + 1) / 2 * r.width, y: r.top + (1 - q.y) / 2 * r.height };
  }, [p]);
  // Puts the cursor after the first letters of a text.
  const cursor = (text) => page.evaluate((text) => {
    const { view } = window.live.source, at = view.state.doc.toString().indexOf(text) + 2;
    view.dispatch({ selection: { anchor: at }, userEvent: "select" });
  }, text);
  async function close() {
    await context.close();
    server.kill();
  }
  async function end() {
    await chromium.close();
    server.kill();
    process.exit(0);
  }
  return { server, url, context, page, test, after, onScreen, cursor, close, end };
}
