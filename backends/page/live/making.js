// Contains the panel of pictures: a render by POV-Ray, contact sheets, turntables, each with its progress and a cancel
// button. It lists the pictures that were made up to now.
import * as THREE from "three";
import { Stage } from "../stage.js";
import { CameraControl } from "../camera.js";
import { Film } from "./film.js";
import { togetherBox } from "../model.js";
import { el } from "../dom.js";

const SIZES = [["640", "small"], ["1280", "medium"], ["1920", "large"]], TILE = 420;

export class Making {
  // make(format, values, options) returns a promise of bytes, and scene(values) a promise of a model. parameters() and
  // values() return the current parameters and values.
  constructor(viewer, { make, scene, parameters, values }) {
    Object.assign(this, { viewer, make, scene, parameters, values });
    this.made = [];
    const select = (label, options, chosen) => el("select", { "aria-label": label }, options.map(([value, text]) => el("option", { value, selected: value === chosen }, text)));
    const number = (label, value, more = {}) => el("input", { type: "number", value, "aria-label": label, step: "any", ...more });
    const button = (text, action) => el("button", { type: "button", class: "button", onclick: action }, text);
    this.size = select("Size of the picture", SIZES, "1280");
    this.quality = select("Quality of the picture", [["draft", "draft"], ["good", "good"], ["final", "final"]], "good");
    this.swept = el("select", { "aria-label": "Parameter that is swept", onchange: () => this.#range() });
    this.from = number("From");
    this.to = number("To");
    this.count = number("How many pictures", 9, { min: 2, max: 36, step: 1 });
    this.seconds = number("Seconds of the film", 4, { min: 1, max: 60, step: 1 });
    this.bar = el("progress", { max: "1", hidden: true });
    this.said = el("p", { class: "said", role: "status" });
    this.cancelButton = el("button", { type: "button", class: "button", hidden: true, onclick: () => this.cancel?.abort() }, "Cancel");
    this.starters = [button("Render", () => this.render()), button("Make a sheet", () => this.sheet()), button("Make a film", () => this.film())];
    this.sweep = el("div", {}, el("h3", {}, "Contact sheet of a parameter"), el("div", { class: "line" }, this.swept), el("div", { class: "line" }, this.from, el("span", {}, "to"), this.to), el("div", { class: "line" }, this.count, el("span", {}, "pictures"), this.starters[1]));
    this.list = el("div", { class: "made-list" });
    this.root = el("section", { class: "making glass", "aria-label": "Pictures", hidden: true, tabindex: "-1" },
      el("header", {}, el("b", {}, "Pictures"), button("Close", () => this.toggle())),
      el("h3", {}, "Render, as it is seen here"), el("div", { class: "line" }, this.size, this.quality, this.starters[0]),
      this.sweep,
      el("h3", {}, "Turntable"), el("div", { class: "line" }, this.seconds, el("span", {}, "seconds"), this.starters[2]),
      el("div", { class: "line" }, this.bar, this.cancelButton), this.said,
      el("h3", {}, "Made so far"), this.list);
    this.list.append(el("p", { class: "empty" }, "Nothing yet."));
    this.large = el("div", { class: "large", role: "dialog", "aria-label": "Picture", hidden: true, tabindex: "-1" });
    for (const root of [this.root, this.large]) root.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      event.stopPropagation();
      if (root === this.large) this.#show(null);
      else this.toggle();
    });
    this.button = el("button", { type: "button", class: "button pictures", "aria-expanded": "false", onclick: () => this.toggle() }, "Pictures");
    if (typeof VideoEncoder === "undefined") this.starters[2].disabled = true, this.starters[2].title = "This browser makes no films.";
  }

  toggle() {
    this.root.hidden = !this.root.hidden;
    this.button.setAttribute("aria-expanded", String(!this.root.hidden));
    if (this.root.hidden) return this.button.focus();
    this.#parameters();
    this.root.focus();
  }

