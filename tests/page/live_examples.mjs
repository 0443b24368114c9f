// Owns the tests of Grimaldo's examples (examples/scenes) in the live view, in a browser, as a user opens and plays
// them. `live_examples.mjs VS FOLDER`. A row of the table: the program, its numbers of handles and objects at the
// start, and the user's steps, each with the expected state of the page.
import { cpSync, mkdirSync } from "node:fs";
import { browser } from "./browser.mjs";
import { session } from "./live_session.mjs";

const [, , vs, folder] = process.argv;
mkdirSync(folder, { recursive: true });
cpSync("examples/scenes", folder, { recursive: true });

// ---- the state of the page; each function runs there ----
const seen = {
  // The number of objects in the picture.
  objects: () => window.visualscheme.model.count,
  // The ends of the model's box along an axis, to a thousandth.
  ends: (axis) => { const m = window.visualscheme.model; return [m.box.min, m.box.max].map((end) => Math.round(1000 * (end[axis] + m.middle[axis])) / 1000).join(" "); },
  // The value of the gizmo with that number.
  value: (n) => window.live.scened.gizmos[n].value.map((x) => Math.round(100 * x) / 100).join(" "),
  gizmos: () => window.live.scened.gizmos.map((g) => g.kind).join(" "),
  // The messages under the picture.
  messages: () => window.live.state.messages.map((m) => m.message).join("; "),
};

// ---- the user's actions: they do not wait; the test waits for the expected state ----
const handleAt = async (page, n) => { await page.waitForFunction((n) => document.querySelectorAll(".overlay .gizmo").length > n, n, { timeout: 8000 }); return page.evaluate((n) => { const r = document.querySelectorAll(".overlay .gizmo")[n].getBoundingClientRect(); return { x: r.x + r.width / 2, y: r.y + r.height / 2 }; }, n); };
const click = (n) => async ({ page }) => { const at = await handleAt(page, n); await page.mouse.click(at.x, at.y); };
const clickPart = (...point) => async ({ page, onScreen }) => { const at = await onScreen(point); await page.mouse.click(at.x, at.y); };
// Drags the handle with that number by a gvector of the model.
const drag = (n, from, to) => async ({ page, onScreen }) => {
  const at = await handleAt(page, n), a = await onScreen(from), b = await onScreen(to);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + (b.x - a.x) / 2, at.y + (b.y - a.y) / 2, { steps: 3 });
  await page.mouse.move(at.x + b.x - a.x, at.y + b.y - a.y, { steps: 3 });
  await page.mouse.up();
};


