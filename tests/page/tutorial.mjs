// Owns the tests of the tutorial in the window, and its pictures: `tutorial.mjs VS FOLDER`. The programs are those of
// manual/tutorial.md. The script makes each picture of the tutorial into FOLDER; with TUTORIAL=manual into the manual,
// for checking by eye. Prints lines in the form that tests/run.sh reads.
import { existsSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { settled } from "./browser.mjs";
import { session } from "./live_session.mjs";

const [, , vs, folder] = process.argv, pages = resolve("manual"), manual = readFileSync(`${pages}/tutorial.md`, "utf8"), to = resolve(process.env.TUTORIAL || folder), model = "first.vs";
const command = resolve(vs);
process.chdir(folder); // As a student does it: the file has no folder before its name.
const programs = new Map(manual.split(/^## /m).slice(1).map((step) => [parseInt(step, 10), [...step.matchAll(/^```scheme\n([\s\S]*?)^```$/gm)].map((m) => m[1])]));
const told = new Set([...manual.matchAll(/\]\((tutorial-window-\d+\.jpg)\)/g)].map((m) => m[1])), made = new Set();

writeFileSync(model, programs.get(2)[0]);
const { page, test, after, onScreen, cursor, end } = await session(command, model);
await page.setViewportSize({ width: 1000, height: 560 });
const parts = () => page.evaluate(() => window.visualscheme.model.count), height = () => page.evaluate(() => window.visualscheme.model.size[2]);
const text = () => page.evaluate(() => window.live.source.text);

// Types a program over the whole text, as a student does, and saves.
async function write(program) {
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+a");
  await page.keyboard.insertText(program);
  await after(() => page.keyboard.press("Control+s"));
}
async function picture(want, step) {
  const name = `tutorial-window-${step}.jpg`;
  if (process.env.TUTORIAL) await settled(page); // Soft shadows take seconds each.
  await page.screenshot({ path: `${to}/${name}`, type: "jpeg", quality: 82, timeout: 120000 });
  made.add(name);
  want(statSync(`${to}/${name}`).size > 15000, `${name} shows hardly anything`);
}

await test("tutorial: 2, a solid in the window", async (want) => {
  await page.waitForFunction(() => window.live.finished > 0);
  want(await parts() === 1 && Math.abs(await height() - 2) < 0.01, `${await parts()} parts, ${await height()} high`);
  await picture(want, 2);
  await write(programs.get(2)[0].replace(/1\)\s*$/, "2)\n"));
  want(Math.abs(await height() - 4) < 0.01, `with the radius 2 it is ${await height()} high`);
  want(/2\)\s*$/.test(readFileSync(model, "utf8")), "Ctrl-S has not saved");
});
await test("tutorial: 3, a click marks the line", async (want) => {
  await write(programs.get(3)[0]);
  want(await parts() === 2, `${await parts()} parts`);
  await page.evaluate(() => window.visualscheme.view("start"));
  const spot = await onScreen([2, 2, 3]);
  await page.mouse.click(spot.x, spot.y);
  want(/first\.vs:2/.test(await page.locator(".card").textContent()), `the card says ${await page.locator(".card").textContent()}`);
  want(await page.locator(".cm-line.made, .made").count() > 0, "no line is marked");
  await picture(want, 3);
  await page.evaluate(() => window.visualscheme.select([]));
  await cursor("(make-box");
  await page.waitForFunction(() => window.visualscheme.chosen.length === 1);
});
await test("tutorial: 4, a number turns like a knob", async (want) => {
  await write(programs.get(4)[0]);
  await page.evaluate(() => {
    const { view } = window.live.source, at = view.state.doc.toString().indexOf("side 4") + 5;
    view.dispatch({ selection: { anchor: at }, userEvent: "select" });
    view.focus();
  });
  for (let i = 0; i < 4; i++) await page.keyboard.press("Control+ArrowUp");
  await page.waitForFunction(() => Math.abs(window.visualscheme.model.size[0] - 8) < 0.01, null, { timeout: 30000 });
  want(/side 8\)/.test(await text()) && /side 4\)/.test(readFileSync(model, "utf8")), "the text is not ahead of the file");
  await page.evaluate(() => window.visualscheme.view("start"));
  await picture(want, 4);
});
await test("tutorial: 5, a mistake and its mending", async (want) => {
  const program = programs.get(5)[0], wrong = program.split("\n").map((line, i) => i === 2 ? line.replace("radius", "raduis") : line).join("\n");
  want(wrong !== program, "the third line has no radius any more");
  await write(program);
  const whole = await parts();
  await page.evaluate(() => window.visualscheme.view("start"));
  await write(wrong);
  const message = await page.locator(".message").first().textContent();
  want(/first\.vs:3:/.test(message) && /raduis/.test(message), `the message is ${message}`);
  want(await page.locator(".view.stale").count() === 1 && await parts() === whole, "the last model does not stay, dimmed");
  await picture(want, 5);
  await write(program);
  want(await page.locator(".view.stale").count() === 0, "it does not heal");
});
await test("tutorial: 12, parameters are sliders", async (want) => {
  await write(programs.get(12)[0]);
  await after(() => page.locator("input[type=range][data-parameter=height]").fill("30"));
  await page.waitForFunction(() => Math.abs(window.visualscheme.model.size[2] - 30) < 0.01, null, { timeout: 30000 });
  await page.locator("input[type=range][data-parameter=turn]").fill("200");
  await page.waitForFunction(() => window.live.state.parameters.find((p) => p.name === "turn")?.value.startsWith("200"), null, { timeout: 30000 });
  await page.evaluate(() => window.visualscheme.view("start"));
  await picture(want, 12);
  await page.getByRole("button", { name: "Write to source" }).click();
  await page.waitForFunction(() => !window.live.source.dirty);
  want(/height 30 /.test(readFileSync(model, "utf8")) && /turn 200\.0 /.test(readFileSync(model, "utf8")), readFileSync(model, "utf8").split("\n").slice(0, 2).join(" "));
});
await test("tutorial: its pictures are those made here", async (want) => {
  if (made.size > 0) want([...told].sort().join() === [...made].sort().join(), `the tutorial shows ${[...told]}, made are ${[...made]}`);
  for (const name of told) want(existsSync(`${pages}/${name}`), `manual/${name} is missing`);
});
await end();
