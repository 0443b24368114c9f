// Owns the tests of the live view in a browser: `live_browser.mjs VS FOLDER`. Prints lines in the form that
// tests/run.sh reads.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { open } from "./browser.mjs";
import { session } from "./live_session.mjs";

const [, , vs, folder] = process.argv;
const model = `${folder}/towers.vs`;
const source = `; two towers and a bridge
(define-parameter height 3.0 #:min 1 #:max 9 #:label "Height of the towers")
(define-parameter roofed #t)
(define-parameter style "round" #:choices '("round" "square"))
(define (tower at) ; one of them
  (if (equal? style "round")
      (make-cylinder at height 1)
      (make-box at 2 2 height)))
(draw (tower (xyz 0 0 0)))
(draw (tower (xyz 8 0 0)))
(if roofed (draw (color "red" (make-cone (xyz 0 0 height) (xyz 0 0 (+ height 2)) 1.3))))
(draw (layer "bridge" (subtract (make-box (xyz 0 -0.5 1) (xyz 8 0.5 2)) (make-box (xyz 3 -1 1.2) (xyz 5 1 1.8)))))
`;
mkdirSync(folder, { recursive: true });
writeFileSync(model, source);

const { url, context, page, test, after, onScreen, end } = await session(vs, model);
const facts = () => page.evaluate(() => {
  const m = window.visualscheme.model;
  return { count: m.count, size: m.size.map((s) => Math.round(s * 1000) / 1000), good: window.live.state.good, messages: window.live.state.messages.map((m) => m.message) };
});
const eye = () => page.evaluate(() => { const c = window.visualscheme.stage.camera; return [...c.position.toArray(), ...c.quaternion.toArray()].map((x) => Math.round(1e4 * x) / 1e4).join(); });
const text = () => page.evaluate(() => window.live.source.text);
await test("the model is shown beside its source", async (want) => {
  await page.waitForFunction(() => window.live.finished > 0);
  const f = await facts();
  want(f.count === 4, `${f.count} parts`);
  want((await text()) === source, "the source pane has another text");
  want(page.troubles.length === 0, page.troubles.join("; "));
});

await test("a slider evaluates", async (want) => {
  const slider = page.locator('input[type=range][data-parameter=height]');
  await after(() => slider.fill("6"));
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 8);
  want((await facts()).size[2] === 8, `height ${(await facts()).size[2]}`);
  want((await text()) === source, "the source changed by itself");
});

await test("a check mark and a choice evaluate", async (want) => {
  await after(() => page.locator("#parameter-roofed").uncheck());
  await page.waitForFunction(() => window.visualscheme.model.count === 3);
  await after(() => page.locator("#parameter-style").selectOption("square"));
  await page.waitForFunction(() => window.visualscheme.model.size[0] === 10 && window.visualscheme.model.size[1] === 2);
  want((await facts()).size.join() === "10,2,6", (await facts()).size.join());
});

await test("the picture has most of the window, and the parameters lie over it", async (want) => {
  const size = page.viewportSize(), inside = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
  for (const [width, height, share] of [[1400, 900, 0.59], [1100, 700, 0.55], [800, 600, 0.55], [390, 800, 0.99]]) {
    await page.setViewportSize({ width, height });
    await page.evaluate((open) => { window.live.parameters.root.open = open; }, width > 1000);
    await page.waitForTimeout(150);
    const found = await page.evaluate(() => {
      const box = (q) => { const e = document.querySelector(q), r = e?.getBoundingClientRect(); return r && r.width && getComputedStyle(e).display !== "none" ? { left: r.left, right: r.right, top: r.top, bottom: r.bottom } : null; };
      return Object.fromEntries(["canvas", ".exports", ".parameters", ".bar", ".cube", ".pane", ".title h1"].map((q) => [q, box(q)]));
    });
    const { canvas, ...rest } = found, names = Object.keys(rest).filter((q) => rest[q]);
    want((canvas.right - canvas.left) / width >= share, `at ${width} the picture has ${((canvas.right - canvas.left) / width).toFixed(2)} of the width`);
    for (const a of names) for (const b of names) if (a < b) want(!inside(rest[a], rest[b]), `at ${width} ${a} lies over ${b}`);
  }
  await page.setViewportSize(size);
  await page.evaluate(() => { window.live.parameters.root.open = true; });
});

await test("a key and a button fold the source", async (want) => {
  const width = () => page.evaluate(() => window.visualscheme.canvas.clientWidth);
  const before = await width();
  await page.getByRole("button", { name: "Fold the source" }).click();
  want(await width() === page.viewportSize().width, `the picture has ${await width()} points`);
  await page.keyboard.press("Control+b");
  want(await width() === before, "Ctrl B does not show the source");
  await page.locator("canvas").first().focus();
  await page.keyboard.press("s");
  want(await width() === page.viewportSize().width, "S does not fold the source");
  await page.getByRole("button", { name: "Show the source" }).click();
  want(await width() === before, "the button does not show the source");
  // Tab indents in the source; after Escape it leaves the source.
  await page.locator(".cm-content").focus();
  await page.keyboard.press("Escape");
  await page.keyboard.press("Tab");
  want(!(await page.evaluate(() => document.activeElement.classList.contains("cm-content"))), "Escape, then Tab stays in the source");
  want((await text()) === source, "leaving the source changed it");
});

