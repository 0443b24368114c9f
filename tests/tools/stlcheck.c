/* Owns the judgement of a binary STL file, knowing nothing of the program that made it: is it closed and oriented, what does it enclose?
 *
 * `stlcheck FILE` prints `triangles N volume V area A` and ends with 0 when the mesh is a closed, oriented chain without degenerate
 * triangles: vertices that are equal as float32 are one, and every directed edge occurs as often as its opposite. Else it says why. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct { float x, y, z; } vertex;
typedef struct { vertex low, high; int direction; } edge; /* direction: +1 from low to high, -1 back */

static int compare_vertices(const vertex *a, const vertex *b) {
  if (a->x != b->x) return a->x < b->x ? -1 : 1;
  if (a->y != b->y) return a->y < b->y ? -1 : 1;
  if (a->z != b->z) return a->z < b->z ? -1 : 1;
  return 0;
}

static int compare_edges(const void *a, const void *b) {
  const edge *e = a, *f = b;
  int order = compare_vertices(&e->low, &f->low);
  return order ? order : compare_vertices(&e->high, &f->high);
}

static float number(const unsigned char *at) {
  uint32_t bits = (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
  float v;
  memcpy(&v, &bits, 4);
  return v;
}

int main(int argc, char **argv) {
  FILE *f = argc == 2 ? fopen(argv[1], "rb") : NULL;
  unsigned char head[84], record[50];
  if (!f || fread(head, 1, 84, f) != 84) {
    fprintf(stderr, "stlcheck: cannot read the header\n");
    return 2;
  }
  size_t count = (size_t)head[80] | (size_t)head[81] << 8 | (size_t)head[82] << 16 | (size_t)head[83] << 24, used = 0, degenerate = 0, open = 0;
  edge *edges = malloc((count * 3 + 1) * sizeof *edges);
  double volume = 0, area = 0;
  if (!edges) return 2;
  for (size_t i = 0; i < count; i++) {
    if (fread(record, 1, 50, f) != 50) {
      fprintf(stderr, "stlcheck: the file ends in triangle %zu of %zu\n", i, count);
      return 1;
    }
    vertex v[3];
    for (int k = 0; k < 3; k++) {
      v[k] = (vertex){number(record + 12 + 12 * k), number(record + 16 + 12 * k), number(record + 20 + 12 * k)};
      if (!isfinite(v[k].x) || !isfinite(v[k].y) || !isfinite(v[k].z)) {
        fprintf(stderr, "stlcheck: triangle %zu has a coordinate that is no number\n", i);
        return 1;
      }
    }
    for (int k = 0; k < 3; k++) {
      int order = compare_vertices(&v[k], &v[(k + 1) % 3]);
      if (order == 0) degenerate++;
      edges[used++] = order < 0 ? (edge){v[k], v[(k + 1) % 3], 1} : (edge){v[(k + 1) % 3], v[k], -1};
    }
    double ax = (double)v[1].x - v[0].x, ay = (double)v[1].y - v[0].y, az = (double)v[1].z - v[0].z;
    double bx = (double)v[2].x - v[0].x, by = (double)v[2].y - v[0].y, bz = (double)v[2].z - v[0].z;
    double nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    volume += (nx * v[0].x + ny * v[0].y + nz * v[0].z) / 6;
    area += sqrt(nx * nx + ny * ny + nz * nz) / 2;
  }
  if (fgetc(f) != EOF) {
    fprintf(stderr, "stlcheck: the file goes on after its last triangle\n");
    return 1;
  }
  fclose(f);
  qsort(edges, used, sizeof *edges, compare_edges);
  for (size_t i = 0, j; i < used; i = j) {
    long sum = 0;
    for (j = i; j < used && compare_edges(&edges[i], &edges[j]) == 0; j++) sum += edges[j].direction;
    if (sum && open++ < 3) fprintf(stderr, "stlcheck: open edge (%g %g %g) - (%g %g %g)\n", edges[i].low.x, edges[i].low.y, edges[i].low.z, edges[i].high.x, edges[i].high.y, edges[i].high.z);
  }
  free(edges);
  printf("triangles %zu volume %.9g area %.9g\n", count, volume, area);
  if (open) fprintf(stderr, "stlcheck: %zu open edges\n", open);
  if (degenerate) fprintf(stderr, "stlcheck: %zu triangle edges without length\n", degenerate);
  if (count && volume <= 0) fprintf(stderr, "stlcheck: inside out\n");
  return open || degenerate || count == 0 || volume <= 0;
}
