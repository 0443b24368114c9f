/* Declares the surface on which a face of a solid's mesh lies, with its own measures instead of the facets'. */
#ifndef VS_GEOMETRY_MEASURE_FACE_SURFACE_H
#define VS_GEOMETRY_MEASURE_FACE_SURFACE_H

#include "geometry/measure/face_edges.h"

typedef enum {
  VS_SURFACE_PLANE,
  VS_SURFACE_CYLINDER,
  VS_SURFACE_SPHERE,
  VS_SURFACE_CONE,
  VS_SURFACE_TORUS,
  VS_SURFACE_OTHER
} vs_surface_form;

typedef struct {
  vs_surface_form form;
  double area;   /* area of the face on its surface, also at round borders; for other surfaces the area of the facets */
  vs_vec3 at;    /* a point of a plane, cylinder's axis or other surface; the centre of a sphere or torus, the apex of a
                  * cone */
  vs_vec3 axis;  /* unit normal of a plane; unit direction of the axis of a cylinder, cone or torus */
  double radius; /* of a cylinder, a sphere, or a torus's middle circle */
  double tube;   /* radius of a torus's tube */
  double angle;  /* angle between a cone's axis and its sides, in radians */
} vs_face_surface;

/* Finds the surface of a face. round: true if the primitive from which the face came is round. Returns false when
 * memory is out. */
bool vs_face_surface_find(const vs_mesh_edges *s, const vs_mesh_faces *faces, uint32_t face, bool round,
                          vs_face_surface *out);

#endif
