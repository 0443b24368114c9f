/* Computes the earth that drawings show around areas: a box without these areas and without the pieces that they
 * enclose. */
#include "geometry/plane/earth_areas.h"

/* Returns true if a loop has a corner on the left, right or lower side of the box, or if `upper` is true, on its upper
 * side. */
static bool reaches(const vs_vec2 *at, size_t count, const vs_vec2 box[2], bool upper) {
  for (size_t i = 0; i < count; i++)
    if (at[i].x <= box[0].x || at[i].x >= box[1].x || at[i].y <= box[0].y || (upper && at[i].y >= box[1].y))
      return true;
  return false;
}

/* Copies to out the pieces of area a that reach the left, right or lower side of the box, or if `upper` is true, its
 * upper side. */
static bool keep_outer(const vs_area *a, const vs_vec2 box[2], bool upper, vs_area *out) {
  bool ok = true, kept = false;
  for (size_t l = 0, first = 0; ok && l < a->loop_count; first += a->size[l++]) {
    if (!a->hole[l]) kept = reaches(a->at + first, a->size[l], box, upper);
    for (size_t i = 0; ok && kept && i < a->size[l]; i++)
      ok = vs_area_point(out, a->at[first + i].x, a->at[first + i].y);
    ok = ok && (!kept || vs_area_loop(out, a->hole[l]));
  }
  return ok;
}

bool vs_earth_around(const vs_vec2 (*edges)[2], size_t count, const vs_vec2 box[2], bool upper, vs_area *out,
                     vs_error *e) {
  static const char purpose[] = "drawing the earth";
  vs_area both[2] = { { 0 }, { 0 } }, rest = { 0 };
  bool ok = vs_area_point(&both[0], box[0].x, box[0].y) && vs_area_point(&both[0], box[1].x, box[0].y) &&
            vs_area_point(&both[0], box[1].x, box[1].y) && vs_area_point(&both[0], box[0].x, box[1].y) &&
            vs_area_loop(&both[0], false);
  if (!ok) vs_error_memory(e, NULL);
  ok = ok && (count == 0 || vs_area_of_chain(edges, count, purpose, &both[1], e)) &&
       vs_area_combine(VS_AREA_DIFFERENCE, both, 2, purpose, &rest, e);
  if (ok && !keep_outer(&rest, box, upper, out)) ok = vs_error_memory(e, NULL);
  vs_area_free(&both[0]);
  vs_area_free(&both[1]);
  vs_area_free(&rest);
  return ok;
}
