/* Calls GEOS for unions, intersections and differences of areas.
 *
 * GEOS keeps its input coordinates, and adds intersection points that are rounded to doubles. Therefore exact input
 * coordinates stay exact in the output. GEOS also keeps corners on a straight edge where pieces touched. These are
 * removed if they are within 1e-12 of the line, relative to the coordinates' size. */
#include "geometry/plane/areas.h"

#include <geos_c.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/dynamic.h"
#include "model/store/array.h"

void vs_area_free(vs_area *a) {
  free(a->at);
  free(a->size);
  free(a->hole);
  *a = (vs_area){ 0 };
}

bool vs_area_point(vs_area *a, double x, double y) {
  if (!VS_GROW(a->at, a->room, a->count + 1)) return false;
  a->at[a->count++] = (vs_vec2){ x, y };
  return true;
}

static size_t area_ended(const vs_area *a) { /* returns the number of points in the completed loops of area a; further
                                              * points belong to the next loop */
  size_t n = 0;
  for (size_t l = 0; l < a->loop_count; l++) n += a->size[l];
  return n;
}

/* Completes a loop of a, with the points from index `first` to the last. hole: true if the loop is a hole. */
static bool area_close(vs_area *a, size_t first, bool hole) {
  size_t n = a->count - first;
  VS_ASSERT(first <= a->count);
  if (n < 3) {
    a->count = first;
    return true;
  }
  if (a->loop_count == a->loop_room) {
    size_t sizes = a->loop_room, holes = a->loop_room;
    if (!VS_GROW(a->size, sizes, a->loop_count + 1) || !VS_GROW(a->hole, holes, a->loop_count + 1)) return false;
    a->loop_room = holes;
  }
  a->size[a->loop_count] = n;
  a->hole[a->loop_count++] = hole;
  return true;
}

bool vs_area_loop(vs_area *a, bool hole) { return area_close(a, area_ended(a), hole); }

/* ---- the library GEOS ---- */

#define VS_GEOS(X)                                                                                                     \
  X(GEOS_init_r) X(GEOS_finish_r) X(GEOSContext_setErrorMessageHandler_r) X(GEOSContext_setNoticeMessageHandler_r) \
  X(GEOSCoordSeq_create_r) \
  X(GEOSCoordSeq_setXY_r) X(GEOSCoordSeq_getXY_r) X(GEOSCoordSeq_getSize_r) X(GEOSGeom_createLinearRing_r)             \
  X(GEOSGeom_createPolygon_r) X(GEOSGeom_createCollection_r) X(GEOSGeom_destroy_r) X(GEOSGeomTypeId_r) \
  X(GEOSGetNumGeometries_r) \
  X(GEOSGetGeometryN_r) X(GEOSGetExteriorRing_r) X(GEOSGetNumInteriorRings_r) X(GEOSGetInteriorRingN_r) \
  X(GEOSGeom_getCoordSeq_r) \
  X(GEOSUnaryUnion_r) X(GEOSIntersection_r) X(GEOSDifference_r) X(GEOSMakeValid_r) X(GEOSGeom_createLineString_r) \
  X(GEOSPolygonize_r) \
  X(GEOSisEmpty_r) X(GEOSCoordSeq_destroy_r) X(GEOSPointOnSurface_r) X(GEOSGeomGetX_r) X(GEOSGeomGetY_r) \
  X(GEOSDelaunayTriangulation_r) X(GEOSMaximumInscribedCircle_r) X(GEOSUnaryUnionPrec_r) X(GEOSArea_r) \
  X(GEOSGeom_getExtent_r) \
  X(GEOSPrepare_r) X(GEOSPreparedIntersects_r) X(GEOSPreparedGeom_destroy_r)

typedef struct {
#define X(name) __typeof__(&name) name;
  VS_GEOS(X)
#undef X
  GEOSContextHandle_t h;
  char said[160]; /* last error message of GEOS */
} vs_geos;

static void geos_hear(const char *message, void *to) {
  vs_geos *g = to;
  strncpy(g->said, message, sizeof g->said - 1);
}
static void geos_ignore(const char *message, void *to) { (void)message, (void)to; }

