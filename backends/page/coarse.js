// Makes the plain material of coarse pictures. It computes light, with the tone curve, at the corners of triangles, so
// a point of the picture costs next to nothing. It shows neither patterns nor shadows nor reflections. Its light has
// the formulas of stage.js.
import * as THREE from "three";

// The tone curve compresses bright colours and makes them paler, and leaves others unchanged. It is Khronos' neutral
// curve without its toe, which reduces the contrast of dark colours.
export const TONE = `{
  color *= toneMappingExposure;
  float peak = max( color.r, max( color.g, color.b ) );
  if ( peak < 0.76 ) return color;
  float now = 1.0 - 0.24 * 0.24 / ( peak + 0.24 - 0.76 );
  return mix( vec3( now ), color * now / peak, 1.0 / ( 0.15 * ( peak - now ) + 1.0 ) );
}`;

// Converts a colour of the picture's light to the screen's.
export const TONED = `vec3 curved( vec3 color ) ${TONE}
vec3 toned( vec3 color ) {
  vec3 c = clamp( curved( color ), 0.0, 1.0 );
  return mix( 1.055 * pow( c, vec3( 1.0 / 2.4 ) ) - 0.055, 12.92 * c, vec3( lessThanEqual( c, vec3( 0.0031308 ) ) ) );
}`;

const vertexShader = `
#include <common>
#include <color_pars_vertex>
#include <clipping_planes_pars_vertex>
uniform float toneMappingExposure;
uniform vec3 sunWay, sunLight, aboveWay, aboveLight, upWay, skyLight, groundLight;
varying vec4 front;
#ifdef BOTH_SIDES
varying vec3 back;
#endif
${TONED}
vec3 lit( vec3 n, vec3 base ) {
  vec3 light = sunLight * max( 0.0, dot( n, sunWay ) ) + aboveLight * max( 0.0, dot( n, aboveWay ) ) + mix( groundLight, skyLight, 0.5 * dot( n, upWay ) + 0.5 );
  return toned( base * light );
}
void main() {
  #include <color_vertex>
  #include <beginnormal_vertex>
  #include <defaultnormal_vertex>
  #include <begin_vertex>
  #include <project_vertex>
  #include <clipping_planes_vertex>
  vec4 base = vec4( 1.0 );
  #if defined( USE_COLOR_ALPHA )
  base = vColor;
  #elif defined( USE_COLOR ) || defined( USE_INSTANCING_COLOR )
  base.rgb = vColor.rgb;
  #endif
  vec3 n = normalize( transformedNormal );
  front = vec4( lit( n, base.rgb ), base.a );
  #ifdef BOTH_SIDES
  back = lit( - n, base.rgb );
  #endif
}`;
const fragmentShader = `
#include <clipping_planes_pars_fragment>
uniform float opacity;
varying vec4 front;
#ifdef BOTH_SIDES
varying vec3 back;
#endif
void main() {
  #include <clipping_planes_fragment>
  gl_FragColor = front * vec4( 1.0, 1.0, 1.0, opacity );
  #ifdef BOTH_SIDES
  if ( ! gl_FrontFacing ) gl_FragColor.rgb = back;
  #endif
}`;

// Returns the uniforms that all coarse materials of a stage share.
export function coarseLight() {
  const colour = () => ({ value: new THREE.Color() }), way = () => ({ value: new THREE.Vector3() });
  return { toneMappingExposure: { value: 1 }, sunWay: way(), sunLight: colour(), aboveWay: way(), aboveLight: colour(), upWay: way(), skyLight: colour(), groundLight: colour() };
}

// Sets the uniforms u to the lights of a stage, in the coordinates of its camera.
export function aimCoarseLight(u, { sun, above, fill, renderer }, camera) {
  const seen = (to, from) => to.copy(from).transformDirection(camera.matrixWorldInverse);
  seen(u.sunWay.value, sun.position.clone().sub(sun.target.position));
  seen(u.aboveWay.value, above.position.clone().sub(above.target.position));
  seen(u.upWay.value, fill.position);
  u.sunLight.value.copy(sun.color).multiplyScalar(sun.intensity / Math.PI);
  u.aboveLight.value.copy(above.color).multiplyScalar(above.intensity / Math.PI);
  u.skyLight.value.copy(fill.color).multiplyScalar(fill.intensity / Math.PI);
  u.groundLight.value.copy(fill.groundColor).multiplyScalar(fill.intensity / Math.PI);
  u.toneMappingExposure.value = renderer.toneMappingExposure;
}

// Returns the coarse version of another material. light: uniforms of coarseLight; closed: true if the backs of the
// surface are never visible.
export function coarseMaterial(light, { vertexColors, transparent, opacity, depthWrite, polygonOffset, clippingPlanes }, closed) {
  return new THREE.ShaderMaterial({
    uniforms: { ...light, opacity: { value: transparent ? opacity : 1 } }, vertexShader, fragmentShader, defines: closed ? {} : { BOTH_SIDES: "" }, side: closed ? THREE.FrontSide : THREE.DoubleSide, forceSinglePass: true,
    vertexColors, transparent, depthWrite, polygonOffset, polygonOffsetFactor: 1, polygonOffsetUnits: 1, clipping: true, clippingPlanes, toneMapped: false,
  });
}