await test("the cube shows standard views, corner views, and turns", async (want) => {
  const way = () => page.evaluate(() => window.visualscheme.control.direction().toArray().map((x) => Math.round(1000 * x) / 1000).join());
  const click = async (q) => { await page.locator(q).dispatchEvent("pointerdown"); await page.locator(q).dispatchEvent("pointerup"); };
  for (const [name, wanted] of [["top", "0,0,1"], ["front", "0,-1,0"], ["right", "1,0,0"]]) {
    await page.evaluate(() => window.visualscheme.control.from(-Math.PI / 4, Math.atan(Math.SQRT1_2)));
    await click(`.cube [data-view=${name}]`);
    want((await way()) === wanted, `${name}: ${await way()}`);
  }
  await page.evaluate(() => window.visualscheme.control.from(-Math.PI / 4, Math.atan(Math.SQRT1_2)));
  await click('.cube [data-corner="-1,-1,1"]');
  want((await way()) === "-0.577,-0.577,0.577", `the corner: ${await way()}`);
  const box = await page.locator(".cube").boundingBox(), before = await way();
  await page.mouse.move(box.x + 50, box.y + 50);
  await page.mouse.down();
  await page.mouse.move(box.x + 80, box.y + 50, { steps: 3 });
  await page.mouse.up();
  const turned = await way(), size = page.viewportSize();
  want(turned !== before, "a drag does not turn the model");
  await page.setViewportSize({ width: size.width + 40, height: size.height });
  await page.waitForTimeout(150);
  want((await way()) === turned, "a resized window undoes the drag");
  await page.setViewportSize(size);
  await page.evaluate(() => { window.visualscheme.view("start"); });
});

await test("the grid has round squares and numbers", async (want) => {
  await page.evaluate(() => window.visualscheme.setGrid(true));
  const numbers = await page.locator(".tick").allTextContents();
  want(numbers.length >= 2 && numbers.includes("0") && numbers.every((n) => Number.isFinite(Number(n))), `numbers: ${numbers}`);
  await page.evaluate(() => window.visualscheme.setGrid(false));
  want(await page.locator(".tick").count() === 0, "the numbers stay");
});

await test("a model that leaves the frame is framed again", async (want) => {
  const seen = () => page.evaluate(() => window.visualscheme.control.outOfFrame());
  want(!(await seen()), "the model is out of frame at first");
  await page.evaluate(() => { const v = window.visualscheme; v.touched = true; v.control.state.target.x += 500; v.control.apply(); });
  want(await seen(), "500 m aside the model is in the frame");
  await after(() => page.locator('input[type=range][data-parameter=height]').fill("3.1"));
  await page.waitForFunction(() => !window.visualscheme.control.outOfFrame(), null, { timeout: 5000 }).catch(() => want(false, "the next run does not frame the model"));
  await after(() => page.locator('input[type=range][data-parameter=height]').fill("6"));
});

await test("reset goes back to what the source says", async (want) => {
  for (const label of ["Reset Height of the towers", "Reset roofed", "Reset style"]) await page.locator(`button[aria-label^="${label}"]`).click();
  await page.waitForFunction(() => window.visualscheme.model.count === 4 && window.visualscheme.model.size[2] === 5, null, { timeout: 20000 });
  // A slider that returns to the source's value has changed nothing: the parameter follows the source.
  const slider = page.locator('input[type=range][data-parameter=height]');
  await after(() => slider.fill("6"));
  await after(() => slider.fill("3"));
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 5, null, { timeout: 20000 });
  want(await page.locator(".parameter.changed").count() === 0, "3 is told to be another value than 3.0");
  await after(() => writeFileSync(model, source.replace("height 3.0", "height 4.0")));
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 6, null, { timeout: 20000 });
  await after(() => writeFileSync(model, source));
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 5, null, { timeout: 20000 });
});

await test("write to source changes the literals alone", async (want) => {
  await after(() => page.locator('input[type=range][data-parameter=height]').fill("4.5"));
  await after(() => page.locator("#parameter-roofed").uncheck());
  await page.getByRole("button", { name: "Write to source" }).click();
  await page.waitForFunction(() => !window.live.source.dirty);
  const wanted = source.replace("height 3.0", "height 4.5").replace("roofed #t", "roofed #f");
  await page.waitForTimeout(300);
  want(readFileSync(model, "utf8") === wanted, "the file is " + readFileSync(model, "utf8").split("\n").slice(1, 4).join(" | "));
});

