/* Writes triangles as POV-Ray's text: meshes, and boolean operations that are replaced by triangles in pictures.
 *
 * POV-Ray intersects a ray with each operand of a difference or an intersection. For each point where the ray enters or
 * leaves an operand, it tests whether the point lies in all other operands. A wall with many openings, or a hall under
 * vaults, therefore takes most of a picture's time. A mesh is faster, because POV-Ray builds a tree of boxes for it.
 *
 * For pictures, the kernel therefore combines such a solid to a mesh. For a .pov, which people read and change, it does
 * not. The mesh is as fine as the picture shows, with smooth shading if its parts are round. vs_povray_solid chooses
 * the solids. It does not choose glass, which refracts light; patterns that were moved with their parts; text of the
 * user; and solids of few parts, most of which a ray misses.
 *
 * POV-Ray uses a mesh in booleans only if the mesh has an inside_vector. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "backends/lower.h"
#include "backends/povray/povray_meshes.h"
#include "backends/povray/povray_text.h"
#include "backends/shade.h"
#include "geometry/measure/bounds.h"

static bool pov_needle(const vs_vec3 *v, const uint32_t t[3]) {
  vs_vec3 a = vs_v3_sub(v[t[1]], v[t[0]]), b = vs_v3_sub(v[t[2]], v[t[0]]);
  double longest = fmax(vs_v3_length(a), vs_v3_length(b));
  return !(vs_v3_length(vs_v3_cross(a, b)) > 1e-12 * longest * longest);
}

/* Writes three indices for each triangle of `of` except needles (triangles without area), ten triangles on a line.
 * `kept`: number of triangles that are not needles. Needles are invisible, and POV-Ray warns about them. */
static void pov_triples(vs_emitter *e, const char *word, const vs_shade_faces *of, const uint32_t (*triples)[3],
                        size_t kept) {
  pov_open(e, word);
  vs_put_u32(e->out, (uint32_t)kept);
  for (size_t i = 0, shown = 0; i < of->triangle_count; i++) {
    if (pov_needle(of->vertices, of->triangles[i])) continue;
    vs_puts(e->out, shown++ % 10 == 0 ? ",\n" : ", ");
    if (shown % 10 == 1) pov_indent(e);
    for (int k = 0; k < 3; k++) {
      vs_puts(e->out, k == 0 ? "<" : ",");
      vs_put_u32(e->out, triples[i][k]);
    }
    vs_puts(e->out, ">");
  }
  vs_puts(e->out, "\n");
  pov_indent(e);
  vs_puts(e->out, "}\n");
}

static void pov_points(vs_emitter *e, const char *word, const vs_vec3 *at, size_t count, vs_vec3 from, double unit) {
  pov_open(e, word);
  vs_put_u32(e->out, (uint32_t)count);
  for (size_t i = 0; i < count; i++) {
    vs_puts(e->out, i % 4 == 0 ? ",\n" : ", ");
    if (i % 4 == 0) pov_indent(e);
    vs_put_triple(e->out, "<", unit == 1 ? vs_v3_sub(at[i], from) : vs_v3_scale(vs_v3_sub(at[i], from), unit), ",",
                  ">");
  }
  vs_puts(e->out, "\n");
  pov_indent(e);
  vs_puts(e->out, "}\n");
}

/* POV-Ray stores the corners of meshes in single precision. If a mesh is far from the origin compared with its size,
 * returns its first corner: all corners are then written relative to it. Otherwise returns 0 0 0. */
static vs_vec3 pov_far(const vs_vec3 *v, size_t count) {
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < count; i++) vs_bounds_add(&b, v[i]);
  vs_vec3 middle = vs_v3_scale(vs_v3_add(b.min, b.max), 0.5);
  return count > 0 && vs_v3_length(middle) > 100 * vs_bounds_diagonal(&b) ? v[0] : vs_v3(0, 0, 0);
}

/* Triangles to write, with their material and shading. */
typedef struct {
  vs_shade_faces faces;     /* the faces; if groups is NULL, all faces are flat, unless the emitter shades smoothly */
  bool closed;
  const vs_material *paint; /* material of the triangles; NULL: the material of the surrounding object */
} pov_triangles;

