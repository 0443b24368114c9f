/* Owns the settling of a rounded mesh.
 *
 * The exact result may have corners that lie closer together than the format's numbers: where four planes nearly meet in one point there are two corners, and where a
 * corner all but lies on another's edge there is a triangle without height. Rounded, such an edge is nothing or noise, and such a triangle may turn over and cross its neighbours.
 *   collapse  an edge of less than two units goes onto its lower corner where the link condition holds (the corners' neighbours in common are the two opposite the
 *             edge: the surface stays a manifold of the same kind) and no triangle around it turns over
 *   flip      a triangle lower than two units gives its longest edge to its top: the neighbour behind that edge is cut in two there
 *   drop      a shell that is thinner than two units all over
 * Then what may still meet something that it does not meet before rounding is looked for beside all that was suspect. */
#include "kernel/settle.h"

#include <stdlib.h>
#include <string.h>

#include "kernel/apart.h"
#include "kernel/shells.h"
#include "model/disjoint.h"

enum { ROUNDS = 3, PASSES = 3 /* of flips, in a round */ };

typedef struct {
  vs_kernel *k;
  vs_mesh *m;
  vs_numbers numbers;
  double coarsest;          /* two units where the mesh reaches furthest */
  uint32_t *first, *around; /* triangles of a vertex */
  uint8_t *busy;            /* of a vertex: something near it has changed in this round */
  uint8_t *gone;            /* of a triangle */
  uint8_t *suspect;         /* of a vertex: 1: a triangle here was thin, or is bent by rounding; 2: near here something meets something */
} settling;

static double unit(double x, vs_numbers numbers) {
  int exponent;
  if (x == 0) return 0;
  if (numbers == VS_NUMBERS_DIGITS) return pow(10, floor(log10(fabs(x))) - 11);
  frexp(x, &exponent);
  return ldexp(1, exponent - (numbers == VS_NUMBERS_SINGLE ? 24 : 53));
}

static double rounded(double x, vs_numbers numbers) {
  double step;
  switch (numbers) {
  case VS_NUMBERS_SINGLE: case VS_NUMBERS_SOUP: return (double)(float)x;
  case VS_NUMBERS_DIGITS: return step = unit(x, numbers), step > 0 ? round(x / step) * step : 0; /* but for double's own last place */
  case VS_NUMBERS_DOUBLE: break;
  }
  return x;
}
static vs_vec3 corner(const settling *s, uint32_t v) {
  vs_vec3 p = s->m->vertices[v];
  return vs_v3(rounded(p.x, s->numbers), rounded(p.y, s->numbers), rounded(p.z, s->numbers));
}

static bool near(double a, double b, vs_numbers numbers) {
  double d = fabs(a - b), most = fabs(a) > fabs(b) ? fabs(a) : fabs(b);
  if (d > most * 1e-6) return false; /* nearly all are: no format's unit is that large */
  return d == 0 || d < 2 * unit(most, numbers);
}

static bool too_short(const settling *s, uint32_t a, uint32_t b) {
  vs_vec3 p = s->m->vertices[a], q = s->m->vertices[b];
  return near(p.x, q.x, s->numbers) && near(p.y, q.y, s->numbers) && near(p.z, q.z, s->numbers);
}

static vs_vec3 normal(vs_vec3 a, vs_vec3 b, vs_vec3 c) { return vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a)); }

static double larger(double a, double b) { return a > b ? a : b; }
static double reach(vs_vec3 p) { return larger(larger(fabs(p.x), fabs(p.y)), fabs(p.z)); }

/* Shorter than what rounding may move its ends by: fine where all that hangs on it is rounded alike, as on faces along the axes. */
static bool unsure(const settling *s, uint32_t a, uint32_t b) {
  vs_vec3 p = s->m->vertices[a], q = s->m->vertices[b];
  return vs_v3_length(vs_v3_sub(p, q)) < 2 * unit(fmax(reach(p), reach(q)), s->numbers);
}

