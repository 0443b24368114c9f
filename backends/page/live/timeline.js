// Contains the timeline: the making of a drawing, object by object and operation by operation, forwards and back.
//
// Its model is another than that of the view, because it contains the operands of each operation beside the result. A
// part appears in one step, and may be used up by an operation in a later step.
import * as THREE from "three";
import { el, icon } from "../dom.js";

const WORDS = { unite: "unite", subtract: "subtract", intersect: "intersect", transform: "move or turn", "with-material": "paint", layer: "layer" };
const GHOST = 0xd0342c, MADE = 0x1f6fd0;

export class Construction {
  constructor(model) {
    this.model = model;
    const n = model.count, paths = model.pathCount, parent = model.pathParent, last = new Int32Array(paths).fill(-1);
    for (let i = 0; i < n; i++) last[model.path[i]] = Math.max(last[model.path[i]], i);
    // Parents have lower numbers than their children.
    for (let p = paths - 1; p > 0; p--) last[parent[p]] = Math.max(last[parent[p]], last[p]);
    const role = (p) => model.roles.get(p)?.role || "", isCut = (p) => !!model.roles.get(p)?.cut;
    // For each path: the operation that uses up its parts, whether this operation subtracts them, and whether any
    // operation above subtracts them.
    const user = new Int32Array(paths), cut = new Uint8Array(paths), cutAbove = new Uint8Array(paths), met = new Uint8Array(paths), kind = (p) => model.kinds[model.pathKind[p]];
    for (let p = 1; p < paths; p++) {
      const q = parent[p];
      // q is the operation. Its result is used up by the same operation as q itself.
      if (role(p) === "result") user[p] = user[q], cut[p] = cut[q];
      else user[p] = role(q) === "operation" ? q : user[q], cut[p] = isCut(p) || (role(q) === "operation" ? 0 : cut[q]) ? 1 : 0;
      cutAbove[p] = isCut(p) || cutAbove[q] ? 1 : 0;
      met[p] = met[q] || (role(q) === "operation" && kind(q) === "intersect") ? 1 : 0;
    }
    const ends = new Map(); // Maps the number of a part to the paths whose last part it is, the innermost first.
    for (let p = paths - 1; p > 0; p--) {
      if (last[p] < 0 || role(p) === "result") continue;
      if (!ends.has(last[p])) ends.set(last[p], []);
      ends.get(last[p]).push(p);
    }
    this.steps = []; // each step is { path } or { part }
    this.born = new Int32Array(n);
    this.cut = new Uint8Array(n);
    this.ghost = new Uint8Array(n); // 1 if the part can appear as the ghost of a subtracted part.
    const done = new Int32Array(paths).fill(-1), uses = new Int32Array(n);
    for (let i = 0; i < n; i++) {
      const p = model.path[i], result = role(p) === "result";
      if (result) {
        if (done[parent[p]] < 0) done[parent[p]] = this.steps.push({ path: parent[p] }) - 1;
        this.born[i] = done[parent[p]];
        uses[i] = user[p], this.cut[i] = cut[p];
      } else {
        const before = this.steps[this.steps.length - 1]; // Several parts of a shape with several paints are one step.
        if (i > 0 && before?.part !== undefined && model.made[i] > 0 && model.made[i] === model.made[i - 1] && p === model.path[i - 1] && model.geometry[i] !== model.geometry[i - 1] && model.paint[i] !== model.paint[i - 1]) before.more = (before.more || 0) + 1;
        else this.steps.push({ part: i });
        this.born[i] = this.steps.length - 1;
        const direct = role(p) === "operation";
        uses[i] = direct ? p : user[p];
        this.cut[i] = model.cuts.has(i) || (!direct && cut[p]) ? 1 : 0;
        this.ghost[i] = model.cuts.has(i) || cutAbove[p] || met[p] || (direct && kind(p) === "intersect") ? 1 : 0;
      }
      for (const q of ends.get(i) || []) {
        // The operation has no result.
        if (role(q) === "operation") done[q] < 0 && (done[q] = this.steps.push({ path: q }) - 1);
        else if (role(q) === "item" || WORDS[kind(q)]) this.steps.push({ path: q });
      }
    }
    this.gone = new Int32Array(n);
    for (let i = 0; i < n; i++) this.gone[i] = uses[i] > 0 && done[uses[i]] >= 0 ? done[uses[i]] : 0x7fffffff;
    this.last = last;
  }