await test("saving in another editor shows, and the camera stays", async (want) => {
  const before = await eye();
  await after(() => writeFileSync(model, source));
  await page.waitForFunction(() => window.visualscheme.model.count === 4, null, { timeout: 20000 });
  want((await eye()) === before, "the camera moved");
  want((await text()) === source, "the source pane has the old text");
});

await test("a save makes no shader anew", async (want) => {
  const programs = () => page.evaluate(() => { // After a picture of each kind: which are drawn depends on how quick the machine is.
    const { stage } = window.visualscheme;
    stage.shadowsDirty = true;
    stage.draw(true);
    stage.draw();
    stage.paint(2);
    return stage.renderer.info.programs.map((p) => p.id);
  });
  const before = await programs();
  await after(() => writeFileSync(model, source.replace("height 3.0", "height 3.5")));
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 5.5, null, { timeout: 20000 });
  const anew = (await programs()).filter((id) => !before.includes(id));
  want(before.length > 2 && anew.length === 0, `${anew.length} shaders anew, ${before.length} were there`);
  await after(() => writeFileSync(model, source));
});

await test("a coarse picture comes first where pictures take long, then the whole one", async (want) => {
  const drawn = async (took, action) => {
    await page.waitForFunction(() => !window.visualscheme.stage.dirty && !window.visualscheme.stage.owed, null, { timeout: 20000 });
    await page.evaluate((took) => {
      const { stage } = window.visualscheme, draw = Object.getPrototypeOf(stage).draw;
      window.drawn = [];
      Object.defineProperty(stage, "took", { get: () => took, set: () => {}, configurable: true });
      const { renderer } = stage, render = Object.getPrototypeOf(renderer).render || renderer.render, targets = []; // How wide what is drawn into is.
      renderer.render = (scene, camera) => { if (scene === stage.scene) targets.push((renderer.getRenderTarget() || stage.canvas).width); render.call(renderer, scene, camera); };
      window.unspy = () => { renderer.render = render; };
      stage.draw = (coarse = false) => {
        draw.call(stage, coarse);
        window.drawn.push({ coarse, share: targets.at(-1) / Math.floor(stage.canvas.clientWidth * stage.ratio), shadow: stage.sun.shadow.intensity });
      };
    }, took);
    await after(action);
    await page.waitForFunction(() => window.drawn.length > 0 && !window.drawn.at(-1).coarse, null, { timeout: 20000 });
    return page.evaluate(() => { delete window.visualscheme.stage.draw; window.unspy(); return window.drawn; });
  };
  const slow = await drawn(1000, () => writeFileSync(model, source.replace("height 3.0", "height 3.5"))), first = slow[0], last = slow.at(-1);
  want(first.coarse && Math.abs(first.share - 0.5) < 0.01 && first.shadow === 0, "the first picture is not coarse: " + JSON.stringify(first));
  want(last.share === 1 && last.shadow === 1, "the last picture is not whole: " + JSON.stringify(last));
  const quick = await drawn(10, () => writeFileSync(model, source));
  want(quick.every((d) => !d.coarse && d.share === 1), "coarse although pictures are quick: " + JSON.stringify(quick));
  await page.evaluate(() => delete window.visualscheme.stage.took);
});

await test("an error dims the last good model and heals", async (want) => {
  await after(() => writeFileSync(model, source.replace("(make-cylinder at height 1)", "(make-cylinder at heigth 1)")));
  let f = await facts();
  want(!f.good && f.count === 4, "the last model is gone");
  want(/heigth/.test(f.messages.join()), f.messages.join());
  want(await page.locator(".view.stale").count() === 1, "the view is not dimmed");
  want(await page.locator(".message.error pre").count() > 0 && (await page.locator(".message.error pre").first().textContent()).includes("^"), "no caret under the source line");
  await page.locator(".message.error button").first().click();
  const line = await page.evaluate(() => window.live.source.position(window.live.source.view.state.selection.main.head).line);
  want(line === 7, `the message leads to line ${line}`);
  // A parameter that fails removes none of the controls.
  await after(() => writeFileSync(model, source.replace("roofed #t", "roofed (sqroot 2)")));
  await page.waitForFunction(() => window.live.state.messages.some((m) => m.message.includes("sqroot")), null, { timeout: 20000 });
  const names = await page.evaluate(() => window.live.parameters.infos.map((p) => p.name).join());
  want(names === "height,roofed,style" && await page.locator("#parameter-style").count() === 1, `parameters that are left: ${names}`);
  await after(() => writeFileSync(model, source));
  f = await facts();
  want(f.good && await page.locator(".view.stale").count() === 0, "it did not heal");
});

await test("a program that draws nothing is an empty picture", async (want) => {
  await after(() => writeFileSync(model, "; nothing yet\n"));
  await page.waitForFunction(() => window.visualscheme.model.count === 0 && window.live.state.good, null, { timeout: 10000 });
  await page.evaluate(() => window.visualscheme.canvas.focus());
  for (const open of [true, false]) { // Neither has it a construction.
    await page.keyboard.press("b");
    await page.waitForFunction((open) => window.live.timeline.isOpen === open, open, { timeout: 5000 });
    await page.waitForTimeout(300);
  }
  want(page.troubles.length === 0, page.troubles.join("; "));
  await after(() => writeFileSync(model, source));
  await page.waitForFunction(() => window.visualscheme.model.count === 4, null, { timeout: 10000 });
});

