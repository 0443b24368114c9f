// Contains the measuring tool: what the user has clicked, the readings, and their marks over the picture.
//
// A mark is a corner, an edge or a face (snap() of pick.js). Two marks make a reading. Readings stay until the user
// takes them away, or the model runs again. In the live view the server describes the surface of a face: then the axis
// of a cylinder, and the centre of a sphere or torus, is measured instead of a facet.
import * as THREE from "three";
import { length } from "./lengths.js";
import { svg } from "./dom.js";

// Positions are numbers of 32 bits, relative to the middle of the model: directions of small parts have few digits.
const PARALLEL = 1e-3; // Greatest sine of the angle between parallel directions.
const ENDLESS = 1e4;   // Half of the length of an axis, in radii.

const way = (edge) => edge.ends[1].clone().sub(edge.ends[0]).normalize();
const angle = (p, q) => (Math.acos(Math.min(1, Math.abs(p.dot(q)))) * 180 / Math.PI).toFixed(1) + "°";

// Returns the points of two segments that are nearest to each other.
function nearest([a, b], [c, d]) {
  const u = b.clone().sub(a), v = d.clone().sub(c), w = a.clone().sub(c), uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w), det = uu * vv - uv * uv;
  const clamp = (x) => Math.min(1, Math.max(0, x));
  let s = det > 1e-12 * uu * vv ? clamp((uv * vw - vv * uw) / det) : 0, t = vv > 0 ? clamp((uv * s + vw) / vv) : 0;
  s = uu > 0 ? clamp((uv * t - uw) / uu) : 0;
  t = vv > 0 ? clamp((uv * s + vw) / vv) : t;
  return [a.clone().addScaledVector(u, s), c.clone().addScaledVector(v, t)];
}

// Returns what the distance from a mark is measured to: the mark, or the axis, centre or apex of its surface.
function element(mark) {
  const s = mark.surface;
  if (!s) return mark;
  if (s.form === "cylinder") {
    const foot = s.at.clone().addScaledVector(s.axis, mark.at.clone().sub(s.at).dot(s.axis));
    const ends = [-1, 1].map((k) => foot.clone().addScaledVector(s.axis, k * ENDLESS * s.radius));
    return { kind: "edge", at: foot, ends, length: 0, name: "axis" };
  }
  if (s.form === "plane") return { ...mark, normal: s.axis };
  return s.form === "surface" ? mark : { kind: "point", at: s.at, name: s.form === "cone" ? "apex" : "centre" };
}

// Returns the reading of two marks: { words, from, to }, the text and the points between which it was taken. units is
// the name of the unit of length.
export function between(a, b, units) {
  [a, b] = [element(a), element(b)];
  const names = [...new Set([a.name, b.name].filter(Boolean))].map((name) => name + "   ").join("");
  const reading = measured(a, b, units);
  return { ...reading, words: names + reading.words };
}

function measured(a, b, units) {
  const rank = { point: 0, edge: 1, face: 2 };
  if (rank[a.kind] > rank[b.kind]) [a, b] = [b, a];
  const gap = (from, to, before = "") => {
    const d = to.clone().sub(from), parts = ["x", "y", "z"].map((name, k) => [name, Math.abs(d.getComponent(k))]).filter(([, x]) => x > 1e-5 * d.length());
    const words = before + length(d.length(), units) + (parts.length > 1 ? "   " + parts.map(([name, x]) => `d${name} ${length(x)}`).join("  ") : "");
    return { words, from, to };
  };
  if (a.kind === "point" && b.kind === "edge") return gap(a.at, new THREE.Line3(...b.ends).closestPointToPoint(a.at, true, new THREE.Vector3()));
  if (a.kind === "edge" && b.kind === "edge") {
    const [from, to] = nearest(a.ends, b.ends), parallel = way(a).cross(way(b)).length() < PARALLEL;
    if (parallel) return gap(from, to);
    return from.distanceTo(to) < 1e-6 * (a.length + b.length) ? { words: angle(way(a), way(b)), from, to } : gap(from, to, angle(way(a), way(b)) + "   ");
  }
  if (b.kind === "face" && a.kind === "edge" && Math.abs(way(a).dot(b.normal)) > PARALLEL)
    return { words: (90 - Math.acos(Math.min(1, Math.abs(way(a).dot(b.normal)))) * 180 / Math.PI).toFixed(1) + "°", from: a.at, to: b.at };
  if (a.kind === "face" && a.normal.clone().cross(b.normal).length() > PARALLEL) return { words: angle(a.normal, b.normal), from: a.at, to: b.at };
  if (b.kind === "face") {
    const off = b.normal.dot(a.at.clone().sub(b.at)), size = a.at.distanceTo(b.at);
    // Both marks are on one plane: the distance between the clicked points.
    if (Math.abs(off) < 1e-6 * size) return gap(a.at, b.at);
    return gap(a.at, a.at.clone().addScaledVector(b.normal, -off));
  }
  return gap(a.at, b.at);
}

