// Owns the test of the program in WebAssembly: `node.mjs VS FOLDER WORK [ALL]`. Each example runs in node, and its
// files are compared with those that VS writes. ALL: every example; else a sample. FOLDER: what make playground made.
// Prints lines in the form that tests/run.sh reads, and then a table of times and of files with the same bytes.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { Program, filesBelow } from "./engine.mjs";
import { LACKS, OTHER_TRIANGLES, TOO_LARGE } from "./lacks.mjs";
import { compare } from "./same_files.mjs";

const [, , vs, folder, work, all] = process.argv, only = (process.env.ONLY || "").replace(/^playground(\/node:?)?/, "");
mkdirSync(work, { recursive: true });
const FORMATS = ["stl", "glb", "pov"], SAMPLE = ["arcade.vs", "doric-column.vs", "vase.vs"], MOST = 2.5;
const examples = readdirSync("examples").filter((name) => name.endsWith(".vs") && (all || SAMPLE.includes(name)) && only.split(",").some((part) => name.includes(part)));
const tree = [...filesBelow(folder + "/files")].map((name) => ["/" + name, readFileSync(folder + "/files/" + name)]);
const ratios = [], notes = [], table = [], same = Object.fromEntries(FORMATS.map((format) => [format, 0]));

for (const name of examples) {
  const wrong = [];
  try {
    const p = await Program.open(folder, "examples/" + name, tree);
    p.run();
    const state = p.state();
    const messages = state.messages.filter((m) => m.severity === "error").map((m) => m.message);
    if (LACKS[name] ? !messages.some((m) => m.includes(LACKS[name])) : !state.good) wrong.push(...messages);
    if (LACKS[name]) {
      console.log(`${wrong.length ? "not ok" : "ok"} playground/node:${name} (it needs ${LACKS[name]})`);
      continue;
    }
    const native = JSON.parse(execFileSync("node", ["tests/playground/native.mjs", vs, "examples/" + name, work], { encoding: "utf8", maxBuffer: 1 << 28 }));
    const ratio = state.seconds / native.seconds, differing = [];
    ratios.push(ratio);
    for (const format of state.good ? FORMATS.filter((f) => !TOO_LARGE[name]?.[f]) : []) {
      const here = p.ask("/export?format=" + format), there = readFileSync(`${work}/native.${format}`);
      if (here.status !== 200) {
        wrong.push(`.${format}: ${here.bytes.toString().trim()}`);
        continue;
      }
      const { bytes, why } = compare(format, here.bytes, there);
      same[format] += bytes;
      if (!bytes) differing.push("." + format);
      const known = OTHER_TRIANGLES[name]?.[format];
      // Not an excuse for anything: a thousandth of the file may differ in length.
      if (why && known && Math.abs(here.bytes.length - there.length) <= there.length / 1000) notes.push(`    ${name} .${format} has other triangles: ${known}`);
      else if (why) writeFileSync(`${work}/${name}.${format}`, here.bytes), wrong.push(`.${format}: ${why}`);
    }
    table.push(`    ${name.padEnd(26)} ${state.seconds.toFixed(3)} s, native ${native.seconds.toFixed(3)} s: ${ratio.toFixed(2)} times${differing.length ? "; last bits differ in " + differing.join(" ") : ""}`);
  } catch (error) {
    wrong.push(String(error.message || error).split("\n")[0]);
  }
  console.log(wrong.length === 0 ? `ok playground/node:${name}` : `not ok playground/node:${name}`);
  for (const reason of wrong) console.log("    " + reason);
}
const mean = Math.exp(ratios.reduce((sum, x) => sum + Math.log(x), 0) / Math.max(1, ratios.length));
console.log([...table, ...notes].join("\n"));
console.log(`    the same bytes: ${FORMATS.map((format) => `.${format} ${same[format]} of ${examples.length}`).join(", ")}`);
console.log(mean <= MOST ? `ok playground/node: times (${mean.toFixed(2)} times the native time, geometric mean)` : `not ok playground/node: times\n    ${mean.toFixed(2)} times the native time, more than ${MOST}`);
