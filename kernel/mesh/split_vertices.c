/* Splits vertices where the result touches itself. Afterwards every edge, by vertex numbers, has two triangles, and the
 * triangles at every vertex form one fan.
 *
 * The triangles along an edge of four or more are paired. Each is joined to the triangle on the other side of the solid
 * wedge between them. Thus two cubes that touch along an edge remain two solids. The pairs may still be connected at
 * both ends of the edge, as for two cavities that touch. Then the triangles are joined across the empty wedges instead.
 * If the pairs remain connected, the edge gets a vertex in its middle for each pair. The planes of the triangles
 * determine their order around the edge exactly; see classify.c. */
#include "kernel/mesh/split_vertices.h"

#include "kernel/arrange/classify.h"
#include "kernel/cluster.h"
#include "kernel/threads.h"

#include <string.h>

/* For a range of edges: the positions, in the sorted list of directed edges, of the edges that do not have exactly two
 * triangles. The position is that of the first directed edge. */
typedef struct { VS_LIST(uint32_t) at; } crowded;

typedef struct {
  vs_kernel *k;
  vs_fresh_result of;          /* result to split; vertices on the rim of untouched triangles are not split, because
                                * nothing touches there */
  size_t vertices, triangles;
  _Atomic size_t open;         /* number of edges between the result's triangles and untouched triangles, which are
                                * copied later */
  vs_halves halves;            /* directed edges of the triangles; item 3 * triangle + j is the edge from corner j to
                                * the next corner */
  VS_LIST(crowded) crowded;
  VS_LIST(uint32_t) twins;
  VS_LIST(_Atomic uint32_t) lead; /* lead[v]: one of the triangle corners (3 * triangle + j) at vertex v */
  _Atomic size_t seen;         /* number of triangle corners in the fans that contain the corners in `lead`, one fan for
                                * each vertex; if it is the number of all corners, no vertex must be split */
  VS_LIST(uint32_t) to;        /* to[c]: vertex of triangle corner c after the split, counted from first_vertex */
  VS_LIST(uint32_t) copied;    /* copied[i]: vertex whose position the new vertex i copies */
  VS_LIST(uint8_t) taken;
  VS_LIST(vs_around) around;
  VS_LIST(vs_around) many;     /* the faces around each edge of more than two triangles, in cyclic order; the wedge
                                * between the last face and the first contains no material */
  VS_LIST(uint32_t) many_first;
  VS_LIST(uint8_t) way;        /* way[e]: how the triangles at edge e are paired if it has more than two: across solid
                                * wedges, across empty wedges, or with separate vertices in the edge's middle */
  VS_LIST(uint32_t) middle;    /* middle[c]: vertex in the middle of the edge that begins at triangle corner c, or
                                * VS_NONE */
} splitter;
typedef enum { SOLID, AIR, MIDDLE } joined;

/* Returns the vertex at a triangle corner, counted from first_vertex. `corner` is 3 * triangle + 0, 1 or 2. */
static uint32_t vertex_at(const splitter *s, uint32_t corner) {
  VS_ASSERT(corner < 3 * s->triangles);
  return s->of.m->triangles[s->of.first_triangle + corner / 3][corner % 3] - (uint32_t)s->of.first_vertex;
}

static bool starts_at(const splitter *s, uint32_t corner, uint32_t low) { return vertex_at(s, corner) == low; }

/* Pairs the triangles at an edge that has more than two. low: number of the edge's lower point; halves: the `count`
 * directed edges between its two points. */