static bool geos_open(vs_geos *g, const char *purpose, vs_error *e) {
  static const vs_dynamic_name names[] = {
#define X(name) { #name, offsetof(vs_geos, name) },
    VS_GEOS(X)
#undef X
  };
  memset(g, 0, sizeof *g);
  if (!vs_dynamic_load(VS_LIBRARY_GEOS, purpose, names, sizeof names / sizeof *names, g, e)) return false;
  g->h = g->GEOS_init_r();
  if (!g->h) return vs_error_memory(e, NULL);
  g->GEOSContext_setErrorMessageHandler_r(g->h, geos_hear, g);
  g->GEOSContext_setNoticeMessageHandler_r(g->h, geos_ignore, g);
  return true;
}

static void geos_close(vs_geos *g) {
  if (g->h) g->GEOS_finish_r(g->h);
}

/* Returns true if GEOS has failed because memory was out, or gave no reason for its last failure. */
static bool geos_starved(const vs_geos *g) { return !*g->said || strstr(g->said, "bad_alloc"); }

static bool geos_failed(const vs_geos *g, const char *purpose, vs_error *e) {
  if (geos_starved(g)) return vs_error_memory(e, NULL);
  return vs_error_set(e, VS_ERROR_MODEL, NULL, "%s: the outlines cannot be combined: %s", purpose, g->said);
}

/* makes a GEOS sequence of n points; if `closes` is true, repeats the first point at the end; returns NULL on
 * failure */
static GEOSCoordSequence *geos_sequence(vs_geos *g, const vs_vec2 *at, size_t n, bool closes) {
  size_t all = n + closes;
  GEOSCoordSequence *s = all <= INT32_MAX ? g->GEOSCoordSeq_create_r(g->h, (unsigned)all, 2) : NULL;
  bool ok = s != NULL;
  for (size_t i = 0; ok && i < all; i++)
    ok = g->GEOSCoordSeq_setXY_r(g->h, s, (unsigned)i, at[i % n].x, at[i % n].y) == 1;
  if (s && !ok) g->GEOSCoordSeq_destroy_r(g->h, s), s = NULL;
  return s;
}

static void geos_drop(vs_geos *g, GEOSGeometry **all, size_t count) {
  for (size_t i = 0; all && i < count; i++) g->GEOSGeom_destroy_r(g->h, all[i]);
}

/* Returns a GEOS collection of the given parts, or NULL on failure. In either case, the parts no longer belong to the
 * caller. */
static GEOSGeometry *geos_collect(vs_geos *g, int type, GEOSGeometry **parts, size_t count) {
  if (count > INT32_MAX) return geos_drop(g, parts, count), NULL;
  return g->GEOSGeom_createCollection_r(g->h, type, parts, (unsigned)count);
}

/* Returns `count` areas as a multipolygon of GEOS, or NULL on failure. */
static GEOSGeometry *geos_polygons(vs_geos *g, const vs_area *areas, size_t count) {
  size_t loops = 0, done = 0, holes = 0;
  for (size_t i = 0; i < count; i++) loops += areas[i].loop_count;
  GEOSGeometry **polygons = vs_zeros(loops + 1, sizeof *polygons), **inner = vs_zeros(loops + 1, sizeof *inner),
               *all = NULL;
  bool ok = polygons && inner;
  for (size_t i = 0; ok && i < count; i++) {
    const vs_area *a = &areas[i];
    GEOSGeometry *shell = NULL;
    for (size_t l = 0, first = 0; ok && l < a->loop_count; first += a->size[l++]) {
      GEOSCoordSequence *s = geos_sequence(g, a->at + first, a->size[l], true);
      GEOSGeometry *ring = s ? g->GEOSGeom_createLinearRing_r(g->h, s) : NULL;
      ok = ring != NULL;
      if (ok && l && a->hole[l]) inner[holes++] = ring;
      else if (ok) shell = ring;
      if (!ok || l + 1 == a->loop_count || !a->hole[l + 1]) { /* if the current loop is the last of its polygon, makes
                                                               * the polygon */
        if (ok) {
          polygons[done] = g->GEOSGeom_createPolygon_r(g->h, shell, inner, (unsigned)holes); /* after this call, the
                                                                                              * rings belong to GEOS,
                                                                                              * which frees them even on
                                                                                              * failure */
          ok = polygons[done] != NULL;
          done += ok;
        } else {
          geos_drop(g, &shell, 1);
          geos_drop(g, inner, holes);
        }
        shell = NULL;
        holes = 0;
      }
    }
  }
  if (ok) all = geos_collect(g, GEOS_MULTIPOLYGON, polygons, done);
  else geos_drop(g, polygons, done);
  free(polygons);
  free(inner);
  return all;
}

