// Owns the tests of the live view's server, by HTTP alone: `live.mjs VS FOLDER`. Prints lines in the form that
// tests/run.sh reads.
import { spawn } from "node:child_process";
import { existsSync, mkdirSync, writeFileSync, readFileSync, readdirSync, symlinkSync, truncateSync } from "node:fs";
import http from "node:http";
import net from "node:net";
import { patience } from "./patience.mjs";

const [, , vs, folder] = process.argv, model = `${folder}/model.vs`, only = process.env.ONLY || "";
const source = `; a comment with "quotes" and (brackets
(define-parameter height 3.0 #:min 1 #:max 9 #:label "<b>height</b>") (define other 3.0)
(display "built")
(draw (make-box (xyz 0 0 0) (xyz 1 2 height)) (make-sphere (xyz 5 0 0) 1))
(draw (layer "<script>" (make-cylinder (xyz 9 0 0) 2 1)))
`;
writeFileSync(model, source);

const server = spawn(vs, ["view", "-q", model], { stdio: ["ignore", "pipe", "pipe"] });
const address = await new Promise((go) => server.stdout.once("data", (d) => go(String(d).trim())));
const url = new URL(address), token = url.hash.slice(1), port = Number(url.port);

// Node's own request, for headers that fetch refuses.
function ask(path, { method = "GET", headers = { "X-VS-Token": token }, body } = {}) {
  return new Promise((go, no) => {
    const request = http.request({ host: "127.0.0.1", port, path, method, headers }, (answer) => {
      const parts = [];
      answer.on("data", (d) => parts.push(d));
      answer.on("end", () => go({ status: answer.statusCode, headers: answer.headers, body: Buffer.concat(parts) }));
    });
    request.on("error", no);
    request.end(body);
  });
}

const states = [], waiting = [];
const stream = http.get({ host: "127.0.0.1", port, path: "/events", headers: { "X-VS-Token": token } }, (answer) => {
  let rest = "";
  answer.setEncoding("utf8");
  answer.on("data", (text) => {
    const blocks = (rest + text).split("\n\n");
    rest = blocks.pop();
    for (const block of blocks) {
      const data = /^event: state\ndata: (.*)$/m.exec(block);
      if (!data) continue;
      states.push(JSON.parse(data[1]));
      for (const w of waiting.splice(0)) w();
    }
  });
});
stream.on("error", () => {});
async function until(test, what) {
  const end = Date.now() + 30000;
  for (let from = 0; ;) {
    for (; from < states.length; from++) if (test(states[from])) return states.splice(0, from + 1).pop();
    if (Date.now() > end) throw new Error("never came: " + what);
    await Promise.race([new Promise((go) => waiting.push(go)), new Promise((go) => setTimeout(go, 500))]);
  }
}

async function test(name, body) {
  if (!("live/" + name).includes(only)) return;
  const faults = [];
  try {
    await body((ok, what) => { if (!ok) faults.push(what); });
  } catch (error) {
    faults.push(String(error.stack || error));
  }
  console.log((faults.length ? "not ok live/" : "ok live/") + name);
  for (const fault of faults) console.log("    " + fault);
}

