/* Tests exactly whether two triangles intersect.
 *
 * The test works edge by edge. If two triangles without a common corner intersect, an edge of one intersects the other
 * triangle. If they intersect in more than a common corner, the intersection extends from this corner to the opposite
 * edge of one of the triangles. Only these two edges are tested then. With a common edge, the triangles are folded onto
 * each other if all their corners lie in one plane and the third corners lie on one side of the edge. Otherwise they
 * share only the edge. */
#include "kernel/mesh/triangles_meet.h"

#include "kernel/exact/doubles.h"

/* Returns an axis (0, 1 or 2) along which the projection of the triangle has an area. Returns 3 if the triangle has no
 * area. */
static int open_axis(const vs_vec3 *t) {
  for (int axis = 0; axis < 3; axis++)
    if (vs_doubles_turn(axis, t[0], t[1], t[2])) return axis;
  return 3;
}

bool vs_triangle_is_flat(const vs_vec3 *corners) { return open_axis(corners) == 3; }

/* Returns true if p is in triangle t or on its border. p lies in the triangle's plane. The projection of t along the
 * axis has an area. */
static bool holds(int axis, const vs_vec3 t[3], vs_vec3 p) {
  int way = vs_doubles_turn(axis, t[0], t[1], t[2]);
  VS_ASSERT(way != 0);
  for (int i = 0; i < 3; i++)
    if (vs_doubles_turn(axis, t[i], t[(i + 1) % 3], p) == -way) return false;
  return true;
}

/* Returns true if the segment leaves triangle t at its end `from`, the only point that the two have in common. The
 * segment lies in the plane of t. The projection of t along the axis has an area. */
static bool leaves(int axis, const vs_vec3 t[3], vs_vec3 from, vs_vec3 to) {
  int way = vs_doubles_turn(axis, t[0], t[1], t[2]);
  VS_ASSERT(way != 0);
  for (int i = 0; i < 3; i++) {
    vs_vec3 a = t[i], b = t[(i + 1) % 3];
    if (vs_doubles_turn(axis, a, b, from) == 0 && vs_doubles_turn(axis, a, b, to) == -way) return true;
  }
  return false;
}

/* Tests the segment from p to q, which lies in the plane of triangle t, against t, whose area is not 0. */
static vs_triangle_meeting flat_segment(const vs_vec3 t[3], vs_vec3 p, vs_vec3 q) {
  int axis = open_axis(t), left = 0, right = 0;
  VS_ASSERT(axis < 3);
  if (holds(axis, t, p)) return leaves(axis, t, p, q) ? VS_MEET_TOUCH : VS_MEET_CROSS;
  if (holds(axis, t, q)) return leaves(axis, t, q, p) ? VS_MEET_TOUCH : VS_MEET_CROSS;
  for (int i = 0; i < 3; i++) {
    int turn = vs_doubles_turn(axis, p, q, t[i]);
    left += turn > 0;
    right += turn < 0;
  }
  for (int i = 0; i < 3; i++) { /* Both ends of the segment are outside the triangle, but the segment may still cross it
                                 * or touch its corner. */
    vs_vec3 a = t[i], b = t[(i + 1) % 3];
    int ap = vs_doubles_turn(axis, a, b, p), aq = vs_doubles_turn(axis, a, b, q);
    if (ap * aq <= 0 && (ap || aq) && vs_doubles_turn(axis, p, q, a) * vs_doubles_turn(axis, p, q, b) <= 0)
      return left == 2 || right == 2 ? VS_MEET_TOUCH : VS_MEET_CROSS;
  }
  return VS_MEET_NOT;
}

/* Tests the segment from p to q against triangle t. from, to: the signs of the determinants that show on which side of
 * the triangle's plane p and q lie. */