/* ---- results of GEOS ---- */

/* Removes corners that lie on the line between their two neighbours, from the last loop of area a; this loop begins at
 * point `first`. */
static void area_tidy(vs_area *a, size_t first) {
  double size = 0;
  size_t n = a->count - first, kept = 0;
  vs_vec2 *p = a->at + first;
  VS_ASSERT(first <= a->count);
  for (size_t i = 0; i < n; i++) size = fmax(size, fmax(fabs(p[i].x), fabs(p[i].y)));
  for (size_t i = 0; i < n; i++) { /* compares each corner with the corner that was kept before it and the corner after
                                    * it */
    vs_vec2 b = p[i], c = p[(i + 1) % n], o = kept ? p[kept - 1] : p[n - 1];
    double ux = b.x - o.x, uy = b.y - o.y, vx = c.x - b.x, vy = c.y - b.y, wx = c.x - o.x, wy = c.y - o.y;
    double u = hypot(ux, uy), v = hypot(vx, vy), w = hypot(wx, wy), slack = 1e-12 * size;
    bool straight = u <= slack || v <= slack || (ux * vx + uy * vy > 0 && fabs(ux * wy - uy * wx) <= slack * w);
    if (!straight || (i + 1 == n && kept < 3)) p[kept++] = b;
  }
  a->count = first + kept;
}

static bool geos_ring(vs_geos *g, const GEOSGeometry *ring, bool hole, vs_area *out) {
  const GEOSCoordSequence *s = ring ? g->GEOSGeom_getCoordSeq_r(g->h, ring) : NULL;
  unsigned n = 0;
  size_t first = out->count;
  bool ok = s && g->GEOSCoordSeq_getSize_r(g->h, s, &n) == 1;
  double area = 0, length = 0;
  for (unsigned i = 0; ok && i + 1 < n; i++) {
    double x, y;
    ok = g->GEOSCoordSeq_getXY_r(g->h, s, i, &x, &y) == 1 && vs_area_point(out, x, y);
  }
  if (!ok) return false;
  area_tidy(out, first);
  vs_vec2 *p = out->at + first;
  size_t count = out->count - first;
  for (size_t i = 0; i < count; i++) {
    vs_vec2 a = p[i], b = p[(i + 1) % count];
    area += ((a.x - p[0].x) * (b.y - p[0].y) - (a.y - p[0].y) * (b.x - p[0].x)) / 2;
    length += hypot(b.x - a.x, b.y - a.y);
  }
  if (!(fabs(area) > 1e-12 * length * length)) { /* drops the loop if it is a sliver that rounding has produced */
    out->count = first;
    return true;
  }
  if ((area < 0) != hole)
    for (size_t i = 0, j = count; i < j; i++) {
      vs_vec2 swap = p[i];
      p[i] = p[--j];
      p[j] = swap;
    }
  return area_close(out, first, hole);
}

static bool geos_polygon(vs_geos *g, const GEOSGeometry *polygon, vs_area *out) {
  size_t loops = out->loop_count;
  if (!geos_ring(g, g->GEOSGetExteriorRing_r(g->h, polygon), false, out)) return false;
  if (out->loop_count == loops) return true; /* the polygon's outer loop was a sliver and was dropped, so its holes are
                                              * dropped, too */
  int holes = g->GEOSGetNumInteriorRings_r(g->h, polygon);
  for (int i = 0; i < holes; i++)
    if (!geos_ring(g, g->GEOSGetInteriorRingN_r(g->h, polygon, i), true, out)) return false;
  return holes >= 0;
}

