// Packs a program into a part of an address, and reads it again. The text is compressed (deflate) and spelled in the 64
// letters that need no escape in an address.

const through = async (bytes, stream) => new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
const MOST = 4 << 20; // Greatest number of bytes that a packed program may unpack to.

// program: { name, text, values: [[name, value]] }.
export async function pack(program) {
  const bytes = await through(new TextEncoder().encode(JSON.stringify(program)), new CompressionStream("deflate-raw"));
  let letters = "";
  for (const byte of bytes) letters += String.fromCharCode(byte);
  return btoa(letters).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

// Returns a promise of the program, or of null if the packed text is damaged.
export async function unpack(packed) {
  try {
    const bytes = Uint8Array.from(atob(packed.replace(/-/g, "+").replace(/_/g, "/")), (letter) => letter.charCodeAt(0));
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader(), parts = [];
    for (let size = 0; ;) {
      const { value, done } = await reader.read();
      if (done) break;
      if ((size += value.length) > MOST) return null;
      parts.push(value);
    }
    const { name, text, values } = JSON.parse(await new Blob(parts).text());
    const words = (x) => typeof x === "string";
    if (!words(name) || !words(text) || !/^(?!\.\.?$)[^/\0]{1,80}$/.test(name) || !Array.isArray(values)) return null;
    return { name, text, values: values.filter((v) => Array.isArray(v) && v.length === 2 && v.every(words)) };
  } catch {
    return null;
  }
}
