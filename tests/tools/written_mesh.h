/* Reads written meshes, independent of the program that wrote them: .off (numbers as text), binary .stl (32-bit
 * corners), binary .ply with doubles, and .glb. Each mesh of a .glb is read separately, in its local coordinates. */
#ifndef TESTS_TOOLS_WRITTEN_MESH_H
#define TESTS_TOOLS_WRITTEN_MESH_H

#include <jansson.h>

#include "stl.h"

#include "crossings.h"

typedef struct {
  crossings_point *points;
  crossings_triangle *triangles;
  size_t point_count, count;
} written_mesh;

static inline void written_free(written_mesh *s) {
  free(s->points);
  free(s->triangles);
  *s = (written_mesh){ 0 };
}

static inline bool written_room(written_mesh *s, size_t points, size_t triangles) {
  s->points = realloc(s->points, (points + 1) * sizeof *s->points);
  s->triangles = realloc(s->triangles, (triangles + 1) * sizeof *s->triangles);
  return s->points && s->triangles;
}

static inline bool read_off(const char *path, written_mesh *out) {
  FILE *f = fopen(path, "r");
  char word[64];
  size_t faces, edges;
  bool ok = f && fscanf(f, "%63s", word) == 1 && strcmp(word, "OFF") == 0 &&
            fscanf(f, "%zu %zu %zu", &out->point_count, &faces, &edges) == 3;
  ok = ok && written_room(out, out->point_count, faces);
  for (size_t i = 0; ok && i < out->point_count; i++)
    ok = fscanf(f, "%lf %lf %lf", &out->points[i][0], &out->points[i][1], &out->points[i][2]) == 3;
  for (; ok && out->count < faces; out->count++) {
    uint32_t *t = out->triangles[out->count], n;
    ok = fscanf(f, "%u %u %u %u", &n, &t[0], &t[1], &t[2]) == 4 && n == 3 && t[0] < out->point_count &&
         t[1] < out->point_count && t[2] < out->point_count;
  }
  if (f) fclose(f);
  return ok;
}

static inline bool read_stl(const char *path, written_mesh *out) {
  stl mesh;
  char why[128];
  if (!stl_read(path, &mesh, why)) return false;
  out->count = mesh.count;
  out->point_count = 3 * mesh.count;
  bool ok = written_room(out, out->point_count, out->count);
  for (uint32_t i = 0; ok && i < out->point_count; i++) {
    vertex v = mesh.at[i / 3].v[i % 3];
    out->points[i][0] = (double)v.x, out->points[i][1] = (double)v.y, out->points[i][2] = (double)v.z;
    out->triangles[i / 3][i % 3] = i;
  }
  free(mesh.at);
  return ok;
}

/* Reads a binary PLY file. A vertex begins with three doubles. A face begins with the byte 3 and three vertex numbers.
 * The header shows how many bytes of colour follow each vertex and face. */
static inline bool read_ply(const char *path, written_mesh *out) {
  FILE *f = fopen(path, "rb");
  char line[200] = "";
  size_t faces = 0, after = 0, colour = 0; /* after, colour: number of colour bytes behind each face, and behind each
                                            * vertex */
  bool ok = f != NULL, face = false, corner = false;
  while (ok && strcmp(line, "end_header\n") != 0) {
    ok = fgets(line, sizeof line, f) != NULL;
    if (strncmp(line, "element ", 8) == 0) {
      corner = sscanf(line, "element vertex %zu", &out->point_count) == 1;
      face = sscanf(line, "element face %zu", &faces) == 1;
    } else if (strncmp(line, "property uchar ", 15) == 0) {
      after += face;
      colour += corner;
    }
  }
  ok = ok && written_room(out, out->point_count, faces);
  for (size_t i = 0; ok && i < out->point_count; i++)
    ok = fread(&out->points[i], sizeof *out->points, 1, f) == 1 && fseek(f, (long)colour, SEEK_CUR) == 0;
  for (; ok && out->count < faces; out->count++) {
    uint32_t *t = out->triangles[out->count];
    ok = fgetc(f) == 3 && fread(t, sizeof *t, 3, f) == 3 && fseek(f, (long)after, SEEK_CUR) == 0;
    ok = ok && t[0] < out->point_count && t[1] < out->point_count && t[2] < out->point_count;
  }
  if (f) fclose(f);
  return ok;
}

static inline size_t written_number(const json_t *of, const char *name) {
  return (size_t)json_integer_value(json_object_get(of, name));
}

/* Returns the position, in the .glb's binary part, of the first number of an accessor (a typed array of glTF). */
static inline size_t written_offset(const json_t *root, const json_t *accessor) {
  const json_t *view = json_array_get(json_object_get(root, "bufferViews"), written_number(accessor, "bufferView"));
  return written_number(view, "byteOffset") + written_number(accessor, "byteOffset");
}

