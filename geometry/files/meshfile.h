/* Owns reading mesh files: .stl and .ply, in words or in bytes, .obj and .off. Bytes become points and faces; whether
 * those are a solid is another's question. */
#ifndef VS_GEOMETRY_FILES_MESHFILE_H
#define VS_GEOMETRY_FILES_MESHFILE_H

#include "geometry/files/file_bytes.h"
#include "model/long_work.h"
#include "model/node.h"

/* Face f has the corners corners[starts[f]] .. corners[starts[f + 1] - 1], three or more, zero-based, within
 * point_count; {0} is empty. */
typedef struct {
  vs_vec3 *points;
  uint32_t *starts, *corners; /* starts has face_count + 1 where there is a face, or NULL */
  size_t point_count, point_room, face_count, start_room, corner_count, corner_room;
} vs_face_list;
void vs_face_list_free(vs_face_list *l);
bool vs_face_list_point(vs_face_list *l, vs_vec3 p);      /* false: out of memory */
bool vs_face_list_corner(vs_face_list *l, uint32_t point); /* of the face that is being made */
/* the face ends; one of fewer than three corners is dropped */
bool vs_face_list_close(vs_face_list *l);

/* By the name's ending; false: none of the four. */
bool vs_mesh_file_is(const char *name);
/* Reads all of a file that is in memory, by its name's ending. Messages say the line (files in words) or the byte, what
 * was expected and what stands there. Counts are held against the file's size before anything is made for them. Out is
 * empty before; on failure it is to be freed too. */
bool vs_mesh_file_read(const vs_file_bytes *file, vs_poller poll, vs_face_list *out, vs_error *e);
/* The same for files that may have no faces: clouds of points. nowhere: points without a finite place are kept as they
 * are, for scanners write such. */
bool vs_points_file_read(const vs_file_bytes *file, vs_poller poll, bool nowhere, vs_face_list *out, vs_error *e);

#endif