static bool pair_many(splitter *s, uint32_t low, const vs_half *halves, size_t count) {
  vs_points_view view = vs_points_of(&s->of.c->points);
  int x, y, sign = vs_around_axes(view, s->of.points[low], s->of.points[halves[0].high], &x, &y);
  VS_ASSERT(count > 2);
  if (!VS_ROOM(s->k, s->around.at, s->around.room, count)) return false;
  for (size_t i = 0; i < count; i++) {
    uint32_t corner = halves[i].item, side = s->of.sides[corner / 3];
    const vs_plane *p = &s->of.c->planes.all.at[side / 2];
    bool along = starts_at(s, corner, low);
    int64_t turn = along == !(side & 1) ? 1 : -1;
    vs_around a = { turn * p->n[sign > 0 ? x : y], turn * p->n[sign > 0 ? y : x], corner, along };
    size_t j = i;
    for (; j > 0 && vs_around_before(&a, &s->around.at[j - 1]); j--) s->around.at[j] = s->around.at[j - 1];
    s->around.at[j] = a;
  }
  size_t begin = 0;
  while (begin < count && s->around.at[begin].cw) begin++;
  if (!VS_PUSH(s->k, s->many_first, (uint32_t)s->many.count) || !VS_PUSH(s->k, s->way, (uint8_t)SOLID)) return false;
  for (size_t i = 0; i < count; i++) { /* if a face runs against the edge's direction, the wedge counter-clockwise of it
                                        * is solid */
    const vs_around *a = &s->around.at[(begin + i) % count];
    if ((bool)a->cw != (i % 2 == 1)) return VS_BROKEN(s->k, "solid lies on solid along an edge");
    if (!VS_PUSH(s->k, s->many, *a)) return false;
  }
  return true;
}

/* Makes two triangles neighbours: the one whose corner a begins their common edge, and the one whose corner b does. */
static void join(splitter *s, uint32_t a, uint32_t b) {
  VS_ASSERT(a != b);
  s->twins.at[a] = b;
  s->twins.at[b] = a;
}

/* Sets *a and *b to the two faces of pair number n at the edge, which has more than n pairs. */
static void pair_of(const splitter *s, size_t edge, size_t n, uint32_t *a, uint32_t *b) {
  uint32_t begin = s->many_first.at[edge], count = s->many_first.at[edge + 1] - begin;
  size_t i = 2 * n + (s->way.at[edge] == AIR);
  VS_ASSERT(n < count / 2);
  *a = s->many.at[begin + i].ccw;
  *b = s->many.at[begin + (i + 1) % count].ccw;
}

static bool on_rim(const splitter *s, uint32_t vertex) { return s->of.rim && s->of.rim[s->of.points[vertex]]; }

static uint32_t next_of(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

static void ends_of_corners(const void *context, uint32_t begin, uint32_t count, uint32_t (*ends)[2]) {
  const splitter *s = context;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t t = (begin + i) / 3, j = (begin + i) % 3;
    const uint32_t *v = s->of.m->triangles[s->of.first_triangle + t];
    ends[i][0] = v[j] - (uint32_t)s->of.first_vertex;
    ends[i][1] = v[j == 2 ? 0 : j + 1] - (uint32_t)s->of.first_vertex;
  }
}

/* Prefetches memory that the pairing of edges will read soon. */
VS_AHEAD join_ahead(const splitter *s, uint32_t i, uint32_t stop) {
  enum { FAR = 16 };
  if (i + FAR >= stop) return;
  const vs_half *h = &s->halves.at.at[i + FAR];
  __builtin_prefetch(s->of.m->triangles[s->of.first_triangle + h->item / 3]);
  __builtin_prefetch(&s->twins.at[h->item], 1);
  __builtin_prefetch(&s->lead.at[h->high], 1);
}

static bool join_range(vs_kernel *k, void *context, size_t range) {
  splitter *s = context;
  const vs_halves *h = &s->halves;
  size_t open = 0;
  uint32_t low = vs_halves_begin(h, range), stop = h->first.at[vs_halves_begin(h, range + 1)];
  for (uint32_t i = h->first.at[low], end; i < stop; i = end) {
    while (i >= h->first.at[low + 1]) low++;
    const vs_half *at = h->at.at + i;
    for (end = i + 1; end < h->first.at[low + 1] && h->at.at[end].high == at->high;) end++;
    for (uint32_t j = i; j < end; j++) join_ahead(s, j, stop);
    bool first = starts_at(s, at[0].item, low);
    if (end - i == 2 && first != starts_at(s, at[1].item, low)) {
      join(s, at[0].item, at[1].item);
      atomic_store_explicit(&s->lead.at[low], at[!first].item, memory_order_relaxed); /* Several threads may write
                                                                                       * lead[low]. Each writes a corner
                                                                                       * of a triangle at this vertex,
                                                                                       * and any of them is right. */
      atomic_store_explicit(&s->lead.at[at->high], at[first].item, memory_order_relaxed);
    } else if (end - i == 1 && on_rim(s, low) && on_rim(s, at->high)) {
      s->twins.at[at[0].item] = VS_NONE;
      open++;
    } else if (!VS_PUSH(k, s->crowded.at[range].at, i)) return false;
  }
  if (open) atomic_fetch_add(&s->open, open);
  return vs_kernel_report(k, k->part);
}

