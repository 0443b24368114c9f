/* Writes .ifc (IFC 4, as text): a project with a site, a building and a storey for each `level` note. An object is an
 * element; its layer determines the class (classes.def). An element's storey is the highest that begins below a tenth
 * of the element's height.
 *
 * Boxes, cylinders, and straight extrusions of polygons and circles are written as swept solids, other objects as
 * faces. A node that is placed several times without a change of size is a mapped representation, written once.
 * Materials are written as surface styles, and as materials by name. Debian has no C library that writes IFC.
 *
 * A line of the file has a number, by which other lines refer to it. The members below that contain such numbers are
 * called `line` numbers. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "backends/ifc/ifc_text.h"
#include "model/store/nodemap.h"

/* A storey: the line numbers of the storey and of its placement, its height, and the list of its elements. */
typedef struct { unsigned line, placement; double height; vs_ifc_list elements; } ifc_storey;

/* A shape that several elements have. map: line number of its representation map; bounds: in its own coordinates;
 * styled: whether its parts have their own materials. */
typedef struct { unsigned map; vs_bounds bounds; bool styled; } ifc_map;

/* The element that openings void: the line numbers of the element and of its placement, and the placement itself. */
typedef struct { unsigned line, placement; vs_affine place; } ifc_host;

typedef struct {
  unsigned last;          /* number of the last line written */
  unsigned things;        /* number of global ids written so far */
  unsigned body;          /* line number of the subcontext `Body`, to which shapes belong */
  unsigned origin, axes, here; /* line numbers: of the point 0 0 0, of the coordinate frame at this point, and of the
                                * placement of the whole model */
  unsigned unmoved;       /* line number of the identity map, by which mapped shapes are used */
  ifc_storey *storeys;    /* the storeys, lowest first */
  size_t storey_count, storey_room;
  ifc_map *maps;
  size_t map_count, map_room;
  ifc_host host;          /* the last element that is no opening and fills none; line 0: none yet */
  unsigned opening;       /* line number of the opening that the next window or door fills; 0: none */
  vs_nodemap shared;      /* maps a node to 1 + the index of its ifc_map */
  unsigned *styles;       /* styles[i]: line number of the surface style of material i; 0: not written yet */
  vs_ifc_list *painted;   /* painted[i]: list of the elements with material i */
  vs_ifc_list items;      /* line numbers of the items of the shape that is being written */
  vs_bounds bounds;       /* bounds of the shape that is being written */
  bool mirrored;          /* whether the placement mirrors the shape that is being written, so that the corners of its
                           * faces are reversed */
  bool styled;            /* whether parts of the shape that is being written have their own materials */
} ifc;

static ifc *state_of(const vs_emitter *e) { return e->state; }
static unsigned next_line(vs_emitter *e) { return ++state_of(e)->last; }

/* ---- points and frames ---- */

static unsigned put_point(vs_emitter *e, vs_vec3 p) {
  unsigned line = next_line(e);
  vs_ifc_begin(e->out, line, "IFCCARTESIANPOINT");
  vs_ifc_triple(e->out, p);
  vs_ifc_end(e->out);
  return line;
}

static unsigned put_direction(vs_emitter *e, vs_vec3 v) {
  unsigned line = next_line(e);
  vs_ifc_begin(e->out, line, "IFCDIRECTION");
  vs_ifc_triple(e->out, v);
  vs_ifc_end(e->out);
  return line;
}

/* Writes a coordinate frame at a point, by its Z and X axes, which are perpendicular unit vectors. */
static unsigned put_frame(vs_emitter *e, vs_vec3 at, vs_vec3 z, vs_vec3 x) {
  unsigned point = put_point(e, at), up = put_direction(e, z), across = put_direction(e, x), line = next_line(e);
  vs_ifc_begin(e->out, line, "IFCAXIS2PLACEMENT3D");
  vs_putf(e->out, "#%u,#%u,#%u", point, up, across);
  vs_ifc_end(e->out);
  return line;
}

static unsigned put_placement(vs_emitter *e, unsigned within, unsigned frame) {
  unsigned line = next_line(e);
  vs_ifc_begin(e->out, line, "IFCLOCALPLACEMENT");
  if (within > 0) vs_ifc_reference(e->out, within);
  else vs_puts(e->out, "$");
  vs_putf(e->out, ",#%u", frame);
  vs_ifc_end(e->out);
  return line;
}

/* Begins the line of an object that has a global id: NAME('id',$, . */
static unsigned begin_thing(vs_emitter *e, const char *name) {
  unsigned line = next_line(e);
  vs_ifc_begin(e->out, line, name);
  vs_ifc_id(e->out, e->scene->title, ++state_of(e)->things);
  vs_puts(e->out, ",$,");
  return line;
}

/* ---- looks ---- */