static vs_emit_status pov_mesh(vs_emitter *e, const pov_triangles *m) {
  const vs_shade_faces *f = &m->faces;
  size_t kept = 0;
  for (size_t i = 0; i < f->triangle_count; i++) kept += !pov_needle(f->vertices, f->triangles[i]);
  if (kept == 0) return VS_EMITTED; /* no triangle is visible, so no mesh is written */
  if (!vs_emit_triangles(e, kept)) return VS_FAILED;
  vs_shading s = { .normal_count = 0 };
  bool smooth = f->groups != NULL || e->smooth;
  if (smooth && !vs_shading_make(e, f, &s)) return VS_FAILED;
  pov_open(e, "mesh2 {\n");
  e->depth++;
  vs_vec3 from = pov_far(f->vertices, f->vertex_count);
  pov_points(e, "vertex_vectors { ", f->vertices, f->vertex_count, from, e->unit);
  if (smooth) pov_points(e, "normal_vectors { ", s.normals, s.normal_count, vs_v3(0, 0, 0), 1);
  pov_triples(e, "face_indices { ", f, f->triangles, kept);
  if (smooth) pov_triples(e, "normal_indices { ", f, (const uint32_t (*)[3])s.corners, kept);
  if (m->closed) /* the inside_vector is a slanted direction, because a line in this direction very rarely runs along an
                  * edge */
    pov_open(e, "inside_vector <0.2317, 0.4951, 0.8372>\n");
  if (!vs_v3_equal(from, vs_v3(0, 0, 0))) {
    pov_open(e, "translate ");
    pov_point(e, pov_at(e, from));
    vs_puts(e->out, "\n");
  }
  if (m->paint) {
    pov_indent(e);
    vs_povray_paint(e, m->paint);
    vs_puts(e->out, "\n");
  }
  e->depth--;
  vs_shading_free(&s);
  pov_open(e, "}\n");
  return pov_close(e, "");
}

vs_emit_status vs_povray_polyface(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_polyface_mesh *p = VS_AS(polyface_mesh, ref->node);
  pov_triangles all = { .closed = p->closed };
  bool triangles = p->faces->corner_count == 3 * p->faces->count;
  const uint32_t *starts = vs_faces_starts(p->faces);
  for (uint32_t i = 0; i < p->faces->count && triangles; i++) triangles = starts[i] == 3 * i;
  if (triangles) {
    all.faces = (vs_shade_faces){ .vertices = p->points->at,
                                  .triangles = (const uint32_t (*)[3])(const void *)vs_faces_corners(p->faces),
                                  .vertex_count = p->points->count,
                                  .triangle_count = p->faces->count,
                                  .crease = vs_shade_crease(true) };
    return pov_mesh(e, &all);
  }
  const vs_solid *m = vs_emit_mesh(e, ref);
  if (m == NULL) return VS_FAILED;
  all.faces = vs_shade_mesh(&m->mesh, vs_shade_crease(true));
  return pov_mesh(e, &all);
}

/* ---- solids as triangles ---- */

/* A node that must still be counted as a part of a solid. moved: whether a placement is around it. The number of parts
 * determines whether the solid becomes a mesh. */
typedef struct { const vs_node *node; bool moved; } pov_step;
typedef struct {
  pov_step *wait;
  size_t count, room;
  size_t parts; /* number of parts of the solid; a part that is reached by several paths counts once for each */
} pov_census;

/* If a solid has fewer parts than PARTS_LEAST, a mesh saves no time. If it has more than PARTS_MOST, the kernel takes
 * longer than the picture. */
enum { PARTS_LEAST = 6, PARTS_MOST = 20000 };

static bool pov_paint_stays(const vs_material *m, bool moved) {
  return m->transparency == 0 && (!moved || m->pattern.kind == VS_PATTERN_NONE);
}

/* Counts a node of a solid, and queues its operands. Returns false if the node cannot be part of a mesh, or if memory
 * is out, with e's error set. */
static bool pov_census_node(vs_emitter *e, pov_census *c, pov_step s) {
  const vs_node *n = s.node;
  if (n->class_ != VS_SOLID || n->kind == VS_NATIVE) return false;
  if (n->kind == VS_MATERIAL && !pov_paint_stays(VS_AS(material, n)->material, s.moved)) return false;
  bool through = n->kind == VS_MATERIAL || n->kind == VS_LAYER || n->kind == VS_TRANSFORM || vs_node_is_set(n);
  if (!through) return ++c->parts <= PARTS_MOST;
  if (n->child_count > PARTS_MOST) return false;
  if (!vs_emit_grow(e, &c->wait, &c->room, c->count + n->child_count, sizeof *c->wait)) return false;
  for (uint32_t i = 0; i < n->child_count; i++)
    c->wait[c->count++] = (pov_step){ n->children[i].node, s.moved || n->kind == VS_TRANSFORM };
  return true;
}

