/* Writes materials as POV-Ray textures: colour, finish, interior, and the patterns of patterns.def at their real size.
 *
 * A pattern either fills space (noise, for patterns without direction) or lies on faces. A pattern on faces is a
 * pigment in the plane of x and z. It is rotated to each face by the face's normal: on floors it is along x and y, on
 * walls upright. The directions of walls are rounded to eight. On walls between these directions, the width of a unit
 * is wrong by at most 8 percent (cos 22.5 degrees). A picture is in the plane of x and y. It is placed on faces by the
 * directions of model/looks/picture.h. */
#include <math.h>

#include "backends/povray/povray.h"
#include "backends/povray/povray_files.h"
#include "backends/povray/povray_scene.h"
#include "model/scene.h"

void vs_povray_name(vs_writer *w, const char *text) {
  int count = 0;
  for (; *text != '\0' && count < 40; text++) {
    bool letter = (*text >= 'a' && *text <= 'z') || (*text >= 'A' && *text <= 'Z') || (*text >= '0' && *text <= '9');
    if (letter || *text == '_' || *text == '-') {
      vs_put(w, letter ? text : "_", 1);
      count++;
    }
  }
}

static void put_name(vs_emitter *e, const vs_material *m) {
  vs_puts(e->out, "M");
  vs_emit_put_material_number(e, m);
  if (m->name[0] != '\0') vs_puts(e->out, "_");
  vs_povray_name(e->out, m->name);
}

bool vs_povray_paint(vs_emitter *e, const vs_material *m) {
  vs_puts(e->out, "material { ");
  put_name(e, m);
  return vs_puts(e->out, " }");
}

static void put_word(vs_writer *w, const char *before, double x, const char *after) {
  vs_puts(w, before);
  vs_put_number(w, x);
  vs_puts(w, after);
}

/* ---- finish ---- */

static bool is_thin(const vs_material *m) { return m->transparency > 0 && m->ior == 1; }

static void put_finish(vs_emitter *e, const vs_material *m) {
  vs_writer *w = e->out;
  double gloss = 1 - m->roughness;
  put_word(w, "    finish { ambient ", vs_povray_ambient(e), " ");
  put_word(w, "diffuse ", vs_povray_diffuse(m), "");
  if (m->transparency > 0) {
    /* POV-Ray's fresnel term uses the interior's refractive index, which is 1 for thin glass. */
    if (is_thin(m))
      put_word(w, " specular ", 0.8 * gloss * gloss,
               " roughness 0.001 reflection { 0.04, 0.7 exponent 3 } conserve_energy }\n");
    else
      vs_puts(w, " specular 0.8 roughness 0.001 reflection { 0.02, 0.9 fresnel on } conserve_energy }\n");
  } else if (m->metallic > 0.5) {
    put_word(w, " brilliance 2 specular ", 0.3 + 0.6 * gloss, "");
    put_word(w, " roughness ", 0.002 + 0.1 * m->roughness * m->roughness, " metallic");
    put_word(w, " reflection { ", 0.12 + 0.5 * gloss * gloss, " metallic } }\n");
  } else {
    put_word(w, " specular ", 0.5 * gloss * gloss, "");
    put_word(w, " roughness ", 0.004 + 0.15 * m->roughness * m->roughness, "");
    if (gloss > 0.75) vs_puts(w, " reflection { 0, 0.25 fresnel on } conserve_energy");
    vs_puts(w, " }\n");
  }
}

/* Writes the refractive index, also for opaque materials, because fresnel reflection needs it. */
void vs_povray_interior(vs_emitter *e, const vs_material *m) {
  put_word(e->out, "  interior { ior ", m->ior >= 1 ? m->ior : 1.5, " }\n");
}

/* ---- colours ---- */

typedef struct {
  double rgb[3], clear;
} shade;

static shade first_of(const vs_material *m) { return (shade){ { m->red, m->green, m->blue }, m->transparency }; }
static shade second_of(const vs_material *m) {
  return (shade){ { m->pattern.red, m->pattern.green, m->pattern.blue }, m->transparency };
}

static shade times(shade s, double by) {
  for (int i = 0; i < 3; i++) s.rgb[i] = fmin(1, s.rgb[i] * by);
  return s;
}

static shade between(shade a, shade b, double t) {
  for (int i = 0; i < 3; i++) a.rgb[i] += t * (b.rgb[i] - a.rgb[i]);
  return a;
}

/* In POV-Ray, "filter" is light that passes through the material and takes its colour; "transmit" is light that keeps
 * its colour. */
