/* Divides an object into pieces whose measures (volume, area, centroid) can be computed separately.
 *
 * The list of jobs contains pieces of the object that do not overlap, each with its placement and a sign. If a piece
 * has a formula, its measure is added to the sum. A union is divided into its parts; a part whose box intersects no
 * other part's box is a separate job. In a difference, cutters that do not intersect the body are ignored. If all
 * cutters lie inside a convex body, the measure is that of the body minus that of the cutters' union. All other parts
 * are collected and meshed together. Boxes that share less than 2^-28 of the object count as separate for volumes, and
 * as touching for areas. No function here is recursive. */
#include "solids/solid_measures.h"

#include <stdlib.h>

#include "kernel/mesh/bvh.h"
#include "kernel/cluster.h"
#include "solids/overlaps.h"
#include "solids/solid_meshes.h"
#include "model/store/array.h"

enum { MOST_PARTS = 1000000, CHEAP = 60000 /* MOST_PARTS: greatest number of parts of a union that are measured
                                            * separately. CHEAP: number of triangles up to which a finer mesh is made to
                                            * improve the result. */ };

typedef struct { vs_ref ref; vs_affine placed; double sign; } job;
typedef struct { vs_ref ref; vs_affine placed; vs_bounds box; bool cutter; } part;

typedef struct {
  vs_kernel k;
  vs_ask ask;
  double tolerance;
  vs_bounds_memo boxes;
  vs_nodemap known;           /* maps a node to the number of its formula in the list of formulas, plus 1 */
  VS_LIST(vs_measure) formulas;
  VS_LIST(job) jobs;
  VS_LIST(part) parts;        /* parts into which the piece that is being measured is divided */
  VS_LIST(vs_ref) rest[2];    /* parts that are meshed together: rest[0] has the added parts, rest[1] the subtracted
                               * parts; the lists hold references to their nodes */
  VS_LIST(vs_node *) made;    /* nodes that were made for the pieces; they are released at the end */
  bool rough;                 /* true if the mesh of some part overlaps itself; a finer mesh would then take long to
                               * compute */
  double volume, area;
  vs_vec3 moment;
  vs_error *error;
} measuring;

static bool memory(measuring *m) { return vs_error_memory(m->error, NULL); }

/* Sets the error after a failure of the kernel's functions: an interrupt, or out of memory. Returns false. */
static bool kernel_failed(measuring *m) {
  if (m->k.error->status != VS_KERNEL_INTERRUPTED) return memory(m);
  return vs_error_set(m->error, VS_ERROR_INTERRUPT, NULL, "interrupted");
}

static void add(measuring *m, double volume, double area, vs_vec3 centroid, double sign) {
  m->volume += sign * volume;
  m->area += area; /* the area of a cavity's wall is added, although the cavity's volume is subtracted */
  m->moment = vs_v3_add(m->moment, vs_v3_scale(centroid, sign * volume));
}

static vs_ref below(vs_ref at, vs_affine *placed) { /* returns the object inside all placements, materials and layers
                                                     * around `at`, and multiplies *placed by these placements */
  while (at.node->child_count == 1 &&
         (at.node->kind == VS_TRANSFORM || at.node->kind == VS_UNION || vs_node_is_wrapper(at.node))) {
    if (at.node->kind == VS_TRANSFORM) *placed = vs_affine_multiply(placed, &VS_AS(transform, at.node)->matrix);
    at = at.node->children[0];
  }
  return at;
}

/* ---- formulas; each distinct node is measured once ---- */

static bool is_swept(const vs_node *n) { return n->kind == VS_SWEEP || n->kind == VS_THICKEN; }

static bool formula(measuring *m, vs_node *n, vs_measure *out) {
  bool found, overlaps = false;
  uint64_t *place = vs_nodemap_put(&m->known, n, &found);
  if (!place) return memory(m);
  if (found && *place) return *out = m->formulas.at[*place - 1], true;
  if (!vs_node_measure(n, out, m->error)) return false;
  if (!out->known && m->ask != VS_ASK_CENTROID && is_swept(n)) {
    vs_bounds b;
    if (!vs_sweep_measure(n, out, m->error) || !vs_bounds_memo_get(&m->boxes, n, &b, m->error)) return false;
    vs_fineness f = { m->tolerance > 0 ? m->tolerance : vs_fineness_tolerance(&b), 0 };
    if (out->known && !vs_primitive_overlaps(n, &f, m->k.options, &overlaps, m->error)) return false;
    out->known = out->known && !overlaps;
    m->rough = m->rough || overlaps;
  }
  if (!VS_PUSH(&m->k, m->formulas, *out)) return memory(m);
  *vs_nodemap_put(&m->known, n, NULL) = m->formulas.count;
  return true;
}

