// Opens the page of the playground: the live view's page over the program in a worker. A program comes from the
// address (a shared link, an example), from this browser's storage, or is the first example.
import { zipSync, strToU8 } from "three/examples/jsm/libs/fflate.module.js";
import { Live } from "../../../backends/page/live/live.js";
import { el } from "../../../backends/page/dom.js";
import { Engine } from "./engine.js";
import { pack, unpack } from "./share.js";

const FOLDER = "/model/", EXAMPLES = "/model/examples/", STORED = "visualscheme.program", FIRST = "twisted-tower.vs";
const here = new URL(".", location.href).href, embedded = window.parent !== window;
const fragment = Object.fromEntries(location.hash.slice(1).split("&").map((word) => [word.split("=")[0], word.slice(word.indexOf("=") + 1)]));

const stored = () => { try { return JSON.parse(localStorage.getItem(STORED)); } catch { return null; } };
// Keeps a program, and returns true if there are room and storage for it.
const store = (program) => { try { localStorage.setItem(STORED, JSON.stringify(program)); return true; } catch { return false; } };
const KEPT = "stored"; // The part after the # of an address that opens the kept program.

// Opens the program that the part after the # of an address names; the page may have this address already.
function visit(part) {
  if (location.hash === "#" + part) location.reload();
  else location.hash = part;
}

// A page from a file may not fetch: all files are in a script then.
const fromFile = location.protocol === "file:";
const loadScript = (name) => new Promise((go, fail) => document.head.append(el("script", { src: name, onload: go, onerror: () => fail(new Error(name + " is missing")) })));
const bytesOf = (base64) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

async function files() {
  if (!fromFile) return (await (await fetch("files.json")).json()).map((name) => [name, new URL("files/" + name, here).href]);
  await loadScript("offline.js");
  return Object.keys(window.visualschemeFiles).map((name) => [name, null]);
}
const content = async (name) => fromFile ? bytesOf(window.visualschemeFiles[name]) : new Uint8Array(await (await fetch("files/" + name)).arrayBuffer());

// Fulfilled when the page that contains this one, if any, asks for a run.
const asked = new Promise((go) => { if (embedded) addEventListener("message", (event) => { if (event.source === window.parent && event.data === "run") go(); }); });

class Playground {
  // program: { name, text, values, stranger, example }.
  constructor(program, names) {
    this.program = program;
    this.names = names;
    this.model = (program.example ? EXAMPLES : FOLDER) + program.name;
    this.added = []; // Files that were dragged in, as [path, bytes].
    this.engine = new Engine({
      open: () => ({ model: this.model, files: [[this.model, this.program.text], ...this.added, ...(fromFile ? names.map(([name]) => ["/" + name, bytesOf(window.visualschemeFiles[name])]) : [])] }),
      worker: () => fromFile ? new Worker(URL.createObjectURL(new Blob([window.visualschemeEngine, "\n", window.visualschemeWorker], { type: "text/javascript" }))) : new Worker("worker.js"),
      start: fromFile ? { program: bytesOf(window.visualschemeProgram) } : { names: names.filter(([name]) => "/" + name !== this.model).map(([name, url]) => ["/" + name, url]) },
    });
    this.live = new Live({ ask: (path, options) => this.#ask(path, options), values: program.values, link: (values) => this.link(values), lasting: true, ended: () => this.why });
    this.engine.halted = (why) => {
      this.live.version = 0; // The next program numbers its scenes from 1 again.
      this.live.pieces.clear();
      this.why = why;
      this.live.status.textContent = why;
      this.live.status.classList.add("bad");
    };
    this.#tools();
    if (program.stranger && !embedded) this.stranger.hidden = false;
    else if (!program.stranger) this.engine.run();
    asked.then(() => this.engine.run());
    if (embedded && fragment.pane !== "1") document.getElementById("live").classList.add("embedded");
    document.body.addEventListener("dragover", (event) => event.preventDefault());
    document.body.addEventListener("drop", (event) => { event.preventDefault(); this.add([...event.dataTransfer.files]); });
    addEventListener("hashchange", () => location.reload());
    window.playground = this;
  }

  // Passes a request on. A saved text is kept in this browser, too, and a reload opens it. A frame in another page keeps
  // no saved text: the browser has one kept program, the user's own.
  async #ask(path, options) {
    const answer = await this.engine.ask(path, options);
    if (path.startsWith("/source?") && answer.ok) {
      this.program = { ...this.program, text: options.body };
      if (!embedded && store({ name: this.program.name, text: options.body, values: [], example: this.program.example })) history.replaceState(null, "", "#" + KEPT);
    }
    return answer;
  }

  #tools() {
    const button = (text, title, onclick) => el("button", { type: "button", class: "button", title, onclick }, text);
    const chosen = el("select", { "aria-label": "Examples", onchange: () => { if (chosen.value) visit("example=" + encodeURIComponent(chosen.value)); } },
      el("option", { value: "" }, "Examples"), this.names.map(([name]) => name).filter((name) => /^model\/examples\/[^/]+\.vs$/.test(name)).map((name) => el("option", { value: name.split("/").pop() }, name.split("/").pop().replace(/\.vs$/, "").replace(/-/g, " "))));
    const pick = el("input", { type: "file", multiple: true, hidden: true, onchange: () => this.add([...pick.files]) });
    this.said = el("span", { role: "status" });
    this.stranger = el("div", { class: "stranger", hidden: true }, el("p", {}, "This program came with the address. It has not run. It can reach nothing but this page."), button("Run it", "Run the program", () => { this.stranger.hidden = true; this.engine.run(); }));
    this.live.editorPlace.before(el("div", { class: "tools" }, chosen, button("Open", "Open a program, or add data for it: files can be dropped on the page, too", () => pick.click()), pick,
      button("Share", "Copy an address that shows this program, with the values of its parameters", () => this.share()), button("Download", "Save all files in a .zip", () => this.download()), this.said), this.stranger);
  }

