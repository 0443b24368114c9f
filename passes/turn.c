/* Tests, for the pass share, whether a subtree is another subtree rotated, mirrored and moved.
 *
 * The test walks both subtrees side by side, and keeps the map from the root to the current node of each. Each pair of
 * primitives gives pairs of points that move with them. These are a primitive's own points if they determine it (a
 * sphere's centre, a cylinder's ends, corners). Otherwise they are the origin and the axes of its frame, and its fields
 * must then be equal. Three points far from each other, and the side on which a fourth point lies, determine the only
 * possible rigid map. Every pair must then agree with this map. Therefore a template deviates from its copies by no
 * more than rounding errors. */
#include "passes/turn.h"

#include <math.h>
#include <string.h>

#include "passes/rewrite.h"
#include "model/store/hashes.h"

enum { PAIRS_MOST = 20000 };

typedef struct { const vs_node *a, *b; vs_affine to_a, to_b; } turn_step;
typedef struct { vs_vec3 a, b; } turn_pair;
typedef struct {
  vs_store *store;
  double near;
  turn_step *steps;
  size_t step_count, step_room;
  turn_pair *pairs;
  size_t pair_count, pair_room;
  size_t steps_taken; /* number of nodes visited so far, which is limited */
  vs_error *error;    /* error that is set if memory is out or the run is interrupted */
} turner;

static bool turn_push(turner *t, const vs_node *a, const vs_affine *to_a, const vs_node *b, const vs_affine *to_b) {
  if (t->step_count == t->step_room) {
    size_t room = t->step_room ? 2 * t->step_room : 64;
    turn_step *grown = vs_store_realloc(t->store, t->steps, t->step_room * sizeof *grown, room * sizeof *grown);
    if (!grown) return vs_error_memory(t->error, NULL);
    t->steps = grown;
    t->step_room = room;
  }
  t->steps[t->step_count++] = (turn_step){ a, b, *to_a, *to_b };
  return true;
}

static bool turn_pair_add(turner *t, vs_vec3 a, vs_vec3 b) {
  if (t->pair_count == PAIRS_MOST) return false;
  if (t->pair_count == t->pair_room) {
    size_t room = t->pair_room ? 2 * t->pair_room : 64;
    turn_pair *grown = vs_store_realloc(t->store, t->pairs, t->pair_room * sizeof *grown, room * sizeof *grown);
    if (!grown) return vs_error_memory(t->error, NULL);
    t->pairs = grown;
    t->pair_room = room;
  }
  t->pairs[t->pair_count++] = (turn_pair){ a, b };
  return true;
}

static bool turn_points(turner *t, const turn_step *x, const vs_points *a, const vs_points *b) {
  bool ok = a->count == b->count;
  for (uint32_t i = 0; ok && i < a->count; i++)
    ok = turn_pair_add(t, vs_affine_point(&x->to_a, a->at[i]), vs_affine_point(&x->to_b, b->at[i]));
  return ok;
}

static bool turn_point(turner *t, const turn_step *x, vs_vec3 a, vs_vec3 b) {
  return turn_pair_add(t, vs_affine_point(&x->to_a, a), vs_affine_point(&x->to_b, b));
}

static bool turn_near(double x, double y) { return fabs(x - y) <= ldexp(fmax(fabs(x), fabs(y)), -40); }
static bool turn_near_points(const turner *t, vs_vec3 a, vs_vec3 b) {
  return fabs(a.x - b.x) <= t->near && fabs(a.y - b.y) <= t->near && fabs(a.z - b.z) <= t->near;
}

static bool turn_is_rigid(const vs_affine *a) {
  double k;
  return vs_affine_even(a, &k) && fabs(k - 1) < 1e-12;
}

/* Compares the fields of two nodes, with positions relative to each node's first point. If they are equal, adds the
 * origins and axes of both nodes' frames to the pairs of points. */