static unsigned style_of(vs_emitter *e, const vs_material *m) {
  ifc *d = state_of(e);
  size_t number = vs_emit_material_number(e, m);
  if (d->styles[number] > 0) return d->styles[number];
  vs_writer *w = e->out;
  unsigned color = next_line(e), shading = next_line(e), style = next_line(e);
  vs_ifc_begin(w, color, "IFCCOLOURRGB");
  vs_puts(w, "$");
  const double rgb[] = { m->red, m->green, m->blue };
  for (int i = 0; i < 3; i++) vs_puts(w, ","), vs_ifc_real(w, rgb[i]);
  vs_ifc_end(w);
  vs_ifc_begin(w, shading, "IFCSURFACESTYLESHADING");
  vs_putf(w, "#%u,", color);
  vs_ifc_real(w, 0.8 * m->transparency);
  vs_ifc_end(w);
  vs_ifc_begin(w, style, "IFCSURFACESTYLE");
  if (m->name[0] != '\0') vs_ifc_text(w, m->name);
  else vs_puts(w, "$");
  vs_putf(w, ",.BOTH.,(#%u)", shading);
  vs_ifc_end(w);
  return d->styles[number] = style;
}

static void put_style(vs_emitter *e, unsigned item, const vs_material *m) {
  if (m == NULL) return;
  unsigned style = style_of(e, m), line = next_line(e);
  vs_ifc_begin(e->out, line, "IFCSTYLEDITEM");
  vs_putf(e->out, "#%u,(#%u),$", item, style);
  vs_ifc_end(e->out);
}

/* ---- swept solids ---- */

/* A profile: loops of polygons, of which the first is the outer one, or a circle. */
typedef struct {
  const vs_points *loops[64];
  size_t loop_count;
  double radius;       /* radius of the circle; 0: the profile consists of loops */
  vs_vec3 at, z, x, y; /* frame of the profile's plane: origin, normal, and axes x and y */
} ifc_profile;

static vs_vec3 loop_normal(const vs_points *p) {
  vs_vec3 sum = { 0, 0, 0 };
  for (uint32_t i = 1; i + 1 < p->count; i++)
    sum = vs_v3_add(sum, vs_v3_cross(vs_v3_sub(p->at[i], p->at[0]), vs_v3_sub(p->at[i + 1], p->at[0])));
  return sum;
}

/* Returns true if the point p lies within the loop, both projected along z. */
static bool within_loop(const ifc_profile *f, const vs_points *loop, vs_vec3 p) {
  bool inside = false;
  double px = vs_v3_dot(p, f->x), py = vs_v3_dot(p, f->y);
  for (uint32_t i = 0, k = loop->count - 1; i < loop->count; k = i++) {
    double ax = vs_v3_dot(loop->at[i], f->x), ay = vs_v3_dot(loop->at[i], f->y), bx = vs_v3_dot(loop->at[k], f->x),
           by = vs_v3_dot(loop->at[k], f->y);
    if ((ay > py) != (by > py) && px < (bx - ax) * (py - ay) / (by - ay) + ax) inside = !inside;
  }
  return inside;
}

/* Sets the frame of a profile of loops. Returns false if the loops are not in one plane, or if a later loop is no hole
 * of the first. */
static bool frame_loops(ifc_profile *f) {
  size_t outer = 0;
  for (size_t i = 1; i < f->loop_count; i++)
    if (vs_v3_length(loop_normal(f->loops[i])) > vs_v3_length(loop_normal(f->loops[outer]))) outer = i;
  const vs_points *first = f->loops[outer];
  f->loops[outer] = f->loops[0], f->loops[0] = first;
  vs_vec3 normal = loop_normal(first), side = vs_v3_sub(first->at[1], first->at[0]);
  double size = vs_v3_length(side);
  if (!(vs_v3_length(normal) > 0) || !(size > 0)) return false;
  f->at = first->at[0], f->z = vs_v3_unit(normal), f->x = vs_v3_unit(side), f->y = vs_v3_cross(f->z, f->x);
  for (size_t i = 0; i < f->loop_count; i++) {
    for (uint32_t k = 0; k < f->loops[i]->count; k++)
      if (fabs(vs_v3_dot(vs_v3_sub(f->loops[i]->at[k], f->at), f->z)) > 1e-9 * size) return false;
    for (size_t k = 0; i > 0 && k < f->loop_count; k++)
      if (k != i && within_loop(f, f->loops[k], f->loops[i]->at[0]) != (k == 0)) return false;
  }
  return true;
}

