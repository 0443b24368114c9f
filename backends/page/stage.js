// Contains the picture: renderer, light, sky, ground, the model's batches, the section, the marks. Decides when to
// draw.
//
// While anything moves, a frame has the sun, a light from above and a pale fill light. If such frames are slow, they
// have a quarter of the points and no new shadows. A complete frame follows when nothing has changed for a moment. When
// the picture is still, each frame has a single direction of the sky and of the sun's disc, its own shadow and a slight
// offset, and the stage shows the mean of the frames. Thus the same few lines of code make soft shadows, dark corners
// and smooth edges. POV-Ray's picture has the same light (backends/povray/povray_scene.c).
import * as THREE from "three";
import { addPattern, patternKey } from "./patterns.js";
import { aimCoarseLight, coarseLight, coarseMaterial, TONE, TONED } from "./coarse.js";
import { buildBatches, disposeBatches, leaveOut, mergeParts, meshGeometry } from "./batches.js";

// Radiances and colours are POV-Ray's, and linear. A light of intensity pi makes a white surface perpendicular to it as
// bright as the light's colour.
const SUN = new THREE.Color(1, 0.95, 0.87), DIFFUSE = 0.82, SKY_POWER = 1.6, SUN_POWER = 2 * SKY_POWER, EXPOSURE = 0.62;
// Light of the default sun and sky on a surface that faces the sun. EXPOSURE is the exposure for this light.
const LIT = 3.9;
// Light that walls, and that the ground, reflect, as a fraction of the sky's and the sun's light.
const BOUNCED = 0.1, BOUNCED_BY_GROUND = 0.3;
// Greatest numbers of triangles and lines of a picture in software; a graphics card gets more.
const PLAIN_MOST = 3e5, COARSE_MOST = 4e5, MOVING_MOST = 1.2e6, STILL_MOST = 2e6;
const GUESSED = 2000; // approximate number of triangles that software draws in a millisecond
const COARSE_SHARE = 0.5; // number of points of a coarse picture along a side, as a fraction of the full number
// If a drawing has more edges, a coarse picture without shadows omits them. A line takes software twice as long as a
// triangle, and such a picture is rough anyway.
const COARSE_LINES = 3000;
// Time of a complete picture, in milliseconds, above which coarse pictures are drawn while anything changes.
const SLOW = 60;

THREE.ShaderChunk.tonemapping_pars_fragment = THREE.ShaderChunk.tonemapping_pars_fragment.replace("vec3 CustomToneMapping( vec3 color ) { return color; }", `vec3 CustomToneMapping( vec3 color ) ${TONE}`);

