/* Writes the lines for the style 'technical (a picture with black outlines).
 *
 * The lines are the visible outlines and creases of the drawing in this view. Each visible piece is a cone between two
 * spheres, moved towards the eye by three times its radius. The lines' width in the picture decreases with the
 * distance: from a thick line at the nearest point of the drawing to a thin line at the farthest point. */
#include "backends/povray/povray_edges.h"

#include <math.h>

#include "backends/view.h"
#include "geometry/measure/bounds.h"
#include "solids/sight_edges.h"
#include "solids/solid_meshes.h"

/* The data for computing the lines. */
typedef struct {
  vs_emitter *e;
  vs_look look;
  double near, far;  /* nearest and farthest distance of the drawing's bounding box from the eye, along the line of
                      * sight */
  vs_vec3 *points;   /* the corners of the mesh in coordinates of the view */
  uint32_t (*triangles)[3]; /* the triangles that are in front of the eye */
  size_t triangle_count;
} edges;

static void find_depths(edges *d) {
  const vs_bounds *b = &d->e->bounds;
  d->near = INFINITY, d->far = -INFINITY;
  for (int i = 0; i < 8; i++) {
    vs_vec3 corner = vs_v3(i & 1 ? b->max.x : b->min.x, i & 2 ? b->max.y : b->min.y, i & 4 ? b->max.z : b->min.z);
    double depth = vs_look_to_view(&d->look, corner).z;
    d->near = fmin(d->near, depth), d->far = fmax(d->far, depth);
  }
}

/* Returns the radius of a line at this depth (distance along the line of sight), in model units. */
static double radius_at(const edges *d, double depth) {
  double share = d->far > d->near ? (depth - d->near) / (d->far - d->near) : 0;
  return fmax(d->e->pen.share * depth, d->e->pen.least) * (0.8 - 0.35 * fmax(0, fmin(1, share)));
}

static void put_joint(const edges *d, vs_vec3 v, double radius) {
  const double ahead = 3 * radius; /* ahead: distance by which a line is moved towards the eye. A round surface bulges
                                    * past the facets from which its lines are computed, and must not hide them */
  vs_vec3 moved = d->look.parallel ? vs_v3(v.x, v.y, v.z - ahead) : vs_v3_scale(v, (v.z - ahead) / v.z);
  vs_put_triple(d->e->out, "<", vs_v3_scale(vs_look_from_view(&d->look, moved), d->e->unit), ", ", ">, ");
  vs_put_number(d->e->out, radius * d->e->unit);
}

static void put_piece(const edges *d, vs_vec3 p, vs_vec3 q) {
  vs_writer *w = d->e->out;
  double at_p = radius_at(d, p.z), at_q = radius_at(d, q.z);
  vs_puts(w, "  sphere { ");
  put_joint(d, p, at_p);
  vs_puts(w, " } sphere { ");
  put_joint(d, q, at_q);
  vs_puts(w, " }\n");
  if (!(vs_v3_length(vs_v3_sub(q, p)) > 1e-3 * at_p)) return;
  vs_puts(w, "  cone { ");
  put_joint(d, p, at_p);
  vs_puts(w, ", ");
  put_joint(d, q, at_q);
  vs_puts(w, " }\n");
}

static void put_pieces(const edges *d, const vs_sight_edges *found, const vs_sight_pieces *pieces) {
  if (pieces->count == 0) return;
  vs_puts(d->e->out, "union {\n");
  for (size_t i = 0; i < pieces->count; i++) {
    const vs_sight_piece *piece = &pieces->at[i];
    const vs_sight_edge *edge = &found->at[piece->edge];
    vs_vec3 along = vs_v3_sub(edge->q, edge->p);
    vs_vec3 from = vs_v3_add(edge->p, vs_v3_scale(along, piece->from));
    put_piece(d, from, vs_v3_add(edge->p, vs_v3_scale(along, piece->to)));
  }
  vs_puts(d->e->out, "  no_shadow no_radiosity no_reflection\n  texture { pigment { color rgb 0 } finish { ambient 0 "
                     "diffuse 0 } }\n}\n");
}

/* Converts the mesh to coordinates of the view. These are left-handed, so the triangles' corners are reversed. Omits
 * triangles of which a corner is behind the eye. */
static bool convert(edges *d, const vs_mesh *m) {
  vs_store *store = d->e->scene->store;
  const double least = 1e-4 * vs_bounds_diagonal(&d->e->bounds);
  d->points = vs_store_realloc(store, NULL, 0, m->vertex_count * sizeof *d->points);
  d->triangles = vs_store_realloc(store, NULL, 0, m->triangle_count * sizeof *d->triangles);
  if (!d->points || !d->triangles) return vs_emit_no_memory(d->e);
  for (size_t i = 0; i < m->vertex_count; i++) d->points[i] = vs_look_to_view(&d->look, m->vertices[i]);
  for (size_t i = 0; i < m->triangle_count; i++) {
    const uint32_t *t = m->triangles[i];
    bool ahead = d->look.parallel;
    if (!ahead) ahead = d->points[t[0]].z > least && d->points[t[1]].z > least && d->points[t[2]].z > least;
    for (int k = 0; ahead && k < 3; k++) d->triangles[d->triangle_count][k] = t[2 - k];
    d->triangle_count += ahead;
  }
  return true;
}

bool vs_povray_edges(vs_emitter *e, int width, int height) {
  vs_store *store = e->scene->store;
  vs_kernel_options options = { .job = e->job };
  vs_sight_host host = { store, e->job };
  vs_solid solid = { 0 };
  vs_sight_edges found = { 0 };
  vs_sight_pieces pieces = { 0 };
  edges d = { .e = e };
  d.look = vs_look_find(e->scene, &e->framed, e->boxes, e->box_count, (double)width / height);
  if (d.look.panorama) return true;
  find_depths(&d);
  vs_job_stage(e->job, "edges");
  bool ok = vs_solid_evaluate(e->scene->drawn, e->scene->drawn_count, &e->drawing_facets, &options, &solid, e->error);
  const vs_mesh *m = &solid.mesh;
  if (ok && m->triangle_count > 0 && convert(&d, m)) {
    vs_sight sight = { .points = d.points, .triangles = (const uint32_t (*)[3])d.triangles,
                       .point_count = m->vertex_count, .triangle_count = d.triangle_count, .closed = d.triangle_count,
                       .perspective = !d.look.parallel, .slack = 2e-7 * vs_bounds_diagonal(&e->bounds) };
    ok = vs_sight_find_edges(&host, &sight, &found, e->error) &&
         vs_sight_find_visible(&host, &sight, &found, false, &pieces, e->error);
    if (ok) put_pieces(&d, &found, &pieces);
  }
  ok = ok && e->error->kind == VS_ERROR_NONE;
  vs_sight_pieces_free(&host, &pieces);
  vs_sight_edges_free(&host, &found);
  if (d.points) vs_store_realloc(store, d.points, m->vertex_count * sizeof *d.points, 0);
  if (d.triangles) vs_store_realloc(store, d.triangles, m->triangle_count * sizeof *d.triangles, 0);
  vs_solid_free(&solid);
  return ok;
}