await test("a click on a face marks its line, the path climbs", async (want) => {
  await page.evaluate(() => window.visualscheme.view("front"));
  await page.waitForFunction(() => !window.visualscheme.control.motion);
  const p = await onScreen([8, -1, 2.5]);
  await page.mouse.click(p.x, p.y);
  want(await page.locator(".cm-line .made").count() > 0, "nothing is marked");
  const made = await page.locator(".cm-line .made").first().textContent();
  want(made.startsWith("(make-cylinder"), `marked: ${made}`);
  const climb = page.locator(".card .path button");
  want(await climb.count() >= 2, "the card has no path");
  want(/^towers\.vs:\d+$/.test(await climb.first().textContent()), `the path begins with ${await climb.first().textContent()}`);
  await climb.nth(1).click();
  const called = await page.locator(".cm-line .made").first().textContent();
  want(/tower/.test(called), `the caller marked: ${called}`);
});

await test("the cursor on an expression chooses what it made", async (want) => {
  const at = source.indexOf("(make-cone") + 3;
  await page.evaluate((at) => window.live.source.view.dispatch({ selection: { anchor: at }, userEvent: "select" }), at);
  await page.waitForFunction(() => { const v = window.visualscheme; return v.chosen.length === 1 && v.model.where(v.chosen[0]).line === 11; }, null, { timeout: 5000 });
  const line = await page.evaluate(() => { const v = window.visualscheme; return v.model.where(v.chosen[0]).line; });
  want(line === 11, `chosen: what line ${line} made`);
});

