// Reads the packed notation, which backends/x3d/packed.c describes, into a tree of nodes: { type, def, fields, children
// }. A node that uses another node is { use: number }.

import { unzlibSync } from "three/examples/jsm/libs/fflate.module.js";

const decoder = new TextDecoder();

export function readPacked(packed) {
  const buffer = expanded(packed), bytes = new Uint8Array(buffer);
  let at = 4;
  if (bytes.length < 4 || decoder.decode(bytes.subarray(0, 4)) !== "VSX1") throw new Error("This is not a packed scene.");
  const names = [""];

  function count() {
    let value = 0, factor = 1;
    for (;;) {
      const byte = bytes[at++];
      value += (byte & 127) * factor;
      if (byte < 128) return value;
      factor *= 128;
    }
  }
  function text() {
    const length = count();
    at += length;
    return decoder.decode(bytes.subarray(at - length, at));
  }
  function name() {
    const number = count();
    if (number > 0) return names[number];
    names.push(text());
    return names[names.length - 1];
  }
  // Arrays are copied, because typed arrays must begin at multiples of their element's width.
  function array(Type, items) {
    const from = at;
    at += items * Type.BYTES_PER_ELEMENT;
    if (at > bytes.length) throw new Error("The scene ends too early.");
    return new Type(buffer.slice(bytes.byteOffset + from, bytes.byteOffset + at));
  }

  const root = { type: "Scene", fields: {}, children: [] };
  const open = [root];
  let node = root;
  while (at < bytes.length) {
    const letter = bytes[at++];
    switch (letter) {
      case 78: // N
        node = { type: name(), def: -1, fields: {}, children: [] };
        open[open.length - 1].children.push(node);
        open.push(node);
        break;
      case 69: // E
        open.pop();
        node = open[open.length - 1];
        break;
      case 68: node.def = count(); break; // D
      case 85: node.children.push({ use: count() }); break; // U
      case 84: { const key = name(), value = text(); if (key === "file") (node.fields.file ||= []).push(value); else node.fields[key] = value; break; } // T
      case 66: { const key = name(); node.fields[key] = count(); break; } // B
      case 70: { const key = name(); node.fields[key] = array(Float32Array, count()); break; } // F
      case 71: { const key = name(); node.fields[key] = array(Float64Array, count()); break; } // G
      case 72: { const key = name(); node.fields[key] = array(Int16Array, count()); break; } // H
      case 73: { const width = count(), key = name(); node.fields[key] = array(width === 1 ? Uint8Array : width === 2 ? Uint16Array : Uint32Array, count()); break; } // I
      default: throw new Error("The scene cannot be read at byte " + (at - 1) + ".");
    }
  }
  return root;
}

// Returns the uncompressed bytes. The scene of a page is compressed by zlib, and begins with an x; a scene from the
// server is uncompressed.
function expanded(buffer) {
  const bytes = new Uint8Array(buffer);
  return bytes[0] === 120 ? unzlibSync(bytes).buffer : buffer;
}

export function decode64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text).buffer;
  const words = atob(text), bytes = new Uint8Array(words.length);
  for (let i = 0; i < words.length; i++) bytes[i] = words.charCodeAt(i);
  return bytes.buffer;
}