/* If a formula gives all measures of job j, adds them to the sum and sets *done to true. Returns false on failure. */
static bool by_formula(measuring *m, const job *j, bool *done) {
  vs_measure one;
  double k;
  if (!formula(m, j->ref.node, &one)) return false;
  *done = one.known && (m->ask != VS_ASK_AREA || (one.area_known && vs_affine_even(&j->placed, &k)));
  if (*done)
    add(m, one.volume * fabs(vs_affine_determinant(&j->placed)), m->ask == VS_ASK_AREA ? one.area * k * k : 0,
        vs_affine_point(&j->placed, one.centroid), j->sign);
  return true;
}

/* ---- division ---- */

static bool left_over(measuring *m, vs_ref ref, const vs_affine *placed, double sign) {
  vs_node *n = vs_node_new(ref.node->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = *placed }, &ref, 1);
  if (!n) return memory(m);
  int which = sign < 0;
  if (VS_PUSH(&m->k, m->rest[which], ((vs_ref){ n, ref.origin }))) return true;
  vs_node_release(n);
  return memory(m);
}

static bool box_of(measuring *m, const part *p, vs_bounds *out) {
  double k;
  if (!vs_bounds_memo_get(&m->boxes, p->ref.node, out, m->error)) return false;
  if (vs_bounds_is_empty(out)) return true;
  vs_affine bare = p->placed;
  bare.m[0][3] = bare.m[1][3] = bare.m[2][3] = 0;
  if (vs_affine_even(&bare, &k) && bare.m[0][0] != 0 && bare.m[1][1] != 0 && bare.m[2][2] != 0 && bare.m[0][1] == 0 &&
      bare.m[0][2] == 0 && bare.m[1][2] == 0) {
    *out = vs_bounds_transform(out, &p->placed);
    return true;
  }
  vs_ref ref = p->ref; /* Computes the box of the object after the rotation, which is smaller than its box before the
                        * rotation, rotated. */
  vs_node *n = vs_node_new(ref.node->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = p->placed }, &ref, 1);
  bool ok = n ? vs_node_bounds(n, out, m->error) : memory(m);
  vs_node_release(n);
  return ok;
}

/* Appends the parts of the union `root`, including those of nested unions. *whole: false if there are too many parts.
 * Returns false on failure. */
static bool spread(measuring *m, vs_ref root, const vs_affine *placed, bool *whole) {
  VS_LIST(job) stack = { 0 };
  bool ok = VS_PUSH(&m->k, stack, ((job){ root, *placed, 1 })) || memory(m);
  *whole = true;
  while (ok && stack.count) {
    job at = stack.at[--stack.count];
    at.ref = below(at.ref, &at.placed);
    const vs_node *n = at.ref.node;
    if (n->class_ != VS_SOLID) continue; /* skips empty nodes and ghosts */
    if (n->kind == VS_UNION) {
      for (uint32_t i = n->child_count; ok && i-- > 0;)
        ok = VS_PUSH(&m->k, stack, ((job){ n->children[i], at.placed, 1 })) || memory(m);
      continue;
    }
    part p = { at.ref, at.placed, vs_bounds_empty(), false };
    if (m->parts.count == MOST_PARTS) {
      *whole = false;
      break;
    }
    ok = box_of(m, &p, &p.box) && (vs_bounds_is_empty(&p.box) || VS_PUSH(&m->k, m->parts, p) || memory(m));
    ok = ok && (vs_kernel_poll(&m->k, 0) || vs_error_set(m->error, VS_ERROR_INTERRUPT, NULL, "interrupted"));
  }
  VS_DROP(&m->k, stack);
  return ok;
}

static bool join(void *set, uint32_t a, uint32_t b) {
  vs_unite(set, a, b);
  return true;
}

/* Finds parts that are connected through intersecting boxes. set[i]: first part of the group that contains part i.
 * Returns false on failure. */
