// Owns the tests of the live view's outputs and of points in it, in a browser: renders, contact sheets, films, dragged
// points. `live_output.mjs VS FOLDER`.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { session } from "./live_session.mjs";

const [, , vs, folder] = process.argv;
const model = `${folder}/tent.vs`;
const source = `; a tent over a point
(define-parameter peak (xyz 2 1 5)) ; dragged
(define-parameter door (xyz 0 0 0) #:label "Door")
(define-parameter thick 0.1 #:min 0.1 #:max 0.9)
(for-each (lambda (p) (draw (cylinder-from-to p peak thick))) (list (xyz -4 -4 0) (xyz 4 -4 0) (xyz 4 4 0) (xyz -4 4 0)))
(draw (color "tomato" (make-sphere peak 0.6)))
(draw (make-box (+ door (vxyz -0.6 -0.1 0)) (+ door (vxyz 0.6 0.1 2))))
`;
mkdirSync(folder, { recursive: true });
writeFileSync(model, source);
const { page, test, after, end } = await session(vs, model);
await page.waitForFunction(() => window.live.finished > 0);

const peak = () => page.evaluate(() => window.live.state.parameters[0].value);
const handleAt = (handle) => page.evaluate((handle) => { // It is drawn anew with every frame: no locator holds it.
  const box = document.querySelector(`[data-handle="${handle}"]`).getBoundingClientRect();
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}, handle);
async function drag(handle, dx, dy, shift = false) {
  const { x, y } = await handleAt(handle);
  if (shift) await page.keyboard.down("Shift");
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 5 });
  await page.mouse.up();
  if (shift) await page.keyboard.up("Shift");
  const now = await handleAt(handle);
  return Math.hypot(now.x - x - dx, now.y - y - dy);
}

await test("a point is dragged in the view", async (want) => {
  const off = await drag("peak", 60, 20);
  await page.waitForFunction(() => !/^\(xyz 2 1 5\)$/.test(window.live.state.parameters[0].value));
  await page.waitForFunction(() => window.live.parameters.rows.get("peak").sent === window.live.state.parameters[0].value, null, { timeout: 20000 }); // Where it was let go.
  const [x, y, z] = (await peak()).slice(5, -1).split(" ").map(Number);
  want(z === 5 && (x !== 2 || y !== 1), `it is at ${x} ${y} ${z}`);
  want(off < 4, `the handle is ${off} pixels from the pointer`);
  await page.waitForFunction(([x, y]) => { const m = window.visualscheme.model, i = [...Array(m.count).keys()].find((k) => m.kinds[m.kind[k]] === "sphere"); return Math.hypot(m.ball[4 * i] + m.middle[0] - x, m.ball[4 * i + 1] + m.middle[1] - y) < 0.02; }, [x, y], { timeout: 5000 });
  await drag("peak", 0, -40, true);
  await page.waitForFunction(([x, y]) => { const p = window.live.state.parameters[0].value.slice(5, -1).split(" ").map(Number); return p[0] === x && p[1] === y && p[2] > 5.2; }, [x, y], { timeout: 5000 });
  want((await page.evaluate(() => window.live.source.text)) === source, "the source changed by itself");
});

await test("the point goes into the source by its literal", async (want) => {
  await page.waitForFunction(() => window.live.parameters.rows.get("peak").sent === window.live.state.parameters[0].value, null, { timeout: 20000 }); // Where it was let go.
  const value = await peak();
  await page.getByRole("button", { name: "Write to source" }).click();
  await page.waitForFunction(() => !window.live.source.dirty);
  await page.waitForTimeout(300);
  want(readFileSync(model, "utf8") === source.replace("(xyz 2 1 5)", value), readFileSync(model, "utf8").split("\n")[1]);
  await after(() => writeFileSync(model, source));
});

await test("a point is typed as numbers", async (want) => {
  const box = page.getByLabel("Door x", { exact: true });
  await box.fill("3.5");
  await after(() => box.press("Enter"));
  want((await page.evaluate(() => window.live.state.parameters[1].value)) === "(xyz 3.5 0 0)", await page.evaluate(() => window.live.state.parameters[1].value));
  await after(() => page.getByRole("button", { name: "Reset all" }).click());
});

const made = () => page.evaluate(() => window.live.making.made.map((m) => ({ name: m.name, type: m.blob.type, size: m.blob.size })));
const said = () => page.locator(".making .said").textContent();
// The last picture: its size, and the number of its red pixels.
const lastPicture = () => page.evaluate(async () => {
  const { making } = window.live, image = await createImageBitmap(making.made[making.made.length - 1].blob), canvas = document.createElement("canvas");
  canvas.width = image.width, canvas.height = image.height;
  const g = canvas.getContext("2d");
  g.drawImage(image, 0, 0);
  const { data } = g.getImageData(0, 0, canvas.width, canvas.height);
  let red = 0, x = 0, y = 0;
  for (let i = 0; i < data.length; i += 4) if (data[i] > 90 && data[i] > 1.7 * data[i + 2] && data[i] > 1.5 * data[i + 1]) red++, x += i / 4 % canvas.width, y += Math.floor(i / 4 / canvas.width);
  return { width: canvas.width, height: canvas.height, red, x: x / red / canvas.width, y: y / red / canvas.height };
});

