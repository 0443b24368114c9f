/* Implements the oracle, which computes volumes by cutting tetrahedra. The recursion is as deep as there are leaves and
 * planes. */
#include "tests/oracle/oracle.h"

#include <gmp.h>
#include <stdlib.h>

typedef struct { mpq_t x[3]; } point;
typedef struct { point v[4]; } tetrahedron;
typedef struct { const vs_kernel_problem *problem; mpq_t sum, t, u, d[4]; } oracle;

static bool true_for(const vs_kernel_problem *p, uint32_t mask) {
  bool *value = malloc(p->term_count * sizeof *value), result;
  if (!value) abort();
  for (uint32_t i = 0; i < p->term_count; i++) {
    const vs_kernel_term *t = &p->terms[i];
    bool any = false, all = t->count > 0, rest = false;
    for (uint32_t j = 0; j < t->count; j++) {
      bool v = value[p->operands[t->first + j]];
      any = any || v;
      all = all && v;
      rest = rest || (j > 0 && v);
    }
    value[i] = t->kind == VS_TERM_LEAF ? mask >> t->first & 1
             : t->kind == VS_TERM_UNION ? any
             : t->kind == VS_TERM_INTERSECTION ? all : t->count > 0 && value[p->operands[t->first]] && !rest;
  }
  result = value[p->term_count - 1];
  free(value);
  return result;
}

static void init(tetrahedron *t) {
  for (int i = 0; i < 4; i++)
    for (int a = 0; a < 3; a++) mpq_init(t->v[i].x[a]);
}
static void clear(tetrahedron *t) {
  for (int i = 0; i < 4; i++)
    for (int a = 0; a < 3; a++) mpq_clear(t->v[i].x[a]);
}
static void copy(tetrahedron *to, const tetrahedron *from) {
  for (int i = 0; i < 4; i++)
    for (int a = 0; a < 3; a++) mpq_set(to->v[i].x[a], from->v[i].x[a]);
}

static void add_volume(oracle *o, const tetrahedron *t) {
  mpq_t m[3][3], s;
  mpq_init(s);
  for (int i = 0; i < 3; i++)
    for (int a = 0; a < 3; a++) {
      mpq_init(m[i][a]);
      mpq_sub(m[i][a], t->v[i + 1].x[a], t->v[0].x[a]);
    }
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    mpq_mul(o->t, m[1][j], m[2][k]);
    mpq_mul(o->u, m[1][k], m[2][j]);
    mpq_sub(o->t, o->t, o->u);
    mpq_mul(o->t, o->t, m[0][i]);
    mpq_add(s, s, o->t);
  }
  mpq_abs(s, s);
  mpq_add(o->sum, o->sum, s);
  mpq_clear(s);
  for (int i = 0; i < 3; i++)
    for (int a = 0; a < 3; a++) mpq_clear(m[i][a]);
}

/* sets d to the distance of v from the face, positive outside */
static void outside(oracle *o, const vs_mesh *m, size_t face, const point *v, mpq_t d) {
  const uint32_t *c = m->triangles[face];
  vs_vec3 a = m->vertices[c[0]], n = vs_v3_cross(vs_v3_sub(m->vertices[c[1]], a), vs_v3_sub(m->vertices[c[2]], a));
  double nn[3] = { n.x, n.y, n.z }; /* the components are small integers, so the doubles are exact */
  mpq_set_d(d, -vs_v3_dot(n, a));
  for (int i = 0; i < 3; i++) {
    mpq_set_d(o->t, nn[i]);
    mpq_mul(o->t, o->t, v->x[i]);
    mpq_add(d, d, o->t);
  }
}

static void cut(oracle *o, const tetrahedron *t, uint32_t leaf, size_t face, uint32_t mask) {
  if (leaf == o->problem->leaf_count) {
    if (true_for(o->problem, mask)) add_volume(o, t);
    return;
  }
  const vs_mesh *m = o->problem->leaves[leaf].mesh;
  if (face == m->triangle_count) {
    cut(o, t, leaf + 1, 0, mask | 1u << leaf);
    return;
  }
  int low = -1, high = -1;
  for (int i = 0; i < 4; i++) {
    outside(o, m, face, &t->v[i], o->d[i]);
    int s = mpq_sgn(o->d[i]);
    if (s < 0) low = i;
    if (s > 0) high = i;
  }
  if (high < 0) {
    cut(o, t, leaf, face + 1, mask);
  } else if (low < 0) {
    cut(o, t, leaf + 1, 0, mask);
  } else { /* halves the edge low-high where the plane intersects it; each half of the tetrahedron has fewer edges that
            * intersect the plane */
    tetrahedron a, b;
    init(&a);
    init(&b);
    copy(&a, t);
    copy(&b, t);
    mpq_t part;
    mpq_init(part);
    mpq_sub(part, o->d[low], o->d[high]);
    mpq_div(part, o->d[low], part);
    for (int i = 0; i < 3; i++) {
      mpq_sub(o->t, t->v[high].x[i], t->v[low].x[i]);
      mpq_mul(o->t, o->t, part);
      mpq_add(o->t, o->t, t->v[low].x[i]);
      mpq_set(a.v[high].x[i], o->t);
      mpq_set(b.v[low].x[i], o->t);
    }
    mpq_clear(part);
    cut(o, &a, leaf, face, mask);
    cut(o, &b, leaf, face, mask);
    clear(&a);
    clear(&b);
  }
}

double oracle_volume(const vs_kernel_problem *problem, long size) {
  static const int paths[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 } };
  oracle o = { .problem = problem };
  mpq_inits(o.sum, o.t, o.u, o.d[0], o.d[1], o.d[2], o.d[3], NULL);
  for (int p = 0; p < 6; p++) { /* divides the cube into six tetrahedra: each order of the axes gives a way from corner
                                 * to opposite corner along three edges, which are edges of a tetrahedron */
    tetrahedron t;
    init(&t);
    for (int i = 0; i < 4; i++)
      for (int a = 0; a < 3; a++) {
        bool far = false;
        for (int j = 0; j < i; j++) far = far || paths[p][j] == a;
        mpq_set_si(t.v[i].x[a], far ? size : -size, 1);
      }
    cut(&o, &t, 0, 0, 0);
    clear(&t);
  }
  double six = mpq_get_d(o.sum);
  mpq_clears(o.sum, o.t, o.u, o.d[0], o.d[1], o.d[2], o.d[3], NULL);
  return six / 6;
}
