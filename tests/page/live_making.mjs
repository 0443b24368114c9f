// Owns the tests of the display of a model's making, in a browser: the timeline, ghosts, and the way from faces to the
// lines that made them through loops, rules and copies. `live_making.mjs VS FOLDER`.
import { mkdirSync, writeFileSync } from "node:fs";
import { session } from "./live_session.mjs";

const [, , vs, folder] = process.argv;
const model = `${folder}/made.vs`;
const source = `; cut, copied, ruled
(define (opening x)
  (make-box (xyz x -1 1) (xyz (+ x 1) 2 2)))
(draw (color "wheat" (subtract (make-box origin (xyz 10 0.4 3))
                               (map opening '(1 4 7)))))
(draw (intersect (make-sphere (xyz 5 6 0) 2)
                 (make-box (xyz 0 0 0) (xyz 9 9 3))))
(for ([i (in-range 3)])
  (draw (make-cylinder (xyz (* 3 i) 12 0) (+ 1 i) 0.5)))
(define pier (unite (make-box (xyz 0 15 0) (xyz 1 16 2)) (make-cone (xyz 0.5 15.5 2) (xyz 0.5 15.5 3) 0.5)))
(for-each (lambda (x) (draw (do-move pier (vxyz x 0 0)))) '(1 4 7 10))
(define brick (make-box origin (xyz 1 1 1)))
(define-rule (wall [self box-scope?]) [(=> (scope-repeat 'x 2 tile))])
(define-rule (tile [self box-scope?]) [(=> (scope-split 'y (absolute 1 base) (rest top)))])
(define-rule (base [self box-scope?]) [(=> (scope-place brick))])
(define-rule (top [self box-scope?]) [(=> (scope-size #f #f 0.5) (scope-place brick))])
(draw (wall (make-box-scope (xyz 0 20 0) 8 3 1)))
`;
mkdirSync(folder, { recursive: true });
writeFileSync(model, source);
const { page, test, after, onScreen, cursor, end } = await session(vs, model);
await page.waitForFunction(() => window.live.finished > 0);