await test("a contact sheet of a parameter", async (want) => {
  await page.getByRole("button", { name: "Pictures" }).click();
  await page.getByLabel("How many pictures").fill("4");
  await page.getByRole("button", { name: "Make a sheet" }).click();
  await page.waitForFunction(() => /is made|cancelled|:/.test(document.querySelector(".making .said").textContent) && !window.live.making.cancel, null, { timeout: 180000 });
  const [sheet] = await made(), picture = await lastPicture();
  want(sheet?.name === "tent-sheet-1.png" && sheet.size > 10000, JSON.stringify(await made()) + (await said()));
  want(picture.red > 4 * 60, `${picture.red} red pixels of four tents`);
  want((await page.evaluate(() => window.live.state.parameters[2].value)) === "0.1", "the model's own value has changed");
});

await test("a turntable as a film", async (want) => {
  await page.getByLabel("Seconds of the film").fill("1");
  await page.getByRole("button", { name: "Make a film" }).click();
  await page.waitForFunction(() => !window.live.making.cancel, null, { timeout: 180000 });
  const film = (await made())[1];
  want(film?.type === "video/webm" && film.size > 5000, (await said()) + JSON.stringify(film));
  const played = await page.evaluate(() => new Promise((go) => {
    const video = document.createElement("video");
    video.muted = true;
    video.onerror = () => go("error " + video.error?.message);
    video.onloadedmetadata = () => { video.currentTime = 0.5; };
    video.onseeked = () => go([video.videoWidth > 400, video.duration].join());
    video.src = window.live.making.made[1].url;
    setTimeout(() => go("it does not play"), 8000);
  }));
  want(played === "true,1", played);
});

await test("a render as it is seen, with progress", async (want) => {
  await page.evaluate(() => { const v = window.visualscheme; v.view("front"); v.control.setParallel(false); });
  await page.getByLabel("Size of the picture").selectOption("640");
  await page.getByLabel("Quality of the picture").selectOption("draft");
  const seen = await page.evaluate(() => { // Where the red ball is in the view, as a share of it.
    const v = window.visualscheme, m = v.model, i = [...Array(m.count).keys()].find((k) => m.kinds[m.kind[k]] === "sphere"), p = v.stage.camera.position.clone().fromArray(m.ball, 4 * i).project(v.stage.camera);
    return { x: (p.x + 1) / 2, y: (1 - p.y) / 2 };
  });
  await page.evaluate(() => { window.heard = new Set(); new MutationObserver(() => window.heard.add(document.querySelector(".making .said").textContent)).observe(document.querySelector(".making .said"), { childList: true, characterData: true, subtree: true }); });
  await page.getByRole("button", { name: "Render", exact: true }).click();
  await page.waitForFunction(() => !window.live.making.cancel, null, { timeout: 120000 });
  if (/povray/i.test(await said()) && (await made()).length === 2) return; // No POV-Ray here: it says so.
  const picture = await lastPicture();
  want(picture.width === 640, `${picture.width} pixels wide: ${await said()}`);
  want(Math.abs(picture.x - seen.x) < 0.02 && Math.abs(picture.y - seen.y) < 0.03, `the ball is at ${picture.x} ${picture.y}, seen at ${seen.x} ${seen.y}`);
  want((await page.evaluate(() => [...window.heard].filter((t) => /rendering/.test(t)).length)) > 0, "nothing is told of its progress");
  want(await page.locator(".made-list figure").count() === 3, "the pictures so far are not listed");
});

await test("a render is cancelled, and the view lives meanwhile", async (want) => {
  await page.getByLabel("Size of the picture").selectOption("1920");
  await page.getByLabel("Quality of the picture").selectOption("final");
  await page.getByRole("button", { name: "Render", exact: true }).click();
  await page.waitForTimeout(1500);
  await after(() => writeFileSync(model, source + "\n"));
  want(await page.evaluate(() => !!window.live.making.cancel), "a save waited for the picture");
  await page.getByRole("button", { name: "Cancel" }).click();
  await page.waitForFunction(() => !window.live.making.cancel, null, { timeout: 10000 });
  want(/cancelled/.test(await said()) && (await made()).length <= 3, await said());
});

await test("no script of the outputs' page has failed", async (want) => { want(page.troubles.filter((t) => !/499/.test(t)).length === 0, page.troubles.join("; ")); });

await end();