  // Returns the number of the subtracted part that made a face, or -1. The surface of this part passes through `point`,
  // which is relative to the model `from`.
  cutterAt(from, point) {
    const m = this.model, at = point.map((x, k) => x + from.middle[k] - m.middle[k]), near = 2e-5 * m.diagonal;
    let best = -1, least = near;
    for (let i = 0; i < m.count; i++) {
      if (!this.ghost[i] || m.roles.get(m.path[i])?.role === "result") continue;
      const d = [0, 1, 2].map((k) => at[k] - m.ball[4 * i + k]);
      if (Math.hypot(...d) > m.ball[4 * i + 3] + near) continue;
      const off = surfaceDistance(m, i, at);
      if (off < least) least = off, best = i;
    }
    return best;
  }

  // Returns a function that tests whether a part exists after step k and is shown. cutting(k) returns the parts that
  // exist but will be subtracted.
  shown(k) { return (i) => this.born[i] <= k && k < this.gone[i] && !this.cut[i]; }
  cutting(k) {
    const found = [];
    for (let i = 0; i < this.model.count; i++) if (this.cut[i] && this.born[i] <= k && k < this.gone[i]) found.push(i);
    return found;
  }
  // Returns the parts that step k made or changed, if they are shown after it.
  made(k) {
    const step = this.steps[k], found = [];
    if (step.part !== undefined) {
      for (let i = step.part; i <= step.part + (step.more || 0); i++) found.push(i);
      return found;
    }
    for (let i = this.last[step.path]; i >= 0; i--) {
      let p = this.model.path[i];
      while (p > step.path) p = this.model.pathParent[p];
      if (p !== step.path) break;
      if (this.born[i] <= k && k < this.gone[i]) found.push(i);
    }
    return found;
  }
  origin(k) {
    const step = this.steps[k], m = this.model;
    return step.part !== undefined ? m.made[step.part] : m.pathOrigin[step.path] || (m.roles.get(step.path)?.role === "item" ? m.made[this.last[step.path]] : 0);
  }
  say(k) {
    const step = this.steps[k], m = this.model, o = this.origin(k), role = m.roles.get(step.path);
    const what = step.part !== undefined ? m.kinds[m.kind[step.part]] || "part" : role?.role === "item" ? "drawn: thing " + role.item : WORDS[m.kinds[m.pathKind[step.path]]] || m.kinds[m.pathKind[step.path]];
    return what + (o > 0 && role?.role !== "item" ? " · line " + m.origin(o).line : "");
  }
}

// Returns the distance of a point from the triangles of part i.
function surfaceDistance(model, i, at) {
  const g = model.geometries[model.geometry[i]], m = model.matrix.subarray(12 * i, 12 * i + 12), P = g.position, I = g.index, triangle = new THREE.Triangle(), p = new THREE.Vector3(...at), foot = new THREE.Vector3();
  if (g.lines) return Infinity;
  const corner = (to, k) => to.set(m[0] * P[k] + m[1] * P[k + 1] + m[2] * P[k + 2] + m[3], m[4] * P[k] + m[5] * P[k + 1] + m[6] * P[k + 2] + m[7], m[8] * P[k] + m[9] * P[k + 1] + m[10] * P[k + 2] + m[11]);
  let least = Infinity;
  for (let t = 0; t < I.length; t += 3) {
    corner(triangle.a, 3 * I[t]), corner(triangle.b, 3 * I[t + 1]), corner(triangle.c, 3 * I[t + 2]);
    least = Math.min(least, triangle.closestPointToPoint(p, foot).distanceTo(p));
  }
  return least;
}