/* Appends the polygons of a GEOS result to out, and ignores its lines and points, which occur where areas only touch.
 * Returns false on failure. */
static bool geos_result(vs_geos *g, const GEOSGeometry *from, vs_area *out) {
  int type = from ? g->GEOSGeomTypeId_r(g->h, from) : -1;
  if (type < 0) return false;
  if (type == GEOS_POLYGON) {
    char empty = g->GEOSisEmpty_r(g->h, from);
    return empty == 1 || (empty == 0 && geos_polygon(g, from, out));
  }
  if (type != GEOS_MULTIPOLYGON && type != GEOS_GEOMETRYCOLLECTION) return true;
  int n = g->GEOSGetNumGeometries_r(g->h, from);
  for (int i = 0; i < n; i++) {
    const GEOSGeometry *part = g->GEOSGetGeometryN_r(g->h, from, i);
    int kind = part ? g->GEOSGeomTypeId_r(g->h, part) : -1;
    if (kind < 0) return false;
    int many = kind == GEOS_MULTIPOLYGON ? g->GEOSGetNumGeometries_r(g->h, part) : 1;
    if (many < 0) return false;
    for (int k = 0; k < many && (kind == GEOS_POLYGON || kind == GEOS_MULTIPOLYGON); k++) {
      const GEOSGeometry *polygon = kind == GEOS_POLYGON ? part : g->GEOSGetGeometryN_r(g->h, part, k);
      if (!polygon || !geos_polygon(g, polygon, out)) return false;
    }
  }
  return n >= 0;
}

/* Returns a valid copy of the collection a, or NULL on failure. Makes each part valid separately, because GEOS would
 * otherwise lose areas that two parts cover. */
static GEOSGeometry *geos_mend(vs_geos *g, const GEOSGeometry *a) {
  int n = g->GEOSGetNumGeometries_r(g->h, a);
  GEOSGeometry **parts = n < 0 ? NULL : vs_zeros((size_t)n + 1, sizeof *parts), *all = NULL;
  bool ok = parts != NULL;
  size_t done = 0;
  for (; ok && done < (size_t)n; done += ok) {
    const GEOSGeometry *part = g->GEOSGetGeometryN_r(g->h, a, (int)done);
    parts[done] = part ? g->GEOSMakeValid_r(g->h, part) : NULL;
    ok = parts[done] != NULL;
  }
  if (ok) all = geos_collect(g, GEOS_GEOMETRYCOLLECTION, parts, done);
  else geos_drop(g, parts, done);
  free(parts);
  return all;
}

/* Returns false if a union has lost a part: if some part of the collection a has no point in `united`. GEOS sometimes
 * loses a part with corners very near to other parts' edges. */
static bool geos_holds_all(vs_geos *g, const GEOSGeometry *a, const GEOSGeometry *united) {
  int n = g->GEOSGetNumGeometries_r(g->h, a);
  const GEOSGeometry *one = n > 1 ? g->GEOSGetGeometryN_r(g->h, a, 0) : NULL; /* only polygons are tested, because GEOS
                                                                               * does not lose lines */
  bool filled = one && g->GEOSGeomTypeId_r(g->h, one) == GEOS_POLYGON;
  const GEOSPreparedGeometry *fast = filled ? g->GEOSPrepare_r(g->h, united) : NULL;
  bool all = true;
  for (int i = 0; fast && all && i < n; i++) {
    const GEOSGeometry *part = g->GEOSGetGeometryN_r(g->h, a, i);
    GEOSGeometry *point = part ? g->GEOSPointOnSurface_r(g->h, part) : NULL;
    all = !point || g->GEOSisEmpty_r(g->h, point) != 0 || g->GEOSPreparedIntersects_r(g->h, fast, point) != 0;
    g->GEOSGeom_destroy_r(g->h, point);
  }
  g->GEOSPreparedGeom_destroy_r(g->h, fast);
  return all;
}

