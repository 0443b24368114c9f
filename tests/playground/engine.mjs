// Opens the program that `make playground` compiled to WebAssembly in node, as the page's worker does in a browser: a
// folder of files, and requests as to the live view's server.
import { createRequire } from "node:module";
import { readFileSync, readdirSync, statSync } from "node:fs";

// The files below a folder, by their paths from it.
export function* filesBelow(folder, under = "") {
  for (const name of readdirSync(folder + "/" + under)) {
    const at = under + name;
    if (statSync(folder + "/" + at).isDirectory()) yield* filesBelow(folder, at + "/");
    else yield at;
  }
}

export class Program {
  static async open(folder, model, files) {
    const p = new Program();
    const make = createRequire(import.meta.url)(folder + "/engine.js");
    p.answers = new Map();
    p.number = 0;
    p.events = "";
    p.said = [];
    p.module = await make({
      wasmBinary: readFileSync(folder + "/engine.wasm"),
      answer: (id, status, type, bytes) => p.answers.set(id, { status, type, bytes: Buffer.from(bytes) }),
      part: (id, bytes) => { p.events += Buffer.from(bytes).toString(); },
      print: () => {}, printErr: (text) => p.said.push(text),
    });
    for (const [path, content] of files) p.put(path, content);
    p.module.FS.chdir("/model"); // A path from there is the path that the native program gets: some files contain it.
    p.begin(model);
    return p;
  }

  put(path, content) {
    this.module.FS.mkdirTree(path.slice(0, path.lastIndexOf("/")));
    this.module.FS.writeFile(path, content);
  }
  begin(model) {
    if (!this.#text(model, (at) => this.module._playground_open(at))) throw new Error(`${model}: ${this.said.join("; ")}`);
    this.ask("/events");
  }
  run() { this.module._playground_run(); }
  turn() { return this.module._playground_turn(); }

  #text(value, use) {
    const bytes = Buffer.from(value), at = this.module._malloc(bytes.length + 1);
    this.module.HEAPU8.set(bytes, at);
    this.module.HEAPU8[at + bytes.length] = 0;
    const result = use(at, bytes.length);
    this.module._free(at);
    return result;
  }
  ask(path, { method = "GET", body = "" } = {}) {
    const id = ++this.number, [address, query = ""] = path.split("?");
    const pairs = [...new URLSearchParams(query)].map(([name, value]) => `${name}\0${value}\0`).join("");
    this.#text(method, (m) => this.#text(address, (a) => this.#text(pairs, (q) => this.#text(body, (b, size) => this.module._playground_request(id, m, a, q, b, size)))));
    return this.answers.get(id);
  }
  // The newest state that the program has sent.
  state() {
    const all = this.events.split("\n\n").filter((block) => block.includes("event: state\n"));
    return JSON.parse(all[all.length - 1].split("\n").find((line) => line.startsWith("data: ")).slice(6));
  }
}
