// Owns the tests of the live view's text in a browser: the source pane as an editor, the text for screen readers, the
// user's words that look like HTML, and that saves and reloads leave nothing behind. `live_words.mjs VS FOLDER`.
import { mkdirSync, writeFileSync } from "node:fs";
import { open } from "./browser.mjs";
import { session } from "./live_session.mjs";

const [, , vs, folder] = process.argv, evil = "<img src=x onerror=window.owned=1>", LONG = Boolean(process.env.LONG);
const model = `${folder}/<b onclick=owned=1>house&amp;.vs`;
const source = `; a house
(define-parameter height 3.0 #:min 1 #:max 9 #:label "${evil}" #:unit "<i>m</i>" #:group "<script>owned=1</script>")
(define-parameter word "${evil}")
(define (wall from to) ; two corners
  (make-box from (+xyz to 0 0 height)))
(display "${evil}<script>owned=1</script>")
(draw (layer "${evil}" (with-material (make-material #:name "<b>brick</b>" #:color "red") (wall (xyz 0 0 0) (xyz 8 0.3 0)))))
(draw (make-sphere (xyz 4 4 1) 1))
`;
mkdirSync(folder, { recursive: true });
writeFileSync(model, source);
const { url, server, page, test, after, end } = await session(vs, model);
await page.waitForFunction(() => window.live.finished > 0);
const system = await page.context().newCDPSession(page);
const write = (text) => after(() => writeFileSync(model, text));

await test("the source has colours, and brackets that of their depth", async (want) => {
  const found = await page.evaluate(() => {
    const colour = (text) => { const span = [...document.querySelectorAll(".cm-line span")].find((s) => s.children.length === 0 && s.textContent === text); return span && getComputedStyle(span).color; };
    return { kinds: ["; a house", "define-parameter", "3.0", "#:min", '"<b>brick</b>"', "draw"].map(colour), depths: [0, 1, 2, 3].map((d) => { const b = document.querySelector(".depth-" + d); return b && getComputedStyle(b).color; }) };
  });
  want(new Set(found.kinds).size === 6 && !found.kinds.includes(undefined), "words: " + found.kinds.join(" "));
  want(new Set(found.depths).size === 4 && !found.depths.includes(null), "brackets: " + found.depths.join(" "));
});

await test("a new line is indented as its list is", async (want) => {
  const typed = (before, keys) => page.evaluate(([before]) => {
    const { view } = window.live.source, at = view.state.doc.toString().indexOf(before) + before.length;
    view.focus();
    view.dispatch({ selection: { anchor: at } });
  }, [before]).then(async () => {
    await page.keyboard.press("Enter");
    await page.keyboard.type(keys);
    const line = await page.evaluate(() => { const { state } = window.live.source.view; return state.doc.lineAt(state.selection.main.head).text; });
    for (let i = 0; i < 5 && await page.evaluate(() => window.live.source.text !== window.live.source.base); i++) await page.keyboard.press("Control+z");
    return line;
  });
  for (const [before, columns] of [["(define (wall from to)", 2], ["  (make-box from", 12], ["(+xyz to 0", 23], ["(draw (make-sphere (xyz 4 4 1) 1))", 0]]) {
    const line = await typed(before, "x");
    want(line.search(/x/) === columns, `after ${before} a line begins in column ${line.search(/x/)}, not ${columns}`);
  }
  want(await page.evaluate(() => window.live.source.text === window.live.source.base), "it is not undone");
});

await test("long lines go on below, further in than they begin", async (want) => {
  const seen = await page.evaluate(() => {
    const { view } = window.live.source, scroller = view.scrollDOM, at = view.state.doc.toString().indexOf("(draw (layer"), line = view.state.doc.lineAt(at);
    const [first, last] = [view.coordsAtPos(line.from), view.coordsAtPos(line.to)], second = view.posAtCoords({ x: scroller.getBoundingClientRect().left, y: first.bottom + 5 });
    return { wide: scroller.scrollWidth - scroller.clientWidth, lines: (last.top - first.top) / (first.bottom - first.top), begins: view.coordsAtPos(second, 1).left - first.left };
  });
  want(seen.wide <= 1 && seen.lines > 0.9 && seen.begins > 8, JSON.stringify(seen));
});