/* Computes the union of the parts of a again, on a coarser grid, where GEOS loses no part. Returns the larger of the
 * new union and `united`, and frees the smaller. */
static GEOSGeometry *geos_unite_on_grid(vs_geos *g, const GEOSGeometry *a, GEOSGeometry *united) {
  int exponent;
  double was = 0, is = 0, low[2], high[2];
  if (g->GEOSGeom_getExtent_r(g->h, a, &low[0], &low[1], &high[0], &high[1]) != 1) return united;
  frexp(fmax(fmax(fabs(low[0]), fabs(high[0])), fmax(fabs(low[1]), fabs(high[1]))), &exponent);
  GEOSGeometry *again = g->GEOSUnaryUnionPrec_r(g->h, a, ldexp(1, exponent - 50));
  bool ok = again && g->GEOSArea_r(g->h, united, &was) == 1 && g->GEOSArea_r(g->h, again, &is) == 1;
  bool better = ok && is > was * (1 + 1e-12);
  g->GEOSGeom_destroy_r(g->h, better ? united : again);
  return better ? again : united;
}

/* Returns the union of the parts of a, and frees a. If GEOS rejects a as invalid, makes it valid and tries again,
 * unless memory is out. Returns NULL on failure. */
static GEOSGeometry *geos_unite(vs_geos *g, GEOSGeometry *a) {
  *g->said = 0;
  GEOSGeometry *united = g->GEOSUnaryUnion_r(g->h, a);
  if (!united && !geos_starved(g)) {
    *g->said = 0;
    GEOSGeometry *valid = geos_mend(g, a);
    if (valid) united = g->GEOSUnaryUnion_r(g->h, valid);
    g->GEOSGeom_destroy_r(g->h, valid);
  }
  if (united && !geos_holds_all(g, a, united)) united = geos_unite_on_grid(g, a, united);
  g->GEOSGeom_destroy_r(g->h, a);
  return united;
}

bool vs_area_combine(vs_area_operation operation, const vs_area *operands, size_t count, const char *purpose,
                     vs_area *out, vs_error *e) {
  vs_geos g;
  for (size_t i = 0; i < count; i++)
    for (size_t k = 0; k < operands[i].count; k++)
      if (!(fabs(operands[i].at[k].x) < 1e100 && fabs(operands[i].at[k].y) < 1e100))
        return vs_error_set(e, VS_ERROR_MODEL, NULL, "%s: the numbers are too large: coordinates must stay below 1e100",
                            purpose);
  if (!geos_open(&g, purpose, e)) return false;
  size_t first = operation == VS_AREA_UNION ? count : 1, next = first;
  GEOSGeometry *made = geos_polygons(&g, operands, first);
  if (made) made = geos_unite(&g, made);
  while (made && next < count) {
    size_t take = operation == VS_AREA_DIFFERENCE ? count - next : 1;
    GEOSGeometry *other = geos_polygons(&g, operands + next, take), *both = NULL;
    if (other) other = geos_unite(&g, other);
    if (other) both = (operation == VS_AREA_DIFFERENCE ? g.GEOSDifference_r : g.GEOSIntersection_r)(g.h, made, other);
    g.GEOSGeom_destroy_r(g.h, other);
    g.GEOSGeom_destroy_r(g.h, made);
    made = both;
    next += take;
  }
  bool ok = (made && geos_result(&g, made, out)) || geos_failed(&g, purpose, e);
  g.GEOSGeom_destroy_r(g.h, made);
  geos_close(&g);
  if (!ok) vs_area_free(out);
  return ok;
}

