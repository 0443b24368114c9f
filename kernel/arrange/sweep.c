/* Implements a plane sweep: the order of its vertices, the tree of the edges under the sweep line, and the events. */
#include "kernel/arrange/sweep.h"

static bool point_before(const void *context, uint32_t a, uint32_t b) {
  const vs_sweep *s = context;
  int sign = vs_compare(s->points, a, b, s->u);
  if (sign == 0) sign = vs_compare(s->points, a, b, s->v);
  return sign < 0;
}

/* Sorts points by coordinate u, and points with equal u by coordinate v. Compares fixed-point numbers where these
 * decide, and exact coordinates elsewhere. */
bool vs_sweep_order(vs_kernel *k, vs_sweep *s, uint32_t *points, size_t count, uint32_t *scratch) {
  const vs_point *all = s->points.at;
  s->vertices.count = 0;
  if (!VS_ROOM(k, s->vertices.at, s->vertices.room, count) || !VS_ROOM(k, s->keyed.at, s->keyed.room, 2 * count))
    return false;
  vs_keyed *at = s->keyed.at;
  for (size_t i = 0; i < count; i++) at[i] = (vs_keyed){ all[points[i]].fixed[s->u], points[i] };
  vs_sort_keyed(at, at + count, count);
  for (size_t i = 0; i < count; i++) points[i] = at[i].item;
  for (size_t i = 0, end; i < count; i = end) {
    bool exact = vs_point_exact(&all[points[i]]);
    for (end = i + 1; end < count && at[end].key == at[i].key; end++)
      exact = exact && vs_point_exact(&all[points[end]]);
    if (end == i + 1) continue;
    if (!exact) {
      vs_kernel_sort(points + i, scratch, end - i, point_before, s);
      continue;
    }
    for (size_t j = i; j < end; j++) at[j].key = all[points[j]].fixed[s->v];
    vs_sort_keyed(at + i, at + count, end - i);
    for (size_t j = i; j < end; j++) points[j] = at[j].item;
  }
  for (size_t i = 0; i < count; i++)
    if (i == 0 || points[i] != points[i - 1]) s->vertices.at[s->vertices.count++] = points[i];
  return true;
}

bool vs_sweep_begin(vs_kernel *k, vs_sweep *s) {
  uint32_t n = (uint32_t)s->vertices.count, m = (uint32_t)s->edges.count;
  if (!VS_ROOM(k, s->first.at, s->first.room, (size_t)n + 2) ||
      !VS_ROOM(k, s->rights.at, s->rights.room, (size_t)m + 1) ||
      !VS_ROOM(k, s->arrival.at, s->arrival.room, (size_t)n + 1) ||
      !VS_ROOM(k, s->nodes.at, s->nodes.room, (size_t)m + 1))
    return false;
  for (uint32_t i = 0; i < n + 2; i++) s->first.at[i] = 0;
  for (uint32_t i = 0; i < n; i++) s->arrival.at[i] = VS_NONE;
  for (uint32_t e = 0; e < m; e++) s->first.at[s->edges.at[e].l + 2]++;
  for (uint32_t i = 2; i < n + 2; i++) s->first.at[i] += s->first.at[i - 1];
  for (uint32_t e = 0; e < m; e++) {
    s->rights.at[s->first.at[s->edges.at[e].l + 1]++] = e;
    s->arrival.at[s->edges.at[e].r] = e;
  }
  for (uint32_t l = 0; l < n; l++) /* insertion sort, because a vertex has few edges */
    for (uint32_t i = s->first.at[l] + 1; i < s->first.at[l + 1]; i++) {
      uint32_t e = s->rights.at[i], to = i, r = s->edges.at[e].r;
      for (; to > s->first.at[l] && vs_sweep_turn(s, l, s->edges.at[s->rights.at[to - 1]].r, r) < 0; to--)
        s->rights.at[to] = s->rights.at[to - 1];
      s->rights.at[to] = e;
    }
  s->root = VS_NONE;
  s->at = 0;
  return true;
}

/* Returns the priority of edge e in the treap: a hash of its number. */
static uint32_t priority(uint32_t e) {
  uint64_t h = ((uint64_t)e + 1) * 0x9e3779b97f4a7c15u;
  return (uint32_t)(h >> 32);
}