await test("the sky is behind parallel views, too", async (want) => {
  for (const view of ["front", "top", "iso"]) {
    await page.evaluate((view) => window.visualscheme.view(view), view);
    await page.waitForFunction(() => !window.visualscheme.control.motion);
    const corner = await page.evaluate(() => {
      const { stage } = window.visualscheme, gl = stage.renderer.getContext(), bytes = new Uint8Array(4);
      stage.draw();
      gl.readPixels(gl.drawingBufferWidth - 5, gl.drawingBufferHeight >> 1, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
      return [...bytes];
    });
    want(corner[0] + corner[1] + corner[2] > 300, `${view}: the background is ${corner.slice(0, 3)}`);
  }
});

await test("measuring says lengths", async (want) => {
  await page.evaluate(() => { window.visualscheme.select([]); window.visualscheme.view("front"); });
  await page.locator('[data-do="measure"]').click();
  await page.waitForFunction(() => !window.visualscheme.control.motion);
  const p = await onScreen([2, -0.5, 1.5]);
  await page.mouse.click(p.x, p.y);
  const told = await page.locator(".live[role=status]").textContent();
  want(/^4\.\d* m²$|^\d.* m²$/.test(told), `told: ${told}`);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
});

await test("a click on a ball measures its radius and whole area", async (want) => {
  await page.locator(".console input").fill("(draw (make-sphere (xyz 4 0 6) 1))");
  await after(() => page.keyboard.press("Enter"));
  await page.evaluate(() => { window.visualscheme.view("front"); });
  await page.locator('[data-do="measure"]').click();
  await page.waitForFunction(() => !window.visualscheme.control.motion);
  const p = await onScreen([4.3, -Math.sqrt(1 - 0.09 - 0.04), 6.2]);
  await page.mouse.click(p.x, p.y);
  const says = page.locator(".live[role=status]");
  await page.waitForFunction(() => document.querySelector(".live[role=status]").textContent.startsWith("radius"), null, { timeout: 10000 }).catch(() => {});
  want(/^radius 1 m +12\.57 m²$/.test(await says.textContent()), `told: ${await says.textContent()}`);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await after(() => writeFileSync(model, source + "\n"));
  await after(() => writeFileSync(model, source));
});

await test("a section shows its cut", async (want) => {
  await page.locator('[data-do="section"]').click();
  await page.locator('.strip [data-axis="y"]').click();
  want(await page.locator(".overlay .handle").count() === 1, "no handle");
  const output = await page.locator(".strip:visible output").textContent();
  want(/m$/.test(output), output);
  await page.locator('button[aria-label="No section"]').click();
});

await test("the prompt shares the session", async (want) => {
  await page.locator(".console input").fill("(* 6 7)");
  await after(() => page.keyboard.press("Enter"));
  want((await page.locator(".console pre").textContent()).includes("42"), await page.locator(".console pre").textContent());
  await page.locator(".console input").fill("(draw (make-sphere (xyz 4 0 6) 1))");
  await after(() => page.keyboard.press("Enter"));
  want((await facts()).count === 5, `${(await facts()).count} parts`);
  await page.locator(".console input").fill("(car 5)");
  await after(() => page.keyboard.press("Enter"));
  const talk = await page.locator(".console pre").textContent();
  want(talk.includes("› (* 6 7)\n42\n› (draw (make-sphere"), "what was typed before is gone: " + talk);
  want((await page.locator(".message.error").textContent()).includes("car"), "the error is not told");
  want(await page.locator(".view.stale").count() === 0 && (await facts()).count === 5, "an error of what was typed takes the model away");
  want(await page.locator(".message.error button").count() === 0, "a place at the prompt leads into the source");
  await after(() => writeFileSync(model, source + "\n"));
  await after(() => writeFileSync(model, source));
});

await test("completion comes from the interpreter", async (want) => {
  await page.evaluate(() => { const v = window.live.source.view; v.dispatch({ selection: { anchor: v.state.doc.length } }); v.focus(); });
  await page.keyboard.type("(make-cyl");
  await page.waitForSelector(".cm-tooltip-autocomplete", { timeout: 5000 });
  want((await page.locator(".cm-tooltip-autocomplete").textContent()).includes("make-cylinder"), "make-cylinder is not offered");
  await page.waitForSelector(".cm-completionInfo", { timeout: 5000 });
  want(/^make-cylinder /.test(await page.locator(".cm-completionInfo").textContent()), await page.locator(".cm-completionInfo").textContent());
  await page.keyboard.press("Escape");
  await page.keyboard.type(" (tow");
  await page.waitForFunction(() => document.querySelector(".cm-tooltip-autocomplete")?.textContent.includes("tower"), null, { timeout: 5000 });
  await page.keyboard.press("Escape");
  await page.evaluate(() => window.live.source.load(window.live.source.base));
});

await test("how a call is written stands below the source, its argument set off", async (want) => {
  const put = async (text) => {
    await page.evaluate((text) => { const s = window.live.source, v = s.view, at = text.indexOf("|"); v.dispatch({ changes: { from: 0, to: v.state.doc.length, insert: s.base + text.replace("|", "") } }); v.dispatch({ selection: { anchor: s.base.length + at } }); }, text);
    await page.waitForTimeout(400);
    return page.evaluate(() => { const h = document.querySelector(".hint-line"); return h.hidden ? "" : h.querySelector("p").textContent + " / " + [...h.querySelectorAll("p:first-child b")].map((b) => b.textContent); });
  };
  want(/^make-cylinder .* \/ c2$/.test(await put("(make-cylinder (xyz 0 0 0) |)")), "of the language: " + await put("(make-cylinder (xyz 0 0 0) |)"));
  want(await put("(tower |") === "tower at / at", "of the program: " + await put("(tower |"));
  want(/^xyz /.test(await put("(tower (xyz 1 |))")), "the innermost: " + await put("(tower (xyz 1 |))"));
  want(await put("(list 1 2)\n|") === "", "outside of calls");
  await page.evaluate(() => window.live.source.load(window.live.source.base));
});

await test("any number can be turned, unsaved", async (want) => {
  const at = source.indexOf("1.3)");
  await page.evaluate((at) => { const v = window.live.source.view; v.dispatch({ selection: { anchor: at + 1 }, scrollIntoView: true }); v.focus(); }, at);
  for (let i = 0; i < 7; i++) await page.keyboard.press("Control+ArrowUp");
  await page.waitForFunction(() => window.visualscheme.model.size[1] === 4, null, { timeout: 10000 });
  want((await text()) === source.replace("1.3)", "2.0)"), "the text is another");
  want(readFileSync(model, "utf8") === source, "the file was written");
  const spot = await page.evaluate((at) => { const r = window.live.source.view.coordsAtPos(at + 1); return { x: (r.left + r.right) / 2 + 2, y: (r.top + r.bottom) / 2 }; }, at);
  await page.keyboard.down("Alt");
  await page.mouse.move(spot.x, spot.y);
  await page.mouse.down();
  await page.mouse.move(spot.x + 60, spot.y, { steps: 8 });
  await page.mouse.up();
  await page.keyboard.up("Alt");
  await page.waitForFunction(() => window.visualscheme.model.size[1] === 6, null, { timeout: 10000 });
  want((await text()) === source.replace("1.3)", "3.0)"), "dragging gave " + (await text()).split("\n")[10]);
  await page.evaluate(() => { const s = window.live.source; s.load(s.base); s.attempt(s.base); });
  await page.waitForFunction(() => Math.abs(window.visualscheme.model.size[1] - 2.6) < 1e-5, null, { timeout: 10000 });
});

await test("what looks wrong shows while it is typed", async (want) => {
  const put = (insert) => page.evaluate((insert) => { const v = window.live.source.view; v.dispatch({ changes: { from: v.state.doc.length, insert } }); }, insert);
  await put("(define (unusual a b) (* a a))\n(draw (unusual 1 2 3))\n");
  await page.waitForFunction(() => window.live.source.found.length >= 2, null, { timeout: 10000 });
  const found = await page.evaluate(() => window.live.source.found.map((f) => f.at.line + " " + f.message));
  want(found.some((f) => f.startsWith("13 ")) && found.some((f) => f.startsWith("14 ")), found.join("; "));
  want(await page.locator(".cm-lint-marker-warning").count() > 0, "no mark beside the line");
  await put("(draw (make-box\n");
  await page.waitForFunction(() => window.live.source.found[0]?.severity === "error", null, { timeout: 10000 });
  want(await page.evaluate(() => window.live.source.found[0].at.line === 15), "the open parenthesis is not pointed at");
  await page.evaluate(() => { const s = window.live.source; s.load(s.base); });
  await page.waitForFunction(() => window.live.source.found.length === 0, null, { timeout: 10000 });
});

await test("sets of values are kept, compared and taken", async (want) => {
  const slider = page.locator("input[type=range][data-parameter=height]"), keep = page.getByRole("button", { name: "Keep these" });
  await after(() => slider.fill("6"));
  await keep.click();
  await after(() => slider.fill("8"));
  await keep.click();
  await after(() => page.getByRole("button", { name: "Reset all" }).click());
  await page.getByRole("button", { name: "Compare", exact: true }).click();
  const panes = () => page.evaluate(() => window.live.compare.panes.map((p) => p.stage.model && p.stage.model.size[2]));
  await page.waitForFunction(() => window.live.compare.panes.length === 3 && window.live.compare.panes.every((p) => p.stage.model), null, { timeout: 20000 });
  want((await panes()).join() === "5,8,10", `heights ${await panes()}`);
  await page.waitForFunction(() => !window.live.compare.working);
  const looks = () => page.evaluate(() => window.live.compare.panes.map((p) => { const t = p.control.eye().add(p.control.state.target.clone().fromArray(p.stage.model.middle)); return t.toArray().map((x) => x.toFixed(3)).join(); }));
  const before = await looks();
  want(new Set(before).size === 1, "the cameras differ: " + before.join(" / "));
  const box = await page.locator(".panes canvas").nth(1).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 + 10, { steps: 4 });
  await page.mouse.up();
  const turned = await looks();
  want(new Set(turned).size === 1 && turned[0] !== before[0], "turning one does not turn all: " + turned.join(" / "));
  const shown = await page.evaluate(() => window.live.compare.panes.map(({ stage }) => { // Pixels that are not the background's, by column.
    stage.draw();
    const gl = stage.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, bytes = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    let red = 0;
    for (let i = 0; i < bytes.length; i += 4) if (bytes[i] > 2 * bytes[i + 1] && bytes[i] > 60) red++;
    return red;
  }));
  want(shown.every((n) => n > 50), "no red roof in a picture: " + shown);
  await page.locator(".panes figure").nth(2).getByRole("button", { name: "Use" }).click();
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 10, null, { timeout: 10000 });
  want(await page.locator(".compare:visible").count() === 0, "it stays open");
  want(await page.evaluate(() => window.live.compare.panes.length) === 0, "its pictures stay");
});