export class Timeline {
  // construction() returns a promise of the Construction of the current drawing. mark(chain) marks places of the
  // source. back() shows the view's model again.
  constructor(viewer, { construction, mark, back }) {
    this.viewer = viewer;
    this.construction = construction;
    this.mark = mark;
    this.back = back;
    const button = (label, text, action) => el("button", { type: "button", "aria-label": label, title: label, onclick: action }, text);
    this.range = el("input", { type: "range", min: "0", value: "0", step: "1", "aria-label": "Step of the construction", oninput: () => this.go(Number(this.range.value)) });
    this.output = el("output", { class: "words" });
    this.playButton = button("Play", icon("play"), () => this.play(!this.playing));
    this.root = el("div", { class: "strip glass timeline", role: "group", "aria-label": "Construction", hidden: true },
      el("div", {}, button("A step back (,)", icon("back"), () => this.go(this.k - 1)), this.playButton, button("A step on (.)", icon("on"), () => this.go(this.k + 1)), this.range,
        button("Close the construction", icon("close"), () => this.close())), this.output);
    viewer.root.append(this.root);
    this.button = viewer.addButton("steps", "How it is made", "B", () => this.isOpen ? this.close() : this.open(), { "aria-pressed": "false" });
    viewer.addKeys({ ",": () => this.isOpen && this.go(this.k - 1), ".": () => this.isOpen && this.go(this.k + 1) });
  }
  get isOpen() { return !this.root.hidden; }

  async open() {
    this.root.hidden = false;
    this.button.setAttribute("aria-pressed", "true");
    this.viewer.setSectionStrip(false);
    this.output.textContent = "working it out …";
    this.made = null;
    await this.renew();
  }
  async renew() {
    try {
      const made = await this.construction();
      if (!this.isOpen) return;
      const n = made.steps.length, atEnd = !this.made || this.k >= this.made.steps.length - 1;
      this.made = made;
      this.range.max = String(Math.max(0, n - 1));
      this.viewer.filter = made.shown(n - 1);
      this.viewer.show(made.model, true, { aside: true });
      this.go(atEnd ? n - 1 : this.k);
    } catch (error) {
      this.output.textContent = error.message;
    }
  }
  close() {
    this.play(false);
    this.root.hidden = true;
    this.button.setAttribute("aria-pressed", "false");
    this.made = null;
    this.viewer.filter = null;
    this.viewer.setGhosts([]);
    if (this.viewer.section) this.viewer.setSectionStrip(true);
    this.back();
  }

  go(k) {
    if (!this.made || this.made.steps.length === 0) return;
    this.k = Math.min(this.made.steps.length - 1, Math.max(0, k));
    this.range.value = String(this.k);
    this.output.textContent = `${this.k + 1} of ${this.made.steps.length} · ${this.made.say(this.k)}`;
    this.range.setAttribute("aria-valuetext", this.output.textContent);
    const m = this.made.model;
    this.viewer.filter = this.made.shown(this.k);
    this.viewer.refresh();
    const now = this.made.made(this.k), atEnd = this.k === this.made.steps.length - 1;
    this.viewer.setGhosts([{ parts: this.made.cutting(this.k), color: GHOST, opacity: 0.3 }, { parts: atEnd ? [] : now.filter((i) => !this.made.cut[i]), color: MADE, opacity: 0.3 }]);
    const chain = [];
    for (let o = this.made.origin(this.k); o > 0; o = m.origins.at[4 * (o - 1) + 3]) chain.push(m.origin(o));
    this.mark(chain);
  }

  play(on) {
    this.playing = on;
    clearInterval(this.timer);
    this.playButton.setAttribute("aria-pressed", String(on));
    if (!on || !this.made) return;
    if (this.k >= this.made.steps.length - 1) this.go(0);
    const pace = Math.max(1, Math.ceil(this.made.steps.length / 240)); // The playback takes at most a minute.
    this.timer = setInterval(() => {
      if (this.k >= this.made.steps.length - 1) return this.play(false);
      this.go(this.k + pace);
    }, 250);
  }
}
