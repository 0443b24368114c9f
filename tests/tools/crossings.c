/* Owns the judgement whether written meshes meet themselves: binary .stl (32-bit corners) and .off (numbers as text).
 *
 * `crossings [-q] FILE...` prints a line a file: how many triangles, what they enclose, and how many faults of each kind there are (crossings.h), with the first of each; -q: only of
 * files with faults. Also whether each edge, by place, is walked as often one way as the other. Ends with 1 when there are faults, 2 when a file cannot be read. */
#include "stl.h"

#include "crossings.h"

typedef struct { crossings_point *points; crossings_triangle *triangles; size_t point_count, count; } soup;

static bool read_off(const char *path, soup *out) {
  FILE *f = fopen(path, "r");
  char word[64];
  size_t faces, edges;
  bool ok = f && fscanf(f, "%63s", word) == 1 && strcmp(word, "OFF") == 0 && fscanf(f, "%zu %zu %zu", &out->point_count, &faces, &edges) == 3;
  if (ok) {
    out->points = malloc((out->point_count + 1) * sizeof *out->points);
    out->triangles = malloc((faces + 1) * sizeof *out->triangles);
    ok = out->points && out->triangles;
  }
  for (size_t i = 0; ok && i < out->point_count; i++) ok = fscanf(f, "%lf %lf %lf", &out->points[i][0], &out->points[i][1], &out->points[i][2]) == 3;
  for (; ok && out->count < faces; out->count++) {
    uint32_t *t = out->triangles[out->count], n;
    ok = fscanf(f, "%u %u %u %u", &n, &t[0], &t[1], &t[2]) == 4 && n == 3 && t[0] < out->point_count && t[1] < out->point_count && t[2] < out->point_count;
  }
  if (f) fclose(f);
  return ok;
}

static bool read_stl(const char *path, soup *out) {
  stl mesh;
  char why[128];
  if (!stl_read(path, &mesh, why)) return false;
  out->count = mesh.count;
  out->point_count = 3 * mesh.count;
  out->points = malloc((out->point_count + 1) * sizeof *out->points);
  out->triangles = malloc((out->count + 1) * sizeof *out->triangles);
  bool ok = out->points && out->triangles;
  for (uint32_t i = 0; ok && i < out->point_count; i++) {
    vertex v = mesh.at[i / 3].v[i % 3];
    out->points[i][0] = (double)v.x, out->points[i][1] = (double)v.y, out->points[i][2] = (double)v.z;
    out->triangles[i / 3][i % 3] = i;
  }
  free(mesh.at);
  return ok;
}

typedef struct { const double *low, *high; int way; } edge;
static int compare_places(const double *a, const double *b) {
  for (int k = 0; k < 3; k++)
    if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
  return 0;
}
static int compare_edges(const void *a, const void *b) {
  const edge *x = a, *y = b;
  int order = compare_places(x->low, y->low);
  return order ? order : compare_places(x->high, y->high);
}

static size_t open_edges(const soup *s) {
  edge *edges = malloc((3 * s->count + 1) * sizeof *edges);
  size_t used = 0, open = 0;
  if (!edges) return SIZE_MAX;
  for (size_t i = 0; i < 3 * s->count; i++) {
    const double *a = s->points[s->triangles[i / 3][i % 3]], *b = s->points[s->triangles[i / 3][(i + 1) % 3]];
    int order = compare_places(a, b);
    if (order) edges[used++] = order < 0 ? (edge){ a, b, 1 } : (edge){ b, a, -1 };
  }
  qsort(edges, used, sizeof *edges, compare_edges);
  for (size_t i = 0, j; i < used; i = j) {
    long sum = 0;
    for (j = i; j < used && compare_edges(&edges[i], &edges[j]) == 0; j++) sum += edges[j].way;
    open += sum != 0;
  }
  free(edges);
  return open;
}

static double volume(const soup *s) {
  double six = 0;
  for (size_t i = 0; i < s->count; i++) {
    const double *a = s->points[s->triangles[i][0]], *b = s->points[s->triangles[i][1]], *c = s->points[s->triangles[i][2]];
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

int main(int argc, char **argv) {
  bool quiet = argc > 1 && strcmp(argv[1], "-q") == 0;
  int status = 0;
  for (int i = 1 + quiet; i < argc; i++) {
    soup s = { 0 };
    crossings_found found = { .count = { 0 } };
    const char *dot = strrchr(argv[i], '.');
    bool read = dot && strcmp(dot, ".stl") == 0 ? read_stl(argv[i], &s) : read_off(argv[i], &s);
    if (!read || !crossings_find((const crossings_point *)s.points, s.point_count, (const crossings_triangle *)s.triangles, s.count, &found)) {
      printf("%s: cannot be read\n", argv[i]);
      status = 2;
    } else {
      size_t open = open_edges(&s), faults = open + crossings_sum(&found);
      if (!quiet || faults) {
        printf("%s: %zu triangles, volume %.12g", argv[i], s.count, volume(&s));
        if (open) printf(", %zu open", open);
        for (int k = 0; k < CROSSINGS_KINDS; k++) {
          if (!found.count[k]) continue;
          const double *p = s.points[s.triangles[found.first[k][0]][0]];
          printf(", %zu %s (the first %u and %u, at %.9g %.9g %.9g)", found.count[k], crossings_names[k], found.first[k][0], found.first[k][1], p[0], p[1], p[2]);
        }
        printf("\n");
      }
      if (faults && status == 0) status = 1;
    }
    free(s.points);
    free(s.triangles);
  }
  return status;
}
