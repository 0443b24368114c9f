/* Implements the modes of structures (structure_modes.h). Members that bend are cut into segments, because a single
 * cubic curve between two nodes is too stiff for modes. */
#include "geometry/structure/structure_modes.h"

#include <math.h>
#include <string.h>

#include "geometry/structure/eigenpairs.h"
#include "geometry/structure/structure_system.h"
#include "model/store/array.h"

#define NO_VALUE 1e-18 /* Eigenvalues below this are rounding errors: they would belong to load factors above 1e18, or
                        * to frequencies of gigahertz. */

/* The structure after its members were cut into segments, which are its members now. */
typedef struct {
  const vs_modes_problem *p;
  vs_structure s;
  vs_vec3 *at;
  vs_structure_member *members;
  bool *held, *loose;
  double *loads, *force, *mass; /* force: axial force in each segment, in N; mass: mass of each segment, in kg; loads:
                                 * no loads, all 0 */
  vs_structure_spin *spins;
  size_t spin_count;
} cut;

static void free_cut(cut *c) {
  free(c->at), free(c->members), free(c->held), free(c->loose), free(c->loads), free(c->force), free(c->mass);
  free(c->spins);
}

static size_t parts_of(const cut *c, const vs_structure_member *m) { return m->bend_y > 0 ? c->p->parts : 1; }

/* Cuts member i: appends its inner nodes and its segments. If both ends of the member are hinged, the segments beside
 * them carry no torsion; an entry of c->spins then keeps the inner segments from turning freely about the axis. */
static void cut_member(cut *c, size_t i) {
  const vs_structure_member *m = &c->p->s->members[i];
  size_t parts = parts_of(c, m);
  vs_vec3 from = vs_v3_add(c->at[m->from], m->offset[0]);
  vs_vec3 along = vs_v3_sub(vs_v3_add(c->at[m->to], m->offset[1]), from);
  bool ball = m->hinged[0] && m->hinged[1];
  for (size_t k = 0; k < parts; k++) {
    vs_structure_member piece = *m;
    double t = ((double)k + 0.5) / (double)parts;
    if (k > 0) piece.from = (uint32_t)c->s.count - 1, piece.offset[0] = vs_v3(0, 0, 0);
    if (k + 1 < parts) {
      piece.to = (uint32_t)c->s.count;
      piece.offset[1] = vs_v3(0, 0, 0);
      c->at[c->s.count++] = vs_v3_add(from, vs_v3_scale(along, ((double)k + 1) / (double)parts));
    }
    piece.hinged[0] = m->hinged[0] && k == 0;
    piece.hinged[1] = m->hinged[1] && k + 1 == parts;
    if (ball && (k == 0 || k + 1 == parts)) piece.twist = 0;
    if (c->p->axial) c->force[c->s.member_count] = c->p->axial[2 * i] * (1 - t) + c->p->axial[2 * i + 1] * t;
    else c->mass[c->s.member_count] = c->p->mass[i] / (double)parts;
    c->members[c->s.member_count++] = piece;
  }
  if (ball && parts > 1)
    c->spins[c->spin_count++] = (vs_structure_spin){ c->s.count - 1, vs_v3_scale(along, 1 / vs_v3_length(along)),
                                                     m->shear * m->twist / vs_v3_length(along) };
}

static bool make_cut(cut *c, vs_error *e) {
  const vs_structure *s = c->p->s;
  size_t nodes = s->count + s->member_count * (c->p->parts - 1), segments = s->member_count * c->p->parts;
  c->held = vs_zeros(nodes * VS_WAYS, sizeof *c->held);
  c->loads = vs_zeros(nodes * VS_WAYS, sizeof *c->loads);
  if (!c->held || !c->loads || !VS_FRESH(c->at, nodes) || !VS_FRESH(c->loose, nodes) ||
      !VS_FRESH(c->members, segments) || !VS_FRESH(c->force, segments) || !VS_FRESH(c->mass, segments) ||
      !VS_FRESH(c->spins, s->member_count))
    return vs_error_memory(e, NULL);
  memcpy(c->at, s->at, s->count * sizeof *c->at);
  memcpy(c->held, s->held, s->count * VS_WAYS * sizeof *c->held);
  c->s.count = s->count;
  for (size_t i = 0; i < s->member_count; i++) cut_member(c, i);
  c->s = (vs_structure){ .at = c->at, .count = c->s.count, .members = c->members, .member_count = c->s.member_count,
                         .held = c->held, .cases = 1, .loads = c->loads };
  return true;
}

/* Sets *out to the second matrix of the eigenvalue problem: the stiffness change by the axial forces, with the opposite
 * sign, or the mass matrix. Returns false on failure. */