static bool cluster(measuring *m, uint32_t *set) {
  uint32_t n = (uint32_t)m->parts.count;
  vs_bounds all = vs_bounds_empty();
  vs_bvh bvh = { 0 };
  vs_bvh_box *boxes = vs_fresh(n + (size_t)1, sizeof *boxes);
  int32_t slack = m->ask == VS_ASK_AREA ? -1 : 1; /* number of steps by which each box shrinks on each side: 1 for
                                                   * volumes, so that boxes that barely overlap count as separate; -1
                                                   * for areas, so that they count as touching */
  vs_disjoint(set, n);
  for (uint32_t i = 0; i < n; i++) vs_bounds_unite(&all, &m->parts.at[i].box);
  double low[3] = { all.min.x, all.min.y, all.min.z },
         size = fmax(fmax(all.max.x - all.min.x, all.max.y - all.min.y), all.max.z - all.min.z),
         step = size > 0 ? size * 0x1p-28 : 1;
  for (uint32_t i = 0; boxes && i < n; i++) {
    const vs_bounds *b = &m->parts.at[i].box;
    double from[3] = { b->min.x, b->min.y, b->min.z }, to[3] = { b->max.x, b->max.y, b->max.z };
    for (int a = 0; a < 3; a++) {
      boxes[i].min[a] = (int32_t)floor((from[a] - low[a]) / step) + slack;
      boxes[i].max[a] = (int32_t)ceil((to[a] - low[a]) / step) - slack;
      if (boxes[i].max[a] < boxes[i].min[a]) boxes[i].max[a] = boxes[i].min[a];
    }
  }
  bool ok = (boxes && vs_bvh_build(&m->k, &bvh, boxes, n) && vs_bvh_pairs(&m->k, &bvh, 0, UINT32_MAX, join, set)) ||
            kernel_failed(m);
  for (uint32_t i = 0; ok && i < n; i++) set[i] = vs_find(set, i);
  vs_bvh_free(&m->k, &bvh);
  free(boxes);
  return ok;
}

/* Sets *inside to true if the boxes of all cutters lie inside the convex body; for areas, they must not touch its
 * surface. The cutters are the parts in the group `root` of `set`. Returns false on failure. */
static bool holds(measuring *m, const part *body, const uint32_t *set, uint32_t root, bool *inside) {
  vs_affine back;
  *inside = vs_node_has(body->ref.node, VS_IS_CONVEX) && vs_affine_invert(&body->placed, &back);
  double slack = m->ask == VS_ASK_AREA ? 1e-9 * vs_bounds_diagonal(&body->box) : 0;
  for (uint32_t i = 0; *inside && i < m->parts.count; i++) {
    const part *p = &m->parts.at[i];
    if (set[i] != root || !p->cutter) continue;
    for (int c = 0; *inside && c < 8; c++) {
      vs_vec3 at = { c & 1 ? p->box.max.x + slack : p->box.min.x - slack,
                     c & 2 ? p->box.max.y + slack : p->box.min.y - slack,
                     c & 4 ? p->box.max.z + slack : p->box.min.z - slack };
      if (!vs_node_contains(body->ref.node, vs_affine_point(&back, at), inside, m->error)) return false;
    }
  }
  return true;
}

/* Measures a group of connected parts, with the numbers member[0] to member[count - 1]. root: number of the first.
 * Returns false on failure. */
