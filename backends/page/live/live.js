// Contains the page of the live view: the viewer, the source beside it, parameters, messages, the prompt, and the
// connection to the server. served.js opens it for the server of `vs view`, the playground for the program in a worker.
import { Viewer } from "../viewer.js";
import { readPacked } from "../packed.js";
import { Model, modelFromPacked } from "../model.js";
import { el, icon } from "../dom.js";
import { Source } from "./source.js";
import { isWhole } from "./scheme.js";
import { Conflict } from "./conflict.js";
import { Parameters } from "./parameters.js";
import { Construction, Timeline } from "./timeline.js";
import { Making } from "./making.js";
import { Compare } from "./compare.js";

let ask; // ask(path, options) sends a request to the server and returns a promise of a Response, as fetch does.

const SLOW_SECONDS = 0.12; // If a model takes more seconds than this, it is shown coarser while a slider moves.
const STILL_MS = 900; // After this time without a key, a slow model is drawn whole.
const TALK_MOST = 20000; // Greatest number of characters of output that are shown.
// Returns the end of a text, from a whole character on.
const tail = (text, most) => text.length <= most ? text : text.slice(-most).replace(/^[\udc00-\udfff]/, "");
const VIEWER_FORMATS = new Set(["x3d-packed", "x3d-steps"]), FIRST_FORMAT = "stl"; // FIRST_FORMAT is chosen when the page opens.
const PHONE = 720; // On windows up to this width in pixels, the source lies below the picture (live.css).
const BOTH = 620; // A picture of at least this width has room for the parameters beside the panel.
const GHOSTS_MOST = 50000; // Greatest number of parts of a model for which cuts are searched when the cursor moves.

// Returns true if a file's ending is one of Scheme.
const isScheme = (path) => !/\.[^./]+$/.test(path) || /\.(vs|scm|ss|sld|sls)$/.test(path);

// Keep a choice of the user for the next page. Without storage, the browser forgets it with the page.
function remember(name, value) {
  try { localStorage.setItem("visualscheme " + name, value); } catch { /* no storage */ }
}
function remembered(name) {
  try { return localStorage.getItem("visualscheme " + name); } catch { return null; }
}

const newId = () => Math.random().toString(36).slice(2);
const progress = (phase, fraction) => phase + (fraction >= 0 ? " " + Math.round(100 * fraction) + " %" : " …");

