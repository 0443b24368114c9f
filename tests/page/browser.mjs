// Owns the browser of the tests: Debian's Chromium driven by playwright-core, with WebGL in software.
import { chromium } from "playwright-core";
import { existsSync } from "node:fs";
import { tmpdir } from "node:os";

export const path = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);

export async function browser() {
  return chromium.launch({
    executablePath: path, headless: true,
    env: { ...process.env, HOME: process.env.HOME ?? tmpdir() }, // Chromium does not start without a home to write to
    args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader", "--hide-scrollbars"],
  });
}

// Returns a page with the viewer, once its first picture is complete; if nothing is drawn, once the viewer exists.
// page.troubles collects the errors of the page's scripts.
export async function open(context, url, settle = false, drawn = true) {
  const page = await context.newPage();
  page.troubles = [];
  page.on("pageerror", (error) => page.troubles.push(String(error)));
  page.on("console", (message) => { if (message.type() === "error") page.troubles.push(message.text()); });
  await page.goto(url, { waitUntil: "load", timeout: 120000 });
  await page.waitForFunction((drawn) => window.visualscheme && (!drawn || window.visualscheme.stage.drawCalls > 0), drawn, { timeout: 120000 });
  if (settle) await settled(page);
  return page;
}

export async function settled(page) {
  await page.waitForFunction(() => window.visualscheme.stage.finished, null, { timeout: 240000 });
}