static bool turn_frame(turner *t, const turn_step *x) {
  const vs_kind_info *info = vs_kind_get((vs_kind)x->a->kind);
  vs_vec3 at[2] = { { 0, 0, 0 }, { 0, 0, 0 } };
  bool found = false, ok = x->a->kind != VS_HEIGHT_FIELD; /* does not compare height fields: the lowest height is a
                                                           * position along z, although the type of its field is a plain
                                                           * number */
  for (size_t i = 0; ok && i < info->field_count; i++) {
    const char *p = (const char *)vs_node_data(x->a) + info->fields[i].offset,
               *q = (const char *)vs_node_data(x->b) + info->fields[i].offset;
    switch (info->fields[i].type) {
      case VS_FIELD_real: ok = turn_near(*(const double *)(const void *)p, *(const double *)(const void *)q); break;
      case VS_FIELD_integer: ok = *(const int32_t *)(const void *)p == *(const int32_t *)(const void *)q; break;
      case VS_FIELD_boolean: ok = *(const bool *)p == *(const bool *)q; break;
      case VS_FIELD_text: ok = *(const char *const *)(const void *)p == *(const char *const *)(const void *)q; break;
      case VS_FIELD_vector:
        ok = turn_near_points(t, *(const vs_vec3 *)(const void *)p, *(const vs_vec3 *)(const void *)q);
        break;
      case VS_FIELD_point: {
        vs_vec3 a = *(const vs_vec3 *)(const void *)p, b = *(const vs_vec3 *)(const void *)q;
        if (!found) at[0] = a, at[1] = b;
        found = true;
        ok = turn_near_points(t, vs_v3_sub(a, at[0]), vs_v3_sub(b, at[1]));
        break;
      }
      case VS_FIELD_points: {
        const vs_points *a = *(const vs_points *const *)(const void *)p,
                        *b = *(const vs_points *const *)(const void *)q;
        ok = a->count == b->count;
        if (ok && !found && a->count) at[0] = a->at[0], at[1] = b->at[0], found = true;
        for (uint32_t k = 0; ok && k < a->count; k++)
          ok = turn_near_points(t, vs_v3_sub(a->at[k], at[0]), vs_v3_sub(b->at[k], at[1]));
        break;
      }
      case VS_FIELD_faces: {
        const vs_faces *a = *(const vs_faces *const *)(const void *)p, *b = *(const vs_faces *const *)(const void *)q;
        ok = a->count == b->count && a->corner_count == b->corner_count &&
             !memcmp(a->data, b->data, (a->count + 1 + (size_t)a->corner_count) * sizeof *a->data);
        break;
      }
      case VS_FIELD_affine: case VS_FIELD_material: case VS_FIELD_ticket: ok = false; break;
    }
  }
  double reach = ldexp(t->near, 32);
  for (int i = 0; ok && i < 4; i++) {
    vs_vec3 step = { i == 1 ? reach : 0, i == 2 ? reach : 0, i == 3 ? reach : 0 };
    ok = turn_point(t, x, vs_v3_add(at[0], step), vs_v3_add(at[1], step));
  }
  return ok;
}

#define TURN_BOTH(lower) const struct vs_##lower *a = VS_AS(lower, x->a), *b = VS_AS(lower, x->b)

/* Compares two primitives of one kind, and adds pairs of points that move with the primitives. Only extruded polygons
 * have children here. */
static bool turn_leaf(turner *t, const turn_step *x) {
  bool rigid = turn_is_rigid(&x->to_a) && turn_is_rigid(&x->to_b);
  if (x->a->kind == VS_SPHERE && rigid) {
    TURN_BOTH(sphere);
    if (a->segments || b->segments) return turn_frame(t, x);
    return turn_near(a->radius, b->radius) && turn_point(t, x, a->center, b->center);
  }
  if (x->a->kind == VS_CYLINDER && rigid) {
    TURN_BOTH(cylinder);
    if (a->segments || b->segments) return turn_frame(t, x);
    return turn_near(a->radius, b->radius) && turn_point(t, x, a->base, b->base) && turn_point(t, x, a->top, b->top);
  }
  if (x->a->kind == VS_CONE && rigid) {
    TURN_BOTH(cone);
    if (a->segments || b->segments) return turn_frame(t, x);
    return turn_near(a->radius, b->radius) && turn_point(t, x, a->base, b->base) && turn_point(t, x, a->apex, b->apex);
  }
  if (x->a->kind == VS_CUT_CONE && rigid) {
    TURN_BOTH(cut_cone);
    if (a->segments || b->segments) return turn_frame(t, x);
    return turn_near(a->base_radius, b->base_radius) && turn_near(a->top_radius, b->top_radius) &&
           turn_point(t, x, a->base, b->base) && turn_point(t, x, a->top, b->top);
  }
  if (x->a->kind == VS_LINE) {
    TURN_BOTH(line);
    return a->closed == b->closed && turn_points(t, x, a->points, b->points);
  }
  if (x->a->kind == VS_POLYFACE_MESH) {
    TURN_BOTH(polyface_mesh);
    return a->closed == b->closed && a->faces->count == b->faces->count &&
           a->faces->corner_count == b->faces->corner_count &&
           !memcmp(a->faces->data, b->faces->data,
                   (a->faces->count + 1 + (size_t)a->faces->corner_count) * sizeof *a->faces->data) &&
           turn_points(t, x, a->points, b->points);
  }
  if (x->a->kind == VS_EXTRUDE && x->a->child_count == 1 && x->b->child_count == 1) {
    TURN_BOTH(extrude);
    const vs_node *p = x->a->children[0].node, *q = x->b->children[0].node;
    if (a->taper != 0 || b->taper != 0 || a->twist != 0 || b->twist != 0 || a->scale != 1 || b->scale != 1 ||
        a->center != b->center)
      return false;
    while (p->kind == VS_REGION && q->kind == VS_REGION && p->child_count == 1 && q->child_count == 1)
      p = p->children[0].node, q = q->children[0].node;
    if (p->kind != VS_LINE || q->kind != VS_LINE || !VS_AS(line, p)->closed || !VS_AS(line, q)->closed) return false;
    const vs_points *a_points = VS_AS(line, p)->points, *b_points = VS_AS(line, q)->points;
    return turn_points(t, x, a_points, b_points) &&
           turn_point(t, x, vs_v3_add(a_points->at[0], a->along), vs_v3_add(b_points->at[0], b->along));
  }
  return x->a->child_count == 0 && turn_frame(t, x);
}

