// Owns the test of photographs on surfaces in other viewers: `photographs.mjs FOLDER` with FOLDER/wall.glb, shown by
// three.js' loader, and FOLDER/wall.x3d, shown by X_ITE. The wall is two metres wide, its picture one: dark, light,
// dark, light from left to right. SHOTS=FOLDER keeps the screenshots there. Prints lines in the form that tests/run.sh
// reads.
import { readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";
import { browser } from "./browser.mjs";

const folder = process.argv[2], chromium = await browser(), WIDTH = 400, HEIGHT = 400;

// In the page: the luminance of a screenshot (PNG, base 64) at four points of the wall, which covers the fraction
// `share` of the width.
async function lightAt([png, share]) {
  const bitmap = await createImageBitmap(await (await fetch("data:image/png;base64," + png)).blob()), canvas = new OffscreenCanvas(bitmap.width, bitmap.height), to = canvas.getContext("2d");
  to.drawImage(bitmap, 0, 0);
  return [1, 3, 5, 7].map((eighth) => {
    const [r, g, b] = to.getImageData(Math.round(bitmap.width * (0.5 + share * (eighth / 8 - 0.5))), Math.round(bitmap.height * 0.55), 1, 1).data;
    return Math.round(0.2126 * r + 0.7152 * g + 0.0722 * b);
  });
}

async function judge(name, page, share) {
  const shot = await page.screenshot({ timeout: 120000 }), light = await page.evaluate(lightAt, [shot.toString("base64"), share]), [a, b, c, d] = light;
  if (process.env.SHOTS) writeFileSync(`${process.env.SHOTS}/${name}.png`, shot);
  const fits = b > 2 * a && b > 2 * c && d > 2 * a && d > 2 * c && Math.abs(a - c) < 12 && Math.abs(b - d) < 12;
  console.log(`${fits ? "ok" : "not ok"} page/photographs:${name}`);
  if (!fits) console.log(`    the wall is as light as ${light} from left to right: dark, light, dark, light is wanted`);
}

// In the page: the .glb from its front, by three.js.
const viewer = `import * as THREE from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
window.show = async (base64) => {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)), scene = new THREE.Scene(), renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
  const model = (await new GLTFLoader().parseAsync(bytes.buffer, "")).scene, box = new THREE.Box3().setFromObject(model), size = box.getSize(new THREE.Vector3()), middle = box.getCenter(new THREE.Vector3());
  const half = size.x / 2, camera = new THREE.OrthographicCamera(-half, half, half, -half, 0.01, 10 * size.x);
  camera.position.set(middle.x, middle.y, box.max.z + 5 * size.x);
  camera.lookAt(middle);
  scene.add(model, new THREE.AmbientLight(0xffffff, 3));
  renderer.setSize(${WIDTH}, ${HEIGHT});
  document.body.append(renderer.domElement);
  renderer.render(scene, camera);
};`;

try {
  const context = await chromium.newContext({ viewport: { width: WIDTH, height: HEIGHT } });
  const three = await context.newPage(), bundle = await build({ stdin: { contents: viewer, resolveDir: process.cwd() }, bundle: true, write: false, format: "iife", logLevel: "error" });
  await three.setContent("<style>body{margin:0}</style>");
  await three.addScriptTag({ content: bundle.outputFiles[0].text });
  await three.evaluate((text) => window.show(text), readFileSync(`${folder}/wall.glb`).toString("base64"));
  await judge("glb in three.js", three, 1);

  const xite = await context.newPage(), html = `<!DOCTYPE html><style>body{margin:0}x3d-canvas{display:block;width:${WIDTH}px;height:${HEIGHT}px}</style><script src="/x_ite.min.js"></script><x3d-canvas></x3d-canvas>`;
  await xite.route("http://viewer.test/**", (route) => {
    const path = new URL(route.request().url()).pathname;
    return path === "/" ? route.fulfill({ contentType: "text/html", body: html }) : route.fulfill({ path: "tests/node_modules/x_ite/dist" + path });
  });
  await xite.goto("http://viewer.test/");
  await xite.waitForFunction(() => document.querySelector("x3d-canvas").browser);
  await xite.evaluate(async (text) => {
    const b = document.querySelector("x3d-canvas").browser;
    for (const name of ["SplashScreen", "Notifications", "ContextMenu"]) b.setBrowserOption(name, false);
    await b.loadComponents(b.getProfile("Full"));
    await b.replaceWorld(await b.createX3DFromString(text));
    await new Promise((go) => setTimeout(go, 2000)); // pictures are decoded beside
  }, readFileSync(`${folder}/wall.x3d`, "utf8"));
  await judge("x3d in X_ITE", xite, 2 / (2.16 * 3 / 4)); // a lens of 100 mm at 6 m shows 2.16 m of a picture of 4:3; X_ITE fits its height, the shorter side
} catch (error) {
  console.log("not ok page/photographs");
  console.log("    " + String(error.stack || error));
} finally {
  await chromium.close();
}