static bool find_twins(splitter *s) {
  uint32_t corners = (uint32_t)(3 * s->triangles);
  vs_halves *h = &s->halves;
  if (!vs_halves_sort(s->k, h, (uint32_t)s->vertices, corners, ends_of_corners, s) ||
      !VS_ROOM(s->k, s->twins.at, s->twins.room, (size_t)corners + 1) ||
      !VS_ROOM(s->k, s->lead.at, s->lead.room, s->vertices + 1) ||
      !VS_ROOM(s->k, s->crowded.at, s->crowded.room, h->ranges))
    return false;
  memset(s->crowded.at, 0, h->ranges * sizeof *s->crowded.at);
  s->crowded.count = h->ranges;
  if (!vs_kernel_run(s->k, h->ranges, join_range, s)) return false;
  if (atomic_load(&s->open) != s->of.rim_edges) return VS_BROKEN(s->k, "the result is not closed");
  for (uint32_t r = 0; r < h->ranges; r++)
    for (size_t e = 0, low = vs_halves_begin(h, r); e < s->crowded.at[r].at.count; e++) {
      uint32_t i = s->crowded.at[r].at.at[e], end = i + 1;
      while (i >= h->first.at[low + 1]) low++;
      while (end < h->first.at[low + 1] && h->at.at[end].high == h->at.at[i].high) end++;
      if ((end - i) % 2) return VS_BROKEN(s->k, "the result is not closed");
      if (!pair_many(s, (uint32_t)low, h->at.at + i, end - i)) return false;
    }
  return VS_PUSH(s->k, s->many_first, (uint32_t)s->many.count);
}

enum { VERTICES = 1 << 14 };
/* Counts the triangle corners in one fan at each vertex. If these are all corners of the result, it does not touch
 * itself. */
static bool count_fans(vs_kernel *k, void *context, size_t chunk) {
  splitter *s = context;
  size_t begin = chunk * VERTICES, end = s->vertices - begin < VERTICES ? s->vertices : begin + VERTICES, n = 0;
  for (size_t v = begin; v < end; v++) {
    if (end - v > 12) __builtin_prefetch(&s->twins.at[atomic_load_explicit(&s->lead.at[v + 12], memory_order_relaxed)]);
    if (on_rim(s, (uint32_t)v)) continue;
    uint32_t lead = atomic_load_explicit(&s->lead.at[v], memory_order_relaxed), at = lead;
    do at = next_of(s->twins.at[at]), n++; while (at != lead);
  }
  atomic_fetch_add(&s->seen, n);
  return vs_kernel_report(k, k->part);
}

/* Returns true if step i needs no report of progress, or the report succeeds. Every 65536th step reports, because a
 * loop over a large mesh takes a second. Returns false if the caller interrupts. */
static bool turn(const splitter *s, uint32_t i) { return (i & 0xFFFF) != 0xFFFF || vs_kernel_report(s->k, s->k->part); }

/* Sets *touching to true if a vertex must be split because the result touches itself there, which is rare. */
static bool look_for_touching(splitter *s, bool *touching) {
  *touching = s->way.count > 0;
  if (*touching) return true;
  if (!vs_kernel_run(s->k, (s->vertices + VERTICES - 1) / VERTICES, count_fans, s)) return false;
  size_t seen = atomic_load(&s->seen);
  for (uint32_t i = 0; s->of.rim && i < 3 * s->triangles; i++) {
    seen += on_rim(s, vertex_at(s, i));
    if (!turn(s, i)) return false;
  }
  *touching = seen != 3 * s->triangles;
  return true;
}

