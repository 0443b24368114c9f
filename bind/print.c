/* Writes an object as text: the expression that creates it, by the table of fields in prims.def. An explicit stack
 * instead of recursion permits deep trees. */
#include "bind/print.h"

#include "bind/print_looks.h"
#include "model/store/array.h"
#include "model/walk.h"

#include <stdio.h>
#include <string.h>
#include <stdlib.h>

void vs_bind_number_text(char out[32], double d) {
  if (d == 0) d = 0; /* prints -0 as 0 */
  for (int digits = 15; digits <= 17; digits++) {
    snprintf(out, 32, "%.*g", digits, d);
    if (strtod(out, NULL) == d) return;
  }
}

#define TURN 6.283185307179586

static bool triple(const sink *k, const char *maker, vs_vec3 v) {
  return text(k, "(") && text(k, maker) && text(k, " ") && number(k, v.x) && text(k, " ") && number(k, v.y) &&
         text(k, " ") && number(k, v.z) && text(k, ")");
}

static bool points(const sink *k, const vs_points *p) {
  if (!text(k, "(list")) return false;
  for (uint32_t i = 0; i < p->count; i++)
    if (!text(k, " ") || !triple(k, "xyz", p->at[i])) return false;
  return text(k, ")");
}

static bool rows(const sink *k, const vs_points *p, size_t columns) {
  if (!text(k, " (list")) return false;
  for (size_t i = 0; i < p->count; i++) {
    if (i % columns == 0 && !text(k, i ? ") (list" : " (list")) return false;
    if (!text(k, " ") || !triple(k, "xyz", p->at[i])) return false;
  }
  return text(k, "))");
}

static bool faces(const sink *k, const vs_faces *f) { /* Writes indices counted from 1, as the constructor expects
                                                       * them. */
  if (!text(k, "'(")) return false;
  for (uint32_t i = 0; i < f->count; i++) {
    if (!text(k, i ? " (" : "(")) return false;
    for (uint32_t c = vs_faces_starts(f)[i]; c < vs_faces_starts(f)[i + 1]; c++)
      if ((c > vs_faces_starts(f)[i] && !text(k, " ")) || !number(k, (double)vs_faces_corners(f)[c] + 1)) return false;
    if (!text(k, ")")) return false;
  }
  return text(k, ")");
}

static bool matrix(const sink *k, const vs_affine *m) {
  if (!text(k, "(make-matrix")) return false;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 4; j++)
      if (!text(k, " ") || !number(k, m->m[i][j])) return false;
  return text(k, " 0 0 0 1)");
}

/* Writes a field of the node's data. */
static bool field(const sink *k, const vs_field_info *f, const void *data) {
  const char *at = (const char *)data + f->offset;
  switch (f->type) {
    case VS_FIELD_real: return number(k, *(const double *)(const void *)at);
    case VS_FIELD_integer: return number(k, *(const int32_t *)(const void *)at);
    case VS_FIELD_boolean: return text(k, *(const bool *)(const void *)at ? "#t" : "#f");
    case VS_FIELD_point: return triple(k, "xyz", *(const vs_vec3 *)(const void *)at);
    case VS_FIELD_vector: return triple(k, "vxyz", *(const vs_vec3 *)(const void *)at);
    case VS_FIELD_affine: return matrix(k, (const vs_affine *)(const void *)at);
    case VS_FIELD_points: return points(k, *(const vs_points *const *)(const void *)at);
    case VS_FIELD_faces: return faces(k, *(const vs_faces *const *)(const void *)at);
    case VS_FIELD_text: return quoted(k, *(const char *const *)(const void *)at);
    case VS_FIELD_ticket: return number(k, (*(const vs_ticket *const *)(const void *)at)->id);
    case VS_FIELD_material:
      return vs_bind_print_material(*(const vs_material *const *)(const void *)at, k->put, k->to);
  }
  return false;
}

static const vs_field_info *find(const vs_node *n, const char *argument) {
  const vs_kind_info *i = vs_kind_get((vs_kind)n->kind);
  for (size_t f = 0; f < i->field_count; f++)
    if (!strcmp(i->fields[f].argument, argument)) return &i->fields[f];
  return NULL;
}

/* Writes a blank and a field for each of the names. Then writes the field `segments` as a keyword if the constructor's
 * call gave it. */
static bool named(const sink *k, const vs_node *n, const char *const *names) {
  for (; *names; names++) {
    const vs_field_info *f = find(n, *names);
    if (!f || !text(k, " ") || !field(k, f, vs_node_data(n))) return false;
  }
  const vs_field_info *s = find(n, "segments");
  return !s || !*(const int32_t *)(const void *)((const char *)vs_node_data(n) + s->offset) ||
         (text(k, " #:segments ") && field(k, s, vs_node_data(n)));
}

