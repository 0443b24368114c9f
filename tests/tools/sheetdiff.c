/* Compares two meshes of one shape: `sheetdiff A.stl B.stl LIMIT` prints `volumes V W, apart D`. Exits with 0 if the
 * volumes differ by less than 0.2 % and the Hausdorff distance of the surfaces is at most LIMIT.
 *
 * The distance of a point from a triangle is a convex function of the point. Therefore a triangle of A lies within
 * LIMIT of a triangle of B if its three corners do. If B has no such triangle, the tool splits A's triangle into four.
 * It judges a triangle smaller than an eighth of LIMIT by its corners alone. B's triangles are judged likewise. D is
 * the largest distance of a corner, an edge's midpoint or a centroid. */
#include "stl.h"

/* Returns the squared distance of p from a triangle. The nearest point is found by the region where p lies (Ericson,
 * Real-Time Collision Detection, 5.1.5). */
static double distance2(vec p, vec a, vec b, vec c) {
  vec ab = vec_sub(b, a), ac = vec_sub(c, a), ap = vec_sub(p, a), near;
  double d1 = vec_dot(ab, ap), d2 = vec_dot(ac, ap);
  vec bp = vec_sub(p, b), cp = vec_sub(p, c);
  double d3 = vec_dot(ab, bp), d4 = vec_dot(ac, bp), d5 = vec_dot(ab, cp), d6 = vec_dot(ac, cp);
  double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (d1 <= 0 && d2 <= 0) near = a;
  else if (d3 >= 0 && d4 <= d3) near = b;
  else if (d6 >= 0 && d5 <= d6) near = c;
  else if (vc <= 0 && d1 >= 0 && d3 <= 0) near = vec_add(a, vec_scale(ab, d1 / (d1 - d3)));
  else if (vb <= 0 && d2 >= 0 && d6 <= 0) near = vec_add(a, vec_scale(ac, d2 / (d2 - d6)));
  else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) near = vec_add(b, vec_scale(vec_sub(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6))));
  else near = vec_add(a, vec_scale(vec_add(vec_scale(ab, vb), vec_scale(ac, vc)), 1 / (va + vb + vc)));
  vec away = vec_sub(p, near);
  return vec_dot(away, away);
}

typedef struct { vec middle; double radius; } ball;

/* Returns the largest distance of a sample point of the mesh `from` to the mesh `to`. */
static double furthest(const stl *from, const stl *to, const ball *balls) {
  double worst = 0;
  for (size_t i = 0; i < from->count; i++) {
    vec a = vec_of(from->at[i].v[0]), b = vec_of(from->at[i].v[1]), c = vec_of(from->at[i].v[2]);
    const vec samples[] = {a, b, c, vec_scale(vec_add(a, b), 0.5), vec_scale(vec_add(b, c), 0.5), vec_scale(vec_add(c, a), 0.5), vec_scale(vec_add(vec_add(a, b), c), 1. / 3)};
    for (size_t s = 0; s < sizeof samples / sizeof *samples; s++) {
      double best = INFINITY, reach = INFINITY;
      for (size_t k = 0; k < to->count && best > worst * worst; k++) {
        vec away = vec_sub(samples[s], balls[k].middle);
        double outside = reach + balls[k].radius;
        if (vec_dot(away, away) > outside * outside) continue;
        const vertex *v = to->at[k].v;
        double d = distance2(samples[s], vec_of(v[0]), vec_of(v[1]), vec_of(v[2]));
        if (d < best) best = d, reach = sqrt(d);
      }
      if (best > worst * worst) worst = sqrt(best);
    }
  }
  return worst;
}

static ball ball_of(const vec *t) {
  ball b = {vec_scale(vec_add(vec_add(t[0], t[1]), t[2]), 1. / 3), 0};
  for (int k = 0; k < 3; k++) b.radius = fmax(b.radius, vec_length(vec_sub(t[k], b.middle)));
  return b;
}

