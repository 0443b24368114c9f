/* Separates faces that lie in one plane (flush.h).
 *
 * Two parts are flush if a facet of each lies in the same plane. The pass meshes every part at a coarse fixed tolerance
 * and stores each plane once, as four whole numbers. Equal numbers mean the same plane. This also finds round walls
 * that coincide, because equal round parts have equal facets. Subtrees, parts and facets whose boxes do not meet the
 * box of another operand are skipped: the loop `(subtract (unite o a) b)` makes thousands of nested sets, and each
 * difference visits its neighbourhood.
 *
 * Flush parts are enlarged, each part of an operand separately, in its own coordinates, so that all faces move
 * outwards. In a difference only cutters are enlarged, so the faces of the result do not move. These are cutters that
 * are flush with the solid that they cut, and cutters that touch an earlier cutter face to face. In an intersection of
 * two flush operands, one of them is enlarged. Solids with an axis are enlarged as their own kind, others about their
 * centre. In the second case, walls of a notched shape that face the centre move by slightly less.
 *
 * Cost: a test of boxes for each level of nesting, the facets near each distinct difference, and a sort. */
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

enum { FACET_WORK = 64, VISIT_WORK = 64 }; /* work for a facet of a part, and for a visit to a node, in the units of
                                            * vs_store_going */
/* Greatest numbers: of parts of one set, of pairs of its planes that are compared, and of nodes that the whole pass
 * visits. In a set that exceeds them, every part counts as flush: as if it had a face in a plane with another part. */
enum { PARTS_MOST = 4000, PAIRS_MOST = 1000000, VISITS_MOST = 1 << 23 };
enum { NEAR_MOST = 16 }; /* greatest number of boxes that represent the other operands of a set */
/* enlarges a box, as a part of its diagonal, because bounds of curved shapes are computed from sample points */
#define FLUSH_SLACK 2e-3

/* key: plane of a face as four whole numbers; turned: 1 if the face's normal is opposite to the key's normal; operand,
 * part: numbers of the operand and the part that have this face */
typedef struct { int64_t key[4]; uint32_t turned, operand, part; } face_plane;
typedef struct { const vs_node *node; vs_affine placed; } place; /* a node inside a set, and its placement in the set's
                                                                  * coordinates */

/* The memory of the pass from set to set. The rewritten nodes live as long as the pass. */
typedef struct { vs_bounds_memo memo; size_t visits; } flush_pass;

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
  vs_bounds near[NEAR_MOST]; /* boxes that contain the other operands of the set, while the parts of one are added */
  size_t near_count;
  bool too_many;    /* true if a limit is exceeded */
  flush_pass *pass;
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

/* Sets *out to the bounds of node n. A node without bounds counts as unbounded. Returns false if the pass must fail. */
static bool flush_bounds(flush_pass *pass, const vs_node *n, vs_bounds *out) {
  vs_error ignored = { 0 };
  if (!(n->flags & VS_NODE_ENDLESS) && vs_bounds_memo_get(&pass->memo, n, out, &ignored)) return true;
  *out = (vs_bounds){ vs_v3(-INFINITY, -INFINITY, -INFINITY), vs_v3(INFINITY, INFINITY, INFINITY) };
  return !starved(&ignored);
}

/* Returns true if box b, enlarged by slack, meets another operand. */
static bool is_near(const flush *f, const vs_bounds *b, double slack) {
  bool near = false;
  for (size_t i = 0; !near && i < f->near_count; i++) near = vs_bounds_overlap(b, &f->near[i], slack);
  return near;
}

/* Sets *near to true if the bounds of a placed node meet another operand. Returns false if the pass must fail. */
static bool place_is_near(flush *f, const place *at, bool *near) {
  vs_bounds b;
  if (!flush_bounds(f->pass, at->node, &b)) return false;
  *near = !vs_bounds_is_empty(&b);
  if (!*near || !isfinite(vs_bounds_diagonal(&b))) return true;
  b = vs_bounds_transform(&b, &at->placed);
  *near = is_near(f, &b, f->step + FLUSH_SLACK * vs_bounds_diagonal(&b));
  return true;
}

/* Adds each plane of those faces of part n once that are near. Adds no plane if the part cannot be meshed here. */
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
  double slack = f->step + FLUSH_SLACK * vs_bounds_diagonal(box);
  for (size_t i = 0; ok && i < mesh.triangle_count; i++) {
    vs_vec3 a = mesh.vertices[mesh.triangles[i][0]], b = mesh.vertices[mesh.triangles[i][1]],
            c = mesh.vertices[mesh.triangles[i][2]];
    vs_bounds facet = { a, a };
    vs_bounds_add(&facet, b), vs_bounds_add(&facet, c);
    if (is_near(f, &facet, slack)) ok = add_plane(f, vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a)), a, operand);
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

/* Adds the planes of all parts of an operand that are near, including those inside its sets. Sets too_many if a limit
 * is exceeded. */
