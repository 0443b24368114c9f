/* Tests the reading of mesh files and the repair of their meshes: one cube in every format, thousands of damaged copies
 * of each file, and broken solids. An argument multiplies the number of damaged copies. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/files/polyface.h"
#include "geometry/files/repair.h"
#include "geometry/primitives/solid_triangles.h"

static size_t rounds = 1;

static uint64_t drawn(uint64_t *seed) { /* returns a random number by xorshift, equal in every run */
  *seed ^= *seed << 13;
  *seed ^= *seed >> 7;
  *seed ^= *seed << 17;
  return *seed >> 11;
}

typedef struct { const char *name; unsigned char bytes[4096]; size_t size; } sample;

static void put(sample *s, const void *bytes, size_t size) {
  memcpy(s->bytes + s->size, bytes, size);
  s->size += size;
}
static void say(sample *s, const char *text) { put(s, text, strlen(text)); }
static void put_float(sample *s, double x) {
  float f = (float)x;
  put(s, &f, sizeof f); /* writes the four bytes of f as they are in memory: the formats are little-endian, and so are
                         * the machines on which the tests run */
}

static const unsigned char quads[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };

enum { SAMPLES = 9, WORD_STRIPS = 7, BYTE_STRIPS };

/* Writes the cube as three triangle strips; each strip covers two opposite sides. A repeated corner reverses the
 * strip's orientation, and -1 begins another strip. */
static void put_strips(sample *s, bool bytes) {
  int32_t corners[32];
  size_t count = 0;
  for (int f = 0; f < 6; f += 2) {
    const unsigned char *p = quads[f], *q = quads[f + 1];
    const int32_t strip[10] = { p[0], p[1], p[3], p[2], p[2], q[0], q[0], q[1], q[3], q[2] };
    if (f > 0) corners[count++] = -1;
    for (int k = 0; k < 10; k++) corners[count++] = strip[k];
  }
  if (bytes) put(s, &(int32_t){ (int32_t)count }, 4), put(s, corners, 4 * count);
  else say(s, "32");
  for (size_t k = 0; !bytes && k < count; k++) {
    char word[16];
    snprintf(word, sizeof word, " %d", (int)corners[k]), say(s, word);
  }
}

