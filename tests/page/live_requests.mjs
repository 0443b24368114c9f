// Owns the tests of hostile requests to the live view's server: every path with every fault of a request.
// `live_requests.mjs VS FOLDER`. Prints lines in the form that tests/run.sh reads.
import { spawn } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import net from "node:net";

const [, , vs, folder] = process.argv, model = `${folder}/model.vs`, only = process.env.ONLY || "";
const source = '(define-parameter height 3.0)\n(define-parameter label "")\n(draw (make-box origin (xyz (+ 1 (string-length label)) 1 height)))\n';
mkdirSync(folder, { recursive: true });
writeFileSync(model, source);
const server = spawn(vs, ["view", "-q", model], { stdio: ["ignore", "pipe", "pipe"] });
const url = new URL(await new Promise((go) => server.stdout.once("data", (d) => go(String(d).trim())))), token = url.hash.slice(1), port = Number(url.port);

// Sends bytes as they are, which no client's library does, and returns { status, head, body, sent }. more: further bytes,
// which are sent until the server answers. sent: how many of them the server has taken.
function send(head, body = "", more = 0) {
  return new Promise((go) => {
    const socket = net.connect(port, "127.0.0.1"), parts = [];
    let sent = 0, answered = false;
    const end = () => {
      const text = Buffer.concat(parts).toString("latin1"), cut = text.indexOf("\r\n\r\n");
      socket.destroy();
      go({ status: Number(/^HTTP\/1\.1 (\d+)/.exec(text)?.[1]), head: text.slice(0, cut), body: cut < 0 ? "" : text.slice(cut + 4), sent });
    };
    socket.on("data", (d) => { parts.push(d); answered = true; });
    for (const event of ["end", "error", "close"]) socket.on(event, end);
    socket.setTimeout(3000, end);
    socket.write(head);
    socket.write(body);
    const piece = Buffer.alloc(65536, 97), pour = () => {
      if (answered || sent >= more || socket.destroyed) return;
      sent += piece.length;
      socket.write(piece, () => setImmediate(pour));
    };
    if (more > 0) pour();
  });
}
const lines = (method, path, headers) => [`${method} ${path} HTTP/1.1`, ...headers, "Connection: close", "", ""].join("\r\n");
const host = `Host: 127.0.0.1:${port}`, key = `X-VS-Token: ${token}`;
const ask = (method, path, headers = [host, key], body = "") => send(lines(method, path, body ? [...headers, `Content-Length: ${Buffer.byteLength(body)}`] : headers), body);

async function test(name, body) {
  if (!("live/" + name).includes(only)) return;
  const faults = [];
  try {
    await body((ok, what) => { if (!ok) faults.push(what); });
  } catch (error) {
    faults.push(String(error.stack || error));
  }
  console.log((faults.length ? "not ok live/" : "ok live/") + name);
  for (const fault of faults.slice(0, 12)) console.log("    " + fault);
}

// The paths that need the token, and a body that each of them takes.
const paths = [["GET", "/source"], ["GET", "/scene"], ["GET", "/events"], ["GET", "/names?prefix=make"], ["GET", "/name?of=car"], ["GET", "/formats"], ["GET", "/export?format=off"], ["GET", "/face?at=0.5,0.5,3"],
  ["POST", "/source?hash=0", "(lost)"], ["POST", "/try", "(lost)"], ["POST", "/set?name=height", "5"], ["POST", "/check", "(car)"], ["POST", "/prompt", "(car 5)"], ["POST", "/input?kind=press", "left 0 0 9 0 0 -1"],
  ["POST", "/export?format=off&id=1", ""], ["POST", "/cancel?id=1", ""], ["POST", "/stop", ""]];
const faults = { // Each makes the headers of a request, and the statuses that refuse it.
  "no token": [() => [host], 403], "a wrong token": [() => [host, `X-VS-Token: ${"0".repeat(32)}`], 403], "half a token": [() => [host, `X-VS-Token: ${token.slice(0, 16)}`], 403], "more than the token": [() => [host, key + "0"], 403],
  "no host": [() => [key], 403, 400], "a foreign host": [() => ["Host: evil.example", key], 403], "our host without its port": [() => ["Host: 127.0.0.1", key], 403], "a host that begins as ours": [() => [host + ".evil.example", key], 403],
  "two hosts, ours first": [() => [host, "Host: evil.example", key], 400], "two hosts, ours last": [() => ["Host: evil.example", host, key], 400], "our host twice": [() => [host, host, key], 400],
  "a foreign origin": [() => [host, key, "Origin: http://evil.example"], 403], "no origin's name": [() => [host, key, "Origin: null"], 403], "our origin, with TLS": [() => [host, key, `Origin: https://127.0.0.1:${port}`], 403],
};
await test("hostile requests: each path with each fault", async (check) => {
  let count = 0;
  for (const [method, path, body] of paths)
    for (const [fault, [headers, ...statuses]] of Object.entries(faults)) {
      const answer = await ask(method, path, headers(), body);
      count++;
      check(statuses.includes(answer.status), `${fault}: ${method} ${path}: ${answer.status}`);
    }
  check(count >= 200, `${count} requests`);
  check(readFileSync(model, "utf8") === source, "the file was written");
});