enum { TURN_WORK = 64 /* TURN_WORK: estimated work for a node, in the unit of vs_store_going (about a nanosecond) */ };

/* Replaces *at by the shape inside its placements and sets of a single member. Multiplies *to by the placements.
 * Returns false if interrupted. */
static bool turn_strip(turner *t, const vs_node **at, vs_affine *to) {
  const vs_node *n = *at;
  for (;; t->steps_taken++) {
    if (!vs_store_going(t->store, TURN_WORK, t->error)) return false;
    bool set = vs_node_is_set(n);
    if (n->kind == VS_TRANSFORM) *to = vs_affine_multiply(to, &VS_AS(transform, n)->matrix);
    else if (!set || n->child_count != 1 || n->children[0].node->class_ != n->class_) return *at = n, true;
    n = n->children[0].node;
  }
}

static bool turn_walk(turner *t) {
  while (t->step_count > 0) {
    turn_step x = t->steps[--t->step_count];
    t->steps_taken++;
    if (!turn_strip(t, &x.a, &x.to_a) || !turn_strip(t, &x.b, &x.to_b)) return false;
    if (x.a->kind != x.b->kind || x.a->child_count != x.b->child_count || x.a->class_ != x.b->class_) return false;
    bool down = vs_node_is_set(x.a);
    if (x.a->kind == VS_MATERIAL) down = VS_AS(material, x.a)->material == VS_AS(material, x.b)->material;
    if (x.a->kind == VS_LAYER) down = VS_AS(layer, x.a)->name == VS_AS(layer, x.b)->name;
    if (!down && (x.a->kind == VS_MATERIAL || x.a->kind == VS_LAYER || !turn_leaf(t, &x))) return false;
    for (uint32_t i = 0; down && i < x.a->child_count; i++)
      if (!turn_push(t, x.a->children[i].node, &x.to_a, x.b->children[i].node, &x.to_b)) return false;
    if (t->step_count > PAIRS_MOST) return false;
  }
  return true;
}

/* Returns the index of the pair whose first point is farthest from the line through o along the unit vector u.
 * *distance: this distance. */
static size_t turn_farthest(const turner *t, vs_vec3 o, vs_vec3 u, double *distance) {
  size_t best = 0;
  *distance = -1;
  for (size_t i = 0; i < t->pair_count; i++) {
    double d = vs_v3_length(vs_v3_cross(u, vs_v3_sub(t->pairs[i].a, o)));
    if (d > *distance * (1 + 1e-9)) *distance = d, best = i; /* Of several almost equal distances, chooses the first, so
                                                              * that the result does not depend on rounding errors. */
  }
  return best;
}

/* Finds the rigid map that maps the first point of every pair to the second point, within the tolerance. Returns false
 * if there is none. */