/* Does rounding turn the triangle by more than two or three degrees, or make it nothing? */
static bool bent(const settling *s, uint32_t t) {
  const uint32_t *v = s->m->triangles[t];
  const vs_vec3 *x = s->m->vertices;
  vs_vec3 n = normal(x[v[0]], x[v[1]], x[v[2]]), r = normal(corner(s, v[0]), corner(s, v[1]), corner(s, v[2]));
  return !(vs_v3_dot(n, r) > 0.999 * vs_v3_length(n) * vs_v3_length(r));
}

static bool is_neighbour(const settling *s, uint32_t v, uint32_t other) {
  for (uint32_t i = s->first[v]; i < s->first[v + 1]; i++) {
    const uint32_t *t = s->m->triangles[s->around[i]];
    if (t[0] == other || t[1] == other || t[2] == other) return true;
  }
  return false;
}

static bool too_thin(const settling *s, uint32_t t) {
  const uint32_t *v = s->m->triangles[t];
  vs_vec3 a = s->m->vertices[v[0]], b = s->m->vertices[v[1]], c = s->m->vertices[v[2]], ab = vs_v3_sub(b, a), bc = vs_v3_sub(c, b), ca = vs_v3_sub(a, c), n = vs_v3_cross(ab, bc);
  double longest = larger(vs_v3_dot(ab, ab), larger(vs_v3_dot(bc, bc), vs_v3_dot(ca, ca))), square = vs_v3_dot(n, n);
  if (square >= s->coarsest * s->coarsest * longest) return false; /* nearly all are */
  double least = 2 * unit(larger(larger(reach(a), reach(b)), reach(c)), s->numbers);
  return square < least * least * longest;
}

/* May b become a? Every triangle around b that stays must keep its side, as far as it had one. */
static bool allowed(const settling *s, uint32_t a, uint32_t b) {
  uint32_t common = 0, both = 0;
  vs_vec3 to = s->m->vertices[a];
  for (uint32_t i = s->first[b]; i < s->first[b + 1]; i++) {
    const uint32_t *t = s->m->triangles[s->around[i]];
    uint32_t j = t[0] == b ? 0 : t[1] == b ? 1 : 2, p = t[(j + 1) % 3], q = t[(j + 2) % 3];
    if (p == a || q == a) {
      both++;
      continue;
    }
    if (is_neighbour(s, a, p)) common++; /* p stands once as the next of b: each neighbour is counted once, but for the two of the edge's triangles */
    vs_vec3 before = normal(s->m->vertices[b], s->m->vertices[p], s->m->vertices[q]), after = normal(to, s->m->vertices[p], s->m->vertices[q]);
    if (vs_v3_dot(before, after) < 0 && !(too_thin(s, s->around[i]) && bent(s, s->around[i]))) return false; /* noise may turn */
  }
  /* around b, next corners: a, then p of each other triangle; the two apexes are neighbours of a, and one of them is counted above */
  bool tetrahedron = s->first[a + 1] - s->first[a] == 3 && s->first[b + 1] - s->first[b] == 3; /* would become two sheets on each other */
  return both == 2 && common == 1 && !tetrahedron;
}

/* ---- thin triangles ---- */

static double height(vs_vec3 a, vs_vec3 b, vs_vec3 c) { /* the least of three */
  double longest = fmax(vs_v3_length(vs_v3_sub(b, a)), fmax(vs_v3_length(vs_v3_sub(c, b)), vs_v3_length(vs_v3_sub(a, c))));
  return longest > 0 ? vs_v3_length(normal(a, b, c)) / longest : 0;
}

static bool same_side(vs_vec3 n, vs_vec3 a, vs_vec3 b, vs_vec3 c) { return vs_v3_dot(n, normal(a, b, c)) > 0; }

/* A triangle lower than rounding moves its corners may turn over. Its longest edge is given to its top instead: the neighbour behind that edge is cut in two there,
 * and what was thin is gone. Neither may become as thin, or turn over, before or after rounding. */