static bool profile_of(const vs_node *n, ifc_profile *f) {
  *f = (ifc_profile){ .loop_count = 0 };
  const vs_node *only = n->kind == VS_REGION && n->child_count == 1 ? n->children[0].node : n;
  if (only->kind == VS_CIRCLE && VS_AS(circle, only)->segments == 0) {
    f->at = VS_AS(circle, only)->center, f->radius = VS_AS(circle, only)->radius;
    f->x = vs_v3(1, 0, 0), f->y = vs_v3(0, 1, 0), f->z = vs_v3(0, 0, 1);
    return true;
  }
  bool region = n->kind == VS_REGION;
  for (uint32_t i = 0; i < (region ? n->child_count : 1); i++) {
    const vs_node *c = region ? n->children[i].node : n;
    if (c->kind != VS_LINE || !VS_AS(line, c)->closed || VS_AS(line, c)->points->count < 3 || f->loop_count == 64)
      return false;
    f->loops[f->loop_count++] = VS_AS(line, c)->points;
  }
  return f->loop_count > 0 && frame_loops(f);
}

static unsigned put_loop(vs_emitter *e, const ifc_profile *f, const vs_points *loop) {
  vs_writer *w = e->out;
  unsigned points = next_line(e), curve = next_line(e);
  vs_ifc_begin(w, points, "IFCCARTESIANPOINTLIST2D");
  for (uint32_t i = 0; i <= loop->count; i++) {
    vs_vec3 p = vs_v3_sub(loop->at[i % loop->count], f->at);
    vs_puts(w, i == 0 ? "((" : ",(");
    vs_ifc_real(w, vs_v3_dot(p, f->x));
    vs_puts(w, ",");
    vs_ifc_real(w, vs_v3_dot(p, f->y));
    vs_puts(w, ")");
  }
  vs_puts(w, ")");
  vs_ifc_end(w);
  vs_ifc_begin(w, curve, "IFCINDEXEDPOLYCURVE");
  vs_putf(w, "#%u,$,$", points);
  vs_ifc_end(w);
  return curve;
}

static unsigned put_profile(vs_emitter *e, const ifc_profile *f) {
  vs_writer *w = e->out;
  if (f->radius > 0) {
    unsigned line = next_line(e);
    vs_ifc_begin(w, line, "IFCCIRCLEPROFILEDEF");
    vs_puts(w, ".AREA.,$,$,");
    vs_ifc_real(w, f->radius);
    vs_ifc_end(w);
    return line;
  }
  unsigned curves[64];
  for (size_t i = 0; i < f->loop_count; i++) curves[i] = put_loop(e, f, f->loops[i]);
  unsigned line = next_line(e);
  vs_ifc_begin(w, line, f->loop_count > 1 ? "IFCARBITRARYPROFILEDEFWITHVOIDS" : "IFCARBITRARYCLOSEDPROFILEDEF");
  vs_putf(w, ".AREA.,$,#%u", curves[0]);
  for (size_t i = 1; i < f->loop_count; i++) vs_putf(w, i == 1 ? ",(#%u" : ",#%u", curves[i]);
  if (f->loop_count > 1) vs_puts(w, ")");
  vs_ifc_end(w);
  return line;
}

/* Writes the solid that the profile sweeps along a vector, as an item. Returns false if the vector lies in the
 * profile's plane. */
static bool put_swept(vs_emitter *e, const ifc_profile *f, vs_vec3 along) {
  ifc *d = state_of(e);
  double length = vs_v3_length(along), rise = vs_v3_dot(along, f->z);
  if (!(fabs(rise) > 1e-9 * length)) return false;
  unsigned profile = put_profile(e, f), frame = put_frame(e, f->at, f->z, f->x);
  unsigned way = put_direction(
      e, vs_v3_scale(vs_v3(vs_v3_dot(along, f->x), vs_v3_dot(along, f->y), rise), 1 / length));
  unsigned line = next_line(e);
  vs_ifc_begin(e->out, line, "IFCEXTRUDEDAREASOLID");
  vs_putf(e->out, "#%u,#%u,#%u,", profile, frame, way);
  vs_ifc_real(e->out, length);
  vs_ifc_end(e->out);
  for (size_t i = 0; i < f->loop_count; i++)
    for (uint32_t k = 0; k < f->loops[i]->count; k++) {
      vs_bounds_add(&d->bounds, f->loops[i]->at[k]);
      vs_bounds_add(&d->bounds, vs_v3_add(f->loops[i]->at[k], along));
    }
  for (int i = 0; f->radius > 0 && i < 4; i++) {
    vs_vec3 r = vs_v3_scale(i < 2 ? f->x : f->y, i % 2 ? f->radius : -f->radius), p = vs_v3_add(f->at, r);
    vs_bounds_add(&d->bounds, p);
    vs_bounds_add(&d->bounds, vs_v3_add(p, along));
  }
  return vs_ifc_add(e, &d->items, line);
}

