/* Separates faces that lie in one plane (flush.h).
 *
 * Two parts are flush if a facet of each lies in the same plane. The pass meshes every part at a coarse fixed tolerance
 * and stores each plane once, as four whole numbers. Equal numbers mean the same plane. This also finds round walls
 * that coincide, because equal round parts have equal facets. Parts whose boxes do not intersect are skipped.
 *
 * Flush parts are enlarged, each part of an operand separately, in its own coordinates, so that all faces move
 * outwards. In a difference only cutters are enlarged, so the faces of the result do not move. These are cutters that
 * are flush with the solid that they cut, and cutters that touch an earlier cutter face to face. In an intersection of
 * two flush operands, one of them is enlarged. Solids with an axis are enlarged as their own kind, others about their
 * centre. In the second case, walls of a notched shape that face the centre move by slightly less.
 *
 * Cost: the facets of each distinct difference, once, and a sort. */
#include "passes/flush.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/measure/node_measures.h"
#include "geometry/parts.h"
#include "geometry/primitives/shape.h"
#include "geometry/tessellate.h"
#include "passes/rewrite.h"
#include "model/store/array.h"

enum { FACET_WORK = 64 }; /* work for a facet of a part, in the units of vs_store_going */
enum { PARTS_MOST = 4000, PAIRS_MOST = 1000000 }; /* PARTS_MOST, PAIRS_MOST: greatest number of parts of one set, and of
                                                   * pairs of parts, that are compared. In a set that exceeds them,
                                                   * every part counts as flush (having a face in a plane with another
                                                   * part's face). */

/* key: plane of a face as four whole numbers; turned: 1 if the face's normal is opposite to the key's normal; operand,
 * part: numbers of the operand and the part that have this face */
typedef struct { int64_t key[4]; uint32_t turned, operand, part; } face_plane;
typedef struct { const vs_node *node; vs_affine placed; } place; /* a node inside a set, and its placement in the set's
                                                                  * coordinates */

typedef struct {
  face_plane *planes;
  size_t count, room;
  vs_bounds *boxes; /* boxes[i]: bounds of part i */
  size_t part_count, part_room;
  place *todo;
  size_t todo_count, todo_room;
  double step;      /* step to which a plane's distance from the origin is rounded, so that equal planes have equal
                     * keys */
  vs_vec3 middle;
  vs_error *error;  /* error of the pass, set if the run is interrupted */
} flush;

static void flush_free(flush *f) {
  free(f->planes);
  free(f->boxes);
  free(f->todo);
}

static int compare_planes(const void *p, const void *q) {
  const face_plane *a = p, *b = q;
  for (int i = 0; i < 4; i++)
    if (a->key[i] != b->key[i]) return a->key[i] < b->key[i] ? -1 : 1;
  if (a->turned != b->turned) return a->turned < b->turned ? -1 : 1;
  if (a->operand != b->operand) return a->operand < b->operand ? -1 : 1;
  return a->part < b->part ? -1 : a->part > b->part;
}

static bool same_plane(const face_plane *a, const face_plane *b) { return memcmp(a->key, b->key, sizeof a->key) == 0; }

/* Adds a plane, given by the point `at` and the normal, to the planes of an operand. Both directions of a normal have
 * one key. */
static bool add_plane(flush *f, vs_vec3 normal, vs_vec3 at, uint32_t operand) {
  vs_vec3 n = vs_v3_unit(normal);
  double first = fabs(n.x) > 1e-7 ? n.x : fabs(n.y) > 1e-7 ? n.y : n.z, h;
  if (!(vs_v3_length(n) > 0.5)) return true;
  bool turned = first < 0;
  if (turned) n = vs_v3_scale(n, -1);
  h = vs_v3_dot(n, vs_v3_sub(at, f->middle)) / f->step;
  if (!(fabs(h) < 1e15)) return true;
  if (!VS_GROW(f->planes, f->room, f->count + 1)) return false;
  f->planes[f->count++] = (face_plane){ { (int64_t)floor(n.x * 1e6 + 0.3137), (int64_t)floor(n.y * 1e6 + 0.3137),
                                          (int64_t)floor(n.z * 1e6 + 0.3137), (int64_t)floor(h + 0.3137) },
                                        turned,
                                        operand,
                                        (uint32_t)(f->part_count - 1) };
  return true;
}