// The light from above has one direction of the sky, or represents all of them. On reflecting surfaces it would appear
// as a bright point, so only the sun is mirrored. Both lights always have a shadow map, because three.js would
// otherwise change their order.
const SUN_ALONE_SHINES = THREE.ShaderChunk.lights_fragment_begin.replace(/(getDirectionalLightInfo[\s\S]*?)(RE_Direct\([^;]*;)/,
  "$1{ vec3 mirrored = reflectedLight.directSpecular; $2 if ( UNROLLED_LOOP_INDEX > 0 ) reflectedLight.directSpecular = mirrored; }");
const sunAloneShines = (parameters) => { parameters.fragmentShader = parameters.fragmentShader.replace("#include <lights_fragment_begin>", SUN_ALONE_SHINES); };

// Makes a shader in which the lines of a fine mesh fade when they are less than some pixels apart, because they would
// blacken the mesh. The attribute `spacing` is the mean distance of a geometry's lines, in model units.
const fading = (pixels) => (parameters) => { // pixels: half the picture's height
  parameters.uniforms.pixels = pixels;
  parameters.vertexShader = parameters.vertexShader.replace("#include <common>", "#include <common>\nattribute float spacing; uniform float pixels; varying float shownLine;")
    .replace("#include <project_vertex>", `#include <project_vertex>
      float gap = spacing;
      #ifdef USE_INSTANCING
      gap *= pow( abs( determinant( mat3( instanceMatrix ) ) ), 1.0 / 3.0 );
      #endif
      shownLine = smoothstep( 5.0, 24.0, gap * projectionMatrix[1][1] * pixels / max( gl_Position.w, 1e-6 ) );`);
  parameters.fragmentShader = parameters.fragmentShader.replace("#include <common>", "#include <common>\nvarying float shownLine;")
    .replace("#include <color_fragment>", "#include <color_fragment>\ndiffuseColor.a *= shownLine;");
};

// A shader's function that returns the direction of view at a point of the picture. In a parallel view, all rays would
// have one colour, so the sky gets the directions of a perspective view.
const SKY_WAY = `vec3 skyWay() {
  vec2 reach = vec2(1.0 / projectionMatrix[0][0], 1.0 / projectionMatrix[1][1]);
  if (isOrthographic) reach *= 0.45 / reach.y;
  return transpose(mat3(viewMatrix)) * vec3(position.xy * reach, -1.0);
}`;
// A shader's function that returns the sky's colour in a direction.
const SKY_COLOUR = `uniform sampler2D daylight; uniform vec2 sunWay; uniform vec3 zenith, horizon, near, below;
vec3 daylightAt(vec3 d) { // The table's columns go from the sun's side to the other, its rows by the root of the height.
  vec2 level = d.xy / max(1e-6, length(d.xy));
  vec2 at = vec2(acos(clamp(dot(level, sunWay), -1.0, 1.0)) / PI, sqrt(asin(clamp(d.z, 0.0, 1.0)) * 2.0 / PI));
  vec2 count = vec2(textureSize(daylight, 0));
  return texture2D(daylight, (at * (count - 1.0) + 0.5) / count).rgb;
}
vec3 skyColour(vec3 way) {
  float h = way.z;
  if (sunWay != vec2(0.0)) return h > 0.0 ? daylightAt(way) : h > -0.28 ? mix(daylightAt(way), near, -h / 0.28) : mix(near, below, (-h - 0.28) / 0.72);
  vec3 c = h > 0.0 ? mix(horizon, zenith, min(1.0, h / 0.6)) : h > -0.28 ? mix(horizon, near, -h / 0.28) : mix(near, below, (-h - 0.28) / 0.72);
  float peak = max(c.r, max(c.g, c.b)); // The sky's colours are those of the screen: what exposure and curve will do is undone.
  if (peak > 0.76) c *= (0.24 * 0.24 / (1.0 - min(peak, 0.995)) - 0.24 + 0.76) / peak;
  return c / ${EXPOSURE.toFixed(2)};
}`;

const quadVertex = "varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }";

// Returns a paler version of the sky's light. Otherwise the objects in this light would look too blue. `share` is the
// share of grey.
const paler = (c, share) => { const grey = (c.r + c.g + c.b) / 3; return c.lerp(new THREE.Color(grey, grey, grey), share); };

// True if software draws WebGL. It is determined only once, because this needs a separate context.
let software;
function isSoftware() {
  if (software !== undefined) return software;
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) throw new Error("This browser shows no WebGL 2.");
  const info = probe.getExtension("WEBGL_debug_renderer_info");
  software = /swiftshader|llvmpipe|software/i.test(info ? probe.getParameter(info.UNMASKED_RENDERER_WEBGL) : "");
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return software;
}

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.software = isSoftware();
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !this.software, stencil: true, powerPreference: "high-performance" });
    this.ratio = this.software ? 1 : Math.min(2, window.devicePixelRatio || 1);
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.toneMapping = THREE.CustomToneMapping;
    this.renderer.toneMappingExposure = EXPOSURE;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = this.software ? THREE.BasicShadowMap : THREE.PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.info.autoReset = false;
    this.renderer.localClippingEnabled = true;
    this.samples = this.software ? 24 : 64;
    this.options = { edges: true, shadows: true, occlusion: true, wireframe: false, dark: false };
    this.scene = new THREE.Scene();
    this.world = new THREE.Group(); // The objects that the section cuts.
    this.marks = new THREE.Group();
    this.scene.add(this.world, this.marks);
    this.clip = [];
    this.section = null;
    this.inside = false; // True if the eye is within the model's box.
    this.frame = 0;
    this.listeners = new Set();
    this.surfaceCache = new Map();
    this.coarseLight = coarseLight();
    // Materials of marks and of the section. They are kept, because a shader takes a tenth of a second to make.
    this.plainCache = new Map();
    this.place = { middle: { value: [0, 0, 0] }, metres: { value: 1 } };
    this.lineMaterials = {
      merged: new THREE.LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }),
      instanced: new THREE.LineBasicMaterial({ color: 0x05070a, transparent: true, opacity: 0.55, depthWrite: false }),
    };
    this.share = 1;
    // width and height of the canvas on the page, in pixels
    this.extent = [canvas.clientWidth || 300, canvas.clientHeight || 150];
    this.half = 400; // Half of the picture's height in pixels.
    this.pixels = { value: 400 };
    this.took = 0; // Time of the last complete picture, in milliseconds, as far as it is known.
    this.owed = false; // True if the last picture was coarse, so that a complete picture must follow.
    for (const m of Object.values(this.lineMaterials)) m.onBeforeCompile = fading(this.pixels);
    this.#lights();
    this.#sky();
    this.#targets();
    this.camera = null;
    this.still = 0;
    this.dirty = true;
    this.shadowsDirty = true;
    this.wake = () => { if (!this.frame && !this.lost) this.frame = requestAnimationFrame((t) => this.#tick(t)); };
    canvas.addEventListener("webglcontextlost", (event) => { event.preventDefault(); this.lost = true; });
    canvas.addEventListener("webglcontextrestored", () => { this.lost = false; this.touch(true); });
  }

  // ---- light ----

  #lights() {
    const light = (size) => {
      const l = new THREE.DirectionalLight(0xffffff, 1);
      l.castShadow = true;
      l.shadow.mapSize.set(size, size);
      this.scene.add(l, l.target);
      return l;
    };
    this.sun = light(this.software ? 1024 : 2048);
    this.above = light(1024);
    this.fill = new THREE.HemisphereLight(0xffffff, 0xb8aea2, 1);
    this.fill.position.set(0, 0, 1);
    this.scene.add(this.fill);
  }

  #aim(light, direction) { // direction: unit vector towards the light
    light.position.copy(direction).multiplyScalar(2 * this.radius).add(this.center);
    light.target.position.copy(this.center);
    const s = light.shadow, r = this.radius * 1.02;
    s.camera.left = s.camera.bottom = -r;
    s.camera.right = s.camera.top = r;
    s.camera.near = 0.5 * this.radius;
    s.camera.far = 8 * this.radius;
    s.camera.updateProjectionMatrix();
    s.normalBias = 4 * r / s.mapSize.x;
    s.bias = -0.0002;
    light.updateMatrixWorld();
    light.target.updateMatrixWorld();
  }

  #light(sample) {
    const o = this.options, mean = this.skyMean, ground = this.groundLight;
    this.sun.shadow.intensity = o.shadows ? 1 : 0;
    this.above.shadow.intensity = o.occlusion ? 1 : 0;
    this.fill.intensity = Math.PI * DIFFUSE;
    this.fill.groundColor.copy(ground);
    if (sample < 0) {
      this.#aim(this.sun, this.sunDirection);
      this.#aim(this.above, new THREE.Vector3(0.12, -0.08, 1).normalize());
      this.above.color.copy(mean);
      this.above.intensity = 0.35 * Math.PI * DIFFUSE;
      this.fill.color.copy(mean).multiplyScalar(0.65 + BOUNCED);
    } else {
      // Computes the directions of sample number `sample`. The golden ratio distributes any number of samples evenly
      // over the hemisphere, and over the sun's disc.
      const golden = 0.6180339887498949, silver = 0.7548776662466927;
      const turn = 2 * Math.PI * ((sample * golden) % 1), height = (0.5 + sample * silver) % 1, across = Math.sqrt(1 - height * height);
      const side = new THREE.Vector3(0.31, 0.57, 0.76).cross(this.sunDirection).normalize(), other = side.clone().cross(this.sunDirection);
      const r = 0.012 * Math.sqrt((sample * silver) % 1), a = 2 * Math.PI * ((sample * golden) % 1);
      this.#aim(this.sun, this.sunDirection.clone().addScaledVector(side, r * Math.cos(a)).addScaledVector(other, r * Math.sin(a)).normalize());
      this.#aim(this.above, new THREE.Vector3(across * Math.cos(turn), across * Math.sin(turn), Math.max(0.03, height)));
      this.above.color.copy(o.occlusion ? this.#skyAt(Math.cos(turn), Math.sin(turn), height) : mean);
      this.above.intensity = o.occlusion ? 2 * Math.PI * DIFFUSE : 0;
      this.fill.color.copy(mean).multiplyScalar(o.occlusion ? BOUNCED : 1 + BOUNCED);
    }
    this.sun.intensity = Math.PI * DIFFUSE * SUN_POWER;
    this.renderer.shadowMap.needsUpdate = o.shadows || o.occlusion;
  }

  // ---- sky and ground ----

  #sky() {
    const uniforms = { daylight: { value: null }, sunWay: { value: new THREE.Vector2() }, zenith: { value: new THREE.Color() }, horizon: { value: new THREE.Color() }, near: { value: new THREE.Color() }, below: { value: new THREE.Color() } };
    this.skyMaterial = new THREE.ShaderMaterial({ uniforms, vertexShader: `varying vec3 way; ${SKY_WAY} void main() { way = skyWay(); gl_Position = vec4(position.xy, 0.999999, 1.0); }`,
      fragmentShader: `#include <common>
        varying vec3 way; ${SKY_COLOUR}
        void main() {
          gl_FragColor = vec4(skyColour(normalize(way)), 1.0);
          #include <tonemapping_fragment>
          #include <colorspace_fragment>
        }`, depthWrite: false });
    // In a coarse picture the sky is computed only at the corners of a net.
    this.coarseSky = new THREE.ShaderMaterial({ uniforms: { ...uniforms, toneMappingExposure: this.coarseLight.toneMappingExposure }, toneMapped: false, vertexShader: `#include <common>
        uniform float toneMappingExposure; varying vec3 seen; ${TONED} ${SKY_WAY} ${SKY_COLOUR}
        void main() { seen = toned(skyColour(normalize(skyWay()))); gl_Position = vec4(position.xy, 0.999999, 1.0); }`,
      fragmentShader: "varying vec3 seen; void main() { gl_FragColor = vec4(seen, 1.0); }", depthWrite: false });
    this.dome = new THREE.Mesh(new THREE.PlaneGeometry(2, 2, 24, 40), this.skyMaterial);
    this.dome.renderOrder = 1000; // The sky is drawn after all opaque objects, so only its visible points are computed.
    this.dome.frustumCulled = false;
    this.scene.add(this.dome);
    this.skyMean = new THREE.Color();
    this.groundLight = new THREE.Color();
  }

  // Stores the values that determine the sky and its light. Returns true if they have changed.
  #lightChanged(model) {
    const key = [this.options.dark, ...this.sunDirection, !!model.sun?.off, ...(model.sky || []), "day", ...(model.daylight ? [...model.daylight.table, ...model.daylight.sun, ...model.daylight.level] : [])].join();
    if (key === this.lightKey) return false;
    this.lightKey = key;
    return true;
  }

  #paintSky(model) {
    const u = this.skyMaterial.uniforms, day = model && model.daylight;
    this.daylight = day;
    this.renderer.toneMappingExposure = EXPOSURE;
    u.sunWay.value.set(0, 0);
    if (day) return this.#paintDaylight(day);
    const own = model && model.sky, zenith = own || [0.46, 0.66, 0.9], haze = own ? own.map((x) => 0.45 * Math.max(...own) + 0.55 * x) : [0.93, 0.95, 0.96];
    const colour = (c) => new THREE.Color().setRGB(...c, THREE.SRGBColorSpace);
    const seen = this.options.dark && !own ? [[0.13, 0.16, 0.2], [0.27, 0.31, 0.36], [0.22, 0.245, 0.275], [0.12, 0.135, 0.155]] : [zenith, haze, [0.9, 0.9, 0.89], [0.78, 0.78, 0.77]];
    ["zenith", "horizon", "near", "below"].forEach((name, k) => u[name].value.copy(colour(seen[k])));
    this.zenithLight = paler(colour(zenith), 0.45).multiplyScalar(SKY_POWER), this.hazeLight = paler(colour(haze), 0.45).multiplyScalar(SKY_POWER);
    this.skyMean.copy(this.hazeLight).lerp(this.zenithLight, 0.88);
    this.sun.color.copy(SUN).multiplyScalar(model?.sun?.off ? 0 : 1);
    this.groundLight.copy(this.sun.color).multiplyScalar(SUN_POWER * Math.max(0.2, this.sunDirection.z)).add(this.skyMean).multiplyScalar(BOUNCED_BY_GROUND);
    this.#environment();
  }

  // Sets the physical sky: a table that vs has computed, the sun, and the light of the sky on a horizontal surface. The
  // exposure is about that of a rendered picture: as the sun sinks, the sky at the horizon fades less than the objects
  // in its light.
  #paintDaylight(day) {
    const u = this.skyMaterial.uniforms, data = new Float32Array(4 * day.columns * day.rows).fill(1);
    for (let i = 0; i < day.columns * day.rows; i++) data.set(day.table.slice(3 * i, 3 * i + 3), 4 * i);
    u.daylight.value?.dispose();
    u.daylight.value = new THREE.DataTexture(Uint16Array.from(data, THREE.DataUtils.toHalfFloat), day.columns, day.rows, THREE.RGBAFormat, THREE.HalfFloatType);
    u.daylight.value.magFilter = u.daylight.value.minFilter = THREE.LinearFilter;
    u.daylight.value.needsUpdate = true;
    u.sunWay.value.set(this.sunDirection.x, this.sunDirection.y);
    if (u.sunWay.value.length() < 1e-6) u.sunWay.value.set(1, 0);
    u.sunWay.value.normalize();
    const sun = new THREE.Color(...day.sun), level = new THREE.Color(...day.level);
    const floor = sun.clone().multiplyScalar(Math.max(0, this.sunDirection.z)).add(level);
    u.near.value.copy(floor).multiplyScalar(0.3), u.below.value.copy(floor).multiplyScalar(0.24);
    this.sun.color.copy(sun).multiplyScalar(1 / SUN_POWER);
    this.skyMean.copy(paler(level, 0.3));
    this.groundLight.copy(floor).multiplyScalar(BOUNCED_BY_GROUND);
    this.renderer.toneMappingExposure = EXPOSURE * Math.pow(LIT / (sun.g + level.g), 0.75);
    this.#environment();
  }

  // Returns the sky's light in the direction of a unit vector.
  #skyAt(x, y, z) {
    if (!this.daylight) return this.hazeLight.clone().lerp(this.zenithLight, Math.min(1, z / 0.6));
    const { table, columns, rows } = this.daylight, way = this.skyMaterial.uniforms.sunWay.value, across = Math.max(1e-6, Math.hypot(x, y));
    const column = Math.round(Math.acos(THREE.MathUtils.clamp((x * way.x + y * way.y) / across, -1, 1)) / Math.PI * (columns - 1));
    const row = Math.round(Math.sqrt(Math.asin(THREE.MathUtils.clamp(z, 0, 1)) * 2 / Math.PI) * (rows - 1)), at = 3 * (row * columns + column);
    return paler(new THREE.Color(table[at], table[at + 1], table[at + 2]), 0.3);
  }

  // Makes the picture of the surroundings that metals and glass reflect: the sky with a bright spot low in it, and the
  // ground.
  #environment() {
    const w = 64, h = 32, data = new Float32Array(4 * w * h), u = this.skyMaterial.uniforms, c = new THREE.Color();
    for (let y = 0; y < h; y++) {
      // The picture's rows go downwards. three.js treats its own Y as up, so envMapRotation turns the picture.
      const up = 1 - 2 * (y + 0.5) / h;
      if (up > 0) c.copy(u.horizon.value).lerp(u.zenith.value, Math.pow(up, 0.6)).multiplyScalar(1.15);
      else c.copy(u.near.value).lerp(u.below.value, -up).multiplyScalar(this.daylight ? 1 : 0.55);
      for (let x = 0; x < w; x++) {
        const turn = 2 * Math.PI * ((x + 0.5) / w - 0.5), across = Math.sqrt(1 - up * up);
        if (up > 0 && this.daylight) c.copy(this.#skyAt(across * Math.cos(turn), across * Math.sin(turn), up));
        const glow = up > 0 && !this.daylight ? 0.5 * Math.exp(-18 * ((up - 0.35) ** 2 + ((x / w - 0.3) * 3) ** 2)) : 0;
        data.set([c.r + glow, c.g + glow, c.b + glow, 1], 4 * ((h - 1 - y) * w + x));
      }
    }
    const picture = new THREE.DataTexture(data, w, h, THREE.RGBAFormat, THREE.FloatType);
    picture.mapping = THREE.EquirectangularReflectionMapping;
    picture.needsUpdate = true;
    this.environmentPicture?.dispose();
    this.environmentMap?.dispose();
    this.environmentPicture = picture;
    this.environmentMap = null;
  }
  #mirrored() { // Returns the reflected surroundings, which are made when the first material needs them.
    if (!this.environmentMap) {
      const maker = new THREE.PMREMGenerator(this.renderer);
      this.environmentMap = maker.fromEquirectangular(this.environmentPicture);
      maker.dispose();
    }
    return this.environmentMap.texture;
  }

  #ground(model) {
    this.groundMesh?.geometry.dispose();
    if (this.groundMesh) this.scene.remove(this.groundMesh);
    this.groundMesh = null;
    if (!model.ground) return;
    const geometry = new THREE.RingGeometry(0.0001, 1, 64, 12), reach = 14 * model.diagonal, position = geometry.attributes.position;
    const m = model.ground.paint > 0 ? model.materials[model.ground.paint] : { color: [0.78, 0.78, 0.76], roughness: 1, metallic: 0 };
    const rgb = new THREE.Color().setRGB(...m.color, THREE.SRGBColorSpace), color = new Float32Array(4 * position.count);
    // Makes the rings fine near the model, and lets the ground fade before the horizon.
    for (let i = 0; i < position.count; i++) {
      const r = Math.hypot(position.getX(i), position.getY(i)), far = r * r;
      position.setXY(i, position.getX(i) * r, position.getY(i) * r);
      color.set([rgb.r, rgb.g, rgb.b, 1 - THREE.MathUtils.smoothstep(far, 0.08, 0.95)], 4 * i);
    }
    geometry.setAttribute("color", new THREE.BufferAttribute(color, 4));
    geometry.scale(reach, reach, 1);
    this.groundMesh = new THREE.Mesh(geometry, this.#plain("ground " + patternKey(m), () => {
      const material = new THREE.MeshLambertMaterial({ vertexColors: true, transparent: true, side: THREE.DoubleSide, forceSinglePass: true });
      addPattern(material, m, this.place, () => this.touch());
      return material;
    }));
    this.groundMesh.position.set(this.center.x, this.center.y, model.ground.z - model.middle[2] - 2e-4 * model.diagonal);
    this.groundMesh.receiveShadow = true;
    this.groundMesh.renderOrder = -5;
    this.scene.add(this.groundMesh);
  }

  // ---- materials ----

  get(surface, m, merged) {
    const key = surface + (merged ? "|v" : "");
    this.used?.add(key);
    if (this.surfaceCache.has(key)) return this.surfaceCache.get(key);
    // Only a graphics card computes reflections, because software would take seconds.
    const shiny = !this.software && (m.metallic > 0.3 || m.transparency > 0.05 || m.roughness < 0.35);
    const material = new THREE.MeshStandardMaterial({
      vertexColors: merged, roughness: Math.max(0.06, m.roughness), metalness: this.software ? 0.35 * m.metallic : m.metallic, shadowSide: THREE.DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    });
    material.onBeforeCompile = sunAloneShines;
    if (shiny) {
      material.envMap = this.#mirrored();
      material.envMapRotation.set(Math.PI / 2, 0, 0);
      material.envMapIntensity = m.metallic > 0.3 ? 1.1 : m.transparency > 0.05 ? 0.9 : 0.3;
    }
    if (m.transparency > 0.02) {
      material.transparent = true;
      material.opacity = 1 - 0.8 * m.transparency;
      material.depthWrite = false;
    }
    addPattern(material, m, this.place, () => this.touch());
    material.wireframe = this.options.wireframe;
    material.clippingPlanes = this.clip;
    material.userData.closed = !surface.endsWith(",open") && !material.transparent;
    this.#side(material);
    this.surfaceCache.set(key, material);
    return material;
  }

  // Decides which sides of a material are drawn. The backs of a closed surface are invisible, except in a section, in a
  // wire frame, and from inside.
  #side(material) { material.side = material.userData.closed && !this.section && !material.wireframe && !this.inside ? THREE.FrontSide : THREE.DoubleSide; }
  #lookInside() {
    const { min, max } = this.model.box, eye = this.camera.position.toArray(), inside = !this.camera.isOrthographicCamera && eye.every((x, k) => x > min[k] && x < max[k]);
    if (inside === this.inside) return;
    this.inside = inside;
    for (const m of this.surfaceCache.values()) this.#side(m), m.needsUpdate = true;
  }

  // Returns the material of a key; make() is called if there is none yet.
  #plain(key, make) {
    if (!this.plainCache.has(key)) this.plainCache.set(key, make());
    return this.plainCache.get(key);
  }

  #dropSurfaces() {
    for (const m of this.surfaceCache.values()) m.dispose();
    this.surfaceCache.clear();
  }

  // ---- the model ----

  setModel(model, shown = null) { // shown(i) returns true if part i is in the picture; null: all parts are.
    this.model = model;
    this.shown = shown;
    const b = model.box;
    this.center = new THREE.Vector3((b.min[0] + b.max[0]) / 2, (b.min[1] + b.max[1]) / 2, (b.min[2] + b.max[2]) / 2);
    this.radius = 0.5 * model.diagonal;
    this.sunDirection = model.sun ? new THREE.Vector3(...model.sun.direction).negate().normalize() : new THREE.Vector3(-0.5, -0.55, 0.67).normalize();
    this.place.middle.value = model.middle;
    this.place.metres.value = model.metres;
    if (this.#lightChanged(model)) {
      this.#dropSurfaces();
      this.#paintSky(model);
    }
    this.#ground(model);
    this.used = new Set();
    this.refresh();
    // This is an estimate until a picture has been timed.
    if (this.took === 0 && this.software) this.took = this.batches.userData.triangles / GUESSED;
    for (const [key, material] of this.surfaceCache) // Removes materials of earlier models that no part uses any more.
      if (!this.used.has(key)) material.dispose(), this.surfaceCache.delete(key);
    this.used = null;
  }

  // Makes the batches again after the shown parts have changed.
  refresh(shown = this.shown) {
    this.shown = shown;
    if (this.batches) {
      this.world.remove(this.batches);
      disposeBatches(this.batches);
    }
    this.batches = buildBatches(this.model, shown, this, this.lineMaterials);
    this.world.add(this.batches);
    this.#caps();
    this.#options();
    this.touch(true);
  }

  setOptions(options) {
    Object.assign(this.options, options);
    if ("dark" in options && this.model && this.#lightChanged(this.model)) {
      this.#dropSurfaces();
      this.#paintSky(this.model);
      this.refresh();
    }
    this.#options();
    this.touch(true);
  }
  #options() {
    for (const m of this.surfaceCache.values()) if (m.wireframe !== this.options.wireframe) m.wireframe = this.options.wireframe, this.#side(m), m.needsUpdate = true;
    this.batches?.traverse((o) => { if (o.userData.edges) o.visible = this.options.edges && !this.options.wireframe; });
    if (this.model) this.#light(-1);
  }

  // ---- marks: parts in a separate colour, over all others ----

  setMarks(groups) { // groups: [{ parts, color, opacity, model }]
    for (const child of [...this.marks.children]) {
      this.marks.remove(child);
      child.geometry.dispose();
    }
    for (const { parts, color, opacity = 0.4, model = this.model } of groups) {
      if (parts.length === 0) continue;
      const m = mergeParts(model, parts, false), off = model.middle.map((x, k) => x - this.model.middle[k]);
      if (m.index.length > 0) {
        const mesh = new THREE.Mesh(meshGeometry(m), this.#plain(`mark ${color} ${opacity}`, () => new THREE.MeshBasicMaterial({
          color, transparent: true, opacity, depthWrite: false, side: THREE.DoubleSide, toneMapped: false, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -2, clippingPlanes: this.clip })));
        mesh.renderOrder = 5;
        mesh.frustumCulled = false;
        mesh.position.set(...off);
        this.marks.add(mesh);
      }
      if (m.edges.length > 0) {
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute("position", new THREE.BufferAttribute(m.edges, 3));
        const line = new THREE.LineSegments(geometry, this.#plain(`mark's lines ${color}`, () => new THREE.LineBasicMaterial({
          color, toneMapped: false, depthTest: false, transparent: true, opacity: 0.9, clippingPlanes: this.clip })));
        line.renderOrder = 6;
        line.frustumCulled = false;
        line.position.set(...off);
        this.marks.add(line);
      }
    }
    this.touch();
  }

  // ---- the section ----

  // Cuts the model by a plane, { normal: Vector3, constant }, and keeps the side of the normal. null: nothing is cut.
  setSection(plane) {
    const had = this.section !== null;
    this.section = plane;
    this.clip.length = 0;
    if (plane) this.clip.push(new THREE.Plane(plane.normal.clone(), plane.constant));
    if (had !== (plane !== null)) {
      for (const m of this.surfaceCache.values()) m.clippingPlanes = this.clip, m.clipShadows = true, this.#side(m), m.needsUpdate = true;
      for (const m of Object.values(this.lineMaterials)) m.clippingPlanes = this.clip, m.needsUpdate = true;
    }
    this.#caps();
    this.touch(true);
  }

  // Fills the cut faces of solids. Behind a point of the plane, a closed solid has equally many faces towards the
  // viewer and away from the viewer. If the numbers differ, the plane cuts the solid there.
  #caps() {
    if (this.capGroup) {
      this.world.remove(this.capGroup);
      this.capGroup.traverse((o) => { if (o.userData.own) o.geometry.dispose(); });
      this.capGroup = null;
    }
    if (!this.section || !this.batches) return;
    const group = this.capGroup = new THREE.Group();
    const counter = (side, operation) => this.#plain("counter " + side, () => new THREE.MeshBasicMaterial({ side, colorWrite: false, depthWrite: false, depthTest: false, stencilWrite: true, stencilFunc: THREE.AlwaysStencilFunc,
      stencilFail: operation, stencilZFail: operation, stencilZPass: operation, clippingPlanes: this.clip }));
    const back = counter(THREE.BackSide, THREE.IncrementWrapStencilOp), front = counter(THREE.FrontSide, THREE.DecrementWrapStencilOp);
    this.batches.traverse((o) => {
      if (!o.isMesh || !o.userData.solid) return;
      o.userData.fill?.();
      for (const material of [back, front]) {
        let copy;
        if (o.isInstancedMesh) {
          copy = new THREE.InstancedMesh(o.geometry, material, 0);
          copy.instanceMatrix = o.instanceMatrix;
          copy.count = o.count;
        } else copy = new THREE.Mesh(o.geometry, material);
        o.updateWorldMatrix(true, false);
        copy.matrixAutoUpdate = false;
        copy.matrix.copy(o.matrixWorld);
        copy.frustumCulled = false;
        copy.renderOrder = 1;
        group.add(copy);
      }
    });
    const size = 4 * this.radius, cap = new THREE.Mesh(new THREE.PlaneGeometry(size, size), this.#plain("cap", () => new THREE.MeshStandardMaterial({
      color: 0xa8584a, roughness: 1, side: THREE.DoubleSide, stencilWrite: true, stencilRef: 0, stencilFunc: THREE.NotEqualStencilFunc,
      stencilFail: THREE.ReplaceStencilOp, stencilZFail: THREE.ReplaceStencilOp, stencilZPass: THREE.ReplaceStencilOp, emissive: 0x4a201a, emissiveIntensity: 0.6 })));
    cap.userData.own = true;
    cap.renderOrder = 2;
    const { normal, constant } = this.section;
    cap.position.copy(this.center).addScaledVector(normal, -(normal.dot(this.center) + constant));
    cap.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
    group.add(cap);
    this.world.add(group);
  }

  // ---- drawing ----

  #targets() {
    const plain = { type: THREE.HalfFloatType, depthBuffer: true, stencilBuffer: true, generateMipmaps: false };
    const precise = { type: THREE.FloatType, depthBuffer: false, generateMipmaps: false, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter };
    this.one = new THREE.WebGLRenderTarget(1, 1, plain);
    this.mean = [new THREE.WebGLRenderTarget(1, 1, precise), new THREE.WebGLRenderTarget(1, 1, precise)];
    this.mixer = new THREE.ShaderMaterial({
      uniforms: { sum: { value: null }, one: { value: null }, part: { value: 1 } }, vertexShader: quadVertex, depthTest: false, depthWrite: false, toneMapped: false,
      fragmentShader: "uniform sampler2D sum, one; uniform float part; varying vec2 at; void main() { vec4 c = min(texture2D(one, at), vec4(24.0)); gl_FragColor = part >= 1.0 ? c : mix(texture2D(sum, at), c, part); }",
    });
    this.shower = new THREE.ShaderMaterial({
      uniforms: { sum: { value: null } }, vertexShader: quadVertex, depthTest: false, depthWrite: false,
      fragmentShader: "uniform sampler2D sum; varying vec2 at; void main() { gl_FragColor = vec4(texture2D(sum, at).rgb, 1.0);\n#include <tonemapping_fragment>\n#include <colorspace_fragment>\n}",
    });
    this.quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), this.mixer);
    this.quad.frustumCulled = false;
    this.quadScene = new THREE.Scene();
    this.quadScene.add(this.quad);
    this.quadCamera = new THREE.Camera();
  }

  resize() {
    const w = Math.max(1, this.canvas.clientWidth), h = Math.max(1, this.canvas.clientHeight), sized = w + " " + h;
    if (sized === this.sized) return;
    this.sized = sized;
    this.extent = [w, h];
    this.share = 0; // With this value, the canvas changes its size at the next picture.
    this.half = h / 2;
    for (const t of [this.one, ...this.mean]) t.setSize(Math.floor(w * this.ratio), Math.floor(h * this.ratio));
    this.touch();
  }

  // Draws pictures with only this fraction of the canvas' points along a side. The canvas itself then gets this size,
  // because drawing a picture over a full-size canvas would take as long as drawing the model.
  #points(share) {
    if (share === this.share) return;
    this.share = share;
    this.renderer.setDrawingBufferSize(...this.extent, this.ratio * share);
    this.pixels.value = share * this.half; // A line is as wide as a point of the picture.
  }

  // Must be called after a change, so that the next frame shows it. shadows: true if the light has changed, too.
  touch(shadows = false) {
    this.dirty = true;
    if (shadows) this.shadowsDirty = true;
    this.count = 0;
    this.wake();
  }

  // Calls the listener before each frame. Returns a function that ends this.
  onFrame(listener) {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  #quad(material, target) {
    this.quad.material = material;
    this.renderer.setRenderTarget(target);
    this.renderer.render(this.quadScene, this.quadCamera);
  }

  // most: limit on the number of triangles and lines; lined: true if edges are drawn
  #leaveOut(most, lined = this.options.edges && !this.options.wireframe) {
    if (!this.batches) return;
    const half = this.half * this.share * this.ratio * this.camera.projectionMatrix.elements[5], parallel = this.camera.isOrthographicCamera;
    leaveOut(this.batches, { camera: this.camera, pixels: (distance) => parallel ? half : half / Math.max(1e-9, distance), across: 2.04 * this.radius / this.sun.shadow.mapSize.x,
      lined, lit: this.renderer.shadowMap.needsUpdate, most: most * (this.software ? 1 : 8) });
  }

  draw(coarse = false) {
    this.#lookInside();
    this.#points(coarse ? COARSE_SHARE : 1);
    this.#light(-1);
    // The old shadows belong to the previous model, so the picture has none.
    if (coarse && this.shadowsDirty) this.sun.shadow.intensity = this.above.shadow.intensity = 0;
    if (coarse || !this.shadowsDirty) this.renderer.shadowMap.needsUpdate = false;
    if (!coarse) this.shadowsDirty = false;
    this.owed = coarse;
    const plainly = coarse && this.shadowsDirty, lined = this.options.edges && !this.options.wireframe && !(plainly && this.batches?.userData.lines > COARSE_LINES);
    const restore = plainly ? this.#simplify(lined) : null;
    this.renderer.setRenderTarget(null);
    this.renderer.info.reset();
    this.#leaveOut(plainly ? PLAIN_MOST : coarse ? COARSE_MOST : MOVING_MOST, lined);
    this.renderer.render(this.scene, this.camera);
    this.drawCalls = this.renderer.info.render.calls;
    restore?.();
  }

  // Gives all surfaces a few plain materials, for a coarse picture without shadows. They take a fifth of the time, and
  // need few shaders. The shaders of patterns and shadows are made for the complete picture. Returns a function that
  // restores the materials.
  #simplify(lined) {
    aimCoarseLight(this.coarseLight, this, this.camera);
    const changed = [], simple = (o) => {
      const { material } = o, { transparent, opacity, wireframe } = material, closed = material.side === THREE.FrontSide;
      changed.push(o, material);
      o.material = this.#plain(["coarse", material.vertexColors, transparent ? opacity.toFixed(1) : "", material.polygonOffset, closed, !!material.clippingPlanes].join(" "), () => coarseMaterial(this.coarseLight, material, closed));
      o.material.wireframe = wireframe;
    };
    const hidden = [];
    this.batches?.traverse((o) => {
      if (o.isMesh) simple(o);
      else if (o.userData.edges && o.visible && !lined) o.visible = false, hidden.push(o);
    });
    if (this.groundMesh) simple(this.groundMesh);
    changed.push(this.dome, this.skyMaterial);
    this.dome.material = this.coarseSky;
    this.sun.castShadow = this.above.castShadow = false;
    return () => {
      for (let i = 0; i < changed.length; i += 2) changed[i].material = changed[i + 1];
      for (const o of hidden) o.visible = true;
      this.sun.castShadow = this.above.castShadow = true;
    };
  }

  // Reads the time of the last picture, which the graphics card reports only some frames later.
  #timed() {
    const gl = this.renderer.getContext();
    if (!this.timing || gl.getSyncParameter(this.timing.end, gl.SYNC_STATUS) !== gl.SIGNALED) return;
    this.took = performance.now() - this.timing.from;
    gl.deleteSync(this.timing.end);
    this.timing = null;
  }
  #time(from) {
    const gl = this.renderer.getContext();
    if (this.timing) gl.deleteSync(this.timing.end);
    this.timing = { from, end: gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0) };
    gl.flush();
  }

  #accumulate() {
    this.#lookInside();
    this.#points(1);
    const i = this.count++, size = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    this.shadowsDirty = true;
    this.#light(i);
    this.camera.setViewOffset(size.x, size.y, ((i * 0.7548776662466927 + 0.5) % 1) - 0.5, ((i * 0.5698402909980532 + 0.5) % 1) - 0.5, size.x, size.y);
    this.renderer.setRenderTarget(this.one);
    this.renderer.info.reset();
    this.#leaveOut(STILL_MOST);
    this.renderer.render(this.scene, this.camera);
    this.camera.clearViewOffset();
    this.mixer.uniforms.sum.value = this.mean[i % 2].texture;
    this.mixer.uniforms.one.value = this.one.texture;
    this.mixer.uniforms.part.value = 1 / (i + 1);
    this.#quad(this.mixer, this.mean[(i + 1) % 2]);
    if (i + 1 >= Math.min(16, this.samples)) { // The mean of fewer samples would look like separate lights.
      this.shower.uniforms.sum.value = this.mean[(i + 1) % 2].texture;
      this.#quad(this.shower, null);
    }
    this.renderer.setRenderTarget(null);
  }

  // Draws the pending picture at once. If a picture takes longer than a frame, waiting for the next frame would only
  // delay it.
  now() {
    if (this.lost) return;
    cancelAnimationFrame(this.frame);
    this.#tick(performance.now());
  }

  #tick(time) {
    this.frame = 0;
    if (!this.camera || !this.model) return;
    let moving = false;
    this.#timed();
    for (const listener of this.listeners) moving = listener(time) || moving;
    if (moving || this.dirty || (this.owed && performance.now() >= this.still)) {
      const from = performance.now(), coarse = (moving || this.dirty) && this.took > SLOW;
      this.dirty = false;
      this.draw(coarse);
      if (!coarse) this.#time(from);
      this.count = 0;
      this.still = performance.now() + Math.min(600, 140 + 2 * (performance.now() - from));
      this.wake();
    } else if (this.owed) {
      this.wake();
    } else if (this.count < this.samples && this.options.refine !== false) {
      if (performance.now() < this.still) return this.wake();
      const until = performance.now() + 12;
      do this.#accumulate(); while (this.count < this.samples && performance.now() < until && !this.software);
      this.wake();
    } else if (!this.settled) {
      this.settled = true;
    }
  }

  // Draws a complete picture at once, for callers that read it from the canvas: the mean of `samples` directions of
  // light.
  paint(samples = this.samples) {
    this.dirty = this.owed = false;
    this.count = 0;
    while (this.count < samples) this.#accumulate();
    this.shower.uniforms.sum.value = this.mean[samples % 2].texture;
    this.#quad(this.shower, null);
    this.renderer.setRenderTarget(null);
  }

  // Frees all memory on the graphics card. Nothing can be drawn afterwards.
  dispose() {
    this.lost = true;
    cancelAnimationFrame(this.frame);
    if (this.batches) disposeBatches(this.batches);
    this.#dropSurfaces();
    for (const m of this.plainCache.values()) m.dispose();
    for (const target of [this.one, ...this.mean]) target.dispose();
    this.environmentMap?.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  get finished() { return !this.dirty && !this.owed && this.count >= this.samples; }
}