typedef struct { const stl *to; const ball *balls; double limit; } judge;

static bool corner_near(const judge *j, vec p, size_t number) {
  const vertex *v = j->to->at[number].v;
  return distance2(p, vec_of(v[0]), vec_of(v[1]), vec_of(v[2])) <= j->limit * j->limit;
}

/* Returns true if every point of the triangle t is within the limit of one of the listed triangles. If unsure, the
 * function splits t and calls itself; at most about fifteen calls are nested. */
static bool near_all(const judge *j, const vec *t, const uint32_t *listed, size_t count) {
  ball b = ball_of(t);
  uint32_t *left = malloc((count + 1) * sizeof *left);
  size_t kept = 0;
  if (!left) return false;
  bool whole = false, corner[3] = {false, false, false};
  for (size_t i = 0; i < count && !whole; i++) {
    double reach = b.radius + j->balls[listed[i]].radius + j->limit;
    vec away = vec_sub(b.middle, j->balls[listed[i]].middle);
    if (vec_dot(away, away) > reach * reach) continue;
    left[kept++] = listed[i];
    bool all = true;
    for (int k = 0; k < 3; k++) {
      bool near = corner_near(j, t[k], listed[i]);
      corner[k] |= near, all &= near;
    }
    whole = all;
  }
  bool good = whole || (corner[0] && corner[1] && corner[2]);
  if (good && !whole && b.radius > j->limit / 8) {
    vec ab = vec_scale(vec_add(t[0], t[1]), 0.5), bc = vec_scale(vec_add(t[1], t[2]), 0.5), ca = vec_scale(vec_add(t[2], t[0]), 0.5);
    const vec parts[4][3] = {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}};
    for (int k = 0; good && k < 4; k++) good = near_all(j, parts[k], left, kept);
  }
  free(left);
  return good;
}

static bool within(const stl *from, const stl *to, const ball *balls, double limit) {
  uint32_t *all = malloc((to->count + 1) * sizeof *all);
  judge j = {to, balls, limit};
  bool good = all != NULL;
  for (size_t i = 0; good && i < to->count; i++) all[i] = (uint32_t)i;
  for (size_t i = 0; good && i < from->count; i++) {
    const vertex *v = from->at[i].v;
    const vec t[3] = {vec_of(v[0]), vec_of(v[1]), vec_of(v[2])};
    good = near_all(&j, t, all, to->count);
  }
  free(all);
  return good;
}

static ball *make_balls(const stl *m) {
  ball *balls = malloc((m->count + 1) * sizeof *balls);
  for (size_t i = 0; balls && i < m->count; i++) {
    const vertex *v = m->at[i].v;
    const vec t[3] = {vec_of(v[0]), vec_of(v[1]), vec_of(v[2])};
    balls[i] = ball_of(t);
  }
  return balls;
}

int main(int argc, char **argv) {
  stl a, b;
  char why[128] = "A.stl B.stl LIMIT, please";
  if (argc != 4 || !stl_read(argv[1], &a, why) || !stl_read(argv[2], &b, why)) {
    printf("%s\n", why);
    return 2;
  }
  ball *of_a = make_balls(&a), *of_b = make_balls(&b);
  if (!of_a || !of_b || !a.count || !b.count) {
    printf("%zu and %zu triangles\n", a.count, b.count);
    return 2;
  }
  double v = stl_volume(a.at, a.count), w = stl_volume(b.at, b.count), d = fmax(furthest(&a, &b, of_b), furthest(&b, &a, of_a));
  double limit = strtod(argv[3], NULL);
  bool near = d <= limit && within(&a, &b, of_b, limit) && within(&b, &a, of_a, limit);
  printf("volumes %.9g %.9g, apart %.9g%s\n", v, w, d, near || d > limit ? "" : " at corners, more between");
  free(of_a), free(of_b), free(a.at), free(b.at);
  return !(fabs(v - w) <= 0.002 * fabs(w) && near);
}
