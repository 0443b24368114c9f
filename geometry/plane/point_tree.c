/* Implements a tree of points for searches in triangles and boxes. */
#include "geometry/plane/point_tree.h"
#include "model/store/array.h"

#include <stdlib.h>
#include <string.h>

enum { POINT_TREE_LEAF = 8 };

static uint64_t tree_spread(uint32_t x) { /* inserts a zero bit after each bit of x, for a Morton code */
  uint64_t v = x;
  v = (v | v << 16) & UINT64_C(0x0000FFFF0000FFFF);
  v = (v | v << 8) & UINT64_C(0x00FF00FF00FF00FF);
  v = (v | v << 4) & UINT64_C(0x0F0F0F0F0F0F0F0F);
  v = (v | v << 2) & UINT64_C(0x3333333333333333);
  return (v | v << 1) & UINT64_C(0x5555555555555555);
}

typedef struct { uint64_t key; size_t item; } vs_point_key;

static int tree_compare(const void *a, const void *b) {
  const vs_point_key *p = a, *q = b;
  if (p->key != q->key) return p->key < q->key ? -1 : 1;
  return p->item < q->item ? -1 : p->item > q->item;
}

static bool tree_order(vs_point_tree *t) {
  vs_point_key *keys = vs_fresh(t->count, sizeof *keys);
  if (!keys) return false;
  vs_point_box all = { INFINITY, INFINITY, -INFINITY, -INFINITY, 0 };
  for (size_t i = 0; i < t->count; i++) {
    vs_vec2 p = t->at[t->point[i]];
    all = (vs_point_box){ fmin(all.min_x, p.x), fmin(all.min_y, p.y), fmax(all.max_x, p.x), fmax(all.max_y, p.y), 0 };
  }
  double size = fmax(all.max_x - all.min_x, all.max_y - all.min_y), k = size > 0 ? 4294967295.0 / size : 0;
  for (size_t i = 0; i < t->count; i++) {
    vs_vec2 p = t->at[t->point[i]];
    keys[i] = (vs_point_key){
      tree_spread((uint32_t)((p.x - all.min_x) * k)) | tree_spread((uint32_t)((p.y - all.min_y) * k)) << 1, i
    };
  }
  qsort(keys, t->count, sizeof *keys, tree_compare);
  for (size_t i = 0; i < t->count; i++) {
    t->order[i] = keys[i].item;
    t->rank[keys[i].item] = i;
  }
  free(keys);
  return true;
}

static void tree_box_add(vs_point_box *b, const vs_point_box *c) {
  *b = (vs_point_box){ fmin(b->min_x, c->min_x), fmin(b->min_y, c->min_y), fmax(b->max_x, c->max_x),
                       fmax(b->max_y, c->max_y), 0 };
}

bool vs_point_tree_make(vs_point_tree *t, const vs_vec2 *at, const size_t *point, size_t count) {
  *t = (vs_point_tree){ .at = at, .count = count, .leaves = 1, .point = point };
  while (t->leaves * POINT_TREE_LEAF < count) t->leaves *= 2;
  t->order = vs_fresh(count + 1, sizeof *t->order);
  t->rank = vs_fresh(count + 1, sizeof *t->rank);
  t->is_on = vs_zeros(count + 1, sizeof *t->is_on);
  t->boxes = vs_fresh(2 * t->leaves, sizeof *t->boxes);
  if (!t->order || !t->rank || !t->is_on || !t->boxes || (count && !tree_order(t))) {
    vs_point_tree_free(t);
    return false;
  }
  for (size_t i = 0; i < 2 * t->leaves; i++)
    t->boxes[i] = (vs_point_box){ INFINITY, INFINITY, -INFINITY, -INFINITY, 0 };
  for (size_t i = 0; i < count; i++) {
    vs_vec2 p = at[point[t->order[i]]];
    tree_box_add(&t->boxes[t->leaves + i / POINT_TREE_LEAF], &(vs_point_box){ p.x, p.y, p.x, p.y, 0 });
  }
  for (size_t i = 2 * t->leaves; i-- > 2;) tree_box_add(&t->boxes[i / 2], &t->boxes[i]);
  return true;
}

void vs_point_tree_free(vs_point_tree *t) {
  free(t->order);
  free(t->rank);
  free(t->is_on);
  free(t->boxes);
  *t = (vs_point_tree){ 0 };
}

void vs_point_tree_switch(vs_point_tree *t, size_t item, bool on) {
  size_t rank = t->rank[item];
  VS_ASSERT(item < t->count);
  if (t->is_on[rank] == on) return;
  t->is_on[rank] = on;
  for (size_t i = t->leaves + rank / POINT_TREE_LEAF; i > 0; i /= 2) t->boxes[i].on += on ? 1 : SIZE_MAX; /* changes the
                                                                                                           * count of
                                                                                                           * switched-on
                                                                                                           * points by
                                                                                                           * 1, in the
                                                                                                           * leaf that
                                                                                                           * contains
                                                                                                           * the point
                                                                                                           * and in all
                                                                                                           * nodes above
                                                                                                           * it */
}

