// Implements the camera: turning, moving and zooming by mouse, pen, touch and keys; standard views; walking.
//
// The view is a target, two angles and a distance, so it cannot roll. Z is up.
import * as THREE from "three";

const clamp = (x, a, b) => Math.min(b, Math.max(a, x));

export const VIEWS = {
  top: { yaw: -Math.PI / 2, pitch: Math.PI / 2, parallel: true },
  bottom: { yaw: -Math.PI / 2, pitch: -Math.PI / 2, parallel: true },
  front: { yaw: -Math.PI / 2, pitch: 0, parallel: true },
  back: { yaw: Math.PI / 2, pitch: 0, parallel: true },
  left: { yaw: Math.PI, pitch: 0, parallel: true },
  right: { yaw: 0, pitch: 0, parallel: true },
  iso: { yaw: -Math.PI / 4, pitch: Math.atan(Math.SQRT1_2), parallel: true },
};

export class CameraControl {
  constructor(stage) {
    this.stage = stage;
    this.perspective = new THREE.PerspectiveCamera(35, 1, 0.1, 1000);
    this.orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 1000);
    this.state = { target: new THREE.Vector3(), yaw: -1, pitch: 0.4, distance: 10, angle: 0.6, parallel: false };
    this.walking = false;
    this.keys = new Set();
    this.pointers = new Map();
    this.depthAt = () => null; // (x, y) is in pixels; returns the point of the model there, or null
    this.changed = () => {};
    // returns the number of pixels at the picture's lower border that are under or next to buttons
    this.covered = () => 0;
    // returns the number of pixels at the picture's right border that something covers
    this.beside = () => 0;
    stage.onFrame((time) => this.#step(time));
    this.#listen(stage.canvas);
  }

  // ---- the state and the camera ----

  direction(s = this.state) { // returns the unit vector from the target to the eye
    return new THREE.Vector3(Math.cos(s.yaw) * Math.cos(s.pitch), Math.sin(s.yaw) * Math.cos(s.pitch), Math.sin(s.pitch));
  }
  up(s = this.state) {
    return new THREE.Vector3(-Math.cos(s.yaw) * Math.sin(s.pitch), -Math.sin(s.yaw) * Math.sin(s.pitch), Math.cos(s.pitch));
  }
  right(s = this.state) { return new THREE.Vector3(-Math.sin(s.yaw), Math.cos(s.yaw), 0); }
  eye(s = this.state) { return s.target.clone().addScaledVector(this.direction(s), s.distance); }