/* Finds the fans at each vertex. The fan with the first corner keeps the vertex; each other fan gets a copy of it. */
static bool find_fans(splitter *s) {
  uint32_t corners = (uint32_t)(3 * s->triangles);
  if (!VS_ROOM(s->k, s->to.at, s->to.room, (size_t)corners + 1) ||
      !VS_ROOM(s->k, s->taken.at, s->taken.room, s->vertices + 1))
    return false;
  for (size_t i = 0; i < s->vertices; i++) s->taken.at[i] = 0;
  for (uint32_t i = 0; i < corners; i++) s->to.at[i] = VS_NONE;
  s->copied.count = 0;
  for (uint32_t corner = 0; corner < corners; corner++) {
    if (!turn(s, corner)) return false;
    if (s->to.at[corner] != VS_NONE) continue;
    uint32_t v = vertex_at(s, corner), to = v, at = corner;
    if (on_rim(s, v)) {
      s->to.at[corner] = v;
      continue;
    }
    if (s->taken.at[v]) {
      to = (uint32_t)(s->vertices + s->copied.count);
      if (!VS_PUSH(s->k, s->copied, v)) return false;
    }
    s->taken.at[v] = 1;
    do {
      s->to.at[at] = to;
      at = next_of(s->twins.at[at]); /* moves to the next triangle around vertex v, to its corner at v */
    } while (at != corner);
  }
  return true;
}

/* Returns true if two pairs of triangles at the edge are still connected at both of its ends. */
static bool still_held(const splitter *s, size_t edge) {
  size_t pairs = (s->many_first.at[edge + 1] - s->many_first.at[edge]) / 2;
  for (size_t i = 0; i < pairs; i++)
    for (size_t j = i + 1; j < pairs; j++) {
      uint32_t a, b, c, d;
      pair_of(s, edge, i, &a, &b);
      pair_of(s, edge, j, &c, &d);
      uint32_t a0 = s->to.at[a], a1 = s->to.at[next_of(a)], c0 = s->to.at[c], c1 = s->to.at[next_of(c)];
      if ((a0 == c0 && a1 == c1) || (a0 == c1 && a1 == c0)) return true;
    }
  return false;
}

static bool join_many(splitter *s) {
  for (bool again = true; again;) {
    again = false;
    for (size_t e = 0; e < s->way.count; e++)
      for (size_t i = 0; i < (s->many_first.at[e + 1] - s->many_first.at[e]) / 2; i++) {
        uint32_t a, b;
        pair_of(s, e, i, &a, &b);
        join(s, a, b);
      }
    if (!find_fans(s)) return false;
    for (size_t e = 0; e < s->way.count; e++)
      if (s->way.at[e] < MIDDLE && still_held(s, e)) s->way.at[e]++, again = true; /* the loop ends, because the
                                                                                    * pairing at an edge changes at
                                                                                    * most twice */
  }
  return true;
}

static bool no_room(splitter *s) {
  return vs_kernel_no_memory(s->k);
}

/* Cuts triangle t, if it has new vertices on its edges, into pieces. None of the pieces is flat. */
static bool cut_triangle(splitter *s, uint32_t t) {
  vs_mesh *m = s->of.m;
  size_t at = s->of.first_triangle + t;
  uint32_t v[3], mid[3], tag = m->tags[at], made[4][3], count = 0, n = 0, first = 0;
  for (uint32_t j = 0; j < 3; j++) n += s->middle.at[3 * t + j] != VS_NONE;
  if (n == 0) return true;
  while (s->middle.at[3 * t + first] == VS_NONE || (n == 2 && s->middle.at[3 * t + (first + 1) % 3] == VS_NONE))
    first++;
  for (uint32_t j = 0; j < 3; j++)
    v[j] = m->triangles[at][(first + j) % 3], mid[j] = s->middle.at[3 * t + (first + j) % 3];
#define PIECE(a, b, c) (made[count][0] = (a), made[count][1] = (b), made[count++][2] = (c))
  if (n == 1) PIECE(mid[0], v[1], v[2]), PIECE(mid[0], v[2], v[0]);
  if (n == 2) PIECE(mid[0], v[1], mid[1]), PIECE(mid[0], mid[1], v[2]), PIECE(mid[0], v[2], v[0]);
  if (n == 3)
    PIECE(mid[0], v[1], mid[1]), PIECE(mid[1], v[2], mid[2]), PIECE(mid[2], v[0], mid[0]),
        PIECE(mid[0], mid[1], mid[2]);
#undef PIECE
  for (int j = 0; j < 3; j++) m->triangles[at][j] = made[0][j];
  for (uint32_t i = 1; i < count; i++) {
    if (!vs_mesh_add_triangle(m, made[i][0], made[i][1], made[i][2])) return no_room(s);
    m->tags[m->triangle_count - 1] = tag;
  }
  return true;
}

