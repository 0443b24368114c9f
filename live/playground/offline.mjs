// Prints the script with all files of the playground, for a page that is opened from a file: `offline.mjs FOLDER`.
import { readFileSync } from "node:fs";

const [, , folder] = process.argv, base64 = (name) => JSON.stringify(readFileSync(`${folder}/${name}`).toString("base64"));
console.log(`window.visualschemeEngine = ${JSON.stringify(readFileSync(`${folder}/engine.js`, "utf8"))};`);
console.log(`window.visualschemeWorker = ${JSON.stringify(readFileSync(`${folder}/worker.js`, "utf8"))};`);
console.log(`window.visualschemeProgram = ${base64("engine.wasm")};`);
console.log("window.visualschemeFiles = {");
for (const name of JSON.parse(readFileSync(`${folder}/files.json`, "utf8"))) console.log(`${JSON.stringify(name)}: ${base64("files/" + name)},`);
console.log("};");