/* Writes "(make-NAME" and the fields in the order of prims.def. `segments`, the last field, is written only if the
 * constructor's call gave it. */
static bool by_row(const sink *k, const vs_node *n) {
  const vs_kind_info *i = vs_kind_get((vs_kind)n->kind);
  if (!text(k, "(make-") || !text(k, i->name)) return false;
  for (size_t f = 0; f < i->field_count; f++)
    if (strcmp(i->fields[f].argument, "segments") && !(text(k, " ") && field(k, &i->fields[f], vs_node_data(n))))
      return false;
  return named(k, n, (const char *const[]){ NULL });
}

static bool half_space(const sink *k, const struct vs_half_space *h) {
  return text(k, "(make-half-space (make-plane ") && triple(k, "xyz", h->point) && text(k, " ") &&
         triple(k, "vxyz", h->normal) && text(k, ")");
}

/* Writes a height field: the rows of heights, and the rectangle from the first to the last point. */
static bool height_field(const sink *k, const struct vs_height_field *h) {
  const vs_points *p = h->points;
  if (!text(k, "(make-height-field '(")) return false;
  for (uint32_t i = 0; i < p->count; i++)
    if (!text(k, i % (uint32_t)h->columns ? " " : i ? ") (" : "(") || !number(k, p->at[i].z)) return false;
  vs_vec3 a = p->at[0], b = p->at[p->count - 1];
  return text(k, ")) ") && triple(k, "xyz", vs_v3(a.x, a.y, 0)) && text(k, " ") &&
         triple(k, "xyz", vs_v3(b.x, b.y, 0)) && text(k, " #:low ") && number(k, h->low);
}

static bool grid_ways(const sink *k, bool closed_u, bool closed_v) {
  return (!closed_u || text(k, " #:closed-u #t")) && (!closed_v || text(k, " #:closed-v #t"));
}

static bool is_moved(const vs_affine *m) { return vs_affine_is_translation(m); }

/* Writes "(make-text" with the keywords whose values differ from their defaults. */
static bool letters(const sink *k, const vs_node *n) {
  const struct vs_letters *t = VS_AS(letters, n);
  bool ok = text(k, "(make-text") && named(k, n, (const char *const[]){ "p", "size", "string", NULL });
  if (*t->font) ok = ok && text(k, " #:font ") && quoted(k, t->font);
  if (strcmp(t->align, "left")) ok = ok && text(k, " #:align '") && text(k, t->align);
  if (strcmp(t->valign, "baseline")) ok = ok && text(k, " #:valign '") && text(k, t->valign);
  if (t->spacing != 1) ok = ok && text(k, " #:spacing ") && number(k, t->spacing);
  return ok;
}