await test("sets go into a file and come back", async (want) => {
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save file" }).click()]);
  want(download.suggestedFilename() === "towers.json", download.suggestedFilename());
  const held = JSON.parse(readFileSync(await download.path(), "utf8"));
  want(held.now.height === "8" && held["Set 1"].height === "6" && held["Set 2"].roofed === "#t", JSON.stringify(held));
  for (const name of ["Set 1", "Set 2"]) await page.getByRole("button", { name: "Forget the set " + name }).click();
  const load = async (name, text) => {
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.getByRole("button", { name: "Load file" }).click()]);
    await chooser.setFiles({ name, mimeType: "application/json", buffer: Buffer.from(text) });
  };
  await load("low.json", JSON.stringify({ height: 2, roofed: false, none: 1 }));
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 2 && window.live.parameters.sets.has("low"), null, { timeout: 10000 });
  await load("towers.json", JSON.stringify({ "<b>a</b>": held["Set 1"], b: held["Set 2"] }));
  await page.waitForFunction(() => window.live.parameters.sets.size === 3);
  await load("bad.json", "[1, 2");
  await page.waitForFunction(() => /bad.json cannot be read/.test(document.querySelector(".said").textContent));
  await load("none.json", '{"other": 3}');
  await page.waitForFunction(() => /none of its names/.test(document.querySelector(".said").textContent));
  const link = await page.evaluate(() => new Promise((go) => { navigator.clipboard.writeText = (text) => { go(text); return Promise.resolve(); }; [...document.querySelectorAll("button")].find((b) => b.textContent === "Copy link").click(); }));
  want(link === url + "&height=2&roofed=%23f", link);
  await after(() => page.getByRole("button", { name: "Reset all" }).click());
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 5, null, { timeout: 10000 });
  const other = await open(context, link);
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 2, null, { timeout: 10000 });
  await other.close();
  await page.getByRole("button", { name: "Reset all" }).click();
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 5, null, { timeout: 10000 });
  for (const name of ["low", "<b>a</b>", "b"]) await page.getByRole("button", { name: "Forget the set " + name }).click();
});