static void put_color(vs_writer *w, shade s) {
  vs_puts(w, "color srgbft <");
  for (int i = 0; i < 3; i++) put_word(w, "", s.rgb[i], ", ");
  put_word(w, "", s.clear * 0.55, ", ");
  put_word(w, "", s.clear * 0.4, ">");
}

typedef struct {
  double at;
  shade color;
} stop;

static void put_map(vs_writer *w, const stop *stops, size_t count) {
  vs_puts(w, " color_map {");
  for (size_t i = 0; i < count; i++) {
    put_word(w, " [", stops[i].at, " ");
    put_color(w, stops[i].color);
    vs_puts(w, "]");
  }
  vs_puts(w, " }");
}
#define PUT_MAP(w, ...) put_map(w, (const stop[]){ __VA_ARGS__ }, sizeof(const stop[]){ __VA_ARGS__ } / sizeof(stop))

/* ---- patterns on faces ---- */

/* The parts of a masonry pattern, as functions of POV-Ray. `odd` is 1 in every second course (row of bricks or stones),
 * `along` is the position in a course in units of `length`, and `cell` numbers the bricks or stones. */
typedef struct {
  const char *along, *cell, *length;
  double height, joint; /* height of a course (row of units) and width of a joint, as fractions of a unit's width */
  double vary;          /* how much the units (bricks or stones) differ in colour; 1 is the difference among bricks */
} courses;

static const courses courses_of[VS_PATTERN_COUNT] = {
  [VS_PATTERN_BRICKS] = { "x/VS_W + .5*VS_Odd(z/VS_H)", "floor(VS_A(x,0,z))", "VS_W", 1 / 3., 0.044, 1 },
  [VS_PATTERN_ENGLISH] = { "x/VS_L(x,0,z) + .25*VS_Odd(z/VS_H)", "floor(VS_A(x,0,z))", "VS_W*(1 - .5*VS_Odd(z/VS_H))",
                           1 / 3., 0.044, 1 },
  [VS_PATTERN_FLEMISH] = { "VS_Bond(x/(1.5*VS_W) + .5*VS_Odd(z/VS_H))", "2*floor(VS_A(x,0,z)) + VS_Half(VS_A(x,0,z))",
                           "VS_W*(1 - .5*VS_Half(VS_A(x,0,z)))", 1 / 3., 0.044, 1 },
  [VS_PATTERN_ASHLAR] = { "x/VS_W + .5*VS_Odd(z/VS_H)", "floor(VS_A(x,0,z))", "VS_W", 1 / 2., 0.02, 0.5 },
  [VS_PATTERN_TILES] = { "x/VS_W", "floor(VS_A(x,0,z))", "VS_W", 1, 0.02, 0.25 },
  [VS_PATTERN_BOARDS] = { "x/(18*VS_W) + VS_Cells(.5, floor(z/VS_H) + .5, .5)", "floor(VS_A(x,0,z))", "18*VS_W", 1,
                          0.03, 0.6 },
};

/* Macros of POV-Ray for masonry. VS_Odd is 1 in every second course (row of bricks). VS_Bond alternates long and short
 * bricks, and VS_Half distinguishes them. VS_Faces lays a pigment on faces by their normal. */
static const char helpers[] =
    "#ifndef (VS_Cells)\n"
    "#declare VS_Cells = function { pattern { cells } }\n"
    "#declare VS_Noise = function { pattern { bozo } }\n"
    "#declare VS_Odd = function(x) { mod(abs(floor(x)), 2) }\n"
    "#declare VS_Half = function(x) { floor(2*(x - floor(x))) }\n"
    "#declare VS_Bond = function(x) { floor(x) + select(x - floor(x) - 2/3, .75*(x - floor(x)), .5 + 1.5*(x - floor(x) "
    "- 2/3)) }\n"
    "#macro VS_Slanting(P) slope { <.70710678, .70710678, 0> } pigment_map {\n"
    "  [.3087 P rotate z*45] [.3087 P rotate -z*45] [.6913 P rotate -z*45] [.6913 P rotate z*45] } #end\n"
    "#macro VS_Walls(P) slope { x } pigment_map {\n"
    "  [.0381 P rotate z*90] [.0381 VS_Slanting(P)] [.3087 VS_Slanting(P)] [.3087 P]\n"
    "  [.6913 P] [.6913 VS_Slanting(P)] [.9619 VS_Slanting(P)] [.9619 P rotate z*90] } #end\n"
    "#macro VS_Faces(P) slope { z } pigment_map {\n"
    "  [.1464 P rotate -x*90] [.1464 VS_Walls(P)] [.8536 VS_Walls(P)] [.8536 P rotate -x*90] } #end\n"
    "#end\n";

