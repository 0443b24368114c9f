// Runs the page in one file: shows its scene, and .x3d files that the user drops on it.
import { Viewer } from "./viewer.js";
import { readPacked, decode64 } from "./packed.js";
import { modelFromPacked } from "./model.js";
import { modelFromX3D } from "./x3d.js";
import { el } from "./dom.js";

const viewer = new Viewer(document.getElementById("viewer"));
viewer.addHelp([["Open", "drop an .x3d file here"]]);
window.visualscheme = viewer; // For tests, and for use in the console.
const scene = document.getElementById("scene");
viewer.show(modelFromPacked(readPacked(decode64(scene.textContent.trim()))));
scene.remove();
// The page contains only the viewer, so the viewer gets all keys from the start.
addEventListener("keydown", (event) => {
  if (event.target !== document.body) return;
  viewer.canvas.focus();
  viewer.canvas.dispatchEvent(new KeyboardEvent("keydown", event));
});

const drop = el("div", { class: "drop", hidden: true }, "Drop an .x3d file");
viewer.root.append(drop);
addEventListener("dragover", (event) => { event.preventDefault(); drop.hidden = false; });
addEventListener("dragleave", (event) => { if (!event.relatedTarget) drop.hidden = true; });
addEventListener("drop", async (event) => {
  event.preventDefault();
  drop.hidden = true;
  const file = event.dataTransfer.files[0];
  if (!file) return;
  try {
    const bytes = await file.arrayBuffer();
    viewer.show(new TextDecoder().decode(bytes.slice(0, 4)) === "VSX1" ? modelFromPacked(readPacked(bytes)) : modelFromX3D(new TextDecoder().decode(bytes), file.name));
  } catch (error) {
    viewer.say(`${file.name} cannot be shown: ${error.message}`);
    alert(`${file.name} cannot be shown: ${error.message}`);
  }
});
