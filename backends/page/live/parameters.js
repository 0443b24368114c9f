// Contains the controls of parameters: sliders, boxes, choices, check marks, each with a button that restores the
// source's value.
import { el } from "../dom.js";

// Returns a step of 1, 2 or 5 times a power of ten that divides a range into some hundreds of steps, so that a slider
// gives round numbers.
function roundStep(span) {
  const power = 10 ** Math.floor(Math.log10(span / 200 || 1)), least = span / 200 / power;
  return Number((power * (least <= 1 ? 1 : least <= 2 ? 2 : least <= 5 ? 5 : 10)).toPrecision(1));
}

// Returns a value from a file or a link in the language's spelling.
const written = (value) => value === true ? "#t" : value === false ? "#f" : String(value);

// Returns true if the value of a parameter differs from that in the source; 6 and 6.0 are equal.
const differs = (p, value = p.value) => value !== p.default && !(["real", "integer"].includes(p.type) && Number(value) === Number(p.default));

// Returns the three coordinates of a point in the language's spelling, or null if the text is not a point.
export function pointOf(text) {
  const m = /^\(xyz ([^ ()]+) ([^ ()]+) ([^ ()]+)\)$/.exec(text), xyz = m && m.slice(1).map((x) => x.includes("/") ? x.split("/").reduce((a, b) => a / b) : Number(x));
  return xyz && xyz.every(Number.isFinite) ? xyz : null;
}
export const pointText = (xyz) => `(xyz ${xyz.map((x) => String(Number(x.toPrecision(9)))).join(" ")})`;