static bool add_operand(flush *f, const vs_node *operand, uint32_t number) {
  f->todo_count = 0;
  if (!VS_GROW(f->todo, f->todo_room, 1)) return false;
  f->todo[f->todo_count++] = (place){ operand, vs_affine_identity() };
  while (f->todo_count > 0 && !f->too_many) {
    place at = f->todo[--f->todo_count];
    const vs_node *n = at.node;
    bool inner = vs_node_is_set(n) || n->kind == VS_TRANSFORM || vs_node_is_wrapper(n), near;
    f->pass->visits++;
    if (!vs_store_going(n->store, VISIT_WORK, f->error) || !place_is_near(f, &at, &near)) return false;
    if (near && !inner && !add_part(f, n, &at.placed, number)) return false;
    f->too_many = f->part_count >= PARTS_MOST || f->pass->visits >= VISITS_MOST;
    if (!near || !inner) continue;
    if (n->kind == VS_TRANSFORM) at.placed = vs_affine_multiply(&at.placed, &VS_AS(transform, n)->matrix);
    if (!VS_GROW(f->todo, f->todo_room, f->todo_count + n->child_count)) return false;
    for (uint32_t i = 0; i < n->child_count; i++) f->todo[f->todo_count++] = (place){ n->children[i].node, at.placed };
  }
  return true;
}

/* Adds the planes of all operands. boxes[i]: bounds of operand i; after[i]: bounds of all operands after it. The first
 * operand may be large, and has a box of its own. */
static bool add_operands(flush *f, const vs_ref *operands, size_t count, const vs_bounds *boxes,
                         const vs_bounds *after) {
  size_t each = (count - 1 + NEAR_MOST - 1) / NEAR_MOST;
  f->near_count = (count - 1 + each - 1) / each;
  VS_ASSERT(count > 1 && f->near_count <= NEAR_MOST);
  for (size_t i = 0; i < f->near_count; i++) f->near[i] = vs_bounds_empty();
  for (size_t i = 1; i < count; i++) vs_bounds_unite(&f->near[(i - 1) / each], &boxes[i]);
  bool ok = add_operand(f, operands[0].node, 0);
  f->near[0] = boxes[0];
  f->near[1] = vs_bounds_empty(); /* the operands between the first and number i */
  f->near_count = 3;
  for (size_t i = 1; ok && !f->too_many && i < count; i++) {
    f->near[2] = after[i];
    ok = add_operand(f, operands[i].node, (uint32_t)i);
    vs_bounds_unite(&f->near[1], &boxes[i]);
  }
  return ok;
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

/* Sets boxes[i] to the bounds of kid i of the set n, after[i] to those of all later kids, and *reach to those of the
 * set. Returns false if the pass must fail. */
static bool kid_boxes(flush_pass *pass, const vs_node *n, const vs_ref *kids, vs_bounds *boxes, vs_bounds *after,
                      vs_bounds *reach) {
  for (size_t i = 0; i < n->child_count; i++)
    if (!flush_bounds(pass, kids[i].node, &boxes[i])) return false;
  *reach = boxes[0];
  for (size_t i = 1; n->kind == VS_INTERSECTION && i < n->child_count; i++) vs_bounds_meet(reach, &boxes[i]);
  after[n->child_count - 1] = vs_bounds_empty();
  for (size_t i = n->child_count - 1; i-- > 0;) {
    after[i] = after[i + 1];
    vs_bounds_unite(&after[i], &boxes[i + 1]);
  }
  return true;
}

/* Sets marked[i] to 1 for each kid of the set n that must be enlarged, and *diagonal to the set's size. Returns false
 * if the pass must fail. */
static bool mark_kids(vs_rewrite *w, const vs_node *n, const vs_ref *kids, unsigned char *marked, double *diagonal) {
  vs_bounds reach, *boxes = vs_fresh(n->child_count, sizeof *boxes), *after = vs_fresh(n->child_count, sizeof *after);
  bool ok = boxes && after && kid_boxes(w->state, n, kids, boxes, after, &reach);
  *diagonal = ok ? vs_bounds_diagonal(&reach) : 0;
  if (*diagonal > 0 && isfinite(*diagonal)) {
    flush f = { .pass = w->state, .error = w->error, .step = 1e-7 * *diagonal,
                .middle = vs_v3_scale(vs_v3_add(reach.min, reach.max), 0.5) };
    ok = add_operands(&f, kids, n->child_count, boxes, after);
    if (ok && f.too_many) memset(marked + 1, 1, n->child_count - 1);
    else if (ok) mark(&f, n->kind == VS_DIFFERENCE, marked, n->child_count);
    flush_free(&f);
  }
  free(boxes);
  free(after);
  return ok;
}

static vs_node *part_flush(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  (void)origin;
  if ((n->kind != VS_DIFFERENCE && n->kind != VS_INTERSECTION) || n->class_ != VS_SOLID || n->child_count < 2)
    return vs_rewrite_keep(w, n, kids);
  unsigned char *marked = vs_zeros(n->child_count, 1);
  vs_ref *now = vs_fresh(n->child_count, sizeof *now);
  double diagonal;
  bool ok = marked && now && mark_kids(w, n, kids, marked, &diagonal), any = false;
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
  flush_pass pass = { .memo = { .places = { .store = scene->store } } };
  vs_rewrite w = { .store = scene->store, .error = e, .state = &pass };
  bool ok = vs_rewrite_alone(&w, part_flush, scene->drawn, scene->drawn_count);
  vs_bounds_memo_free(&pass.memo);
  return ok;
}