static void replace_child(vs_sweep *s, uint32_t parent, uint32_t old, uint32_t now) {
  vs_sweep_node *n = s->nodes.at;
  if (parent == VS_NONE) s->root = now;
  else if (n[parent].left == old) n[parent].left = now;
  else n[parent].right = now;
  if (now != VS_NONE) n[now].parent = parent;
}

static void rotate_up(vs_sweep *s, uint32_t x) { /* rotates the tree so that node x moves above its parent */
  vs_sweep_node *n = s->nodes.at;
  uint32_t p = n[x].parent;
  replace_child(s, n[p].parent, p, x);
  if (n[p].left == x) {
    n[p].left = n[x].right;
    if (n[x].right != VS_NONE) n[n[x].right].parent = p;
    n[x].right = p;
  } else {
    n[p].right = n[x].left;
    if (n[x].left != VS_NONE) n[n[x].left].parent = p;
    n[x].left = p;
  }
  n[p].parent = x;
}

static void insert_between(vs_sweep *s, uint32_t e, uint32_t below, uint32_t above) {
  vs_sweep_node *n = s->nodes.at;
  n[e] = (vs_sweep_node){ VS_NONE, VS_NONE, VS_NONE, below, above };
  if (below != VS_NONE) n[below].next = e;
  if (above != VS_NONE) n[above].previous = e;
  if (below != VS_NONE && n[below].right == VS_NONE) n[below].right = e, n[e].parent = below;
  else if (above != VS_NONE) n[above].left = e, n[e].parent = above; /* The new edge belongs between two neighbours in
                                                                      * order. At least one of the neighbours has no
                                                                      * child on the side towards the new edge. */
  else s->root = e;
  while (n[e].parent != VS_NONE && priority(n[e].parent) < priority(e)) rotate_up(s, e);
}

static void take_out(vs_sweep *s, uint32_t e) {
  vs_sweep_node *n = s->nodes.at;
  while (n[e].left != VS_NONE && n[e].right != VS_NONE)
    rotate_up(s, priority(n[e].left) > priority(n[e].right) ? n[e].left : n[e].right);
  replace_child(s, n[e].parent, e, n[e].left != VS_NONE ? n[e].left : n[e].right);
  if (n[e].previous != VS_NONE) n[n[e].previous].next = n[e].next;
  if (n[e].next != VS_NONE) n[n[e].next].previous = n[e].previous;
}

bool vs_sweep_done(const vs_sweep *s) { return s->at == s->vertices.count; }

bool vs_sweep_next(vs_kernel *k, vs_sweep *s, vs_sweep_event *event) {
  if (vs_sweep_done(s) || !vs_kernel_poll(k, 0.5)) return false;
  const vs_sweep_node *n = s->nodes.at;
  uint32_t v = s->at++;
  event->vertex = v;
  event->rights = s->rights.at + s->first.at[v];
  event->right_count = s->first.at[v + 1] - s->first.at[v];
  s->lefts.count = 0;
  uint32_t e = s->arrival.at[v];
  if (e != VS_NONE) {
    while (n[e].previous != VS_NONE && s->edges.at[n[e].previous].r == v) e = n[e].previous;
    event->below = n[e].previous;
    for (; e != VS_NONE && s->edges.at[e].r == v; e = n[e].next)
      if (!VS_PUSH(k, s->lefts, e)) return false;
    event->above = e;
  } else {
    event->below = event->above = VS_NONE;
    for (e = s->root; e != VS_NONE;) {
      if (vs_sweep_turn(s, s->edges.at[e].l, s->edges.at[e].r, v) > 0) event->below = e, e = n[e].right;
      else event->above = e, e = n[e].left;
    }
  }
  event->lefts = s->lefts.at;
  event->left_count = (uint32_t)s->lefts.count;
  for (uint32_t i = 0; i < event->left_count; i++) take_out(s, event->lefts[i]);
  uint32_t below = event->below;
  for (uint32_t i = 0; i < event->right_count; i++) {
    insert_between(s, event->rights[i], below, event->above);
    below = event->rights[i];
  }
  return true;
}

void vs_sweep_free(vs_kernel *k, vs_sweep *s) {
  VS_DROP(k, s->vertices);
  VS_DROP(k, s->edges);
  VS_DROP(k, s->first);
  VS_DROP(k, s->rights);
  VS_DROP(k, s->arrival);
  VS_DROP(k, s->nodes);
  VS_DROP(k, s->lefts);
  VS_DROP(k, s->keyed);
}
