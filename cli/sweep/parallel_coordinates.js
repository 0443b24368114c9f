// Draws the parallel coordinates of a sweep above its pictures: an axis for each parameter and number, a line for each
// set. Dragging along an axis keeps the sets in that range; a click on its name gives the lines the colours of its values.
// The body's data-axes has the names of the axes; each figure's data-values has its values in that order. The object
// `sweep` is for scatter.js, which draws beside: null if there is nothing to draw.
"use strict";
const sweep = (() => {
  const names = JSON.parse(document.body.dataset.axes || "[]"), figures = [...document.querySelectorAll("figure")];
  if (names.length < 2 || figures.length < 2) return null;
  const rows = figures.map((figure) => JSON.parse(figure.dataset.values));
  const axes = names.map((name, k) => {
    const values = rows.map((row) => row[k]), known = values.filter((v) => v !== null);
    const numeric = known.every((v) => typeof v === "number"), texts = numeric ? [] : [...new Set(known.map(String))];
    const places = values.map((v) => (v === null ? NaN : numeric ? v : texts.indexOf(String(v))));
    const finite = places.filter((p) => !Number.isNaN(p));
    const least = finite.reduce((a, b) => Math.min(a, b), Infinity), most = finite.reduce((a, b) => Math.max(a, b), -Infinity);
    return { name, texts, places, least, most, kept: null, x: 0 };
  });
  const panel = document.createElement("div"), box = document.createElement("div"), canvas = document.createElement("canvas");
  const bar = document.createElement("p"), count = document.createElement("span"), reset = document.createElement("button");
  panel.id = "panel", box.id = "parallel";
  panel.style.cssText = "grid-column:1/-1;background:#fff;z-index:1;display:flex;flex-wrap:wrap;gap:24px;top:0";
  box.style.cssText = "flex:3 1 300px;min-width:0";
  canvas.style.cssText = "width:100%;height:260px;display:block;touch-action:none";
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "Parallel coordinates of " + names.join(", "));
  count.setAttribute("role", "status");
  reset.textContent = "Show all";
  bar.append(count, " ", reset);
  box.append(canvas, bar);
  panel.append(box);
  document.body.prepend(panel);
  const top = 34, bottom = 24, height = 260;
  let coloured = axes.length - 1, chosen = -1, drag = null, drawn_beside = () => {}, chosen_beside = () => {};
  const still = document.createElement("canvas"); // the drawing without the chosen line

  const share = (axis, i) => (axis.most > axis.least ? (axis.places[i] - axis.least) / (axis.most - axis.least) : 0.5);
  const down = (axis, i) => height - bottom - share(axis, i) * (height - top - bottom);
  const is_kept = (i) => axes.every((a) => !a.kept || (down(a, i) >= a.kept[0] && down(a, i) <= a.kept[1]));
  const label = (axis, place) => (axis.texts.length ? axis.texts[Math.round(place)] : String(Number(place.toPrecision(4))));
  const colour = (i) => `hsl(${Math.round(240 - 240 * (share(axes[coloured], i) || 0))} 75% 45%)`;

  function line(to, i) {
    to.beginPath();
    let begun = false;
    for (const axis of axes) {
      if (Number.isNaN(axis.places[i])) continue;
      if (begun) to.lineTo(axis.x, down(axis, i));
      else to.moveTo(axis.x, down(axis, i)), begun = true;
    }
    to.stroke();
  }
  function draw() {
    panel.style.position = window.innerWidth < 900 ? "static" : "sticky";
    const width = box.clientWidth, scale = window.devicePixelRatio || 1, to = canvas.getContext("2d");
    canvas.width = width * scale, canvas.height = height * scale;
    to.scale(scale, scale);
    to.font = "12px sans-serif", to.textAlign = "center";
    axes.forEach((axis, k) => { axis.x = 60 + (k * (width - 120)) / (axes.length - 1); });
    const kept = rows.map((row, i) => is_kept(i)), shown = kept.filter(Boolean).length;
    to.globalAlpha = 0.12, to.strokeStyle = "#888";
    rows.forEach((row, i) => { if (!kept[i]) line(to, i); });
    to.globalAlpha = Math.max(0.15, Math.min(0.8, 60 / shown));
    rows.forEach((row, i) => { if (kept[i]) to.strokeStyle = colour(i), line(to, i); });
    to.globalAlpha = 1;
    axes.forEach((axis, k) => {
      to.strokeStyle = "#333";
      to.beginPath(), to.moveTo(axis.x, top), to.lineTo(axis.x, height - bottom), to.stroke();
      to.fillStyle = "#000", to.fillText((k === coloured ? "\u25cf " : "") + axis.name, axis.x, 12);
      if (Number.isFinite(axis.least)) {
        to.fillStyle = "#444";
        to.fillText(label(axis, axis.most), axis.x, 28), to.fillText(label(axis, axis.least), axis.x, height - 8);
      }
      if (axis.kept) to.fillStyle = "rgba(0,90,200,.2)", to.fillRect(axis.x - 9, axis.kept[0], 18, axis.kept[1] - axis.kept[0]);
    });
    figures.forEach((figure, i) => {
      if ((figure.style.display === "") !== kept[i]) figure.style.display = kept[i] ? "" : "none";
    });
    count.textContent = `${shown} of ${rows.length} sets`;
    still.width = canvas.width, still.height = canvas.height;
    still.getContext("2d").drawImage(canvas, 0, 0);
    drawn_beside(kept);
    draw_chosen();
  }
  function draw_chosen() {
    const to = canvas.getContext("2d"), scale = window.devicePixelRatio || 1;
    to.setTransform(1, 0, 0, 1, 0, 0);
    to.clearRect(0, 0, canvas.width, canvas.height), to.drawImage(still, 0, 0);
    to.scale(scale, scale);
    if (chosen >= 0) to.lineWidth = 3, to.strokeStyle = "#000", line(to, chosen);
    chosen_beside(chosen);
  }
  function choose(i) { if (i !== chosen) chosen = i, draw_chosen(); }
  const place = (event) => { const at = canvas.getBoundingClientRect(); return [event.clientX - at.left, event.clientY - at.top]; };
  const nearest = (x) => axes.reduce((best, axis) => (Math.abs(axis.x - x) < Math.abs(best.x - x) ? axis : best));
  canvas.addEventListener("pointerdown", (event) => {
    const [x, y] = place(event), axis = nearest(x);
    canvas.setPointerCapture(event.pointerId);
    if (y < 18) coloured = axes.indexOf(axis), draw();
    else drag = { axis, from: y };
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!drag) return;
    const y = place(event)[1];
    drag.axis.kept = Math.abs(y - drag.from) < 4 ? null : [Math.min(y, drag.from), Math.max(y, drag.from)];
    draw();
  });
  canvas.addEventListener("pointerup", () => {
    if (drag && !drag.axis.kept) draw();
    drag = null;
  });
  reset.addEventListener("click", () => { for (const axis of axes) axis.kept = null; draw(); });
  figures.forEach((figure, i) => {
    figure.addEventListener("pointerenter", () => choose(i));
    figure.addEventListener("pointerleave", () => choose(-1));
  });
  window.addEventListener("resize", draw);
  draw();
  return {
    panel, axes, figures, share, label, colour, choose,
    // Calls `drawing` with the list of kept sets when it changes, and `choice` with the number of the chosen set or -1.
    beside(drawing, choice) { drawn_beside = drawing, chosen_beside = choice, draw(); },
  };
})();
