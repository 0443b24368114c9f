/* Makes faces of a net planar (planarity.h). Each corner moves to the mean of its projections onto the planes of all
 * its faces, repeatedly and with over-relaxation (S. Bouaziz and others, Shape-Up, 2012). */
#include "geometry/nets/planarity.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"

/* Returns the unit normal of face i by Newell's formula, and sets *middle to the mean of its corners. If the face has
 * no area, the normal has length 0. The face has at least three corners. */
static vs_vec3 plane_of(const vs_net_faces *f, size_t i, vs_vec3 *middle) {
  size_t n = f->start[i + 1] - f->start[i];
  const uint32_t *k = f->corner + f->start[i];
  vs_vec3 sum = { 0, 0, 0 }, normal = { 0, 0, 0 };
  VS_ASSERT(n >= 3);
  for (size_t c = 0; c < n; c++) sum = vs_v3_add(sum, f->at[k[c]]);
  *middle = vs_v3_scale(sum, 1. / (double)n);
  for (size_t c = 0; c < n; c++)
    normal = vs_v3_add(normal, vs_v3_cross(vs_v3_sub(f->at[k[c]], *middle), vs_v3_sub(f->at[k[(c + 1) % n]], *middle)));
  double length = vs_v3_length(normal);
  return length > 0 ? vs_v3_scale(normal, 1 / length) : normal;
}

vs_plane_outcome vs_net_planarise(vs_net_faces *f, double tolerance, vs_long_work work, double *worst) {
  static const double further = 1.5;
  vs_vec3 *move = NULL;
  uint32_t *faces = NULL;
  size_t move_room = 0, faces_room = 0;
  vs_plane_outcome outcome = VS_PLANE_FAR;
  VS_ASSERT(tolerance > 0);
  *worst = 0;
  if (!VS_GROW(move, move_room, f->count + 1) || !VS_GROW(faces, faces_room, f->count + 1))
    return free(move), free(faces), VS_PLANE_MEMORY;
  for (int round = 0; round < VS_PLANE_ROUNDS && outcome == VS_PLANE_FAR; round++) {
    *worst = 0;
    for (size_t i = 0; i < f->count; i++) move[i] = (vs_vec3){ 0, 0, 0 }, faces[i] = 0;
    for (size_t i = 0; i < f->face_count; i++) {
      vs_vec3 middle, normal = plane_of(f, i, &middle);
      for (uint32_t c = f->start[i]; c < f->start[i + 1]; c++) {
        uint32_t k = f->corner[c];
        double height = vs_v3_dot(normal, vs_v3_sub(f->at[k], middle));
        *worst = fmax(*worst, fabs(height));
        move[k] = vs_v3_sub(move[k], vs_v3_scale(normal, height)), faces[k]++;
      }
    }
    if (*worst <= tolerance)
      outcome = VS_PLANE_DONE;
    else if (round % 64 == 0 && !work.going(work.context, 0))
      outcome = VS_PLANE_STOPPED;
    for (size_t i = 0; outcome == VS_PLANE_FAR && i < f->count; i++)
      if (faces[i] && !f->fixed[i]) f->at[i] = vs_v3_add(f->at[i], vs_v3_scale(move[i], further / faces[i]));
  }
  free(move), free(faces);
  return outcome;
}