await test("on a phone nothing lies on anything else", async (want) => {
  const phone = await page.context().browser().newContext({ viewport: { width: 390, height: 800 }, hasTouch: true, isMobile: true, reducedMotion: "reduce" }), other = await open(phone, url);
  const bad = await other.evaluate(() => {
    const seen = [...document.querySelectorAll(".bar, .exports, .parameters, .title h1, .console, .top")].filter((e) => e.offsetParent).map((e) => [e.className || e.tagName, e.getBoundingClientRect()]), found = [];
    for (let i = 0; i < seen.length; i++) for (let k = i + 1; k < seen.length; k++) {
      const [a, p] = seen[i], [b, q] = seen[k];
      if (p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 1 && q.top < p.bottom - 1) found.push(`${a} / ${b}`);
    }
    return matchMedia("(pointer: coarse)").matches ? found : [...found, "no fingers"];
  });
  want(bad.length === 0, "these overlap: " + bad.join(", "));
  await phone.close();
});

await test("the source is searched", async (want) => {
  await page.evaluate(() => { const { view } = window.live.source; view.focus(); view.dispatch({ selection: { anchor: 0 } }); });
  await page.keyboard.press("Control+f");
  await page.locator(".cm-search input[name=search]").pressSequentially("make-sphere");
  await page.keyboard.press("Enter");
  const found = await page.evaluate(() => { const { state } = window.live.source.view, { from, to } = state.selection.main; return [state.sliceDoc(from, to), state.doc.lineAt(from).number]; });
  want(found.join() === "make-sphere,8", "it finds " + found);
  await page.keyboard.press("Escape");
  want(await page.locator(".cm-search").count() === 0, "Escape does not close it");
});

await test("words of the user stay words", async (want) => {
  await page.evaluate(() => { const v = window.visualscheme; if (v.panel.root.hidden) v.togglePanel(); });
  for (const tab of ["layers", "materials", "parts"]) await page.locator(`[data-tab="${tab}"]`).click();
  await page.locator('[data-tab="layers"]').click();
  const said = await page.evaluate(() => document.body.innerText);
  for (const [what, text] of [["a parameter's label", evil], ["its unit", "<i>m</i>"], ["what is printed", evil + "<script>owned=1</script>"]]) want(said.includes(text), `${what} is not shown as it is`);
  want((await page.locator(".list").innerText()).includes(evil), "a layer's name is not shown as it is");
  want((await page.locator(".top b").innerText()).startsWith("<b onclick"), "the file's name is not shown as it is");
  await page.evaluate(() => { const v = window.visualscheme; v.select([0]); });
  want((await page.locator(".card").innerText()).includes("<b>brick</b>"), "a material's name is not shown as it is");
  await write(source + `(error "${evil}" '<script>)\n`);
  want((await page.locator(".messages").innerText()).includes(evil), "an error's words are not shown as they are");
  await write(source);
  await after(async () => { await page.locator("#parameter-word").fill(evil + "<b>"); await page.keyboard.press("Enter"); });
  want(!(await page.evaluate(() => window.owned)), "something of it ran");
  want(await page.evaluate(() => document.querySelectorAll("img, .vs script, #live script, #live i, .messages b").length) === 0, "something of it became elements");
  await page.evaluate(() => { const v = window.visualscheme; v.select([]); v.togglePanel(); });
});

await test("all that can be worked has a name for screen readers", async (want) => {
  await page.evaluate(() => { const v = window.visualscheme; v.togglePanel(); v.setSection({ axis: "y", at: 0.5, flip: false }); v.buttons.display.click(); });
  const { nodes } = await system.send("Accessibility.getFullAXTree"), works = ["button", "checkbox", "slider", "spinbutton", "textbox", "combobox", "menuitem", "menuitemcheckbox", "tab", "link", "searchbox", "switch"];
  const asked = nodes.filter((n) => !n.ignored && works.includes(n.role?.value)), nameless = asked.filter((n) => !n.name?.value?.trim());
  want(asked.length > 30, `only ${asked.length} things are found`);
  const told = [];
  for (const n of nameless) told.push(`${n.role.value} ${(await system.send("DOM.describeNode", { backendNodeId: n.backendDOMNodeId, depth: 0 })).node.attributes?.join(" ")}`);
  want(nameless.length === 0, told.join("; "));
  const picture = nodes.find((n) => /image|img/.test(n.role?.value) && /model/i.test(n.name?.value || ""));
  want(picture, "the picture has no name");
  await page.evaluate(() => { const v = window.visualscheme; v.buttons.display.click(); v.setSection(null); v.togglePanel(); });
  // Screen readers announce a choice and an error.
  await page.evaluate(() => window.visualscheme.view("iso"));
  const at = await page.evaluate(() => { const { stage, model } = window.visualscheme, q = stage.camera.position.clone().set(...[4, 4, 2].map((x, k) => x - model.middle[k])).project(stage.camera), r = stage.canvas.getBoundingClientRect(); return [r.left + (q.x + 1) / 2 * r.width, r.top + (1 - q.y) / 2 * r.height]; });
  await page.mouse.click(at[0], at[1] + 4);
  const live = await page.evaluate(() => document.querySelector(".vs [aria-live]").textContent);
  want(/^sphere at .*, line 8$/.test(live), "a click says: " + live);
  await page.keyboard.press("Escape");
});

