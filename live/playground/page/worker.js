// Runs the program in a worker. Messages of the page: open (files, the model's path, whether it runs), ask (a request,
// as to the live view's server), put (a file), files (a list of all). The worker answers with answer, part, files and
// failed, and with ready when the model is open.
/* global importScripts, VisualScheme */

const ENGINE = "engine.js", PROGRAM = "engine.wasm", FOLDER = "/model/";

let module, scheduled = false, frames = false, running = false;

const send = (kind, data, moved = []) => self.postMessage({ kind, ...data }, moved);

// program: the bytes of the program, where the page may not fetch; names: files that are fetched, as [path, address].
async function start({ program, names }) {
  if (typeof VisualScheme === "undefined") importScripts(ENGINE);
  module = await VisualScheme({
    ...(program ? { wasmBinary: program } : { locateFile: () => PROGRAM }),
    answer: (id, status, type, bytes, open) => send("answer", { id, status, type, bytes: bytes.buffer, open }, [bytes.buffer]),
    part: (id, bytes) => send("part", { id, bytes: bytes.buffer }, [bytes.buffer]),
    print: (text) => console.log(text), printErr: (text) => console.warn(text),
  });
  for (const [path, url] of names || []) lazy(path, url);
}

const folder = (path) => path.slice(0, path.lastIndexOf("/") + 1);

// A file that is fetched when the program first reads it.
function lazy(path, url) {
  module.FS.mkdirTree(folder(path));
  module.FS.createLazyFile(folder(path), path.slice(folder(path).length), url, true, false);
}

function put(path, content) {
  module.FS.mkdirTree(folder(path));
  try { module.FS.unlink(path); } catch { /* it is new */ }
  module.FS.writeFile(path, content);
}

// The files below a folder, as [path, bytes].
function* below(path) {
  for (const name of module.FS.readdir(path)) {
    if (name === "." || name === "..") continue;
    const at = path + name;
    if (module.FS.isDir(module.FS.stat(at).mode)) yield* below(at + "/");
    else if (!module.FS.lookupPath(at).node.contents?.get) yield [at, module.FS.readFile(at)];
  }
}

// Handles the waiting requests after all messages that have come, so that a run sees the last value of a slider.
function turn() {
  scheduled = false;
  frames = module._playground_turn() !== 0;
  if (frames) wake(40);
}
function wake(milliseconds = 0) {
  if (scheduled || !running) return;
  scheduled = true;
  setTimeout(() => guarded(turn), milliseconds);
}

// An error of the machine (no memory, no stack) ends the program; the page starts another.
function guarded(work) {
  try {
    return work();
  } catch (error) {
    send("failed", { message: String(error.message || error) });
    return undefined;
  }
}

function text(value) {
  const bytes = new TextEncoder().encode(value), at = module._malloc(bytes.length + 1);
  module.HEAPU8.set(bytes, at);
  module.HEAPU8[at + bytes.length] = 0;
  return [at, bytes.length];
}

function ask({ id, method, path, body }) {
  const [address, query = ""] = path.split("?"), pairs = [...new URLSearchParams(query)];
  const given = [method, address, pairs.map(([name, value]) => name + "\0" + value + "\0").join(""), body].map(text);
  module._playground_request(id, given[0][0], given[1][0], given[2][0], given[3][0], given[3][1]);
  for (const [at] of given) module._free(at);
  wake();
}

function open({ model, files, run }) {
  for (const [path, content] of files) put(path, content);
  const [at] = text(model);
  if (!module._playground_open(at)) throw new Error(model + " cannot be opened");
  send("ready", {});
  if (run) begin();
}

function begin() {
  if (running) return;
  running = true;
  module._playground_run();
  wake();
}

// Messages that come while the program is compiled wait for it.
let last = Promise.resolve();
self.onmessage = ({ data }) => {
  last = last.then(async () => {
    if (data.kind === "start") await start(data);
    else guarded(() => ({ open, ask, run: begin, put: ({ path, content }) => put(path, content),
      files: ({ id }) => send("files", { id, files: [...below(FOLDER)] }) })[data.kind](data));
  }).catch((error) => send("failed", { message: String(error.message || error) }));
};