bool vs_area_middle(const vs_area *a, const char *purpose, vs_vec2 *at, double *radius, vs_error *e) {
  vs_geos g;
  vs_vec2 low = { INFINITY, INFINITY }, high = { -INFINITY, -INFINITY }, rim = { 0, 0 };
  *radius = 0;
  if (!a->loop_count) return true;
  if (!geos_open(&g, purpose, e)) return false;
  for (size_t i = 0; i < a->count; i++) {
    low = (vs_vec2){ fmin(low.x, a->at[i].x), fmin(low.y, a->at[i].y) };
    high = (vs_vec2){ fmax(high.x, a->at[i].x), fmax(high.y, a->at[i].y) };
  }
  GEOSGeometry *whole = geos_polygons(&g, a, 1);
  if (whole) whole = geos_unite(&g, whole);
  double step = hypot(high.x - low.x, high.y - low.y) / 1000;
  GEOSGeometry *line = whole && step > 0 ? g.GEOSMaximumInscribedCircle_r(g.h, whole, step) : NULL;
  const GEOSCoordSequence *s = line ? g.GEOSGeom_getCoordSeq_r(g.h, line) : NULL;
  bool ok = s && g.GEOSCoordSeq_getXY_r(g.h, s, 0, &at->x, &at->y) == 1 &&
            g.GEOSCoordSeq_getXY_r(g.h, s, 1, &rim.x, &rim.y) == 1;
  if (ok) *radius = hypot(rim.x - at->x, rim.y - at->y);
  else ok = geos_failed(&g, purpose, e);
  g.GEOSGeom_destroy_r(g.h, line);
  g.GEOSGeom_destroy_r(g.h, whole);
  geos_close(&g);
  return ok;
}

/* ---- tests of points ---- */

static int area_winding(const vs_area *a, double x, double y) {
  int turns = 0;
  for (size_t l = 0, first = 0; l < a->loop_count; first += a->size[l++])
    for (size_t i = 0; i < a->size[l]; i++) {
      vs_vec2 p = a->at[first + i], q = a->at[first + (i + 1) % a->size[l]];
      double side = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
      if (p.y <= y && q.y > y && side > 0) turns++;
      if (p.y > y && q.y <= y && side < 0) turns--;
    }
  return turns;
}

/* Returns true if the point is inside the area, or within 1e-9 of the area's size from its border. */
bool vs_area_holds(const vs_area *a, double x, double y) {
  double size = 0, near = INFINITY;
  for (size_t i = 0; i < a->count; i++)
    size = fmax(size, fmax(fabs(a->at[i].x - a->at[0].x), fabs(a->at[i].y - a->at[0].y)));
  for (size_t l = 0, first = 0; l < a->loop_count; first += a->size[l++])
    for (size_t i = 0; i < a->size[l]; i++) {
      vs_vec2 p = a->at[first + i], q = a->at[first + (i + 1) % a->size[l]];
      double dx = q.x - p.x, dy = q.y - p.y, d = dx * dx + dy * dy,
             t = d > 0 ? ((x - p.x) * dx + (y - p.y) * dy) / d : 0;
      t = fmin(1, fmax(0, t));
      near = fmin(near, hypot(x - p.x - t * dx, y - p.y - t * dy));
    }
  return near <= 1e-9 * size || area_winding(a, x, y) > 0;
}

/* ---- areas of directed edges ---- */

static int chain_winding(const vs_vec2 (*edges)[2], size_t count, double x, double y) {
  int turns = 0;
  for (size_t i = 0; i < count; i++) {
    vs_vec2 p = edges[i][0], q = edges[i][1];
    if ((p.y <= y) == (q.y <= y)) continue;
    double side = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
    if (p.y <= y && side > 0) turns++;
    if (p.y > y && side < 0) turns--;
  }
  return turns;
}

/* GEOS unites all edges as lines, and divides them at their intersections. The faces between the lines are then
 * selected by their winding number, and united. */