/* Returns true if the pass must fail: memory is out or the run was interrupted. Any other error means that a part
 * cannot be meshed; the pass skips this part, and the mesher reports the error later. */
static bool starved(const vs_error *e) { return e->kind != VS_ERROR_NONE && e->kind != VS_ERROR_MODEL; }

/* Adds each plane of the faces of part n once. Adds no plane if the part cannot be meshed here. */
static bool add_part(flush *f, const vs_node *n, const vs_affine *placed, uint32_t operand) {
  static const vs_fineness coarse = { 1e300, 32 };
  vs_mesh mesh = { 0 };
  vs_error ignored = { 0 };
  size_t from = f->count;
  if (!VS_GROW(f->boxes, f->part_room, f->part_count + 1)) return false;
  vs_bounds *box = &f->boxes[f->part_count++];
  *box = vs_bounds_empty();
  if (n->kind == VS_HALF_SPACE) { /* to map a plane, maps two directions in the plane, which is simpler than mapping its
                                   * normal by the inverse transpose */
    vs_vec3 normal = vs_v3_unit(VS_AS(half_space, n)->normal),
            u = vs_v3_unit(vs_v3_cross(normal, fabs(normal.z) < 0.5 ? vs_v3(0, 0, 1) : vs_v3(1, 0, 0))),
            v = vs_v3_cross(normal, u);
    vs_vec3 o = VS_AS(half_space, n)->point, p = vs_affine_point(placed, o);
    *box = (vs_bounds){ vs_v3(-INFINITY, -INFINITY, -INFINITY), vs_v3(INFINITY, INFINITY, INFINITY) };
    return add_plane(f,
                     vs_v3_cross(vs_v3_sub(vs_affine_point(placed, vs_v3_add(o, u)), p),
                                 vs_v3_sub(vs_affine_point(placed, vs_v3_add(o, v)), p)),
                     p, operand);
  }
  if (n->class_ != VS_SOLID || n->flags & (VS_NODE_UNRESOLVED | VS_NODE_SUGAR) ||
      !vs_tessellate(n, &coarse, &mesh, &ignored))
    return vs_mesh_free(&mesh), !starved(&ignored);
  bool ok = true;
  for (size_t i = 0; i < mesh.vertex_count; i++) {
    mesh.vertices[i] = vs_affine_point(placed, mesh.vertices[i]);
    vs_bounds_add(box, mesh.vertices[i]);
  }
  for (size_t i = 0; ok && i < mesh.triangle_count; i++) {
    vs_vec3 a = mesh.vertices[mesh.triangles[i][0]], b = mesh.vertices[mesh.triangles[i][1]],
            c = mesh.vertices[mesh.triangles[i][2]];
    ok = add_plane(f, vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a)), a, operand);
  }
  ok = ok && vs_store_going(n->store, FACET_WORK * ((uint32_t)mesh.triangle_count + 1), f->error);
  vs_mesh_free(&mesh);
  if (f->count > from) qsort(f->planes + from, f->count - from, sizeof *f->planes, compare_planes);
  size_t kept = from;
  for (size_t i = from; i < f->count; i++)
    if (i == from || f->planes[i].turned != f->planes[kept - 1].turned ||
        !same_plane(&f->planes[i], &f->planes[kept - 1]))
      f->planes[kept++] = f->planes[i];
  f->count = kept;
  return ok;
}

/* Adds the planes of all parts of an operand, including those inside its sets. Sets *too_many if a limit is reached. */
static bool add_operand(flush *f, const vs_node *operand, uint32_t number, bool *too_many) {
  f->todo_count = 0;
  if (!VS_GROW(f->todo, f->todo_room, 1)) return false;
  f->todo[f->todo_count++] = (place){ operand, vs_affine_identity() };
  while (f->todo_count > 0 && !*too_many) {
    place at = f->todo[--f->todo_count];
    const vs_node *n = at.node;
    bool set = vs_node_is_set(n);
    if (!set && n->kind != VS_TRANSFORM && !vs_node_is_wrapper(n)) {
      if (!add_part(f, n, &at.placed, number)) return false;
      *too_many = f->part_count >= PARTS_MOST;
      continue;
    }
    if (n->kind == VS_TRANSFORM) at.placed = vs_affine_multiply(&at.placed, &VS_AS(transform, n)->matrix);
    if (!VS_GROW(f->todo, f->todo_room, f->todo_count + n->child_count)) return false;
    for (uint32_t i = 0; i < n->child_count; i++) f->todo[f->todo_count++] = (place){ n->children[i].node, at.placed };
  }
  return true;
}