// Returns the text for a single mark. middle is the model's middle, to which marks are relative.
export function alone(a, units, middle) {
  if (a.kind === "point") return a.at.toArray().map((v, k) => length(v + middle[k])).join(", ");
  if (a.kind === "edge") return length(a.length, units);
  const s = a.surface, area = length((s || a).area, units + "²");
  if (!s || s.form === "plane" || s.form === "surface") return area;
  if (s.form === "cone") return `half angle ${(s.angle * 180 / Math.PI).toFixed(2)}°   ${area}`;
  const radius = `radius ${length(s.radius, units)}`;
  return s.form === "torus" ? `${radius}   tube ${length(s.tube, units)}   ${area}` : `${radius}   ${area}`;
}

export class Measures {
  constructor() {
    this.readings = []; // { words, from, to, marks }
    this.open = null;   // the first mark of the next reading
    this.hovered = null;
  }
  get count() { return this.readings.length + (this.open ? 1 : 0); }
  clear() {
    this.readings = [];
    this.open = this.hovered = null;
  }
  takeAway() {
    if (this.open) this.open = null;
    else this.readings.pop();
  }
  // Adds a mark, and returns its text: that of the mark, or that of the finished reading.
  add(mark, units, middle) {
    if (!this.open) {
      this.open = mark;
      return alone(mark, units, middle);
    }
    const reading = { ...between(this.open, mark, units), marks: [this.open, mark] };
    this.readings.push(reading);
    this.open = null;
    return reading.words;
  }
  // Gives a mark the surface of its face, and returns the text that has changed, or null if the mark has gone.
  describe(mark, surface, units, middle) {
    mark.surface = surface;
    if (mark === this.open) return alone(mark, units, middle);
    const reading = this.readings.find((r) => r.marks.includes(mark));
    if (!reading) return null;
    Object.assign(reading, between(...reading.marks, units));
    return reading.words;
  }

  // Returns the shapes of all marks and readings. at(point) returns a point's place in the picture.
  shapes(at, units, middle) {
    const out = [], line = (p, q, more) => { if (!p.behind && !q.behind) out.push(svg("line", { x1: p.x, y1: p.y, x2: q.x, y2: q.y, class: "measure", ...more })); };
    const mark = (m, faint) => {
      if (m.ends) line(...m.ends.map(at), { opacity: faint ? 0.6 : 1 });
      const p = at(m.at);
      if (!p.behind && m.kind !== "edge") out.push(svg("circle", { cx: p.x, cy: p.y, r: faint ? 4 : 5, class: "dot", opacity: faint ? 0.7 : 1 }));
    };
    const label = (text, p, q) => {
      if (p.behind || q.behind) return;
      const x = (p.x + q.x) / 2, y = (p.y + q.y) / 2 - 20, w = 14 + 7.4 * text.length;
      out.push(svg("rect", { x: x - w / 2, y: y - 12, width: w, height: 24, rx: 7, class: "label" }), svg("text", { x, y, class: "reading" }, text));
    };
    if (this.hovered) mark(this.hovered, true);
    if (this.open) mark(this.open, false), label(alone(this.open, units, middle), at(this.open.at), at(this.open.at));
    for (const r of this.readings) {
      const p = at(r.from), q = at(r.to);
      for (const m of r.marks) mark(m, false);
      line(p, q, { "stroke-dasharray": "5 4" });
      label(r.words, p, q);
    }
    return out;
  }
}