const lineOf = (text) => source.slice(0, source.indexOf(text)).split("\n").length;
// Chooses the part nearest to a point, as a click does: its place, its callers, the marked lines.
async function clicked(p, from = "top") {
  await page.evaluate((from) => { window.visualscheme.select([]); window.visualscheme.view(from); }, from);
  const at = await onScreen(p);
  await page.mouse.click(at.x, at.y);
  await page.waitForTimeout(300);
  return page.evaluate(() => ({ made: document.querySelector(".cm-line .made")?.textContent, card: document.querySelector(".card:not([hidden]) h2")?.textContent,
    path: [...document.querySelectorAll(".card:not([hidden]) .path button")].map((b) => Number(b.textContent.split(":").pop())) }));
}
const redness = () => page.evaluate(() => { // Pixels that a ghost has made red.
  const { stage } = window.visualscheme;
  stage.draw();
  const gl = stage.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, bytes = new Uint8Array(4 * w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  let red = 0;
  for (let i = 0; i < bytes.length; i += 4) if (bytes[i] > bytes[i + 1] + 30 && bytes[i + 1] < bytes[i + 2] + 12) red++;
  return red;
});

await test("a face of a loop leads to its line", async (want) => {
  const f = await clicked([6, 12, 3]);
  want(f.made?.startsWith("(make-cylinder"), `marked: ${f.made}`);
  want(f.path[0] === lineOf("(draw (make-cylinder"), `the path is ${f.path}`);
});

await test("a face of a mapped copy leads to its line and its callers", async (want) => {
  const f = await clicked([10.1, 15.1, 2]);
  want(f.made?.startsWith("(make-box (xyz 0 15 0)"), `marked: ${f.made}`);
  want(f.path[0] === lineOf("(define pier") && f.path.includes(lineOf("(for-each")), `the path is ${f.path}`);
  const count = () => page.evaluate(() => window.visualscheme.chosen.length);
  want(await count() === 1, `${await count()} parts are chosen`);
  await page.locator(".card .path button").nth(f.path.indexOf(lineOf("(for-each"))).click();
  want(await count() === 8, `the caller's parts: ${await count()} of 8`);
});

await test("a face of a rule leads to its line and its rules", async (want) => {
  const f = await clicked([1, 19.75, 3]);
  want(f.path.includes(lineOf("(define-rule (top")) && f.path.includes(lineOf("(draw (wall")), `the path is ${f.path}`);
});

await test("the face of a cut leads to what was taken away", async (want) => {
  const p = [4.5, 0.2, 1]; // On a sill.
  await page.evaluate(() => { const v = window.visualscheme; v.select([]); v.view("front"); v.control.turn(0, 60); });
  const at = await onScreen(p);
  await page.mouse.click(at.x, at.y);
  await page.waitForFunction(() => /taken away/.test(document.querySelector(".card h2")?.textContent), null, { timeout: 8000 });
  const made = await page.locator(".cm-line .made").first().textContent();
  want(made.startsWith("(make-box (xyz x -1 1)"), `marked: ${made}`);
  want(await page.evaluate(() => window.visualscheme.ghosts[0]?.parts.length) === 1, "no ghost of the one that was taken away");
});

await test("the cursor on what was cut shows a ghost", async (want) => {
  await page.evaluate(() => { window.visualscheme.select([]); window.visualscheme.view("iso"); });
  const before = await redness();
  await cursor("(make-box (xyz x -1 1)");
  await page.waitForFunction(() => window.visualscheme.ghosts[0]?.parts.length === 3, null, { timeout: 8000 });
  want(await redness() > before + 300, `${before} red pixels became ${await redness()}`);
  await cursor("(make-box (xyz 0 0 0) (xyz 9 9 3))");
  await page.waitForFunction(() => window.visualscheme.ghosts[0]?.parts.length === 1, null, { timeout: 8000 });
  await cursor("(make-cone");
  await page.waitForFunction(() => window.visualscheme.ghosts.length === 0 && window.visualscheme.chosen.length === 4, null, { timeout: 8000 });
});

await test("the timeline goes through it, forwards and back", async (want) => {
  await page.locator('[data-do="steps"]').click();
  await page.waitForFunction(() => window.live.timeline.made);
  const steps = await page.evaluate(() => { const t = window.live.timeline.made; return t.steps.map((s, k) => t.say(k)); });
  const wanted = ["box", "box", "box", "box", "subtract", "paint"];
  want(steps.slice(0, 6).every((s, k) => s.startsWith(wanted[k])), steps.slice(0, 7).join("; "));
  want(steps.filter((s) => s.startsWith("drawn")).length === 10, steps.filter((s) => s.startsWith("drawn")).length + " things are drawn");
  want(steps.some((s) => s.startsWith("intersect")) && steps.some((s) => s.startsWith("unite")), "operations are missing");
  const now = () => page.evaluate(() => {
    const { timeline } = window.live, m = timeline.made.model, shown = timeline.made.shown(timeline.k);
    return { k: timeline.k, shown: [...Array(m.count).keys()].filter((i) => shown(i)).map((i) => m.kinds[m.kind[i]]).join(), cut: timeline.made.cutting(timeline.k).length, line: document.querySelector(".cm-line .made")?.textContent };
  });
  const last = await now();
  want(last.k === steps.length - 1 && last.cut === 0, JSON.stringify(last));
  await page.locator('.timeline input[type="range"]').fill("0");
  let s = await now();
  want(s.shown === "box" && s.cut === 0 && s.line.startsWith("(make-box origin (xyz 10"), JSON.stringify(s));
  const on = page.getByRole("button", { name: "A step on (.)" }), back = page.getByRole("button", { name: "A step back (,)" });
  for (let i = 0; i < 3; i++) await on.click();
  s = await now();
  want(s.shown === "box" && s.cut === 3 && s.line.startsWith("(make-box (xyz x -1 1)"), JSON.stringify(s));
  want(await redness() > 200, "what will be cut is no ghost: " + await redness());
  await on.click();
  s = await now();
  want(/^subtract/.test(s.shown) && s.cut === 0, JSON.stringify(s));
  await back.click();
  s = await now();
  want(s.shown === "box" && s.cut === 3, JSON.stringify(s));
  await page.evaluate(() => window.visualscheme.canvas.focus());
  await page.keyboard.press(".");
  want((await now()).k === 4, "the key . does nothing");
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForTimeout(1200);
  await page.getByRole("button", { name: "Play" }).click();
  s = await now();
  want(s.k > 5, `playing came to step ${s.k}`);
});

await test("the timeline follows a save, and gives the model back", async (want) => {
  await page.locator('.timeline input[type="range"]').fill("3");
  await after(() => writeFileSync(model, source.replace("'(1 4 7)", "'(1 4)")));
  await page.waitForFunction(() => window.live.timeline.made.say(3).startsWith("subtract"), null, { timeout: 8000 });
  want(await page.evaluate(() => window.live.timeline.k) === 3, "the step moved");
  await page.getByRole("button", { name: "Close the construction" }).click();
  const same = await page.evaluate(() => window.visualscheme.model === window.live.model && window.visualscheme.ghosts.length === 0 && !window.visualscheme.filter);
  want(same, "the view's model does not come back");
  await page.keyboard.press("b");
  await page.waitForFunction(() => window.live.timeline.isOpen && window.live.timeline.made);
  await page.keyboard.press("b");
  want(await page.locator(".timeline:visible").count() === 0, "the key B does not close it");
});

await test("no script of the timeline's page has failed", async (want) => { want(page.troubles.length === 0, page.troubles.join("; ")); });

await end();