/* Marks the operands that share a plane with an earlier operand. In a difference, the earlier operand must be the
 * first, or a cutter that is touched face to face. */
static void mark(flush *f, bool difference, unsigned char *marked, size_t operands) {
  size_t pairs = 0;
  if (f->count > 0) qsort(f->planes, f->count, sizeof *f->planes, compare_planes);
  for (size_t i = 0, end, turned; i < f->count; i = end) {
    for (end = i + 1; end < f->count && same_plane(&f->planes[i], &f->planes[end]);) end++;
    for (turned = i; turned < end && !f->planes[turned].turned;) turned++;
    for (size_t a = i; a < end; a++) {
      bool cutter = difference && f->planes[a].operand > 0;
      for (size_t b = !difference ? a + 1 : !cutter ? i : a < turned ? turned : end; b < end; b++) {
        if (++pairs > PAIRS_MOST) {
          memset(marked + 1, 1, operands - 1);
          return;
        }
        const face_plane *p = &f->planes[a], *q = &f->planes[b];
        uint32_t later = p->operand > q->operand ? p->operand : q->operand;
        if (p->operand != q->operand && !marked[later])
          marked[later] = vs_bounds_overlap(&f->boxes[p->part], &f->boxes[q->part], f->step);
      }
    }
  }
}

/* ---- enlarging parts ---- */

/* Computes the bounding box of part n, and the point about which it is enlarged: the centre of its mesh, or of its box
 * if it has no mesh. Returns false if there is nothing to enlarge, or if memory is out; *failed is true only in the
 * second case. */
static bool middle_of(const vs_node *n, vs_bounds *b, vs_vec3 *middle, bool *failed) {
  static const vs_fineness coarse = { 1e300, 32 };
  vs_mesh mesh = { 0 };
  vs_error ignored = { 0 };
  vs_vec3 sum = vs_v3(0, 0, 0);
  bool set = vs_node_is_set(n) || n->kind == VS_SLICE || n->flags & (VS_NODE_UNRESOLVED | VS_NODE_SUGAR);
  if (!vs_node_bounds(n, b, &ignored) || vs_bounds_is_empty(b) || !isfinite(vs_bounds_diagonal(b)))
    return *failed = starved(&ignored), false;
  *middle = vs_v3_scale(vs_v3_add(b->min, b->max), 0.5);
  if (!set && vs_tessellate(n, &coarse, &mesh, &ignored) && mesh.vertex_count > 0) {
    for (size_t i = 0; i < mesh.vertex_count; i++)
      sum = vs_v3_add(sum, vs_v3_scale(mesh.vertices[i], 1 / (double)mesh.vertex_count));
    *middle = sum;
  }
  vs_mesh_free(&mesh);
  return !(*failed = starved(&ignored));
}

/* Returns the solid of ref with all its faces moved outwards by about the length `by`. The node of ref is no placement.
 * Returns NULL if memory is out. */
static vs_node *grown_part(vs_ref ref, double by) {
  vs_node *n = ref.node;
  vs_store *s = n->store;
  const vs_shape *shape = vs_shape_of(n);
  if (shape && shape->grown) return shape->grown(s, n, by);
  vs_bounds b;
  vs_vec3 middle;
  bool failed = false;
  if (!middle_of(n, &b, &middle, &failed)) return failed ? NULL : vs_node_retain(n);
  vs_vec3 d = vs_v3_sub(b.max, b.min);
  vs_vec3 more = vs_v3(1 + 2 * by / fmax(d.x, by), 1 + 2 * by / fmax(d.y, by), 1 + 2 * by / fmax(d.z, by));
  return vs_node_new(s, VS_TRANSFORM, &(struct vs_transform){ .matrix = vs_affine_scaling(middle, more) }, &ref, 1);
}

