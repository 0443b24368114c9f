// Owns the tests of the live view as a host of scenes, in a browser: frames, picks, gizmos, coarse drags. `live_scene.mjs VS FOLDER`.
import { copyFileSync, mkdirSync, writeFileSync } from "node:fs";
import { session } from "./live_session.mjs";

const [, , vs, folder] = process.argv;
const model = `${folder}/alive.vs`;
const still = `(define lamp (on-pick (color "tomato" (make-sphere (xyz 6 0 0) 1)) (lambda (node hit) (node-translate node (+v (node-gettranslate node) (vxyz 0 0 1))))))
(define column (node-create #:drawing (make-box (xyz 9 -0.5 -2) (xyz 10 0.5 0)) #:parent (node-getroot)))
(define knob (make-slider (xyz 9.5 -2 -2) (xyz 9.5 -2 2) 0 4 #:value 1 #:size 0.5 #:parent (node-getroot)))
(property-subscribe (property-ref knob 'value) (lambda (v) (node-translate column (vxyz 0 0 v))))
`;
const moving = `(define wheel (node-create #:drawing (make-box (xyz -3 -1 -1) (xyz -2 1 1)) #:parent (node-getroot)))
(define way 0)
(every-frame (lambda (dt) (set! way (+ way dt)) (node-translate wheel (vxyz (- way) 0 0))))
`;
mkdirSync(folder, { recursive: true });
writeFileSync(model, still.replace("+v ", "v+v "));
const { page, test, after, onScreen, end } = await session(vs, model);
await page.waitForFunction(() => window.live.finished > 0);
const front = () => page.evaluate(() => window.visualscheme.view("front"));
const height = () => page.evaluate(() => Math.round(100 * (window.visualscheme.model.box.max[2] + window.visualscheme.model.middle[2])) / 100);

await test("a click on a node calls its procedure", async (want) => {
  await front();
  want(await height() === 1, `the height is ${await height()}`);
  const at = await onScreen([6, -1, 0]);
  await page.mouse.click(at.x, at.y);
  await page.waitForFunction(() => Math.abs(window.visualscheme.model.box.max[2] + window.visualscheme.model.middle[2] - 2) < 1e-3, null, { timeout: 8000 });
});

await test("a gizmo is dragged", async (want) => {
  const at = () => page.evaluate(() => { const r = document.querySelector(".overlay .gizmo").getBoundingClientRect(); return { x: r.x + r.width / 2, y: r.y + r.height / 2 }; });
  const from = await at(), there = await onScreen([9.5, -2, 2]);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x, (from.y + there.y) / 2, { steps: 4 });
  await page.mouse.move(there.x, there.y - 30, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(() => window.live.scened.gizmos[0].value[0] === 4, null, { timeout: 8000 });
  await page.waitForFunction(() => Math.abs(window.visualscheme.model.box.max[2] + window.visualscheme.model.middle[2] - 4) < 1e-3, null, { timeout: 8000 });
  const now = await at(), wanted = await onScreen([9.5, -2, 2]);
  want(Math.hypot(now.x - wanted.x, now.y - wanted.y) < 4, `the handle is at ${now.x} ${now.y}, not ${wanted.x} ${wanted.y}`);
});

await test("what is done in every frame moves", async (want) => {
  await after(() => writeFileSync(model, moving));
  const left = () => page.evaluate(() => window.visualscheme.model.box.min[0] + window.visualscheme.model.middle[0]);
  const a = await left();
  await page.waitForFunction((a) => window.visualscheme.model.box.min[0] + window.visualscheme.model.middle[0] < a - 0.3, a, { timeout: 15000 });
  const source = await page.evaluate(() => window.live.source.text);
  want(source === moving, "the source pane has another text");
  await after(() => writeFileSync(model, moving.replace("(set! way (+ way dt))", "(set! way (+ way dt)) (if (> way 0.2) (car way))")));
  await page.waitForFunction(() => !window.live.state.good && /car/.test(window.live.state.messages.map((m) => m.message).join()), null, { timeout: 15000 });
  const version = await page.evaluate(() => window.live.version);
  await page.waitForTimeout(600);
  want(await page.evaluate(() => window.live.version) === version, "frames go on after an error");
  await after(() => writeFileSync(model, still.replace("+v ", "v+v ")));
  want(await page.evaluate(() => window.live.state.good && window.live.scened.frames === false), "it does not heal");
});

await test("a slow model is coarser while its slider moves", async (want) => {
  await after(() => writeFileSync(model, "(define-parameter r 1.0 #:min 1 #:max 5)\n(draw (make-sphere origin r))\n"));
  await page.waitForFunction(() => window.visualscheme.model.count === 1 && document.querySelector("input[type=range][data-parameter=r]"), null, { timeout: 15000 });
  const triangles = () => page.evaluate(() => window.visualscheme.model.geometries.reduce((sum, g) => sum + g.triangles, 0));
  const fine = await triangles();
  await page.evaluate(() => { window.live.state.seconds = 1; const s = document.querySelector("input[type=range][data-parameter=r]"); s.value = "3"; s.dispatchEvent(new Event("input")); });
  await page.waitForFunction(() => Math.abs(window.visualscheme.model.size[2] - 6) < 0.5, null, { timeout: 15000 });
  want(await triangles() < fine / 2, `${fine} triangles became ${await triangles()}`);
  await page.evaluate(() => document.querySelector("input[type=range][data-parameter=r]").dispatchEvent(new Event("change")));
  await page.waitForFunction((fine) => window.visualscheme.model.geometries.reduce((sum, g) => sum + g.triangles, 0) >= fine, fine, { timeout: 15000 });
});

await test("Grimaldo's spiral grows by a part a click", async (want) => {
  copyFileSync("examples/scenes/spiral.gml", `${folder}/spiral.gml`);
  await after(() => writeFileSync(model, "(load \"spiral.gml\")\n"));
  await page.reload(); // as a user who opens it: the page begins with nothing but the trigger
  await page.waitForFunction(() => window.live?.finished > 0);
  await page.waitForFunction(() => window.live.scened?.gizmos.length === 1 && window.live.scened.gizmos[0].kind === "trigger", null, { timeout: 15000 });
  const top = () => page.evaluate(() => window.visualscheme.model ? window.visualscheme.model.box.max[2] + window.visualscheme.model.middle[2] : 0);
  for (let clicks = 1; clicks <= 3; clicks++) {
    const at = await page.evaluate(() => { const r = document.querySelector(".overlay .gizmo").getBoundingClientRect(); return { x: r.x + r.width / 2, y: r.y + r.height / 2 }; });
    want(at.x > 450 && at.x < 1100 && at.y > 0 && at.y < 580, `the handle is outside of the picture, at ${at.x} ${at.y}`);
    await page.mouse.click(at.x, at.y);
    await page.waitForFunction((n) => window.live.scened.gizmos[0].value[0] === n, clicks, { timeout: 8000 });
    await page.waitForFunction((n) => Math.abs(window.visualscheme.model.box.max[2] + window.visualscheme.model.middle[2] - n - 1) < 0.05, clicks, { timeout: 8000 }).catch(async () => want(false, `after ${clicks} clicks the top is at ${await top()}`));
  }

});

await test("no script of the scene's page has failed", async (want) => { want(page.troubles.length === 0, page.troubles.join("; ")); });

await end();