await test("many saves in a row cost one evaluation", async (want) => {
  await page.waitForTimeout(300);
  const runs = () => page.evaluate(() => window.live.state.run), before = await runs();
  const { writeSync, openSync, closeSync } = await import("node:fs");
  let pauses = 0, last = Date.now(); // Where this process was held up, what was written till then may be evaluated by itself.
  for (let i = 1; i <= 40; i++) { // Faster than files are looked at.
    if (Date.now() - last > 8) pauses++;
    last = Date.now();
    writeFileSync(model, source.replace("height 3.0", `height ${(3 + i / 40).toFixed(3)}`));
    const file = openSync(model, "a");
    writeSync(file, "\n");
    closeSync(file);
  }
  await page.waitForFunction(() => window.live.state.parameters[0]?.default === "4.0", null, { timeout: 20000 });
  await page.waitForTimeout(500);
  const cost = await runs() - before;
  want(cost >= 1 && cost <= 2 + pauses && pauses < 20, `40 saves with ${pauses} pauses cost ${cost} evaluations`);
  await write(source);
});

// The memory of the graphics card and of the scripts after a tenth of the saves, and after all.
await test("saves leave nothing behind", async (want) => {
  const rounds = LONG ? 300 : 60, held = async () => {
    await system.send("HeapProfiler.collectGarbage");
    return page.evaluate(() => {
      const { stage } = window.visualscheme, { memory, programs } = stage.renderer.info;
      stage.shadowsDirty = true; // A picture of each kind is drawn first: which were depends on how quick the machine is.
      stage.draw(true);
      stage.draw();
      stage.paint(2);
      return { geometries: memory.geometries, textures: memory.textures, programs: programs.length, heap: Math.round(performance.memory.usedJSHeapSize / 1e5) / 10, elements: document.querySelectorAll("*").length };
    });
  };
  let first;
  for (let i = 1; i <= rounds; i++) {
    await write(source.replace("height 3.0", `height ${(3 + (i % 50) / 100).toFixed(2)}`));
    if (i === Math.floor(rounds / 5)) first = await held();
  }
  await write(source);
  const last = await held();
  for (const key of ["geometries", "textures", "programs"]) want(last[key] <= first[key], `${key}: ${first[key]} became ${last[key]}`);
  want(last.elements <= first.elements + 20, `elements: ${first.elements} became ${last.elements}`);
  want(last.heap < first.heap + 4, `heap: ${first.heap} MB became ${last.heap} MB`);
});

await test("a page that is loaded again and again leaves the server as it was", async (want) => {
  const { readFileSync, readdirSync } = await import("node:fs"), { pid } = server;
  const held = () => ({ kilobytes: Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))[1]), threads: readdirSync(`/proc/${pid}/task`).length, files: readdirSync(`/proc/${pid}/fd`).length });
  let first;
  const rounds = LONG ? 60 : 12;
  for (let i = 1; i <= rounds; i++) {
    await page.goto("about:blank");
    await page.goto(url);
    if (i % 2) await page.waitForFunction(() => window.live?.finished > 0, null, { timeout: 20000 }); // Every second one vanishes while it loads.
    if (i === Math.floor(rounds / 3)) first = held();
  }
  await page.waitForFunction(() => window.live?.finished > 0, null, { timeout: 20000 });
  const last = held();
  want(last.kilobytes < first.kilobytes + 6000 && last.threads <= first.threads + 6 && last.files <= first.files + 6, `${JSON.stringify(first)} became ${JSON.stringify(last)}`);
});

await test("no script of the words' page has failed", async (want) => { want(page.troubles.length === 0, page.troubles.join("; ")); });
await end();
