// Makes a picture of a page's model in black on white, with the camera of the .x3d scene of the same drawing:
// `silhouette.mjs FILE.html FILE.x3d PIXELS OUT.png`. tests/cross.sh compares it. The page frames the operands of cuts,
// the scene frames the material that remains, so their own cameras may differ.
import { readFileSync } from "node:fs";
import { browser, open } from "./browser.mjs";

const [, , file, scene, pixels, out] = process.argv, chromium = await browser();
const [x, z, y] = /<Viewpoint[^>]* position='([^']*)'/.exec(readFileSync(scene, "utf8"))[1].split(" ").map(Number); // Y points up
try {
  const context = await chromium.newContext({ viewport: { width: 200, height: 200 } }); // the page's own first picture, with light and shadow, is small
  const page = await open(context, "file://" + file);
  await page.evaluate(() => { window.visualscheme.stage.options.refine = false; });
  await page.setViewportSize({ width: Number(pixels), height: Number(pixels) });
  await page.waitForFunction((n) => window.visualscheme.stage.canvas.width === n, Number(pixels), { timeout: 60000 });
  await page.evaluate((eye) => {
    const { stage, control, model, root } = window.visualscheme, view = model.view;
    for (const node of root.children) if (node !== stage.canvas) node.style.display = "none";
    stage.options.refine = false;
    stage.dome.visible = false;
    stage.scene.background = null;
    stage.renderer.setClearColor(0xffffff, 1);
    stage.batches.traverse((o) => {
      if (o.userData.edges) o.visible = false; // half of a line's width lies beside the surface
      if (!o.material) return;
      o.material.onBeforeCompile = (shader) => { shader.fragmentShader = shader.fragmentShader.replace(/}\s*$/, "gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0); }"); };
      o.material.needsUpdate = true;
      o.material.transparent = false;
    });
    // With the camera of an X3D viewer: from far away with a long lens.
    const s = control.start();
    s.parallel = false;
    s.angle = 0.1;
    s.distance = view.width / 2 / Math.tan(0.05);
    const back = [0, 1, 2].map((k) => view.eye[k] - view.target[k]), length = Math.hypot(...back);
    s.target.set(...eye.map((c, k) => c - back[k] / length * s.distance - model.middle[k]));
    Object.assign(control.state, s);
    control.apply();
    stage.draw();
  }, [x, -y, z]);
  await page.waitForFunction(() => !window.visualscheme.stage.dirty && !window.visualscheme.stage.owed, null, { timeout: 120000 });
  await page.waitForTimeout(300);
  await page.screenshot({ path: out, timeout: 120000 }); // drawn in software: a busy machine takes long
} finally {
  await chromium.close();
}
