// Owns the tests of drawing while the user types, of a file that changes meanwhile, and of the controls of another
// program. `live_typing.mjs VS FOLDER`.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { session } from "./live_session.mjs";
import { patience } from "./patience.mjs";

const [, , vs, folder] = process.argv, model = `${folder}/typed.vs`;
const source = `; a box
(define-parameter height 3.0 #:min 1 #:max 9)
(draw (make-box origin (xyz 1 1 height)))
`;
mkdirSync(folder, { recursive: true });
writeFileSync(model, source);
const { page, test, after, end } = await session(vs, model);
const pause = (ms) => new Promise((go) => setTimeout(go, ms));
const facts = () => page.evaluate(() => { const { live } = window; return { size: live.viewer.model.size.map((x) => Math.round(1000 * x) / 1000), good: live.state.good, run: live.state.run, trial: live.state.trial,
  messages: live.state.messages.map((m) => m.message), stale: live.viewPlace.classList.contains("stale"), panel: !live.messages.hidden, text: live.source.text }; });
const shown = (height, timeout = 10000) => page.waitForFunction((h) => Math.abs(window.visualscheme.model.size[2] - h) < 1e-6, height, { timeout });
// Puts the cursor after a text, and types there as a user does.
async function type(where, keys, options) {
  await page.evaluate((where) => { const { view } = window.live.source, at = view.state.doc.toString().indexOf(where) + where.length; view.dispatch({ selection: { anchor: at } }); view.focus(); }, where);
  for (const key of keys) await (key.length > 1 ? page.keyboard.press(key) : page.keyboard.type(key));
}
async function fresh() {
  writeFileSync(model, source);
  await page.evaluate(() => window.live.conflict.close());
  await page.evaluate((text) => { const { live } = window; live.source.load(text); live.source.attempt(text); return live.readSource(); }, source);
  await page.waitForFunction((text) => window.live.source.text === text && !window.live.state.trial && window.live.state.good && window.live.state.parameters[0]?.default === "3.0" && Math.abs(window.visualscheme.model.size[2] - 3) < 1e-6, source, { timeout: 10000 });
  for (let run = -1, now; (now = (await facts()).run) !== run; run = now) await pause(400); // No run is on its way.
}
await page.waitForFunction(() => window.live.finished > 0);

await test("the picture follows what is typed, unsaved", async (want) => {
  await type("height 3", [], {});
  await page.keyboard.press("Backspace");
  const from = Date.now();
  await page.keyboard.type("5");
  await shown(5);
  const took = Date.now() - from;
  want(took < patience(1500), `it took ${took} ms`); // The promise of 500 ms is measured by bench/pages on an idle machine.
  want(readFileSync(model, "utf8") === source, "the file was written");
  want((await facts()).trial, "it is no unsaved text");
  await page.keyboard.press("Control+s");
  await page.waitForFunction(() => !window.live.source.dirty && !window.live.state.trial);
  want(readFileSync(model, "utf8") === source.replace("3.0", "5.0"), "Save wrote " + readFileSync(model, "utf8"));
  await fresh();
});

await test("a text that does not read whole is not run", async (want) => {
  const before = await facts();
  for (const [where, keys] of [["height)))", ["Enter", "(", "Delete"]], ["; a box", ["Enter", "#", "|", " ", "x"]], ["; a box", ["Enter", '"', "Delete", "x"]], ["height)))", ["Backspace"]]]) {
    await type(where, keys);
    await pause(700);
    const now = await facts();
    want(now.run === before.run && now.good && !now.stale, `${keys.join("")}: run ${now.run - before.run} times, good ${now.good}: ${now.text}`);
    await page.evaluate((text) => window.live.source.load(text), source);
  }
  await fresh();
});