await test("a newer file is not written over without a question", async (want) => {
  await page.evaluate(() => { const v = window.live.source.view; v.dispatch({ changes: { from: 0, insert: "; mine\n" } }); });
  writeFileSync(model, source.replace("two towers", "2 towers"));
  await page.waitForTimeout(500);
  await page.evaluate(() => window.live.save());
  want(await page.locator(".conflict:visible").count() === 1 && /changed on disk/.test(await page.locator(".conflict").textContent()), "nobody asked");
  await page.getByRole("button", { name: "Later" }).click();
  want(readFileSync(model, "utf8").includes("2 towers"), "the newer file is gone");
  want((await text()).startsWith("; mine"), "what was typed is gone");
  await page.evaluate(() => { const s = window.live.source; s.load(s.base); });
  await after(() => writeFileSync(model, source));
  await page.evaluate(() => window.live.readSource());
  want((await text()) === source, "the source pane has the old text");
});

await test("the stop button ends a model that never ends", async (want) => {
  writeFileSync(model, source + "(let spin () (spin))\n");
  await page.waitForFunction(() => !window.live.stopButton.disabled, null, { timeout: 10000 });
  await page.getByRole("button", { name: "Stop" }).click();
  await page.waitForFunction(() => window.live.state.stopped, null, { timeout: 10000 });
  writeFileSync(model, source);
  await page.waitForFunction(() => window.live.state.good && !window.live.state.stopped, null, { timeout: 10000 });
});

await test("keys alone reach everything", async (want) => {
  await page.evaluate(() => window.visualscheme.canvas.focus());
  const before = await eye();
  await page.keyboard.press("ArrowLeft");
  await page.waitForTimeout(200);
  want((await eye()) !== before, "arrow keys do not turn it");
  await page.keyboard.press("l");
  want(await page.locator(".panel:visible").count() === 1, "L does not open the panel");
  await page.keyboard.press("l");
  await page.keyboard.press("?");
  want(await page.locator(".help:visible").count() === 1, "? does not open the help");
  await page.keyboard.press("Escape");
  await page.evaluate(() => document.activeElement.blur());
  const names = new Set();
  for (let i = 0; i < 60; i++) {
    await page.keyboard.press("Escape"); // In the editor Tab indents; after Escape it goes on.
    await page.keyboard.press("Tab");
    names.add(await page.evaluate(() => document.activeElement.getAttribute("aria-label") || document.activeElement.textContent.trim() || document.activeElement.id || document.activeElement.tagName));
  }
  for (const wanted of ["Section plane", "Measure", "Export"]) want(names.has(wanted), `${wanted} cannot be reached by Tab`);
});

