// Owns the tests of pages: `page.mjs FOLDER` with FOLDER/NAME.html for every example, FOLDER/hostile.html,
// FOLDER/crowd.html, FOLDER/doric-columns.x3d, FOLDER/flat.html, FOLDER/tree.html, FOLDER/light.html, daylight.html,
// evening.html and, if POV-Ray is installed, a .png of each. Prints lines in the form that tests/run.sh reads.
import { readdirSync } from "node:fs";
import { browser, open } from "./browser.mjs";

const folder = process.argv[2], chromium = await browser(), only = process.env.ONLY || "";
const pages = readdirSync(folder).filter((f) => f.endsWith(".html") && !["hostile.html", "crowd.html", "light.html", "daylight.html", "evening.html", "flat.html", "tree.html"].includes(f)).map((f) => f.slice(0, -5)).sort();

function judge(name, faults) {
  console.log((faults.length ? "not ok page/" : "ok page/") + name);
  for (const fault of faults) console.log("    " + fault);
}
const wanted = (name) => ("page/" + name).includes(only);

// In the page: the number of pixels that show the model, and their extent, as fractions of the picture.
function install() {
  window.seen = () => {
    const { stage } = window.visualscheme, gl = stage.renderer.getContext(), ground = stage.groundMesh;
    stage.dome.visible = false;
    if (ground) ground.visible = false;
    stage.renderer.setClearColor(0xff00ff, 1);
    stage.draw();
    const w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, bytes = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    stage.dome.visible = true;
    if (ground) ground.visible = true;
    const box = { left: 1, right: 0, bottom: 1, top: 0 };
    let count = 0, white = 0;
    for (let i = 0; i < w * h; i++) {
      if (bytes[4 * i] > 250 && bytes[4 * i + 1] < 5 && bytes[4 * i + 2] > 250) continue;
      count++;
      if (bytes[4 * i] + bytes[4 * i + 1] + bytes[4 * i + 2] > 3 * 252) white++;
      const x = (i % w + 0.5) / w, y = (Math.floor(i / w) + 0.5) / h;
      box.left = Math.min(box.left, x), box.right = Math.max(box.right, x), box.bottom = Math.min(box.bottom, y), box.top = Math.max(box.top, y);
    }
    return { count, white: white / Math.max(1, count), part: count / (w * h), ...box, calls: stage.drawCalls };
  };
  // Returns the buttons and titles that overlap, or are outside the screen.
  window.crowded = () => {
    const found = [], boxes = [...document.querySelectorAll(".vs .bar button, .vs .title h1, .vs .title p")].filter((n) => n.offsetParent !== null).map((n) => [n.getAttribute("aria-label") || n.tagName, n.getBoundingClientRect()]);
    for (const [name, b] of boxes) if (b.left < 0 || b.right > innerWidth || b.top < 0 || b.bottom > innerHeight) found.push(`${name} reaches out of the screen`);
    for (let i = 0; i < boxes.length; i++) for (let k = 0; k < i; k++) {
      const a = boxes[i][1], b = boxes[k][1];
      if (a.left < b.right - 0.5 && b.left < a.right - 0.5 && a.top < b.bottom - 0.5 && b.top < a.bottom - 0.5) found.push(`${boxes[i][0]} lies on ${boxes[k][0]}`);
    }
    for (const b of document.querySelectorAll("button")) if (!b.getAttribute("aria-label") && !b.textContent.trim()) found.push("a button without a name");
    if (document.documentElement.scrollWidth > innerWidth) found.push("it scrolls sideways");
    return found;
  };
}

// Returns true if the picture contains the whole model, and the model extends across most of one side. long: a scene
// that is a line from some sides, as a row of facades from above. slender: a frame of bars, or a plan, which cover few
// pixels.
function framed(s, long, slender) {
  const faults = [], across = Math.max(s.right - s.left, s.top - s.bottom);
  if (s.part < (slender ? 0.002 : long ? 0.004 : 0.01)) faults.push(`only ${(100 * s.part).toFixed(2)} % of the picture show the model`);
  if (s.left < 0.005 || s.right > 0.995 || s.bottom < 0.005 || s.top > 0.995) faults.push("it is cut off by the picture's border");
  if (across < (long ? 0.3 : 0.6)) faults.push(`it reaches across ${(100 * across).toFixed(0)} % of the picture`);
  return faults;
}

const SLENDER = ["diagrid-roof", "diagrid-tower", "school-plan"];

const context = await chromium.newContext({ viewport: { width: 480, height: 400 }, reducedMotion: "reduce" });
await context.addInitScript(install);
await context.addInitScript(() => { window.quick = true; });