bool vs_area_of_chain(const vs_vec2 (*edges)[2], size_t count, const char *purpose, vs_area *out, vs_error *e) {
  vs_geos g;
  if (!geos_open(&g, purpose, e)) return false;
  GEOSGeometry **lines = vs_zeros(count + 1, sizeof *lines), **kept = NULL, *noded = NULL, *faces = NULL, *all = NULL;
  bool ok = lines != NULL;
  size_t done = 0, keep = 0;
  for (; ok && done < count; done += ok) {
    GEOSCoordSequence *s = geos_sequence(&g, edges[done], 2, false);
    lines[done] = s ? g.GEOSGeom_createLineString_r(g.h, s) : NULL;
    ok = lines[done] != NULL;
  }
  if (!ok) geos_drop(&g, lines, done);
  if (ok) noded = geos_collect(&g, GEOS_MULTILINESTRING, lines, done);
  if (noded) noded = geos_unite(&g, noded);
  if (noded) faces = g.GEOSPolygonize_r(g.h, (const GEOSGeometry *const *)&noded, 1);
  int n = faces ? g.GEOSGetNumGeometries_r(g.h, faces) : -1;
  if (n >= 0) kept = vs_zeros((size_t)n + 1, sizeof *kept);
  ok = kept != NULL;
  for (int i = 0; ok && i < n; i++) {
    const GEOSGeometry *face = g.GEOSGetGeometryN_r(g.h, faces, i);
    GEOSGeometry *inside = face ? g.GEOSPointOnSurface_r(g.h, face) : NULL;
    double x = 0, y = 0;
    ok = inside && g.GEOSGeomGetX_r(g.h, inside, &x) == 1 && g.GEOSGeomGetY_r(g.h, inside, &y) == 1;
    g.GEOSGeom_destroy_r(g.h, inside);
    if (!ok || chain_winding(edges, count, x, y) == 0) continue;
    kept[keep] = g.GEOSUnaryUnion_r(g.h, face); /* the union of a single face is a copy of the face, which belongs to
                                                 * this function */
    ok = kept[keep] != NULL;
    keep += ok;
  }
  if (ok) all = geos_collect(&g, GEOS_GEOMETRYCOLLECTION, kept, keep);
  else geos_drop(&g, kept, keep);
  if (all) all = geos_unite(&g, all);
  ok = (all && geos_result(&g, all, out)) || geos_failed(&g, purpose, e);
  g.GEOSGeom_destroy_r(g.h, all);
  g.GEOSGeom_destroy_r(g.h, faces);
  g.GEOSGeom_destroy_r(g.h, noded);
  free(kept);
  free(lines);
  geos_close(&g);
  if (!ok) vs_area_free(out);
  return ok;
}

/* ---- outlines ---- */

bool vs_area_of_outline(const vs_outline *o, const vs_affine *frame, vs_area *out) {
  vs_vec3 x = { frame->m[0][0], frame->m[1][0], frame->m[2][0] },
          y = { frame->m[0][1], frame->m[1][1], frame->m[2][1] };
  vs_vec3 origin = { frame->m[0][3], frame->m[1][3], frame->m[2][3] };
  bool ok = true;
  for (size_t l = 0; ok && l < o->count; l++) {
    size_t first = out->count;
    for (size_t i = 0; ok && i < o->loops[l].count; i++) {
      vs_vec3 d = vs_v3_sub(o->loops[l].at[i], origin);
      ok = vs_area_point(out, vs_v3_dot(d, x), vs_v3_dot(d, y));
    }
    ok = ok && area_close(out, first, o->hole[l]);
  }
  return ok;
}

bool vs_area_outline(const vs_area *a, const vs_affine *frame, vs_outline *out) {
  *out = (vs_outline){ .frame = *frame,
                       .normal = { frame->m[0][2], frame->m[1][2], frame->m[2][2] },
                       .point = { frame->m[0][3], frame->m[1][3], frame->m[2][3] } };
  out->loops = vs_zeros(a->loop_count + 1, sizeof *out->loops);
  out->hole = vs_zeros(a->loop_count + 1, sizeof *out->hole);
  bool ok = out->loops && out->hole;
  for (size_t l = 0, first = 0; ok && l < a->loop_count; first += a->size[l++]) {
    vs_polyline *p = &out->loops[l];
    p->at = vs_fresh(a->size[l], sizeof *p->at);
    ok = p->at != NULL;
    p->room = p->count = ok ? a->size[l] : 0;
    p->closed = true;
    for (size_t i = 0; ok && i < p->count; i++)
      p->at[i] = vs_affine_point(frame, vs_v3(a->at[first + i].x, a->at[first + i].y, 0));
    out->hole[l] = a->hole[l];
    out->count = l + 1;
  }
  if (!ok) vs_outline_free(out);
  return ok;
}

