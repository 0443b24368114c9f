// Prints the figures of a mesh file: `node meshes.mjs FILE` prints triangles, volume and bounds of a .ply, .glb, .stl
// in words, or of an .x3d of boxes and triangle sets (with the number of its Shapes, copies included); a .glb goes
// through the validator first. Ends with 1 and prints the reason if the file is wrong.
import { readFileSync } from 'node:fs'
import { createRequire } from 'node:module'

const file = process.argv[2], bytes = readFileSync(file)
const fail = text => { console.log(`${file}: ${text}`); process.exit(1) }
const triangles = [] // of three points each

function ply() {
  const text = bytes.toString('latin1'), head = text.slice(0, text.indexOf('end_header\n') + 11)
  const count = what => Number(new RegExp(`element ${what} (\\d+)`).exec(head)[1])
  const stride = /z\nproperty uchar red/.test(head) ? 28 : 24 // colours of vertices
  let at = head.length
  const points = Array.from({ length: count('vertex') }, () => [0, 8, 16].map(o => bytes.readDoubleLE(at + o)).concat(at += stride).slice(0, 3))
  const edges = new Map()
  for (let i = count('face'); i > 0; i--, at += 17) {
    if (bytes[at] !== 3) fail('a face is no triangle')
    const corners = [1, 5, 9].map(o => bytes.readUInt32LE(at + o))
    corners.forEach((a, k) => { const key = a + ' ' + corners[(k + 1) % 3]; if (edges.has(key)) fail('an edge is used twice'); edges.set(key, 1) })
    triangles.push(corners.map(c => points[c]))
  }
  for (const key of edges.keys()) if (!edges.has(key.split(' ').reverse().join(' '))) fail('the surface is open')
  if (at !== bytes.length) fail('bytes are left over')
}

function words() {
  const points = [...bytes.toString().matchAll(/vertex (\S+) (\S+) (\S+)/g)].map(m => m.slice(1).map(Number))
  for (let i = 0; i < points.length; i += 3) triangles.push(points.slice(i, i + 3))
}

async function glb() {
  const validator = createRequire(import.meta.url)('gltf-validator')
  const { issues } = await validator.validateBytes(new Uint8Array(bytes))
  if (issues.numErrors + issues.numWarnings > 0) fail(JSON.stringify(issues.messages.filter(m => m.severity < 2)))
  const length = bytes.readUInt32LE(12), scene = JSON.parse(bytes.toString('utf8', 20, 20 + length)), start = 28 + length
  const read = number => {
    const a = scene.accessors[number], v = scene.bufferViews[a.bufferView], from = start + v.byteOffset + a.byteOffset
    if (a.type === 'VEC3') return Array.from({ length: a.count }, (_, i) => [0, 4, 8].map(o => bytes.readFloatLE(from + i * v.byteStride + o)))
    return Array.from({ length: a.count }, (_, i) => a.componentType === 5123 ? bytes.readUInt16LE(from + 2 * i) : bytes.readUInt32LE(from + 4 * i))
  }
  const turned = ([x, y, z, w], p) => { // q p q*
    const t = [2 * (y * p[2] - z * p[1]), 2 * (z * p[0] - x * p[2]), 2 * (x * p[1] - y * p[0])]
    return [p[0] + w * t[0] + y * t[2] - z * t[1], p[1] + w * t[1] + z * t[0] - x * t[2], p[2] + w * t[2] + x * t[1] - y * t[0]]
  }
  const walk = (number, place) => {
    const n = scene.nodes[number], s = n.scale ?? [1, 1, 1], t = n.translation ?? [0, 0, 0]
    const here = p => place(turned(n.rotation ?? [0, 0, 0, 1], p.map((x, i) => x * s[i])).map((x, i) => x + t[i]))
    const mirrored = s[0] * s[1] * s[2] < 0
    for (const p of n.mesh === undefined ? [] : scene.meshes[n.mesh].primitives) {
      if (p.mode === 3) continue
      const points = read(p.attributes.POSITION).map(here), index = read(p.indices)
      for (let i = 0; i < index.length; i += 3) {
        const t3 = [0, 1, 2].map(k => points[index[i + k]])
        triangles.push(mirrored ? t3.reverse() : t3)
      }
    }
    for (const child of n.children ?? []) walk(child, here)
  }
  for (const root of scene.scenes[0].nodes) walk(root, p => p)
}