await test("a mistake while typing stays in the margin, the last picture stays", async (want) => {
  await type("1 1 height", ["x"]);
  await page.waitForFunction(() => window.live.state.trial && !window.live.state.good, null, { timeout: 10000 });
  await page.waitForSelector(".cm-lint-marker-error", { timeout: 5000 });
  const now = await facts();
  want(now.size.join() === "1,1,3" && !now.stale && !now.panel && /heightx/.test(now.messages.join()), JSON.stringify(now));
  want(/1 error/.test(await page.locator(".top .status").textContent()), "the status: " + await page.locator(".top .status").textContent());
  await page.keyboard.press("Backspace");
  await page.waitForFunction(() => window.live.state.good && document.querySelectorAll(".cm-lint-marker-error").length === 0, null, { timeout: 10000 });
  await fresh();
});

await test("the switch turns drawing while typing off, and on again", async (want) => {
  const button = page.getByRole("button", { name: "As you type" });
  want(await button.getAttribute("aria-pressed") === "true", "it is off at first");
  await button.click();
  await type("height 3", ["Backspace", "6"]);
  await pause(800);
  want((await facts()).size[2] === 3, "it drew");
  await page.reload();
  await page.waitForFunction(() => window.live?.finished > 0);
  want(await button.getAttribute("aria-pressed") === "false", "the page forgot it");
  await type("height 3", ["Backspace", "7"]);
  await button.click();
  await shown(7);
  await fresh();
});

await test("an unsaved text neither writes nor deletes files", async (want) => {
  const kept = `${folder}/kept.txt`, made = `${folder}/made.txt`;
  writeFileSync(kept, "kept");
  for (const [does, word] of [[`(delete-file "${kept}")`, "deletes"], [`(call-with-output-file "${made}" (lambda (p) (display 1 p)))`, "writes"], [`(with-output-to-file "${made}" (lambda () (display 1)))`, "writes"], [`(close-port (open-binary-output-file "${made}"))`, "writes"]]) {
    const run = (await facts()).run;
    await page.evaluate((text) => { const { view } = window.live.source; view.dispatch({ changes: { from: view.state.doc.length, insert: text + "\n" }, userEvent: "input.paste" }); }, does);
    await page.waitForFunction((run) => window.live.state.run > run && !window.live.state.good, run, { timeout: 10000 });
    const now = await facts();
    want(existsSync(kept) && !existsSync(made) && now.messages.some((m) => m.includes(`an unsaved one ${word} no files`)), `${does}: ${now.messages}`);
    await fresh();
  }
  await after(() => writeFileSync(model, source + `(call-with-output-file "${made}" (lambda (p) (display 1 p)))\n`));
  want(existsSync(made), "a saved text writes no file");
  await fresh();
});

await test("a slow model is drawn coarse while its user types, then whole", async (want) => {
  const slow = "; a ball\n(define until (+ (current-milliseconds) 300))\n(let wait () (if (< (current-milliseconds) until) (wait)))\n(draw (make-sphere origin 1))\n";
  await after(() => writeFileSync(model, slow));
  // Waits until the number of the picture's bytes is between two numbers, and returns it.
  const bytes = (least, most) => page.waitForFunction(([least, most]) => {
    const n = [...window.live.pieces.values()].reduce((n, p) => n + p.length, 0);
    return n >= least && n <= most && n;
  }, [least, most], { timeout: 10000 }).then((n) => n.jsonValue());
  const whole = await bytes(1, Infinity);
  await type("; a ball", ["x"]);
  await page.waitForFunction(() => window.live.state.trial && window.live.rough, null, { timeout: 10000 });
  await bytes(1, whole / 2);
  await bytes(whole, whole);
  // What was typed before a save does not come back when another editor saves at once.
  await type("; a ball", ["x"]);
  await page.waitForFunction(() => window.live.state.trial && window.live.rough, null, { timeout: 10000 });
  await page.keyboard.press("Control+s");
  await page.waitForFunction(() => !window.live.source.dirty);
  writeFileSync(model, source);
  await shown(3);
  await pause(1500);
  const now = await facts();
  want(!now.trial && now.size[2] === 3 && now.text === source, "a text from before came back: " + JSON.stringify(now));
  await fresh();
});