/* Returns the length of a metre in units of the scene. */
static double metre_of(const vs_emitter *e) { return e->unit / vs_scene_metres(e->scene); }

static void put_courses(vs_emitter *e, const vs_material *m, const courses *c) {
  vs_writer *w = e->out;
  double size = vs_pattern_size(&m->pattern), v = c->vary;
  shade first = first_of(m), joint = second_of(m);
  put_word(w, "#declare VS_W = ", size, ";\n");
  put_word(w, "#declare VS_H = ", size * c->height, ";\n");
  put_word(w, "#declare VS_J = ", size * c->joint, ";\n");
  put_word(w, "#declare VS_V = ", 0.25 * v, ";\n");
  if (m->pattern.kind ==
      VS_PATTERN_ENGLISH) { /* in English bond, all bricks of a course have the same length */
    vs_puts(w, "#declare VS_L = function(x,y,z) { ");
    vs_puts(w, c->length);
    vs_puts(w, " }\n#declare VS_A = function(x,y,z) { ");
    vs_puts(w, c->along);
  } else {
    vs_puts(w, "#declare VS_A = function(x,y,z) { ");
    vs_puts(w, c->along);
    vs_puts(w, " }\n#declare VS_L = function(x,y,z) { ");
    vs_puts(w, c->length);
  }
  vs_puts(w, " }\n#declare VS_C = function(x,y,z) { ");
  vs_puts(w, c->cell);
  vs_puts(w, " }\n#declare VS_P = pigment {\n  function { select(min(");
  vs_puts(w, m->pattern.kind == VS_PATTERN_FLEMISH ? "(2*VS_A(x,0,z) - floor(2*VS_A(x,0,z)))*VS_L(x,0,z)"
                                                   : "(VS_A(x,0,z) - floor(VS_A(x,0,z)))*VS_L(x,0,z)");
  vs_puts(w, ", z - floor(z/VS_H)*VS_H) - VS_J, 0,\n    .1 + .9*max(0, min(1, VS_Cells(VS_C(x,0,z) + .5, floor(z/VS_H) "
             "+ .5, .5)");
  vs_puts(w, m->pattern.kind == VS_PATTERN_BOARDS ? " + .5*VS_Noise(x*3/VS_W/9, z*12/VS_H, VS_C(x,0,z)) - .25"
                                                  : " + VS_V*(VS_Noise(x*40, 0, z*40) - .5)");
  vs_puts(w, "))) }\n ");
  PUT_MAP(w, { 0, joint }, { 0.05, joint }, { 0.05, times(first, 1 - 0.2 * v) }, { 0.45, first },
          { 0.82, times(first, 1 + 0.1 * v) }, { 1, times(first, 1 - 0.26 * v) });
  put_word(w, "\n  rotate y*", -m->pattern.angle, ""); /* rotates the pattern anticlockwise by its angle, as seen from
                                                        * -y */
  put_word(w, " scale ", metre_of(e), "\n}\n");
  vs_puts(w, "#undef VS_A\n#undef VS_L\n#undef VS_C\n"); /* POV-Ray does not allow a second declaration of a function */
}

static void put_grain(vs_emitter *e, const vs_material *m, const char *function, const stop *stops, size_t count) {
  vs_writer *w = e->out;
  put_word(w, "#declare VS_W = ", vs_pattern_size(&m->pattern), ";\n#declare VS_P = pigment {\n  function { ");
  vs_puts(w, function);
  vs_puts(w, " }\n ");
  put_map(w, stops, count);
  put_word(w, "\n  rotate y*", -m->pattern.angle, ""); /* rotates the pattern anticlockwise by its angle, as seen from
                                                        * -y */
  put_word(w, " scale ", metre_of(e), "\n}\n");
}

static bool lies_on_faces(vs_pattern p) {
  return courses_of[p].along != NULL || p == VS_PATTERN_GRAIN || p == VS_PATTERN_RIBBED || p == VS_PATTERN_BRUSHED;
}