static bool flip(settling *s, uint32_t t) {
  vs_mesh *m = s->m;
  const uint32_t *v = m->triangles[t];
  double length[3];
  for (int j = 0; j < 3; j++) length[j] = vs_v3_length(vs_v3_sub(m->vertices[v[(j + 1) % 3]], m->vertices[v[j]]));
  int base = length[0] >= length[1] && length[0] >= length[2] ? 0 : length[1] >= length[2] ? 1 : 2;
  uint32_t p = v[base], q = v[(base + 1) % 3], top = v[(base + 2) % 3], other = UINT32_MAX, far = 0;
  for (uint32_t i = s->first[p]; i < s->first[p + 1]; i++) {
    const uint32_t *w = m->triangles[s->around[i]];
    for (int j = 0; j < 3; j++)
      if (w[j] == q && w[(j + 1) % 3] == p) other = s->around[i], far = w[(j + 2) % 3];
  }
  if (other == UINT32_MAX || far == top || s->busy[p] || s->busy[q] || s->busy[top] || s->busy[far] || is_neighbour(s, top, far)) return false;
  const vs_vec3 *x = m->vertices;
  vs_vec3 before = normal(x[q], x[p], x[far]), rp = corner(s, p), rq = corner(s, q), rt = corner(s, top), rf = corner(s, far);
  if (!same_side(before, x[p], x[far], x[top]) || !same_side(before, x[far], x[q], x[top])) return false;
  if (!same_side(before, rp, rf, rt) || !same_side(before, rf, rq, rt)) return false;
  double old = fmin(height(x[p], x[q], x[top]), height(x[q], x[p], x[far])), now = fmin(height(x[p], x[far], x[top]), height(x[far], x[q], x[top]));
  if (now <= old) return false;
  uint32_t one[3] = { p, far, top }, two[3] = { far, q, top };
  memcpy(m->triangles[t], one, sizeof one);
  memcpy(m->triangles[other], two, sizeof two);
  if (m->tags) m->tags[t] = m->tags[other];
  s->busy[p] = s->busy[q] = s->busy[top] = s->busy[far] = 1;
  s->suspect[top] |= 1;
  return true;
}

/* Does the caller go on? Cheap enough for every triangle. */
static bool asked(settling *s) { return s->k->error->status == VS_KERNEL_FINE && vs_kernel_poll(s->k, 1); }

/* Rounds stop where the caller does not go on: the error says so. */
static size_t flip_round(settling *s) {
  size_t done = 0;
  for (uint32_t t = 0; t < s->m->triangle_count && asked(s); t++)
    if (too_thin(s, t) && bent(s, t)) done += flip(s, t);
  return done;
}

static void index_vertices(settling *s) {
  vs_mesh *m = s->m;
  size_t n = (size_t)(uint32_t)m->vertex_count + 2;
  for (size_t i = 0; i < n; i++) s->first[i] = 0;
  for (size_t i = 0; i < 3 * m->triangle_count; i++) s->first[m->triangles[i / 3][i % 3] + 2]++;
  for (size_t i = 2; i < n; i++) s->first[i] += s->first[i - 1];
  for (size_t i = 0; i < 3 * m->triangle_count; i++) s->around[s->first[m->triangles[i / 3][i % 3] + 1]++] = (uint32_t)(i / 3);
  memset(s->busy, 0, m->vertex_count);
  memset(s->gone, 0, m->triangle_count);
  vs_kernel_report(s->k, 1);
}

static size_t collapse_round(settling *s) {
  vs_mesh *m = s->m;
  size_t done = 0;
  for (uint32_t t = 0; t < m->triangle_count && asked(s); t++)
    for (int j = 0; j < 3 && !s->gone[t]; j++) {
      uint32_t a = m->triangles[t][j], b = m->triangles[t][(j + 1) % 3], c;
      if (s->busy[a] || s->busy[b] || !(too_short(s, a, b) || (unsure(s, a, b) && bent(s, t)))) continue;
      if (a > b) c = a, a = b, b = c;
      if (!allowed(s, a, b)) continue;
      for (int end = 0; end < 2; end++)
        for (uint32_t i = s->first[end ? b : a]; i < s->first[(end ? b : a) + 1]; i++)
          for (int k = 0; k < 3; k++) s->busy[m->triangles[s->around[i]][k]] = 1;
      for (uint32_t i = s->first[b]; i < s->first[b + 1]; i++) {
        uint32_t *v = m->triangles[s->around[i]];
        for (int k = 0; k < 3; k++)
          if (v[k] == b) v[k] = a;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) s->gone[s->around[i]] = 1;
      }
      s->suspect[a] |= 1;
      done++;
    }
  if (done) vs_mesh_squeeze(m, s->gone);
  return done;
}

