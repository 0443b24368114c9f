// Draws the patterns of materials (model/looks/patterns.def) in the picture: bricks, boards, grain, clouds ... at their
// real size.
//
// A pattern is a function of a position in the model, in metres, and of the face's normal. On floors it lies along x
// and y, on walls it is upright, with walls in eight directions, as in POV-Ray's pictures
// (backends/povray/povray_materials.c). If a unit is smaller than two pixels, the material's own colour appears, so
// that distant faces do not flicker.
import * as THREE from "three";

const numbers = ["bricks", "english", "flemish", "ashlar", "tiles", "boards", "grain", "ribbed", "brushed", "mottled", "speckled", "veined", "pebbled", "rippled", "grassy", "picture"];

const vertexHead = "varying vec3 vsPlace;\nuniform vec3 vsMiddle;\nuniform float vsMetres;\n";
const vertexBody = `
  vec4 vsWorld = vec4(transformed, 1.0);
  #ifdef USE_INSTANCING
    vsWorld = instanceMatrix * vsWorld;
  #endif
  vsPlace = ((modelMatrix * vsWorld).xyz + vsMiddle) * vsMetres;
`;

const fragmentHead = `
varying vec3 vsPlace;
uniform vec3 vsSecond;
uniform float vsSize, vsAngle;
#if VS_PATTERN == 16
uniform float vsHeight;
uniform sampler2D vsPicture;
#endif
float vsHash(vec3 p) {
  p = fract(p * vec3(0.1031, 0.11369, 0.13787));
  p += dot(p, p.yzx + 19.19);
  return fract((p.x + p.y) * p.z);
}
float vsNoise(vec3 p) {
  vec3 i = floor(p), f = p - i;
  f = f * f * (3.0 - 2.0 * f);
  return mix(mix(mix(vsHash(i), vsHash(i + vec3(1, 0, 0)), f.x), mix(vsHash(i + vec3(0, 1, 0)), vsHash(i + vec3(1, 1, 0)), f.x), f.y),
             mix(mix(vsHash(i + vec3(0, 0, 1)), vsHash(i + vec3(1, 0, 1)), f.x), mix(vsHash(i + vec3(0, 1, 1)), vsHash(i + vec3(1, 1, 1)), f.x), f.y), f.z);
}
float vsClouds(vec3 p) { return 0.5 * vsNoise(p) + 0.3 * vsNoise(2.3 * p + 7.1) + 0.2 * vsNoise(5.7 * p + 3.3); }
vec2 vsCracks(vec3 p) { // The distance to the nearest border between cells, and the cell's number from 0 to 1.
  vec3 i = floor(p);
  float near = 9.0, next = 9.0, cell = 0.0;
  for (int x = -1; x <= 1; x++) for (int y = -1; y <= 1; y++) for (int z = -1; z <= 1; z++) {
    vec3 at = i + vec3(x, y, z), seed = at + vec3(vsHash(at), vsHash(at + 31.7), vsHash(at + 77.3));
    float d = distance(p, seed);
    if (d < near) { next = near; near = d; cell = vsHash(at + 5.5); } else next = min(next, d);
  }
  return vec2(next - near, cell);
}
vec3 vsTone(vec3 c, float t, float vary) { // t: 0 to 1; most units are like the material, few are dark
  float by = t < 0.45 ? mix(1.0 - 0.2 * vary, 1.0, t / 0.45) : t < 0.82 ? mix(1.0, 1.0 + 0.1 * vary, (t - 0.45) / 0.37) : mix(1.0 + 0.1 * vary, 1.0 - 0.26 * vary, (t - 0.82) / 0.18);
  return c * pow(by, 2.2);
}
vec3 vsCourses(vec3 c, vec2 q) {
  const int p = VS_PATTERN;
  float wide = vsSize, high = p <= 3 ? wide / 3.0 : p == 4 ? wide / 2.0 : wide, joint = wide * (p <= 3 ? 0.044 : p == 6 ? 0.03 : 0.02);
  float vary = p <= 3 ? 1.0 : p == 4 ? 0.5 : p == 5 ? 0.25 : 0.6;
  float row = floor(q.y / high), odd = mod(row, 2.0), along, cell, len = wide, inside;
  if (p == 2) { len = wide * (1.0 - 0.5 * odd); along = q.x / len + 0.25 * odd; cell = floor(along); inside = (along - cell) * len; }
  else if (p == 3) {
    along = q.x / (1.5 * wide) + 0.5 * odd;
    float pair = floor(along), rest = (along - pair) * 1.5 * wide, half_ = step(wide, rest);
    cell = 2.0 * pair + half_; inside = rest - half_ * wide;
  } else {
    if (p == 6) { len = 18.0 * wide; along = q.x / len + vsHash(vec3(0.5, row, 0.5)); }
    else along = q.x / wide + (p == 5 ? 0.0 : 0.5 * odd);
    cell = floor(along); inside = (along - cell) * len;
  }
  float w = 0.5 * (fwidth(q.x) + fwidth(q.y));
  float gap = min(inside - joint, q.y - row * high - joint), share = smoothstep(-w, w, gap);
  float t = vsHash(vec3(cell, row, 0.5)) + (p == 6 ? 0.5 * vsNoise(vec3(q.x / (3.0 * wide), 12.0 * q.y / high, cell)) - 0.25 : 0.25 * vary * (vsNoise(vec3(40.0 * q, 0.0)) - 0.5));
  return mix(vsSecond, vsTone(c, clamp(t, 0.0, 1.0), vary), share);
}
vec3 vsOnFace(vec3 c, vec2 q) {
  #if VS_PATTERN <= 6
    return vsCourses(c, q);
  #elif VS_PATTERN == 7
    q /= vsSize;
    float t = 0.65 * vsNoise(vec3(0.5 * q.x, 0.0, 5.0 * q.y)) + 0.35 * vsNoise(vec3(2.5 * q.x, 7.0, 45.0 * q.y));
    return mix(vsSecond, c * (0.9 + 0.2 * t), smoothstep(0.15, 0.6, t));
  #elif VS_PATTERN == 8
    float t = abs(2.0 * fract(q.x / vsSize) - 1.0);
    return t > 0.965 ? vsSecond : t > 0.925 ? 1.3 * c : c * (1.0 + 0.1 * t);
  #else
    return mix(vsSecond, c, smoothstep(0.2, 0.8, vsNoise(vec3(0.3 * q.x / vsSize, 0.0, 120.0 * q.y / vsSize))));
  #endif
}
vec3 vsThrough(vec3 c, vec3 p) {
  #if VS_PATTERN == 10
    return mix(vsSecond, c, smoothstep(0.25, 0.55, vsClouds(1.6 * p / vsSize)));
  #elif VS_PATTERN == 11
    float t = vsCracks(p / vsSize).y;
    return t < 0.25 ? vsSecond : t < 0.5 ? mix(mix(c, vsSecond, 0.4), c, 4.0 * t - 1.0) : c * (0.78 + 0.44 * t);
  #elif VS_PATTERN == 12
    p /= vsSize;
    float t = abs(fract(p.x + 0.7 * p.y + 0.4 * p.z + 1.8 * vsClouds(1.5 * p)) * 2.0 - 1.0);
    return mix(c, vsSecond, 0.2 * smoothstep(0.6, 0.88, t) + 0.6 * smoothstep(0.88, 0.99, t));
  #elif VS_PATTERN == 13
    vec2 t = vsCracks(p / vsSize);
    return mix(vsSecond, c * (0.85 + 0.35 * t.y), smoothstep(0.04, 0.22, t.x));
  #elif VS_PATTERN == 14
    return c * (0.92 + 0.16 * vsClouds(p / vsSize));
  #else
    float t = (1.2 * vsNoise(p / vsSize) + vsNoise(p / (14.0 * vsSize)) + 0.8 * vsClouds(p / (110.0 * vsSize))) / 3.0;
    return t < 0.5 ? mix(0.55 * c, 0.95 * c, smoothstep(0.2, 0.5, t)) : mix(0.95 * c, vsSecond, smoothstep(0.5, 0.8, t));
  #endif
}
#if VS_PATTERN == 16
// As in model/looks/picture.c: directions in steps of 22.5 degrees.
vec2 vsLaid(vec3 p, vec3 across, vec3 up) {
  vec2 q = vec2(dot(p, across), dot(p, up));
  return vec2(cos(vsAngle) * q.x + sin(vsAngle) * q.y, cos(vsAngle) * q.y - sin(vsAngle) * q.x) / vec2(vsSize, vsHeight);
}
vec3 vsPattern(vec3 c) {
  vec3 right = dFdx(vsPlace), down = dFdy(vsPlace), n = normalize(cross(right, down));
  const float turn = 0.392699082;
  float tilt = floor(atan(length(n.xy), n.z) / turn + 0.5) * turn, a = floor(atan(n.y, n.x) / turn + 0.5) * turn;
  if (tilt < 0.5 * turn || tilt > 7.5 * turn) a = -1.570796327;
  vec3 across = vec3(-sin(a), cos(a), 0.0), up = vec3(-cos(tilt) * cos(a), -cos(tilt) * sin(a), sin(tilt));
  return textureGrad(vsPicture, vsLaid(vsPlace, across, up), vsLaid(right, across, up), vsLaid(down, across, up)).rgb;
}
#else
vec3 vsPattern(vec3 c) {
  vec3 across = dFdx(vsPlace), down = dFdy(vsPlace), n = normalize(cross(across, down));
  float pixel = 0.5 * (length(across) + length(down)), unit = VS_PATTERN == 15 ? 40.0 * vsSize : vsSize;
  float fine = 1.0 - smoothstep(0.2, 0.6, pixel / unit);
  if (fine <= 0.0) return c;
  #if VS_PATTERN <= 9
    vec2 q = vsPlace.xy;
    if (abs(n.z) < 0.7071) {
      float turn = floor(atan(n.y, n.x) / 0.785398163 + 0.5) * 0.785398163;
      q = vec2(cos(turn) * vsPlace.y - sin(turn) * vsPlace.x, vsPlace.z);
    }
    q = vec2(cos(vsAngle) * q.x + sin(vsAngle) * q.y, cos(vsAngle) * q.y - sin(vsAngle) * q.x);
    return mix(c, vsOnFace(c, q), fine);
  #else
    return mix(c, vsThrough(c, vsPlace), fine);
  #endif
}
#endif
`;

