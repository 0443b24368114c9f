// Contains the grid on the floor: squares of a round size, the axes through the origin, and numbers at every fifth line.
import * as THREE from "three";
import { roundStep } from "./lengths.js";

const SQUARES = 20; // About this number of squares lie along the longer side.

export class Grid {
  constructor(stage) {
    this.stage = stage;
    this.group = new THREE.Group();
    this.group.name = "grid";
    stage.scene.add(this.group);
    this.ticks = []; // Numbers at the lines: { axis, ends, text }. ends: the ends of the line that crosses the axis.
  }

  clear() {
    for (const child of [...this.group.children]) {
      this.group.remove(child);
      child.geometry.dispose();
      child.material.dispose();
    }
    this.ticks = [];
    this.laid = "";
  }

  // Returns the numbers along the two borders of the grid that are nearer to the eye: { at, text }.
  numbers(eye) {
    return this.ticks.map(({ axis, ends: [a, b], text }) => ({ at: Math.abs(eye.getComponent(1 - axis) - a.getComponent(1 - axis)) < Math.abs(eye.getComponent(1 - axis) - b.getComponent(1 - axis)) ? a : b, text }));
  }

  // Lays the grid under the model, and a fifth of its size around it.
  show(model) {
    const laid = model && model.count > 0 ? JSON.stringify([model.box, model.middle, model.ground?.z, model.diagonal]) : "";
    if (laid === this.laid) return;
    this.clear();
    this.laid = laid;
    if (!laid) return;
    const middle = model.middle, low = [0, 1].map((k) => model.box.min[k] + middle[k]), high = [0, 1].map((k) => model.box.max[k] + middle[k]);
    // A model without a width, such as a vertical line, has a grid that suits its height.
    const size = Math.max(high[0] - low[0], high[1] - low[1], 0.1 * model.diagonal), pad = 0.2 * size, step = roundStep((size + 2 * pad) / SQUARES);
    const from = low.map((x) => Math.floor((x - pad) / step)), to = high.map((x) => Math.ceil((x + pad) / step));
    const z = (model.ground ? model.ground.z : model.box.min[2] + middle[2]) - middle[2], faint = [], strong = [], axes = [[], []];
    for (const k of [0, 1]) for (let i = from[k]; i <= to[k]; i++) {
      const a = [0, 0, z], b = [0, 0, z], o = 1 - k;
      a[k] = b[k] = i * step - middle[k];
      a[o] = from[o] * step - middle[o];
      b[o] = to[o] * step - middle[o];
      (i === 0 ? axes[o] : i % 5 === 0 ? strong : faint).push(...a, ...b);
      if (i % 5 === 0) this.ticks.push({ axis: k, ends: [new THREE.Vector3(...a), new THREE.Vector3(...b)], text: String(Number((i * step).toPrecision(12))) });
    }
    const add = (points, color, opacity) => {
      if (points.length === 0) return;
      const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
      const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color, transparent: true, opacity, depthWrite: false, toneMapped: false }));
      lines.frustumCulled = false;
      lines.renderOrder = 1;
      this.group.add(lines);
    };
    add(faint, 0x46525e, 0.25);
    add(strong, 0x46525e, 0.55);
    add(axes[0], 0xc0392b, 0.9); // the x axis
    add(axes[1], 0x1c8a5a, 0.9); // the y axis
  }
}
