/* Owns the settling of a rounded mesh.
 *
 * The exact result may have corners that lie closer together than the format's numbers: where four planes nearly meet in one point there are two corners.
 * Rounded, such an edge is nothing or noise. It is collapsed onto its lower corner where the link condition holds (the corners' neighbours in common are the two
 * opposite the edge: the surface stays a manifold of the same kind) and no triangle around it turns over. */
#include "kernel/settle.h"

#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 3 };

typedef struct {
  vs_mesh *m;
  vs_numbers numbers;
  uint32_t *first, *around; /* triangles of a vertex */
  uint8_t *busy;            /* of a vertex: something near it has changed in this round */
  uint8_t *gone;            /* of a triangle */
} settling;

static double unit(double x, vs_numbers numbers) {
  int exponent;
  if (x == 0) return 0;
  if (numbers == VS_NUMBERS_DIGITS) return pow(10, floor(log10(fabs(x))) - 11);
  frexp(x, &exponent);
  return ldexp(1, exponent - (numbers == VS_NUMBERS_SINGLE ? 24 : 53));
}

static double rounded(double x, vs_numbers numbers) { return numbers == VS_NUMBERS_SINGLE ? (double)(float)x : x; }
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

static bool is_neighbour(const settling *s, uint32_t v, uint32_t other) {
  for (uint32_t i = s->first[v]; i < s->first[v + 1]; i++) {
    const uint32_t *t = s->m->triangles[s->around[i]];
    if (t[0] == other || t[1] == other || t[2] == other) return true;
  }
  return false;
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
    if (vs_v3_dot(before, after) < 0) return false;
  }
  /* around b, next corners: a, then p of each other triangle; the two apexes are neighbours of a, and one of them is counted above */
  bool tetrahedron = s->first[a + 1] - s->first[a] == 3 && s->first[b + 1] - s->first[b] == 3; /* would become two sheets on each other */
  return both == 2 && common == 1 && !tetrahedron;
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
}

static size_t collapse_round(settling *s) {
  vs_mesh *m = s->m;
  size_t done = 0;
  for (uint32_t t = 0; t < m->triangle_count; t++)
    for (int j = 0; j < 3 && !s->gone[t]; j++) {
      uint32_t a = m->triangles[t][j], b = m->triangles[t][(j + 1) % 3];
      if (a > b || s->busy[a] || s->busy[b] || !too_short(s, a, b)) continue;
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
      done++;
    }
  size_t kept = 0;
  for (size_t t = 0; done && t < m->triangle_count; t++) {
    if (s->gone[t]) continue;
    memmove(m->triangles[kept], m->triangles[t], sizeof *m->triangles);
    if (m->tags) m->tags[kept] = m->tags[t];
    kept++;
  }
  if (done) m->triangle_count = kept;
  return done;
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

bool vs_mesh_settle(vs_mesh *m, vs_numbers numbers, vs_settled *out) {
  settling s = { .m = m, .numbers = numbers };
  *out = (vs_settled){ 0 };
  bool any = false;
  for (size_t t = 0; t < m->triangle_count && !any; t++)
    for (int j = 0; j < 3 && !any; j++) {
      uint32_t a = m->triangles[t][j], b = m->triangles[t][j == 2 ? 0 : j + 1];
      any = a < b && too_short(&s, a, b); /* each edge runs upwards in one of its two triangles */
    }
  if (any) {
    s.first = malloc((m->vertex_count + 2) * sizeof *s.first);
    s.around = malloc((3 * m->triangle_count + 1) * sizeof *s.around);
    s.busy = malloc(m->vertex_count + 1);
    s.gone = malloc(m->triangle_count + 1);
    bool ok = s.first && s.around && s.busy && s.gone;
    for (int round = 0; ok && round < ROUNDS; round++) {
      index_vertices(&s);
      size_t done = collapse_round(&s);
      out->collapsed += done;
      if (!done) break;
    }
    if (ok && out->collapsed) drop_vertices(&s);
    free(s.first);
    free(s.around);
    free(s.busy);
    free(s.gone);
    if (!ok) return false;
  }
  for (size_t t = 0; numbers == VS_NUMBERS_SINGLE && t < m->triangle_count; t++) {
    const uint32_t *v = m->triangles[t];
    vs_vec3 a = corner(&s, v[0]), b = corner(&s, v[1]), c = corner(&s, v[2]);
    if (vs_v3_equal(a, b) || vs_v3_equal(b, c) || vs_v3_equal(c, a)) continue; /* left out by the writer, without a gap */
    vs_vec3 n = normal(a, b, c);
    if (vs_v3_dot(n, normal(m->vertices[v[0]], m->vertices[v[1]], m->vertices[v[2]])) > 0) continue;
    double longest = fmax(vs_v3_length(vs_v3_sub(b, a)), fmax(vs_v3_length(vs_v3_sub(c, b)), vs_v3_length(vs_v3_sub(a, c))));
    double most = fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z)); /* thinner than rounding moves corners: as flat as can be said */
    if (vs_v3_length(n) > 4 * unit(most, numbers) * longest && out->folded++ == 0) out->at = a;
  }
  return true;
}
