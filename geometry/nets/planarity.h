/* Declares a function that makes the faces of a net planar by small moves of their corners. */
#ifndef VS_GEOMETRY_NETS_PLANARITY_H
#define VS_GEOMETRY_NETS_PLANARITY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/vec.h"

/* Faces of at least three corners: face i has the corners corner[start[i]] to corner[start[i + 1] - 1]. */
typedef struct {
  vs_vec3 *at; /* positions of the corners, which are moved */
  size_t count;
  const bool *fixed;
  const uint32_t *corner, *start;
  size_t face_count;
} vs_net_faces;

enum { VS_PLANE_ROUNDS = 60000 };

typedef enum { VS_PLANE_DONE, VS_PLANE_FAR, VS_PLANE_STOPPED, VS_PLANE_MEMORY } vs_plane_outcome;

/* Moves the corners of the faces until each is within `tolerance` > 0 of the planes of its faces. *worst: largest
 * remaining distance of a corner from a plane. */
vs_plane_outcome vs_net_planarise(vs_net_faces *f, double tolerance, vs_long_work work, double *worst);

#endif