/* ---- triangulations of points ---- */

typedef struct {
  vs_vec2 at;
  uint32_t number;
} numbered;

static int compare_numbered(const void *p, const void *q) {
  const numbered *a = p, *b = q;
  if (a->at.x != b->at.x) return a->at.x < b->at.x ? -1 : 1;
  if (a->at.y != b->at.y) return a->at.y < b->at.y ? -1 : 1;
  return a->number < b->number ? -1 : a->number > b->number;
}

/* Sets *out to the index of the first point with the coordinates (x, y), which GEOS returns unchanged. Returns false if
 * there is no such point. */
static bool number_at(const numbered *all, size_t n, double x, double y, uint32_t *out) {
  size_t low = 0, high = n;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (all[middle].at.x < x || (all[middle].at.x == x && all[middle].at.y < y))
      low = middle + 1;
    else
      high = middle;
  }
  if (low == n || all[low].at.x != x || all[low].at.y != y) return false;
  *out = all[low].number;
  return true;
}

/* Stores a triangle of GEOS's triangulation in `out` as three indices of points, counter-clockwise. Returns false if
 * `part` is not a triangle of the points. */
static bool delaunay_triangle(vs_geos *g, const GEOSGeometry *part, const numbered *all, size_t n, const vs_vec2 *at,
                              uint32_t out[3]) {
  const GEOSGeometry *ring = part ? g->GEOSGetExteriorRing_r(g->h, part) : NULL;
  const GEOSCoordSequence *s = ring ? g->GEOSGeom_getCoordSeq_r(g->h, ring) : NULL;
  for (unsigned i = 0; i < 3; i++) {
    double x, y;
    if (!s || g->GEOSCoordSeq_getXY_r(g->h, s, i, &x, &y) != 1 || !number_at(all, n, x, y, &out[i])) return false;
  }
  vs_vec2 a = at[out[0]], b = at[out[1]], c = at[out[2]];
  if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) < 0) {
    uint32_t swap = out[1];
    out[1] = out[2], out[2] = swap;
  }
  return true;
}

bool vs_points_delaunay(const vs_vec2 *at, size_t n, uint32_t (**out)[3], size_t *count, vs_error *e) {
  static const char *const purpose = "triangulations of points";
  vs_geos g;
  numbered *all = NULL;
  size_t all_room = 0, room = 0;
  VS_ASSERT(n >= 2);
  *out = NULL, *count = 0;
  if (!geos_open(&g, purpose, e)) return false;
  bool ok = VS_GROW(all, all_room, n + 1) || vs_error_memory(e, NULL);
  for (size_t i = 0; ok && i < n; i++) all[i] = (numbered){ at[i], (uint32_t)i };
  if (ok) qsort(all, n, sizeof *all, compare_numbered);
  GEOSCoordSequence *s = ok ? geos_sequence(&g, at, n, false) : NULL;
  GEOSGeometry *line = s ? g.GEOSGeom_createLineString_r(g.h, s) : NULL;
  GEOSGeometry *triangles = line ? g.GEOSDelaunayTriangulation_r(g.h, line, 0, 0) : NULL;
  int parts = triangles ? g.GEOSGetNumGeometries_r(g.h, triangles) : -1;
  if (ok && parts < 0) ok = geos_failed(&g, purpose, e);
  if (ok && parts > 0) ok = VS_GROW(*out, room, (size_t)parts) || vs_error_memory(e, NULL);
  for (int i = 0; ok && i < parts; i++)
    if (delaunay_triangle(&g, g.GEOSGetGeometryN_r(g.h, triangles, i), all, n, at, (*out)[*count])) (*count)++;
  if (triangles) g.GEOSGeom_destroy_r(g.h, triangles);
  if (line) g.GEOSGeom_destroy_r(g.h, line);
  geos_close(&g);
  free(all);
  return ok;
}