  apply() {
    const s = this.state, stage = this.stage, canvas = stage.canvas, aspect = Math.max(1, canvas.clientWidth) / Math.max(1, canvas.clientHeight);
    const camera = s.parallel ? this.orthographic : this.perspective, eye = this.eye();
    const far = eye.distanceTo(stage.center || s.target) + 1.02 * (stage.radius || 1);
    camera.position.copy(eye);
    camera.up.copy(this.up());
    camera.lookAt(s.target);
    if (s.parallel) {
      const half = s.distance * Math.tan(s.angle / 2), back = 4 * (stage.radius || 1) + s.distance;
      Object.assign(camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half, near: -back, far: far + back });
    } else {
      camera.fov = THREE.MathUtils.radToDeg(s.angle);
      camera.aspect = aspect;
      camera.near = Math.max(far - 2.04 * (stage.radius || 1), far / (this.walking ? 20000 : 5000));
      const ground = stage.groundMesh; // If the eye is low, the ground is nearer to it than the model.
      if (ground) camera.near = Math.min(camera.near, Math.max(0.3 * Math.abs(eye.z - ground.position.z), far / 5000));
      if (this.walking) camera.near = Math.min(camera.near, 0.1 / this.metre());
      // When the user walks, the ground begins at the eye's feet.
      if (stage.groundMesh) camera.near = Math.min(camera.near, Math.max(0.25 * Math.abs(eye.z - stage.groundMesh.position.z), far / 5000));
      camera.far = Math.max(far, 1e-6) * (stage.groundMesh ? 8 : 1.2);
    }
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    stage.camera = camera;
    this.changed();
    stage.touch();
  }

  metre() { return this.stage.model?.metres || 1; } // length of a model unit in metres

  // ---- framing ----

  corners(box) {
    const out = [];
    for (let i = 0; i < 8; i++) out.push(new THREE.Vector3(box[i & 1 ? "max" : "min"][0], box[i & 2 ? "max" : "min"][1], box[i & 4 ? "max" : "min"][2]));
    return out;
  }

  // Returns the state that shows the box, as large as possible above the buttons, with the direction of s. If the box
  // is that of the model, shows all points of the model instead. The computation is that of backends/view.c.
  framed(s, box) {
    const canvas = this.stage.canvas, aspect = Math.max(1, canvas.clientWidth) / Math.max(1, canvas.clientHeight), margin = 1.12;
    const half = Math.tan(s.angle / 2), tall = half / margin, wide = tall * aspect;
    // tangent of the visible half angle below the middle, above the buttons
    const low = Math.min(tall, half * Math.max(0.4, 1 - 2 * this.covered() / Math.max(1, canvas.clientHeight)));
    // tangent of the visible half angle right of the middle
    const free = Math.min(wide, half * aspect * Math.max(-0.6, 1 - 2 * this.beside() / Math.max(1, canvas.clientWidth)));
    const r = this.right(s), u = this.up(s), f = this.direction(s).negate(), corners = this.corners(box);
    const middle = corners[0].clone().add(corners[7]).multiplyScalar(0.5);
    const most = { r: -Infinity, l: -Infinity, t: -Infinity, b: -Infinity }, flat = { ...most };
    const outer = box === this.stage.model?.box ? this.stage.model.outerPoints() : corners.flatMap((c) => [c.x, c.y, c.z]), c = new THREE.Vector3();
    for (let i = 0; i < outer.length; i += 3) {
      c.set(outer[i], outer[i + 1], outer[i + 2]).sub(middle);
      const x = c.dot(r), y = c.dot(u), z = c.dot(f);
      most.r = Math.max(most.r, x - z * free), most.l = Math.max(most.l, -x - z * wide);
      most.t = Math.max(most.t, y - z * tall), most.b = Math.max(most.b, -y - z * low);
      flat.r = Math.max(flat.r, x), flat.l = Math.max(flat.l, -x), flat.t = Math.max(flat.t, y), flat.b = Math.max(flat.b, -y);
    }
    const used = s.parallel ? flat : most;
    const width = (used.r + used.l) / (free + wide), height = (used.t + used.b) / (tall + low), distance = Math.max(width, height, 1e-6) || 1;
    const target = middle.addScaledVector(r, (used.r - used.l + (wide - free) * distance) / 2).addScaledVector(u, (used.t - used.b + (low - tall) * distance) / 2);
    return { ...s, target, distance };
  }

  fit(box = this.stage.model.box) { this.walking = false; this.go(this.framed(this.state, box)); }
  view(name) {
    this.walking = false;
    if (name === "start") return this.go(this.start());
    const v = VIEWS[name];
    this.from(v.yaw, v.pitch, v.parallel);
  }
  // Shows the model from a direction.
  from(yaw, pitch, parallel = true) {
    this.walking = false;
    this.go(this.framed({ ...this.state, yaw: this.#nearest(yaw), pitch, parallel }, this.stage.model.box));
  }
  // Returns true if the rectangle around the corners of the model's box does not meet the picture, or is smaller than a
  // twentieth of it.
  outOfFrame() {
    const { model, camera } = this.stage;
    if (!model || model.count === 0) return false;
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    let behind = 0;
    for (const corner of this.corners(model.box)) {
      if (!this.state.parallel && corner.clone().applyMatrix4(camera.matrixWorldInverse).z >= 0) { behind++; continue; }
      corner.project(camera);
      [corner.x, corner.y].forEach((v, k) => { low[k] = Math.min(low[k], v); high[k] = Math.max(high[k], v); });
    }
    if (behind > 0) return behind === 8;
    return low.some((v) => v > 1) || high.some((v) => v < -1) || Math.max(high[0] - low[0], high[1] - low[1]) < 0.1;
  }
  #nearest(yaw) { return yaw + 2 * Math.PI * Math.round((this.state.yaw - yaw) / (2 * Math.PI)); }

  // Returns the state of the view that the model sets, or else of the default view.
  start() {
    const model = this.stage.model, v = model.view, s = { ...this.state, angle: 0.583, parallel: false, yaw: -0.98, pitch: 0.42 };
    if (!v) return this.framed(s, model.box);
    const eye = new THREE.Vector3(...v.eye).sub(new THREE.Vector3(...model.middle)), target = new THREE.Vector3(...v.target).sub(new THREE.Vector3(...model.middle));
    const way = eye.clone().sub(target), length = way.length() || 1;
    way.divideScalar(length);
    s.pitch = Math.asin(clamp(way.z, -1, 1));
    s.yaw = Math.abs(way.z) > 0.99999 ? Math.atan2(-v.up[1] * Math.sign(way.z), -v.up[0] * Math.sign(way.z)) : Math.atan2(way.y, way.x);
    s.parallel = v.parallel;
    if (!v.given) return this.framed(s, model.box);
    const aspect = this.stage.canvas.clientWidth / Math.max(1, this.stage.canvas.clientHeight);
    s.angle = 2 * Math.atan(Math.tan(v.angle / 2) / Math.min(aspect, v.aspect));
    // The centre of rotation is on the line of sight, near the middle of the model.
    const ahead = way.clone().negate(), along = clamp(-eye.dot(ahead), 0.05 * model.diagonal, 20 * model.diagonal);
    return { ...s, distance: along, target: eye.addScaledVector(ahead, along) };
  }
  reset() { this.walking = false; Object.assign(this.state, this.start()); this.motion = null; this.apply(); }

  // Moves the camera to a state: smoothly, or at once if the user prefers no motion.
  go(to) {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
      Object.assign(this.state, to);
      this.motion = null;
      return this.apply();
    }
    const from = { ...this.state, target: this.state.target.clone() };
    if (from.parallel !== to.parallel) this.state.parallel = to.parallel;
    this.motion = { from, to, began: performance.now() };
    this.stage.wake();
  }

  setParallel(parallel) {
    this.walking = false;
    this.state.parallel = parallel;
    this.apply();
  }

  // ---- gestures ----

  turn(dx, dy) { // dx and dy are in pixels
    this.motion = null;
    const s = this.state;
    if (this.walking) {
      const eye = this.eye();
      s.yaw -= dx * 0.004;
      s.pitch = clamp(s.pitch + dy * 0.004, -1.5, 1.5);
      s.target.copy(eye).addScaledVector(this.direction(), -s.distance);
    } else {
      s.yaw -= dx * 0.0065;
      s.pitch = clamp(s.pitch + dy * 0.0065, -Math.PI / 2, Math.PI / 2);
    }
    this.apply();
  }

  pan(dx, dy) {
    this.motion = null;
    const s = this.state, depth = this.grabbed ? Math.max(this.grabbed.clone().sub(this.eye()).dot(this.direction().negate()), 1e-3 * s.distance) : s.distance;
    const unit = 2 * (s.parallel ? s.distance : depth) * Math.tan(s.angle / 2) / Math.max(1, this.stage.canvas.clientHeight);
    s.target.addScaledVector(this.right(), -dx * unit).addScaledVector(this.up(), dy * unit);
    this.apply();
  }

  // Multiplies the distance by a factor; a factor below 1 moves nearer. The point under (x, y) stays at its place in
  // the picture.
  zoom(factor, x, y) {
    this.motion = null;
    const s = this.state;
    const canvas = this.stage.canvas, px = x === undefined ? 0 : 2 * x / canvas.clientWidth - 1, py = y === undefined ? 0 : 1 - 2 * y / canvas.clientHeight;
    const point = x === undefined ? s.target.clone() : this.depthAt(x, y) || this.#onTarget(px, py);
    const least = 1e-4 * (this.stage.radius || 1), most = 60 * (this.stage.radius || 1);
    factor = clamp(s.distance * factor, least, most) / s.distance;
    s.target.sub(point).multiplyScalar(factor).add(point);
    s.distance *= factor;
    // Near the object under the cursor the steps become shorter, so the eye never ends inside it.
    this.apply();
  }
  #onTarget(px, py) {
    const s = this.state, half = s.distance * Math.tan(s.angle / 2), aspect = this.stage.canvas.clientWidth / Math.max(1, this.stage.canvas.clientHeight);
    return s.target.clone().addScaledVector(this.right(), px * half * aspect).addScaledVector(this.up(), py * half);
  }

  walk(on) {
    this.walking = on;
    if (on) {
      const s = this.state, eye = this.eye(), model = this.stage.model, height = 1.65 / this.metre();
      const floor = model.ground ? model.ground.z - model.middle[2] : model.box.min[2];
      s.parallel = false;
      s.angle = 1.05;
      // The walk begins on the floor below the eye, but not farther from the model than `reach`.
      const flat = eye.clone().sub(this.stage.center).setZ(0), reach = 0.75 * Math.hypot(model.size[0], model.size[1]) + 4 / this.metre();
      if (flat.length() > reach) flat.setLength(reach);
      eye.set(this.stage.center.x + flat.x, this.stage.center.y + flat.y, floor + height);
      const look = this.stage.center.clone().setZ(Math.min(this.stage.center.z, floor + 2.2 * height)).sub(eye);
      if (look.lengthSq() < 1e-9) look.set(0, 1, 0);
      s.yaw = Math.atan2(-look.y, -look.x);
      s.pitch = clamp(-Math.atan2(look.z, Math.hypot(look.x, look.y)), -0.5, 0.5);
      s.distance = 2 / this.metre();
      s.target.copy(eye).addScaledVector(this.direction(), -s.distance);
      this.motion = null;
      this.apply();
    } else {
      this.state.angle = 0.583;
      this.fit();
    }
  }

  #step(time) {
    let moving = false;
    if (this.motion) {
      const { from, to, began } = this.motion, t = clamp((performance.now() - began) / 380, 0, 1), e = t * t * (3 - 2 * t), s = this.state;
      s.target.lerpVectors(from.target, to.target, e);
      for (const key of ["yaw", "pitch", "angle"]) s[key] = from[key] + (to[key] - from[key]) * e;
      s.distance = from.distance * Math.pow(to.distance / from.distance, e);
      if (t >= 1) {
        Object.assign(s, to);
        this.motion = null;
      }
      moving = true;
    }
    if (this.keys.size > 0) {
      const dt = clamp((time - (this.lastTime || time)) / 1000, 0, 0.1), has = (k) => this.keys.has(k);
      const x = (has("d") || has("arrowright") ? 1 : 0) - (has("a") || has("arrowleft") ? 1 : 0), y = (has("w") || has("arrowup") ? 1 : 0) - (has("s") || has("arrowdown") ? 1 : 0);
      if (this.walking) {
        const speed = (has("shift") ? 7 : 2.4) / this.metre() * dt, forward = this.direction().negate().setZ(0).normalize();
        this.state.target.addScaledVector(forward, y * speed).addScaledVector(this.right(), x * speed);
        this.state.target.z += ((has("e") ? 1 : 0) - (has("q") ? 1 : 0)) * speed;
        moving = true;
      }
    }
    this.lastTime = time;
    if (moving) this.apply();
    return moving;
  }

  #listen(canvas) {
    const at = (event) => { const r = canvas.getBoundingClientRect(); return { x: event.clientX - r.left, y: event.clientY - r.top }; };
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("pointerdown", (event) => {
      if (this.intercept?.(event, at(event))) return;
      canvas.focus({ preventScroll: true });
      canvas.setPointerCapture?.(event.pointerId);
      const p = { ...at(event), button: event.button, ctrl: event.ctrlKey || event.shiftKey || event.metaKey, from: at(event), time: event.timeStamp };
      this.pointers.set(event.pointerId, p);
      this.grabbed = this.depthAt(p.x, p.y);
    });
    canvas.addEventListener("pointermove", (event) => {
      const p = this.pointers.get(event.pointerId);
      if (!p) return;
      const now = at(event), dx = now.x - p.x, dy = now.y - p.y;
      if (this.pointers.size === 2) {
        const [other] = [...this.pointers.entries()].filter(([id]) => id !== event.pointerId).map(([, q]) => q);
        const before = Math.hypot(p.x - other.x, p.y - other.y), after = Math.hypot(now.x - other.x, now.y - other.y);
        Object.assign(p, now);
        this.pan(dx / 2, dy / 2);
        if (before > 8 && after > 8) this.zoom(before / after, (now.x + other.x) / 2, (now.y + other.y) / 2);
        p.moved = other.moved = true;
        return;
      }
      Object.assign(p, now);
      if (Math.hypot(now.x - p.from.x, now.y - p.from.y) > 4) p.moved = true;
      if (!p.moved) return;
      if (p.button !== 0 || p.ctrl) this.pan(dx, dy);
      else this.turn(dx, dy);
    });
    const end = (event) => {
      const p = this.pointers.get(event.pointerId);
      this.pointers.delete(event.pointerId);
      if (p && !p.moved && event.type === "pointerup" && p.button === 0) this.click?.(p.x, p.y, event);
    };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 30 : event.deltaMode === 2 ? 300 : 1, p = at(event);
      this.zoom(Math.exp(clamp(event.deltaY * lines, -300, 300) * (event.ctrlKey ? 0.008 : 0.0016)), p.x, p.y);
    }, { passive: false });
    canvas.addEventListener("dblclick", (event) => {
      const p = at(event), point = this.depthAt(p.x, p.y);
      if (point) this.go({ ...this.state, target: point, distance: this.state.parallel ? this.state.distance : Math.max(this.eye().distanceTo(point) * 0.6, 1e-3) });
    });
    const walkKeys = ["w", "a", "s", "d", "q", "e", "shift", "arrowup", "arrowdown", "arrowleft", "arrowright"];
    canvas.addEventListener("keydown", (event) => {
      if (event.metaKey || event.altKey || event.ctrlKey) return;
      const key = event.key.toLowerCase();
      if (this.walking && walkKeys.includes(key)) {
        this.keys.add(key);
        this.stage.wake();
      } else if (key.startsWith("arrow")) {
        const x = key === "arrowright" ? 1 : key === "arrowleft" ? -1 : 0, y = key === "arrowdown" ? 1 : key === "arrowup" ? -1 : 0;
        if (event.shiftKey) this.grabbed = null, this.pan(-40 * x, -40 * y);
        else this.turn(24 * x, 24 * y);
      } else if (key === "+" || key === "=") this.zoom(0.85);
      else if (key === "-") this.zoom(1 / 0.85);
      else return;
      event.preventDefault();
    });
    canvas.addEventListener("keyup", (event) => this.keys.delete(event.key.toLowerCase()));
    canvas.addEventListener("blur", () => this.keys.clear());
  }
}