  values() { return this.live.parameters.changed().map((p) => [p.name, p.value]); }
  async link(values) { return location.href.replace(/#.*/, "") + "#program=" + await pack({ name: this.program.name, text: this.live.source.text ?? this.program.text, values }); }

  async share() {
    const address = await this.link(this.values());
    history.replaceState(null, "", address);
    const copied = await navigator.clipboard?.writeText(address).then(() => true, () => false);
    this.said.textContent = (copied ? "The address is copied" : "The address is in the address bar") + `: ${address.length.toLocaleString("en")} characters.`;
    return address;
  }

  async download() {
    const all = Object.fromEntries((await this.engine.files()).map(([path, bytes]) => [path.slice(FOLDER.length), bytes]));
    all[this.model.slice(FOLDER.length)] = strToU8(this.live.source.text ?? this.program.text);
    const url = URL.createObjectURL(new Blob([zipSync(all)], { type: "application/zip" }));
    el("a", { href: url, download: this.program.name.replace(/\.[^.]*$/, "") + ".zip" }).click();
    setTimeout(() => URL.revokeObjectURL(url), 60000);
  }

  // Adds files: a program opens, other files are data beside it.
  async add(list) {
    for (const file of list) {
      const bytes = new Uint8Array(await file.arrayBuffer());
      if (/\.(vs|scm|js|gml|lsp)$/.test(file.name)) {
        if (store({ name: file.name, text: new TextDecoder().decode(bytes), values: [] })) visit(KEPT);
        else this.said.textContent = `${file.name} does not fit into this browser's storage.`;
        return;
      }
      const path = this.model.slice(0, this.model.lastIndexOf("/") + 1) + file.name;
      this.added.push([path, bytes]);
      this.engine.put(path, bytes);
      this.said.textContent = `${file.name} is there: ${bytes.length.toLocaleString("en")} bytes.`;
    }
  }
}

async function chosen(names) {
  if (fragment.program) {
    const program = await unpack(fragment.program);
    if (program) return { ...program, stranger: true };
  }
  const kept = stored();
  if (fragment.example === undefined && kept) return kept;
  const wanted = decodeURIComponent(fragment.example || FIRST), name = names.some(([known]) => known === "model/examples/" + wanted) ? wanted : FIRST;
  return { name, text: new TextDecoder().decode(await content("model/examples/" + name)), values: [], example: true };
}

async function open() {
  const names = await files(), program = await chosen(names), { said } = new Playground(program, names);
  if (fragment.program !== undefined && !program.stranger) said.textContent = "The program in this address is damaged. Another program is shown.";
}
open().catch((error) => document.getElementById("live").append(el("p", { class: "notice" }, "The playground could not be opened: " + error.message)));
if ("serviceWorker" in navigator && !fromFile && !embedded) navigator.serviceWorker.register("service.js").catch(() => {});
