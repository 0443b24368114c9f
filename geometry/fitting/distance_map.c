/* Writes a scan (measured points) whose colours show distances from a model (distance_map.h). Points keep the
 * coordinates of the scan. */
#include "geometry/fitting/distance_map.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

typedef struct {
  vs_map_write *write;
  void *context;
  bool ok;
  char text[1 << 14];
  size_t used;
} sink;

static void flush(sink *s) {
  if (s->ok && s->used) s->ok = s->write(s->context, s->text, s->used);
  s->used = 0;
}
static void put(sink *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(sink *s, const char *format, ...) {
  enum { LONGEST = 400 };
  if (s->used > sizeof s->text - LONGEST) flush(s);
  va_list args;
  va_start(args, format);
  int n = vsnprintf(s->text + s->used, LONGEST, format, args);
  va_end(args);
  if (n > 0) s->used += (size_t)(n < LONGEST ? n : LONGEST - 1);
}

/* vs_distance_colour uses blue, pale grey and red, with equal lightness on both sides of grey; people who do not see
 * red can distinguish these. */
void vs_distance_colour(double share, double rgb[3]) {
  static const double ends[3][3] = { { .13, .31, .66 }, { .90, .89, .87 }, { .70, .09, .11 } };
  double t = fmin(fmax(share, -1), 1), k = fabs(t);
  const double *to = ends[t < 0 ? 0 : 2];
  for (int i = 0; i < 3; i++) rgb[i] = ends[1][i] + k * (to[i] - ends[1][i]);
}

static bool shown(const vs_distance_map *m, size_t i) { return isfinite(m->distances[i]); }

static bool face_shown(const vs_distance_map *m, size_t f) {
  for (uint32_t c = m->scan->starts[f]; c < m->scan->starts[f + 1]; c++)
    if (!shown(m, m->scan->corners[c])) return false;
  return true;
}

/* Returns the number of points that the map shows: those with a known position. */
static size_t count_points(const vs_distance_map *m) {
  size_t n = 0;
  for (size_t i = 0; i < m->scan->point_count; i++) n += shown(m, i);
  return n;
}
static size_t count_faces(const vs_distance_map *m) {
  size_t n = 0;
  for (size_t f = 0; f < m->scan->face_count; f++) n += face_shown(m, f);
  return n;
}

bool vs_distance_map_ply(const vs_distance_map *m, vs_map_write *write, void *context) {
  sink s = { .write = write, .context = context, .ok = true };
  bool all = count_points(m) == m->scan->point_count; /* true if all points are visible, so that the faces keep their
                                                       * indices */
  size_t faces = all ? count_faces(m) : 0;
  VS_ASSERT(m->range > 0);
  put(&s, "ply\nformat ascii 1.0\ncomment signed distance from the fitted model, in %s; below 0: inside of it\n",
      m->units);
  put(&s, "comment colours: blue %.6g, grey 0, red %.6g\n", -m->range, m->range);
  put(&s, "element vertex %zu\nproperty double x\nproperty double y\nproperty double z\n", count_points(m));
  put(&s, "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float distance\n");
  if (faces) put(&s, "element face %zu\nproperty list uint uint vertex_indices\n", faces);
  put(&s, "end_header\n");
  for (size_t i = 0; s.ok && i < m->scan->point_count; i++) {
    double rgb[3];
    vs_vec3 p = m->scan->points[i];
    if (!shown(m, i)) continue;
    vs_distance_colour(m->distances[i] / m->range, rgb);
    put(&s, "%.9g %.9g %.9g %d %d %d %.6g\n", p.x + 0., p.y + 0., p.z + 0., (int)lrint(rgb[0] * 255),
        (int)lrint(rgb[1] * 255), (int)lrint(rgb[2] * 255), m->distances[i] + 0.);
  }
  for (size_t f = 0; s.ok && faces && f < m->scan->face_count; f++) {
    put(&s, "%u", m->scan->starts[f + 1] - m->scan->starts[f]);
    for (uint32_t c = m->scan->starts[f]; c < m->scan->starts[f + 1]; c++) put(&s, " %u", m->scan->corners[c]);
    put(&s, "\n");
  }
  flush(&s);
  return s.ok;
}

/* Appends a bar of colours beside the box b to the file, with the two ends of the range of distances as text. */
static void put_legend(sink *s, const vs_distance_map *m, const vs_bounds *b) {
  enum { STEPS = 16 };
  double height = b->max.z - b->min.z, size = vs_bounds_diagonal(b), x = b->max.x + .08 * size, w = .03 * size;
  if (!(height > .2 * size)) height = .2 * size;
  put(s, "<Shape><IndexedTriangleSet solid='false' index='");
  for (int i = 0; i < STEPS; i++)
    put(s, "%d %d %d %d %d %d ", 2 * i, 2 * i + 1, 2 * i + 3, 2 * i, 2 * i + 3, 2 * i + 2);
  put(s, "'><Coordinate point='");
  for (int i = 0; i <= STEPS; i++) {
    double z = b->min.z + height * i / STEPS;
    put(s, "%.6g %.6g %.6g %.6g %.6g %.6g ", x, b->min.y, z, x + w, b->min.y, z);
  }
  put(s, "'/><Color color='");
  for (int i = 0; i <= STEPS; i++) {
    double rgb[3];
    vs_distance_colour(2. * i / STEPS - 1, rgb);
    for (int k = 0; k < 2; k++) put(s, "%.3f %.3f %.3f ", rgb[0], rgb[1], rgb[2]);
  }
  put(s, "'/></IndexedTriangleSet></Shape>\n");
  for (int i = -1; i <= 1; i++)
    put(s,
        "<Transform translation='%.6g %.6g %.6g' rotation='1 0 0 1.5707963'><Shape><Appearance><Material "
        "diffuseColor='0 0 0' "
        "emissiveColor='.9 .9 .9'/></Appearance><Text solid='false' string='\"%.3g\"'><FontStyle size='%.6g' "
        "justify='\"BEGIN\" "
        "\"MIDDLE\"'/></Text></Shape></Transform>\n",
        x + 1.4 * w, b->min.y, b->min.z + height * (i + 1) / 2, i * m->range, .04 * size);
}

bool vs_distance_map_x3d(const vs_distance_map *m, vs_map_write *write, void *context) {
  sink s = { .write = write, .context = context, .ok = true };
  size_t faces = count_faces(m);
  vs_bounds b = vs_bounds_empty();
  VS_ASSERT(m->range > 0);
  for (size_t i = 0; i < m->scan->point_count; i++)
    if (shown(m, i)) vs_bounds_add(&b, m->scan->points[i]);
  put(&s,
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<X3D profile='Immersive' version='3.3'>\n<Scene>\n<WorldInfo "
      "info='"
      "\"signed distance from the fitted model: blue %.6g, grey 0, red %.6g\"'/>\n",
      -m->range, m->range);
  if (!vs_bounds_is_empty(&b)) { /* adds a view from the front, and a rotation of the scan: Y is up in X3D, and Z is up
                                  * in the scan */
    vs_vec3 c = vs_v3_scale(vs_v3_add(b.min, b.max), .5);
    double away = 1.5 * vs_bounds_diagonal(&b);
    put(&s, "<Background skyColor='.16 .18 .2'/>\n<Viewpoint description='front' position='%.9g %.9g %.9g' ", c.x + 0.,
        c.z + 0., away - c.y);
    put(&s, "centerOfRotation='%.9g %.9g %.9g'/>\n", c.x + 0., c.z + 0., 0. - c.y);
  }
  put(&s, "<Transform rotation='1 0 0 -1.5707963'>\n<Shape>\n");
  if (faces) {
    put(&s, "<Appearance><Material diffuseColor='.8 .8 .8'/></Appearance>\n<IndexedFaceSet solid='false' coordIndex='");
    for (size_t f = 0; s.ok && f < m->scan->face_count; f++) {
      if (!face_shown(m, f)) continue;
      for (uint32_t c = m->scan->starts[f]; c < m->scan->starts[f + 1]; c++) put(&s, "%u ", m->scan->corners[c]);
      put(&s, "-1\n");
    }
    put(&s, "'>\n");
  } else
    put(&s, "<PointSet>\n");
  put(&s, "<Coordinate point='");
  for (size_t i = 0; s.ok && i < m->scan->point_count; i++) {
    vs_vec3 p = m->scan->points[i];
    if (shown(m, i))
      put(&s, "%.9g %.9g %.9g\n", p.x + 0., p.y + 0., p.z + 0.);
    else if (faces)
      put(&s, "0 0 0\n");
  }
  put(&s, "'/>\n<Color color='");
  for (size_t i = 0; s.ok && i < m->scan->point_count; i++) {
    double rgb[3];
    if (!shown(m, i) && !faces) continue;
    vs_distance_colour(shown(m, i) ? m->distances[i] / m->range : 0, rgb);
    put(&s, "%.3f %.3f %.3f\n", rgb[0], rgb[1], rgb[2]);
  }
  put(&s, "'/>\n%s\n</Shape>\n", faces ? "</IndexedFaceSet>" : "</PointSet>");
  if (!vs_bounds_is_empty(&b)) put_legend(&s, m, &b);
  put(&s, "</Transform>\n</Scene>\n</X3D>\n");
  flush(&s);
  return s.ok;
}
