// Owns the tests of the view of an untrusted model: `live_untrusted.mjs VS FOLDER`.
import { existsSync, mkdirSync, readFileSync, readdirSync, symlinkSync, writeFileSync } from "node:fs";
import { session } from "./live_session.mjs";

const [, , vs, folder] = process.argv, inner = `${folder}/inner`, model = `${inner}/stranger.vs`, secret = `${folder}/secret.txt`, made = `${inner}/made.txt`;
mkdirSync(inner, { recursive: true });
writeFileSync(secret, "the secret");
writeFileSync(`${inner}/part.vs`, '(display "a part of its own folder; ")\n');
symlinkSync(secret, `${inner}/link.txt`);
// Each way to a file, and to the environment: the model prints what it gets.
const ways = [`(call-with-input-file "${secret}" read-line)`, '(call-with-input-file "../secret.txt" read-line)', '(call-with-input-file "link.txt" read-line)', '(call-with-input-file "/etc/passwd" read-line)', `(begin (load "${secret}") "loaded")`,
  `(begin (call-with-output-file "${made}" (lambda (p) (display 1 p))) "written")`, `(begin (delete-file "${inner}/part.vs") "deleted")`, '(get-environment-variable "SECRET")', "(length (get-environment-variables))"];
const source = `(define-parameter height 3.0 #:min 1 #:max 9)
(load "part.vs")
${ways.map((way, i) => `(display "${i}:") (write (guard (e (#t 'refused)) ${way})) (newline)`).join("\n")}
(draw (make-box origin (xyz 1 1 height)))
`;
writeFileSync(model, source);
process.env.SECRET = "the secret";
const { server, url, page, test, after, end } = await session(vs, model, ["--untrusted"]);
const address = new URL(url), call = (path, body, method = body === undefined ? "GET" : "POST") => fetch(address.origin + path, { method, body, headers: { "X-VS-Token": address.hash.slice(1) } });
await page.waitForFunction(() => window.live.finished > 0);

await test("an untrusted model runs confined", async (want) => {
  const { good, printed, messages } = await page.evaluate(() => window.live.state);
  want(good, JSON.stringify(messages));
  want(printed.startsWith("a part of its own folder; "), "it cannot read its own folder: " + printed);
  ways.forEach((way, i) => want(new RegExp(`^(.*; )?${i}:(refused|#f|0)$`, "m").test(printed), `${way}: ${printed.split("\n")[i]}`));
  want(!printed.includes("secret") && !existsSync(made) && existsSync(`${inner}/part.vs`), "it got out: " + printed);
  for (const task of readdirSync(`/proc/${server.pid}/task`)) {
    const status = readFileSync(`/proc/${server.pid}/task/${task}/status`, "utf8");
    want(/^NoNewPrivs:\s+1$/m.test(status) && /^Seccomp:\s+2$/m.test(status), `the thread ${/^Name:\s+(.*)$/m.exec(status)[1]} is not confined`);
  }
});

await test("an endless untrusted model ends at its limit of time", async (want) => {
  await after(() => writeFileSync(model, source + "(let spin () (spin))\n"));
  await page.waitForFunction(() => window.live.state.messages.some((m) => /time|limit/i.test(m.message)), null, { timeout: 20000 });
  await after(() => writeFileSync(model, source));
  want((await page.evaluate(() => window.live.state.good)), "it did not heal");
});

await test("the view of an untrusted model neither saves nor runs text", async (want) => {
  const { hash } = await (await call("/source")).json();
  for (const [path, body] of [["/source?hash=" + hash, "(lost)"], ["/try", "(draw (make-sphere origin 9))"], ["/prompt", "(draw (make-sphere origin 9))"], ["/check", "(car)"], ["/export?format=png&id=1", ""]]) {
    const answer = await call(path, body);
    want(answer.status === 403 && /read only/.test(await answer.text()), `${path}: ${answer.status}`);
  }
  want((await call("/export?format=png")).status === 403, "a picture starts POV-Ray");
  want(!(await (await call("/formats")).json()).some((f) => f.worker), "formats of external programs are offered");
  want(readFileSync(model, "utf8") === source, "the file was written");
});

await test("the page of an untrusted model is read only", async (want) => {
  for (const name of ["Save", "As you type", "Pictures", "Write to source"]) want(!(await page.getByRole("button", { name, exact: true }).isVisible()), name + " is offered");
  want(!(await page.locator(".console input").isVisible()), "there is a prompt");
  want(await page.locator(".reads-only").isVisible(), "the page does not say so");
  await page.evaluate(() => { const { view } = window.live.source; view.dispatch({ selection: { anchor: view.state.doc.toString().indexOf("3.0") + 1 } }); view.focus(); });
  await page.keyboard.type("9");
  await page.keyboard.press("Control+ArrowUp");
  await page.keyboard.press("Control+s");
  await page.waitForTimeout(500);
  want(await page.evaluate(() => window.live.source.text) === source && readFileSync(model, "utf8") === source, "its text can be changed");
});

await test("an untrusted model has sliders, exports and a comparison", async (want) => {
  await after(() => page.locator("input[type=range][data-parameter=height]").fill("6"));
  await page.waitForFunction(() => window.visualscheme.model.size[2] === 6);
  const stl = await call("/export?format=stl"), other = await call("/export?format=off&id=1", "height\x1f5.0\x1e");
  want(stl.status === 200 && (await stl.arrayBuffer()).byteLength === 84 + 12 * 50, `stl: ${stl.status}`);
  want(other.status === 200 && /^1 1 5$/m.test(await other.text()), `off: ${other.status}`);
  want(page.troubles.filter((t) => !/403/.test(t)).length === 0, page.troubles.join("; "));
});

await end();
