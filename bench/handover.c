/* Measures the transfer of a drawing's meshes to a host, with the public header alone: handover FILE [OUT] It prints a
 * line: meshes, places, triangles at all places, MB of the library's arrays, processor seconds from the drawing to the
 * last mesh, seconds of the host's own copy of everything, MB by which the library's memory grew, seconds of a second
 * round in which nothing changed. OUT: file for the meshes as numbers, for handover_occt.cc. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <visualscheme.h>

static size_t held, most;

static void *take(void *context, void *old, size_t old_size, size_t new_size) {
  (void)context;
  held += new_size - old_size;
  if (held > most) most = held;
  if (new_size) return realloc(old, new_size);
  free(old);
  return NULL;
}

static double seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

/* Copies `bytes` bytes as a host would keep them. Returns the number of bytes. */
static size_t keep(void **to, const void *from, size_t bytes) {
  *to = bytes ? malloc(bytes) : NULL;
  if (*to) memcpy(*to, from, bytes);
  return bytes;
}

static bool write_mesh(FILE *to, const vs_mesh_info *m) {
  const uint64_t counts[] = { m->point_count, m->triangle_count, m->place_count };
  return fwrite(counts, sizeof counts, 1, to) == 1 &&
         fwrite(m->points, sizeof *m->points, m->point_count, to) == m->point_count &&
         fwrite(m->corners, sizeof *m->corners, m->triangle_count, to) == m->triangle_count &&
         fwrite(m->places, sizeof *m->places, m->place_count, to) == m->place_count;
}

/* Writes the meshes as numbers, in place of the measurements. */
static int write_all(vs_scheme *s, const char *path) {
  FILE *to = fopen(path, "wb");
  bool ok = to && vs_meshes_begin(s, NULL) == VS_OUTCOME_DONE;
  for (vs_mesh_info m; ok && vs_mesh_next(s, &m);) ok = write_mesh(to, &m);
  return !(to && fclose(to) == 0 && ok);
}

int main(int count, char **words) {
  vs_options o = vs_options_default();
  o.alloc = take;
  vs_scheme *s = count == 2 || count == 3 ? vs_new(&o) : NULL;
  if (!s || vs_eval_file(s, words[1], VS_EVAL_PROGRAM) != VS_OUTCOME_DONE) return 1;
  if (count == 3) return write_all(s, words[2]);
  size_t before = most = held, bytes = 0, meshes = 0, places = 0, triangles = 0;
  double began = seconds(), copying = 0;
  if (vs_meshes_begin(s, NULL) != VS_OUTCOME_DONE) return 1;
  for (vs_mesh_info m; vs_mesh_next(s, &m); meshes++) {
    void *copy[5];
    double start = seconds();
    bytes += keep(&copy[0], m.points, m.point_count * sizeof *m.points);
    bytes += keep(&copy[1], m.corners, m.triangle_count * sizeof *m.corners);
    bytes += keep(&copy[2], m.normals, m.normal_count * sizeof *m.normals);
    bytes += keep(&copy[3], m.normal_corners, m.normal_corners ? m.triangle_count * sizeof *m.normal_corners : 0);
    bytes += keep(&copy[4], m.places, m.place_count * sizeof *m.places);
    copying += seconds() - start;
    places += m.place_count, triangles += m.place_count * m.triangle_count;
  } /* the host keeps its copies until the program ends, as a real host does */
  double handed = seconds() - began - copying;
  size_t grew = most - before;
  began = seconds();
  vs_mesh_info again;
  if (vs_meshes_begin(s, NULL) != VS_OUTCOME_DONE || vs_mesh_next(s, &again)) return 1;
  printf("%zu %zu %zu %.1f %.3f %.3f %.1f %.3f\n", meshes, places, triangles, (double)bytes / 1e6, handed, copying,
         (double)grew / 1e6, seconds() - began);
  vs_free(s);
  return 0;
}
