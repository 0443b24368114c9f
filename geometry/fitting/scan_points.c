/* Chooses the points to which a model is fitted (scan_points.h). */
#include "geometry/fitting/scan_points.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"

void vs_scan_points_free(vs_scan_points *s) {
  vs_face_list_free(&s->file);
  free(s->samples);
  *s = (vs_scan_points){ 0 };
}

/* Returns the next number of G. Marsaglia's xorshift generator. The seed is fixed, so a scan is always fitted with the
 * same points. */
static uint64_t next_random(uint64_t *state) {
  *state ^= *state << 13, *state ^= *state >> 7, *state ^= *state << 17;
  return *state;
}
static double next_share(uint64_t *state) { return (double)(next_random(state) >> 11) * 0x1p-53; }

static bool somewhere(vs_vec3 p) { return isfinite(p.x) && isfinite(p.y) && isfinite(p.z); }

static void shuffle(vs_vec3 *at, size_t count, uint64_t *state) {
  for (size_t i = count; i > 1; i--) {
    size_t k = (size_t)(next_random(state) % i);
    vs_vec3 held = at[i - 1];
    at[i - 1] = at[k], at[k] = held;
  }
}

/* Distributes `count` samples over the faces, in proportion to their area: the total area is divided into equal parts,
 * and each has one sample. Returns false when memory is out. */
static bool spread_samples(const vs_face_list *l, size_t count, vs_scan_points *out, uint64_t *state) {
  double *sums = NULL, area = 0;
  size_t room = 0, sample_room = 0, triangles = 0, at = 0;
  uint32_t(*corners)[3] = NULL;
  size_t corner_room = 0;
  bool ok = VS_GROW(sums, room, l->corner_count + 1) && VS_GROW(corners, corner_room, l->corner_count + 1) &&
            VS_GROW(out->samples, sample_room, count);
  for (size_t f = 0; ok && f < l->face_count; f++)
    for (uint32_t c = l->starts[f] + 1; c + 1 < l->starts[f + 1]; c++) {
      const uint32_t t[3] = { l->corners[l->starts[f]], l->corners[c], l->corners[c + 1] };
      vs_vec3 a = l->points[t[0]], cross = vs_v3_cross(vs_v3_sub(l->points[t[1]], a), vs_v3_sub(l->points[t[2]], a));
      double size = vs_v3_length(cross);
      if (!isfinite(size)) continue;
      area += size;
      sums[triangles] = area;
      for (int k = 0; k < 3; k++) corners[triangles][k] = t[k];
      triangles++;
    }
  for (size_t i = 0; ok && area > 0 && i < count; i++) {
    double place = ((double)i + next_share(state)) / (double)count * area, u = next_share(state), v = next_share(state);
    while (at + 1 < triangles && sums[at] < place) at++;
    if (u + v > 1) u = 1 - u, v = 1 - v;
    vs_vec3 a = l->points[corners[at][0]], b = l->points[corners[at][1]], c = l->points[corners[at][2]];
    out->samples[out->sample_count++] =
        vs_v3_add(a, vs_v3_add(vs_v3_scale(vs_v3_sub(b, a), u), vs_v3_scale(vs_v3_sub(c, a), v)));
  }
  free(sums), free(corners);
  return ok;
}

bool vs_scan_points_take(vs_face_list *file, size_t least, vs_scan_points *out, vs_error *e) {
  uint64_t state = UINT64_C(0x9e3779b97f4a7c15);
  size_t room = 0;
  *out = (vs_scan_points){ .file = *file };
  *file = (vs_face_list){ 0 };
  for (size_t i = 0; i < out->file.point_count; i++) out->nowhere += !somewhere(out->file.points[i]);
  bool ok = true;
  if (out->file.face_count) ok = spread_samples(&out->file, least, out, &state);
  if (ok && !out->sample_count) { /* no face of the file has an area, so the file's points are the samples */
    free(out->samples);
    out->samples = NULL;
    ok = VS_GROW(out->samples, room, out->file.point_count + 1);
    for (size_t i = 0; ok && i < out->file.point_count; i++)
      if (somewhere(out->file.points[i])) out->samples[out->sample_count++] = out->file.points[i];
  }
  if (!ok) return vs_scan_points_free(out), vs_error_memory(e, NULL);
  shuffle(out->samples, out->sample_count, &state);
  return true;
}