  #parameters() {
    const ranged = this.parameters().filter((p) => p.min !== undefined || p.choices || p.type === "boolean"), was = this.swept.value;
    this.sweep.hidden = ranged.length === 0;
    this.swept.replaceChildren(...ranged.map((p) => el("option", { value: p.name, selected: p.name === was }, p.label)));
    this.#range();
  }
  #range() {
    const p = this.parameters().find((q) => q.name === this.swept.value), few = !p || p.min === undefined;
    for (const box of [this.from, this.to, this.count]) box.disabled = few;
    if (few) return;
    this.from.value = p.min;
    this.to.value = p.max;
  }

  // ---- a single job at a time, with its progress ----

  async #run(name, work) {
    if (this.cancel) return;
    const cancel = this.cancel = new AbortController(), began = performance.now();
    for (const b of this.starters) b.disabled = true;
    this.bar.hidden = this.cancelButton.hidden = false;
    this.bar.removeAttribute("value");
    this.#say(name + " …");
    try {
      const told = (fraction, text) => {
        if (cancel.signal.aborted) throw new Error("cancelled");
        if (fraction >= 0) this.bar.value = fraction;
        else this.bar.removeAttribute("value");
        this.#say(`${name}: ${text}${fraction >= 0 ? ` ${Math.floor(100 * fraction)} %` : " …"}`);
      };
      const made = await work(told, cancel.signal);
      if (cancel.signal.aborted) throw new Error("cancelled");
      this.#add(made);
      this.#say(`${made.name} is made, in ${((performance.now() - began) / 1000).toFixed(1)} s.`);
    } catch (error) {
      this.#say(cancel.signal.aborted ? name + " is cancelled." : `${name}: ${error.message}`);
    }
    this.cancel = null;
    this.bar.hidden = this.cancelButton.hidden = true;
    for (const b of this.starters) b.disabled = b === this.starters[2] && typeof VideoEncoder === "undefined";
  }
  #say(text) { this.said.textContent = text; }
  #name(kind, ending) { return `${this.viewer.model.title}-${kind}-${this.made.length + 1}.${ending}`; }

  // Returns the view's camera in POV-Ray's terms: eye, target, focal length in millimetres. A parallel view becomes a
  // view from far away.
  #camera(aspect) {
    const c = this.viewer.control, s = c.state, middle = new THREE.Vector3(...this.viewer.model.middle), far = s.parallel ? 25 : 1;
    const eye = s.target.clone().addScaledVector(c.direction(), far * s.distance).add(middle), target = s.target.clone().add(middle);
    return [...eye.toArray(), ...target.toArray(), 18 * far / (Math.tan(s.angle / 2) * aspect)].map((x) => Number(x.toPrecision(9))).join(" ");
  }

  render() {
    return this.#run("The picture", async (told, signal) => {
      const width = Number(this.size.value), { clientWidth, clientHeight } = this.viewer.canvas, height = Math.round(width * clientHeight / clientWidth / 2) * 2;
      const bytes = await this.make("png", this.values(), { size: `${width}x${height} ${this.quality.value} ${this.#camera(width / height)}`, signal,
        told: (phase, fraction) => { if (!signal.aborted) told(phase === "rendering" ? fraction : -1, phase); } });
      return { name: this.#name("picture", "png"), blob: new Blob([bytes], { type: "image/png" }), alt: `${this.quality.value}, ${width} by ${height}` };
    });
  }

  // Makes an invisible stage of a size in pixels, and passes it to work().
  async #studio(width, height, work) {
    const canvas = el("canvas", { style: `position:fixed;left:-10000px;top:0;width:${width}px;height:${height}px`, "aria-hidden": "true" });
    document.body.append(canvas);
    const stage = new Stage(canvas), control = new CameraControl(stage);
    stage.renderer.setPixelRatio(1);
    stage.wake = () => {};
    stage.resize();
    Object.assign(stage.options, this.viewer.stage.options);
    try {
      return await work(stage, control, canvas);
    } finally {
      stage.dispose();
      canvas.remove();
    }
  }
  // Sets the camera of a stage to that of the view. Positions are relative to the middle of the stage's model.
  #look(stage, control, more = {}) {
    const s = this.viewer.control.state, off = this.viewer.model.middle.map((x, k) => x - stage.model.middle[k]);
    Object.assign(control.state, s, { target: s.target.clone().add(new THREE.Vector3(...off)) }, more);
    control.apply();
  }

  sheet() {
    const p = this.parameters().find((q) => q.name === this.swept.value), n = Math.min(36, Math.max(2, Math.round(Number(this.count.value)) || 2));
    if (!p) return;
    const from = Number(this.from.value), to = Number(this.to.value), exact = (x) => p.type === "integer" ? String(Math.round(x)) : String(Number(x.toPrecision(6)));
    const all = p.choices || (p.type === "boolean" ? ["#f", "#t"] : Array.from({ length: n }, (_, i) => exact(from + (to - from) * i / (n - 1)))), values = [...new Set(all)];
    return this.#run("The contact sheet", async (told, signal) => {
      const tall = TILE * 3 / 4, caption = 30, gap = 10, columns = Math.ceil(Math.sqrt(values.length)), rows = Math.ceil(values.length / columns), models = [], failed = [];
      for (let i = 0; i < values.length; i++) {
        told(0.6 * i / values.length, `model ${i + 1} of ${values.length},`);
        try {
          models.push(await this.scene({ ...this.values(), [p.name]: values[i] }, { signal }));
        } catch (error) {
          if (signal.aborted) throw error;
          failed.push(error.message);
          models.push(error.message);
        }
      }
      const sheet = el("canvas", { width: columns * (TILE + gap) + gap, height: rows * (tall + caption + gap) + gap }), g = sheet.getContext("2d");
      const put = (text, x, y, bold) => { g.font = `${bold ? "600 17" : "14"}px system-ui, "DejaVu Sans", sans-serif`; g.fillText(text, x, y, TILE - 12); };
      g.fillStyle = "#fff";
      g.fillRect(0, 0, sheet.width, sheet.height);
      g.fillStyle = "#1f2a36";
      g.textAlign = "center";
      await this.#studio(TILE, tall, async (stage, control, canvas) => {
        for (let i = 0; i < values.length; i++) {
          told(0.6 + 0.4 * i / values.length, `picture ${i + 1} of ${values.length},`);
          const x = gap + (i % columns) * (TILE + gap), y = gap + Math.floor(i / columns) * (tall + caption + gap);
          put(`${p.label} ${values[i]}`, x + TILE / 2, y + tall + 21, true);
          if (typeof models[i] === "string") {
            put(models[i], x + TILE / 2, y + tall / 2);
            continue;
          }
          stage.setModel(models[i]);
          this.#look(stage, control);
          if (!this.viewer.touched) Object.assign(control.state, control.framed(control.state, togetherBox(models.filter((m) => m.count > 0), models[i].middle))), control.apply();
          stage.paint();
          g.drawImage(canvas, x, y, TILE, tall);
          await new Promise((go) => setTimeout(go, 0));
        }
      });
      if (failed.length === values.length) throw new Error(failed[0]);
      const blob = await new Promise((go) => sheet.toBlob(go, "image/png"));
      return { name: this.#name("sheet", "png"), blob, alt: `${p.label} from ${values[0]} to ${values[values.length - 1]}, ${values.length} pictures` };
    });
  }

  film() {
    return this.#run("The film", async (told) => {
      const rate = 24, frames = Math.round(rate * Math.min(60, Math.max(1, Number(this.seconds.value) || 4))), { clientWidth, clientHeight } = this.viewer.canvas;
      const width = 2 * Math.round(Math.min(1280, Math.max(480, clientWidth)) / 2), height = 2 * Math.round(width * clientHeight / clientWidth / 2), model = this.viewer.model;
      model.kept = true;
      const blob = await this.#studio(width, height, async (stage, control, canvas) => {
        const film = new Film(width, height, rate), yaw = this.viewer.control.state.yaw;
        try {
          stage.setModel(model, this.viewer.shown);
          for (let i = 0; i < frames; i++) {
            told(i / frames, `${i + 1} of ${frames},`);
            this.#look(stage, control, { yaw: yaw + 2 * Math.PI * i / frames });
            stage.paint(stage.software ? 2 : 16);
            await film.add(canvas);
            await new Promise((go) => setTimeout(go, 0));
          }
          return await film.finish();
        } finally {
          film.close();
        }
      });
      return { name: this.#name("turntable", "webm"), blob, alt: `turntable, ${frames} pictures` };
    });
  }

  // ---- the results ----

  #add(made) {
    made.url = URL.createObjectURL(made.blob);
    if (this.made.length === 0) this.list.replaceChildren();
    this.made.push(made);
    const film = made.blob.type.startsWith("video"), look = film ? el("video", { src: made.url, muted: true, loop: true, autoplay: true, playsinline: true, "aria-label": made.alt }) : el("img", { src: made.url, alt: made.alt });
    look.muted = true;
    this.list.prepend(el("figure", {}, el("button", { type: "button", title: "Show it large", onclick: () => this.#show(made) }, look),
      el("figcaption", {}, el("a", { href: made.url, download: made.name, title: "Save" }, made.name), el("span", {}, made.alt))));
  }
  #show(made) {
    this.large.hidden = !made;
    if (!made) return this.root.focus();
    const film = made.blob.type.startsWith("video");
    this.large.replaceChildren(film ? el("video", { src: made.url, controls: true, loop: true, autoplay: true }) : el("img", { src: made.url, alt: made.alt }),
      el("div", { class: "line" }, el("a", { class: "button", href: made.url, download: made.name }, "Save"), el("button", { type: "button", class: "button", onclick: () => this.#show(null) }, "Close")));
    this.large.focus();
  }
}
