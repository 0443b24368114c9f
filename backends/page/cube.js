// Contains the view cube: a small cube that turns with the camera. A click on a face gives the standard view from there,
// a click on a corner the view from that corner, and a drag turns the model.
import * as THREE from "three";
import { svg } from "./dom.js";

const SIZE = 96, HALF = 23; // The picture's side, and half the cube's edge, in pixels.
// Each face: its view, its name, its outward normal, and the direction that is to the right for its reader.
const FACES = [["top", "Top", [0, 0, 1], [1, 0, 0]], ["bottom", "Bottom", [0, 0, -1], [1, 0, 0]], ["front", "Front", [0, -1, 0], [1, 0, 0]],
  ["back", "Back", [0, 1, 0], [-1, 0, 0]], ["left", "Left", [-1, 0, 0], [0, -1, 0]], ["right", "Right", [1, 0, 0], [0, 1, 0]]];
const AXES = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];
const CORNERS = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].map((z) => [x, y, z])));
const PITCH = Math.atan(Math.SQRT1_2); // The pitch of an isometric view.

export class ViewCube {
  // control: the camera. view(name) shows a standard view; from(yaw, pitch) shows the model from a direction.
  constructor(control, { view, from }) {
    this.control = control;
    this.root = svg("svg", { class: "cube", viewBox: `${-SIZE / 2} ${-SIZE / 2} ${SIZE} ${SIZE}`, width: SIZE, height: SIZE, role: "group", "aria-label": "View cube" });
    this.faces = FACES.map(([name, label, normal, right]) => {
      const shape = svg("polygon", { class: "cube-face", "data-view": name }), words = svg("text", { class: "cube-words", "aria-hidden": "true" }, label);
      return { name, shape, words, normal: new THREE.Vector3(...normal), right: new THREE.Vector3(...right), does: () => view(name) };
    });
    this.corners = CORNERS.map((at) => {
      const [x, y, z] = at, shape = svg("circle", { class: "cube-corner", r: 7, "data-corner": at.join() });
      return { at: new THREE.Vector3(...at), shape, does: () => from(Math.atan2(y, x), z * PITCH) };
    });
    this.axes = AXES.map(([name, way]) => ({ way: new THREE.Vector3(...way), line: svg("line", { class: "cube-axis axis-" + name }), words: svg("text", { class: "cube-letter axis-" + name }, name) }));
    this.root.append(...this.axes.map((a) => a.line), ...this.faces.flatMap((f) => [f.shape, f.words]), ...this.axes.map((a) => a.words), ...this.corners.map((c) => c.shape));
    this.root.addEventListener("pointerdown", (event) => this.#press(event));
  }

  // Draws the cube as the camera sees it.
  draw() {
    const c = this.control, state = c.state, right = c.right(state), up = c.up(state), eye = c.direction(state);
    const at = (p) => [HALF * p.dot(right), -HALF * p.dot(up)];
    for (const f of this.faces) {
      const shown = f.normal.dot(eye) > 0.05, over = f.normal.clone().cross(f.right);
      f.shape.style.display = f.words.style.display = shown ? "" : "none";
      if (!shown) continue;
      const corner = (s, t) => at(f.normal.clone().addScaledVector(f.right, s).addScaledVector(over, t));
      f.shape.setAttribute("points", [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)].map((p) => p.join()).join(" "));
      const [ax, ay] = at(f.right), [bx, by] = at(over), [x, y] = at(f.normal), k = 1 / HALF;
      f.words.setAttribute("transform", `matrix(${[ax * k, ay * k, -bx * k, -by * k, x, y].map((v) => v.toFixed(4)).join(" ")})`);
    }
    for (const corner of this.corners) {
      const [x, y] = at(corner.at), shown = corner.at.dot(eye) > -0.3;
      corner.shape.style.display = shown ? "" : "none";
      corner.shape.setAttribute("cx", x);
      corner.shape.setAttribute("cy", y);
    }
    const origin = new THREE.Vector3(-1, -1, -1);
    for (const a of this.axes) {
      const [x1, y1] = at(origin), [x2, y2] = at(origin.clone().addScaledVector(a.way, 2.6)), [x3, y3] = at(origin.clone().addScaledVector(a.way, 3));
      for (const [name, value] of Object.entries({ x1, y1, x2, y2 })) a.line.setAttribute(name, value.toFixed(2));
      a.words.setAttribute("x", x3.toFixed(2));
      a.words.setAttribute("y", y3.toFixed(2));
    }
  }

  #press(event) {
    event.preventDefault();
    const target = event.target, begin = [event.clientX, event.clientY];
    let last = begin, moved = false;
    const move = (e) => {
      moved ||= Math.hypot(e.clientX - begin[0], e.clientY - begin[1]) > 4;
      if (moved) this.control.turn(2 * (e.clientX - last[0]), 2 * (e.clientY - last[1])), last = [e.clientX, e.clientY];
    };
    const up = (e) => {
      for (const [name, does] of [["pointermove", move], ["pointerup", up], ["pointercancel", up]]) removeEventListener(name, does);
      if (!moved && e.type === "pointerup") [...this.faces, ...this.corners].find((p) => p.shape === target)?.does();
    };
    for (const [name, does] of [["pointermove", move], ["pointerup", up], ["pointercancel", up]]) addEventListener(name, does);
  }
}