/* Returns the factor by which a placement changes lengths on average: the cube root of its factor for volumes. */
static double lengthens(const vs_affine *a) {
  vs_vec3 x = vs_v3(a->m[0][0], a->m[1][0], a->m[2][0]), y = vs_v3(a->m[0][1], a->m[1][1], a->m[2][1]),
          z = vs_v3(a->m[0][2], a->m[1][2], a->m[2][2]);
  return cbrt(fabs(vs_v3_dot(x, vs_v3_cross(y, z))));
}

/* Returns the part with its faces moved outwards by about the length `by`, inside the same placements and materials.
 * Returns NULL if memory is out. */
static vs_node *grown_placed(vs_ref part, double by) {
  vs_ref at = part;
  while (vs_is_wrapper(at.node)) {
    if (at.node->kind == VS_TRANSFORM) {
      double longer = lengthens(&VS_AS(transform, at.node)->matrix);
      if (longer > 0) by /= longer;
    }
    at = at.node->children[0];
  }
  vs_node *core = grown_part(at, by);
  if (!core) return NULL;
  vs_node *made = vs_parts_within(part, (vs_ref){ core, at.origin });
  vs_node_release(core);
  return made;
}

static vs_node *grown(vs_ref operand, double by) {
  vs_ref *parts;
  size_t count;
  if (!vs_several_parts(operand, &parts, &count)) return NULL;
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) {
    vs_node *part = grown_placed(parts[i], by);
    ok = part != NULL;
    if (ok) vs_node_release(parts[i].node), parts[i].node = part;
  }
  vs_node *made = !ok          ? NULL
                  : count == 1 ? vs_node_retain(parts[0].node)
                               : vs_node_new(operand.node->store, VS_UNION, &(struct vs_union){ 0 }, parts, count);
  vs_several_free(parts, count);
  return made;
}

/* ---- the pass ---- */

static vs_node *part_flush(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  (void)origin;
  if ((n->kind != VS_DIFFERENCE && n->kind != VS_INTERSECTION) || n->class_ != VS_SOLID || n->child_count < 2)
    return vs_rewrite_keep(w, n, kids);
  vs_bounds reach;
  vs_error ignored = { 0 };
  double diagonal =
      vs_node_bounds(n->kind == VS_DIFFERENCE ? kids[0].node : n, &reach, &ignored) ? vs_bounds_diagonal(&reach) : 0;
  if (starved(&ignored)) return NULL;
  if (!(diagonal > 0) || !isfinite(diagonal)) return vs_rewrite_keep(w, n, kids);
  flush f = { .error = w->error, .step = 1e-7 * diagonal, .middle = vs_v3_scale(vs_v3_add(reach.min, reach.max), 0.5) };
  unsigned char *marked = vs_zeros(n->child_count, 1);
  vs_ref *now = vs_fresh(n->child_count, sizeof *now);
  bool ok = marked && now, too_many = false, any = false;
  for (uint32_t i = 0; ok && i < n->child_count; i++) ok = add_operand(&f, kids[i].node, i, &too_many);
  if (ok && too_many) memset(marked + 1, 1, n->child_count - 1);
  else if (ok) mark(&f, n->kind == VS_DIFFERENCE, marked, n->child_count);
  flush_free(&f);
  uint32_t made = 0;
  for (; ok && made < n->child_count; made++) {
    now[made] = kids[made];
    any = any || marked[made];
    /* In an intersection, each operand is enlarged by a different length, so that two enlarged operands do not have
     * faces in one plane. */
    if (!marked[made]) vs_node_retain(kids[made].node);
    else if (!(now[made].node = grown(kids[made], diagonal * 0x1p-16 * (n->kind == VS_DIFFERENCE ? 1 : made))))
      ok = false;
    if (!ok) break;
  }
  vs_node *result = !ok   ? NULL
                    : any ? vs_node_new(w->store, (vs_kind)n->kind, vs_node_data(n), now, n->child_count)
                          : vs_rewrite_keep(w, n, kids);
  w->changed += ok && any;
  for (uint32_t i = 0; i < made; i++) vs_node_release(now[i].node);
  free(marked);
  free(now);
  return result;
}

bool vs_scene_part_flush(vs_scene *scene, vs_error *e) {
  if (scene->drawn_count == 0) return true;
  vs_rewrite w = { .store = scene->store, .error = e };
  return vs_rewrite_alone(&w, part_flush, scene->drawn, scene->drawn_count);
}