await test("a name with the character U+0000 is refused", async (check) => {
  for (const [method, path, body] of paths) {
    for (const bad of [path.replace(/\?|$/, "%00$&"), path + (path.includes("?") ? "%00" : "?a=%00"), path + "%00x", "/%00" + path]) check((await ask(method, bad, [host, key], body)).status === 400, `${method} ${bad}`);
    if (body) check((await ask(method, path, [host, key], body + "\0rest")).status === 400, `${method} ${path}: a body with U+0000`);
  }
  check(readFileSync(model, "utf8") === source, "the file was written");
});

// A body of half a gigabyte: the server answers from the headers alone. Only the system's buffers take a part of it.
await test("a body is refused before it is read", async (check) => {
  const most = 1 << 29, rows = { "no token": [host], "a foreign host": ["Host: evil.example", key], "too long": [host, key] };
  for (const [what, headers] of Object.entries(rows))
    for (const length of what === "too long" ? [`Content-Length: ${most}`] : [`Content-Length: ${most}`, "Transfer-Encoding: chunked"]) {
      const chunked = length.startsWith("T"), before = Number(/VmHWM:\s+(\d+)/.exec(readFileSync(`/proc/${server.pid}/status`, "utf8"))[1]);
      const answer = await send(lines("POST", "/try", [...headers, length]), chunked ? most.toString(16) + "\r\n" : "", most);
      const grown = Number(/VmHWM:\s+(\d+)/.exec(readFileSync(`/proc/${server.pid}/status`, "utf8"))[1]) - before;
      check(answer.sent < 64 << 20 && (answer.status === (what === "too long" ? 413 : 403) || Number.isNaN(answer.status)), `${what}, ${length}: ${answer.status} after ${answer.sent} bytes`);
      check(grown < 4000, `${what}, ${length}: the server grew by ${grown} KB`);
      // A client that waits before it sends a body gets the refusal.
      const waits = await send(lines("POST", "/try", [...headers, length]));
      check(waits.status === (what === "too long" ? 413 : 403), `${what}, ${length}, before the body: ${waits.status}`);
    }
});

await test("HEAD answers as GET does, without a body", async (check) => {
  for (const path of ["/", "/live.js", "/live.css", ...paths.filter(([method]) => method === "GET").map(([, path]) => path)]) {
    const answer = await ask("HEAD", path), length = Number(/Content-Length: (\d+)/i.exec(answer.head)?.[1] ?? -1);
    check(answer.status === 200 && answer.body === "" && (path === "/events" || length > 0), `${path}: ${answer.status}, ${answer.body.length} bytes, Content-Length ${length}`);
  }
  check((await ask("HEAD", "/source", [host])).status === 403, "HEAD without the token");
  check((await ask("HEAD", "/nothing")).status === 404, "HEAD of no path");
});

await test("an export has a text with any character", async (check) => {
  for (const text of ["\x1f", "x\x1fy\x1ez", "\x1e\x1e", "é\n\""]) {
    check((await ask("POST", "/set?name=label", [host, key], text)).status === 202, "it cannot be set");
    const { status, body } = await ask("GET", "/export?format=off");
    check(status === 200 && body.includes(`\n${text.length + 1} 1 3\n`), `${JSON.stringify(text)}: ${status} ${body.slice(0, 80)}`);
  }
});

await test("the formats are those of the program", async (check) => {
  const formats = JSON.parse((await ask("GET", "/formats")).body), help = await new Promise((go) => {
    let all = "";
    const child = spawn(vs, ["help", "formats"], { stdio: ["ignore", "pipe", "ignore"] });
    child.stdout.on("data", (d) => { all += d; });
    child.on("close", () => go(all));
  });
  check(formats.length > 15 && formats.every((f) => f.name && f.suffix && f.doc && typeof f.worker === "boolean"), JSON.stringify(formats).slice(0, 200));
  for (const f of formats) check(new RegExp(`^\\.${f.suffix}\\b`, "m").test(help), `.${f.suffix} is no ending of vs help formats`);
  for (const [, suffix] of help.matchAll(/^\.([a-z0-9]+)\s/gm)) check(formats.some((f) => f.suffix === suffix), `.${suffix} is missing`);
});

server.kill("SIGKILL");
process.exit(0);