/* Declares VS_P, the pigment of the material's pattern in the plane of x and z. */
static void put_face_pigment(vs_emitter *e, const vs_material *m) {
  shade a = first_of(m), b = second_of(m);
  vs_puts(e->out, helpers);
  switch (m->pattern.kind) {
  case VS_PATTERN_GRAIN:
    put_grain(e, m, ".65*VS_Noise(x*.5/VS_W, 0, z*5/VS_W) + .35*VS_Noise(x*2.5/VS_W, 7, z*45/VS_W)",
              (const stop[]){ { 0.15, b }, { 0.45, between(b, a, 0.75) }, { 0.6, a }, { 0.9, times(a, 1.08) } }, 4);
    break;
  case VS_PATTERN_RIBBED:
    put_grain(e, m, "abs(2*(x/VS_W - floor(x/VS_W)) - 1)",
              (const stop[]){ { 0, a },
                              { 0.92, times(a, 1.05) },
                              { 0.93, times(a, 1.15) },
                              { 0.96, times(a, 1.15) },
                              { 0.965, b },
                              { 1, b } },
              6);
    break;
  case VS_PATTERN_BRUSHED:
    put_grain(e, m, "VS_Noise(x*.3/VS_W, 0, z*120/VS_W)", (const stop[]){ { 0.2, b }, { 0.8, a } }, 2);
    break;
  default: put_courses(e, m, &courses_of[m->pattern.kind]); break;
  }
}

/* ---- pictures ---- */

/* Macros of POV-Ray for pictures. VS_Laid rotates the picture P to the faces of a tilt and an azimuth. VS_Side selects
 * the azimuth within a half turn, VS_Picture the tilt. S is 1 for azimuths to the north and -1 to the south. */
static const char picture_helpers[] =
    "#ifndef (VS_Step)\n"
    "#declare VS_Step = 22.5;\n"
    "#macro VS_Share(S, A) [.5 + .5*S*cos(radians(A)) #end\n"
    "#macro VS_Laid(P, T, A) P rotate x*T rotate z*(A + 90)] #end\n"
    "#macro VS_Side(P, T, S) slope { x } pigment_map {\n"
    "  #local I = 8; #while (I >= 0)\n"
    "    #local D = sin(radians(T));\n"
    "    #if (I < 8) VS_Share(D, (I + .5)*VS_Step) VS_Laid(P, T, S*I*VS_Step) #end\n"
    "    #if (I > 0) VS_Share(D, (I - .5)*VS_Step) VS_Laid(P, T, S*I*VS_Step) #end\n"
    "  #local I = I - 1; #end } #end\n"
    "#macro VS_Around(P, T) slope { y } pigment_map { [.5 VS_Side(P, T, -1)] [.5 VS_Side(P, T, 1)] } #end\n"
    "#macro VS_Picture(P) slope { z } pigment_map {\n"
    "  VS_Share(1, 7.5*VS_Step) P rotate x*180]\n"
    "  #local J = 7; #while (J >= 1)\n"
    "    VS_Share(1, (J + .5)*VS_Step) VS_Around(P, J*VS_Step)]\n"
    "    VS_Share(1, (J - .5)*VS_Step) VS_Around(P, J*VS_Step)]\n"
    "  #local J = J - 1; #end\n"
    "  VS_Share(1, .5*VS_Step) P] } #end\n"
    "#end\n";

/* Declares VS_P, a pigment with the picture in the plane of x and y: upright, and repeated over the plane. */
static void put_picture_pigment(vs_emitter *e, const vs_material *m) {
  vs_writer *w = e->out;
  vs_puts(w, picture_helpers);
  vs_puts(w, "#declare VS_P = pigment { image_map { ");
  if (!vs_povray_put_picture(e, m->pattern.picture, vs_emit_material_number(e, m))) w->failed = true;
  vs_puts(w, " interpolate 2 } ");
  put_word(w, "scale <", vs_pattern_size(&m->pattern), ", ");
  put_word(w, "", vs_pattern_height(&m->pattern), ", 1> ");
  put_word(w, "rotate z*", m->pattern.angle, "");
  put_word(w, " scale ", metre_of(e), " }\n");
}

/* ---- patterns through space ---- */