try {
  for (const name of pages) {
    if (!wanted(name)) continue;
    const page = await open(context, `file://${folder}/${name}.html`);
    const seen = await page.evaluate(() => {
      const v = window.visualscheme, out = {}, given = v.model.view.given;
      v.stage.options.refine = false;
      out.first = window.seen();
      for (const how of ["fit", "top", "front", "right", "iso"]) {
        if (how === "fit") v.buttons.fit.click();
        else v.menus.views.querySelector(`[data-view="${how}"]`).click();
        out[how] = window.seen();
      }
      return { out, given, count: v.model.count, nan: v.model.matrix.subarray(0, 12 * v.model.count).some((x) => !Number.isFinite(x)) };
    });
    const faults = [...page.troubles];
    if (!(seen.count > 0) || seen.nan) faults.push("its parts are not whole");
    if (seen.out.first.part < 0.01) faults.push("the first picture shows nothing");
    for (const how of ["fit", "top", "front", "right", "iso"]) faults.push(...framed(seen.out[how], name.startsWith("rules-"), SLENDER.includes(name)).map((f) => `${how}: ${f}`));
    if (seen.out.iso.white > 0.2) faults.push(`${(100 * seen.out.iso.white).toFixed(0)} % of it are burnt out`);
    if (name === "gare-do-oriente" && seen.out.first.calls > 60) faults.push(`${seen.out.first.calls} draw calls`);
    // At the width of a phone, the framed model is above the buttons.
    await page.setViewportSize({ width: 360, height: 640 });
    await page.waitForFunction(() => window.visualscheme.canvas.width === 360, null, { timeout: 60000 });
    const narrow = await page.evaluate(() => {
      const v = window.visualscheme;
      v.menus.views.querySelector('[data-view="iso"]').click();
      v.buttons.fit.click();
      const bar = document.querySelector(".vs .bar").getBoundingClientRect();
      return { seen: window.seen(), bar: 1 - bar.top / innerHeight, faults: window.crowded() };
    });
    faults.push(...narrow.faults.map((f) => "360 pixels wide: " + f));
    if (narrow.seen.bottom < narrow.bar) faults.push(`360 pixels wide: it reaches ${Math.round(640 * (narrow.bar - narrow.seen.bottom))} pixels under the buttons`);
    judge(name, faults);
    await page.close();
  }

  // Fingers and pens, as the system reports them: one finger or a pen turns the model, two fingers move it, or zoom.
  if (wanted("touch")) {
    const phone = await chromium.newContext({ viewport: { width: 360, height: 640 }, hasTouch: true, isMobile: true, reducedMotion: "reduce" });
    const page = await open(phone, `file://${folder}/doric-columns.html`), faults = [], system = await phone.newCDPSession(page);
    await page.evaluate(() => { window.visualscheme.stage.options.refine = false; });
    const state = () => page.evaluate(() => { const s = window.visualscheme.control; return { far: s.state.distance, eye: s.eye().toArray(), ahead: window.visualscheme.stage.camera.matrixWorld.elements.slice(8, 11) }; });
    const touch = (type, ...points) => system.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const differs = (a, b) => a.some((x, k) => Math.abs(x - b[k]) > 1e-6);
    async function fingers(from, to) {
      await touch("touchStart", ...from);
      for (const part of [0.25, 0.5, 0.75, 1]) await touch("touchMove", ...from.map((p, k) => p.map((x, q) => x + part * (to[k][q] - x))));
      await touch("touchEnd");
      return state();
    }
    const first = await state(), turned = await fingers([[180, 300]], [[250, 330]]);
    if (!differs(turned.ahead, first.ahead) || Math.abs(turned.far / first.far - 1) > 1e-6) faults.push("a finger does not turn it, or does more");
    const moved = await fingers([[150, 300], [210, 300]], [[190, 340], [250, 340]]);
    if (differs(moved.ahead, turned.ahead) || !differs(moved.eye, turned.eye)) faults.push("two fingers do not move it alone");
    const pinched = await fingers([[160, 300], [200, 300]], [[110, 300], [250, 300]]);
    if (!(pinched.far < 0.7 * moved.far)) faults.push(`two fingers that part draw it from ${moved.far} to ${pinched.far}`);
    const pen = (type, x, y) => system.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1, clickCount: 1, pointerType: "pen" });
    await page.evaluate(() => window.visualscheme.canvas.addEventListener("pointermove", (event) => { window.movedBy = event.pointerType; }));
    await pen("mousePressed", 180, 300);
    for (const x of [200, 220, 240]) await pen("mouseMoved", x, 310);
    await pen("mouseReleased", 240, 310);
    const drawn = await state(), by = await page.evaluate(() => window.movedBy);
    if (by !== "pen" || !differs(drawn.ahead, pinched.ahead)) faults.push(`a pen (${by}) does not turn it`);
    judge("touch", [...faults, ...page.troubles]);
    await phone.close();
  }

  if (wanted("camera")) {
    const page = await open(context, `file://${folder}/doric-columns.html`), faults = [];
    const state = () => page.evaluate(() => { const c = window.visualscheme.control, e = c.eye(), s = c.state; return { far: s.distance, eye: e.toArray(), roll: window.visualscheme.stage.camera.matrixWorld.elements[2], x: window.visualscheme.stage.camera.matrixWorld.elements.slice(0, 3) }; });
    await page.evaluate(() => { window.visualscheme.stage.options.refine = false; });
    const before = await state();
    await page.mouse.move(240, 200);
    await page.mouse.wheel(0, -200);
    await page.waitForTimeout(100);
    const nearer = await state();
    if (!(nearer.far < before.far)) faults.push("wheel up does not go nearer");
    // 100 drags: the horizon stays level, which means that the camera's right vector has no height.
    await page.evaluate(() => { const c = window.visualscheme.control; let seed = 7; for (let i = 0; i < 100; i++) { seed = seed * 16807 % 2147483647; c.turn(seed % 400 - 200, (seed >> 9) % 300 - 150); } });
    const turned = await state();
    if (Math.abs(turned.x[2]) > 1e-6) faults.push("it has rolled by " + turned.x[2]);
    await page.mouse.down();
    await page.mouse.move(300, 220, { steps: 3 });
    await page.mouse.up();
    const dragged = await state();
    if (dragged.eye.every((x, k) => Math.abs(x - turned.eye[k]) < 1e-9)) faults.push("dragging does not turn it");
    // The keyboard alone: Tab to the picture, turn, zoom, fit.
    await page.locator("canvas").focus();
    await page.keyboard.press("ArrowLeft");
    const left = await state();
    if (left.eye.every((x, k) => Math.abs(x - dragged.eye[k]) < 1e-9)) faults.push("the arrow key does not turn it");
    await page.keyboard.press("+");
    if (!((await state()).far < left.far)) faults.push("the plus key does not go nearer");
    await page.keyboard.press("f");
    faults.push(...framed(await page.evaluate(() => window.seen())).map((f) => "key F: " + f));
    await page.keyboard.press("?");
    const help = await page.locator(".help").textContent();
    if (!/Turn.*drag.*Walk/s.test(help) || help.includes("[object")) faults.push(`the help says: ${help}`);
    await page.keyboard.press("Escape");
    await page.locator("canvas").focus();
    await page.keyboard.press("g");
    const eye = await page.evaluate(() => { const v = window.visualscheme; return (v.control.eye().z - (v.model.ground ? v.model.ground.z - v.model.middle[2] : v.model.box.min[2])) * v.control.metre(); });
    if (Math.abs(eye - 1.65) > 0.01) faults.push(`walking, the eye is ${eye} m above the floor`);
    await page.keyboard.press("Escape");
    faults.push(...page.troubles);
    judge("camera", faults);
    await page.close();
  }

  // The light is that of POV-Ray's picture of the same view: the test compares both as twelve by nine squares.
  for (const name of ["light", "daylight", "evening"]) {
    if (!wanted(name) || !readdirSync(folder).includes(`${name}.png`)) continue;
    const { readFileSync } = await import("node:fs"), plain = await chromium.newContext({ viewport: { width: 480, height: 360 }, reducedMotion: "reduce" });
    const page = await open(plain, `file://${folder}/${name}.html`, true), faults = [];
    await page.evaluate(() => { const v = window.visualscheme; for (const node of v.root.children) if (node !== v.canvas) node.style.display = "none"; });
    const squares = (png) => page.evaluate(async (data) => {
      const bitmap = await createImageBitmap(await (await fetch("data:image/png;base64," + data)).blob()), canvas = new OffscreenCanvas(12, 9), to = canvas.getContext("2d");
      to.imageSmoothingQuality = "high";
      to.drawImage(bitmap, 0, 0, 12, 9);
      return [...to.getImageData(0, 0, 12, 9).data].filter((_, i) => i % 4 < 3);
    }, png.toString("base64"));
    const a = await squares(await page.screenshot()), b = await squares(readFileSync(`${folder}/${name}.png`)), apart = a.map((x, i) => Math.abs(x - b[i])), mean = apart.reduce((x, y) => x + y) / apart.length;
    if (process.env.TELL) console.log(`# ${name}: mean difference ${mean.toFixed(1)} of 255, largest ${Math.max(...apart)}`);
    if (mean > 12 || Math.max(...apart) > 60) faults.push(`the page and POV-Ray's picture differ by ${mean.toFixed(1)} of 255 in the mean, ${Math.max(...apart)} at most`);
    judge(name, [...faults, ...page.troubles]);
    await plain.close();
  }

  if (wanted("tools")) {
    const page = await open(context, `file://${folder}/doric-columns.html`), faults = [];
    await page.evaluate(() => { window.visualscheme.stage.options.refine = false; window.visualscheme.view("front"); });
    const whole = await page.evaluate(() => window.seen());
    const red = await page.evaluate(() => {
      const v = window.visualscheme;
      v.setSection({ axis: "z", at: 0.5, flip: false });
      v.view("top");
      const s = window.seen(), gl = v.stage.renderer.getContext(), bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
      v.stage.draw();
      gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
      let filled = 0;
      for (let i = 0; i < bytes.length; i += 4) if (bytes[i] > bytes[i + 2] + 40 && bytes[i] > bytes[i + 1] + 25) filled++;
      return { filled, shown: !v.sectionStrip.hidden, handle: !!v.overlay.querySelector("[data-handle]") };
    });
    if (red.filled < 200) faults.push(`the cut fills ${red.filled} pixels`);
    if (!red.shown) faults.push("the section's controls do not show");
    const half = await page.evaluate(() => { const v = window.visualscheme; v.view("front"); const s = window.seen(); const handle = !!v.overlay.querySelector("[data-handle]"); v.setSection(null); return { ...s, handle }; });
    if (!(half.count < 0.75 * whole.count)) faults.push(`the section leaves ${half.count} of ${whole.count} pixels`);
    if (!half.handle) faults.push("the section has no handle");
    // Choosing: a click in the middle of the visible model names its place in the source.
    const spot = await page.evaluate(() => { const v = window.visualscheme, b = v.model.ball, p = v.stage.camera; v.view("front"); let best = 0; for (let i = 0; i < v.model.count; i++) if (b[4 * i + 3] > b[4 * best + 3]) best = i; window.seen(); const q = v.stage.center.clone().set(b[4 * best], b[4 * best + 1], b[4 * best + 2]).project(v.stage.camera); return { x: (q.x + 1) / 2 * innerWidth, y: (1 - q.y) / 2 * innerHeight }; });
    await page.mouse.click(spot.x, spot.y);
    const card = await page.locator(".card").textContent();
    if (!/doric-columns\.vs:\d+/.test(card)) faults.push(`a click tells: ${card}`);
    await page.keyboard.press("Escape");
    await page.keyboard.press("m");
    await page.mouse.click(spot.x, spot.y);
    if (!/\d/.test(await page.locator(".reading").first().textContent({ timeout: 5000 }).catch(() => ""))) faults.push("measuring gives no number");
    await page.keyboard.press("Escape");
    await page.keyboard.press("Escape");
    // A hidden layer or material is not visible.
    await page.keyboard.press("l");
    await page.locator('[data-tab="materials"]').click();
    const all = await page.evaluate(() => window.seen().count);
    for (const box of await page.locator('.list input[type=checkbox]').all()) await box.uncheck({ force: true }).catch(() => {});
    const none = await page.evaluate(() => window.seen().count);
    if (!(none < 0.2 * all)) faults.push(`without its materials ${none} of ${all} pixels show`);
    faults.push(...page.troubles);
    judge("tools", faults);
    await page.close();
  }

  // The result of each kind of measuring, of a box of 2 x 2 x 2.5 m; and each display mode changes the picture.
  if (wanted("measures")) {
    const page = await open(context, `file://${folder}/light.html`), faults = [];
    await page.evaluate(() => { const v = window.visualscheme; v.stage.options.refine = false; v.view("front"); v.setMeasuring(true); });
    const click = async (p) => { // two points inside of the box's face
      const at = await page.evaluate((p) => { const { stage, model } = window.visualscheme, on = (p) => { const q = stage.camera.position.clone().set(...p.map((x, k) => x - model.middle[k])).project(stage.camera); return [(q.x + 1) / 2 * stage.canvas.clientWidth, (1 - q.y) / 2 * stage.canvas.clientHeight]; }; const a = on(p), b = on([-2, -1, 1.25]); return a.map((x, k) => x + 2 * Math.sign(Math.round(b[k] - x))); }, p);
      await page.mouse.click(...at);
      await page.waitForTimeout(100);
      return page.locator(".reading").first().textContent({ timeout: 5000 }).catch(() => "nothing");
    };
    const again = () => page.keyboard.press("Escape"), said = (got, want, of) => { if (got !== want) faults.push(`${of}: ${got}, not ${want}`); };
    said(await click([-2, -1, 1.25]), "5 m²", "a face");
    await again();
    said(await click([-2, -1, 2.5]), "2 m", "an edge");
    said(await click([-3, -1, 1.25]), "90.0°", "two edges");
    await again();
    said(await click([-3, -1, 2.5]), "-3, -1, 2.5", "a corner");
    said(await click([-1, -1, 2.5]), "2 m", "two corners");
    // Readings stay; Esc takes the last one away. Two points of one face: their distance.
    const clicks = async (x, z) => { const at = await page.evaluate(([x, z]) => { const { stage, model } = window.visualscheme, q = stage.camera.position.clone().set(x - model.middle[0], -1 - model.middle[1], z - model.middle[2]).project(stage.camera); return [(q.x + 1) / 2 * stage.canvas.clientWidth, (1 - q.y) / 2 * stage.canvas.clientHeight]; }, [x, z]); await page.mouse.click(...at); await page.waitForTimeout(100); };
    await clicks(-2.6, 0.9);
    await clicks(-1.6, 1.7);
    const stays = await page.locator(".reading").allTextContents(), [far, ...parts] = (stays[1] || "").split(/\s{2,}/);
    if (stays.length !== 2 || stays[0] !== "2 m") faults.push(`the readings are ${stays.join(" | ")}`);
    if (Math.abs(parseFloat(far) - Math.hypot(1, 0.8)) > 0.02 || parts.length !== 2) faults.push(`two points of a face: ${stays[1]}, not 1.28 m with dx and dz`);
    await again();
    await again();
    if (await page.locator(".reading").count() !== 0) faults.push("Esc does not take the readings away");
    await page.evaluate(() => { const v = window.visualscheme; v.setMeasuring(false); v.view("start"); });
    const picture = () => page.evaluate(() => { const { stage } = window.visualscheme, gl = stage.renderer.getContext(); stage.shadowsDirty = true; stage.draw(); const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight); gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes); let sum = 0; for (let i = 0; i < bytes.length; i += 4) sum = (Math.imul(31, sum) + bytes[i] + bytes[i + 1] + bytes[i + 2]) | 0; return sum; });
    const first = await picture();
    for (const name of ["edges", "shadows", "occlusion"]) {
      const press = async () => { await page.locator('[data-do="display"]').click(); await page.locator(`[data-show="${name}"]`).click(); await page.keyboard.press("Escape"); };
      await press();
      if ((await picture()) === first) faults.push(`${name}: the picture is the same without`);
      await press();
      if ((await picture()) !== first) faults.push(`${name}: the picture is not the same with it again`);
    }
    await page.locator('[data-do="parallel"]').click();
    if (!(await page.waitForFunction(() => window.visualscheme.stage.camera.isOrthographicCamera, null, { timeout: 15000 }).catch(() => null))) faults.push("no parallel projection");
    judge("measures", [...faults, ...page.troubles]);
    await page.close();
  }

  // The wheel keeps the point under the pointer there; a chosen part is framed; wireframe and dark mode show; a drag
  // moves the section's handle.
  if (wanted("means")) {
    const page = await open(context, `file://${folder}/doric-columns.html`), faults = [];
    await page.evaluate(() => { window.visualscheme.stage.options.refine = false; window.visualscheme.view("front"); });
    const at = (p) => page.evaluate((p) => { const { stage } = window.visualscheme, q = stage.camera.position.clone().set(...p).project(stage.camera); return [(q.x + 1) / 2 * stage.canvas.clientWidth, (1 - q.y) / 2 * stage.canvas.clientHeight]; }, p);
    const corner = await page.evaluate(() => { const { box } = window.visualscheme.model; return [box.min[0], box.min[1], box.max[2]]; }), before = await at(corner);
    await page.mouse.move(before[0], before[1]);
    await page.evaluate((p) => { window.visualscheme.control.depthAt = () => window.visualscheme.stage.camera.position.clone().set(...p); }, corner);
    await page.mouse.wheel(0, -240);
    await page.waitForTimeout(300);
    const after = await at(corner);
    if (Math.hypot(after[0] - before[0], after[1] - before[1]) > 2) faults.push(`the wheel moves what is under the pointer from ${before} to ${after}`);
    const whole = await page.evaluate(() => { const v = window.visualscheme; v.select([]); v.fit(); return v.control.state.distance; });
    const one = await page.evaluate(() => { const v = window.visualscheme; let least = 0; for (let i = 0; i < v.model.count; i++) if (v.model.ball[4 * i + 3] < v.model.ball[4 * least + 3]) least = i; v.select([least]); v.fit(); return v.control.state.distance; });
    if (!(one < 0.9 * whole)) faults.push(`one part is framed from ${one}, the whole from ${whole}`);
    await page.locator("canvas").focus();
    await page.keyboard.press("Escape");
    const all = await page.evaluate(() => { window.visualscheme.fit(); return window.seen().count; });
    await page.keyboard.press("w");
    const lines = await page.evaluate(() => window.seen().count);
    if (!(lines < 0.9 * all)) faults.push(`as wires ${lines} of ${all} pixels show`);
    await page.keyboard.press("w");
    const paper = () => page.evaluate(() => getComputedStyle(document.querySelector(".bar")).backgroundColor);
    const light = await paper();
    await page.keyboard.press("d");
    if ((await paper()) === light) faults.push("dark is no other colour");
    await page.keyboard.press("d");
    for (const axis of ["x", "y", "z"]) {
      await page.evaluate((axis) => { const v = window.visualscheme; v.setSection({ axis, at: 0.5, flip: false }); v.view("iso"); v.stage.draw(); }, axis);
      const box = await page.locator("[data-handle]").first().boundingBox(), from = await page.evaluate(() => window.visualscheme.stage.section.constant);
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
      await page.mouse.down();
      await page.mouse.move(box.x + box.width / 2 + 20, box.y + box.height / 2 + 25, { steps: 3 });
      await page.mouse.up();
      if ((await page.evaluate(() => window.visualscheme.stage.section.constant)) === from) faults.push(`the handle of ${axis} does not move the plane`);
    }
    judge("means", [...faults, ...page.troubles]);
    await page.close();
  }

  // Ten thousand copies: near a corner most of them are out of view and not drawn, and the picture is the same as with
  // all of them.
  if (wanted("crowd")) {
    const page = await open(context, `file://${folder}/crowd.html`), faults = [];
    const seen = await page.evaluate(() => {
      const v = window.visualscheme, { stage } = v;
      stage.draw();
      const gl = stage.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight;
      const picture = () => {
        const bytes = new Uint8Array(4 * w * h);
        stage.shadowsDirty = true;
        stage.draw();
        gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        stage.draw(); // Without the lights' pictures.
        return { bytes, drawn: stage.renderer.info.render.triangles };
      };
      stage.options.refine = false;
      v.view("iso");
      const out = [];
      for (const distance of [0, 6]) {
        if (distance > 0) v.control.state.target.set(-59, -49, 0), v.control.state.distance = distance, v.control.apply();
        const some = picture(), around = [];
        stage.batches.traverse((o) => {
          if (!o.userData.around) return;
          around.push([o, o.userData.around]);
          o.userData.fill();
          o.userData.around = null, o.frustumCulled = false, o.visible = true;
        });
        const all = picture();
        for (const [o, was] of around) o.userData.around = was, o.frustumCulled = true;
        let apart = 0;
        for (let i = 0; i < some.bytes.length; i += 4) if (Math.abs(some.bytes[i] - all.bytes[i]) > 2) apart++;
        out.push({ apart: apart / (w * h), some: some.drawn, all: all.drawn, things: around.length });
      }
      return out;
    });
    if (seen[0].things < 8) faults.push(`the copies are ${seen[0].things} things to draw`);
    if (seen.some((s) => s.apart > 0.002)) faults.push(`${seen.map((s) => (100 * s.apart).toFixed(2)).join(" and ")} % of the pixels differ from those with all copies`);
    if (!(seen[1].some < 0.5 * seen[1].all)) faults.push(`${seen[1].some} of ${seen[1].all} triangles are drawn near a corner`);
    judge("crowd", [...faults, ...page.troubles]);
    await page.close();
  }

  // A coarse picture, with a quarter of the points, has the colours of the full one without its shadows and lines; also
  // of cut faces.
  if (wanted("coarse")) {
    const faults = [];
    for (const name of ["light", "evening", "doric-columns"]) {
      if (!readdirSync(folder).includes(`${name}.html`)) continue;
      const page = await open(context, `file://${folder}/${name}.html`);
      for (const cut of [false, true]) {
        const [apart, shares] = await page.evaluate((cut) => {
          const v = window.visualscheme, { stage } = v, small = document.createElement("canvas"), to = small.getContext("2d", { willReadFrequently: true });
          stage.options.refine = false;
          if (cut) v.setSection({ axis: "y", at: 0.5, flip: false });
          v.stage.setOptions({ shadows: false, occlusion: false, edges: false });
          small.width = 24, small.height = 20, to.imageSmoothingQuality = "high";
          const squares = (coarse) => { stage.shadowsDirty = true; stage.draw(coarse); to.drawImage(stage.canvas, 0, 0, 24, 20); return [to.getImageData(0, 0, 24, 20).data, stage.canvas.width / stage.canvas.clientWidth]; };
          const [whole, all] = squares(false), [coarse, some] = squares(true);
          return [[...whole].map((x, i) => Math.abs(x - coarse[i])), [all, some]];
        }, cut);
        const mean = apart.reduce((a, b) => a + b) / apart.length, most = Math.max(...apart);
        if (process.env.TELL) console.log(`# coarse ${name} ${cut ? "cut" : ""}: mean difference ${mean.toFixed(1)} of 255, largest ${most}`);
        if (mean > 2.5 || most > 60) faults.push(`${name}${cut ? ", cut" : ""}: they differ by ${mean.toFixed(1)} of 255 in the mean, ${most} at most`);
        if (shares.join() !== "1,0.5") faults.push(`${name}: pictures of ${shares} of the points along a side`);
      }
      faults.push(...page.troubles);
      await page.close();
    }
    judge("coarse", faults);
  }

  // Each standard view has the direction of its name, from the menu and by its key.
  if (wanted("views")) {
    const page = await open(context, `file://${folder}/light.html`), faults = [], third = 1 / Math.sqrt(3);
    await page.evaluate(() => { window.visualscheme.stage.options.refine = false; });
    const looks = { top: [0, 0, 1, "7"], bottom: [0, 0, -1], front: [0, -1, 0, "1"], back: [0, 1, 0], left: [-1, 0, 0], right: [1, 0, 0, "3"], iso: [third, -third, third, "0"], start: [null, null, null, "r"] };
    const eye = () => page.evaluate(() => { const { control } = window.visualscheme; return control.direction().toArray(); }), first = await eye();
    for (const [name, [x, y, z, key]] of Object.entries(looks)) {
      const want = x === null ? first : [x, y, z], off = async (how) => { const d = await eye(); if (Math.hypot(...d.map((c, k) => c - want[k])) > 1e-6) faults.push(`${name} ${how} looks from ${d}`); };
      await page.locator('[data-do="views"]').click();
      await page.locator(`button[data-view="${name}"]`).click();
      await off("of the menu");
      if (!key) continue;
      await page.evaluate(() => { window.visualscheme.control.turn(70, 20); window.visualscheme.canvas.focus(); });
      await page.keyboard.press(key);
      await off("by its key");
    }
    judge("views", [...faults, ...page.troubles]);
    await page.close();
  }

  // Curves, regions and text are flat, and visible: each in its colour.
  if (wanted("flat")) {
    const page = await open(context, `file://${folder}/flat.html`), faults = [];
    const near = (p, how) => page.evaluate(([p, how]) => { // The pixel farthest from the sky's colour within 3 of where a point is.
      const { stage, model } = window.visualscheme, gl = stage.renderer.getContext(), q = stage.camera.position.clone().set(...p.map((x, k) => x - model.middle[k])).project(stage.camera);
      stage.draw();
      const x = Math.round((q.x + 1) / 2 * gl.drawingBufferWidth) - 3, y = Math.round((q.y + 1) / 2 * gl.drawingBufferHeight) - 3, bytes = new Uint8Array(4 * 49);
      gl.readPixels(x, y, 7, 7, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
      let best = -Infinity;
      for (let i = 0; i < bytes.length; i += 4) best = Math.max(best, how === "red" ? bytes[i] - bytes[i + 1] : how === "blue" ? bytes[i + 2] - bytes[i] : 255 - bytes[i + 1]);
      return best;
    }, [p, how]);
    await page.evaluate(() => { const v = window.visualscheme; v.stage.options.refine = false; });
    for (const view of ["top", "iso"]) {
      await page.evaluate((view) => window.visualscheme.view(view), view);
      for (const [what, p, how, least] of [["a circle", [2, 0, 0], "red", 60], ["a line", [6, 1, 0], "dark", 120], ["a spline's end", [11, 3, 0], "dark", 120], ["a region", [5, 6, 0], "blue", 40]]) {
        const found = await near(p, how);
        if (!(found >= least)) faults.push(`${view}: ${what} shows as ${found} of ${least}`);
      }
      const hole = await near([5, 5, 0], "blue"), filled = await near([3.4, 5, 0], "blue");
      if (!(filled > hole + 20)) faults.push(`${view}: the region is ${filled} blue, its hole ${hole}`);
    }
    judge("flat", [...faults, ...page.troubles]);
    await page.close();
  }

  // The parts as a tree: operations unfold, a row chooses, its box hides and shows.
  if (wanted("tree")) {
    const page = await open(context, `file://${folder}/tree.html`), faults = [];
    await page.evaluate(() => { window.visualscheme.stage.options.refine = false; });
    await page.keyboard.press("l");
    await page.locator('[data-tab="parts"]').click();
    const rows = () => page.locator(".list .row .name").allTextContents(), folded = await rows(), all = await page.evaluate(() => window.seen().count);
    await page.getByRole("button", { name: "Unfold" }).first().click();
    const unfolded = await rows();
    if (!(unfolded.length > folded.length) || !unfolded.some((name) => /^(box|sphere) +tree\.vs:\d+$/.test(name))) faults.push(`unfolded: ${unfolded.join(", ")} after ${folded.join(", ")}`);
    await page.locator(".list [data-part] .name").first().click();
    const card = await page.locator(".card").textContent();
    if (!/tree\.vs:\d+/.test(card)) faults.push(`a row of the tree tells: ${card}`);
    await page.keyboard.press("Escape");
    const group = page.locator(".list .row").filter({ has: page.locator(".fold") }).first();
    await group.locator("input").uncheck();
    const hidden = await page.evaluate(() => window.seen().count);
    await page.locator(".list .row").filter({ has: page.locator(".fold") }).first().locator("input").check();
    const again = await page.evaluate(() => window.seen().count);
    if (!(hidden < 0.9 * all) || again !== all) faults.push(`${hidden} of ${all} pixels without a group, ${again} with it again`);
    await page.getByRole("button", { name: "Fold", exact: true }).first().click();
    if ((await rows()).length !== folded.length) faults.push("it does not fold");
    await page.locator("canvas").focus();
    await page.keyboard.press("g"); // In a model in millimetres, too, eyes are 1.65 m above what they stand on.
    const eye = await page.evaluate(() => { const { control, model } = window.visualscheme; return control.eye().z - model.box.min[2]; });
    // A viewer inside a closed body sees it all round.
    const inside = await page.evaluate(() => { const v = window.visualscheme, { state } = v.control, b = v.model.ball; v.control.walking = false; state.target.set(b[0], b[1], b[2]), state.distance = 0.01, v.control.apply(); const { part } = window.seen(); state.distance = 30, v.control.apply(); window.seen(); return [part, [...v.stage.surfaceCache.values()].some((m) => m.side === 0)]; });
    if (!(inside[0] > 0.99)) faults.push(`from inside of a box ${(100 * inside[0]).toFixed(0)} % of the picture show it`);
    if (!inside[1]) faults.push("from outside, backs are drawn, too");
    if (Math.abs(eye - 1650) > 5) faults.push(`walking, the eye is ${eye} mm above the floor`);
    judge("tree", [...faults, ...page.troubles]);
    await page.close();
  }

  // By double click, without a network: the page requests nothing but itself. Every control has a name for screen
  // readers.
  if (wanted("alone")) {
    const page = await context.newPage(), faults = [], asked = [];
    page.on("request", (request) => { if (!/^(data|blob):/.test(request.url())) asked.push(request.url()); });
    page.on("pageerror", (error) => faults.push(String(error)));
    await context.setOffline(true);
    await page.goto(`file://${folder}/light.html`);
    await page.waitForFunction(() => window.visualscheme?.stage.drawCalls > 0, null, { timeout: 60000 });
    await page.evaluate(() => { const v = window.visualscheme; v.stage.options.refine = false; v.togglePanel(); v.setSection({ axis: "y", at: 0.5, flip: false }); v.buttons.display.click(); });
    await context.setOffline(false);
    if (asked.length !== 1) faults.push("it asks for " + asked.join(", "));
    const system = await context.newCDPSession(page), { nodes } = await system.send("Accessibility.getFullAXTree");
    const works = nodes.filter((n) => !n.ignored && ["button", "checkbox", "slider", "textbox", "combobox", "menuitem", "menuitemcheckbox", "tab", "link"].includes(n.role?.value));
    if (works.length < 15) faults.push(`only ${works.length} things can be worked`);
    for (const n of works) if (!n.name?.value?.trim()) faults.push(`a ${n.role.value} without a name`);
    if (!nodes.some((n) => n.role?.value === "image" && /model/i.test(n.name?.value || ""))) faults.push("the picture has no name");
    judge("alone", faults);
    await page.close();
  }

  if (wanted("phone")) {
    const phone = await chromium.newContext({ viewport: { width: 360, height: 640 }, hasTouch: true, isMobile: true });
    await phone.addInitScript(install);
    const page = await open(phone, `file://${folder}/gare-do-oriente.html`);
    const faults = await page.evaluate(() => window.crowded());
    judge("phone", [...faults, ...page.troubles]);
    await phone.close();
  }

  if (wanted("hostile")) {
    const page = await open(context, `file://${folder}/hostile.html`), faults = [...page.troubles];
    await page.keyboard.press("l");
    for (const tab of ["layers", "materials", "parts"]) await page.locator(`[data-tab="${tab}"]`).click();
    if (await page.evaluate(() => window.owned)) faults.push("a name was run as script");
    if (await page.evaluate(() => document.querySelectorAll("img, b, script[src]").length)) faults.push("a name became elements");
    await page.locator('[data-tab="layers"]').click();
    if (!(await page.locator(".list").textContent()).includes("<img src=x onerror=")) faults.push("the layer's name is not shown as it is");
    judge("hostile", faults);
    await page.close();
  }

  if (wanted("x3d")) {
    const page = await open(context, `file://${folder}/doric-columns.html`), faults = [];
    const { readFileSync } = await import("node:fs"), text = readFileSync(`${folder}/doric-columns.x3d`, "utf8");
    const compared = await page.evaluate(async (x3d) => {
      const v = window.visualscheme;
      v.stage.options.refine = false;
      v.view("iso");
      const ours = window.seen(), size = v.model.size;
      const data = new DataTransfer();
      data.items.add(new File([x3d], "doric-columns.x3d"));
      dispatchEvent(new DragEvent("drop", { dataTransfer: data }));
      await new Promise((go) => setTimeout(go, 1500));
      v.view("iso");
      return { ours, theirs: window.seen(), size, again: v.model.size, count: v.model.count };
    }, text);
    if (compared.size.some((s, k) => Math.abs(s - compared.again[k]) > 0.01 * Math.max(...compared.size))) faults.push(`sizes ${compared.size} and ${compared.again}`);
    if (Math.abs(compared.ours.count - compared.theirs.count) > 0.02 * compared.ours.count) faults.push(`${compared.ours.count} and ${compared.theirs.count} pixels`);
    judge("x3d", [...faults, ...page.troubles]);
    await page.close();
  }
} catch (error) {
  judge("run", [String(error.stack || error)]);
} finally {
  await chromium.close();
}
