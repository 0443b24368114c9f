// Owns the tests of the live view's runs: the events that end a run, the runs that Stop ends, and that the view shows
// all messages of a program. `live_runs.mjs VS FOLDER`.
import { mkdirSync, writeFileSync } from "node:fs";
import { session } from "./live_session.mjs";
import { patience } from "./patience.mjs";

const [, , vs, folder] = process.argv, model = `${folder}/model.vs`, part = `${folder}/part.vs`;
const box = (size) => `(define-parameter size ${size} #:min 1 #:max 9)\n(draw (make-box origin (xyz 1 1 size)))\n`;
// The endless work: in the model's text, in a file that it loads, in a frame, in a shape defined by a function, typed
// at the prompt.
const endless = {
  "a loop": { text: box("2.0") + "(let spin () (spin))\n" },
  "a loaded file": { text: box("2.0") + '(load "part.vs")\n', part: "(let spin () (spin))\n" },
  "a loop that prints": { text: box("2.0") + '(let spin () (display "still here ") (spin))\n' },
  "a loop in a native": { text: box("2.0") + "(let spin () (expt 7 30000) (sort (iota 3000) >) (spin))\n" },
  "solids that take long": { text: box("2.0") + "(let spin ((n 0)) (volume (unite (make-sphere (xyz n 0 0) 1) (make-sphere (xyz (+ n 1) 0 0) 1))) (spin (+ n 1)))\n" },
  "a drawing function": { text: box("2.0") + "(define-primitive endless x)\n(register-drawing-function endless? (lambda (e) (let spin () (spin))))\n(draw (make-endless 1))\n" },
  "a frame": { text: box("2.0") + "(define n 0)\n(every-frame (lambda (dt) (set! n (+ n 1)) (if (> n 3) (let spin () (spin)))))\n" },
  "the prompt": { text: box("2.0"), typed: "(let spin () (spin))" },
};
const PART = '(display "part")\n';
mkdirSync(folder, { recursive: true });
writeFileSync(part, PART);
writeFileSync(model, box("1.0"));
const { url, page, test, after, end } = await session(vs, model);
const address = new URL(url), call = (path, body) => fetch(address.origin + path, { method: "POST", body, headers: { "X-VS-Token": address.hash.slice(1) } });
const state = () => page.evaluate(() => window.live.state);
const pause = (ms) => new Promise((go) => setTimeout(go, ms));
const shown = (wanted, more = null, timeout = 20000) => page.waitForFunction(wanted, more, { timeout });
const busy = () => shown(() => !window.live.stopButton.disabled); // The page says that something runs.
await shown(() => window.live.finished > 0);

// ---- a newer request ends the current run ----

const wishes = {
  "a save": { does: () => writeFileSync(model, box("4.0")), makes: "4.0" },
  "a save of a loaded file": { does: () => writeFileSync(part, '(display "another part")\n'), of: "a loaded file", makes: "2.0" },
  "a slider": { does: () => call("/set?name=size", "5.0"), again: () => call("/try", box("2.0")), makes: "5.0" },
  "a key": { does: () => page.evaluate((text) => { window.live.source.attempt(text); }, box("6.0")), makes: "6.0" }, // As Ctrl and an arrow do.
};
for (const [what, { text, part: loaded, typed }] of Object.entries(endless)) {
  for (const [wish, { does, again, of, makes }] of Object.entries(wishes)) {
    if (of && of !== what) continue;
    await test(`${wish} ends ${what}`, async (want) => {
      writeFileSync(part, loaded || PART);
      writeFileSync(model, text);
      if (typed) {
        await shown(() => window.live.state.parameters[0]?.default === "2.0" && window.live.state.good);
        await call("/prompt", typed);
      }
      await busy();
      await pause(300);
      const from = Date.now();
      await does();
      if (again) { // The value alone leaves a program endless: a key then ends that, too.
        await pause(700);
        await again();
      }
      await shown((value) => window.live.state.good && window.live.state.parameters[0]?.value === value && window.live.stopButton.disabled, makes, patience(8000));
      const took = Date.now() - from;
      want(took < patience(again ? 3500 : 2500), `it took ${took} ms`);
      want(!(await state()).stopped, "the run that was overtaken is told of");
      // Back to the start: the default value, the file's text.
      await call("/set?name=size", "1.0");
      writeFileSync(model, box("1.0"));
      await shown(() => window.live.state.good && window.live.state.parameters[0]?.value === "1.0" && window.live.state.parameters[0].default === "1.0");
      await page.evaluate(() => { const { live } = window; return live.readSource(); });
    });
  }
}

