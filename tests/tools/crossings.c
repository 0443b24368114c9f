/* Checks whether written meshes intersect themselves (written_mesh.h lists the formats).
 *
 * `crossings [-q] FILE...` prints a line for each mesh: its number of triangles, its volume, the number of faults of
 * each kind (crossings.h), and the first fault of each kind. It also checks that each edge, identified by its
 * coordinates, occurs equally often in its two directions. With -q it prints only meshes with faults. Exits with 1 if
 * there are faults, with 2 if it cannot read a file. */
#include "written_mesh.h"

static int judge(const char *path, size_t which, bool quiet, bool *more) {
  written_mesh s = { 0 };
  crossings_found found = { .count = { 0 } };
  int status = 0;
  *more = false;
  if (!read_mesh(path, which, &s, more) || !crossings_find((const crossings_point *)s.points, s.point_count,
                                                           (const crossings_triangle *)s.triangles, s.count, &found)) {
    printf("%s: cannot be read\n", path);
    status = 2;
  } else {
    size_t open = written_open_edges(&s), faults = open + crossings_sum(&found);
    status = faults > 0;
    if (!quiet || faults) {
      printf("%s: %zu triangles, volume %.12g", path, s.count, written_volume(&s));
      if (open) printf(", %zu open", open);
      for (int k = 0; k < CROSSINGS_KINDS; k++) {
        if (!found.count[k]) continue;
        const double *p = s.points[s.triangles[found.first[k][0]][0]];
        printf(", %zu %s (the first %u and %u, at %.9g %.9g %.9g)", found.count[k], crossings_names[k],
               found.first[k][0], found.first[k][1], p[0], p[1], p[2]);
      }
      printf("\n");
    }
  }
  written_free(&s);
  return status;
}

int main(int argc, char **argv) {
  bool quiet = argc > 1 && strcmp(argv[1], "-q") == 0;
  int status = 0;
  for (int i = 1 + quiet; i < argc; i++) {
    bool more = true;
    for (size_t which = 0; more; which++) {
      int said = judge(argv[i], which, quiet, &more);
      if (said > status) status = said;
    }
  }
  return status;
}
