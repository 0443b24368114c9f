// Draws the sets of a sweep as points beside the parallel coordinates, by two axes that the user chooses. The point under
// the pointer shows its picture and numbers; a click opens its file. `sweep` is that of parallel_coordinates.js.
"use strict";
(() => {
  if (!sweep) return;
  const { panel, axes, figures, label, colour, choose, beside } = sweep;
  const box = document.createElement("div"), canvas = document.createElement("canvas"), bar = document.createElement("p");
  const card = document.createElement("div"), left = 56, right = 16, top = 12, bottom = 28, height = 260, near = 14;
  box.id = "scatter";
  box.style.cssText = "flex:2 1 300px;min-width:0;position:relative";
  canvas.style.cssText = "width:100%;height:260px;display:block";
  canvas.setAttribute("role", "img");
  card.style.cssText = "position:absolute;display:none;width:220px;background:#fff;border:1px solid #999;padding:6px;" +
    "pointer-events:none;z-index:2;box-shadow:0 2px 8px rgba(0,0,0,.25)";
  // Numbers that differ by rounding alone are one value.
  const ranges = (axis) => axis.most - axis.least > 1e-9 * Math.max(Math.abs(axis.least), Math.abs(axis.most));
  const numeric = axes.map((axis, k) => k).filter((k) => !axes[k].texts.length && ranges(axes[k]));
  const [first, second] = numeric.length > 1 ? numeric.slice(-2) : [0, axes.length - 1];
  const across = choice("Across", first), up = choice("Up", second);
  bar.append(across.parentNode, " ", up.parentNode);
  box.append(canvas, bar, card);
  panel.append(box);
  const still = document.createElement("canvas"); // the drawing without the chosen point
  let kept = [];

  function choice(words, at) {
    const name = document.createElement("label"), list = document.createElement("select");
    axes.forEach((axis, k) => list.append(new Option(axis.name, k, k === at, k === at)));
    list.addEventListener("change", draw);
    name.append(words + " ", list);
    return list;
  }
  const tick_label = (axis, value) => (axis.texts.length ? label(axis, value) : String(Number(value.toPrecision(12))));
  const chosen_axes = () => [axes[across.value], axes[up.value]];
  const wide = () => box.clientWidth - left - right, high = height - top - bottom;
  // Shares of an axis between 0.03 and 0.97: points at its ends are inside the frame.
  const inset = (at) => 0.03 + 0.94 * at;
  // Returns the place of a set's point, or null if the set lacks one of the values. The axes and the width may be given.
  function place(i, [x, y] = chosen_axes(), width = wide()) {
    if (Number.isNaN(x.places[i]) || Number.isNaN(y.places[i])) return null;
    return [left + along(x, x.places[i]) * width, top + (1 - along(y, y.places[i])) * high];
  }
  // Returns round numbers on the axis, or the places of its texts.
  function ticks(axis, most) {
    if (axis.texts.length) return axis.texts.length <= most ? axis.texts.map((text, k) => k) : [0, axis.texts.length - 1];
    if (!ranges(axis)) return Number.isFinite(axis.least) ? [axis.least] : [];
    const rough = (axis.most - axis.least) / most, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((k) => k * power >= rough), list = [];
    for (let k = Math.ceil(axis.least / step); k * step <= axis.most; k++) list.push(k * step);
    return list;
  }
  const along = (axis, value) => inset(ranges(axis) ? (value - axis.least) / (axis.most - axis.least) : 0.5);
  function draw_frame(to) {
    const [x, y] = chosen_axes(), shown = (text) => (text.length > 14 ? text.slice(0, 13) + "\u2026" : text);
    to.font = "12px sans-serif", to.strokeStyle = "#ddd", to.fillStyle = "#444";
    to.textAlign = "center";
    for (const value of ticks(x, Math.max(3, Math.floor(wide() / 80)))) {
      const at = left + along(x, value) * wide();
      to.beginPath(), to.moveTo(at, top), to.lineTo(at, height - bottom), to.stroke();
      to.fillText(shown(tick_label(x, value)), at, height - 10);
    }
    to.textAlign = "right";
    for (const value of ticks(y, 5)) {
      const at = top + (1 - along(y, value)) * high;
      to.beginPath(), to.moveTo(left, at), to.lineTo(left + wide(), at), to.stroke();
      to.fillText(shown(tick_label(y, value)), left - 6, at + 4);
    }
    to.strokeStyle = "#333", to.strokeRect(left, top, wide(), high);
  }
  function draw_point(to, i, size, of = []) {
    const at = place(i, ...of);
    if (!at) return;
    const [x, y] = at;
    to.beginPath(), to.arc(x, y, size, 0, 2 * Math.PI), to.fill();
  }
  function draw() {
    const scale = window.devicePixelRatio || 1, to = canvas.getContext("2d"), [x, y] = chosen_axes();
    canvas.width = box.clientWidth * scale, canvas.height = height * scale;
    canvas.setAttribute("aria-label", `Sets by ${x.name} and ${y.name}`);
    to.scale(scale, scale);
    draw_frame(to);
    const size = figures.length > 1000 ? 2 : 4;
    to.fillStyle = "#ddd";
    const of = [[x, y], wide()];
    figures.forEach((figure, i) => { if (!kept[i]) draw_point(to, i, size, of); });
    figures.forEach((figure, i) => { if (kept[i]) to.fillStyle = colour(i), draw_point(to, i, size, of); });
    still.width = canvas.width, still.height = canvas.height;
    still.getContext("2d").drawImage(canvas, 0, 0);
  }
  function draw_chosen(i) {
    const to = canvas.getContext("2d"), scale = window.devicePixelRatio || 1;
    to.setTransform(1, 0, 0, 1, 0, 0);
    to.clearRect(0, 0, canvas.width, canvas.height), to.drawImage(still, 0, 0);
    to.scale(scale, scale);
    if (i >= 0) to.fillStyle = "#000", draw_point(to, i, 7);
  }
  // Returns the number of the kept set whose point is nearest to the pointer, or -1 if none is near.
  function nearest(event) {
    const frame = canvas.getBoundingClientRect(), chosen = chosen_axes(), width = wide();
    let best = -1, least = near;
    figures.forEach((figure, i) => {
      const at = kept[i] && place(i, chosen, width);
      if (!at) return;
      const distance = Math.hypot(at[0] - (event.clientX - frame.left), at[1] - (event.clientY - frame.top));
      if (distance < least) least = distance, best = i;
    });
    return best;
  }
  function show_card(i) {
    const picture = figures[i].querySelector("img"), words = figures[i].querySelector("figcaption").cloneNode(true);
    card.replaceChildren(words);
    if (picture) {
      const copy = new Image();
      copy.src = picture.src, copy.alt = "", copy.style.cssText = "width:100%;display:block";
      card.prepend(copy);
    }
    const [x, y] = place(i);
    card.style.display = "block";
    card.style.left = Math.max(0, Math.min(x + 16 + 234 > box.clientWidth ? x - 250 : x + 16, box.clientWidth - 234)) + "px";
    card.style.top = y + 16 + "px";
  }
  let under = -1; // the set whose card is shown
  canvas.addEventListener("pointermove", (event) => {
    const i = nearest(event);
    if (i === under) return;
    under = i;
    canvas.style.cursor = i >= 0 ? "pointer" : "";
    choose(i);
    if (i >= 0) show_card(i);
    else card.style.display = "none";
  });
  canvas.addEventListener("pointerleave", () => { card.style.display = "none", under = -1, choose(-1); });
  canvas.addEventListener("click", (event) => {
    const i = nearest(event), link = i >= 0 && figures[i].querySelector("a");
    if (link) window.open(link.href);
  });
  beside((now_kept) => { kept = now_kept, draw(); }, draw_chosen);
})();
