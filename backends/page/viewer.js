// Contains the viewer's user interface: the toolbar, menus, panel, section, measuring, keys. Create `new
// Viewer(element)`, then call show(model).
import * as THREE from "three";
import { Stage } from "./stage.js";
import { CameraControl } from "./camera.js";
import { ViewCube } from "./cube.js";
import { Grid } from "./grid.js";
import { pick, rayAt, snap, toScreen } from "./pick.js";
import { length, roundStep } from "./lengths.js";
import { Measures } from "./measure.js";
import { el, svg, icon } from "./dom.js";
import { Panel } from "./panel.js";

const AXES = { x: new THREE.Vector3(1, 0, 0), y: new THREE.Vector3(0, 1, 0), z: new THREE.Vector3(0, 0, 1) };
const MODES = [["top", "Top", "7"], ["bottom", "Bottom", ""], ["front", "Front", "1"], ["back", "Back", ""], ["left", "Left", ""], ["right", "Right", "3"], ["iso", "Isometric", "0"], ["start", "First view", "R"]];
const SHOWS = [["edges", "Edges", "E"], ["shadows", "Shadows", ""], ["occlusion", "Ambient occlusion", ""], ["grid", "Grid and axes", "N"], ["wireframe", "Wireframe", "W"], ["dark", "Dark", "D"]];