const linear = (c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;

// Returns the part of a material's key that its pattern determines. Materials with equal keys are drawn together.
export function patternKey(m) {
  return m.pattern ? [m.pattern.name, ...m.pattern.color, m.pattern.size, m.pattern.angle, m.pattern.picture ? m.pattern.picture.sum : ""].join(":") : "";
}

// Returns the texture of a picture. The texture has the material's own colour until the browser has decoded the
// picture. redraw is then called, which requests a frame.
function textureOf(m, redraw) {
  const picture = m.pattern.picture;
  if (!picture.shown) {
    const plain = new THREE.DataTexture(new Uint8Array([...m.color.map((c) => Math.round(255 * c)), 255]), 1, 1);
    plain.colorSpace = THREE.SRGBColorSpace;
    plain.needsUpdate = true;
    picture.shown = { value: plain };
    createImageBitmap(new Blob([picture.bytes], { type: "image/" + picture.type }), { imageOrientation: "flipY" }).then((image) => {
      const texture = new THREE.Texture(image);
      texture.flipY = false;
      texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
      texture.colorSpace = THREE.SRGBColorSpace;
      texture.anisotropy = 8;
      texture.needsUpdate = true;
      picture.shown.value = texture;
      redraw();
    });
  }
  return picture.shown;
}

// Makes a three.js material show the pattern of m, if m has a pattern. place: shared uniforms: middle, the point to
// which the model's positions are relative, and metres, the length of a model unit. redraw: called when the browser has
// decoded a picture.
export function addPattern(material, m, place, redraw) {
  const number = m.pattern ? numbers.indexOf(m.pattern.name) + 1 : 0;
  if (number === 0) return;
  const before = material.onBeforeCompile, values = {
    vsMiddle: place.middle, vsMetres: place.metres, vsSecond: { value: m.pattern.color.map(linear) },
    vsSize: { value: m.pattern.size }, vsAngle: { value: m.pattern.angle * Math.PI / 180 },
  };
  if (m.pattern.picture) values.vsPicture = textureOf(m, redraw), values.vsHeight = { value: m.pattern.picture.height };
  material.onBeforeCompile = (shader, renderer) => {
    before.call(material, shader, renderer);
    Object.assign(shader.uniforms, values);
    shader.vertexShader = vertexHead + shader.vertexShader.replace("#include <begin_vertex>", "#include <begin_vertex>\n" + vertexBody);
    shader.fragmentShader = "#define VS_PATTERN " + number + "\n" + shader.fragmentShader
      .replace("void main() {", fragmentHead + "void main() {")
      .replace("#include <color_fragment>", "#include <color_fragment>\n  diffuseColor.rgb = vsPattern(diffuseColor.rgb);");
  };
  material.customProgramCacheKey = () => "pattern " + number;
}