/* Writes the start of an expression, for example "(make-sphere", and the fields that precede the children. */
static bool opening(const sink *k, const vs_node *n) {
  const char *name = vs_kind_get((vs_kind)n->kind)->name;
  static const char *const none[] = { NULL };
  switch ((vs_kind)n->kind) {
    case VS_EMPTY: return text(k, "(empty-object");
    case VS_LINE: /* a line of one point is the apex of a loft, and is written as a point */
      if (VS_AS(line, n)->points->count == 1) {
        vs_vec3 p = VS_AS(line, n)->points->at[0];
        return text(k, "(xyz ") && number(k, p.x) && text(k, " ") && number(k, p.y) && text(k, " ") && number(k, p.z);
      }
      return text(k, VS_AS(line, n)->closed ? "(make-polygon" : "(make-line") &&
             named(k, n, (const char *const[]){ "points", NULL });
    case VS_SPLINE: {
      const struct vs_spline *s = VS_AS(spline, n);
      if (!text(k, "(make-spline (list")) return false;
      for (uint32_t i = 0; i < s->points->count + (s->closed ? 1u : 0u); i++)
        if (!text(k, " ") || !triple(k, "xyz", s->points->at[i % s->points->count])) return false;
      bool tangents = !vs_v3_equal(s->start_tangent, vs_v3(0, 0, 0)) || !vs_v3_equal(s->end_tangent, vs_v3(0, 0, 0));
      return text(k, ")") &&
             named(k, n, tangents ? (const char *const[]){ "start-tangent", "end-tangent", NULL } : none);
    }
    case VS_POLYFACE_MESH:
      return text(k, "(make-polyface-mesh") && named(k, n, (const char *const[]){ "points", "faces", NULL });
    case VS_REGION: return text(k, "(make-region");
    case VS_TEXT: return letters(k, n);
#include "model/cases/shape_cases.def"
      if (n->kind == VS_HALF_SPACE) return half_space(k, VS_AS(half_space, n));
      if (n->kind == VS_HEIGHT_FIELD) return height_field(k, VS_AS(height_field, n)); /* fall through */
    case VS_ARC: case VS_CIRCLE: case VS_XLINE: case VS_RAY: return by_row(k, n);
    case VS_HULL:
      return text(k, "(hull") &&
             (!VS_AS(hull, n)->points->count || named(k, n, (const char *const[]){ "points", NULL }));
    case VS_SLICE: return text(k, "(do-slice");
    case VS_DEFORM: { /* a scope's y is the world's Z, and its front face points to -Y, so the corners are written in
                       * another order */
      const struct vs_deform *d = VS_AS(deform, n);
      const vs_vec3 corner[8] = { d->c010, d->c110, d->c011, d->c111, d->c000, d->c100, d->c001, d->c101 };
      bool ok = text(k, "(scope-place (make-ffd-scope");
      for (int i = 0; ok && i < 8; i++) ok = text(k, " ") && triple(k, "xyz", corner[i]);
      return ok && text(k, ")");
    }
    case VS_EXTRUDE: return text(k, "(do-extrude");
    case VS_SWEEP: return text(k, "(do-sweep");
    case VS_THICKEN: case VS_REVOLVE: return text(k, "(do-") && text(k, name);
    case VS_LOFT: case VS_RULED_LOFT: case VS_GUIDED_LOFT: return text(k, "(do-") && text(k, name) && text(k, " (list");
    case VS_GRID_MESH: {
      const struct vs_grid_mesh *g = VS_AS(grid_mesh, n);
      return text(k, "(make-mesh") && rows(k, g->points, (size_t)g->columns) && grid_ways(k, g->closed_u, g->closed_v);
    }
    case VS_GRID_SURFACE: {
      const struct vs_grid_surface *g = VS_AS(grid_surface, n);
      return text(k, "(make-surface") && rows(k, g->points, (size_t)g->columns) &&
             grid_ways(k, g->closed_u, g->closed_v);
    }
    case VS_JOIN: return text(k, "(join-curves");
    case VS_OFFSET: case VS_SECTION: case VS_PROJECT: case VS_EDGES: return text(k, "(do-") && text(k, name);
    case VS_TRANSFORM: return text(k, is_moved(&VS_AS(transform, n)->matrix) ? "(do-move" : "(do-transform");
    case VS_MATERIAL: return vs_bind_print_painting(VS_AS(material, n)->material, k->put, k->to);
    case VS_NATIVE:
      return text(k, "(native '") && text(k, VS_AS(native, n)->target) &&
             named(k, n, (const char *const[]){ "text", NULL }) && text(k, " #:otherwise");
    case VS_CUSTOM: return text(k, VS_AS(custom, n)->made); /* written as the program's own call, without the child that
                                                             * a drawing function created */
    case VS_HIGHLIGHT: case VS_GHOST: case VS_ONLY: return text(k, "(") && text(k, name);
    case VS_PART: return text(k, "(part") && named(k, n, (const char *const[]){ "name", NULL });
    case VS_LAYER: return text(k, "(layer") && named(k, n, (const char *const[]){ "name", NULL });
    case VS_UNION: case VS_INTERSECTION: case VS_DIFFERENCE: return text(k, "(") && text(k, name);
    case VS_KIND_COUNT: break;
  }
  return text(k, "(make-") && text(k, name);
}

