// Owns the test of joints in the live view, in a browser: a slider turns an assembly about its joint, and the joint of a part
// that it carries. `live_joint.mjs VS FOLDER`.
import { mkdirSync, writeFileSync } from "node:fs";
import { session } from "./live_session.mjs";

const [, , vs, folder] = process.argv, model = `${folder}/crane.vs`;
const ARM = 4, THICK = 0.2;
mkdirSync(folder, { recursive: true });
writeFileSync(model, `(import (visualscheme) (visualscheme assembly))
(define-parameter lift 0.0 #:min 0 #:max 1.5)
(define-parameter reach 0.0 #:min 0 #:max 3)
(define tip (part "tip" (color "firebrick" (make-box (xyz 0 0 0) (xyz ${ARM} ${THICK} ${THICK})))))
(define out (joint tip 'prismatic (list origin ux) reach #:range '(0 3)))
(define arm (part "arm" (color "silver" (make-box (xyz 0 ${-THICK} 0) (xyz ${ARM} 0 ${THICK})))))
(draw (joint (list arm out) 'revolute (list origin (- uy)) lift #:range '(0 1.5)))
`);
const { page, test, after, end } = await session(vs, model);
const slide = (name, value) => after(() => page.locator(`input[type=range][data-parameter=${name}]`).fill(String(value)));

// The far upper corner of the tip is the highest point of the assembly, the far lower corner its outermost one.
async function shows(want, lift, reach) {
  const long = ARM + reach, high = long * Math.sin(lift) + THICK * Math.cos(lift), wide = long * Math.cos(lift);
  const seen = () => { const m = window.visualscheme.model; return [m.box.max[2] + m.middle[2], m.box.max[0] + m.middle[0]]; };
  await page.waitForFunction((high) => {
    const m = window.visualscheme.model;
    return Math.abs(m.box.max[2] + m.middle[2] - high) < 1e-4;
  }, high, { timeout: 10000 }).catch(() => {});
  const [z, x] = await page.evaluate(seen);
  want(Math.abs(z - high) < 1e-4 && Math.abs(x - wide) < 1e-4, `height and reach are ${z} and ${x}, not ${high} and ${wide}`);
}
await test("sliders turn an assembly about its joint, and slide the part that it carries", async (want) => {
  await page.waitForFunction(() => window.live.finished > 0);
  await shows(want, 0, 0);
  for (const lift of [0.5, 1.2]) await slide("lift", lift), await shows(want, lift, 0);
  await slide("reach", 2.5);
  await shows(want, 1.2, 2.5);
  await slide("lift", 0.1);
  await shows(want, 0.1, 2.5);
  want(page.troubles.length === 0, page.troubles.join("; "));
});
await end();