/* Appends the triangles of a glTF primitive, which is a part of a mesh with one material. */
static inline bool written_primitive(const json_t *root, const json_t *primitive, const unsigned char *binary,
                                     size_t size, written_mesh *out) {
  const json_t *accessors = json_object_get(root, "accessors");
  const json_t *corners =
      json_array_get(accessors, written_number(json_object_get(primitive, "attributes"), "POSITION"));
  const json_t *indices = json_array_get(accessors, written_number(primitive, "indices"));
  if (json_object_get(primitive, "mode")) return true; /* a primitive with a "mode" consists of lines instead of
                                                        * triangles, so it is skipped */
  size_t points = written_number(corners, "count"), count = written_number(indices, "count"),
         wide = written_number(indices, "componentType") == 5125 ? 4 : 2;
  size_t from = written_offset(root, corners), index_from = written_offset(root, indices), base = out->point_count;
  if (written_number(corners, "componentType") != 5126 || from + 12 * points > size ||
      index_from + wide * count > size || count % 3)
    return false;
  if (!written_room(out, base + points, out->count + count / 3)) return false;
  for (size_t i = 0; i < 3 * points; i++) {
    float x;
    memcpy(&x, binary + from + 4 * i, 4);
    out->points[base + i / 3][i % 3] = (double)x;
  }
  for (size_t i = 0; i < count; i++) {
    const unsigned char *at = binary + index_from + wide * i;
    uint32_t index = wide == 2 ? (uint32_t)(at[0] | at[1] << 8) : 0;
    if (wide == 4) memcpy(&index, at, 4);
    if (index >= points) return false;
    out->triangles[out->count + i / 3][i % 3] = (uint32_t)base + index;
  }
  out->point_count += points;
  out->count += count / 3;
  return true;
}

/* Reads mesh number `which` with all its primitives. Sets *more if another mesh follows. */
static inline bool read_glb(const char *path, size_t which, written_mesh *out, bool *more) {
  FILE *f = fopen(path, "rb");
  uint32_t head[5], next[2];
  char *text = NULL;
  unsigned char *binary = NULL;
  json_t *root = NULL;
  bool ok = f && fread(head, 4, 5, f) == 5 && memcmp(head, "glTF", 4) == 0 && (text = malloc(head[3] + 1)) != NULL &&
            fread(text, 1, head[3], f) == head[3];
  ok = ok && fread(next, 4, 2, f) == 2 && (binary = malloc((size_t)next[0] + 1)) != NULL &&
       fread(binary, 1, next[0], f) == next[0];
  ok = ok && (root = json_loadb(text, head[3], 0, NULL)) != NULL;
  const json_t *meshes = json_object_get(root, "meshes"),
               *primitives = json_object_get(json_array_get(meshes, which), "primitives");
  for (size_t i = 0; ok && i < json_array_size(primitives); i++)
    ok = written_primitive(root, json_array_get(primitives, i), binary, next[0], out);
  *more = ok && which + 1 < json_array_size(meshes);
  json_decref(root);
  free(text);
  free(binary);
  if (f) fclose(f);
  return ok;
}

/* Reads mesh number `which` from a file of any of these formats. Only a .glb can contain several meshes. */
static inline bool read_mesh(const char *path, size_t which, written_mesh *out, bool *more) {
  const char *suffix = strrchr(path, '.');
  *more = false;
  if (!suffix || (which && strcmp(suffix, ".glb") != 0)) return false;
  if (strcmp(suffix, ".glb") == 0) return read_glb(path, which, out, more);
  return strcmp(suffix, ".stl") == 0   ? read_stl(path, out)
         : strcmp(suffix, ".ply") == 0 ? read_ply(path, out)
                                       : read_off(path, out);
}

typedef struct {
  const double *low, *high;
  int way;
} written_edge;
static inline int written_compare_places(const double *a, const double *b) {
  for (int k = 0; k < 3; k++)
    if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
  return 0;
}
static inline int written_compare_edges(const void *a, const void *b) {
  const written_edge *x = a, *y = b;
  int order = written_compare_places(x->low, y->low);
  return order ? order : written_compare_places(x->high, y->high);
}

/* Returns the number of edges that occur in their two directions unequally often. Edges with equal coordinates are one
 * edge. */
static inline size_t written_open_edges(const written_mesh *s) {
  written_edge *edges = malloc((3 * s->count + 1) * sizeof *edges);
  size_t used = 0, open = 0;
  if (!edges) return SIZE_MAX;
  for (size_t i = 0; i < 3 * s->count; i++) {
    const double *a = s->points[s->triangles[i / 3][i % 3]], *b = s->points[s->triangles[i / 3][(i + 1) % 3]];
    int order = written_compare_places(a, b);
    if (order) edges[used++] = order < 0 ? (written_edge){ a, b, 1 } : (written_edge){ b, a, -1 };
  }
  qsort(edges, used, sizeof *edges, written_compare_edges);
  for (size_t i = 0, j; i < used; i = j) {
    long sum = 0;
    for (j = i; j < used && written_compare_edges(&edges[i], &edges[j]) == 0; j++) sum += edges[j].way;
    open += sum != 0;
  }
  free(edges);
  return open;
}

static inline double written_volume(const written_mesh *s) {
  double six = 0;
  for (size_t i = 0; i < s->count; i++) {
    const double *a = s->points[s->triangles[i][0]], *b = s->points[s->triangles[i][1]],
                 *c = s->points[s->triangles[i][2]];
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

#endif