/* Returns true if POV-Ray would need long for the solid n, so that a mesh is faster, and if the mesh gives the same
 * picture. */
static bool pov_is_dear(vs_emitter *e, const vs_node *n) {
  pov_census c = { .count = 0 };
  if (n->class_ != VS_SOLID || n->flags & VS_NODE_ENDLESS || e->carved) return false;
  if (e->material && !pov_paint_stays(e->material, false)) return false;
  bool fits = pov_census_node(e, &c, (pov_step){ n, false });
  while (fits && c.count > 0) fits = pov_census_node(e, &c, c.wait[--c.count]);
  vs_emit_release(e, c.wait, c.room, sizeof *c.wait);
  return fits && c.parts >= PARTS_LEAST;
}

/* Lets the kernel combine the solid. Ignores the kernel's warnings, which concern files of triangles. On an error
 * except an interrupt, sets *fits to false: POV-Ray must then combine the solid itself. */
static bool pov_combine(vs_emitter *e, const vs_ref *ref, vs_solid *out, bool *fits) {
  vs_error why = { VS_ERROR_NONE, NULL, "" }, *was = e->error;
  e->error = &why;
  *fits = vs_lower_solids(e, ref, 1, VS_BENT_AGAIN, out);
  e->error = was;
  size_t limit = e->job->limits.mesh_triangles, count = out->mesh.triangle_count;
  if (*fits) *fits = count > 0 && (!limit || e->triangles + 2 * count <= limit);
  if (why.kind != VS_ERROR_INTERRUPT) return true;
  *e->error = why;
  return false;
}

/* The triangles of a solid that have one paint. */
typedef struct {
  vs_vec3 *v;
  uint32_t (*t)[3];
  uint32_t *groups, *places; /* places[i]: 1 + new number of corner i of the solid's mesh, or 0 */
  size_t vertices, triangles, vertex_room, triangle_room;
} pov_piece;

static const vs_solid_part *pov_part(const vs_solid *s, size_t triangle) {
  return &s->parts[s->mesh.tags ? s->mesh.tags[triangle] : 0];
}

/* Adds a lining to a piece: a copy of its triangles slightly deeper in the solid. Single-precision planes leave tiny
 * gaps between POV-Ray's triangles, and the lining closes the view through these gaps. */
static void pov_line(pov_piece *p) {
  const double deep = 4e-6; /* depth of the lining as a fraction of the largest coordinate: some tens of steps of single
                             * precision */
  double most = 0;
  size_t vertices = p->vertices, triangles = p->triangles;
  vs_vec3 *into = p->v + vertices;
  for (size_t i = 0; i < vertices; i++) {
    most = fmax(most, fmax(fabs(p->v[i].x), fmax(fabs(p->v[i].y), fabs(p->v[i].z))));
    into[i] = vs_v3(0, 0, 0);
  }
  for (size_t i = 0; i < triangles; i++) {
    const uint32_t *t = p->t[i];
    vs_vec3 out = vs_v3_cross(vs_v3_sub(p->v[t[1]], p->v[t[0]]), vs_v3_sub(p->v[t[2]], p->v[t[0]]));
    double length = vs_v3_length(out);
    for (int k = 0; k < 3; k++) {
      p->t[triangles + i][k] = t[k] + (uint32_t)vertices;
      if (length > 0) into[t[k]] = vs_v3_sub(into[t[k]], vs_v3_scale(out, 1 / length));
    }
    p->groups[triangles + i] = p->groups[i];
  }
  for (size_t i = 0; i < vertices; i++) {
    double length = vs_v3_length(into[i]);
    into[i] = vs_v3_add(p->v[i], vs_v3_scale(into[i], length > 0 ? deep * most / length : 0));
  }
  p->vertices *= 2, p->triangles *= 2;
}

