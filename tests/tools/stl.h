/* Reads binary STL files for the tests, independent of the program that made the files. Checks whether the triangles,
 * with vertices of 32-bit numbers, form a closed, oriented surface. */
#ifndef TESTS_TOOLS_STL_H
#define TESTS_TOOLS_STL_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct { float x, y, z; } vertex;
typedef struct { vertex v[3]; } triangle;
typedef struct { triangle *at; size_t count; } stl;
typedef struct { double x, y, z; } vec;

static inline vec vec_of(vertex v) { return (vec){v.x, v.y, v.z}; }
static inline vec vec_add(vec a, vec b) { return (vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline vec vec_sub(vec a, vec b) { return (vec){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline vec vec_scale(vec a, double k) { return (vec){a.x * k, a.y * k, a.z * k}; }
static inline double vec_dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline vec vec_cross(vec a, vec b) { return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static inline double vec_length(vec a) { return sqrt(vec_dot(a, a)); }

static inline float stl_number(const unsigned char *at) {
  uint32_t bits = (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
  float v;
  memcpy(&v, &bits, 4);
  return v;
}

/* Reads an STL file. On failure returns false and sets *why; the caller then has nothing to free. */
static inline bool stl_read(const char *path, stl *out, char why[128]) {
  FILE *f = fopen(path, "rb");
  unsigned char head[84], record[50];
  *out = (stl){NULL, 0};
  if (!f || fread(head, 1, 84, f) != 84) {
    snprintf(why, 128, "cannot read the header");
    if (f) fclose(f);
    return false;
  }
  size_t count = (size_t)head[80] | (size_t)head[81] << 8 | (size_t)head[82] << 16 | (size_t)head[83] << 24, room = 0;
  bool good = true;
  for (size_t i = 0; i < count && good; i++) {
    if (fread(record, 1, 50, f) != 50) {
      snprintf(why, 128, "the file ends in triangle %zu of %zu", i, count);
      good = false;
      break;
    }
    if (i == room) {
      triangle *more = realloc(out->at, (room = room * 2 + 1000) * sizeof *more);
      if (!more) {
        snprintf(why, 128, "out of memory");
        good = false;
        break;
      }
      out->at = more;
    }
    for (int k = 0; k < 3; k++) {
      vertex v = {stl_number(record + 12 + 12 * k), stl_number(record + 16 + 12 * k), stl_number(record + 20 + 12 * k)};
      out->at[i].v[k] = v;
      if (isfinite(v.x) && isfinite(v.y) && isfinite(v.z)) continue;
      snprintf(why, 128, "triangle %zu has a coordinate that is no number", i);
      good = false;
    }
    out->count = i + 1;
  }
  if (good && fgetc(f) != EOF) {
    snprintf(why, 128, "the file goes on after its last triangle");
    good = false;
  }
  fclose(f);
  if (!good) free(out->at), *out = (stl){NULL, 0};
  return good;
}

/* Returns the normal of the triangle; its length is twice the triangle's area. */
static inline vec stl_normal(const triangle *t) {
  return vec_cross(vec_sub(vec_of(t->v[1]), vec_of(t->v[0])), vec_sub(vec_of(t->v[2]), vec_of(t->v[0])));
}

/* Returns the enclosed volume. The centroid of the first triangle serves as origin, so no digits are lost for a mesh
 * far from 0. */
static inline double stl_volume(const triangle *at, size_t count) {
  double volume = 0;
  for (size_t i = 0; i < count; i++) volume += vec_dot(stl_normal(&at[i]), vec_sub(vec_of(at[i].v[0]), vec_of(at[0].v[0]))) / 6;
  return volume;
}

static inline double stl_area(const triangle *at, size_t count) {
  double area = 0;
  for (size_t i = 0; i < count; i++) area += vec_length(stl_normal(&at[i])) / 2;
  return area;
}

typedef struct { vertex low, high; int direction; } stl_edge; /* direction: +1 if the edge runs from low to high,
                                                               * otherwise -1 */

static inline int stl_compare_vertices(const vertex *a, const vertex *b) {
  if (a->x != b->x) return a->x < b->x ? -1 : 1;
  if (a->y != b->y) return a->y < b->y ? -1 : 1;
  if (a->z != b->z) return a->z < b->z ? -1 : 1;
  return 0;
}

static inline int stl_compare_edges(const void *a, const void *b) {
  const stl_edge *e = a, *f = b;
  int order = stl_compare_vertices(&e->low, &f->low);
  return order ? order : stl_compare_vertices(&e->high, &f->high);
}

/* Counts the edges that occur more often in one direction than in the opposite direction (*open), and the edges of
 * length 0 (*degenerate). Prints the first three open edges to the file `tell`. Returns false if memory is
 * exhausted. */
static inline bool stl_check(const triangle *at, size_t count, size_t *open, size_t *degenerate, FILE *tell) {
  stl_edge *edges = malloc((count * 3 + 1) * sizeof *edges);
  size_t used = 0;
  *open = *degenerate = 0;
  if (!edges) return false;
  for (size_t i = 0; i < count; i++)
    for (int k = 0; k < 3; k++) {
      vertex a = at[i].v[k], b = at[i].v[(k + 1) % 3];
      int order = stl_compare_vertices(&a, &b);
      *degenerate += order == 0;
      edges[used++] = order < 0 ? (stl_edge){a, b, 1} : (stl_edge){b, a, -1};
    }
  qsort(edges, used, sizeof *edges, stl_compare_edges);
  for (size_t i = 0, j; i < used; i = j) {
    long sum = 0;
    for (j = i; j < used && stl_compare_edges(&edges[i], &edges[j]) == 0; j++) sum += edges[j].direction;
    if (sum == 0) continue;
    if (tell && *open < 3)
      fprintf(tell, "open edge (%g %g %g) - (%g %g %g)\n", (double)edges[i].low.x, (double)edges[i].low.y, (double)edges[i].low.z, (double)edges[i].high.x,
              (double)edges[i].high.y, (double)edges[i].high.z);
    ++*open;
  }
  free(edges);
  return true;
}

#endif
