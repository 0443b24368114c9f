/* Owns the making of faces plane by moving their corners as little as it takes. */
#ifndef VS_GEOMETRY_NETS_PLANARITY_H
#define VS_GEOMETRY_NETS_PLANARITY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/vec.h"

/* Faces of three or more corners: face i is corner[start[i]] to corner[start[i + 1]], which is left out. */
typedef struct {
  vs_vec3 *at; /* moved */
  size_t count;
  const bool *fixed;
  const uint32_t *corner, *start;
  size_t face_count;
} vs_net_faces;

enum { VS_PLANE_ROUNDS = 60000 };

typedef enum { VS_PLANE_DONE, VS_PLANE_FAR, VS_PLANE_STOPPED, VS_PLANE_MEMORY } vs_plane_outcome;

/* Moves the corners until none lies further than `tolerance` from its faces' planes. *worst: how far the worst is. The
 * tolerance is above 0. */
vs_plane_outcome vs_net_planarise(vs_net_faces *f, double tolerance, vs_long_work work, double *worst);

#endif