try {
  await test("first state", async (check) => {
    const s = await until((x) => x.version > 0, "the first state");
    check(s.good && s.printed === "built", JSON.stringify(s));
    check(s.parameters.length === 1 && s.parameters[0].name === "height" && s.parameters[0].label === "<b>height</b>" && s.parameters[0].max === 9 && s.parameters[0].at.line === 2, JSON.stringify(s.parameters));
    const scene = await ask("/scene");
    check(scene.status === 200 && scene.body.subarray(0, 4).toString() === "VSL1", "the scene is no scene");
  });

  await test("who may ask", async (check) => {
    const with_ = (more) => ({ headers: { "X-VS-Token": token, ...more } });
    for (const [what, status, options] of [
      ["no token", 403, { headers: {} }], ["a wrong token", 403, { headers: { "X-VS-Token": token.slice(0, -1) + (token.endsWith("0") ? "1" : "0") } }], ["a short token", 403, { headers: { "X-VS-Token": "" } }],
      ["a foreign host", 403, with_({ Host: "evil.example" })], ["a host like ours", 403, with_({ Host: `127.0.0.1:${port}.evil.example` })], ["a foreign origin", 403, with_({ Origin: "http://evil.example" })],
      ["no origin's name", 403, with_({ Origin: "null" })], ["our own origin", 200, with_({ Origin: `http://127.0.0.1:${port}` })]]) {
      const answer = await ask("/source", options);
      check(answer.status === status, `${what}: ${answer.status}`);
    }
    const page = await ask("/", { headers: {} });
    check(page.status === 200 && !page.body.includes(token), "the page itself holds the token, or is not there");
    check(/default-src 'none'/.test(page.headers["content-security-policy"]) && /script-src 'self';/.test(page.headers["content-security-policy"]), "the policy: " + page.headers["content-security-policy"]);
    check(page.headers["referrer-policy"] === "no-referrer" && page.headers["x-content-type-options"] === "nosniff", "headers are missing");
    const rebound = await ask("/", { headers: { Host: "evil.example" } });
    check(rebound.status === 403, "a foreign name gets the page");
    symlinkSync("/etc/passwd", `${folder}/link`);
    for (const path of ["/../model.vs", "/model.vs", "/link", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/..%2f..%2fetc/passwd", "/live.js/../../x", "/\\..\\x"]) check((await ask(path)).status === 404, path + " is served");
    check((await ask("/source", { method: "DELETE" })).status === 404, "DELETE does something");
    check((await ask("/set?name=height", { method: "POST", body: Buffer.alloc(17 << 20) }).catch(() => ({ status: 413 }))).status === 413, "a body without end is taken");
  });

  await test("save, error and heal", async (check) => {
    const before = (await ask("/scene")).body.length;
    writeFileSync(model, source + "(car 5)\n");
    const bad = await until((s) => !s.good, "an error");
    check(bad.messages.length === 1 && bad.messages[0].at.line === 6 && bad.messages[0].source === "(car 5)", JSON.stringify(bad.messages));
    check((await ask("/scene")).body.length === before, "the last good model is gone");
    writeFileSync(model, source);
    const good = await until((s) => s.good, "its healing");
    check(good.messages.length === 0, "messages stay");
  });

  // Many editors empty a file before they write it, and on a busy machine there may be a delay in between: the view
  // must not show the empty text, at any moment of noticing and reading the model.
  await test("a file that is emptied for a moment", async (check) => {
    let shown = 0;
    for (let delay = 0; delay < 40; delay++) {
      writeFileSync(model, source.replace("height 3.0", `height 3.${100 + delay}`));
      await new Promise((go) => setTimeout(go, delay));
      truncateSync(model);
      const emptied = Date.now();
      await new Promise((go) => setTimeout(go, 60));
      writeFileSync(model, source.replace("height 3.0", `height 4.${100 + delay}`));
      const short = Date.now() - emptied < 400; // For half a second it is nobody's text.
      await until((s) => (shown += short && s.good && s.parameters.length === 0, s.good && Number(s.parameters[0]?.default) === Number(`4.${100 + delay}`)), "the last text");
    }
    check(shown === 0, `shown ${shown} times`);
    writeFileSync(model, source);
    await until((s) => s.good && s.parameters[0]?.default === "3.0", "the first text");
  });

  await test("only what changed travels", async (check) => {
    const many = source + "(draw (map (lambda (i) (make-superellipsoid (+ 0.3 (* 0.1 i)) 0.8 1)) (iota 12)))\n";
    writeFileSync(model, many);
    const first = await until((s) => s.good, "a large scene"), whole = (await ask("/scene")).body.length;
    writeFileSync(model, many + "(draw (make-box (xyz 3 0 0) (xyz 3.5 1 1)))\n");
    await until((s) => s.good && s.version > first.version, "one box more");
    const part = (await ask("/scene?have=" + first.version)).body.length;
    check(whole > 200000 && part < 0.4 * whole, `${part} of ${whole} bytes`);
    const nothing = (await ask("/scene?have=" + (first.version + 1))).body.length;
    check(nothing < 0.02 * whole, `${nothing} bytes for nothing`);
    check((await ask("/scene?have=99999")).body.length === (await ask("/scene")).body.length, "a version that never was is not sent whole");
    writeFileSync(model, source);
    await until((s) => s.good && s.version > first.version + 1, "the first text");
  });

  await test("parameters", async (check) => {
    for (let i = 0; i < 40; i++) await ask("/set?name=height", { method: "POST", body: String(2 + i / 10) });
    const s = await until((x) => x.parameters[0]?.value === "5.9", "the last value");
    check(s.good && s.parameters[0].default === "3.0", JSON.stringify(s.parameters));
    await ask("/set?name=height", { method: "POST", body: "99" });
    const bad = await until((x) => !x.good, "what is out of range");
    check(bad.messages.length > 0, "nobody says why");
    await ask("/set?name=height", { method: "POST", body: "(exit 3)" });
    await ask("/set?name=height", { method: "POST", body: "4" });
    await until((x) => x.good && x.parameters[0].value.startsWith("4"), "another value");
  });

  await test("the source is saved, never over a newer one", async (check) => {
    const { hash, text } = JSON.parse((await ask("/source")).body);
    check(text === source, "another text came");
    const changed = text.replace("3.0 #:min", "7.5 #:min");
    const saved = await ask("/source?hash=" + hash, { method: "POST", body: changed });
    check(saved.status === 200 && readFileSync(model, "utf8") === changed, "it was not written");
    check((await ask("/source?hash=" + hash, { method: "POST", body: "(lost)" })).status === 409 && readFileSync(model, "utf8") === changed, "a newer file was written over");
    check((await ask("/source", { method: "POST", body: "(lost)" })).status === 400, "it was written over nothing known");
    await until((s) => s.good && s.parameters[0].default === "7.5", "the saved text's run");
  });

  await test("how a name is called", async (check) => {
    const told = await (async () => JSON.parse((await ask("/name?of=make-cylinder")).body))();
    check(/\(make-cylinder /.test(told.call) && told.doc !== undefined, JSON.stringify(told));
    check((await ask("/name?of=no-such-name")).body.toString() === "{}", "a name that is none");
    check((await ask("/name?of=make-cylinder", { headers: {} })).status === 403, "without the token");
  });

  await test("prompt", async (check) => {
    await ask("/prompt", { method: "POST", body: "(* 6 other)" });
    check((await until((s) => s.values !== "", "a value")).values.trim() === "18.0", "another value");
    await ask("/prompt", { method: "POST", body: "(begin (draw (make-sphere (xyz 0 9 0) 1)) (car 5))" });
    const s = await until((x) => x.messages.length > 0, "an error");
    check(s.good && s.asked.startsWith("(begin (draw") && s.version > 1, "an error of what was typed is told as the model's: " + JSON.stringify(s).slice(0, 300));
  });

  await test("stop", async (check) => {
    await ask("/prompt", { method: "POST", body: "(let loop () (loop))" });
    await new Promise((go) => setTimeout(go, 400));
    const from = Date.now();
    await ask("/stop", { method: "POST" });
    const s = await until((x) => x.stopped, "the end of a loop");
    check(Date.now() - from < patience(5000) && s.asked === "(let loop () (loop))", `it took ${Date.now() - from} ms`);
    check(s.good, "what was typed has taken the model away");
    await ask("/prompt", { method: "POST", body: "'alive" });
    check((await until((x) => x.values !== "", "life after it")).values.trim() === "alive", "it does not live on");
  });

  await test("outputs", async (check) => {
    for (const format of ["stl", "x3d", "html", "glb", "pov", "scad"]) {
      const answer = await ask("/export?format=" + format);
      check(answer.status === 200 && answer.body.length > 100, `${format}: ${answer.status}, ${answer.body.length} bytes`);
    }
    check((await ask("/export?format=exe")).status === 400, "there is a format exe");
  });

  await test("vanishing and idle clients", async (check) => {
    for (let i = 0; i < 60; i++) {
      const socket = net.connect(port, "127.0.0.1");
      socket.on("error", () => {});
      socket.write(i % 2 ? "GET /events HTTP/1.1\r\nHost: 127.0.0.1:" + port + "\r\nX-VS-Token: " + token + "\r\n\r\n" : "GET /so");
      setTimeout(() => socket.destroy(), 30);
      await new Promise((go) => setTimeout(go, 5));
    }
    await new Promise((go) => setTimeout(go, 300));
    let answer = null;
    for (let i = 0; i < 40 && answer?.status !== 200; i++) {
      answer = await ask("/source").catch(() => null);
      if (answer?.status !== 200) await new Promise((go) => setTimeout(go, 500));
    }
    check(answer?.status === 200, "nobody is served any more");
  });

  // More clients than there are connections; each sends a byte before the server would close it as silent.
  await test("slow clients", async (check) => {
    const slow = Array.from({ length: 60 }, (_, i) => {
      const socket = net.connect(port, "127.0.0.1");
      for (const event of ["error", "close"]) socket.on(event, () => clearInterval(socket.drip));
      socket.write(i % 3 ? "G" : `POST /check HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\nX-VS-Token: ${token}\r\nContent-Length: 9999\r\n\r\n(`);
      socket.drip = setInterval(() => socket.write("E"), 500);
      return socket;
    });
    for (let i = 0; i < 4; i++) {
      await new Promise((go) => setTimeout(go, 1000));
      const answer = await Promise.race([ask("/source").catch((e) => ({ status: e.code })), new Promise((go) => setTimeout(go, 5000, { status: "no answer in 5 s" }))]);
      check(answer.status === 200, `beside slow clients: ${answer.status}`);
    }
    const left = slow.filter((socket) => !socket.destroyed).length;
    check(left > 0 && left <= 12, `${left} of the slow are served`);
    for (const socket of slow) clearInterval(socket.drip), socket.destroy();
  });

  await test("with other values, beside the session", async (check) => {
    const send = (values, more = "") => ask("/export?format=off&id=t" + more, { method: "POST", body: Object.entries(values).map(([n, v]) => n + "\x1f" + v + "\x1e").join("") });
    const tall = (body) => Math.max(...body.toString().split("\n").slice(2).map((l) => l.split(" ")).filter((l) => l.length === 3).map((l) => Number(l[2])));
    const [low, high, none] = await Promise.all([send({ height: "1.5" }), send({ height: "8.5" }), send({})]);
    check(low.status === 200 && tall(low.body) === 2, `${low.status} ${tall(low.body)}`);
    check(high.status === 200 && tall(high.body) === 8.5, `${high.status} ${tall(high.body)}`);
    check(none.status === 200 && tall(none.body) === 7.5, `${none.status} ${tall(none.body)}`);
    const bad = await send({ height: "99" });
    check(bad.status === 422 && /parameter height must be from 1 to 9/.test(bad.body), `${bad.status} ${bad.body}`);
    check((await ask("/export?format=exe", { method: "POST", body: "" })).status === 400, "there is a format exe");
    for (const body of ["height", "height\x1f", "\x1e\x1f", "height\x1e5\x1f"]) check((await ask("/export?format=off&id=t", { method: "POST", body })).status === 200, "no values: " + JSON.stringify(body));
    writeFileSync(model, source + "(let spin () (spin))\n");
    const long = send({}, "1");
    await new Promise((go) => setTimeout(go, 700));
    await ask("/cancel?id=t1", { method: "POST" });
    const ended = await Promise.race([long, new Promise((go) => setTimeout(() => go({ status: "never" }), 8000))]);
    check(ended.status === 499, `cancelled: ${ended.status}`);
    await ask("/stop", { method: "POST" });
    await until((x) => x.stopped, "the end of the session's loop");
    writeFileSync(model, source.replace("3.0 #:min", "7.5 #:min"));
    await until((x) => x.good, "its healing");
  });

  await test("a value of the command line stays, also where the source says the same", async (check) => {
    const path = `${folder}/held.vs`, text = "(define-parameter height 3.0)\n(draw (make-box origin (xyz 1 1 height)))\n";
    writeFileSync(path, text);
    const held = spawn(vs, ["view", "-q", "-D", "height=3.0", path], { stdio: ["ignore", "pipe", "pipe"] });
    const there = new URL(await new Promise((go) => held.stdout.once("data", (d) => go(String(d).trim()))));
    const call = (path, more = {}) => fetch(there.origin + path, { headers: { "X-VS-Token": there.hash.slice(1) }, ...more });
    const value = async (wanted) => {
      const stream = (await call("/events")).body.getReader();
      let said = "";
      for (const end = Date.now() + 10000; Date.now() < end;) {
        const { value: bytes, done } = await stream.read();
        if (done) break;
        said += Buffer.from(bytes);
        const found = [...said.matchAll(/"type":"real","value":"([^"]*)","default":"([^"]*)"/g)].pop();
        if (found && found.slice(1).join() === wanted) return stream.cancel(), wanted;
      }
      return said.slice(-200);
    };
    check(await value("3.0,3.0") === "3.0,3.0", "at first");
    writeFileSync(path, text.replace("3.0", "5.0"));
    check(await value("3.0,5.0") === "3.0,5.0", "the source's new default took its place");
    await call("/set?name=height", { method: "POST", body: "5.0" });
    check(await value("5.0,5.0") === "5.0,5.0", "a window cannot set it");
    writeFileSync(path, text.replace("3.0", "6.0"));
    check(await value("6.0,6.0") === "6.0,6.0", "it does not follow the source after a window let it go");
    held.kill();
  });

  await test("many reloads without a leak", async (check) => {
    const bytes = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${server.pid}/status`, "utf8"))[1]);
    const rounds = process.env.LONG ? 1000 : 120;
    let after = 0;
    for (let i = 0; i < rounds; i++) {
      states.length = 0;
      await ask("/set?name=height", { method: "POST", body: String(1 + i % 7 + 0.5) });
      await until((s) => s.parameters[0]?.value.startsWith(String(1 + i % 7 + 0.5)), "round " + i);
      if (i === Math.floor(rounds / 3)) after = bytes();
    }
    check(bytes() < after + 8000, `${after} KB became ${bytes()} KB`);
  });

  // A window that is opened and closed at once, a thousand times: the first requests of a page, and its stream of
  // events.
  await test("a thousand quick reloads without a leak", async (check) => {
    const held = () => ({ kilobytes: Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${server.pid}/status`, "utf8"))[1]), threads: readdirSync(`/proc/${server.pid}/task`).length, files: readdirSync(`/proc/${server.pid}/fd`).length });
    let first;
    for (let i = 1; i <= 1000; i++) {
      for (const path of ["/", "/live.js", "/live.css", "/source", "/scene"]) {
        const answer = await ask(path);
        check(answer.status === 200, `${path}, round ${i}: ${answer.status}`);
      }
      await new Promise((go) => {
        const events = http.get({ host: "127.0.0.1", port, path: "/events", headers: { "X-VS-Token": token } }, (answer) => { check(answer.statusCode === 200, `events, round ${i}: ${answer.statusCode}`); answer.on("error", () => {}); answer.once("data", () => { events.destroy(); go(); }); });
        events.on("error", () => go());
      });
      if (i === 300) first = held();
    }
    let last; // The last connections that vanished are noticed in their time.
    for (const until = Date.now() + 10000; ;) {
      await new Promise((go) => setTimeout(go, 500));
      last = held();
      if (Date.now() > until || (last.threads <= first.threads + 4 && last.files <= first.files + 4)) break;
    }
    check(last.kilobytes < first.kilobytes + 6000 && last.threads <= first.threads + 4 && last.files <= first.files + 4, `${JSON.stringify(first)} became ${JSON.stringify(last)}`);
  });

  await test("a model that never ends, with a limit", async (check) => {
    const path = `${folder}/endless.vs`, at = [];
    writeFileSync(path, "(draw (make-box (xyz 0 0 0) (xyz 1 1 1)))\n(let loop () (loop))\n");
    const held = spawn(vs, ["view", "-q", "--limit-time", "0.5", path], { stdio: ["ignore", "pipe", "ignore"] }), from = Date.now();
    at.push(new URL(await new Promise((go) => held.stdout.once("data", (d) => go(String(d).trim())))));
    const answer = await new Promise((go) => http.get({ host: "127.0.0.1", port: at[0].port, path: "/events", headers: { "X-VS-Token": at[0].hash.slice(1) } }, (a) => {
      let all = "";
      a.setEncoding("utf8");
      a.on("data", (d) => { all += d; const state = /event: state\ndata: (.*)\n/.exec(all); if (state) a.destroy(), go(JSON.parse(state[1])); });
      a.on("error", () => {});
    }));
    check(!answer.good && answer.messages.some((m) => /time|limit/i.test(m.message)) && Date.now() - from < patience(10000), `after ${Date.now() - from} ms: ${JSON.stringify(answer.messages)}`);
    held.kill();
  });

  await test("the browser is opened", async (check) => {
    const said = `${folder}/said`, bin = `${folder}/bin`;
    mkdirSync(bin);
    for (const name of ["browser", "xdg-open"]) writeFileSync(`${bin}/${name}`, `#!/bin/sh\n{ printf '%s' "\${0##*/}"; printf ' <%s>' "$@"; echo; } >> '${said}'\n`, { mode: 0o755 });
    const rows = [
      [{ BROWSER: "browser" }, [], "browser <@>"],
      [{ BROWSER: "no-such-browser %s:browser --new  --app=%s after:xdg-open" }, [], "browser <--new> <--app=@> <after>"],
      [{ BROWSER: "", DISPLAY: ":9" }, [], "xdg-open <@>"],
      [{}, [], ""], [{ BROWSER: "no-such-browser" }, [], ""], [{ BROWSER: "browser" }, ["-q"], ""],
    ];
    for (const [names, options, wanted] of rows) {
      const { BROWSER, DISPLAY, WAYLAND_DISPLAY, ...env } = process.env;
      writeFileSync(said, "");
      const other = spawn(vs, ["view", ...options, model], { env: { ...env, PATH: `${bin}:${env.PATH}`, ...names }, stdio: ["ignore", "pipe", "ignore"] });
      const address = await new Promise((go) => other.stdout.once("data", (d) => go(String(d).trim())));
      for (let k = 0; k < 100 && wanted && readFileSync(said, "utf8") === ""; k++) await new Promise((go) => setTimeout(go, 50));
      if (!wanted) await new Promise((go) => setTimeout(go, 200));
      other.kill();
      const now = readFileSync(said, "utf8").trim().replace(address, "@");
      check(now === wanted, `${JSON.stringify(names)} ${options} started "${now}"`);
    }
  });

  await test("a missing model is made, and nothing else", async (check) => {
    const run = (path, options = []) => new Promise((go) => {
      const other = spawn(vs, ["view", "-q", ...options, path], { stdio: ["ignore", "pipe", "pipe"] });
      let told = "";
      other.stderr.on("data", (d) => { told += d; });
      other.stdout.once("data", () => { other.kill(); });
      other.once("close", (code) => go({ code, told: told.replaceAll(folder, "@") }));
    });
    const first = await run(`${folder}/first.vs`), text = readFileSync(`${folder}/first.vs`, "utf8");
    check(first.code === 0 && first.told === "vs view: made @/first.vs\n" && text.includes("(draw (make-box"), JSON.stringify(first));
    writeFileSync(`${folder}/first.vs`, "; mine\n");
    const again = await run(`${folder}/first.vs`);
    check(again.told === "" && readFileSync(`${folder}/first.vs`, "utf8") === "; mine\n", `an existing model: ${JSON.stringify(again)}`);
    symlinkSync(`${folder}/nowhere.vs`, `${folder}/link.vs`);
    for (const [name, options] of [["no-folder/a.vs", []], ["a.js", []], [".vs", []], ["b.vs", ["--untrusted"]], ["link.vs", []]]) {
      const { code, told } = await run(`${folder}/${name}`, options);
      check(code === 2 && /no such file|reads only|not there/i.test(told), `${name}: ${code} ${told}`);
      check(!existsSync(`${folder}/${name}`), `${name} was made`);
    }
  });

  await test("it ends when told to", async (check) => {
    const ended = new Promise((go) => server.once("exit", (code) => go(code)));
    server.kill("SIGTERM");
    const code = await Promise.race([ended, new Promise((go) => setTimeout(() => go("never"), 10000))]);
    check(code === 0, "it ended with " + code);
  });
} finally {
  stream.destroy();
  server.kill("SIGKILL");
}
process.exit(0);