export class Viewer {
  constructor(host) {
    // The tabindex lets the viewer get the keys after a click beside the buttons.
    this.root = el("div", { class: "vs", tabindex: "-1" });
    host.append(this.root);
    this.canvas = el("canvas", { tabindex: "0", role: "img", "aria-label": "The model. Arrow keys turn it, plus and minus zoom." });
    this.overlay = svg("svg", { class: "overlay", "aria-hidden": "true" });
    this.root.append(this.canvas, this.overlay);
    try {
      this.stage = new Stage(this.canvas);
    } catch (error) {
      this.root.append(el("p", { class: "notice" }, "The model cannot be shown: " + error.message));
      throw error;
    }
    document.documentElement.classList.toggle("software", this.stage.software);
    this.control = new CameraControl(this.stage);
    this.hidden = { layers: new Set(), materials: new Set(), parts: new Set() };
    this.chosen = [];
    this.marks = [];
    this.ghosts = [];
    this.handles = []; // Points that the user can drag: { name, at, drag(xyz) }, in the model's coordinates.
    this.filter = null; // A function that returns true for the parts that the picture shows; null: it shows all.
    this.keys = {};
    this.measures = new Measures();
    this.beside = () => 0; // Returns the number of pixels at the picture's right border that something covers.
    this.onSelect = () => {};
    this.faceAt = null; // async (point): describes the face there, as the live view's server does
    this.#build();
    this.grid = new Grid(this.stage);
    this.cube = new ViewCube(this.control, { view: (name) => this.view(name), from: (yaw, pitch) => { this.control.from(yaw, pitch); this.#pressed(); } });
    this.cube.root.addEventListener("pointerdown", () => { this.touched = true; });
    this.root.append(this.cube.root);
    this.control.depthAt = (x, y) => pick(this.stage, x, y)?.point || null;
    this.control.click = (x, y) => this.#click(x, y);
    this.control.changed = () => { this.cube.draw(); this.#drawOverlay(); };
    this.control.beside = () => this.beside();
    this.control.covered = () => this.bar.offsetHeight === 0 ? 0 : Math.max(0, 8 + this.canvas.getBoundingClientRect().bottom - this.bar.getBoundingClientRect().top);
    this.setDark(matchMedia("(prefers-color-scheme: dark)").matches);
    new ResizeObserver(() => {
      this.stage.resize();
      if (!this.model) return;
      if (!this.touched) this.reframe();
      else this.control.apply();
    }).observe(this.root);
    for (const name of ["pointerdown", "wheel", "keydown"]) this.canvas.addEventListener(name, () => { this.touched = true; }, { passive: true });
    this.canvas.addEventListener("pointermove", (event) => this.#hover(event));
    this.root.addEventListener("keydown", (event) => this.#key(event));
  }

  // ---- the model ----

  // Shows a model. keep: true if the camera stays, for a new version of the same model. aside: true if the model only
  // shows more details of the previous model, so that title and size stay. moving: true for a frame of an animation,
  // which the camera does not follow out of the picture.
  show(model, keep = false, { aside = false, moving = false } = {}) {
    // grown: true if the model was empty, so that there was no view to keep
    const was = this.model, grown = was?.count === 0 && model.count > 0;
    const first = !was || !keep || grown;
    this.model = model;
    // True if only the places of parts have changed, as in a frame of an animation.
    const same = !first && was?.count === model.count && !aside;
    if (first) for (const set of Object.values(this.hidden)) set.clear();
    else if (!same) this.hidden.parts.clear();
    if (!same || this.chosen.length === 0) this.select([]);
    this.measures.clear();
    document.title = model.title;
    this.heading.textContent = model.title;
    if (!aside) this.facts.textContent = model.count === 0 ? "" : model.size.map((s) => length(s)).join(" × ") + " " + model.units;
    this.stage.resize();
    this.stage.setModel(model, this.shown);
    if (this.gridShown) this.grid.show(model);
    if (this.chosen.length > 0) this.#showMarks();
    if (first) {
      this.touched = this.handlesFramed = false;
      this.setSection(null);
      this.control.reset();
    } else {
      if (this.section) this.setSection(this.section);
      this.control.apply();
      if (!this.control.walking && !moving && !aside && this.control.outOfFrame()) this.control.reset();
      this.stage.now();
    }
    this.panel.refresh();
  }

  // Returns a promise that resolves when the next picture has been drawn, or after a moment, because a hidden window
  // draws nothing.
  drawn() {
    return new Promise((go) => {
      const late = setTimeout(go, 150);
      requestAnimationFrame(() => setTimeout(() => { clearTimeout(late); go(); }));
    });
  }

  isShown(i) {
    const m = this.model, h = this.hidden;
    return !(h.layers.has(m.layers[m.layer[i]]) || h.materials.has(m.paint[i]) || h.parts.has(i)) && (!this.filter || this.filter(i));
  }
  // Returns isShown as a function for callers with a million parts, or null if all parts are shown.
  get shown() { return this.filter || Object.values(this.hidden).some((set) => set.size > 0) ? (i) => this.isShown(i) : null; }
  refresh() { this.stage.refresh(this.shown); }

  select(parts, quietly = false) {
    this.chosen = parts;
    this.explained = null;
    this.marks = parts.length > 0 ? [{ parts, color: 0x1f6fd0, opacity: 0.35 }] : [];
    this.#showMarks();
    this.#card();
    this.panel?.mark();
    if (!quietly) this.onSelect(parts);
  }

  // Shows parts of this model or of another one through all other objects: [{ parts, color, opacity, model }].
  setGhosts(ghosts) {
    if (ghosts.length === 0 && this.ghosts.length === 0) return;
    this.ghosts = ghosts;
    this.#showMarks();
  }
  #showMarks() { if (this.model) this.stage.setMarks([...this.ghosts, ...this.marks]); }

  // ---- the controls around the picture ----

  #button(name, label, key, action, attributes = {}) {
    const b = el("button", { type: "button", title: label + (key ? ` (${key})` : ""), "aria-label": label, "data-do": name, onclick: action, ...attributes }, icon(name));
    return b;
  }

  #build() {
    this.heading = el("h1");
    this.facts = el("p");
    this.head = el("header", { class: "title" }, this.heading, this.facts);
    this.buttons = {};
    const add = (name, label, key, action, attributes) => this.buttons[name] = this.#button(name, label, key, () => { this.touched = true; action(); }, attributes);
    this.bar = el("div", { class: "bar glass", role: "toolbar", "aria-label": "Viewer" },
      add("fit", "Fit the model", "F", () => this.fit()),
      add("views", "Standard views", "", () => this.#menu("views"), { "aria-haspopup": "menu", "aria-expanded": "false" }),
      add("parallel", "Parallel projection", "P", () => this.toggleParallel(), { "aria-pressed": "false" }),
      add("walk", "Walk at eye height", "G", () => this.toggleWalk(), { "aria-pressed": "false" }),
      el("span", { class: "gap" }),
      add("section", "Section plane", "X", () => this.setSection(this.section ? null : { axis: "y", at: 0.5, flip: false }), { "aria-pressed": "false" }),
      add("measure", "Measure", "M", () => this.setMeasuring(!this.measuring), { "aria-pressed": "false" }),
      el("span", { class: "gap" }),
      add("display", "Light and lines", "", () => this.#menu("display"), { "aria-haspopup": "menu", "aria-expanded": "false" }),
      add("panel", "Layers, materials and parts", "L", () => this.togglePanel(), { "aria-expanded": "false" }),
      add("help", "Help", "?", () => this.toggleHelp(), { "aria-expanded": "false" }));
    const item = (label, key, action, attributes) => el("button", { type: "button", onclick: () => { this.touched = true; action(); }, ...attributes }, label, key ? el("kbd", {}, key) : null);
    this.menus = {
      views: el("div", { class: "menu glass", role: "menu", "aria-label": "Standard views", hidden: true },
        MODES.map(([name, label, key]) => item(label, key, () => { this.view(name); this.#menu(null); }, { role: "menuitem", "data-view": name }))),
      display: el("div", { class: "menu glass", role: "menu", "aria-label": "Light and lines", hidden: true },
        SHOWS.map(([name, label, key]) => item(label, key, () => this.toggle(name), { role: "menuitemcheckbox", "data-show": name }))),
    };
    this.sectionStrip = this.#sectionStrip();
    this.measureStrip = el("div", { class: "strip glass words-only", role: "status", hidden: true }, el("span", { class: "words" }, "Click corners, edges or faces; Esc takes the last reading away"));
    this.card = el("aside", { class: "card glass", "aria-label": "What is chosen", hidden: true });
    this.help = el("div", { class: "help glass", role: "dialog", "aria-label": "Help", hidden: true },
      el("button", { type: "button", class: "close", "aria-label": "Close", onclick: () => this.toggleHelp() }, icon("close")),
      el("h2", {}, "Moving about"),
      this.helpList = el("dl"));
    this.addHelp([["Turn", "drag, one finger, or the arrow keys"], ["Move", "right or middle drag, shift-drag, two fingers, or shift and arrows"], ["Zoom", "wheel or pinch, towards the pointer; plus and minus"],
        ["Go to", "double click"], ["Choose", "click; H hides what is chosen, F frames it, Esc lets it go"], ["Walk", "W A S D or arrows, drag to look, Q and E down and up"], ["Keys", "X section, M measure, P parallel, G walk, 1 3 7 0 views, L lists, E edges, N grid, D dark"]]);
    this.says = el("div", { class: "live", role: "status", "aria-live": "polite" });
    this.panel = new Panel(this);
    this.root.append(this.head, this.panel.root, this.card, this.sectionStrip, this.measureStrip, this.menus.views, this.menus.display, this.bar, this.help, this.says);
    this.#marksOfMenus();
  }

  // Adds a button and its key, for pages that extend the viewer.
  addButton(name, label, key, action, attributes) {
    const button = this.buttons[name] = this.#button(name, label, key, () => { this.touched = true; action(); }, attributes);
    this.buttons.help.before(button);
    if (key) this.keys[key.toLowerCase()] = () => button.click();
    return button;
  }
  addHelp(rows) { this.helpList.append(...rows.flatMap(([name, words]) => [el("dt", {}, name), el("dd", {}, words)])); }
  addKeys(keys) { Object.assign(this.keys, keys); }

  say(text) { this.says.textContent = text; }

  #menu(name) {
    for (const [key, menu] of Object.entries(this.menus)) {
      const open = key === name && menu.hidden;
      menu.hidden = !open;
      this.buttons[key].setAttribute("aria-expanded", String(open));
      if (open) menu.querySelector("button").focus();
    }
  }
  #marksOfMenus() {
    for (const b of this.menus.display.querySelectorAll("[data-show]")) b.setAttribute("aria-checked", String(b.dataset.show === "grid" ? !!this.gridShown : !!this.stage.options[b.dataset.show]));
  }

  fit() {
    const parts = this.chosen;
    if (this.control.walking) this.toggleWalk();
    if (parts.length === 0) return this.control.fit();
    const m = this.model, box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
    for (const i of parts) for (let k = 0; k < 3; k++) {
      box.min[k] = Math.min(box.min[k], m.ball[4 * i + k] - m.ball[4 * i + 3]);
      box.max[k] = Math.max(box.max[k], m.ball[4 * i + k] + m.ball[4 * i + 3]);
    }
    this.control.fit(box);
  }
  view(name) {
    this.control.view(name);
    this.#pressed();
    this.say("View: " + name);
  }
  toggleParallel() { this.control.setParallel(!this.control.state.parallel); this.#pressed(); }
  toggleWalk() { this.control.walk(!this.control.walking); this.canvas.focus(); this.#pressed(); }
  toggle(name) {
    if (name === "dark") this.setDark(!this.stage.options.dark);
    else if (name === "grid") this.setGrid(!this.gridShown);
    else this.stage.setOptions({ [name]: !this.stage.options[name] });
    this.#marksOfMenus();
  }
  setGrid(shown) {
    this.gridShown = shown;
    if (shown && this.model) this.grid.show(this.model);
    else this.grid.clear();
    this.stage.touch();
    this.#marksOfMenus();
    this.#drawOverlay();
  }
  setDark(dark) {
    document.documentElement.classList.toggle("dark", dark);
    this.stage.setOptions({ dark });
    this.#marksOfMenus();
  }
  togglePanel() {
    this.panel.root.hidden = !this.panel.root.hidden;
    this.buttons.panel.setAttribute("aria-expanded", String(!this.panel.root.hidden));
    if (!this.panel.root.hidden) this.panel.refresh();
  }
  toggleHelp() {
    this.help.hidden = !this.help.hidden;
    this.buttons.help.setAttribute("aria-expanded", String(!this.help.hidden));
    if (!this.help.hidden) this.help.querySelector("button").focus();
  }
  #pressed() {
    const c = this.control, s = c.motion ? c.motion.to : c.state;
    this.buttons.parallel.setAttribute("aria-pressed", String(s.parallel));
    this.buttons.walk.setAttribute("aria-pressed", String(c.walking));
    this.buttons.section.setAttribute("aria-pressed", String(!!this.section));
    this.buttons.measure.setAttribute("aria-pressed", String(!!this.measuring));
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, textarea, select, [contenteditable], .cm-editor")) return;
    const key = event.key.toLowerCase();
    if (this.control.walking && event.target === this.canvas && ["w", "a", "s", "d", "q", "e"].includes(key)) return;
    const does = {
      f: () => this.fit(), r: () => this.view("start"), p: () => this.toggleParallel(), g: () => this.toggleWalk(), x: () => this.buttons.section.click(), m: () => this.setMeasuring(!this.measuring),
      l: () => this.togglePanel(), e: () => this.toggle("edges"), n: () => this.toggle("grid"), w: () => this.toggle("wireframe"), d: () => this.toggle("dark"), "?": () => this.toggleHelp(),
      7: () => this.view("top"), 1: () => this.view("front"), 3: () => this.view("right"), 0: () => this.view("iso"), t: () => this.view("top"),
      h: () => this.hideChosen(), escape: () => this.#escape(),
    }[key] || this.keys[key];
    if (!does) return;
    this.touched = true;
    does();
    event.preventDefault();
  }
  #escape() {
    const open = Object.keys(this.menus).find((key) => !this.menus[key].hidden);
    if (open) this.#menu(open), this.buttons[open].focus();
    else if (!this.help.hidden) this.toggleHelp(), this.buttons.help.focus();
    else if (this.control.walking) this.toggleWalk();
    else if (this.measures.count > 0) this.measures.takeAway(), this.#drawOverlay();
    else if (this.measuring) this.setMeasuring(false);
    else this.select([]);
  }

  hideChosen() {
    for (const i of this.chosen) this.hidden.parts.add(i);
    this.say(this.chosen.length + " hidden");
    this.select([]);
    this.refresh();
    this.panel.refresh();
  }
  showAll() {
    for (const set of Object.values(this.hidden)) set.clear();
    this.refresh();
    this.panel.refresh();
  }

  // ---- choosing and measuring ----

  #click(x, y) {
    this.#menu(null);
    if (this.measuring) {
      const found = snap(this.stage, x, y);
      if (found) this.say(this.measures.add(found, this.model.units, this.model.middle));
      if (found?.kind === "face") this.#describeFace(found);
      return this.#drawOverlay();
    }
    this.onRay?.(this.#worldRay(x, y));
    const hit = pick(this.stage, x, y);
    this.hit = hit;
    if (hit) this.say(this.describe(hit.part));
    this.select(hit ? [hit.part] : []);
    this.hit = null;
  }

  // Asks for the surface of a face that the user has clicked, and measures it instead of its facets.
  async #describeFace(mark) {
    const { middle, units } = this.model, from = (p) => new THREE.Vector3(...p.map((v, k) => v - middle[k]));
    const s = await this.faceAt?.(mark.at.toArray().map((v, k) => v + middle[k]));
    if (!s?.form) return;
    const words = this.measures.describe(mark, { ...s, at: from(s.at), axis: new THREE.Vector3(...s.axis) }, units, middle);
    if (words === null) return;
    this.say(words);
    this.#drawOverlay();
  }

  describe(i) {
    const m = this.model, where = m.where(i);
    return (m.kinds[m.kind[i]] || "part") + (where ? ` at ${where.name}, line ${where.line}` : "");
  }

  #card() {
    this.card.hidden = this.chosen.length === 0 || !this.model;
    if (this.card.hidden) return;
    const m = this.model, i = this.chosen[0], paint = m.materials[m.paint[i]], layer = m.layers[m.layer[i]];
    const kind = this.explained?.kind || m.kinds[m.kind[i]] || "part", chain = this.explained?.chain || m.chain(i);
    const words = [paint.name || (m.paint[i] ? "coloured" : "plain"), layer ? "layer " + layer : "", this.chosen.length > 1 ? this.chosen.length + " parts" : ""].filter(Boolean).join(" · ");
    this.card.replaceChildren(
      el("button", { type: "button", class: "close", "aria-label": "Let go", onclick: () => this.select([]) }, icon("close")),
      el("h2", {}, kind), el("p", {}, words),
      el("div", { class: "path" }, chain.slice(0, 8).map((o) => el("button", { type: "button", title: `Choose all that ${o.file}:${o.line} made`, onclick: () => this.selectOrigin(o) }, `${o.name}:${o.line}`))));
  }

  // Shows that the chosen part comes from another call than its own constructor.
  explain(kind, chain) {
    this.explained = { kind, chain };
    this.#card();
    this.say(kind + (chain.length > 0 ? ` at ${chain[0].name}, line ${chain[0].line}` : ""));
  }

  // Selects all parts that the call at the place of origin o made.
  selectOrigin(o) {
    this.select(this.partsOf((q) => q.file === o.file && q.line === o.line && q.column === o.column));
    this.onOrigin?.(o);
  }
  partsOf(wanted, m = this.model) {
    const hits = new Uint8Array(m.origins.at.length / 4 + 1), paths = new Uint8Array(m.pathCount), found = [];
    // Callers come before the calls inside them.
    for (let o = 1; o < hits.length; o++) hits[o] = wanted(m.origin(o)) || hits[m.origins.at[4 * (o - 1) + 3]] ? 1 : 0;
    for (let p = 1; p < m.pathCount; p++) paths[p] = hits[m.pathOrigin[p]] || paths[m.pathParent[p]];
    for (let i = 0; i < m.count; i++) if (hits[m.made[i]] || paths[m.path[i]]) found.push(i);
    return found;
  }

  setMeasuring(on) {
    this.measuring = on;
    if (!on) this.measures.clear();
    this.root.classList.toggle("measuring", on);
    this.measureStrip.hidden = !on;
    if (on) this.setSectionStrip(false);
    else if (this.section) this.setSectionStrip(true);
    this.#pressed();
    this.#drawOverlay();
  }

  // ---- the section ----

  #sectionStrip() {
    const axis = (name) => el("button", { type: "button", "data-axis": name, "aria-label": "Section across " + name.toUpperCase(), "aria-pressed": "false", onclick: () => this.setSection({ ...this.section, axis: name }) }, name.toUpperCase());
    this.sectionRange = el("input", { type: "range", min: "0", max: "1", step: "0.001", "aria-label": "Place of the section", oninput: () => this.setSection({ ...this.section, at: Number(this.sectionRange.value) }) });
    this.sectionOutput = el("output");
    return el("div", { class: "strip glass", role: "group", "aria-label": "Section", hidden: true }, axis("x"), axis("y"), axis("z"), this.sectionRange, this.sectionOutput,
      el("button", { type: "button", "aria-label": "Keep the other side", title: "Keep the other side", onclick: () => this.setSection({ ...this.section, flip: !this.section.flip }) }, icon("flip")),
      el("button", { type: "button", "aria-label": "No section", title: "No section", onclick: () => this.setSection(null) }, icon("close")));
  }
  setSectionStrip(shown) { this.sectionStrip.hidden = !shown; }

  setSection(section) {
    this.section = section;
    this.setSectionStrip(!!section && !this.measuring);
    if (section) {
      const k = "xyz".indexOf(section.axis), b = this.model.box, place = b.min[k] + section.at * (b.max[k] - b.min[k]);
      // A horizontal section keeps the lower side.
      const normal = AXES[section.axis].clone().multiplyScalar(section.flip ? -1 : 1).multiplyScalar(section.axis === "z" ? -1 : 1);
      this.stage.setSection({ normal, constant: -normal.clone().dot(AXES[section.axis]) * place });
      this.sectionRange.value = section.at;
      this.sectionOutput.textContent = length(place + this.model.middle[k], this.model.units);
      for (const button of this.sectionStrip.querySelectorAll("[data-axis]")) button.setAttribute("aria-pressed", String(button.dataset.axis === section.axis));
    } else if (this.model) {
      this.stage.setSection(null);
    }
    this.#pressed();
    this.#drawOverlay();
  }

  // ---- labels over the picture ----

  #hover(event) {
    if (!this.measuring || this.control.pointers.size > 0) return;
    const r = this.canvas.getBoundingClientRect();
    const found = snap(this.stage, event.clientX - r.left, event.clientY - r.top);
    this.measures.hovered = found;
    this.#drawOverlay();
  }

  #drawOverlay() {
    if (!this.stage?.camera || !this.model) return;
    const shapes = [], at = (p) => toScreen(this.stage, p);
    if (this.section) shapes.push(...this.#sectionShapes(at));
    if (this.measuring) shapes.push(...this.measures.shapes(at, this.model.units, this.model.middle));
    for (const tick of this.grid.numbers(this.stage.camera.position)) {
      const p = at(tick.at);
      if (!p.behind) shapes.push(svg("text", { x: p.x, y: p.y + 10, class: "tick" }, tick.text));
    }
    for (const handle of this.handles) shapes.push(...this.#handleShapes(handle, at));
    this.overlay.replaceChildren(...shapes);
  }

  // ---- points that can be dragged ----

  setHandles(handles) {
    this.handles = this.grip ? handles.map((h) => h.name === this.grip.name ? { ...h, at: this.grip.at } : h) : handles;
    this.#frameHandles();
    this.#drawOverlay();
  }
  // Frames the model and its handles anew, unless the user has moved the camera.
  reframe() {
    if (!this.model || this.touched) return;
    this.control.reset();
    this.handlesFramed = false;
    this.#frameHandles();
  }
  // If handles are outside of the picture, or covered, frames them together with the model. Does so only once, and only if the user
  // has not moved the camera.
  #frameHandles() {
    if (!this.model || this.touched || this.handlesFramed || this.handles.length === 0) return;
    this.handlesFramed = true;
    // Distant handles are ignored, because the model would become tiny.
    const empty = this.model.count === 0, near = (p) => empty || p.distanceTo(this.stage.center) < 3 * this.stage.radius, points = this.handles.map((h) => this.#fromModel(h.at)).filter(near);
    const right = 0.9 - 2 * this.beside() / Math.max(1, this.canvas.clientWidth);
    const seen = (p) => { const q = p.clone().project(this.stage.camera); return q.x > -0.9 && q.x < right && Math.abs(q.y) < 0.8 && q.z < 1; };
    this.stage.camera.updateMatrixWorld();
    if (!empty && points.every(seen)) return;
    const { min, max } = this.model.box, room = empty ? 1 : 0;
    const ends = (k, end) => (empty ? [] : [end === Math.min ? min[k] : max[k]]).concat(points.map((p) => p.getComponent(k) + (end === Math.min ? -room : room)));
    this.control.fit({ min: [0, 1, 2].map((k) => Math.min(...ends(k, Math.min))), max: [0, 1, 2].map((k) => Math.max(...ends(k, Math.max))) });
  }
  #handleShapes(handle, at) {
    const p = at(this.#fromModel(handle.at));
    if (p.behind) return [];
    const held = this.grip?.name === handle.name, words = handle.gizmo ? handle.words : held ? `${handle.name}  ${handle.at.map((x) => length(x)).join("  ")}` : handle.name, w = 14 + 7.2 * words.length;
    const circle = svg("circle", { cx: p.x, cy: p.y, r: held ? 10 : 8, class: handle.gizmo ? "point gizmo" : "point", "data-handle": handle.name });
    circle.addEventListener("pointerdown", (event) => this.#dragHandle(event, handle));
    return [svg("rect", { x: p.x - w / 2, y: p.y - 38, width: w, height: 22, rx: 7, class: "label" }), svg("text", { x: p.x, y: p.y - 27 }, words), circle];
  }
  // Returns the ray through a point of the picture, in the model's coordinates. The ray of a parallel view begins in
  // front of all objects.
  #worldRay(x, y) {
    const ray = rayAt(this.stage, x, y), back = this.stage.camera.isOrthographicCamera ? 4 * this.stage.radius : 0;
    return { origin: ray.origin.toArray().map((v, k) => v - back * ray.direction.getComponent(k) + this.model.middle[k]), direction: ray.direction.toArray() };
  }
  #fromModel(xyz) { return new THREE.Vector3(...xyz).sub(new THREE.Vector3(...this.model.middle)); }

  // Sends the rays under the mouse to the program's gizmos, which follow them within their own constraints.
  #dragGizmo(event, handle) {
    const r = this.canvas.getBoundingClientRect(), send = (kind) => (e) => handle.ray(kind, this.#worldRay(e.clientX - r.left, e.clientY - r.top)), move = send("drag");
    send("press")(event);
    const up = (e) => {
      removeEventListener("pointermove", move);
      removeEventListener("pointerup", up);
      removeEventListener("pointercancel", up);
      send("release")(e);
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", up);
    addEventListener("pointercancel", up);
  }

  // Drags a point in its horizontal plane. In views from the side, drags it in the vertical plane that faces the
  // viewer. With the shift key, drags it only up and down.
  #dragHandle(event, handle) {
    event.preventDefault();
    event.stopPropagation();
    this.touched = true;
    if (handle.gizmo) return this.#dragGizmo(event, handle);
    const r = this.canvas.getBoundingClientRect(), start = this.#fromModel(handle.at), seen = this.control.direction(), round = roundStep(this.model.diagonal / 400);
    const offset = toScreen(this.stage, start), grab = { x: event.clientX - r.left - offset.x, y: event.clientY - r.top - offset.y };
    this.grip = { name: handle.name, at: handle.at };
    const upright = new THREE.Vector3(seen.x, seen.y, 0).normalize();
    const move = (e) => {
      const level = !e.shiftKey && Math.abs(seen.z) > 0.2, plane = new THREE.Plane().setFromNormalAndCoplanarPoint(level ? AXES.z : upright, start), hit = new THREE.Vector3();
      if (!rayAt(this.stage, e.clientX - r.left - grab.x, e.clientY - r.top - grab.y).intersectPlane(plane, hit) || hit.distanceTo(start) > 50 * this.model.diagonal) return;
      const xyz = hit.toArray().map((x, k) => x + this.model.middle[k]), kept = e.shiftKey ? [0, 1] : level ? [2] : [];
      const now = xyz.map((x, k) => kept.includes(k) ? handle.at[k] : Number((Math.round(x / round) * round).toPrecision(9)));
      if (now.join() === this.grip.at.join()) return;
      this.grip.at = now;
      this.setHandles(this.handles);
      handle.drag(now, true);
    };
    const up = () => {
      removeEventListener("pointermove", move);
      removeEventListener("pointerup", up);
      removeEventListener("pointercancel", up);
      if (this.grip.at !== handle.at) handle.drag(this.grip.at, false);
      this.grip = null;
      this.#drawOverlay();
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", up);
    addEventListener("pointercancel", up);
  }

  #sectionShapes(at) {
    const k = "xyz".indexOf(this.section.axis), b = this.model.box, place = b.min[k] + this.section.at * (b.max[k] - b.min[k]), i = (k + 1) % 3, j = (k + 2) % 3, pad = 0.03 * this.model.diagonal;
    const corner = (s, t) => { const p = [0, 0, 0]; p[k] = place; p[i] = s ? b.max[i] + pad : b.min[i] - pad; p[j] = t ? b.max[j] + pad : b.min[j] - pad; return new THREE.Vector3(...p); };
    const corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)].map(at);
    if (corners.some((c) => c.behind)) return [];
    const centre = corner(1, 1).add(corner(1, 0)).multiplyScalar(0.5), p = at(centre);
    const handle = svg("circle", { cx: p.x, cy: p.y, r: 10, class: "handle", "data-handle": "section" });
    handle.addEventListener("pointerdown", (event) => this.#dragSection(event, handle, centre, k));
    return [svg("polygon", { points: corners.map((c) => `${c.x},${c.y}`).join(" "), class: "frame" }), handle];
  }

  #dragSection(event, handle, centre, k) {
    event.preventDefault();
    this.touched = true;
    const axis = new THREE.Vector3().setComponent(k, 1), size = this.model.box.max[k] - this.model.box.min[k];
    const a = toScreen(this.stage, centre), b = toScreen(this.stage, centre.clone().addScaledVector(axis, size * 0.1)), dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy || 1;
    const from = { x: event.clientX, y: event.clientY, at: this.section.at };
    const move = (e) => this.setSection({ ...this.section, at: Math.min(1, Math.max(0, from.at + 0.1 * ((e.clientX - from.x) * dx + (e.clientY - from.y) * dy) / square)) });
    const up = () => { removeEventListener("pointermove", move); removeEventListener("pointerup", up); };
    addEventListener("pointermove", move);
    addEventListener("pointerup", up);
  }
}
