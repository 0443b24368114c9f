// Makes films: pictures of a canvas, encoded by the browser as VP9, in a WebM file (a Matroska file of few elements).
const bytesOf = (number) => {
  const out = [];
  do out.unshift(number % 256), number = Math.floor(number / 256); while (number > 0);
  return out;
};
// Returns an element of the file: the bytes of its name, its size in eight bytes, and its contents (numbers, texts,
// bytes, or elements).
function element(name, content) {
  const parts = Array.isArray(content) ? content : [typeof content === "number" ? Uint8Array.from(bytesOf(content)) : typeof content === "string" ? new TextEncoder().encode(content) : content];
  const size = parts.reduce((sum, part) => sum + (part.size ?? part.byteLength), 0), head = Uint8Array.from([...bytesOf(name), 1, ...new Array(7).fill(0)]);
  for (let k = 0, rest = size; k < 7; k++, rest = Math.floor(rest / 256)) head[head.length - 1 - k] = rest % 256;
  return { size: head.length + size, parts: [head, ...parts] };
}
const flat = (e) => e.parts ? e.parts.flatMap(flat) : [e];
const double = (x) => { const b = new Uint8Array(8); new DataView(b.buffer).setFloat64(0, x); return b; };

export class Film {
  constructor(width, height, rate) {
    Object.assign(this, { width, height, rate, chunks: [] });
    this.encoder = new VideoEncoder({
      output: (chunk) => {
        const data = new Uint8Array(chunk.byteLength);
        chunk.copyTo(data);
        this.chunks.push({ key: chunk.type === "key", at: Math.round(chunk.timestamp / 1000), data });
      },
      error: (error) => { this.failed = error; },
    });
    this.encoder.configure({ codec: "vp09.00.31.08", width, height, framerate: rate, bitrate: 12 * width * height });
    this.count = 0;
  }
  async add(canvas) {
    const frame = new VideoFrame(canvas, { timestamp: Math.round(1e6 * this.count / this.rate) });
    this.encoder.encode(frame, { keyFrame: this.count % (2 * this.rate) === 0 });
    frame.close();
    this.count++;
    while (this.encoder.encodeQueueSize > 4) await new Promise((go) => setTimeout(go, 5));
    if (this.failed) throw this.failed;
  }
  close() { if (this.encoder.state !== "closed") this.encoder.close(); }
  async finish() {
    await this.encoder.flush();
    this.close();
    if (this.failed) throw this.failed;
    const clusters = [];
    for (const chunk of this.chunks) { // Each chunk begins with a picture that does not depend on earlier pictures.
      if (chunk.key) clusters.push({ at: chunk.at, blocks: [] });
      const cluster = clusters[clusters.length - 1], off = chunk.at - cluster.at;
      const block = new Uint8Array(4 + chunk.data.length);
      block.set([0x81, off >> 8, off & 255, chunk.key ? 0x80 : 0]);
      block.set(chunk.data, 4);
      cluster.blocks.push(element(0xa3, block));
    }
    const file = [
      element(0x1a45dfa3, [element(0x4286, 1), element(0x42f7, 1), element(0x42f2, 4), element(0x42f3, 8), element(0x4282, "webm"), element(0x4287, 2), element(0x4285, 2)]),
      element(0x18538067, [
        element(0x1549a966, [element(0x2ad7b1, 1000000), element(0x4489, double(1000 * this.count / this.rate)), element(0x4d80, "VisualScheme"), element(0x5741, "VisualScheme")]),
        element(0x1654ae6b, [element(0xae, [element(0xd7, 1), element(0x73c5, 1), element(0x83, 1), element(0x9c, 0), element(0x86, "V_VP9"), element(0xe0, [element(0xb0, this.width), element(0xba, this.height)])])]),
        ...clusters.map((c) => element(0x1f43b675, [element(0xe7, c.at), ...c.blocks])),
      ]),
    ];
    return new Blob(file.flatMap(flat), { type: "video/webm" });
  }
}
