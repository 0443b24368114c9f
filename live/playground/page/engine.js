// Contains the page's side of the program in a worker: ask(), as the live view's page needs it, by messages.

// What a program changes or runs. The page holds these requests back until someone has asked it to run a stranger's
// program.
const RUNS = ["/try", "/set", "/prompt", "/input", "/export"];
const SLOW = 300; // Milliseconds after which the Stop button is enabled although the program has said nothing.

export class Engine {
  // open(): { model, files: [[path, text or bytes]] }, asked for each new worker. worker(): a new worker. start: the
  // worker's first message.
  constructor({ open, worker, start }) {
    Object.assign(this, { makeOpen: open, makeWorker: worker, start });
    this.held = true;
    this.later = []; // Requests that wait for the first run.
    this.number = 0;
    this.asked = new Map(); // For each request without an answer: the function that answers it.
    this.streams = new Map(); // For each answer that stays open: the controller of its stream.
    this.ask = (path, options) => this.#ask(path, options);
    this.#begin(false);
  }

  #begin(run) {
    const worker = this.worker = this.makeWorker();
    this.opened = false;
    worker.onmessage = ({ data }) => { if (worker === this.worker) this.#hear(data); };
    worker.onerror = (event) => { if (worker === this.worker) this.#failed(event.message || "the program could not be started"); };
    worker.postMessage({ kind: "start", ...this.start });
    worker.postMessage({ kind: "open", run, ...this.makeOpen() });
  }

  // Runs the model for the first time.
  run() {
    this.held = this.idle = false;
    this.worker.postMessage({ kind: "run" });
    for (const [path, options] of this.later.splice(0)) this.#ask(path, options);
  }

  put(path, content) { this.worker.postMessage({ kind: "put", path, content }); }

  // Returns a promise of all files, as [path, bytes].
  files() {
    const id = ++this.number;
    return new Promise((go) => {
      this.asked.set(id, go);
      this.worker.postMessage({ kind: "files", id });
    });
  }

  #hear(data) {
    if (data.kind === "ready") this.opened = true;
    else if (data.kind === "failed") this.#failed(data.message);
    else if (data.kind === "files") this.#answer(data.id, data.files);
    else if (data.kind === "part") this.streams.get(data.id)?.enqueue(new Uint8Array(data.bytes));
    else if (data.open) {
      const body = new ReadableStream({ start: (controller) => this.streams.set(data.id, controller) });
      this.#answer(data.id, new Response(body, { status: data.status, headers: { "Content-Type": data.type } }));
    } else {
      this.#answer(data.id, new Response(data.bytes, { status: data.status === 499 ? 422 : data.status, headers: { "Content-Type": data.type } }));
    }
  }

  #answer(id, answer) {
    const go = this.asked.get(id);
    this.asked.delete(id);
    clearTimeout(this.slow);
    if (this.asked.size > 0) this.#watch();
    go?.(answer);
  }

  // Sends an event to the view, as the program does.
  #event(kind, data) {
    const bytes = new TextEncoder().encode(`event: ${kind}\ndata: ${JSON.stringify(data)}\n\n`);
    for (const stream of this.streams.values()) stream.enqueue(bytes);
  }

  #watch() {
    clearTimeout(this.slow);
    this.slow = setTimeout(() => { if (this.asked.size > 0) this.#event("busy", { phase: "running", fraction: -1 }); }, SLOW);
  }

  #ask(path, { method = "GET", body = "" } = {}) {
    if (path === "/stop") return this.#stop();
    if (this.held && path.startsWith("/set?")) this.later.push([path, { method, body }]); // a value of the address
    if (this.held && RUNS.some((one) => path.startsWith(one))) return Promise.resolve(new Response("", { status: 202 }));
    const id = ++this.number;
    return new Promise((go) => {
      this.asked.set(id, go);
      this.worker.postMessage({ kind: "ask", id, method, path, body });
      if (path !== "/events") this.#watch();
      // After a stop the next text or value runs the model again.
      if (this.idle && !this.held && (path.startsWith("/source?") || RUNS.some((one) => path.startsWith(one)))) this.run();
    });
  }

  // Ends what runs. A program in a worker hears nothing while it runs, so the worker ends, and another begins with the
  // same files. It runs nothing until there is a new text or value.
  async #stop() {
    this.#again("stopped");
    return new Response("", { status: 202 });
  }

  #failed(message) {
    console.error(message);
    this.#again(/memory|allocat/i.test(message) ? "the page has no more memory" : /stack|recursion/i.test(message) ? "the stack is full" : message);
  }

  #again(why) {
    this.worker.terminate();
    this.#event("busy", { phase: why, fraction: -1 });
    this.#event("idle", {});
    for (const stream of this.streams.values()) try { stream.close(); } catch { /* it is closed */ }
    this.streams.clear();
    const open = [...this.asked.values()];
    this.asked.clear();
    for (const go of open) go(new Response(why, { status: 422 }));
    this.idle = true;
    if (this.opened) this.#begin(false); // else the program cannot start here
    this.halted?.(why);
  }
}
