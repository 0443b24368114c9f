/* Implements the search for a face of the drawing (vs_drawing_face). */
#include <math.h>

#include "bind/call/precision.h"
#include "geometry/measure/face_surface.h"
#include "geometry/measure/node_measures.h"
#include "session/handles.h"
#include "session/host.h"
#include "session/report.h"
#include "session/spine.h"
#include "solids/faced_solid.h"

static const double SLACK = 1e-4; /* distance from a point to the bounds that contain it, as a fraction of their size */

/* The nearest face so far. */
typedef struct { vs_vec3 point; double distance; vs_face_surface surface; bool found; } nearest;

static bool may_contain(const vs_node *n, vs_vec3 p, bool *out, vs_error *e) {
  vs_bounds b;
  *out = false;
  if (n->class_ != VS_SOLID) return true;
  if (!vs_node_bounds(n, &b, e)) return false;
  double slack = SLACK * vs_bounds_diagonal(&b);
  *out = p.x >= b.min.x - slack && p.x <= b.max.x + slack && p.y >= b.min.y - slack && p.y <= b.max.y + slack &&
         p.z >= b.min.z - slack && p.z <= b.max.z + slack;
  return true;
}

/* Compares the nearest face of an object with the nearest so far. */
static bool look_at(vs_session *s, vs_ref ref, nearest *n, vs_error *e) {
  vs_kernel_options options = { .job = s->writing, .cache = vs_store_cache(s->bind.store) };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(s->bind.vm), .segments = vs_bind_segments(s->bind.vm) };
  vs_faced_solid solid;
  bool ok = vs_faced_solid_find(ref, &facets, &options, &solid, e);
  if (ok && solid.solid.mesh.triangle_count) {
    vs_vec3 place;
    uint32_t face = solid.faces.of[vs_mesh_edges_nearest(&solid.edges, n->point, &place)];
    double distance = vs_v3_length(vs_v3_sub(place, n->point));
    if (!n->found || distance < n->distance) {
      bool round = vs_faced_solid_is_round(&solid, face);
      ok = vs_face_surface_find(&solid.edges, &solid.faces, face, round, &n->surface) || vs_error_memory(e, NULL);
      n->distance = distance, n->found = true;
    }
  }
  vs_faced_solid_free(&solid);
  return ok;
}

static void give(const nearest *n, vs_face_info *out) {
  static const char *const names[] = { "plane", "cylinder", "sphere", "cone", "torus", "surface" };
  const vs_face_surface *f = &n->surface;
  if (!n->found) return;
  *out = (vs_face_info){ names[f->form], f->area, { f->at.x, f->at.y, f->at.z }, { f->axis.x, f->axis.y, f->axis.z },
                         f->radius, f->tube, f->angle };
}

vs_outcome vs_drawing_face(vs_scheme *vm, const double point[3], vs_face_info *out) {
  vs_session *s = vs_session_of(vm);
  *out = (vs_face_info){ .form = NULL };
  if (vs_session_busy(s, "vs_drawing_face")) return VS_OUTCOME_USAGE;
  vs_ref *drawn;
  size_t count;
  vs_outcome outcome = vs_session_take(s, &drawn, &count);
  if (outcome != VS_OUTCOME_DONE) return outcome;
  nearest n = { .point = vs_v3(point[0], point[1], point[2]) };
  vs_error e = { 0 };
  vs_job job = vs_session_job(s);
  job.limits.seconds = s->options.limit_time;
  vs_job_start(&job);
  vs_store_set_job(s->bind.store, s->writing = &job);
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) {
    bool near;
    ok = may_contain(drawn[i].node, n.point, &near, &e) && (!near || look_at(s, drawn[i], &n, &e));
  }
  s->writing = NULL;
  vs_store_set_job(s->bind.store, &s->job);
  vs_session_give_back(s, drawn, count);
  if (ok) give(&n, out);
  return ok ? VS_OUTCOME_DONE : vs_session_report_error(s, &e);
}