static vs_triangle_meeting segment(const vs_vec3 t[3], vs_vec3 p, vs_vec3 q, int from, int to) {
  if (from * to > 0) return VS_MEET_NOT;
  if (from == 0 && to == 0) return flat_segment(t, p, q);
  if (from == 0 || to == 0) return holds(open_axis(t), t, from == 0 ? p : q) ? VS_MEET_TOUCH : VS_MEET_NOT;
  bool left = false, right = false, border = false;
  for (int i = 0; i < 3; i++) {
    int side = vs_doubles_side(p, q, t[i], t[(i + 1) % 3]);
    left = left || side > 0;
    right = right || side < 0;
    border = border || side == 0;
  }
  return left && right ? VS_MEET_NOT : border ? VS_MEET_TOUCH : VS_MEET_CROSS;
}

static vs_triangle_meeting worse(vs_triangle_meeting a, vs_triangle_meeting b) { return a > b ? a : b; }

vs_triangle_meeting vs_triangles_meet(const vs_vec3 a[3], const vs_vec3 b[3]) {
  int of_a[3], of_b[3], shared = 0, over_a[3] = { 0 },
                        over_b[3] = { 0 }; /* over_a[i]: on which side of triangle a's plane corner i of b lies, as 1,
                                            * -1 or 0; over_b[i]: the same for triangle b's plane and corner i of a */
  VS_ASSERT(!vs_triangle_is_flat(a) && !vs_triangle_is_flat(b));
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (vs_v3_equal(a[i], b[j])) of_a[shared] = i, of_b[shared++] = j;
  if (shared == 3) return VS_MEET_CROSS;
  for (int j = 0; j < 3; j++)
    if ((shared < 1 || j != of_b[0]) && (shared < 2 || j != of_b[1]))
      over_a[j] = vs_doubles_side(a[0], a[1], a[2], b[j]);
  if (shared == 2) {
    int x = 3 - of_a[0] - of_a[1], y = 3 - of_b[0] - of_b[1], axis = open_axis(a);
    vs_vec3 p = a[of_a[0]], q = a[of_a[1]];
    return over_a[y] == 0 && vs_doubles_turn(axis, p, q, a[x]) == vs_doubles_turn(axis, p, q, b[y]) ? VS_MEET_CROSS
                                                                                                    : VS_MEET_NOT;
  }
  if (shared == 0 && over_a[0] && over_a[0] == over_a[1] && over_a[0] == over_a[2]) return VS_MEET_NOT;
  for (int i = 0; i < 3; i++)
    if (shared < 1 || i != of_a[0]) over_b[i] = vs_doubles_side(b[0], b[1], b[2], a[i]);
  if (shared == 1) {
    int i = (of_a[0] + 1) % 3, j = (of_a[0] + 2) % 3, k = (of_b[0] + 1) % 3, l = (of_b[0] + 2) % 3;
    return worse(segment(b, a[i], a[j], over_b[i], over_b[j]), segment(a, b[k], b[l], over_a[k], over_a[l]));
  }
  vs_triangle_meeting all = VS_MEET_NOT;
  for (int i = 0; i < 3 && all != VS_MEET_CROSS; i++) {
    int j = (i + 1) % 3;
    all = worse(all, worse(segment(b, a[i], a[j], over_b[i], over_b[j]), segment(a, b[i], b[j], over_a[i], over_a[j])));
  }
  return all;
}

static double coordinate(vs_vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

bool vs_triangles_cross_level(const vs_vec3 a[3], const vs_vec3 b[3]) {
  for (int edges = 0; edges < 27; edges++) {
    int axis = edges / 9;
    vs_vec3 p = a[edges / 3 % 3], q = a[(edges / 3 + 1) % 3], x = b[edges % 3], y = b[(edges % 3 + 1) % 3];
    double level = coordinate(p, axis);
    if (coordinate(q, axis) != level || coordinate(x, axis) != level || coordinate(y, axis) != level) continue;
    if (vs_doubles_turn(axis, p, q, x) * vs_doubles_turn(axis, p, q, y) < 0 &&
        vs_doubles_turn(axis, x, y, p) * vs_doubles_turn(axis, x, y, q) < 0)
      return true;
  }
  return false;
}