/* ---- blades ---- */

static bool is_blade(const settling *s, const vs_shell *of) { return fabs(of->volume) < of->area * unit(of->reach, s->numbers); }

/* Shells that are thinner than two units all over, and that rounding bends, would be sheets on sheets: they go, unless nothing else is there. (A thin plate far from the
 * origin, along the axes, stays as it is.) False: out of memory. */
static bool drop_blades(settling *s, vs_settled *out) {
  vs_mesh *m = s->m;
  vs_shells shells;
  bool ok = vs_shells_find(m, &shells) && vs_kernel_report(s->k, 1);
  uint8_t *goes = ok ? calloc((size_t)shells.count + 1, 1) : NULL;
  uint32_t going = 0;
  ok = goes != NULL;
  for (uint32_t t = 0; ok && t < m->triangle_count; t++) {
    uint32_t shell = shells.of[m->triangles[t][0]];
    if (!goes[shell] && is_blade(s, &shells.at[shell]) && bent(s, t)) goes[shell] = 1;
    ok = asked(s);
  }
  for (uint32_t i = 0; ok && i < shells.count; i++) {
    if (!goes[i]) continue;
    if (going++ == 0) out->dropped_at = shells.at[i].from;
  }
  if (ok && going && going < shells.count) {
    for (size_t t = 0; t < m->triangle_count; t++) s->gone[t] = goes[shells.of[m->triangles[t][0]]];
    vs_mesh_squeeze(m, s->gone);
    out->dropped = going;
  }
  vs_shells_free(&shells);
  free(goes);
  return ok;
}

/* ---- where nothing else helps: corners become one place ---- */

typedef struct { uint32_t corner[3], triangle; bool odd; } sheet; /* corners in order; odd: that turned it over */

static int sheet_order(const void *a, const void *b) {
  const sheet *x = a, *y = b;
  for (int i = 0; i < 3; i++)
    if (x->corner[i] != y->corner[i]) return x->corner[i] < y->corner[i] ? -1 : 1;
  if (x->odd != y->odd) return x->odd ? 1 : -1;
  return x->triangle < y->triangle ? -1 : 1;
}

static sheet sheet_of(const uint32_t v[3], uint32_t t) {
  sheet s = { { v[0], v[1], v[2] }, t, false };
  for (int i = 0; i < 3; i++) { /* 0 1, 1 2, 0 1 */
    int j = i % 2;
    if (s.corner[j] < s.corner[j + 1]) continue;
    uint32_t swap = s.corner[j];
    s.corner[j] = s.corner[j + 1], s.corner[j + 1] = swap;
    s.odd = !s.odd;
  }
  return s;
}

static bool is_met(const settling *s, uint32_t t) { /* near one that meets another, as count_met found */
  const uint32_t *v = s->m->triangles[t];
  return (s->suspect[v[0]] | s->suspect[v[1]] | s->suspect[v[2]]) & 2;
}

/* Corners within a few units of each other, joined by edges of triangles that rounding bends (or all) near where something meets, become one; what then is an
 * edge, or two sheets on each other, goes. A map of corners keeps a closed chain closed, but it need not be a manifold by index any more: for formats without
 * indices. False: out of memory. */
