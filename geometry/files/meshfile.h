/* Declares the reading of mesh files: .stl and .ply, as text or binary, .obj and .off. A reader converts a file to
 * points and faces; polyface.h checks whether these form a solid. */
#ifndef VS_GEOMETRY_FILES_MESHFILE_H
#define VS_GEOMETRY_FILES_MESHFILE_H

#include "geometry/files/file_bytes.h"
#include "model/long_work.h"
#include "model/node.h"

/* A list of points and faces. Face f has the corners corners[starts[f]] to corners[starts[f + 1] - 1]: three or more
 * indices of points, counted from 0. {0} is an empty list. */
typedef struct {
  vs_vec3 *points;
  uint32_t *starts, *corners; /* starts: face_count + 1 elements, or NULL if there is no face; corners: indices of
                               * points, face by face */
  size_t point_count, point_room, face_count, start_room, corner_count, corner_room;
} vs_face_list;
void vs_face_list_free(vs_face_list *l);
bool vs_face_list_point(vs_face_list *l, vs_vec3 p);      /* adds the point p; returns false when memory is out */
bool vs_face_list_corner(vs_face_list *l, uint32_t point); /* adds the point with this index as a corner to the face
                                                            * that is being built; returns false when memory is out */
/* Ends the face that is being built. Drops it if it has fewer than three corners. Returns false when memory is out. */
bool vs_face_list_close(vs_face_list *l);

/* Returns true if the name ends in .stl, .ply, .obj or .off. */
bool vs_mesh_file_is(const char *name);
/* Reads a mesh file that is in memory; the ending of its name determines the format. *out is empty at the call, and the
 * caller frees it, also after a failure. Returns false and sets e if the file is broken. */
bool vs_mesh_file_read(const vs_file_bytes *file, vs_poller poll, vs_face_list *out, vs_error *e);
/* Reads a file as vs_mesh_file_read does, but accepts a file without faces: a cloud of points. nowhere: true if points
 * with coordinates that are not finite are kept, because scanners write such points. */
bool vs_points_file_read(const vs_file_bytes *file, vs_poller poll, bool nowhere, vs_face_list *out, vs_error *e);

#endif