static bool put_box(vs_emitter *e, const struct vs_box *b) {
  const vs_vec3 at[4] = { b->p, { b->q.x, b->p.y, b->p.z }, { b->q.x, b->q.y, b->p.z }, { b->p.x, b->q.y, b->p.z } };
  vs_points *loop = vs_points_new(e->scene->store, at, 4);
  if (loop == NULL) return vs_emit_no_memory(e);
  ifc_profile f = { .loops = { loop }, .loop_count = 1 };
  bool ok = frame_loops(&f) && put_swept(e, &f, vs_v3(0, 0, b->q.z - b->p.z));
  vs_points_release(e->scene->store, loop);
  return ok;
}

static bool put_cylinder(vs_emitter *e, const struct vs_cylinder *c) {
  vs_vec3 along = vs_v3_sub(c->top, c->base), z = vs_v3_unit(along);
  vs_vec3 x = vs_v3_unit(vs_v3_cross(fabs(z.z) < 0.9 ? vs_v3(0, 0, 1) : vs_v3(0, 1, 0), z));
  return put_swept(e, &(ifc_profile){ .radius = c->radius, .at = c->base, .z = z, .x = x, .y = vs_v3_cross(z, x) },
                   along);
}

/* If the node can be a swept solid, writes it as such and returns true. */
static bool put_solid(vs_emitter *e, const vs_node *n) {
  ifc_profile f;
  if (n->kind == VS_BOX) return put_box(e, VS_AS(box, n));
  if (n->kind == VS_CYLINDER && VS_AS(cylinder, n)->segments == 0) return put_cylinder(e, VS_AS(cylinder, n));
  if (n->kind != VS_EXTRUDE || n->class_ != VS_SOLID || n->child_count != 1) return false;
  const struct vs_extrude *x = VS_AS(extrude, n);
  return x->taper == 0 && x->twist == 0 && x->scale == 1 && !x->center && profile_of(n->children[0].node, &f) &&
         put_swept(e, &f, x->along);
}

/* ---- faces ---- */

/* Writes the triangles of the solid that have material number `paint`, as an item. points: line number of the list of
 * points; all: writes all triangles. */
static bool put_faces(vs_emitter *e, const vs_solid *m, size_t paint, unsigned points, bool all, bool closed) {
  const ifc *d = state_of(e);
  vs_writer *w = e->out;
  unsigned line = 0;
  for (size_t i = 0; i < m->mesh.triangle_count && !w->failed; i++) {
    const uint32_t *t = m->mesh.triangles[i];
    uint32_t tag = m->mesh.tags != NULL ? m->mesh.tags[i] : 0;
    size_t own = tag < m->part_count ? vs_emit_material_number(e, m->parts[tag].material) : 0;
    if (!all && own != paint) continue;
    if (line == 0) {
      line = next_line(e);
      vs_ifc_begin(w, line, "IFCTRIANGULATEDFACESET");
      vs_putf(w, "#%u,$,%s,(", points, closed ? ".T." : ".F.");
    } else vs_puts(w, i % 8 ? "," : ",\n");
    vs_putf(w, "(%u,%u,%u)", t[0] + 1, t[d->mirrored ? 2 : 1] + 1, t[d->mirrored ? 1 : 2] + 1);
    if (!vs_emit_going(e, i)) return false;
  }
  if (line == 0) return !w->failed;
  vs_puts(w, "),$");
  vs_ifc_end(w);
  if (paint > 0) put_style(e, line, vs_emit_material_at(e, paint));
  else if (!all) put_style(e, line, e->material);
  state_of(e)->styled |= paint > 0 || !all;
  return vs_ifc_add(e, &state_of(e)->items, line);
}

/* Writes a mesh as items, one for each material, with its points mapped by `place`. */
static bool put_mesh(vs_emitter *e, const vs_ref *ref, const vs_affine *place) {
  vs_writer *w = e->out;
  const vs_solid *m = vs_emit_mesh(e, ref);
  if (m == NULL || !vs_emit_triangles(e, m->mesh.triangle_count)) return false;
  if (m->mesh.triangle_count == 0) return true;
  unsigned points = next_line(e);
  state_of(e)->mirrored = vs_affine_determinant(place) < 0;
  vs_ifc_begin(w, points, "IFCCARTESIANPOINTLIST3D");
  for (size_t i = 0; i < m->mesh.vertex_count && !w->failed; i++) {
    vs_vec3 p = vs_affine_point(place, m->mesh.vertices[i]);
    vs_puts(w, i == 0 ? "(" : i % 8 ? "," : ",\n");
    vs_ifc_triple(w, p);
    vs_bounds_add(&state_of(e)->bounds, p);
  }
  vs_puts(w, ")");
  vs_ifc_end(w);
  bool one = true;
  for (size_t i = 1; i < m->part_count; i++) one &= m->parts[i].material == m->parts[0].material;
  size_t own = m->part_count > 0 ? vs_emit_material_number(e, m->parts[0].material) : 0;
  if (one) return put_faces(e, m, own, points, true, ref->node->class_ == VS_SOLID);
  for (size_t paint = 0; paint <= vs_emit_material_count(e); paint++)
    if (!put_faces(e, m, paint, points, false, false)) return false;
  return true;
}