static bool write(splitter *s) {
  uint32_t corners = (uint32_t)(3 * s->triangles);
  vs_mesh *m = s->of.m;
  for (size_t i = 0; i < s->copied.count; i++)
    if (!vs_mesh_add_vertex(m, m->vertices[s->of.first_vertex + s->copied.at[i]], NULL)) return no_room(s);
  for (uint32_t i = 0; i < corners; i++)
    m->triangles[s->of.first_triangle + i / 3][i % 3] = s->to.at[i] + (uint32_t)s->of.first_vertex;
  bool any = false;
  for (size_t e = 0; e < s->way.count; e++) any = any || s->way.at[e] == MIDDLE;
  if (!any) return true;
  if (!VS_ROOM(s->k, s->middle.at, s->middle.room, corners)) return false;
  for (uint32_t i = 0; i < corners; i++) s->middle.at[i] = VS_NONE;
  for (size_t e = 0; e < s->way.count; e++) {
    if (s->way.at[e] != MIDDLE) continue;
    uint32_t begin = s->many_first.at[e],
             low = s->of.m->triangles[s->of.first_triangle + s->many.at[begin].ccw / 3][s->many.at[begin].ccw % 3];
    uint32_t corner = next_of(s->many.at[begin].ccw),
             high = s->of.m->triangles[s->of.first_triangle + corner / 3][corner % 3];
    /* Each pair of triangles gets its own vertex in the edge's middle. These vertices have one position, so the result
     * remains closed by position. */
    vs_vec3 at = vs_v3_scale(vs_v3_add(m->vertices[low], m->vertices[high]), 0.5);
    for (size_t i = 0; i < (s->many_first.at[e + 1] - begin) / 2; i++) {
      uint32_t a, b, vertex;
      pair_of(s, e, i, &a, &b);
      if (!vs_mesh_add_vertex(m, at, &vertex)) return no_room(s);
      s->middle.at[a] = s->middle.at[b] = vertex;
    }
  }
  for (uint32_t t = 0; t < s->triangles; t++)
    if (!cut_triangle(s, t) || !turn(s, t)) return false;
  return true;
}

bool vs_split_touching(vs_kernel *k, const vs_fresh_result *of) {
  splitter s = { .k = k,
                 .of = *of,
                 .vertices = of->m->vertex_count - of->first_vertex,
                 .triangles = of->m->triangle_count - of->first_triangle };
  if (s.triangles >= UINT32_MAX / 3) return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have too many faces");
  bool touching, ok = find_twins(&s) && look_for_touching(&s, &touching) && (!touching || (join_many(&s) && write(&s)));
  vs_halves_free(k, &s.halves);
  for (size_t i = 0; i < s.crowded.count; i++) VS_DROP(k, s.crowded.at[i].at);
  VS_DROP(k, s.crowded);
  VS_DROP(k, s.lead);
  VS_DROP(k, s.twins);
  VS_DROP(k, s.to);
  VS_DROP(k, s.copied);
  VS_DROP(k, s.taken);
  VS_DROP(k, s.around);
  VS_DROP(k, s.many);
  VS_DROP(k, s.many_first);
  VS_DROP(k, s.way);
  VS_DROP(k, s.middle);
  return ok;
}