static void put_solid_pigment(vs_emitter *e, const vs_material *m) {
  vs_writer *w = e->out;
  shade a = first_of(m), b = second_of(m);
  double size = vs_pattern_size(&m->pattern) * metre_of(e);
  vs_puts(w, "    pigment { ");
  switch (m->pattern.kind) {
  case VS_PATTERN_MOTTLED:
    vs_puts(w, "bozo turbulence 0.9 octaves 6 omega 0.6");
    PUT_MAP(w, { 0.15, b }, { 0.5, a }, { 0.85, times(a, 1.03) });
    break;
  case VS_PATTERN_SPECKLED:
    vs_puts(w, "crackle solid");
    PUT_MAP(w, { 0, b }, { 0.25, b }, { 0.25, between(a, b, 0.4) }, { 0.5, a }, { 1, times(a, 1.1) });
    break;
  case VS_PATTERN_VEINED:
    vs_puts(w, "marble turbulence 0.9 octaves 7 omega 0.55");
    PUT_MAP(w, { 0, a }, { 0.6, between(a, b, 0.04) }, { 0.88, between(a, b, 0.2) }, { 0.97, between(a, b, 0.6) },
            { 1, b });
    break;
  case VS_PATTERN_PEBBLED:
    vs_puts(w, "crackle");
    PUT_MAP(w, { 0, b }, { 0.1, b }, { 0.2, between(b, a, 0.8) }, { 0.45, a }, { 1, times(a, 1.15) });
    break;
  case VS_PATTERN_GRASSY: /* a lawn's colour is a sum of three noises, for blades, tufts and patches */
    vs_puts(w, "average pigment_map {");
    for (int i = 0; i < 3; i++) {
      const double scale[] = { 1, 14, 110 }, share[] = { 1, 0.8, 1.2 };
      put_word(w, "\n      [", share[i], " bozo turbulence 0.6");
      PUT_MAP(w, { 0.2, times(a, 0.7) }, { 0.5, times(a, 0.92) }, { 0.8, b });
      put_word(w, " scale ", scale[i], "]");
    }
    vs_puts(w, " }");
    break;
  default: put_color(w, a); break;
  }
  put_word(w, " scale ", size, "");
  vs_puts(w, m->pattern.kind == VS_PATTERN_VEINED ? " rotate <20, 35, 50> }\n" : " }\n");
  switch (m->pattern.kind) {
  case VS_PATTERN_RIPPLED: put_word(w, "    normal { bumps 0.12 turbulence 0.4 scale ", size, " }\n"); break;
  case VS_PATTERN_PEBBLED: put_word(w, "    normal { crackle 0.5 scale ", size, " }\n"); break;
  case VS_PATTERN_GRASSY: put_word(w, "    normal { bumps 0.5 scale ", 0.5 * size, " }\n"); break;
  default: break;
  }
}

/* ---- the complete material ---- */

static bool shows(const vs_emitter *e, const vs_material *m, double pixel) {
  double unit = vs_pattern_size(&m->pattern) * metre_of(e);
  if (m->pattern.kind == VS_PATTERN_GRASSY) unit *= 110; /* in a lawn, the patches are visible from afar, but the blades
                                                          * are not */
  return m->pattern.kind != VS_PATTERN_NONE && unit >= pixel;
}

bool vs_povray_is_white(const vs_scene *s) {
  return s->style == VS_STYLE_ARCTIC || s->style == VS_STYLE_TECHNICAL;
}

/* Returns the material that the scene's style shows in place of m: in some styles white, or cardboard. Glass remains
 * glass. */
static const vs_material *shown(const vs_emitter *e, const vs_material *m) {
  static const vs_material white = { "", .93, .93, .93, 1, 0, 0, 1.5, { 0 } };
  static const vs_material card = { "", .9, .875, .82, 1, 0, 0, 1.5, { 0 } };
  if (m->transparency > 0) return m;
  return vs_povray_is_white(e->scene) ? &white : e->scene->style == VS_STYLE_MODEL ? &card : m;
}

void vs_povray_prepare_texture(vs_emitter *e, const vs_material *m, double pixel) {
  m = shown(e, m);
  if (!shows(e, m, pixel)) return;
  if (m->pattern.picture != NULL) put_picture_pigment(e, m);
  else if (lies_on_faces(m->pattern.kind)) put_face_pigment(e, m);
}

void vs_povray_texture(vs_emitter *e, const vs_material *m, double pixel) {
  vs_writer *w = e->out;
  m = shown(e, m);
  if (!shows(e, m, pixel)) {
    vs_puts(w, "    pigment { ");
    put_color(w, first_of(m));
    vs_puts(w, " }\n");
  } else if (m->pattern.picture != NULL)
    vs_puts(w, "    pigment { VS_Picture(VS_P) }\n");
  else if (lies_on_faces(m->pattern.kind))
    vs_puts(w, "    pigment { VS_Faces(VS_P) }\n");
  else
    put_solid_pigment(e, m);
  put_finish(e, m);
}

bool vs_povray_declare_material(vs_emitter *e, const vs_material *m, double pixel) {
  vs_writer *w = e->out;
  vs_povray_prepare_texture(e, m, pixel);
  vs_puts(w, "#declare ");
  put_name(e, m);
  vs_puts(w, " = material {\n  texture {\n");
  vs_povray_texture(e, m, pixel);
  vs_puts(w, "  }\n");
  vs_povray_interior(e, m);
  return vs_puts(w, "}\n");
}