static bool settle_cluster(measuring *m, const uint32_t *set, const uint32_t *member, uint32_t count, double sign,
                           vs_ref whole) {
  uint32_t bodies = 0, cutters = 0, body = 0;
  bool inside = false, ok = true;
  for (uint32_t i = 0; i < count; i++) {
    if (m->parts.at[member[i]].cutter) cutters++;
    else bodies++, body = member[i];
  }
  if (!bodies) return true;
  if (bodies == 1 && cutters && !holds(m, &m->parts.at[body], set, set[body], &inside)) return false;
  if (bodies == 1 && (!cutters || inside)) {
    part p = m->parts.at[body];
    ok = VS_PUSH(&m->k, m->jobs, ((job){ p.ref, p.placed, sign })) || memory(m);
  }
  if (!cutters && bodies == 1) return ok;
  if (!cutters) {
    for (uint32_t i = 0; ok && i < count; i++)
      ok = left_over(m, m->parts.at[member[i]].ref, &m->parts.at[member[i]].placed, sign);
    return ok;
  }
  vs_ref *refs = vs_zeros(count + (size_t)1, sizeof *refs); /* the array contains first the bodies of all differences in
                                                             * the group, then their cutters */
  uint32_t at[2] = { 0, bodies };
  if (!refs) return memory(m);
  for (uint32_t i = 0; ok && i < count; i++) {
    const part *p = &m->parts.at[member[i]];
    vs_ref ref = p->ref, *to = &refs[at[p->cutter]++];
    *to = (vs_ref){ vs_node_new(ref.node->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = p->placed }, &ref, 1),
                    ref.origin };
    ok = to->node || memory(m);
  }
  vs_store *s = whole.node->store;
  vs_ref sets[2] = { { NULL, whole.origin }, { NULL, whole.origin } }, made = { NULL, whole.origin };
  if (ok) sets[0].node = vs_node_new(s, VS_UNION, &(struct vs_union){ 0 }, refs, bodies);
  if (ok) sets[1].node = vs_node_new(s, VS_UNION, &(struct vs_union){ 0 }, refs + bodies, cutters);
  ok = ok && ((sets[0].node && sets[1].node) || memory(m));
  vs_affine identity = vs_affine_identity();
  if (ok && inside) {
    ok = VS_PUSH(&m->k, m->made, sets[1].node) || memory(m);
    if (ok) vs_node_retain(sets[1].node);
    ok = ok && (VS_PUSH(&m->k, m->jobs, ((job){ sets[1], identity, -sign })) || memory(m));
  } else if (ok) {
    made.node = vs_node_new(s, VS_DIFFERENCE, &(struct vs_difference){ 0 }, sets, 2);
    ok = made.node ? left_over(m, made, &identity, sign) : memory(m);
  }
  vs_node_release(made.node);
  vs_node_release(sets[0].node);
  vs_node_release(sets[1].node);
  for (uint32_t i = 0; i < count; i++) vs_node_release(refs[i].node);
  free(refs);
  return ok;
}

/* Measures the parts of a job, one group of connected parts after another. sign: 1 if their measures are added, -1 if
 * subtracted. Returns false on failure. */
static bool settle_parts(measuring *m, double sign, vs_ref whole) {
  uint32_t n = (uint32_t)m->parts.count, *set = vs_fresh(3 * (size_t)n + 3, sizeof *set);
  if (!set) return memory(m);
  uint32_t *start = set + n, *member = start + n + 2;
  bool ok = cluster(m, set);
  for (uint32_t i = 0; i < n + 2; i++) start[i] = 0;
  for (uint32_t i = 0; ok && i < n; i++) start[set[i] + 2]++;
  for (uint32_t i = 2; ok && i < n + 2; i++) start[i] += start[i - 1];
  for (uint32_t i = 0; ok && i < n; i++) member[start[set[i] + 1]++] = i;
  for (uint32_t i = 0; ok && i < n; i++)
    if (set[i] == i) ok = settle_cluster(m, set, member + start[i], start[i + 1] - start[i], sign, whole);
  free(set);
  return ok;
}

static bool take_apart(measuring *m, job j) {
  j.ref = below(j.ref, &j.placed);
  vs_node *n = j.ref.node;
  bool done, whole = true;
  if (n->class_ != VS_SOLID) return true;
  if (!by_formula(m, &j, &done)) return false;
  if (done) return true;
  m->parts.count = 0;
  if (n->kind == VS_UNION) {
    if (!spread(m, j.ref, &j.placed, &whole)) return false;
  } else if (n->kind == VS_DIFFERENCE && !(n->flags & (VS_NODE_ENDLESS | VS_NODE_CUT))) {
    if (!spread(m, n->children[0], &j.placed, &whole)) return false;
    size_t bodies = m->parts.count;
    for (uint32_t i = 1; whole && i < n->child_count; i++)
      if (!spread(m, n->children[i], &j.placed, &whole)) return false;
    for (size_t i = bodies; i < m->parts.count; i++) m->parts.at[i].cutter = true;
  } else if (n->kind == VS_INTERSECTION && !(n->flags & (VS_NODE_ENDLESS | VS_NODE_CUT))) {
    vs_bounds box[2];
    for (uint32_t i = 0; i < n->child_count; i++) {
      part p = { n->children[i], j.placed, vs_bounds_empty(), false };
      if (!box_of(m, &p, &box[i > 0])) return false;
      if (i) vs_bounds_meet(&box[0], &box[1]);
      if (vs_bounds_is_empty(&box[0])) return true;
    }
    whole = false;
  } else {
    whole = false;
  }
  if (!whole) return left_over(m, j.ref, &j.placed, j.sign);
  return settle_parts(m, j.sign, j.ref);
}

