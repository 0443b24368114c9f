// Compares sets of parameter values: shows a picture for each set, with one camera for all.
import * as THREE from "three";
import { Stage } from "../stage.js";
import { CameraControl } from "../camera.js";
import { togetherBox } from "../model.js";
import { pick } from "../pick.js";
import { el } from "../dom.js";

const MOST = 8; // Greatest number of pictures, because a browser keeps only some sixteen WebGL contexts at a time.

export class Compare {
  // scene(values) returns a promise of the model with these values of parameters.
  constructor(viewer, scene) {
    this.viewer = viewer;
    this.scene = scene;
    this.panes = [];
    this.grid = el("div", { class: "panes" });
    new ResizeObserver(() => { if (!this.root.hidden) this.#columns(); }).observe(this.grid);
    this.root = el("section", { class: "compare", "aria-label": "Sets side by side", hidden: true, tabindex: "-1" },
      el("header", {}, el("b", {}, "Side by side"), el("span", {}, "One camera for all: turn any of them."),
        el("button", { type: "button", class: "button", onclick: () => this.close() }, "Close")), this.grid);
    this.root.addEventListener("keydown", (event) => { if (event.key === "Escape") this.close(), event.stopPropagation(); });
  }

  // Shows a picture for each set: [{ name, values, said }]. The current model precedes them. use(name) applies a set.
  open(sets, use) {
    this.close();
    this.use = use;
    this.root.hidden = false;
    this.grid.replaceChildren();
    for (const set of [{ name: "As it is now", values: null, said: "" }, ...sets.slice(0, MOST - 1)]) this.#pane(set);
    this.#columns();
    this.#follow(this.viewer.control, this.viewer.model);
    this.touched = false;
    this.root.focus();
    this.renew();
  }

  // Sets the number of columns for which pictures of four to three are largest.
  #columns() {
    const n = this.panes.length, { clientWidth: w, clientHeight: h } = this.grid;
    let best = 1, most = 0;
    for (let columns = 1; columns <= n; columns++) {
      const size = Math.min(w / columns / 4, h / Math.ceil(n / columns) / 3);
      if (size > 1.02 * most) most = size, best = columns;
    }
    this.grid.style.setProperty("--columns", String(best));
  }

  close() {
    if (this.root.hidden) return;
    this.root.hidden = true;
    for (const pane of this.panes) {
      pane.watcher.disconnect();
      pane.stage.dispose();
    }
    this.panes = [];
    this.viewer.canvas.focus();
  }

  #pane(set) {
    const canvas = el("canvas", { tabindex: "0", role: "img", "aria-label": set.name });
    const said = el("p", {}, set.said), use = set.values ? el("button", { type: "button", class: "button", onclick: () => { this.close(); this.use(set.name); } }, "Use") : null;
    const root = el("figure", { class: "vs" }, canvas, el("figcaption", { class: "glass" }, el("div", {}, el("b", {}, set.name), said), use));
    this.grid.append(root);
    const stage = new Stage(canvas), control = new CameraControl(stage), pane = { set, root, canvas, stage, control, said };
    Object.assign(stage.options, this.viewer.stage.options);
    control.depthAt = (x, y) => stage.model ? pick(stage, x, y)?.point || null : null;
    for (const name of ["pointerdown", "wheel", "keydown"]) canvas.addEventListener(name, () => { this.touched = true; }, { passive: true });
    control.changed = () => { if (!this.following && stage.model) this.#follow(control, stage.model, pane); };
    pane.watcher = new ResizeObserver(() => {
      stage.resize();
      if (stage.model) control.apply();
    });
    pane.watcher.observe(canvas);
    this.panes.push(pane);
  }

  // Makes all cameras follow the camera `leader`. Positions are relative to the middle of each model.
  #follow(leader, model, but) {
    this.following = true;
    const world = leader.state.target.clone().add(new THREE.Vector3(...model.middle));
    this.last = { ...leader.state, target: world };
    for (const pane of this.panes) if (pane !== but) this.#look(pane);
    this.following = false;
  }
  #look(pane) {
    if (!pane.stage.model) return;
    Object.assign(pane.control.state, this.last, { target: this.last.target.clone().sub(new THREE.Vector3(...pane.stage.model.middle)) });
    pane.control.motion = null;
    pane.control.apply();
  }

  #show(pane, model) {
    pane.stage.resize();
    pane.stage.setModel(model);
    this.following = true;
    this.#look(pane);
    this.following = false;
  }

  // Makes all pictures again, one after the other. If another request comes meanwhile, begins again.
  async renew() {
    if (this.root.hidden) return;
    this.wanted = true;
    if (this.working) return;
    this.working = true;
    while (this.wanted && !this.root.hidden) {
      this.wanted = false;
      for (const pane of [...this.panes]) {
        if (!this.panes.includes(pane) || this.wanted) break;
        if (!pane.set.values) {
          this.viewer.model.kept = true;
          this.#show(pane, this.viewer.model);
          continue;
        }
        pane.root.setAttribute("aria-busy", "true");
        try {
          const model = await this.scene(pane.set.values);
          if (this.panes.includes(pane)) this.#show(pane, model), pane.said.textContent = pane.set.said, pane.root.classList.remove("bad");
        } catch (error) {
          pane.said.textContent = error.message;
          pane.root.classList.add("bad");
        }
        pane.root.removeAttribute("aria-busy");
      }
    }
    this.working = false;
    if (!this.touched && !this.root.hidden) this.#frame();
  }

  // Makes the cameras show the box of all models, from the current direction.
  #frame() {
    const shown = this.panes.filter((p) => p.stage.model?.count > 0);
    if (shown.length === 0) return;
    const [{ control, stage }] = shown, box = togetherBox(shown.map((p) => p.stage.model), stage.model.middle);
    Object.assign(control.state, control.framed(control.state, box));
    control.apply();
  }
}
