/* Declares the faces of a solid's mesh, and the edges between them, as a modeller sees them: the wall of a cylinder is
 * one face, and its rim one edge. */
#ifndef VS_GEOMETRY_MEASURE_FACE_EDGES_H
#define VS_GEOMETRY_MEASURE_FACE_EDGES_H

#include "geometry/nets/mesh_edges.h"

typedef enum { VS_FACE_PLANE, VS_FACE_CYLINDER, VS_FACE_OTHER } vs_face_form;

typedef struct {
  vs_face_form form;
  double area;
  vs_vec3 normal;    /* for a plane: its unit normal; for a cylinder: unit direction of its axis; for other faces: mean
                      * of the normals, as a unit vector */
  vs_vec3 at;        /* for a cylinder: the point of its axis nearest to the face's centroid; for other faces: the
                      * centroid */
  double radius;     /* radius of a cylinder; negative if the material lies outside of it */
  uint32_t first;    /* index, in the mesh, of the first of the face's triangles */
} vs_mesh_face;

/* An edge between two faces: a chain of mesh edges that follow each other. */
typedef struct {
  uint32_t face[2];
  size_t first, count; /* range of the edge's points: at[first] to at[first + count - 1] of vs_mesh_faces; a closed edge
                        * does not repeat its first point */
  bool closed;
  double angle;        /* angle between the two faces in radians, measured within the material; below pi if the edge is
                        * convex */
} vs_face_edge;

typedef struct {
  uint32_t *of; /* of[t]: number of the face that contains triangle t */
  vs_mesh_face *faces;
  vs_face_edge *edges;
  vs_vec3 *at;
  size_t face_count, face_room, edge_count, edge_room, count, room;
} vs_mesh_faces;

/* Finds the faces and edges of a closed mesh. leaf[t]: number of the primitive from which triangle t came; round[t]:
 * true if this primitive is round. Returns false when memory is out. The caller frees out in either case. */
bool vs_mesh_faces_find(const vs_mesh_edges *s, const uint32_t *leaf, const bool *round, vs_mesh_faces *out);
void vs_mesh_faces_free(vs_mesh_faces *f);

#endif
