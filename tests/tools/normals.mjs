// Prints the shading of a file's triangles: `node normals.mjs FILE` prints the share of triangles whose three corners
// have different normals, for a .x3d, .glb or .html (its packed scene). For a round wall it is near 1, for a wall with
// flat shading 0.
import { readFileSync } from 'node:fs'
import { readPacked } from '../../backends/page/packed.js'

const file = process.argv[2], bytes = readFileSync(file)
let all = 0, smooth = 0
const look = (index, normals) => {
  for (let i = 0; i + 2 < index.length; i += 3) {
    const at = k => [0, 1, 2].map(c => normals[3 * index[i + k] + c])
    const apart = (a, b) => Math.hypot(...a.map((x, c) => x - b[c])) > 1e-2
    all++
    if (apart(at(0), at(1)) || apart(at(1), at(2))) smooth++
  }
}
const numbers = text => text.trim().split(/\s+/).map(Number)

if (file.endsWith('.x3d')) {
  for (const set of bytes.toString().matchAll(/<IndexedTriangleSet[^>]*index='([^']*)'>([^]*?)<\/IndexedTriangleSet>/g))
    look(numbers(set[1]), numbers(/<Normal vector='([^']*)'/.exec(set[2])[1]))
} else if (file.endsWith('.html')) {
  const scene = Buffer.from(/id="scene">([^<]*)</.exec(bytes.toString())[1], 'base64')
  const walk = node => {
    const { index, vector: normal } = node.fields ?? {}
    if (index && normal) look(index, normal)
    for (const child of node.children ?? []) walk(child)
  }
  walk(readPacked(scene.buffer.slice(scene.byteOffset, scene.byteOffset + scene.length)))
} else {
  const length = bytes.readUInt32LE(12), scene = JSON.parse(bytes.toString('utf8', 20, 20 + length)), start = 28 + length
  for (const p of scene.meshes.flatMap(m => m.primitives).filter(p => p.attributes.NORMAL !== undefined)) {
    const a = scene.accessors[p.attributes.NORMAL], v = scene.bufferViews[a.bufferView], b = scene.accessors[p.indices], w = scene.bufferViews[b.bufferView]
    const read = { 5120: o => bytes.readInt8(o) / 127, 5122: o => bytes.readInt16LE(o) / 32767, 5126: o => bytes.readFloatLE(o) }[a.componentType]
    const size = { 5120: 1, 5122: 2, 5126: 4 }[a.componentType], from = start + (v.byteOffset ?? 0) + (a.byteOffset ?? 0)
    const normals = Array.from({ length: 3 * a.count }, (_, i) => read(from + Math.floor(i / 3) * (v.byteStride ?? 3 * size) + (i % 3) * size))
    const at = start + (w.byteOffset ?? 0) + (b.byteOffset ?? 0)
    look(Array.from({ length: b.count }, (_, i) => b.componentType === 5123 ? bytes.readUInt16LE(at + 2 * i) : bytes.readUInt32LE(at + 4 * i)), normals)
  }
}
console.log(`triangles ${all} smooth ${all ? (smooth / all).toFixed(2) : 0}`)
