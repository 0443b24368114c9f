// Owns the controls of parameters: sliders, boxes, choices, check marks, each with a way back to what the source says.
import { el } from "./dom.js";

// A step of 1, 2 or 5 times a power of ten that parts a range into some hundreds: what a slider gives is a number that one would write.
function roundStep(span) {
  const power = 10 ** Math.floor(Math.log10(span / 200 || 1)), least = span / 200 / power;
  return Number((power * (least <= 1 ? 1 : least <= 2 ? 2 : least <= 5 ? 5 : 10)).toPrecision(1));
}

export class Parameters {
  // set(name, value) hands a value on, as the language writes it; write() puts all that were changed into the source.
  constructor(set, write) {
    this.set = set;
    this.rows = new Map();
    this.list = el("div");
    this.writeButton = el("button", { type: "button", class: "button", disabled: true, onclick: write }, "Write to source");
    this.root = el("details", { class: "parameters glass", open: innerWidth > 720, hidden: true }, el("summary", {}, "Parameters"), this.list,
      el("div", { class: "write" }, this.writeButton, el("button", { type: "button", class: "button", onclick: () => this.#save() }, "Save values"), el("button", { type: "button", class: "button", onclick: () => this.#load() }, "Load")));
  }

  changed() { return this.infos.filter((p) => p.value !== p.default); }

  show(infos) {
    this.infos = infos;
    this.root.hidden = infos.length === 0;
    const shape = JSON.stringify(infos.map((p) => [p.name, p.label, p.group, p.type, p.min, p.max, p.step, p.choices]));
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
    }
    for (const p of infos) {
      const row = this.rows.get(p.name);
      row.info = p;
      row.root.classList.toggle("changed", p.value !== p.default);
      if (!row.root.contains(document.activeElement) || document.activeElement.type === "button") row.put(p.value);
      else if (row.sent === p.value) row.put(p.value);
    }
    this.writeButton.disabled = this.changed().length === 0;
  }

  #row(p) {
    const row = { info: p }, id = "parameter-" + p.name, send = (value) => { row.sent = String(value); this.set(p.name, String(value)); };
    const reset = el("button", { type: "button", class: "reset", title: "Back to " + p.default, "aria-label": `Reset ${p.label} to ${p.default}`, onclick: () => { row.put(row.info.default); send(row.info.default); } }, "↺");
    const label = el("label", { for: id, title: p.name }, p.label);
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
      const number = el("input", { type: "number", id, min: p.min, max: p.max, step: p.step || "any" });
      const range = el("input", { type: "range", min: p.min, max: p.max, step: p.step || roundStep(p.max - p.min), "aria-label": p.label, "data-parameter": p.name });
      const exact = (x) => p.type === "integer" ? String(Math.round(x)) : String(Number(Number(x).toPrecision(6)));
      range.addEventListener("input", () => { number.value = exact(range.value); send(exact(range.value)); });
      number.addEventListener("change", () => { if (number.value !== "" && Number.isFinite(Number(number.value))) { range.value = number.value; send(exact(number.value)); } });
      row.put = (v) => { const x = v.includes("/") ? v.split("/").reduce((a, b) => a / b) : Number(v); number.value = range.value = x; };
      controls = [label, number, reset, range];
    } else {
      const text = el("input", { type: "text", id, onchange: () => send(text.value) });
      row.put = (v) => { text.value = v; };
      controls = [label, text, reset];
    }
    row.root = el("div", { class: "parameter" }, controls);
    row.put(p.value);
    this.rows.set(p.name, row);
    return row.root;
  }

  #save() {
    const values = Object.fromEntries(this.infos.map((p) => [p.name, p.value])), url = URL.createObjectURL(new Blob([JSON.stringify(values, null, 2) + "\n"], { type: "application/json" }));
    el("a", { href: url, download: "values.json" }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10000);
  }
  #load() {
    const input = el("input", { type: "file", accept: ".json,application/json" });
    input.addEventListener("change", async () => {
      try {
        const values = JSON.parse(await input.files[0].text());
        for (const p of this.infos) if (typeof values[p.name] === "string") this.set(p.name, values[p.name]);
      } catch (error) {
        alert("These values cannot be read: " + error.message);
      }
    });
    input.click();
  }
}