/* ---- elements ---- */

static unsigned put_representation(vs_emitter *e, const char *type, const vs_ifc_list *items) {
  unsigned line = next_line(e);
  vs_ifc_begin(e->out, line, "IFCSHAPEREPRESENTATION");
  vs_putf(e->out, "#%u,'Body','%s',", state_of(e)->body, type);
  vs_ifc_references(e->out, items);
  vs_ifc_end(e->out);
  return line;
}

/* Returns the highest storey whose height is not above z or, if there is none, the lowest storey. */
static ifc_storey *storey_at(ifc *d, double z) {
  size_t i = 0;
  while (i + 1 < d->storey_count && d->storeys[i + 1].height <= z) i++;
  return &d->storeys[i];
}

static unsigned put_place(vs_emitter *e, unsigned within, const vs_affine *place) {
  unsigned frame =
      put_frame(e, vs_affine_column(place, 3), vs_affine_column(place, 2), vs_affine_column(place, 0));
  return put_placement(e, within, frame);
}

/* Writes the line of an element. Returns its number. */
static unsigned put_product(vs_emitter *e, vs_ifc_class class_, const char *name, unsigned placement, unsigned shape) {
  vs_writer *w = e->out;
  unsigned product = next_line(e);
  vs_ifc_begin(w, product, "IFCPRODUCTDEFINITIONSHAPE");
  vs_putf(w, "$,$,(#%u)", shape);
  vs_ifc_end(w);
  unsigned element = begin_thing(e, class_.name);
  vs_ifc_text(w, name);
  vs_putf(w, ",$,$,#%u,#%u,'%u',%s", placement, product, state_of(e)->things, class_.attributes);
  vs_ifc_end(w);
  return element;
}

static void put_relation(vs_emitter *e, const char *name, unsigned whole, unsigned part) {
  begin_thing(e, name);
  vs_putf(e->out, "$,$,#%u,#%u", whole, part);
  vs_ifc_end(e->out);
}

/* Writes an opening of the last element, of which it is a void. It belongs to no storey. */
static bool put_opening(vs_emitter *e, vs_ifc_class class_, unsigned shape, const vs_affine *place) {
  ifc *d = state_of(e);
  vs_affine back, within;
  if (!vs_affine_invert(&d->host.place, &back)) return true;
  within = vs_affine_multiply(&back, place);
  d->opening = put_product(e, class_, "opening", put_place(e, d->host.placement, &within), shape);
  put_relation(e, "IFCRELVOIDSELEMENT", d->host.line, d->opening);
  return true;
}

/* Writes an element. shape: line number of its representation; place: its placement, which must not change sizes;
 * bounds: those of the placed shape. An opening belongs to the element before it, and a window or door to the opening
 * before it. */
static bool put_element(vs_emitter *e, const vs_ref *ref, unsigned shape, const vs_affine *place, vs_bounds bounds) {
  ifc *d = state_of(e);
  vs_ifc_class class_ = vs_ifc_class_of(e->layer);
  if (vs_ifc_is_opening(class_) && d->host.line) return put_opening(e, class_, shape, place);
  ifc_storey *s = storey_at(d, bounds.min.z + 0.1 * (bounds.max.z - bounds.min.z));
  vs_affine within = *place;
  within.m[2][3] -= s->height;
  unsigned placement = put_place(e, s->placement, &within);
  const char *name =
      e->part != NULL ? e->part : e->layer != NULL ? e->layer : vs_kind_get((vs_kind)ref->node->kind)->name;
  unsigned element = put_product(e, class_, name, placement, shape);
  if (d->opening && vs_ifc_fills(class_)) put_relation(e, "IFCRELFILLSELEMENT", d->opening, element);
  else d->host = (ifc_host){ element, placement, *place };
  d->opening = 0;
  size_t paint = vs_emit_material_number(e, e->material);
  return vs_ifc_add(e, &s->elements, element) && (paint == 0 || vs_ifc_add(e, &d->painted[paint], element));
}

/* Returns true if the map changes no lengths and does not mirror. */
static bool is_rigid(const vs_affine *a) {
  double k;
  return vs_affine_even(a, &k) && fabs(k - 1) < 1e-12 && vs_affine_determinant(a) > 0;
}

