/* Checks whether a binary STL file is closed and oriented, and prints its volume.
 *
 * `stlcheck FILE` prints `triangles N volume V area A`, and exits with 0 if the mesh is closed and oriented, without
 * degenerate triangles. Vertices with equal float32 coordinates are one vertex, and every directed edge must occur as
 * often as its opposite. Otherwise it prints the reason. */
#include "stl.h"

int main(int argc, char **argv) {
  stl mesh;
  char why[128] = "one file, please";
  size_t open, degenerate;
  if (argc != 2 || !stl_read(argv[1], &mesh, why) || !stl_check(mesh.at, mesh.count, &open, &degenerate, stderr)) {
    fprintf(stderr, "stlcheck: %s\n", why);
    return 2;
  }
  double volume = mesh.count ? stl_volume(mesh.at, mesh.count) : 0;
  printf("triangles %zu volume %.9g area %.9g\n", mesh.count, volume, stl_area(mesh.at, mesh.count));
  if (open) fprintf(stderr, "stlcheck: %zu open edges\n", open);
  if (degenerate) fprintf(stderr, "stlcheck: %zu triangle edges without length\n", degenerate);
  if (mesh.count && volume <= 0) fprintf(stderr, "stlcheck: inside out\n");
  int bad = open || degenerate || mesh.count == 0 || volume <= 0;
  free(mesh.at);
  return bad;
}