static bool contract(settling *s, double near_units, bool all, size_t *count) {
  vs_mesh *m = s->m;
  size_t sheets_count = 0;
  uint32_t *parent = malloc((m->vertex_count + 1) * sizeof *parent);
  vs_bounds *boxes = malloc((m->vertex_count + 1) * sizeof *boxes);
  sheet *sheets = malloc((m->triangle_count + 1) * sizeof *sheets);
  bool ok = parent && boxes && sheets;
  *count = 0;
  for (uint32_t v = 0; ok && v < m->vertex_count; v++) parent[v] = v, boxes[v] = (vs_bounds){ m->vertices[v], m->vertices[v] };
  for (uint32_t t = 0; ok && t < m->triangle_count; t++)
    for (int j = 0; is_met(s, t) && (bent(s, t) || all) && j < 3; j++) {
      uint32_t a = vs_find(parent, m->triangles[t][j]), b = vs_find(parent, m->triangles[t][(j + 1) % 3]), low = a < b ? a : b, high = a < b ? b : a;
      vs_vec3 p = m->vertices[m->triangles[t][j]], q = m->vertices[m->triangles[t][(j + 1) % 3]];
      double step = unit(fmax(reach(p), reach(q)), s->numbers);
      vs_bounds both = boxes[a];
      vs_bounds_unite(&both, &boxes[b]);
      if (a == b || vs_v3_length(vs_v3_sub(p, q)) >= near_units * step || vs_bounds_diagonal(&both) >= 3 * near_units * step) continue;
      parent[high] = low;
      boxes[low] = both;
      ++*count;
    }
  for (uint32_t t = 0; ok && *count && t < m->triangle_count; t++) {
    uint32_t *v = m->triangles[t];
    bool moved = false;
    for (int j = 0; j < 3; j++) {
      uint32_t to = vs_find(parent, v[j]);
      moved = moved || to != v[j];
      v[j] = to;
    }
    s->gone[t] = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
    for (int j = 0; j < 3; j++) moved = moved || !vs_v3_equal(boxes[v[j]].min, boxes[v[j]].max);
    if (moved && !s->gone[t]) sheets[sheets_count++] = sheet_of(v, t);
  }
  if (sheets_count) qsort(sheets, sheets_count, sizeof *sheets, sheet_order);
  for (size_t i = 0, end; i < sheets_count; i = end) { /* of one place: as many of either side go */
    size_t even = i, odd;
    for (end = i; end < sheets_count && memcmp(sheets[end].corner, sheets[i].corner, sizeof sheets[i].corner) == 0; end++) even += !sheets[end].odd;
    odd = even;
    for (size_t j = i; j < even && odd < end; j++, odd++) s->gone[sheets[j].triangle] = s->gone[sheets[odd].triangle] = 1;
  }
  if (ok && *count) vs_mesh_squeeze(m, s->gone);
  free(parent);
  free(boxes);
  free(sheets);
  return ok;
}

/* ---- what remains ---- */

/* Triangles around a corner, and around those next to it: each once, in order. */
static size_t gather(const settling *s, uint32_t v, uint32_t *list, size_t room) {
  size_t n = 0;
  for (uint32_t i = s->first[v]; i < s->first[v + 1]; i++)
    for (int j = 0; j < 3; j++) {
      uint32_t w = s->m->triangles[s->around[i]][j];
      for (uint32_t k = s->first[w]; k < s->first[w + 1] && n < room; k++) {
        uint32_t t = s->around[k];
        size_t at = n;
        while (at > 0 && list[at - 1] > t) at--;
        if (at > 0 && list[at - 1] == t) continue;
        memmove(list + at + 1, list + at, (n++ - at) * sizeof *list);
        list[at] = t;
      }
    }
  return n;
}

/* Counts triangles that rounding makes meet others near a suspect corner: of each, once. */
static void count_met(settling *s, vs_settled *out) {
  enum { ROOM = 96 };
  const vs_mesh *m = s->m;
  uint32_t list[ROOM];
  memset(s->gone, 0, m->triangle_count);
  for (uint32_t t = 0; t < m->triangle_count; t++)
    if (too_thin(s, t) && bent(s, t))
      for (int j = 0; j < 3; j++) s->suspect[m->triangles[t][j]] |= 1;
  for (uint32_t v = 0; v < m->vertex_count && asked(s); v++) {
    if (!(s->suspect[v] & 1)) continue;
    size_t n = gather(s, v, list, ROOM);
    for (uint32_t i = s->first[v]; i < s->first[v + 1]; i++)
      for (size_t j = 0; j < n; j++) {
        uint32_t t = s->around[i], u = list[j];
        vs_vec3 a[3], b[3];
        int shared;
        if (t == u || s->gone[t]) continue;
        for (int k = 0; k < 3; k++) a[k] = corner(s, m->triangles[t][k]), b[k] = corner(s, m->triangles[u][k]);
        if (vs_v3_equal(a[0], a[1]) || vs_v3_equal(a[1], a[2]) || vs_v3_equal(a[2], a[0]) || vs_v3_equal(b[0], b[1]) || vs_v3_equal(b[1], b[2]) || vs_v3_equal(b[2], b[0])) continue;
        if (vs_triangles_apart(a, b, &shared)) continue;
        s->gone[t] = 1;
        for (size_t k = 0; k < n; k++)
          for (int l = 0; l < 3; l++) s->suspect[m->triangles[list[k]][l]] |= 2;
        if (out->met++ == 0) out->at = a[0];
      }
  }
}

