/* Declares reading mesh files: .stl and .ply, as text or binary, .obj and .off. Bytes become points and faces;
 * polyface.h checks whether these form a solid. */
#ifndef VS_GEOMETRY_FILES_MESHFILE_H
#define VS_GEOMETRY_FILES_MESHFILE_H

#include "geometry/files/file_bytes.h"
#include "model/long_work.h"
#include "model/node.h"

/* Face f has the corners corners[starts[f]] .. corners[starts[f + 1] - 1]: three or more, zero-based, below
 * point_count. {0} is empty. */
typedef struct {
  vs_vec3 *points;
  uint32_t *starts, *corners; /* starts has face_count + 1 entries, or is NULL if there is no face */
  size_t point_count, point_room, face_count, start_room, corner_count, corner_room;
} vs_face_list;
void vs_face_list_free(vs_face_list *l);
bool vs_face_list_point(vs_face_list *l, vs_vec3 p);      /* false: out of memory */
bool vs_face_list_corner(vs_face_list *l, uint32_t point); /* of the face that is under construction */
/* Ends the face; drops it if it has fewer than three corners. */
bool vs_face_list_close(vs_face_list *l);

/* Returns true if the name has the ending of one of the four formats. */
bool vs_mesh_file_is(const char *name);
/* Reads a whole file that is in memory, in the format of its name's ending. Messages give the line (text files) or the
 * byte, the expected text and the found text. Counts are compared with the file's size before memory is allocated for
 * them. *out is empty before; the caller frees it, also after a failure. */
bool vs_mesh_file_read(const vs_file_bytes *file, vs_poller poll, vs_face_list *out, vs_error *e);
/* Does the same for files that may have no faces: clouds of points. nowhere: keep points with coordinates that are not
 * finite, because scanners write such points. */
bool vs_points_file_read(const vs_file_bytes *file, vs_poller poll, bool nowhere, vs_face_list *out, vs_error *e);

#endif
