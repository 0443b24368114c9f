// Owns the tests of a sweep's page: its parallel coordinates and its scatter. `parallel.mjs INDEX.HTML ROUNDED.HTML`, the pages of
// a sweep of n=1..4, style=flat,steep with the number "area", and of one with "same", which is 1000 but for rounding, and "long". Prints lines in the form that tests/run.sh reads.
import { pathToFileURL } from "node:url";
import { browser } from "./browser.mjs";

const faults = [], check = (ok, words) => { if (!ok) faults.push(words); };
const chromium = await browser(), page = await chromium.newPage({ viewport: { width: 900, height: 900 } });
const troubles = [];
page.on("pageerror", (error) => troubles.push(String(error)));
page.on("request", (request) => { if (!request.url().startsWith("file:")) troubles.push("it requests " + request.url()); });
await page.goto(pathToFileURL(process.argv[2]).href);
const shown = () => page.$$eval("figure", (all) => all.filter((f) => f.style.display !== "none").map((f) => JSON.parse(f.dataset.values)));
const status = () => page.textContent("[role=status]");
check((await status()) === "8 of 8 sets", "the count begins with " + (await status()));
const inked = await page.$eval("canvas", (c) => c.getContext("2d").getImageData(0, 0, c.width, c.height).data.filter((v, i) => i % 4 === 3 && v > 0).length);
check(inked > 2000, `only ${inked} pixels are drawn`);
const box = await (await page.$("canvas")).boundingBox(), x = (k) => box.x + 60 + (k * (box.width - 120)) / 2;
async function drag(k, from, to) {
  await page.mouse.move(x(k), box.y + from);
  await page.mouse.down();
  await page.mouse.move(x(k), box.y + (from + to) / 2);
  await page.mouse.move(x(k), box.y + to);
  await page.mouse.up();
}
await drag(0, 30, 120); // the upper half of n: 3 and 4
let rows = await shown();
check(rows.length === 4 && rows.every((r) => r[0] >= 3), "the upper half of n keeps " + JSON.stringify(rows));
await drag(1, 30, 60); // the upper end of style: the text that comes last
rows = await shown();
check(rows.length === 2 && rows.every((r) => r[1] === "steep"), "and of style " + JSON.stringify(rows));
check((await status()) === "2 of 8 sets", "the count is " + (await status()));
await page.click("button");
check((await shown()).length === 8, "the button does not show all");
const before = await page.$eval("canvas", (c) => c.toDataURL());
await page.mouse.click(x(0), box.y + 8);
check((await page.$eval("canvas", (c) => c.toDataURL())) !== before, "a click on a name does not change the colours");
// the scatter: n across and area = n * n up, with frames inset by 3 %; the point under the pointer shows its set
const plot = await (await page.$("#scatter canvas")).boundingBox();
const on_axis = (value, least, most) => 0.03 + (0.94 * (value - least)) / (most - least);
const at = (n, area) => [plot.x + 56 + on_axis(n, 1, 4) * (plot.width - 72), plot.y + 12 + (1 - on_axis(area, 1, 16)) * (plot.height - 40)];
const card = () => page.$eval("#scatter div", (d) => (d.style.display === "none" ? null : { words: d.textContent, pictures: [...d.querySelectorAll("img")].map((i) => i.src) }));
for (const n of [1, 3, 4]) {
  await page.mouse.move(...at(n, n * n));
  const seen = await card();
  check(seen && new RegExp(`^n=${n}, style=(flat|steep)area ${n * n}$`).test(seen.words), `at n=${n} the card says ${seen && seen.words}`);
  check(seen && seen.pictures.length === 1 && decodeURIComponent(seen.pictures[0]).includes(`swept-n=${n},style=`), `at n=${n} the card shows ${seen && seen.pictures}`);
}
await page.mouse.move(...at(1, 16));
check((await card()) === null, "a card where there is no point");
await page.selectOption("#scatter select >> nth=0", { label: "style" });
await page.mouse.move(plot.x + 56 + 0.97 * (plot.width - 72), at(1, 4)[1]);
check((await card())?.words.startsWith("n=2, style=steep"), "with style across the card says " + (await card())?.words);
await drag(0, 30, 120); // n: 3 and 4; points that are not kept show nothing
await page.mouse.move(plot.x + 56 + 0.97 * (plot.width - 72), at(1, 4)[1]);
check((await card()) === null, "a set that is not kept has a card");
await page.click("button");
await page.hover("figure:nth-of-type(3)");
await page.setViewportSize({ width: 360, height: 700 });
check(await page.evaluate(() => document.documentElement.scrollWidth <= 360), "a phone's width does not hold it");
// Numbers on the scatter's axes: those of a value that differs by rounding alone, and of five digits.
await page.addInitScript(() => {
  window.written = [];
  const { fillText } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.fillText = function (text, ...at) { if (this.canvas.getAttribute("aria-label")?.startsWith("Sets by")) window.written.push(text); return fillText.call(this, text, ...at); };
});
await page.goto(pathToFileURL(process.argv[3]).href, { timeout: 20000 });
for (const [name, wanted] of [["same", /^1000$/], ["long", /^102[3-6]\d(\.5)?$/]]) {
  await page.selectOption("#scatter select >> nth=1", { label: "n" });
  await page.evaluate(() => { window.written = []; });
  await page.selectOption("#scatter select >> nth=0", { label: name });
  const words = await page.evaluate(() => window.written);
  check(words.some((w) => wanted.test(w)) && new Set(words).size === words.length, `the axis of ${name} says ${words}`);
}
check(troubles.length === 0, troubles.join("; "));
await chromium.close();
console.log((faults.length ? "not ok" : "ok") + " page/parallel coordinates");
for (const fault of faults) console.log("    " + fault);