/* Writes a shape that several elements have. Sets *index to 1 + the index of its ifc_map. */
static bool put_map(vs_emitter *e, const vs_ref *ref, const char *type, uint64_t *index) {
  ifc *d = state_of(e);
  unsigned shape = put_representation(e, type, &d->items), map = next_line(e);
  vs_ifc_begin(e->out, map, "IFCREPRESENTATIONMAP");
  vs_putf(e->out, "#%u,#%u", d->axes, shape);
  vs_ifc_end(e->out);
  if (!vs_emit_grow(e, &d->maps, &d->map_room, d->map_count + 1, sizeof *d->maps)) return false;
  d->maps[d->map_count++] = (ifc_map){ map, d->bounds, d->styled };
  uint64_t *at = vs_nodemap_put_held(&d->shared, ref->node, NULL);
  if (at == NULL) return vs_emit_no_memory(e);
  *index = *at = d->map_count;
  return true;
}

static bool put_mapped(vs_emitter *e, const vs_ref *ref, const ifc_map *map) {
  ifc *d = state_of(e);
  unsigned item = next_line(e), shown = map->map;
  vs_bounds placed = vs_bounds_transform(&map->bounds, &e->placement);
  vs_ifc_begin(e->out, item, "IFCMAPPEDITEM");
  vs_putf(e->out, "#%u,#%u", shown, d->unmoved);
  vs_ifc_end(e->out);
  if (!map->styled) put_style(e, item, e->material);
  vs_ifc_list one = { &item, 1, 1 };
  return put_element(e, ref, put_representation(e, "MappedRepresentation", &one), &e->placement, placed);
}

static bool put_object(vs_emitter *e, const vs_ref *ref) {
  ifc *d = state_of(e);
  bool rigid = is_rigid(&e->placement), shared = rigid && ref->node->refs > 1;
  vs_affine here = vs_affine_identity();
  const uint64_t *known = shared ? vs_nodemap_get(&d->shared, ref->node) : NULL;
  uint64_t index = known != NULL ? *known : 0;
  if (index > 0) return put_mapped(e, ref, &d->maps[index - 1]);
  d->items.count = 0, d->bounds = vs_bounds_empty(), d->styled = false;
  bool swept = rigid && put_solid(e, ref->node);
  if (!swept && (e->out->failed || !put_mesh(e, ref, rigid ? &here : &e->placement))) return false;
  if (d->items.count == 0) return !e->out->failed;
  const char *type = swept ? "SweptSolid" : "Tessellation";
  if (shared && d->items.count == 1)
    return put_map(e, ref, type, &index) && put_mapped(e, ref, &d->maps[index - 1]);
  if (!d->styled) put_style(e, d->items.at[0], e->material);
  vs_bounds placed = rigid ? vs_bounds_transform(&d->bounds, &e->placement) : d->bounds;
  return put_element(e, ref, put_representation(e, type, &d->items), rigid ? &e->placement : &here, placed);
}

static vs_emit_status ifc_leaf(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  return put_object(e, ref) && !e->out->failed ? VS_EMITTED : VS_FAILED;
}

static vs_emit_status ifc_boolean(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_ENTER) return VS_EMITTED;
  return ifc_leaf(e, ref, phase) == VS_EMITTED ? VS_WHOLE : VS_FAILED;
}

/* Does nothing for placements, paint and layers, because the emitter contains them while shapes are written. */
static vs_emit_status ifc_through(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)e, (void)ref, (void)phase;
  return VS_EMITTED;
}

/* ---- the project ---- */

/* Writes the units: lengths in model units, areas and volumes in square and cubic metres, angles in radians. Returns
 * the line number. */
static unsigned put_units(vs_emitter *e) {
  static const struct { const char *unit, *prefix, *name;
  } units[] = { { "m", "$", NULL },
                { "mm", ".MILLI.", NULL },
                { "cm", ".CENTI.", NULL },
                { "in", "$", "INCH" },
                { "ft", "$", "FOOT" } };
  vs_writer *w = e->out;
  size_t k = 0;
  while (k + 1 < sizeof units / sizeof *units && strcmp(units[k].unit, e->scene->units) != 0) k++;
  unsigned first = next_line(e), length = first;
  vs_putf(w, "#%u=IFCSIUNIT(*,.LENGTHUNIT.,%s,.METRE.);\n", first, units[k].prefix);
  if (units[k].name != NULL) {
    unsigned powers = next_line(e), measure = next_line(e);
    length = next_line(e);
    vs_putf(w, "#%u=IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0);\n#%u=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(", powers,
            measure);
    vs_ifc_real(w, vs_scene_metres(e->scene));
    vs_putf(w, "),#%u);\n#%u=IFCCONVERSIONBASEDUNIT(#%u,.LENGTHUNIT.,'%s',#%u);\n", first, length, powers,
            units[k].name, measure);
  }
  unsigned area = next_line(e), volume = next_line(e), angle = next_line(e), all = next_line(e);
  vs_putf(w, "#%u=IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.);\n#%u=IFCSIUNIT(*,.VOLUMEUNIT.,$,.CUBIC_METRE.);\n", area,
          volume);
  vs_putf(w, "#%u=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);\n#%u=IFCUNITASSIGNMENT((#%u,#%u,#%u,#%u));\n", angle, all,
          length, area, volume, angle);
  return all;
}