export class Live {
  // server: ask, the function above; values, the parameters set at first, as [name, value]; link(values), the address
  // that shows this model with these values; lasting, whether it works later, too; ended(), why the server has ended, if
  // it can say so.
  constructor(server) {
    this.server = server;
    ask = server.ask;
    const root = document.getElementById("live");
    this.name = el("b", {}, "…");
    this.status = el("span", { class: "status", role: "status", title: "How long the last run took" }, "connecting");
    this.saveButton = el("button", { type: "button", class: "button save", title: "Save (Ctrl S)", disabled: true, onclick: () => this.save() }, "Save");
    this.stopButton = el("button", { type: "button", class: "button", title: "Stop what runs", disabled: true, onclick: () => this.#stop() }, "Stop");
    this.typingButton = el("button", { type: "button", class: "button typing", title: "Draw the unsaved text while you type", onclick: () => this.#setTyping(!this.draws) }, "As you type");
    this.foldButton = el("button", { type: "button", class: "fold", title: "Fold the source (Ctrl B, or S in the picture)", "aria-label": "Fold the source", onclick: () => this.fold(true) }, icon("fold"));
    this.unfoldButton = el("button", { type: "button", class: "unfold glass", title: "Show the source (Ctrl B, or S in the picture)", "aria-label": "Show the source", onclick: () => this.fold(false) }, icon("unfold"));
    this.conflict = new Conflict({ mine: () => this.#keepMine(), theirs: () => this.#takeTheirs() });
    this.editorPlace = el("div", { class: "editor" });
    this.hintPlace = el("div");
    this.messages = el("div", { class: "messages", role: "log", "aria-label": "Messages", hidden: true });
    this.printed = el("pre", { hidden: true });
    this.prompt = el("input", { type: "text", autocomplete: "off", autocapitalize: "off", spellcheck: "false", "aria-label": "Prompt", placeholder: "(draw (make-sphere (xyz 0 0 0) 1))" });
    const consoleArea = el("div", { class: "console" }, this.printed, el("label", {}, "›", this.prompt));
    this.viewPlace = el("div", { class: "view" });
    this.split = el("button", { type: "button", class: "split", "aria-label": "Width of the source: left and right arrow keys" });
    root.append(el("section", { class: "pane", "aria-label": "Source" }, el("div", { class: "top" }, this.name, this.status, this.stopButton, el("span", { class: "reads-only", title: "The model is untrusted: it runs confined, and this page cannot change it" }, "read only"), this.typingButton, this.saveButton, this.foldButton), this.conflict.notice, this.editorPlace, this.hintPlace, this.messages, consoleArea), this.split, this.viewPlace, this.conflict.root);

    this.viewer = new Viewer(this.viewPlace);
    window.visualscheme = this.viewer;
    window.live = this;
    this.viewer.onSelect = (parts) => this.#selected(parts);
    this.viewer.onRay = (ray) => { if (this.scened?.input) this.#input("press", ray), this.#input("release", ray); };
    this.viewer.onOrigin = (o) => this.#showPlace(o);
    this.note = el("div", { class: "stale-note glass", role: "alert", hidden: true });
    this.formats = el("select", { "aria-label": "Format" });
    this.exportButton = el("button", { type: "button", class: "button", onclick: () => this.export() }, "Export");
    this.making = new Making(this.viewer, {
      make: (format, values, options) => this.make(format, values, options), scene: (values, options) => this.scene(values, options),
      parameters: () => this.parameters.infos || [], values: () => Object.fromEntries(this.parameters.changed().map((p) => [p.name, p.value])),
    });
    this.compare = new Compare(this.viewer, (values) => this.scene(values));
    this.parameters = new Parameters({
      set: (name, value, moving) => this.set(name, value, moving), write: () => this.writeParameters(), link: () => this.#link(), lasting: server.lasting,
      compare: (sets) => this.compare.open(sets, (name) => this.parameters.use(name)), place: () => this.state.model,
    });
    this.viewer.root.append(el("div", { class: "exports glass" }, this.formats, this.exportButton, this.making.button), this.note, this.unfoldButton);
    this.viewPlace.append(this.parameters.root, this.compare.root, this.making.root, this.making.large);
    this.timeline = new Timeline(this.viewer, {
      construction: () => this.construction(), mark: (chain) => this.source.mark(chain.filter((o) => this.#isModel(o.file))),
      back: () => { this.source.mark([]); if (this.model) this.viewer.show(this.model, true); },
    });

    this.viewer.addHelp([["Source", "Ctrl B folds it and shows it; Esc, then Tab leaves it; B goes through how the model is made; Alt and a drag turn a number, as do Ctrl and the up and down arrows"]]);
    this.viewer.addKeys({ s: () => this.fold(!this.folded) });
    this.viewer.beside = () => this.parameters.root.open && !this.parameters.root.hidden && innerWidth > PHONE ? this.viewer.canvas.getBoundingClientRect().right - this.parameters.root.getBoundingClientRect().left : 0;
    this.viewer.faceAt = async (at) => {
      const answer = await ask("/face?at=" + at.join(",")).catch(() => null);
      return answer?.ok ? answer.json() : null;
    };
    this.#apart();
    this.source = new Source(this.editorPlace, {
      changed: () => { this.saveButton.disabled = !this.source.dirty; },
      save: () => this.save(),
      cursor: (place) => this.#atCursor(place),
      attempt: (text) => this.#attempt(text),
      typed: (text) => this.#typed(text),
      check: async (text) => {
        const answer = await ask("/check", { method: "POST", body: text });
        return answer.ok ? (await answer.json()).findings : [];
      },
      describe: async (name) => (await ask("/name?of=" + encodeURIComponent(name))).json(),
      complete: async (prefix) => (await ask("/names?prefix=" + encodeURIComponent(prefix))).json(),
    });
    this.hintPlace.replaceWith(this.source.hint);
    this.#setTyping(remembered("draws-as-typed") !== "no");
    this.prompt.addEventListener("keydown", (event) => this.#promptKey(event));
    this.history = [];
    this.pieces = new Map();
    this.telling = new Map(); // For each request: the callback that receives the progress of its output.
    this.version = 0;
    this.talk = this.before = ""; // talk: the model's output; before: its part from before the last run.
    this.missing = this.lost = 0; // Number of omitted characters at the beginning of talk, and of before.
    // When the button that has the focus vanishes, no element gets the keys. The viewer then gets them.
    addEventListener("keydown", (event) => {
      if ((event.ctrlKey || event.metaKey) && !event.altKey && !event.shiftKey && event.key.toLowerCase() === "b") {
        event.preventDefault();
        return this.fold(!this.folded);
      }
      if (event.target !== document.body || event.key === "Tab") return;
      this.viewer.canvas.focus();
      this.viewer.canvas.dispatchEvent(new KeyboardEvent("keydown", event));
    });
    this.#splitter();
    this.#start();
  }

  async #start() {
    await this.#listFormats();
    for (const [name, value] of this.server.values) await this.set(name, value);
    await this.readSource();
    this.#listen();
  }

  // ---- events ----

  async #listen() {
    for (let wait = 250; ; wait = Math.min(4000, 2 * wait)) {
      try {
        const answer = await ask("/events");
        if (answer.status === 403) {
          this.#status("open the address that vs view printed", true);
          return;
        }
        if (!answer.ok) throw new Error(await answer.text());
        const reader = answer.body.pipeThrough(new TextDecoderStream()).getReader();
        let rest = "";
        for (;;) {
          const { value, done } = await reader.read();
          if (done) break;
          wait = 250;
          rest += value;
          const blocks = rest.split("\n\n");
          rest = blocks.pop();
          for (const block of blocks) {
            // Fields are on lines that end in \n alone.
            const field = (name) => block.split("\n").find((line) => line.startsWith(name))?.slice(name.length);
            const kind = field("event: "), data = field("data: ");
            if (kind && data) await this.#hear(kind, data);
          }
        }
      } catch (error) {
        console.info("the view's server is gone:", error.message);
      }
      this.#status(this.server.ended?.() ?? "the server has ended", true);
      await new Promise((go) => setTimeout(go, wait));
    }
  }

  // Shows an event. If this fails, reports the failure; the following events are still processed.
  async #hear(kind, data) {
    try {
      await this.#event(kind, JSON.parse(data));
    } catch (error) {
      console.error(error);
      this.#status("the page could not show this run: " + error.message, true);
    }
  }

  async #event(kind, data) {
    if (kind === "busy") {
      this.stopButton.disabled = false;
      this.#status(progress(data.phase, data.fraction), false);
    } else if (kind === "idle") {
      this.stopButton.disabled = true;
      if (this.state) this.#outcome(this.state);
    } else if (kind === "progress") {
      this.telling.get(data.id)?.(data.phase, data.fraction);
    } else if (kind === "messages") {
      this.#messages(data.messages, data.more);
    } else if (kind === "frame") {
      if (this.timeline.isOpen) return; // The timeline shows a single moment of the drawing, so frames are ignored.
      if (data.version > this.version) await this.#fetchScene(true);
      this.#scene(data.scene);
    } else if (kind === "state") {
      await this.#state(data);
    }
  }

  #status(text, bad) {
    this.status.textContent = text;
    this.status.classList.toggle("bad", bad);
  }

  #outcome(state) {
    const errors = state.messages.filter((m) => m.severity === "error").length;
    this.#status(state.stopped ? "stopped" : errors ? errors + (errors === 1 ? " error" : " errors") : (1000 * state.seconds).toFixed(0) + " ms", errors > 0 || state.stopped);
  }

  async #state(state) {
    this.heard = performance.now(); // Time of the event, which bench/pages/save.mjs reads.
    this.state = state;
    // The picture comes first. A change of the text makes the browser draw the entire page again, which would delay the
    // picture.
    if (state.version !== this.version && state.version > 0) await this.#fetchScene();
    this.stopButton.disabled = true;
    this.name.textContent = state.model.split("/").pop();
    // The page follows a prompt in a terminal, so there is no source.
    document.getElementById("live").classList.toggle("follows", state.follows);
    // A stranger's model: the page shows the source, and offers neither save nor prompt.
    document.getElementById("live").classList.toggle("reads", state.reads);
    this.source.setReadOnly(state.reads);
    this.#outcome(state);
    // Messages about a text that is being typed appear beside its lines only.
    const inText = (m) => this.#isModel(m.at.file) && m.at.line > 0;
    this.#messages(state.trial ? state.messages.filter((m) => !inText(m)) : state.messages, state.more);
    this.source.diagnose(state.messages.filter((m) => this.#isModel(m.at.file)), state.trial ? this.tried : null);
    this.#said(state);
    if (!state.good && !state.trial) await this.#follow(state);
    this.parameters.show(state.good ? state.parameters : this.#known(state));
    if (state.good || !state.trial) { // A mistake while typing leaves the picture as it is.
      this.viewPlace.classList.toggle("stale", !state.good);
      this.note.hidden = state.good;
      this.note.textContent = state.good ? "" : this.viewer.model ? "The last model that could be made" : "Nothing can be shown yet: the program has an error.";
    }
    if (state.good) this.compare.renew();
    this.#scene(state.scene);
    if (state.good) await this.#follow(state);
    this.finished = (this.finished || 0) + 1; // Number of states that were shown, for tests.
  }

  // Reads the model's file again if it has changed. If the page's text has changed as well, says so.
  async #follow(state) {
    if (this.source.text === undefined || state.file === this.file || state.trial) return;
    // The picture comes first, because the editor takes some time for a new text.
    if (this.viewer.stage.dirty) await this.viewer.drawn();
    if (!this.source.dirty) {
      await this.readSource(true);
      this.file = state.file;
    } else {
      const { hash } = await this.#onDisk();
      this.file = state.file;
      if (hash && hash !== this.hash) this.conflict.tell(state.model, () => this.#showConflict());
    }
  }

  // Shows the model's output, and below it the later input of the prompt, with its results.
  #said(state) {
    const asked = state.asked ? "› " + state.asked.trim() + "\n" : "";
    if (!state.prompted) this.before = "", this.lost = 0;
    // Otherwise the same state came again.
    else if (state.run !== this.said) this.before = this.talk, this.lost = this.missing;
    this.said = state.run;
    const whole = this.before + (this.before && !this.before.endsWith("\n") ? "\n" : "") + asked + state.printed + state.values;
    this.talk = tail(whole, TALK_MOST);
    this.missing = this.lost + state.missing + [...whole.slice(0, whole.length - this.talk.length)].length;
    this.printed.textContent = (this.missing > 0 ? `(${this.missing.toLocaleString("en")} characters before these are not shown)\n` : "") + this.talk;
    this.printed.hidden = this.talk === "";
    this.printed.scrollTop = this.printed.scrollHeight;
  }

  // ---- the program's own scene: frames, gizmos, nodes that wait for a click ----

  #scene(scene) {
    this.scened = scene;
    if (!this.viewer.model) return;
    const gizmos = (scene?.gizmos || []).flatMap((g, n) => g.handles.map((at, k) => ({ name: `${g.kind} ${n + 1}${g.handles.length > 1 ? "xyz"[k] : ""}`, gizmo: true, at, words: [...(g.name ? [g.name] : []), ...g.value.map((x) => Number(x.toPrecision(4)))].join(" "),
      ray: (kind, ray) => this.#input(kind, ray) })));
    this.viewer.setHandles([...this.parameters.points(), ...gizmos]);
  }
  // Sends an input of the mouse to the program. Only one request is pending at a time. Of several waiting drags, only
  // the last is sent.
  async #input(kind, { origin, direction }) {
    this.inputs ||= [];
    const input = { kind, body: ["left", ...origin, ...direction].join(" ") };
    if (kind === "drag" && this.inputs[this.inputs.length - 1]?.kind === "drag") this.inputs[this.inputs.length - 1] = input;
    else this.inputs.push(input);
    if (this.inputting) return;
    this.inputting = true;
    while (this.inputs.length > 0) {
      const next = this.inputs.shift();
      await ask("/input?kind=" + next.kind, { method: "POST", body: next.body });
    }
    this.inputting = false;
  }

  // Returns the parameters after a failed run. The run has defined the parameters up to its failure; of the others,
  // those stay unchanged that the program still defines, in its text or in a file that its text names or that it read.
  #known({ parameters: met, trial, files }) {
    const text = (trial ? this.tried : this.source.text) ?? "", now = new Map(met.map((p) => [p.name, p])), before = this.parameters.infos || [], names = new Set(before.map((p) => p.name));
    const defined = new Set([...text.matchAll(/\(define-parameter\s+([^\s()]+)/g)].map((m) => m[1]));
    const stays = (p) => this.#isModel(p.at.file) ? defined.has(p.name) : files.includes(p.at.file) || text.includes(p.at.file.split("/").pop().replace(/\.[^.]*$/, ""));
    return [...before.filter((p) => now.has(p.name) || stays(p)).map((p) => now.get(p.name) || p), ...met.filter((p) => !names.has(p.name))];
  }

  #isModel(file) { return file && (file === this.state?.model || file.split("/").pop() === this.state?.model.split("/").pop()); }

  #messages(list, more) {
    this.messages.hidden = list.length === 0;
    this.messages.replaceChildren(...list.map((m) => {
      const lead = (at, words) => this.#isModel(at.file) ? el("button", { type: "button", onclick: () => this.source.go(at.line, at.column) }, words) : el("span", {}, words);
      const at = m.at.file && m.at.line ? lead(m.at, `${m.at.file.split("/").pop()}:${m.at.line}:${m.at.column}`) : null;
      const caret = m.source && m.at.column ? el("pre", {}, m.source + "\n" + " ".repeat(m.at.column - 1) + "^".repeat(Math.max(1, m.at.endLine === m.at.line ? m.at.endColumn - m.at.column : 1))) : null;
      return el("div", { class: "message " + m.severity }, el("p", {}, at, at ? " " : "", m.message), caret, m.notes.map((n) => el("p", {}, n.message, " ", n.at.line ? lead(n.at, `${(n.at.file || "").split("/").pop()}:${n.at.line}`) : null)));
    }), more > 0 ? el("p", {}, `and ${more} more`) : "");
  }

  // ---- the scene: the server sends only new pieces ----

  async #fetchScene(moving = false) {
    const answer = await ask("/scene?have=" + this.version);
    if (!answer.ok) return;
    const buffer = await answer.arrayBuffer(), view = new DataView(buffer), version = view.getUint32(4, true), count = view.getUint32(8, true);
    let data = 12 + 12 * count, length = 0;
    const list = [], pieces = new Map();
    for (let i = 0; i < count; i++) {
      const at = 12 + 12 * i, size = view.getUint32(at + 8, true), bytes = size & 0x7fffffff, key = view.getUint32(at, true) + "," + view.getUint32(at + 4, true) + "," + bytes;
      let piece = this.pieces.get(key);
      if (size >>> 31) {
        piece = new Uint8Array(buffer, data, bytes);
        data += bytes;
      }
      if (!piece) { // The page no longer has this piece, so all pieces are requested again.
        this.version = 0;
        this.pieces.clear();
        return this.#fetchScene(moving);
      }
      pieces.set(key, piece);
      list.push(piece);
      length += bytes;
    }
    const whole = new Uint8Array(length);
    let to = 0;
    for (const piece of list) whole.set(piece, to), to += piece.length;
    this.travelled = buffer.byteLength;
    this.pieces = pieces;
    this.version = version;
    const first = !this.viewer.model, before = this.model;
    // The length is 0 if the program draws nothing.
    this.model = length === 0 ? new Model().measure() : modelFromPacked(readPacked(whole.buffer), this.spare);
    this.spare = null;
    this.made = null;
    if (this.timeline.isOpen) return this.timeline.renew();
    this.viewer.setGhosts([]);
    this.viewer.show(this.model, !first, { moving });
    this.spare = before;
  }

  // Returns a promise of the steps of the current drawing, which are requested once for each version.
  async construction() {
    if (this.made?.version !== this.version) {
      const made = this.made = { version: this.version, promise: this.#construct() };
      // The request failed, for example because a newer run ended it. It may be sent again.
      made.promise.catch(() => { if (this.made === made) this.made = null; });
    }
    return this.made.promise;
  }
  async #construct() {
    if (this.model.count === 0) return new Construction(this.model);
    const answer = await ask("/export?format=x3d-steps");
    if (!answer.ok) throw new Error((await answer.text()).trim());
    return new Construction(modelFromPacked(readPacked(await answer.arrayBuffer())));
  }

  // ---- the source ----

  async readSource(quietly = false) {
    const answer = await ask("/source");
    if (!answer.ok) return;
    const { text, hash } = await answer.json();
    if (quietly && hash === this.hash) return;
    this.hash = hash;
    this.source.load(text);
    this.#settle();
    this.saveButton.disabled = true;
  }

  async save() {
    if (this.state?.reads) return;
    const text = this.source.text, answer = await ask("/source?hash=" + this.hash, { method: "POST", body: text });
    if (answer.status === 409) return this.#showConflict();
    if (!answer.ok) return this.#status(await answer.text(), true);
    this.hash = (await answer.json()).hash;
    this.conflict.close();
    this.source.saved(text);
    this.#settle();
    this.saveButton.disabled = !this.source.dirty;
  }

  // ---- a file that changed on disk while the page has changes ----

  async #onDisk() {
    const answer = await ask("/source");
    return answer.ok ? answer.json() : {};
  }
  async #showConflict() {
    const { text, hash } = await this.#onDisk();
    if (hash === undefined) return this.#status("the file cannot be read", true);
    this.diskHash = hash;
    this.conflict.open(this.source.text, text);
  }
  #keepMine() {
    this.hash = this.diskHash;
    return this.save();
  }
  async #takeTheirs() {
    this.conflict.close();
    await this.readSource(); // The file may have changed again since both texts were shown.
    await this.#attempt(this.source.text);
  }

  // ---- drawing while the user types ----

  #setTyping(on) {
    this.draws = on;
    this.typingButton.setAttribute("aria-pressed", String(on));
    remember("draws-as-typed", on ? "yes" : "no");
    if (on && this.source.dirty) this.#typed(this.source.text);
  }
  #typed(text) {
    if (!this.draws || this.state?.follows || this.state?.reads) return;
    if (isScheme(this.state?.model || "") && !isWhole(text)) return;
    this.#attempt(text);
  }

  // Requests the model of the current, unsaved text. Only one request is pending at a time; the last text is always
  // sent. A slow model is first drawn coarser, and whole after a moment without another text.
  async #attempt(text) {
    this.wanted = text;
    clearTimeout(this.refining);
    if (this.attempting) return;
    this.attempting = true;
    while (this.wanted !== undefined) {
      const next = this.wanted, coarse = this.state?.seconds > SLOW_SECONDS || this.rough;
      this.wanted = undefined;
      await this.#try(next, coarse).catch((error) => console.info("the text was not sent:", error.message));
      await new Promise((go) => setTimeout(go, 30));
      if (coarse && this.wanted === undefined) this.refining = setTimeout(() => this.#try(next, false), STILL_MS);
    }
    this.attempting = false;
  }
  // The text is the file's again, and the next run draws it whole: a text from before must not replace it.
  #settle() {
    clearTimeout(this.refining);
    this.rough = false;
  }
  // rough: true while the picture is that of a coarse run, whose time says little about that of a whole one.
  #try(text, coarse) {
    this.tried = text;
    this.rough = coarse;
    return ask("/try" + (coarse ? "?coarse=1" : ""), { method: "POST", body: text === this.source.base ? "" : text });
  }

  // ---- parameters ----

  // Returns a promise of the model with other values of parameters, { name: value } in the language's spelling. The
  // current model does not change.
  async scene(values, options) {
    const buffer = await this.make("x3d-packed", values, options);
    return modelFromPacked(readPacked(buffer));
  }
  // Returns a promise of the bytes of an output of the model with these values. told(phase, fraction) receives the
  // progress, and an aborted signal ends the request.
  async make(format, values, { size = "", told, signal } = {}) {
    const id = newId(), body = Object.entries(values).map(([name, value]) => `${name}\x1f${value}\x1e`).join("");
    const cancel = () => ask("/cancel?id=" + id, { method: "POST" });
    if (told) this.telling.set(id, told);
    signal?.addEventListener("abort", cancel, { once: true });
    try {
      const answer = await ask(`/export?format=${format}&size=${encodeURIComponent(size)}&id=${id}`, { method: "POST", body });
      if (!answer.ok) throw new Error((await answer.text()).trim());
      return await answer.arrayBuffer();
    } finally {
      this.telling.delete(id);
      signal?.removeEventListener("abort", cancel);
    }
  }
  // Returns this page's address, with the values of parameters that differ from the source.
  #link() {
    return this.server.link(this.parameters.changed().map((p) => [p.name, p.value]));
  }

  // Sets a parameter. moving: true while the value is still changing; a slow model is then shown coarser.
  set(name, value, moving = false) {
    const moved = name + " " + value;
    if (!moving && !this.coarse && this.moved === moved) return undefined; // The picture already shows the final value.
    this.coarse = moving && (this.coarse || this.state?.seconds > SLOW_SECONDS);
    this.moved = moving ? moved : undefined;
    return ask("/set?name=" + encodeURIComponent(name) + (this.coarse ? "&coarse=1" : ""), { method: "POST", body: value });
  }

  // Writes the values of the sliders into the calls of define-parameter in the source. The rest of the text stays
  // unchanged.
  async writeParameters() {
    let written = 0;
    for (const p of this.parameters.changed()) if (this.#isModel(p.at.file) && this.source.replaceParameter(p.name, p.at, p.type === "string" ? JSON.stringify(p.value) : p.type === "real" && /^-?\d+$/.test(p.value) ? p.value + ".0" : p.value)) written++;
    if (written > 0) await this.save();
  }

  // ---- selection, from picture to text and from text to picture ----

  #selected(parts) {
    this.pointing = null;
    if (!this.timeline?.isOpen) this.viewer.setGhosts([]);
    const chain = parts.length > 0 ? this.viewer.model.chain(parts[0]).filter((o) => this.#isModel(o.file)) : [];
    this.source.mark(chain);
    if (parts.length === 1 && this.viewer.hit?.part === parts[0] && !this.timeline.isOpen) this.#cutHere(parts[0], this.viewer.hit.point);
  }
  // Finds the subtracted part that made this face. Marks the place in the source that made the part, and shows the part
  // as a ghost.
  async #cutHere(part, point) {
    const from = this.pointing = {}, m = this.model;
    if (!this.#isCut() || !["subtract", "intersect"].includes(m.kinds[m.kind[part]])) return;
    const made = await this.construction().catch(() => null);
    if (!made || this.pointing !== from || this.model !== m || this.timeline.isOpen) return;
    const cutter = made.cutterAt(m, point.toArray());
    if (cutter < 0) return;
    const chain = made.model.chain(cutter);
    this.viewer.explain((made.model.kinds[made.model.kind[cutter]] || "part") + ", taken away", chain);
    this.viewer.setGhosts([{ parts: [cutter], model: made.model, color: 0xd0342c, opacity: 0.32 }]);
    this.source.mark(chain.filter((o) => this.#isModel(o.file)));
  }
  #showPlace(o) {
    if (this.#isModel(o.file)) this.source.mark([o], true);
  }
  async #atCursor(places) { // places: the calls around the cursor, the innermost first
    const { viewer } = this, from = this.pointing = {};
    if (!viewer.model) return;
    const at = (place) => (o) => this.#isModel(o.file) && o.line === place.line && o.column === place.column;
    const lit = places.findIndex((place) => viewer.partsOf(at(place)).length > 0);
    viewer.select(lit < 0 ? [] : viewer.partsOf(at(places[lit])), true);
    if (this.timeline.isOpen) return;
    viewer.setGhosts([]);
    if (!this.#isCut()) return;
    // A subtracted part is invisible, or only partly visible. Therefore it is shown as a ghost.
    const { model, ghost } = await this.construction().catch(() => ({}));
    if (!model || this.pointing !== from || this.timeline.isOpen) return;
    for (let k = 0; k <= (lit < 0 ? places.length - 1 : lit); k++) {
      const parts = viewer.partsOf(at(places[k]), model).filter((i) => ghost[i]);
      if (parts.length === 0) continue;
      if (k < lit) viewer.select([], true);
      return viewer.setGhosts([{ parts, model, color: 0xd0342c, opacity: 0.32 }]);
    }
  }
  // Returns true if the model has cuts, and is small enough for a search among them.
  #isCut() {
    const m = this.model;
    return m && m.count <= GHOSTS_MOST && ["subtract", "intersect"].some((kind) => m.kinds.includes(kind));
  }

  // ---- the prompt and the outputs ----

  #promptKey(event) {
    if (event.key === "Enter" && this.prompt.value.trim()) {
      this.history.push(this.prompt.value);
      this.back = this.history.length;
      ask("/prompt", { method: "POST", body: this.prompt.value });
      this.prompt.value = "";
    } else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
      this.back = Math.min(this.history.length, Math.max(0, (this.back ?? this.history.length) + (event.key === "ArrowUp" ? -1 : 1)));
      this.prompt.value = this.history[this.back] || "";
      event.preventDefault();
    }
  }

  // Offers the formats of the program; those that only the viewer reads are omitted. A second notation of a suffix has
  // its name, too.
  async #listFormats() {
    const answer = await ask("/formats");
    if (!answer.ok) return;
    const own = (await answer.json()).filter((f) => !VIEWER_FORMATS.has(f.name)), met = new Set();
    this.suffixes = new Map(own.map((f) => [f.name, f.suffix]));
    this.formats.replaceChildren(...own.map((f) => {
      const words = "." + f.suffix + (met.has(f.suffix) ? ` (${f.name})` : "");
      met.add(f.suffix);
      return el("option", { value: f.name, title: f.doc }, words);
    }));
    this.formats.value = FIRST_FORMAT;
  }

  #stop() {
    if (this.exporting) ask("/cancel?id=" + this.exporting, { method: "POST" });
    return ask("/stop", { method: "POST" });
  }

  async export() {
    const id = this.exporting = newId();
    this.telling.set(id, (phase, fraction) => this.#status(progress(phase, fraction), false));
    const format = this.formats.value, suffix = this.suffixes.get(format);
    this.exportButton.disabled = true;
    this.stopButton.disabled = false;
    const answer = await ask(`/export?format=${format}&size=1280x800&id=${id}`).catch((error) => new Response(error.message, { status: 503 }));
    this.exporting = null;
    this.telling.delete(id);
    this.exportButton.disabled = false;
    this.stopButton.disabled = true;
    if (!answer.ok) return this.#status(await answer.text(), true);
    const url = URL.createObjectURL(await answer.blob());
    el("a", { href: url, download: (this.state?.model || "model").split("/").pop().replace(/\.[^.]*$/, "") + "." + suffix }).click();
    setTimeout(() => URL.revokeObjectURL(url), 60000);
    this.#status("wrote ." + suffix, false);
  }

  // Folds the source away, so that the picture has the whole window, or shows it again.
  fold(folded) {
    this.folded = folded;
    document.getElementById("live").classList.toggle("folded", folded);
    (folded ? this.unfoldButton : this.foldButton).focus({ preventScroll: true });
  }

  // The parameters and the viewer's panel lie beside each other over the picture. If the picture is too narrow for
  // both, opening one closes the other. The model is framed beside them, unless the user has moved the camera.
  #apart() {
    const { viewer } = this, parameters = this.parameters.root, narrow = () => viewer.root.clientWidth < BOTH;
    parameters.addEventListener("toggle", () => {
      if (parameters.open && narrow() && !viewer.panel.root.hidden) viewer.togglePanel();
      viewer.reframe();
    });
    new MutationObserver(() => viewer.reframe()).observe(parameters, { attributeFilter: ["hidden"] });
    new MutationObserver(() => { if (!viewer.panel.root.hidden && narrow()) parameters.open = false; }).observe(viewer.panel.root, { attributeFilter: ["hidden"] });
  }

  #splitter() {
    const set = (x) => document.getElementById("live").style.setProperty("--left", Math.min(75, Math.max(15, x)) + "%");
    let now = 40;
    this.split.addEventListener("pointerdown", (event) => {
      this.split.setPointerCapture(event.pointerId);
      const move = (e) => set(now = 100 * e.clientX / innerWidth);
      this.split.addEventListener("pointermove", move);
      this.split.addEventListener("pointerup", () => this.split.removeEventListener("pointermove", move), { once: true });
    });
    this.split.addEventListener("keydown", (event) => { if (event.key === "ArrowLeft") set(now -= 2); if (event.key === "ArrowRight") set(now += 2); });
  }
}