// ---- the table: `see` is checked after the program has been opened, and after each of the `steps` ----
const rows = (count, row) => Array.from({ length: count }, (_, i) => row(i + 1));
const examples = [
  { file: "spiral.gml", name: "the spiral is opened from its own file", see: [["objects", 0], ["gizmos", "trigger"]],
    steps: rows(3, (n) => [click(0), [["value", `${n}`, 0], ["ends", `1 ${n + 0.972}`, 2]]]) },
  { file: "octagon.gml", name: "the octagon", see: [["objects", 1], ["gizmos", ""], ["ends", "0 1", 2]], steps: [] },
  { file: "manipulator.gml", name: "the manipulator", see: [["gizmos", "tripod"], ["ends", "-0.3 3.4", 2]],
    steps: [[drag(2, [2, 0, 2], [2, 0, 9]), [["value", "0 0 2", 0], ["ends", "-0.3 5.4", 2]]]] }, // one drag goes 2 along Z at most
  { file: "wall.gml", name: "the gothic wall builder", see: [["gizmos", "tripod trigger"], ["objects", 2]],
    steps: [[drag(2, [4, 2, 8], [4, 2, 40]), [["value", "0 0 16", 0], ["ends", "0 24", 2]]],
      [click(3), [["gizmos", /tripod.* tripod/], ["objects", 3]]]] },
  { file: "chairs.vs", name: "chairs, the desk of eight, clear", see: [["gizmos", "slider slider trigger trigger"], ["ends", "-0.1 1.3", 2]],
    steps: [[drag(0, [-4, -1.2, 0.75], [-4, -1.2, 2]), [["value", "0.75", 0], ["ends", "-0.1 1.6", 2]]],
      ...rows(8, (n) => [click(2), [["value", `${n}`, 2], ["more", 6 * n]]]), // a chair is six parts
      [click(2), [["messages", /the desk has 8 places, and all are taken/], ["more", 48]]],
      [click(3), [["more", 0]]]] },
  { file: "lamps.vs", name: "three lamps on three shelves", see: [["gizmos", "tripod tripod tripod trigger"], ["ends", "-0.2 1.3", 2]],
    steps: [[drag(0, [1.5, 0, 0], [0.5, 0, 0]), [["value", /^-(1|0.9\d?) 0 0$/, 0]]],
      ...rows(3, (n) => [click(6), [["value", `${n}`, 3], ["ends", `-0.2 ${[1.8, 2.3, 2.3][n - 1]}`, 2]]]),
      [click(6), [["messages", /./]]]] },
  { file: "engine.vs", name: "the engine", see: [["objects", 8], ["gizmos", "slider slider"]],
    steps: [[drag(0, [0, -4, 0], [9, -4, 0]), [["value", "90", 0], ["ends", "-0.5 0.5", 2]]],
      [drag(1, [-0.4286, -5, 0], [9, -5, 0]), [["value", "16", 1], ["objects", 16]]]] },
  { file: "instances.vs", name: "three instances of one context", see: [["gizmos", ""], ["ends", "-0.2 4.3", 2]],
    steps: [[clickPart(0, -0.7, 0.15), [["more", 1], ["ends", "-0.2 5.2", 2]]]] },
];

const chromium = await browser(), only = process.env.ONLY || "";
for (const example of examples) {
  const name = "example: " + example.name;
  if (!("live/browser:" + name).includes(only)) continue;
  const s = await session(vs, `${folder}/${example.file}`, [], chromium);
  await s.test(name, async (want) => {
    await s.page.waitForFunction(() => window.live?.finished > 0 && window.live.scened && window.visualscheme.model, null, { timeout: 15000 });
    const opened = await s.page.evaluate(() => window.visualscheme.model.count);
    const sees = async (step, list) => {
      for (const [what, wanted, argument] of list) {
        const last = {}, end = Date.now() + 4000;
        do { // until the state that follows has been shown
          last.seen = what === "more" ? await s.page.evaluate(seen.objects) - opened : await s.page.evaluate(seen[what], argument);
          if (wanted instanceof RegExp ? wanted.test(last.seen) : last.seen === wanted) break;
          await s.page.evaluate(() => new Promise(requestAnimationFrame));
        } while (Date.now() < end);
        want(wanted instanceof RegExp ? wanted.test(last.seen) : last.seen === wanted, `step ${step}: ${what} is ${JSON.stringify(last.seen)}, not ${wanted}`);
      }
    };
    await sees(0, example.see);
    const gizmos = await s.page.evaluate(() => [...document.querySelectorAll(".overlay .gizmo")].map((g) => g.getBoundingClientRect()).map((r) => [r.x, r.y]));
    want(gizmos.length === await s.page.evaluate(() => window.live.scened.gizmos.reduce((n, g) => n + g.handles.length, 0)), `${gizmos.length} handles are shown`);
    want(gizmos.every(([x, y]) => x > 450 && x < 1090 && y > 0 && y < 580), `a handle is outside of the picture: ${gizmos}`);
    for (const [i, [act, list]] of example.steps.entries()) {
      await act(s);
      await sees(i + 1, list);
    }
    want(s.page.troubles.length === 0, s.page.troubles.join("; "));
    want(!example.file.endsWith(".gml") || await s.page.evaluate(() => window.live.source.found.length) === 0, "the source is underlined");
  });
  await s.close();
}
await chromium.close();
process.exit(0);