/* Writes that the project, site or building `whole` consists of the parts in a list. */
static void put_aggregate(vs_emitter *e, unsigned whole, const vs_ifc_list *parts) {
  begin_thing(e, "IFCRELAGGREGATES");
  vs_putf(e->out, "$,$,#%u,", whole);
  vs_ifc_references(e->out, parts);
  vs_ifc_end(e->out);
}

static int compare_heights(const void *a, const void *b) {
  const vs_scene_note *const *p = a, *const *q = b;
  return (*p)->p.z < (*q)->p.z ? -1 : (*p)->p.z > (*q)->p.z;
}

static bool put_storey(vs_emitter *e, const char *name, double height, vs_ifc_list *made) {
  ifc *d = state_of(e);
  if (!vs_emit_grow(e, &d->storeys, &d->storey_room, d->storey_count + 1, sizeof *d->storeys)) return false;
  unsigned frame = put_frame(e, vs_v3(0, 0, height), vs_v3(0, 0, 1), vs_v3(1, 0, 0));
  unsigned placement = put_placement(e, d->here, frame), line = begin_thing(e, "IFCBUILDINGSTOREY");
  vs_ifc_text(e->out, name);
  vs_putf(e->out, ",$,$,#%u,$,$,.ELEMENT.,", placement);
  vs_ifc_real(e->out, height);
  vs_ifc_end(e->out);
  d->storeys[d->storey_count++] = (ifc_storey){ .line = line, .placement = placement, .height = height };
  return vs_ifc_add(e, made, line);
}

/* Writes a storey for the height of each level note or, if there is none, a storey at 0. Adds their line numbers to
 * `made`. */
static bool put_storeys(vs_emitter *e, vs_ifc_list *made) {
  const vs_scene *s = e->scene;
  size_t count = 0, room = (s->note_count + 1) * sizeof(const vs_scene_note *);
  const vs_scene_note **levels = vs_store_realloc(s->store, NULL, 0, room);
  if (levels == NULL) return vs_emit_no_memory(e);
  for (size_t i = 0; i < s->note_count; i++)
    if (s->notes[i].kind == VS_NOTE_LEVEL) levels[count++] = &s->notes[i];
  qsort(levels, count, sizeof *levels, compare_heights);
  bool ok = count > 0 || put_storey(e, "Level 0", 0, made);
  for (size_t i = 0; ok && i < count; i++) {
    char name[64];
    if (i > 0 && levels[i]->p.z == levels[i - 1]->p.z) continue;
    snprintf(name, sizeof name, "Level %g", levels[i]->p.z);
    ok = put_storey(e, levels[i]->text != NULL ? levels[i]->text : name, levels[i]->p.z, made);
  }
  vs_store_realloc(s->store, levels, room, 0);
  return ok;
}

static void put_header(vs_emitter *e) {
  vs_writer *w = e->out;
  vs_puts(w, "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [ReferenceView_V1.2]'),'2;1');\nFILE_NAME(");
  vs_ifc_text(w, e->scene->title);
  vs_puts(w, ",'1970-01-01T00:00:00',(''),(''),'VisualScheme','VisualScheme','');\nFILE_SCHEMA(('IFC4'));\nENDSEC;\n"
             "DATA;\n");
}

/* Writes the project with its context, the site, the building and the storeys. */
static bool put_project(vs_emitter *e) {
  ifc *d = state_of(e);
  vs_writer *w = e->out;
  unsigned units = put_units(e);
  d->origin = put_point(e, vs_v3(0, 0, 0));
  d->axes = next_line(e);
  vs_putf(w, "#%u=IFCAXIS2PLACEMENT3D(#%u,$,$);\n", d->axes, d->origin);
  unsigned context = next_line(e);
  vs_putf(w, "#%u=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#%u,$);\n", context, d->axes);
  d->body = next_line(e);
  vs_putf(w, "#%u=IFCGEOMETRICREPRESENTATIONSUBCONTEXT('Body','Model',*,*,*,*,#%u,$,.MODEL_VIEW.,$);\n", d->body,
          context);
  d->unmoved = next_line(e);
  vs_putf(w, "#%u=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#%u,1.,$);\n", d->unmoved, d->origin);
  d->here = put_placement(e, 0, d->axes);
  unsigned project = begin_thing(e, "IFCPROJECT");
  vs_ifc_text(w, e->scene->title);
  vs_putf(w, ",$,$,$,$,(#%u),#%u);\n", context, units);
  unsigned site = begin_thing(e, "IFCSITE");
  vs_putf(w, "'Site',$,$,#%u,$,$,.ELEMENT.,$,$,$,$,$);\n", d->here);
  unsigned building = begin_thing(e, "IFCBUILDING");
  vs_putf(w, "'Building',$,$,#%u,$,$,.ELEMENT.,$,$,$);\n", d->here);
  vs_ifc_list storeys = { NULL, 0, 0 };
  bool ok = put_storeys(e, &storeys);
  if (ok) {
    put_aggregate(e, project, &(vs_ifc_list){ &site, 1, 1 });
    put_aggregate(e, site, &(vs_ifc_list){ &building, 1, 1 });
    put_aggregate(e, building, &storeys);
  }
  vs_ifc_list_free(e, &storeys);
  return ok && !w->failed;
}