export class Parameters {
  // set(name, value) passes on a value in the language's spelling. write() writes all changed values into the source.
  // link() returns an address with the values, or a promise of it; lasting: whether it works after this view has ended.
  // compare(sets) shows sets beside each other. place() returns the model's path.
  constructor({ set, write, link, lasting, compare, place }) {
    this.set = set;
    this.compare = compare;
    this.place = place;
    this.rows = new Map();
    this.sets = new Map(); // maps the name of a set to { values, chosen }
    this.list = el("div");
    const button = (text, action, attributes) => el("button", { type: "button", class: "button", onclick: action, ...attributes }, text);
    this.writeButton = button("Write to source", write, { class: "button write-source", disabled: true, title: "Put these values into the text" });
    this.resetButton = button("Reset all", () => { for (const p of this.changed()) this.set(p.name, p.default); }, { disabled: true });
    this.setList = el("div", { class: "sets" });
    this.compareButton = button("Compare", () => this.compare(this.#chosen()), { disabled: true, title: "Show the chosen sets beside each other" });
    this.said = el("p", { class: "said", role: "status" });
    const share = button("Copy link", async () => {
      const address = await link();
      try {
        await navigator.clipboard.writeText(address);
        this.#say("The link is copied." + (lasting ? "" : " It contains this view's key: whoever has it can change the model while this view runs."));
      } catch {
        this.#say(address);
      }
    }, { title: "An address that opens this view with these values" + (lasting ? "" : ". It contains the view's key") });
    this.root = el("details", { class: "parameters glass", open: innerWidth > 1000, hidden: true }, el("summary", {}, "Parameters"), this.list,
      el("div", { class: "write" }, this.writeButton, this.resetButton),
      el("h3", { class: "apart" }, "Sets of values"), this.setList,
      el("div", { class: "write" }, button("Keep these", () => this.keep(), { title: "Keep the values as a set" }), this.compareButton, share,
        button("Save file", () => this.#save(), { title: "All sets, and the values of now, as JSON" }), button("Load file", () => this.#load())), this.said);
  }

  #say(text) {
    this.said.textContent = text;
    clearTimeout(this.saying);
    this.saying = setTimeout(() => { this.said.textContent = ""; }, 8000);
  }
  get values() { return Object.fromEntries(this.infos.map((p) => [p.name, p.value])); }

  // ---- sets ----

  // Keeps the current values as a set. Without a name, chooses an unused name.
  keep(name, values = this.values) {
    if (!name) for (let i = this.sets.size + 1; !name || this.sets.has(name); i++) name = "Set " + i;
    this.sets.set(name, { values, chosen: true });
    this.#showSets();
    return name;
  }
  use(name) {
    const { values } = this.sets.get(name);
    for (const p of this.infos) if (p.name in values && values[p.name] !== p.value) this.set(p.name, values[p.name]);
  }
  #chosen() { return [...this.sets].filter(([, s]) => s.chosen).map(([name, s]) => ({ name, values: s.values, said: this.#differences(s.values) })); }
  // Returns a text with the values of a set that differ from the source.
  #differences(values) {
    return this.infos.filter((p) => p.name in values && differs(p, values[p.name])).map((p) => `${p.label} ${values[p.name]}`).join(" · ") || "as the source says";
  }
  #remember() {
    try {
      sessionStorage.setItem("sets " + this.place(), JSON.stringify([...this.sets]));
    } catch { /* Without storage, the browser forgets the sets with the page. */ }
  }
  #recall() {
    try {
      this.sets = new Map(JSON.parse(sessionStorage.getItem("sets " + this.place()) || "[]"));
    } catch {
      this.sets = new Map();
    }
  }
  #showSets() {
    this.setList.replaceChildren(...[...this.sets].map(([name, s]) => {
      const title = this.#differences(s.values), named = el("input", { type: "text", value: name, "aria-label": "Name of the set " + name, title });
      named.addEventListener("change", () => {
        const now = named.value.trim();
        if (now && !this.sets.has(now)) this.sets = new Map([...this.sets].map(([key, value]) => [key === name ? now : key, value]));
        this.#showSets();
      });
      return el("div", { class: "set" },
        el("input", { type: "checkbox", checked: s.chosen, "aria-label": "Compare " + name, onchange: (event) => { s.chosen = event.target.checked; this.#showSets(); } }), named,
        el("button", { type: "button", class: "button", title: "Take these values: " + title, onclick: () => this.use(name) }, "Use"),
        el("button", { type: "button", class: "reset", "aria-label": "Forget the set " + name, onclick: () => { this.sets.delete(name); this.#showSets(); } }, "×"));
    }));
    this.compareButton.disabled = !this.#chosen().length;
    this.#remember();
  }

  // Returns the parameters that are points, as handles of the view: { name, at, drag(xyz) }.
  points() { return this.infos.filter((p) => this.rows.get(p.name).drag).map((p) => ({ name: p.label, at: pointOf(p.value) || [0, 0, 0], drag: this.rows.get(p.name).drag })); }

  changed() { return (this.infos || []).filter((p) => differs(p)); }

  show(infos) {
    this.infos = infos;
    this.root.hidden = infos.length === 0;
    const shape = JSON.stringify(infos.map((p) => [p.name, p.label, p.group, p.type, p.min, p.max, p.step, p.choices, p.unit]));
    if (shape !== this.shape) {
      this.shape = shape;
      this.rows.clear();
      let group = "";
      const rows = [];
      for (const p of infos) {
        if (p.group !== group) rows.push(el("h3", {}, group = p.group));
        rows.push(this.#row(p));
      }
      this.list.replaceChildren(...rows);
      if (this.sets.size === 0) this.#recall();
      this.#showSets();
    }
    for (const p of infos) {
      const row = this.rows.get(p.name);
      row.info = p;
      row.root.classList.toggle("changed", differs(p));
      if (!row.root.contains(document.activeElement) || document.activeElement.type === "button") row.put(p.value);
      else if (row.sent === p.value) row.put(p.value);
    }
    this.writeButton.disabled = this.resetButton.disabled = this.changed().length === 0;
  }

  #row(p) {
    const row = { info: p }, id = "parameter-" + p.name, send = (value, moving) => { row.sent = String(value); row.moving = !!moving; this.set(p.name, String(value), !!moving); };
    const reset = el("button", { type: "button", class: "reset", title: "Back to " + p.default, "aria-label": `Reset ${p.label} to ${p.default}`, onclick: () => { row.put(row.info.default); send(row.info.default); } }, "↺");
    const label = el("label", { for: id, title: p.name }, p.label), unit = p.unit ? el("span", { class: "unit" }, p.unit) : null;
    // The width of a box is that of its number.
    const box = (attributes) => {
      const input = el("input", attributes);
      input.put = (x) => { input.value = x, input.style.width = Math.min(22, Math.max(9, input.value.length + 3)) + "ch"; };
      return input;
    };
    let controls;
    if (p.type === "boolean") {
      const box = el("input", { type: "checkbox", id, onchange: () => send(box.checked ? "#t" : "#f") });
      row.put = (v) => { box.checked = v !== "#f"; };
      controls = [label, box, reset];
    } else if (p.choices) {
      const select = el("select", { id, onchange: () => send(select.value) }, p.choices.map((c) => el("option", { value: c }, c)));
      row.put = (v) => { select.value = v; };
      controls = [label, select, reset];
    } else if (p.min !== undefined) {
      const number = box({ type: "number", id, min: p.min, max: p.max, step: p.step || "any" });
      const range = el("input", { type: "range", min: p.min, max: p.max, step: p.step || roundStep(p.max - p.min), "aria-label": p.label, "data-parameter": p.name });
      const exact = (x) => p.type === "integer" ? String(Math.round(x)) : String(Number(Number(x).toPrecision(6)));
      range.addEventListener("input", () => { number.put(exact(range.value)); send(exact(range.value), true); });
      range.addEventListener("change", () => { if (row.moving) send(exact(range.value)); });
      number.addEventListener("change", () => { if (number.value !== "" && Number.isFinite(Number(number.value))) { range.value = number.value; send(exact(number.value)); } });
      row.put = (v) => { const x = v.includes("/") ? v.split("/").reduce((a, b) => a / b) : Number(v); range.value = x, number.put(x); };
      controls = [label, number, unit, reset, range];
    } else if (pointOf(p.default)) {
      const boxes = ["x", "y", "z"].map((axis, k) => box({ type: "number", step: "any", id: k === 0 ? id : id + "-" + axis, "aria-label": `${p.label} ${axis}`, onchange: () => {
        const xyz = boxes.map((b) => Number(b.value));
        if (boxes.every((b) => b.value !== "") && xyz.every(Number.isFinite)) send(pointText(xyz));
      } }));
      const places = el("div", { class: "xyz" }, boxes);
      row.put = (v) => {
        const texts = (pointOf(v) || [0, 0, 0]).map((x) => String(Number(x.toPrecision(9))));
        texts.forEach((text, k) => { boxes[k].value = text; });
        // Long numbers are placed below each other.
        places.classList.toggle("long", texts.some((text) => text.length > 8));
      };
      row.drag = (xyz, moving) => { const text = pointText(xyz); row.put(text); send(text, moving); };
      controls = [label, el("span", { class: "hint" }, "drag it in the view"), reset, places];
    } else {
      const text = el("input", { type: "text", id, onchange: () => send(text.value) });
      row.put = (v) => { text.value = v; };
      controls = [label, unit, reset, text];
    }
    row.root = el("div", { class: "parameter" }, controls);
    row.put(p.value);
    this.rows.set(p.name, row);
    return row.root;
  }

  #save() {
    const sets = Object.fromEntries([["now", this.values], ...[...this.sets].map(([name, s]) => [name, s.values])]);
    const url = URL.createObjectURL(new Blob([JSON.stringify(sets, null, 2) + "\n"], { type: "application/json" }));
    el("a", { href: url, download: this.place().split("/").pop().replace(/\.[^.]*$/, "") + ".json" }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10000);
  }
  // Reads a file, which contains several sets by name, or the values of a single set.
  read(text, name) {
    const found = JSON.parse(text), known = new Set(this.infos.map((p) => p.name));
    if (found === null || typeof found !== "object" || Array.isArray(found)) throw new Error("it holds no values by name");
    const sets = Object.values(found).some((v) => v !== null && typeof v === "object") ? found : { [name]: found };
    let taken = 0;
    for (const [key, values] of Object.entries(sets)) {
      if (values === null || typeof values !== "object") continue;
      const kept = Object.fromEntries(Object.entries(values).filter(([n]) => known.has(n)).map(([n, v]) => [n, written(v)]));
      if (Object.keys(kept).length === 0) continue;
      taken++;
      if (key === "now" || Object.keys(sets).length === 1) for (const p of this.infos) if (p.name in kept && kept[p.name] !== p.value) this.set(p.name, kept[p.name]);
      if (key !== "now") this.keep(key, kept);
    }
    if (taken === 0) throw new Error("none of its names is a parameter of this model");
    this.#say(`${taken === 1 ? "One set" : taken + " sets"} read.`);
  }
  #load() {
    const input = el("input", { type: "file", accept: ".json,application/json" });
    input.addEventListener("change", async () => {
      try {
        this.read(await input.files[0].text(), input.files[0].name.replace(/\.[^.]*$/, ""));
      } catch (error) {
        this.#say(`${input.files[0].name} cannot be read: ${error.message}`);
      }
    });
    input.click();
  }
}