await test("a slider that moves shows pictures on its way", async (want) => {
  // A run takes some 200 ms here, and values arrive faster than runs end.
  await after(() => writeFileSync(model, box("1.0") + "(define until (+ (current-milliseconds) 200))\n(let wait () (if (< (current-milliseconds) until) (wait)))\n"));
  const before = await page.evaluate(() => window.live.finished), from = Date.now();
  for (let i = 0; i < 80; i++) {
    await call("/set?name=size", String(2 + i / 20));
    await pause(25);
  }
  const seconds = (Date.now() - from) / 1000, pictures = (await page.evaluate(() => window.live.finished)) - before;
  want(pictures > 2 * seconds / patience(1), `${pictures} pictures in ${seconds} s`);
  await shown(() => window.live.state.parameters[0]?.value === "5.95");
  await call("/set?name=size", "1.0");
  await after(() => writeFileSync(model, box("1.0")));
});

await test("an output that somebody waits for is not ended", async (want) => {
  await after(() => writeFileSync(model, box("1.0") + `(register-drawing-function 'off (lambda (o) (eq? (object-kind o) 'box))
  (lambda (o) (define until (+ (current-milliseconds) 2500)) (let wait () (if (< (current-milliseconds) until) (wait))) (make-sphere origin 1)))\n`));
  const output = fetch(address.origin + "/export?format=off", { headers: { "X-VS-Token": address.hash.slice(1) } });
  await pause(1200);
  await call("/set?name=size", "2.0");
  const answer = await output;
  want(answer.status === 200 && (await answer.text()).startsWith("OFF"), `it was ended: ${answer.status}`);
  await call("/set?name=size", "1.0");
  await after(() => writeFileSync(model, box("1.0")));
});

await test("a save does not wait for an export", async (want) => {
  // A solid of many rings that meet takes seconds; their picture needs the triangles of one.
  const slow = (size) => box(size) + "(for-each (lambda (i) (for-each (lambda (j) (draw (make-torus (xyz (* 3 i) (* 3 j) 0) 1.6 0.5))) (iota 24))) (iota 24))\n";
  await after(() => writeFileSync(model, slow("1.0")));
  for (const typed of [false, true]) { // The drawing of a text typed at the prompt exists in the session alone.
    if (typed) await after(() => call("/prompt", "(draw (make-sphere (xyz 0 9 0) 1))"));
    let ended = false;
    const output = fetch(address.origin + "/export?format=stl&id=slow", { headers: { "X-VS-Token": address.hash.slice(1) } }).finally(() => { ended = true; });
    await pause(400);
    writeFileSync(model, slow(typed ? "3.0" : "2.0"));
    await shown((value) => window.live.state.parameters[0]?.default === value, typed ? "3.0" : "2.0");
    if (!typed) want(!ended, "the save waited for the export");
    await call("/cancel?id=slow");
    const answer = await output, text = await answer.text();
    want(answer.status === 499 && (typed ? /export again/ : /cancelled/).test(text), `typed ${typed}: ${answer.status} ${text.slice(0, 60)}`);
  }
  const exported = page.evaluate(() => { document.querySelector(".exports select").value = "stl"; return window.live.export(); }), from = Date.now();
  await pause(400);
  await page.getByRole("button", { name: "Stop" }).click();
  await exported;
  want(/cancelled/.test(await page.locator(".top .status").textContent()), `Stop ended the export after ${Date.now() - from} ms: ${await page.locator(".top .status").textContent()}`);
  await after(() => writeFileSync(model, box("1.0")));
});

// ---- Stop ----

await test("Stop where nothing runs ends nothing", async (want) => {
  for (const next of ["a save", "a slider", "a key", "the prompt"]) {
    await pause(200);
    for (let i = 0; i < 3; i++) await call("/stop");
    await after(async () => {
      if (next === "a save") writeFileSync(model, box("3.0"));
      if (next === "a slider") await call("/set?name=size", "4.0");
      if (next === "a key") await call("/try", box("5.0"));
      if (next === "the prompt") await call("/prompt", "(* 6 7)");
    });
    const s = await state();
    want(s.good && !s.stopped && s.messages.length === 0, `${next}: ${JSON.stringify(s.messages)}`);
  }
  want((await state()).values.trim() === "42", "the prompt gave " + (await state()).values);
});

await test("Stop ends what runs, and what waits to be run", async (want) => {
  for (const wait of [0, 2, 20, 400]) {
    const run = (await state()).run;
    await call("/prompt", "(let spin () (spin))");
    await pause(wait);
    await call("/stop");
    await shown((run) => window.live.state.stopped && window.live.state.run > run, run, 5000);
    await after(() => call("/prompt", "'alive"));
    want((await state()).values.trim() === "alive", `after ${wait} ms: ${(await state()).values}`);
  }
});

// ---- messages of a program ----