static void drop_vertices(settling *s) {
  vs_mesh *m = s->m;
  uint32_t *number = s->first, count = 0;
  memset(number, 0, m->vertex_count * sizeof *number);
  for (size_t i = 0; i < 3 * m->triangle_count; i++) number[m->triangles[i / 3][i % 3]] = 1;
  for (uint32_t v = 0; v < m->vertex_count; v++)
    if (number[v]) {
      m->vertices[count] = m->vertices[v];
      number[v] = count++;
    }
  m->vertex_count = count;
  for (size_t i = 0; i < 3 * m->triangle_count; i++) m->triangles[i / 3][i % 3] = number[m->triangles[i / 3][i % 3]];
}

bool vs_mesh_settle(vs_mesh *m, vs_numbers numbers, const vs_kernel_options *options, vs_settled *out, vs_kernel_error *error) {
  bool places = numbers == VS_NUMBERS_SOUP;
  if (places) numbers = VS_NUMBERS_SINGLE;
  vs_kernel_error ignored;
  vs_kernel k = { .options = options, .error = error ? error : &ignored, .threads = 1, .done = 1 };
  settling s = { .k = &k, .m = m, .numbers = numbers };
  *k.error = (vs_kernel_error){ VS_KERNEL_FINE, 0, "" };
  *out = (vs_settled){ 0 };
  bool any = false, ok = true;
  vs_bounds b = vs_mesh_bounds(m);
  s.coarsest = 2 * unit(larger(reach(b.min), reach(b.max)), numbers);
  for (uint32_t t = 0; t < m->triangle_count && !any && asked(&s); t++) any = too_thin(&s, t) && bent(&s, t);
  if (!any) return k.error->status == VS_KERNEL_FINE;
  s.first = malloc((m->vertex_count + 2) * sizeof *s.first);
  s.around = malloc((3 * m->triangle_count + 1) * sizeof *s.around);
  s.busy = malloc(m->vertex_count + 1);
  s.suspect = calloc(m->vertex_count + 1, 1);
  s.gone = malloc(m->triangle_count + 1);
  ok = s.first && s.around && s.busy && s.suspect && s.gone && drop_blades(&s, out);
  for (int round = 0; ok && asked(&s) && round < ROUNDS; round++) {
    index_vertices(&s);
    size_t collapsed = collapse_round(&s), flipped = 0;
    for (int pass = 0; pass < PASSES; pass++) {
      index_vertices(&s);
      size_t more = flip_round(&s);
      flipped += more;
      if (!more) break;
    }
    out->collapsed += collapsed;
    out->flipped += flipped;
    if (!collapsed && !flipped) break;
  }
  if (ok && numbers != VS_NUMBERS_DOUBLE) index_vertices(&s), count_met(&s, out);
  for (int round = 0; ok && asked(&s) && places && out->met && round < ROUNDS; round++) {
    size_t contracted = 0;
    index_vertices(&s);
    ok = contract(&s, 4 << round, round == ROUNDS - 1, &contracted);
    if (!ok || !contracted) break;
    out->collapsed += contracted;
    index_vertices(&s);
    out->flipped += flip_round(&s);
    index_vertices(&s);
    out->met = 0;
    count_met(&s, out);
  }
  if (ok && (out->collapsed || out->dropped)) drop_vertices(&s);
  free(s.first);
  free(s.around);
  free(s.busy);
  free(s.suspect);
  free(s.gone);
  if (!ok) vs_kernel_fail(&k, VS_KERNEL_OUT_OF_MEMORY, 0, "out of memory while combining solids"); /* unless it was interrupted */
  return k.error->status == VS_KERNEL_FINE;
}