static bool turn_solve(const turner *t, vs_affine *turn) {
  const turn_pair *p = t->pairs;
  if (t->pair_count < 2) return false;
  size_t one = 0, two, four = 0;
  double most = 0, across, off = 0;
  for (size_t i = 1; i < t->pair_count; i++) {
    double d = vs_v3_length(vs_v3_sub(p[i].a, p[0].a));
    if (d > most * (1 + 1e-9)) most = d, one = i;
  }
  if (!(most > ldexp(t->near, 20))) return false;
  vs_vec3 frame[2][3]; /* two frames, each with axes x, y, z: frame[0] for the first points of the pairs, frame[1] for
                        * the second points */
  frame[0][0] = vs_v3_unit(vs_v3_sub(p[one].a, p[0].a));
  frame[1][0] = vs_v3_unit(vs_v3_sub(p[one].b, p[0].b));
  two = turn_farthest(t, p[0].a, frame[0][0], &across);
  if (across > ldexp(most, -20)) {
    frame[0][1] = vs_v3_sub(p[two].a, p[0].a);
    frame[1][1] = vs_v3_sub(p[two].b, p[0].b);
  } else { /* all points are on a line, so any rotation about this line is possible */
    for (int k = 0; k < 2; k++) frame[k][1] = fabs(frame[k][0].z) < 0.9 ? vs_v3(0, 0, 1) : vs_v3(1, 0, 0);
  }
  for (int k = 0; k < 2; k++) {
    vs_vec3 y = vs_v3_sub(frame[k][1], vs_v3_scale(frame[k][0], vs_v3_dot(frame[k][0], frame[k][1])));
    if (!(vs_v3_length(y) > 0)) return false;
    frame[k][1] = vs_v3_unit(y);
    frame[k][2] = vs_v3_cross(frame[k][0], frame[k][1]);
  }
  for (size_t i = 0; i < t->pair_count; i++) {
    double d = fabs(vs_v3_dot(frame[0][2], vs_v3_sub(p[i].a, p[0].a)));
    if (d > off * (1 + 1e-9)) off = d, four = i;
  }
  if (off > ldexp(most, -20) &&
      vs_v3_dot(frame[0][2], vs_v3_sub(p[four].a, p[0].a)) * vs_v3_dot(frame[1][2], vs_v3_sub(p[four].b, p[0].b)) < 0)
    frame[1][2] = vs_v3_scale(frame[1][2], -1); /* the map includes a mirroring, so one axis of the second frame is
                                                 * reversed */
  for (int i = 0; i < 3; i++) {
    const double *x = &frame[1][0].x + i, *y = &frame[1][1].x + i, *z = &frame[1][2].x + i;
    vs_vec3 row =
        vs_v3_add(vs_v3_add(vs_v3_scale(frame[0][0], *x), vs_v3_scale(frame[0][1], *y)), vs_v3_scale(frame[0][2], *z));
    double entries[3] = { row.x, row.y, row.z };
    /* Entries of the map that are nearly whole numbers are rounded, so that quarter turns are exact. */
    for (int j = 0; j < 3; j++)
      turn->m[i][j] = fabs(entries[j] - round(entries[j])) < 1e-12 ? round(entries[j]) + 0.0 : entries[j];
    turn->m[i][3] = 0;
  }
  vs_vec3 shift = vs_v3_sub(p[0].b, vs_affine_vector(turn, p[0].a));
  turn->m[0][3] = shift.x;
  turn->m[1][3] = shift.y;
  turn->m[2][3] = shift.z;
  for (size_t i = 0; i < t->pair_count; i++) {
    vs_vec3 d = vs_v3_sub(vs_affine_point(turn, p[i].a), p[i].b);
    if (!(fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z))) <= 4 * t->near)) return false;
  }
  return true;
}

bool vs_turn_find(vs_turn_pair pair, double near, vs_affine *turn, size_t *work, vs_error *e) {
  vs_store *s = pair.a->store;
  turner t = { .store = s, .near = near, .error = e };
  vs_affine here = vs_affine_identity();
  bool found = turn_push(&t, pair.a, &here, pair.b, &here) && turn_walk(&t) && turn_solve(&t, turn);
  enum { STEPS_FREE = 64 };
  *work += t.pair_count + 1 + (t.steps_taken > STEPS_FREE ? t.steps_taken - STEPS_FREE : 0);
  vs_store_realloc(s, t.steps, t.step_room * sizeof *t.steps, 0);
  vs_store_realloc(s, t.pairs, t.pair_room * sizeof *t.pairs, 0);
  return found;
}