const points = [0x0, 0x1, 0x7, 0x8, 0x9, 0xb, 0xc, 0xd, 0x1b, 0x7f, 0x80, 0x85, 0xa0, 0xad, 0x300, 0x61c, 0x200b, 0x200e, 0x2028, 0x2029, 0x202e, 0x2066, 0xfeff, 0xfdd0, 0xfffd, 0xfffe, 0xffff, 0x1f600, 0x1fffe, 0xe0001, 0x10ffff];
await test("any character in what is said leaves the window alive", async (want) => {
  const all = points.map((c) => `\\x${c.toString(16)};`).join("z"), text = String.fromCodePoint(...points.flatMap((c) => [c, 0x7a]).slice(0, -1));
  const some = all.replace("\\x0;z", ""), label = text.slice(2); // A label ends where a C text does.
  const rows = {
    printed: `(display "${all}")`, label: `(define-parameter n 1 #:label "${some}" #:group "${some}" #:unit "${some}")`, text: `(define-parameter word "${all}")`, choice: `(define-parameter word "b" #:choices '("b" "${all}"))`,
    layer: `(draw (layer "${all}" (make-sphere origin 2)))`, material: `(draw (with-material (make-material #:name "${all}" #:color "red") (make-sphere origin 2)))`,
    error: `(error "${all}" "${all}")`, raised: `(raise "${all}")`, name: `(no-such-\u2028name\u2029)`.replace(/[\u2028\u2029]/g, (c) => `\\x${c.codePointAt(0).toString(16)};`).replace(/\((.*)\)/, "(|$1|)"), source: `(car "${"\u2028 \u2029"}")`,
    comment: `; \u2028 and \u2029\n(car 'x)`, defined: `(define |f${all}| (lambda (x) (car x)))\n(|f${all}| 5)`,
  };
  for (const [what, row] of Object.entries(rows)) {
    await after(() => writeFileSync(model, box("1.0") + row + "\n"));
    const s = await state();
    want(s.parameters.length > 0, `${what}: ${JSON.stringify(s).slice(0, 200)}`);
    if (what === "printed") want(s.printed === text, `printed: ${JSON.stringify(s.printed)}`);
    if (what === "label") want(s.parameters[1].label === label, `label: ${JSON.stringify(s.parameters[1].label)}`);
    if (["error", "raised", "name", "source", "comment", "defined"].includes(what)) want(!s.good && s.messages.length > 0, what + " is no error");
  }
  await after(() => call("/prompt", `(begin (display "${all}") "${all}")`));
  want((await state()).printed === text, "typed: " + JSON.stringify((await state()).printed));
  await after(() => writeFileSync(model, box("1.0")));
  want((await state()).good, "no life after it");
});

await test("a program that prints much: its end is shown, and how much is missing", async (want) => {
  for (const [letter, count] of [["x", 100], ["x", 30000], ["\u00e9", 1500000], ["\u{1f600}", 700000], ["x", 5000000]]) {
    await after(() => writeFileSync(model, box("1.0") + `(display (make-string ${count} #\\${letter}))\n(display "the end")\n`));
    const s = await state(), text = await page.locator(".console pre").textContent(), told = /^\(([\d,]+) characters before these are not shown\)\n/.exec(text);
    want(s.printed.endsWith("the end") && [...s.printed].length + s.missing === count + 7, `${count} of ${letter}: ${[...s.printed].length} and ${s.missing}`);
    want(Buffer.byteLength(s.printed) <= (2 << 20) && (s.missing === 0 || Buffer.byteLength(s.printed) >= 1 << 20), `${Buffer.byteLength(s.printed)} bytes are kept`);
    want(text.endsWith("the end"), "the page: " + text.slice(-30));
    want((told ? Number(told[1].replaceAll(",", "")) : 0) + [...text.slice(told ? told[0].length : 0)].length === count + 7, `${count} of ${letter}: the page says "${text.slice(0, 70)}"`);
  }
});

await test("an error after many warnings is shown", async (want) => {
  await after(() => writeFileSync(model, box("1.0") + Array.from({ length: 260 }, (_, i) => `(make-cylinder (xyz 0 0 ${i}) (xyz 0 0 ${i}) 1)`).join("\n") + "\n(car 'late)\n"));
  const s = await state();
  want(s.messages.length >= 200 && s.messages.at(-1).severity === "error" && s.more > 0, `${s.messages.length} messages, ${s.more} more, the last: ${JSON.stringify(s.messages.at(-1))}`);
  want(/and \d+ more$/.test(await page.locator(".messages").textContent()), "the page does not say that there are more");
});

await test("a file that loads itself is told of at once", async (want) => {
  const from = Date.now();
  await after(() => writeFileSync(model, box("1.0") + '(load "model.vs")\n'));
  const s = await state();
  want(!s.good && /loads itself/.test(s.messages[0]?.message), JSON.stringify(s.messages));
  want(Date.now() - from < patience(3000), `it took ${Date.now() - from} ms`);
  await after(() => writeFileSync(model, box("1.0")));
});

await test("no script of the page has failed in these runs", async (want) => {
  const troubles = page.troubles.filter((t) => !/status of 499/.test(t)); // The browser reports the cancelled export.
  want(troubles.length === 0, troubles.join("; "));
});

await end();