/* ---- parts without a formula ---- */

/* Sets m->rough if the parts that are meshed together contain a sweep or pipe that overlaps itself. Returns false on
 * failure. */
static bool find_rough(measuring *m, int which, const vs_fineness *f) {
  vs_nodemap seen = { .store = m->known.store };
  VS_LIST(vs_node *) stack = { 0 };
  bool ok = true, found;
  for (size_t i = 0; ok && i < m->rest[which].count; i++)
    ok = VS_PUSH(&m->k, stack, m->rest[which].at[i].node) || memory(m);
  while (ok && stack.count && !m->rough) {
    vs_node *n = stack.at[--stack.count];
    if (is_swept(n)) ok = vs_primitive_overlaps(n, f, m->k.options, &m->rough, m->error);
    for (uint32_t i = 0; ok && !is_swept(n) && i < n->child_count; i++) {
      vs_node *child = n->children[i].node;
      if (child->class_ != VS_SOLID) continue;
      ok = vs_nodemap_put(&seen, child, &found) && (found || VS_PUSH(&m->k, stack, child));
      ok = ok || memory(m);
    }
    ok = ok && (vs_kernel_poll(&m->k, 1) || kernel_failed(m));
  }
  VS_DROP(&m->k, stack);
  vs_nodemap_free(&seen);
  return ok;
}

static bool mesh_rest(measuring *m, int which, const vs_bounds *drawing) {
  const vs_ref *refs = m->rest[which].at;
  vs_fineness f = { m->tolerance > 0 ? m->tolerance : vs_fineness_tolerance(drawing), 0 };
  vs_measure one;
  for (int again = 0; again < 2; again++) {
    vs_solid solid = { 0 };
    if (!vs_solid_evaluate(refs, m->rest[which].count, &f, m->k.options, &solid, m->error)) return false;
    vs_mesh_measure(&solid.mesh, &one);
    size_t triangles = solid.mesh.triangle_count;
    vs_solid_free(&solid);
    double finer = fmin(CHEAP / fmax((double)triangles, 1), 64);
    if (again || m->tolerance > 0 || finer < 2) break;
    if (!m->rough && !find_rough(m, which, &f)) return false;
    if (m->rough) break;
    f.tolerance = ldexp(f.tolerance, -(int)floor(log2(finer)));
  }
  add(m, one.volume, one.area, one.centroid, which ? -1 : 1);
  return true;
}

bool vs_solid_measure(vs_ref ref, vs_ask ask, double tolerance, const vs_kernel_options *options, vs_measure *out,
                      vs_error *e) {
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  measuring m = { .ask = ask, .tolerance = tolerance, .error = e };
  m.k.options = options, m.k.error = &why, m.k.threads = 1;
  m.known.store = m.boxes.places.store = ref.node->store;
  vs_bounds drawing;
  bool ok = vs_node_bounds(ref.node, &drawing, e) &&
            (VS_PUSH(&m.k, m.jobs, ((job){ ref, vs_affine_identity(), 1 })) || memory(&m));
  while (ok && m.jobs.count) ok = take_apart(&m, m.jobs.at[--m.jobs.count]);
  for (int which = 0; which < 2; which++) {
    if (ok && m.rest[which].count) ok = mesh_rest(&m, which, &drawing);
    for (size_t i = 0; i < m.rest[which].count; i++) vs_node_release(m.rest[which].at[i].node);
    VS_DROP(&m.k, m.rest[which]);
  }
  *out = (vs_measure){ .known = ok, .area_known = ok && ask == VS_ASK_AREA, .volume = m.volume, .area = m.area };
  if (m.volume != 0) out->centroid = vs_v3_scale(m.moment, 1 / m.volume);
  for (size_t i = 0; i < m.made.count; i++) vs_node_release(m.made.at[i]);
  VS_DROP(&m.k, m.made);
  VS_DROP(&m.k, m.formulas);
  VS_DROP(&m.k, m.jobs);
  VS_DROP(&m.k, m.parts);
  vs_nodemap_free(&m.known);
  vs_bounds_memo_free(&m.boxes);
  return ok;
}
