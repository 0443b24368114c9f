// Owns the test of frames in the live view, in a browser: a slider moves the deformed shape and the lines of moments.
// `live_frames.mjs VS FOLDER`.
import { mkdirSync, writeFileSync } from "node:fs";
import { session } from "./live_session.mjs";

const [, , vs, folder] = process.argv, model = `${folder}/frame.vs`;
const LENGTH = 4, FORCE = 1000, STIFFNESS = 210e9 * Math.PI * (0.1 ** 4 - 0.09 ** 4) / 64, PER_NM = 1e-5; // a cantilever
const sag = FORCE * LENGTH ** 3 / 3 / STIFFNESS, moment = FORCE * LENGTH;
mkdirSync(folder, { recursive: true });
writeFileSync(model, `(import (visualscheme) (visualscheme analysis))
(define-parameter factor 10.0 #:min 1 #:max 100)
(define r (frame-solve (frame (list origin (xyz ${LENGTH} 0 0)) '((1 2)) #:supports '(1)
  #:sections (tube-section 0.1 0.005) #:loads (list (list 2 (vxyz 0 0 ${-FORCE}))))))
(draw (color "steelblue" (deformed r #:factor factor)))
(draw (color "red" (moment-lines r #:factor (* ${PER_NM} factor))))
`);
const { page, test, after, end } = await session(vs, model);
const ends = () => page.evaluate(() => { const m = window.visualscheme.model; return [m.box.min[2] + m.middle[2], m.box.max[2] + m.middle[2]]; });

// The shape hangs below the axis by the factor times its sag; the lines stand above it by the factor times the moment.
async function shows(want, factor) {
  const wanted = [-factor * sag, factor * PER_NM * moment];
  const near = (seen) => seen.every((z, i) => Math.abs(z - wanted[i]) < 1e-4 * Math.abs(wanted[i]));
  await page.waitForFunction((high) => Math.abs(window.visualscheme.model.box.max[2] + window.visualscheme.model.middle[2] - high) < 1e-4 * high, wanted[1], { timeout: 10000 }).catch(() => {});
  const seen = await ends();
  want(near(seen), `heights are ${seen}, not ${wanted}`);
}
await test("a slider moves the deformed shape and the lines of moments", async (want) => {
  await page.waitForFunction(() => window.live.finished > 0);
  await shows(want, 10);
  for (const factor of [40, 100, 1]) {
    await after(() => page.locator("input[type=range][data-parameter=factor]").fill(String(factor)));
    await shows(want, factor);
  }
  want(page.troubles.length === 0, page.troubles.join("; "));
});
await end();
