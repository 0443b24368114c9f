// Runs an example in the live view of the native program on one thread, as the playground does: `native.mjs VS MODEL
// FOLDER`. Prints { seconds }, the time of the run that the view states, and writes FOLDER/native.stl, .glb and .pov.
import { spawn } from "node:child_process";
import { writeFileSync } from "node:fs";

const [, , vs, model, folder] = process.argv;
const view = spawn("taskset", ["-c", "0", vs, "view", "-q", model], { stdio: ["ignore", "pipe", "inherit"] });
const address = await new Promise((go) => view.stdout.once("data", (text) => go(String(text).trim())));
const [base, token] = address.split("#");
const ask = (path) => fetch(base + path, { headers: { "X-VS-Token": token } });
const reader = (await ask("events")).body.pipeThrough(new TextDecoderStream()).getReader();
let text = "", data;
while (!data) {
  text += (await reader.read()).value;
  const block = text.split("\n\n").find((one) => one.includes("event: state\n") && one.includes("data: "));
  if (block && text.includes(block + "\n\n")) data = block.split("\n").find((line) => line.startsWith("data: ")).slice(6);
}
for (const format of ["stl", "glb", "pov"]) {
  const answer = await ask("export?format=" + format);
  writeFileSync(`${folder}/native.${format}`, answer.ok ? Buffer.from(await answer.arrayBuffer()) : "");
}
console.log(JSON.stringify({ seconds: JSON.parse(data).seconds }));
view.kill("SIGINT");
process.exit(0);