static vs_emit_status pov_piece_of(vs_emitter *e, pov_piece *p, const vs_solid *s, const vs_material *paint) {
  const vs_mesh *m = &s->mesh;
  p->vertices = p->triangles = 0;
  memset(p->places, 0, m->vertex_count * sizeof *p->places);
  for (size_t i = 0; i < m->triangle_count; i++) {
    const vs_solid_part *part = pov_part(s, i);
    if (part->material != paint) continue;
    for (int k = 0; k < 3; k++) {
      uint32_t corner = m->triangles[i][k];
      if (!p->places[corner]) {
        p->v[p->vertices] = m->vertices[corner];
        p->places[corner] = (uint32_t)++p->vertices;
      }
      p->t[p->triangles][k] = p->places[corner] - 1;
    }
    bool round = vs_lower_is_round(part->leaf.node);
    p->groups[p->triangles++] = round ? (uint32_t)(part - s->parts) : VS_SHADE_FLAT;
  }
  if (p->triangles == 0) return VS_EMITTED;
  pov_line(p);
  const double crease = 0.35; /* least angle in radians of a sharp edge; the angle between neighbouring facets of round
                               * parts is at most a fifth of this */
  const vs_shade_faces faces = { p->v, (const uint32_t (*)[3])p->t, p->groups, p->vertices, p->triangles, crease };
  return pov_mesh(e, &(pov_triangles){ .faces = faces, .paint = paint });
}

static bool pov_paint_met(const vs_solid *s, size_t part) {
  for (size_t i = 0; i < part; i++)
    if (s->parts[i].material == s->parts[part].material) return true;
  return false;
}

/* Returns true if the part is the solid's first part with its paint (material), and a triangle of this paint is
 * visible. All triangles of a paint may be inside other parts. */
static bool pov_paint_shows(const vs_solid *s, size_t part) {
  if (pov_paint_met(s, part)) return false;
  for (size_t i = 0; i < s->mesh.triangle_count; i++)
    if (pov_part(s, i)->material == s->parts[part].material && !pov_needle(s->mesh.vertices, s->mesh.triangles[i]))
      return true;
  return false;
}

/* Returns the number of meshes that represent the solid, one for each visible paint (material). */
static size_t pov_paints(const vs_solid *s) {
  size_t paints = 0;
  for (size_t i = 0; i < s->part_count; i++) paints += pov_paint_shows(s, i);
  return paints;
}

/* Writes the solid as one mesh for each paint (material). Several meshes are written as a union; POV-Ray warns about a
 * union of a single object. */
static vs_emit_status pov_pieces(vs_emitter *e, const vs_solid *s, size_t paints) {
  pov_piece p = { .vertex_room = 2 * s->mesh.vertex_count, .triangle_room = 2 * s->mesh.triangle_count };
  size_t room[4] = { 0 };
  vs_emit_status status = VS_EMITTED;
  if (!vs_emit_grow(e, &p.v, &room[0], p.vertex_room, sizeof *p.v) ||
      !vs_emit_grow(e, &p.t, &room[1], p.triangle_room, sizeof *p.t) ||
      !vs_emit_grow(e, &p.groups, &room[2], p.triangle_room, sizeof *p.groups) ||
      !vs_emit_grow(e, &p.places, &room[3], p.vertex_room, sizeof *p.places))
    status = VS_FAILED;
  if (paints > 1) {
    pov_open(e, "union {\n");
    e->depth++;
  }
  for (size_t i = 0; status == VS_EMITTED && i < s->part_count; i++)
    if (pov_paint_shows(s, i)) status = pov_piece_of(e, &p, s, s->parts[i].material);
  if (paints > 1) {
    e->depth--;
    pov_open(e, "}\n");
  }
  vs_emit_release(e, p.v, room[0], sizeof *p.v);
  vs_emit_release(e, p.t, room[1], sizeof *p.t);
  vs_emit_release(e, p.groups, room[2], sizeof *p.groups);
  vs_emit_release(e, p.places, room[3], sizeof *p.places);
  return status == VS_EMITTED ? pov_close(e, "") : status;
}

vs_emit_status vs_povray_solid(vs_emitter *e, const vs_ref *ref) {
  vs_solid s = { .part_count = 0 };
  bool fits = false;
  if (e->backend->render == NULL || !pov_is_dear(e, ref->node)) return VS_LOWER;
  vs_emit_status status = pov_combine(e, ref, &s, &fits) ? VS_LOWER : VS_FAILED;
  size_t paints = fits ? pov_paints(&s) : 0;
  if (paints > 0) status = pov_pieces(e, &s, paints) == VS_EMITTED ? VS_WHOLE : VS_FAILED;
  vs_solid_free(&s);
  return status;
}