await test("a copied link says that it carries the key", async (want) => {
  await page.evaluate(() => { navigator.clipboard.writeText = async (text) => { window.copied = text; }; });
  await page.getByRole("button", { name: "Copy link" }).click();
  await page.waitForFunction(() => document.querySelector(".parameters .said").textContent !== "");
  const said = await page.locator(".parameters .said").textContent(), copied = await page.evaluate(() => window.copied);
  want(copied.includes(new URL(url).hash) && /contains this view's key/.test(said), `copied ${copied}, said: ${said}`);
});

await test("export downloads what was asked", async (want) => {
  const offered = await page.evaluate(() => [...document.querySelector(".exports select").options].map((o) => o.value));
  const told = (await (await fetch(new URL(url).origin + "/formats", { headers: { "X-VS-Token": new URL(url).hash.slice(1) } })).json()).map((f) => f.name);
  want(told.length > 15 && offered.join() === told.filter((name) => !/^x3d-/.test(name)).join(), `offered: ${offered}`);
  await page.getByLabel("Format", { exact: true }).selectOption("stl");
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Export" }).click()]);
  want(download.suggestedFilename() === "towers.stl", download.suggestedFilename());
  want(readFileSync(await download.path()).length > 84, "it is empty");
});

await test("two windows see the same", async (want) => {
  const other = await open(context, url);
  await other.waitForFunction(() => window.live.finished > 0);
  await after(() => page.locator('input[type=range][data-parameter=height]').fill("7"));
  await other.waitForFunction(() => window.visualscheme.model.size[2] === 9, null, { timeout: 10000 });
  await after(() => page.locator('button[aria-label^="Reset Height"]').click());
  want(other.troubles.length === 0, other.troubles.join("; "));
  await other.close();
});

await test("a hundred saves in a row end with the last", async (want) => {
  for (let i = 1; i <= 100; i++) {
    writeFileSync(model, source.replace("height 3.0", `height ${(3 + i / 100).toFixed(2)}`));
    await new Promise((go) => setTimeout(go, 5));
  }
  await page.waitForFunction(() => Math.abs(window.visualscheme.model.size[2] - 6) < 1e-6, null, { timeout: 20000 }).catch(async (e) => { console.log(JSON.stringify(await facts()), JSON.stringify(await page.evaluate(() => window.live.state.parameters))); throw e; });
  want(true);
  await after(() => writeFileSync(model, source));
});

await test("a phone's width holds it all", async (want) => {
  await page.setViewportSize({ width: 360, height: 740 });
  await page.waitForTimeout(300);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  want(wide <= 360, `it is ${wide} pixels wide`);
  const overlaps = await page.evaluate(() => {
    const seen = [...document.querySelectorAll(".bar, .exports, .parameters, .title, .console, .top")].filter((e) => e.offsetParent).map((e) => [e.className, e.getBoundingClientRect()]), bad = [];
    for (let i = 0; i < seen.length; i++) for (let k = i + 1; k < seen.length; k++) {
      const [a, p] = seen[i], [b, q] = seen[k];
      if (p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 1 && q.top < p.bottom - 1) bad.push(`${a} / ${b}`);
    }
    return bad;
  });
  want(overlaps.length === 0, "these overlap: " + overlaps.join(", "));
  await page.setViewportSize({ width: 1100, height: 640 });
});

await test("no script of the page has failed", async (want) => { want(page.troubles.filter((t) => !/403|409/.test(t)).length === 0, page.troubles.join("; ")); });

// A separate model, with parameters of all kinds.
const kinds = `${folder}/kinds.vs`;
writeFileSync(kinds, `(define-parameter span 0.30000001192092896 #:min 0.1 #:max 1 #:unit "m")
(define-parameter budget 123456789.25)
(define-parameter door (xyz 12.3456789 -6 0))
(define-parameter far (xyz 900 0 0))
(define-parameter finish "white plaster" #:choices '("white plaster" "oak"))
(define-parameter title "A pavilion for the garden")
(define-parameter open #t)
(draw (make-box (xyz 0 0 0) (xyz 2 2 spam)))
`);
const all = await session(vs, kinds, [], page.context().browser(), false);
await all.test("a program that fails at first says so, and then shows", async (want) => {
  await all.page.waitForFunction(() => window.live.finished > 0);
  want(/Nothing can be shown yet/.test(await all.page.locator(".stale-note").textContent()), await all.page.locator(".stale-note").textContent());
  await all.after(() => writeFileSync(kinds, readFileSync(kinds, "utf8").replace("spam", "span")));
  await all.page.waitForFunction(() => window.visualscheme.stage.drawCalls > 0, null, { timeout: 20000 });
  want(await all.page.locator(".stale-note:visible").count() === 0, "the note stays");
});
await all.test("parameters show whole numbers and units, in controls that can be hit", async (want) => {
  for (const width of [1100, 390]) {
    await all.page.setViewportSize({ width, height: 800 });
    await all.page.evaluate(() => { document.querySelector(".parameters").open = true; });
    const seen = await all.page.evaluate(() => {
      const controls = [...document.querySelectorAll(".parameters input, .parameters button, .parameters select")].filter((e) => e.offsetParent && getComputedStyle(e).visibility === "visible");
      return { cut: controls.filter((e) => e.type !== "range" && e.scrollWidth > e.clientWidth + 1).map((e) => e.id || e.textContent),
        small: controls.filter((e) => { const r = e.getBoundingClientRect(); return Math.min(r.width, r.height) < 18; }).map((e) => e.id || e.getAttribute("aria-label")),
        out: controls.filter((e) => e.getBoundingClientRect().right > innerWidth + 0.5).map((e) => e.id), units: [...document.querySelectorAll(".parameters .unit")].map((e) => e.textContent) };
    });
    want(seen.cut.length === 0 && seen.small.length === 0 && seen.out.length === 0 && seen.units.join() === "m", width + ": " + JSON.stringify(seen));
  }
});
await all.test("a point far off does not make the model a speck", async (want) => {
  await all.page.setViewportSize({ width: 1100, height: 640 });
  const again = await open(all.context, all.url);
  await again.waitForFunction(() => window.visualscheme.handles.length === 2, null, { timeout: 10000 });
  const share = await again.evaluate(() => { const { stage } = window.visualscheme, c = stage.camera; return stage.radius / c.position.distanceTo(stage.center); });
  want(share > 0.1, `radius to distance ${share}`);
  await again.close();
});
await all.close();

const script = `${folder}/script.js`;
writeFileSync(script, "var x = 3;\nfunction twice(a, b) { return a + a; }\ntwice(1, 2);\n");
const other = await session(vs, script, [], page.context().browser());
await other.test("a model in JavaScript is checked", async (want) => {
  await other.page.waitForFunction(() => window.live.source?.found.length >= 2, null, { timeout: 10000 });
  const found = await other.page.evaluate(() => window.live.source.found.map((f) => f.at.line + " " + f.message).join("; "));
  want(found === "1 nothing uses the variable x; 2 twice does not use its parameter b", found);
});
await other.close();

await end();
