// Contains the panel beside the picture: layers, materials and parts, each with a switch.
import { el, icon } from "./dom.js";

const ROWS = 400; // Greatest number of rows in a list. For the others, the list shows only their number.

export class Panel {
  constructor(viewer) {
    this.viewer = viewer;
    this.tab = "layers";
    this.open = new Set();
    this.list = el("div", { class: "list", role: "tabpanel" });
    this.tabs = ["layers", "materials", "parts"].map((name) => el("button", { type: "button", role: "tab", "data-tab": name, "aria-selected": "false", onclick: () => { this.tab = name; this.refresh(); } }, name[0].toUpperCase() + name.slice(1)));
    this.root = el("section", { class: "panel glass", "aria-label": "Layers, materials and parts", hidden: true },
      el("div", { class: "tabs", role: "tablist" }, this.tabs, el("button", { type: "button", class: "close", "aria-label": "Close", onclick: () => viewer.togglePanel() }, icon("close"))), this.list);
  }

  refresh() {
    if (this.root.hidden || !this.viewer.model) return;
    for (const tab of this.tabs) tab.setAttribute("aria-selected", String(tab.dataset.tab === this.tab));
    const rows = this[this.tab]();
    const any = Object.values(this.viewer.hidden).some((set) => set.size > 0);
    if (any) rows.unshift(el("div", { class: "row" }, el("button", { type: "button", class: "name", onclick: () => this.viewer.showAll() }, "Show everything")));
    this.list.replaceChildren(...rows);
    this.mark();
  }

  mark() {
    const chosen = new Set(this.viewer.chosen);
    for (const row of this.list.querySelectorAll("[data-part]")) row.classList.toggle("chosen", chosen.has(Number(row.dataset.part)));
  }

  #row({ name, shown, switched, count, swatch, choose, depth = 0, fold, part }) {
    return el("div", { class: "row", style: depth ? `padding-left:${6 + 14 * depth}px` : null, "data-part": part },
      fold === undefined ? null : el("button", { type: "button", class: "fold", "aria-label": fold.open ? "Fold" : "Unfold", onclick: fold.turn }, fold.open ? "▾" : "▸"),
      el("input", { type: "checkbox", checked: shown, "aria-label": "Show " + name, onchange: (event) => switched(event.target.checked) }),
      swatch ? el("span", { class: "swatch", style: `background:${swatch}` }) : null,
      el("button", { type: "button", class: "name", title: name, onclick: choose }, name), count > 1 ? el("span", { class: "count" }, String(count)) : null);
  }

  #switched(set, key) {
    return (on) => {
      if (on) set.delete(key);
      else set.add(key);
      this.viewer.refresh();
      this.refresh();
    };
  }

  #counted(array, n) {
    const m = this.viewer.model, counts = new Uint32Array(n);
    for (let i = 0; i < m.count; i++) counts[array[i]]++;
    return counts;
  }
  #where(test) {
    const m = this.viewer.model, found = [];
    for (let i = 0; i < m.count; i++) if (test(i)) found.push(i);
    return found;
  }

  layers() {
    const v = this.viewer, m = v.model, counts = this.#counted(m.layer, m.layers.length);
    if (m.layers.length <= 1) return [el("p", { class: "empty" }, "This model has no layers. (layer \"name\" object …) makes them.")];
    return m.layers.map((name, k) => counts[k] === 0 ? null : this.#row({ name: name || "no layer", shown: !v.hidden.layers.has(name), switched: this.#switched(v.hidden.layers, name), count: counts[k],
      choose: () => v.select(this.#where((i) => m.layer[i] === k && v.isShown(i))) })).filter(Boolean);
  }

  materials() {
    const v = this.viewer, m = v.model, counts = this.#counted(m.paint, m.materials.length);
    const rows = m.materials.map((material, k) => counts[k] === 0 ? null : this.#row({
      name: material.name || (k === 0 ? "plain" : "#" + material.color.map((c) => Math.round(255 * c).toString(16).padStart(2, "0")).join("")), shown: !v.hidden.materials.has(k), switched: this.#switched(v.hidden.materials, k), count: counts[k],
      swatch: "rgb(" + material.color.map((c) => Math.round(255 * c)).join(",") + ")", choose: () => v.select(this.#where((i) => m.paint[i] === k && v.isShown(i))) })).filter(Boolean);
    return rows.slice(0, ROWS);
  }

  // Prepares the tree of the source's operations, with the parts in each. A row is made when its operation is unfolded.
  // first[p] and next[p] link the children of a path in a list.
  #tree() {
    const m = this.viewer.model, n = m.pathCount;
    if (this.treeOf === m) return;
    const parts = { first: new Int32Array(n).fill(-1), next: new Int32Array(m.count) }, paths = { first: new Int32Array(n).fill(-1), next: new Int32Array(n) }, count = this.counts = new Uint32Array(n);
    for (let i = m.count - 1; i >= 0; i--) parts.next[i] = parts.first[m.path[i]], parts.first[m.path[i]] = i, count[m.path[i]]++;
    for (let p = n - 1; p > 0; p--) {
      count[m.pathParent[p]] += count[p];
      if (count[p] > 0) paths.next[p] = paths.first[m.pathParent[p]], paths.first[m.pathParent[p]] = p;
    }
    const list = (chain) => (p) => { const found = []; for (let i = chain.first[p]; i >= 0; i = chain.next[i]) found.push(i); return found; };
    this.partsIn = list(parts);
    this.pathsIn = list(paths);
    this.treeOf = m;
    this.open.clear();
  }

  parts() {
    const v = this.viewer, m = v.model;
    this.#tree();
    const rows = [], all = (p) => {
      const found = [];
      for (const open = [p]; open.length > 0;) {
        const q = open.pop();
        for (const i of this.partsIn(q)) found.push(i);
        for (const c of this.pathsIn(q)) open.push(c);
      }
      return found;
    };
    const place = (o) => { if (!o) return ""; const at = m.origin(o); return `  ${at.name}:${at.line}`; };
    const add = (p, depth) => {
      for (const child of this.pathsIn(p)) {
        if (rows.length >= ROWS) return;
        // An operation that contains only another operation is omitted.
        let at = child;
        for (let inner = this.pathsIn(at); inner.length === 1 && this.partsIn(at).length === 0; inner = this.pathsIn(at)) at = inner[0];
        const open = this.open.has(at);
        rows.push(this.#row({ name: (m.kinds[m.pathKind[at]] || "group") + place(m.pathOrigin[at]), count: this.counts[at], depth, shown: v.hidden.parts.size === 0 || !all(at).every((i) => v.hidden.parts.has(i)),
          fold: { open, turn: () => { if (open) this.open.delete(at); else this.open.add(at); this.refresh(); } },
          switched: (on) => { for (const i of all(at)) on ? v.hidden.parts.delete(i) : v.hidden.parts.add(i); v.refresh(); this.refresh(); }, choose: () => v.select(all(at)) }));
        if (open) add(at, depth + 1);
      }
      for (const i of this.partsIn(p)) {
        if (rows.length >= ROWS) return;
        rows.push(this.#row({ name: (m.kinds[m.kind[i]] || "part") + place(m.made[i]), depth, part: i, shown: !v.hidden.parts.has(i), switched: this.#switched(v.hidden.parts, i), choose: () => v.select([i]) }));
      }
    };
    add(0, 0);
    if (rows.length >= ROWS) rows.push(el("p", { class: "empty" }, `${m.count - ROWS} more are in groups that are folded or past the end of this list.`));
    return rows;
  }
}