// An element of the scene gives its triangles for a place; copies (USE) give those of the element with that name (DEF).
let shapes = ''
function x3d() {
  const root = { name: '', of: {}, in: [] }, open = [root], named = {}
  for (const [, slash, name, rest, empty] of bytes.toString().matchAll(/<(\/?)(\w+)((?:\s+\w+='[^']*')*)\s*(\/?)>/g)) {
    if (slash) { open.pop(); continue }
    const of = Object.fromEntries([...rest.matchAll(/(\w+)='([^']*)'/g)].map(m => m.slice(1)))
    const node = of.USE === undefined ? { name, of, in: [] } : named[of.USE] ?? fail(`${of.USE} is used before it is defined`)
    if (of.DEF !== undefined) named[of.DEF] = node
    open.at(-1).in.push(node)
    if (!empty) open.push(node)
  }
  const numbers = text => (text.match(/[-+.\deE]+/g) ?? []).map(Number)
  const corners = { Box: ({ of }) => {
    const half = numbers(of.size ?? '2 2 2').map(x => x / 2), at = k => half.map((h, i) => k >> i & 1 ? h : -h)
    return [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]].flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]].map(t => t.map(at)))
  }, IndexedTriangleSet: n => {
    const index = numbers(n.of.index), points = numbers(n.in.find(c => c.name === 'Coordinate').of.point)
    return Array.from({ length: index.length / 3 }, (_, i) => [0, 1, 2].map(k => points.slice(3 * index[3 * i + k], 3 * index[3 * i + k] + 3)))
  } }
  let count = 0
  const walk = (node, place) => {
    if (node.name === 'Switch' || node.of.DEF === 'ground') return
    if (corners[node.name]) { count++; for (const t of node.made ??= corners[node.name](node)) triangles.push(t.map(place)); return }
    if (['Sphere', 'Cylinder', 'Cone'].includes(node.name)) fail(`a ${node.name} has no triangles`)
    const [x, y, z, angle] = numbers(node.of.rotation ?? '0 0 1 0'), s = numbers(node.of.scale ?? '1 1 1'), t = numbers(node.of.translation ?? '0 0 0')
    const long = Math.hypot(x, y, z), axis = [x / long, y / long, z / long], cos = Math.cos(angle), sin = Math.sin(angle)
    const turned = p => { // Rodrigues
      const dot = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2]
      return p.map((v, i) => v * cos + (axis[(i + 1) % 3] * p[(i + 2) % 3] - axis[(i + 2) % 3] * p[(i + 1) % 3]) * sin + axis[i] * dot * (1 - cos))
    }
    for (const child of node.in) walk(child, node.name === 'Transform' ? p => place(turned(p.map((v, i) => v * s[i])).map((v, i) => v + t[i])) : place)
  }
  walk(root, ([x, y, z]) => [x, -z, y])
  shapes = ` shapes ${count}`
}

await (file.endsWith('.x3d') ? x3d() : file.endsWith('.ply') ? ply() : file.endsWith('.glb') ? glb() : words())
let volume = 0, min = [Infinity, Infinity, Infinity], max = min.map(x => -x)
for (const [a, b, c] of triangles) {
  volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
  for (const p of [a, b, c]) { min = min.map((x, i) => Math.min(x, p[i])); max = max.map((x, i) => Math.max(x, p[i])) }
}
console.log(`triangles ${triangles.length}${shapes} volume ${volume} min ${min.join(' ')} max ${max.join(' ')}`)