static sample make(int which) {
  sample s = { .size = 0 };
  char line[128];
  bool strips = which >= WORD_STRIPS, bytes = which == 5 || which == BYTE_STRIPS;
  static const char *const names[] = { "words.stl", "bytes.stl", "a.obj", "b.off", "words.ply", "little.ply", "colour.OFF", "strips.ply", "little-strips.ply" };
  s.name = names[which];
  if (which == 0) say(&s, "solid a cube of one\n");
  if (which == 1) {
    say(&s, "solid, though in bytes");
    memset(s.bytes + s.size, 0, 80 - s.size);
    s.size = 80;
    put(&s, &(uint32_t){ 12 }, 4);
  }
  if (which == 3) say(&s, "OFF # a cube\n8 6 12\n");
  if (which == 6) say(&s, "COFF\n8 6 0\n");
  if (which == 4 || which == 5 || strips) {
    say(&s, "ply\nformat ");
    say(&s, bytes ? "binary_little_endian" : "ascii");
    say(&s, " 1.0\ncomment made by hand\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n");
    say(&s, strips ? "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                   : "element face 6\nproperty list uchar int vertex_indices\nend_header\n");
  }
  for (int i = 0; i < 8 && which > 1; i++) {
    double x = i & 1, y = i >> 1 & 1, z = i >> 2;
    if (bytes) put_float(&s, x), put_float(&s, y), put_float(&s, z), put(&s, "\xff", 1);
    else snprintf(line, sizeof line, "%s%g %g %g%s\n", which == 2 ? "v " : "", x, y, z, which == 4 || strips ? " 255" : which == 6 ? " 1 0 0 1" : ""), say(&s, line);
  }
  if (strips) put_strips(&s, bytes);
  for (int f = 0; f < 6 && !strips; f++) {
    const unsigned char *q = quads[f];
    if (which < 2)
      for (int half = 0; half < 2; half++) {
        unsigned char t[3] = { q[0], q[half + 1], q[half + 2] };
        if (which == 0) say(&s, "facet normal nan 0 0\n outer loop\n");
        else for (int k = 0; k < 3; k++) put_float(&s, 0);
        for (int k = 0; k < 3; k++) {
          double x = t[k] & 1, y = t[k] >> 1 & 1, z = t[k] >> 2;
          if (which == 0) snprintf(line, sizeof line, "  vertex %g %g %g\n", x, y, z), say(&s, line);
          else put_float(&s, x), put_float(&s, y), put_float(&s, z);
        }
        if (which == 0) say(&s, " endloop\nendfacet\n");
        else put(&s, "\0\0", 2);
      }
    else if (which == 2) snprintf(line, sizeof line, f % 2 ? "f %d/1/2 %d/3 \\\n %d//4 %d # side\n" : "f %d %d %d %d\n", q[0] + 1, q[1] + 1, f == 2 ? q[2] - 8 : q[2] + 1, q[3] + 1), say(&s, line);
    else if (which == 5) {
      put(&s, "\4", 1);
      for (int k = 0; k < 4; k++) put(&s, &(int32_t){ q[k] }, 4);
    } else snprintf(line, sizeof line, "4 %d %d %d %d%s\n", q[0], q[1], q[2], q[3], which == 4 ? "" : " 1 0 0"), say(&s, line);
  }
  if (which == 0) say(&s, "endsolid a cube of one\n");
  return s;
}

/* Returns the volume enclosed by a list of triangles, which must form a closed surface. */
static double chain_volume(const vs_face_list *l) {
  vs_mesh m = { 0 };
  for (size_t i = 0; i < l->point_count; i++) assert_true(vs_mesh_add_vertex(&m, l->points[i], NULL));
  for (size_t f = 0; f < l->face_count; f++)
    for (uint32_t c = l->starts[f] + 1; c + 1 < l->starts[f + 1]; c++) assert_true(vs_mesh_add_triangle(&m, l->corners[l->starts[f]], l->corners[c], l->corners[c + 1]));
  assert_true(vs_mesh_closed(&m, NULL));
  double volume = vs_mesh_volume(&m);
  vs_mesh_free(&m);
  return volume;
}

static void every_format(void **state) {
  (void)state;
  for (int which = 0; which < SAMPLES; which++) {
    sample s = make(which);
    vs_face_list l = { 0 };
    vs_error e = { 0 };
    vs_open_edges open;
    if (!vs_mesh_file_read(&(vs_file_bytes){ s.name, s.bytes, s.size }, (vs_poller){ 0 }, &l, &e)) fail_msg("%s", e.message);
    assert_int_equal(l.face_count, which < 2 || which >= WORD_STRIPS ? 12 : 6);
    assert_true(vs_face_list_compact(&l));
    assert_int_equal(l.point_count, 8);
    assert_true(vs_face_list_open(NULL, &l, &open, NULL) && open.count == 0);
    assert_true(chain_volume(&l) == 1);
    vs_face_list_free(&l);
  }
}

static void damaged_files(void **state) {
  (void)state;
  uint64_t seed = 88172645463325252u;
  size_t read = 0, refused = 0;
  for (size_t round = 0; round < 400 * rounds; round++)
    for (int which = 0; which < SAMPLES; which++) {
      sample s = make(which);
      for (uint64_t n = 1 + drawn(&seed) % 4; n > 0; n--) {
        size_t at = (size_t)(drawn(&seed) % s.size);
        switch (drawn(&seed) % 7) {
          case 0: s.bytes[at] = (unsigned char)drawn(&seed); break;
          case 1: s.bytes[at] ^= (unsigned char)(1u << drawn(&seed) % 8); break;
          case 2: s.size = at + 1; break;
          case 3: memmove(s.bytes + at, s.bytes + at + 1, s.size - at - 1), s.size -= s.size > 1; break;
          case 4: s.bytes[at] = (unsigned char)"0123456789-. \nef"[drawn(&seed) % 16]; break;
          case 5: if (at + 4 < s.size) memset(s.bytes + at, drawn(&seed) % 2 ? 0xff : 0x7f, 4); break;
          default: { /* overwrites a random place of the file with another piece of the file */
            size_t from = (size_t)(drawn(&seed) % s.size), size = (size_t)(drawn(&seed) % 40);
            if (from + size < s.size && at + size < s.size) memmove(s.bytes + at, s.bytes + from, size);
          }
        }
      }
      unsigned char *exact = malloc(s.size); /* a block of exactly the file's size, so that a sanitizer finds reads past
                                              * its end */
      memcpy(exact, s.bytes, s.size);
      vs_face_list l = { 0 };
      vs_error e = { 0 };
      if (vs_mesh_file_read(&(vs_file_bytes){ s.name, exact, s.size }, (vs_poller){ 0 }, &l, &e)) {
        vs_repair_notes notes;
        vs_open_edges open;
        read++;
        assert_true(vs_face_list_open(NULL, &l, &open, NULL));
        assert_true(vs_face_list_repair(NULL, &l, &notes, NULL));
        if (l.face_count) chain_volume(&l);
      } else {
        assert_true(e.kind == VS_ERROR_MODEL && !strncmp(e.message, s.name, strlen(s.name)));
        refused++;
      }
      vs_face_list_free(&l);
      free(exact);
    }
  assert_true(read > 300 && refused > 300);
}

static vs_face_list list_of(const vs_mesh *m) {
  vs_face_list l = { 0 };
  for (size_t i = 0; i < m->vertex_count; i++) assert_true(vs_face_list_point(&l, m->vertices[i]));
  for (size_t i = 0; i < m->triangle_count; i++) {
    for (int k = 0; k < 3; k++) assert_true(vs_face_list_corner(&l, m->triangles[i][k]));
    assert_true(vs_face_list_close(&l));
  }
  return l;
}

/* Tests balls with missing, reversed and duplicated faces, and with vertices that are split in two. After the repair,
 * the volume must be nearly that of the ball. */
static void broken_solids(void **state) {
  (void)state;
  uint64_t seed = 5;
  for (size_t round = 0; round < 60 * rounds; round++) {
    vs_mesh ball = { 0 }, hollow = { 0 };
    vs_repair_notes notes;
    assert_true(vs_solid_sphere(&ball, vs_v3(100, 0, 0), 1, 32));
    double volume = vs_mesh_volume(&ball);
    vs_face_list whole = list_of(&ball), l = { 0 };
    if (round % 3 == 0) { /* adds a second, inner shell: a cavity */
      assert_true(vs_solid_sphere(&hollow, vs_v3(100, 0, 0), 0.5, 32));
      volume -= vs_mesh_volume(&hollow);
      for (size_t i = 0; i < hollow.triangle_count; i++) {
        for (int k = 2; k >= 0; k--) assert_true(vs_face_list_point(&whole, hollow.vertices[hollow.triangles[i][k]]) && vs_face_list_corner(&whole, (uint32_t)whole.point_count - 1));
        assert_true(vs_face_list_close(&whole));
      }
    }
    size_t dropped = 0;
    bool first = true;
    for (size_t f = 0; f < whole.face_count; f++) {
      /* the first face of each shell is never damaged, because the repair orients the shell by it */
      uint64_t fate = first || f == ball.triangle_count ? 99 : drawn(&seed) % 60;
      first = false;
      if (fate == 0 && dropped < 20) {
        dropped++;
        continue;
      }
      for (int again = 0; again < (fate == 1 ? 2 : 1); again++) {
        for (int k = 0; k < 3; k++) {
          vs_vec3 p = whole.points[whole.corners[whole.starts[f] + (fate == 2 ? 2 - (uint32_t)k : (uint32_t)k)]];
          p.x += (double)(drawn(&seed) % 3) * 1e-8;
          assert_true(vs_face_list_point(&l, p) && vs_face_list_corner(&l, (uint32_t)l.point_count - 1));
        }
        assert_true(vs_face_list_close(&l));
      }
    }
    assert_true(vs_face_list_repair(NULL, &l, &notes, NULL));
    double got = chain_volume(&l);
    if (fabs(got - volume) > 0.05) fail_msg("round %zu: volume %g, not %g: %zu welded, %zu dropped, %zu turned, %zu holes", round, got, volume, notes.welded, notes.dropped, notes.turned, notes.holes);
    assert_true(dropped == 0 || notes.holes > 0);
    vs_mesh_free(&ball);
    vs_mesh_free(&hollow);
    vs_face_list_free(&whole);
    vs_face_list_free(&l);
  }
}

int main(int argc, char **argv) {
  if (argc > 1) rounds = (size_t)strtoul(argv[1], NULL, 10);
  const struct CMUnitTest tests[] = { cmocka_unit_test(every_format), cmocka_unit_test(damaged_files), cmocka_unit_test(broken_solids) };
  return cmocka_run_group_tests_name("mesh files and mending", tests, NULL, NULL);
}