/* Writes the fields that follow the children, and the closing parenthesis. */
static bool closing(const sink *k, const vs_node *n) {
  if (n->kind == VS_CUSTOM) return true;
  if (n->kind == VS_EXTRUDE) {
    const struct vs_extrude *e = VS_AS(extrude, n);
    if (n->child_count == 1 &&
        !(text(k, " ") && (e->along.x == 0 && e->along.y == 0 ? number(k, e->along.z) : triple(k, "vxyz", e->along))))
      return false;
    if (e->taper != 0 && !(text(k, " ") && number(k, e->taper))) return false;
    if (e->twist != 0 && !(text(k, " #:twist ") && number(k, e->twist))) return false;
    if (e->scale != 1 && !(text(k, " #:scale ") && number(k, e->scale))) return false;
    if (e->center && !text(k, " #:centre #t")) return false;
  } else if (n->kind == VS_SWEEP) {
    const struct vs_sweep *s = VS_AS(sweep, n);
    if ((s->twist != 0 || s->scale != 1) &&
        !(text(k, " ") && number(k, s->twist) && text(k, " ") && number(k, s->scale)))
      return false;
    if (s->has_base && !(text(k, " #:base ") && triple(k, "xyz", s->base))) return false;
    if (vs_v3_length(s->up) > 0 && !(text(k, " #:up ") && triple(k, "vxyz", s->up))) return false;
  } else if (n->kind == VS_SLICE) {
    const struct vs_slice *s = VS_AS(slice, n);
    if (!text(k, " (make-plane ") || !triple(k, "xyz", s->point) || !text(k, " ") || !triple(k, "vxyz", s->normal) ||
        !text(k, ")"))
      return false;
  } else if (n->kind == VS_REVOLVE) {
    const struct vs_revolve *r = VS_AS(revolve, n);
    if (!text(k, " (make-axis ") || !triple(k, "xyz", r->at) || !text(k, " ") || !triple(k, "vxyz", r->direction) ||
        !text(k, ")"))
      return false;
    if ((r->start != 0 || r->end != TURN) &&
        !(text(k, " ") && number(k, r->start) && text(k, " ") && number(k, r->end)))
      return false;
    if (!named(k, n, (const char *const[]){ NULL })) return false;
  } else if (n->kind == VS_LOFT) {
    const struct vs_loft *l = VS_AS(loft, n);
    bool held = l->start_hold > 0 || l->end_hold > 0;
    if (!text(k, ")") || (held && !named(k, n, (const char *const[]){ "a1", "m1", "a2", "m2", NULL }))) return false;
  } else if (n->kind == VS_RULED_LOFT || (n->kind == VS_GUIDED_LOFT && !VS_AS(guided_loft, n)->path)) {
    if (!text(k, ")")) return false;
  } else if (n->kind == VS_OFFSET) {
    const struct vs_offset *o = VS_AS(offset, n);
    if (!text(k, " ") || !number(k, o->distance) ||
        (*o->corners != 'm' && !(text(k, " #:corners '") && text(k, o->corners))))
      return false;
    if (o->segments && !(text(k, " #:segments ") && number(k, o->segments))) return false;
  } else if (n->kind == VS_SECTION || n->kind == VS_PROJECT) {
    vs_vec3 at = n->kind == VS_SECTION ? VS_AS(section, n)->point : VS_AS(project, n)->point;
    vs_vec3 normal = n->kind == VS_SECTION ? VS_AS(section, n)->normal : VS_AS(project, n)->normal;
    if (!text(k, " (make-plane ") || !triple(k, "xyz", at) || !text(k, " ") || !triple(k, "vxyz", normal) ||
        !text(k, ")"))
      return false;
  } else if (n->kind == VS_THICKEN) {
    if (!named(k, n, (const char *const[]){ "width", NULL })) return false;
  } else if (n->kind == VS_TRANSFORM) {
    const vs_affine *m = &VS_AS(transform, n)->matrix;
    if (!text(k, " ") || !(is_moved(m) ? triple(k, "vxyz", vs_v3(m->m[0][3], m->m[1][3], m->m[2][3])) : matrix(k, m)))
      return false;
  }
  return text(k, ")");
}

/* Writes the text that precedes a child. After the last section of a guided loft, ends the list of sections and begins
 * the list of guides. */
enum { GUIDES = 1 << 30 };
static bool between(const sink *k, uint32_t *left) {
  if (!*left || --*left & (GUIDES - 1)) return true;
  bool guides = *left & GUIDES;
  *left = 0;
  return text(k, guides ? ") (list" : ")");
}

bool vs_bind_print_node(const vs_node *n, vs_put_text *put, void *to) {
  enum { MOST = 20000 }; /* limits the text, since that of a tree with shared nodes can be exponentially long */
  sink k = { put, to };
  vs_walk *w = vs_walk_new(n->store, (vs_ref){ (vs_node *)(uintptr_t)n, NULL });
  vs_ref ref;
  size_t depth, printed = 0;
  /* left[d]: for a guided loft at depth d, 1 + the number of its sections that are not yet written. */
  uint32_t *left = vs_zeros((size_t)n->depth + 1, sizeof *left);
  bool ok = w != NULL && left != NULL;
  while (ok) {
    vs_walk_event e = vs_walk_next(w, &ref, &depth);
    if (e == VS_WALK_DONE) break;
    if (e == VS_WALK_FAILED) ok = false;
    else if (e == VS_WALK_ENTER) {
      const struct vs_guided_loft *g = ref.node->kind == VS_GUIDED_LOFT ? VS_AS(guided_loft, ref.node) : NULL;
      left[depth] = g ? ((uint32_t)g->section_count + 1) | (g->path ? 0 : GUIDES) : 0;
      ok = (depth == 0 || (between(&k, &left[depth - 1]) && text(&k, " "))) && opening(&k, ref.node);
      if (ref.node->kind == VS_CUSTOM) vs_walk_skip(w);
      else if (++printed > MOST && ok && ref.node->child_count) ok = text(&k, " ..."), vs_walk_skip(w);
    } else ok = closing(&k, ref.node);
  }
  vs_walk_free(w);
  free(left);
  return ok;
}