static bool other_matrix(const cut *c, const vs_structure_system *w, vs_sparse **out, vs_error *e) {
  enum { MEMBER = VS_MEMBER_WAYS * (VS_MEMBER_WAYS + 1) / 2 };
  *out = vs_sparse_new(w->rows, c->s.member_count * MEMBER + c->s.count * 3, "modes of frames", e);
  if (!*out) return false;
  for (size_t i = 0; i < c->s.member_count; i++) {
    const vs_structure_member *m = &c->members[i];
    vs_member_matrix a;
    vs_vec3 axes[3];
    double length = vs_structure_axes(&c->s, m, axes);
    if (c->p->axial) vs_member_geometric(m, length, -c->force[i], a);
    else vs_member_mass(m, length, c->mass[i], a);
    vs_member_matrix_to_nodes(m, axes, a);
    if (c->p->axial) vs_member_arms_geometric(m, axes, -c->force[i], a);
    for (int x = 0; x < VS_MEMBER_WAYS; x++)
      for (int y = x; y < VS_MEMBER_WAYS; y++) {
        uint32_t p = w->row[vs_structure_way(m, x)], q = w->row[vs_structure_way(m, y)];
        if (p != VS_HELD && q != VS_HELD) vs_sparse_add(*out, p, q, a[x][y]);
      }
  }
  for (size_t n = 0; !c->p->axial && n < c->p->s->count; n++)
    for (size_t i = 0; i < 3; i++)
      if (w->row[n * VS_WAYS + i] != VS_HELD) {
        uint32_t row = w->row[n * VS_WAYS + i];
        vs_sparse_add(*out, row, row, c->p->node_mass[n]);
      }
  return vs_sparse_close(*out, false, e);
}

/* Returns the displacement of the given end of a segment. vector: eigenvector. */
static vs_vec3 end_motion(const vs_structure_system *w, const double *vector, const vs_structure_member *m, int end) {
  double node[VS_WAYS];
  for (int i = 0; i < VS_WAYS; i++) {
    uint32_t row = w->row[vs_structure_way(m, end * VS_WAYS + i)];
    node[i] = row == VS_HELD ? 0 : vector[row];
  }
  return vs_member_end(node, m->offset[end]);
}

/* Computes the shape of a mode, the movements at the ends of all segments, from its eigenvector. */
static void set_shape(const cut *c, const vs_structure_system *w, const double *vector, double *shape) {
  size_t stride = (c->p->parts + 1) * 3, segment = 0;
  double most = 0;
  for (size_t i = 0; i < c->p->s->member_count; i++) {
    size_t parts = parts_of(c, &c->p->s->members[i]);
    for (size_t k = 0; k <= c->p->parts; k++) {
      /* a member that is not cut stays straight: its movements are interpolated between its ends */
      double t = parts > 1 ? 0 : (double)k / (double)c->p->parts;
      const vs_structure_member *m = &c->members[segment + (parts > 1 && k == parts ? k - 1 : parts > 1 ? k : 0)];
      vs_vec3 first = end_motion(w, vector, m, parts > 1 && k == parts), last = end_motion(w, vector, m, 1);
      vs_vec3 d = vs_v3_add(vs_v3_scale(first, 1 - t), vs_v3_scale(last, t));
      double *out = &shape[i * stride + k * 3];
      out[0] = d.x, out[1] = d.y, out[2] = d.z;
      most = fmax(most, vs_v3_length(d));
    }
    segment += parts;
  }
  for (size_t i = 0; most > 0 && i < c->p->s->member_count * stride; i++) shape[i] /= most;
}

static vs_structure_outcome find_modes(const cut *c, const vs_structure_system *w, vs_long_work work, double *values,
                                       double *shapes, size_t *found, vs_error *e) {
  vs_sparse *other = NULL;
  double *vectors = NULL;
  size_t each = c->p->s->member_count * (c->p->parts + 1) * 3, pairs = 0;
  vs_eigen_outcome outcome = VS_EIGEN_FAILED;
  if (other_matrix(c, w, &other, e)) {
    if (VS_FRESH(vectors, c->p->want * w->rows))
      outcome = vs_eigenpairs(w->equations, other, w->rows, c->p->want, work, values, vectors, &pairs, e);
    else
      vs_error_memory(e, NULL);
  }
  for (size_t i = 0; outcome == VS_EIGEN_DONE && i < pairs && values[i] > NO_VALUE; i++) {
    values[i] = c->p->axial ? 1 / values[i] : 1 / sqrt(values[i]) / (2 * acos(-1));
    set_shape(c, w, vectors + i * w->rows, &shapes[i * each]);
    *found = i + 1;
  }
  vs_sparse_free(other);
  free(vectors);
  if (outcome == VS_EIGEN_SLOW)
    vs_error_set(e, VS_ERROR_MODEL, NULL, "the modes were not found: too many are nearly equal");
  return outcome == VS_EIGEN_DONE ? VS_STRUCTURE_DONE
                                  : outcome == VS_EIGEN_STOPPED ? VS_STRUCTURE_STOPPED : VS_STRUCTURE_FAILED;
}

vs_structure_outcome vs_structure_modes(const vs_modes_problem *p, vs_long_work work, double *values, double *shapes,
                                        size_t *found, vs_structure_report *report, vs_error *e) {
  cut c = { .p = p };
  vs_structure_outcome outcome = VS_STRUCTURE_FAILED;
  VS_ASSERT(p->parts > 0 && p->want > 0);
  *found = 0;
  if (make_cut(&c, e)) {
    vs_structure_system w = { .s = &c.s, .loose = c.loose, .spins = c.spins, .spin_count = c.spin_count };
    outcome = vs_structure_system_make(&w, c.loads, report, e);
    if (outcome == VS_STRUCTURE_DONE && w.rows) outcome = find_modes(&c, &w, work, values, shapes, found, e);
    vs_structure_system_free(&w);
  }
  free_cut(&c);
  return outcome;
}