await test("a text that could not be sent does not end drawing while the user types", async (want) => {
  await page.route("**/try*", (route) => route.abort());
  await type("height 3", ["Backspace", "4"]);
  await pause(800);
  await page.unroute("**/try*");
  want((await facts()).size[2] === 3, "the text was sent");
  await type("height 4", ["Backspace", "5"]);
  await shown(5);
  await fresh();
});

await test("controls of the program before are gone when another program fails", async (want) => {
  const names = () => page.evaluate(() => window.live.parameters.infos.map((p) => p.name).join());
  writeFileSync(`${folder}/part.vs`, "(define-parameter depth 2.0)\n");
  await after(() => writeFileSync(model, source + '(load "part.vs")\n(draw (make-box origin (xyz depth 1 1)))\n'));
  want(await names() === "height,depth", "at first: " + await names());
  await after(() => writeFileSync(model, "(car 5)\n" + source + '(load "part.vs")\n'));
  want(await names() === "height,depth", "a mistake before them takes them away: " + await names());
  await after(() => writeFileSync(model, "(define-parameter width 2.0)\n(draw (make-box origin (xyz width 1 1)))\n(car 5)\n"));
  want(await names() === "width", "after another program: " + await names());
  want(await page.locator(".parameter").count() === 1, "rows are left");
  await after(() => writeFileSync(model, "(car 5)\n"));
  want(await names() === "" && !(await page.locator(".parameters").isVisible()), "after a program without any: " + await names());
  await fresh();
});

await test("a conflict shows both texts side by side", async (want) => {
  const disk = source.replace("1 1 height", "2 1 height") + "; from another editor\n", both = page.locator(".conflict");
  const mark = (k) => page.evaluate((k) => [...document.querySelectorAll(".conflict pre")[k].querySelectorAll(".own")].map((l) => l.textContent.trim()), k);
  const begin = async () => {
    await type("height 3", ["Backspace", "4"]);
    await shown(4);
    writeFileSync(model, disk);
    await page.waitForSelector(".newer:visible", { timeout: 10000 });
  };
  await begin();
  want(await page.evaluate(() => window.live.source.text) === source.replace("3.0", "4.0"), "the page's text is gone");
  await page.getByRole("button", { name: "Show both" }).click();
  await both.waitFor({ state: "visible" });
  const [a, b] = await Promise.all([0, 1].map((k) => page.locator(".conflict pre").nth(k).boundingBox()));
  want(b.x >= a.x + a.width && Math.abs(a.y - b.y) < 1 && a.width > 200, "they are not side by side");
  want((await mark(0)).join("|") === "(define-parameter height 4.0 #:min 1 #:max 9)|(draw (make-box origin (xyz 1 1 height)))", "marked left: " + await mark(0));
  want((await mark(1)).join("|") === "(define-parameter height 3.0 #:min 1 #:max 9)|(draw (make-box origin (xyz 2 1 height)))|; from another editor", "marked right: " + await mark(1));
  await page.keyboard.press("Escape");
  want(!(await both.isVisible()), "Escape does not close it");
  await page.evaluate(() => window.live.save());
  await both.waitFor({ state: "visible" });
  want(readFileSync(model, "utf8") === disk, "Save wrote over the newer file");
  await page.getByRole("button", { name: "Keep yours" }).click();
  await page.waitForFunction(() => !window.live.source.dirty, null, { timeout: 10000 });
  want(readFileSync(model, "utf8") === source.replace("3.0", "4.0") && !(await both.isVisible()), "yours was not kept");
  await fresh();
  await begin();
  await page.getByRole("button", { name: "Show both" }).click();
  await page.getByRole("button", { name: "Take the file's" }).click();
  await page.waitForFunction((text) => window.live.source.text === text && !window.live.source.dirty, disk, { timeout: 10000 });
  await page.waitForFunction(() => window.visualscheme.model.size[0] === 2 && window.visualscheme.model.size[2] === 3, null, { timeout: 10000 });
  want(readFileSync(model, "utf8") === disk, "the file was written");
  await fresh();
});

await test("no script of the page has failed while typing", async (want) => { want(page.troubles.filter((t) => !/409|ERR_FAILED/.test(t)).length === 0, page.troubles.join("; ")); });

await end();