/* Returns true if the whole box is clearly to the right of the line from p to q. `flat`: tolerance for twice the area
 * of a triangle of p, q and a point; the box gets twice as much, which exceeds rounding errors. */
static bool tree_beyond(const vs_point_box *b, vs_vec2 p, vs_vec2 q, double flat) {
  /* most: the corner of the box that is farthest to the left of the line */
  vs_vec2 most = { q.y > p.y ? b->min_x : b->max_x, q.x > p.x ? b->max_y : b->min_y };
  return vs_vec2_turn(p, q, most) < -2 * flat;
}

/* Returns a box that contains every point that counts as inside the triangle a, b, c. Such a point may lie slightly
 * outside: its triangles with two of the corners have areas of at least -flat. */
static vs_point_box tree_around(vs_vec2 a, vs_vec2 b, vs_vec2 c, double flat) {
  vs_point_box box = { fmin(a.x, fmin(b.x, c.x)), fmin(a.y, fmin(b.y, c.y)), fmax(a.x, fmax(b.x, c.x)),
                       fmax(a.y, fmax(b.y, c.y)), 0 };
  double area = vs_vec2_turn(a, b, c), share = area > 0 ? 3 * flat / area : INFINITY;
  if (!(share < 1)) return (vs_point_box){ -INFINITY, -INFINITY, INFINITY, INFINITY, 0 };
  double x = share * (box.max_x - box.min_x), y = share * (box.max_y - box.min_y);
  return (vs_point_box){ box.min_x - x, box.min_y - y, box.max_x + x, box.max_y + y, 0 };
}

static bool tree_apart(const vs_point_box *a, const vs_point_box *b) {
  return a->min_x > b->max_x || a->max_x < b->min_x || a->min_y > b->max_y || a->max_y < b->min_y;
}

static bool tree_same(vs_vec2 p, vs_vec2 q) { return p.x == q.x && p.y == q.y; }

/* A traversal of the tree: the stack of nodes that are still to be visited. */
typedef struct { size_t stack[2 * 64], depth; } tree_walk;

/* Pushes the two children of the node and returns true. If the node is a leaf, returns false and sets *first and *end
 * to its range of positions in `order`. */
static bool tree_down(const vs_point_tree *t, tree_walk *w, size_t node, size_t *first, size_t *end) {
  VS_ASSERT(node > 0 && node < 2 * t->leaves);
  if (node < t->leaves) {
    w->stack[w->depth++] = 2 * node + 1;
    w->stack[w->depth++] = 2 * node;
    return true;
  }
  *first = (node - t->leaves) * POINT_TREE_LEAF;
  *end = *first + POINT_TREE_LEAF < t->count ? *first + POINT_TREE_LEAF : t->count;
  return false;
}

size_t vs_point_tree_in(const vs_point_tree *t, vs_vec2 a, vs_vec2 b, vs_vec2 c, double flat) {
  vs_point_box all = tree_around(a, b, c, flat);
  tree_walk w;
  VS_ASSERT(flat >= 0);
  w.stack[0] = w.depth = 1;
  while (w.depth > 0) {
    size_t node = w.stack[--w.depth], first, end;
    const vs_point_box *box = &t->boxes[node];
    if (box->on == 0 || tree_apart(box, &all) || tree_beyond(box, a, b, flat) || tree_beyond(box, b, c, flat) ||
        tree_beyond(box, c, a, flat) || tree_down(t, &w, node, &first, &end))
      continue;
    for (size_t i = first; i < end; i++) {
      vs_vec2 p = t->at[t->point[t->order[i]]];
      if (!t->is_on[i] || tree_same(p, a) || tree_same(p, b) || tree_same(p, c)) continue;
      if (vs_vec2_turn(a, b, p) >= -flat && vs_vec2_turn(b, c, p) >= -flat && vs_vec2_turn(c, a, p) >= -flat)
        return t->order[i];
    }
  }
  return SIZE_MAX;
}

void vs_point_tree_each(const vs_point_tree *t, const vs_point_box *box, void (*found)(void *context, size_t item),
                        void *context) {
  tree_walk w;
  w.stack[0] = w.depth = 1;
  while (w.depth > 0) {
    size_t node = w.stack[--w.depth], first, end;
    const vs_point_box *b = &t->boxes[node];
    if (b->on == 0 || tree_apart(b, box) || tree_down(t, &w, node, &first, &end)) continue;
    for (size_t i = first; i < end; i++) {
      vs_vec2 p = t->at[t->point[t->order[i]]];
      if (t->is_on[i] && p.x >= box->min_x && p.x <= box->max_x && p.y >= box->min_y && p.y <= box->max_y)
        found(context, t->order[i]);
    }
  }
}