static bool ifc_begin(vs_emitter *e) {
  vs_store *store = e->scene->store;
  size_t materials = vs_emit_material_count(e) + 1;
  ifc *d = vs_store_realloc(store, NULL, 0, sizeof *d);
  if (d == NULL) return vs_emit_no_memory(e);
  *d = (ifc){ .shared.store = store };
  e->state = d;
  d->styles = vs_store_realloc(store, NULL, 0, materials * sizeof *d->styles);
  d->painted = vs_store_realloc(store, NULL, 0, materials * sizeof *d->painted);
  if (d->styles == NULL || d->painted == NULL) return vs_emit_no_memory(e);
  memset(d->styles, 0, materials * sizeof *d->styles);
  for (size_t i = 0; i < materials; i++) d->painted[i] = (vs_ifc_list){ NULL, 0, 0 };
  if (e->scene->has_ground && !vs_emit_warn_once(e, NULL, "IFC: the ground is omitted")) return false;
  put_header(e);
  return put_project(e);
}

/* Writes which elements belong to each storey, and which have each material. */
static bool ifc_end(vs_emitter *e) {
  ifc *d = state_of(e);
  vs_writer *w = e->out;
  for (size_t i = 0; i < d->storey_count; i++) {
    if (d->storeys[i].elements.count == 0) continue;
    begin_thing(e, "IFCRELCONTAINEDINSPATIALSTRUCTURE");
    vs_puts(w, "$,$,");
    vs_ifc_references(w, &d->storeys[i].elements);
    vs_putf(w, ",#%u", d->storeys[i].line);
    vs_ifc_end(w);
  }
  for (size_t i = 1; i <= vs_emit_material_count(e); i++) {
    const vs_material *m = vs_emit_material_at(e, i);
    if (d->painted[i].count == 0 || m->name[0] == '\0') continue;
    unsigned line = next_line(e);
    vs_ifc_begin(w, line, "IFCMATERIAL");
    vs_ifc_text(w, m->name);
    vs_puts(w, ",$,$");
    vs_ifc_end(w);
    begin_thing(e, "IFCRELASSOCIATESMATERIAL");
    vs_puts(w, "$,$,");
    vs_ifc_references(w, &d->painted[i]);
    vs_putf(w, ",#%u", line);
    vs_ifc_end(w);
  }
  vs_puts(w, "ENDSEC;\nEND-ISO-10303-21;\n");
  return !w->failed;
}

static void ifc_close(vs_emitter *e) {
  ifc *d = e->state;
  size_t materials = vs_emit_material_count(e) + 1;
  if (d == NULL) return;
  for (size_t i = 0; i < d->storey_count; i++) vs_ifc_list_free(e, &d->storeys[i].elements);
  for (size_t i = 0; d->painted != NULL && d->styles != NULL && i < materials; i++) vs_ifc_list_free(e, &d->painted[i]);
  vs_emit_release(e, d->storeys, d->storey_room, sizeof *d->storeys);
  vs_emit_release(e, d->maps, d->map_room, sizeof *d->maps);
  vs_emit_release(e, d->styles, d->styles != NULL ? materials : 0, sizeof *d->styles);
  vs_emit_release(e, d->painted, d->painted != NULL ? materials : 0, sizeof *d->painted);
  vs_ifc_list_free(e, &d->items);
  vs_nodemap_free_held(&d->shared);
  vs_emit_release(e, d, 1, sizeof *d);
  e->state = NULL;
}

const vs_backend vs_backend_ifc = { .begin = ifc_begin, .end = ifc_end, .close = ifc_close, .traits = VS_NAMES,
                                    .omit = { [VS_CURVE] = "IFC holds bodies: curves are omitted" },
                                    VS_EMIT_SHAPES(ifc_leaf, NULL, ifc_through, ifc_boolean) };
