/* Divides a picture among runs (processes) of POV-Ray so that equal models give equal bytes. Each run has one thread.
 *
 * Several threads of a run gather bounced light in a random order, and each sample of a thread changes the next sample
 * of another thread. A run with a single thread has a fixed order. A picture with bounced light is therefore made in
 * two steps. The first pass, a small picture, gathers the light: the left and the right half of this picture are runs
 * of one thread, whose samples are joined in that order. In the second step each strip of the picture is a run of one
 * thread that reads these samples. The number and place of the strips do not depend on the number of processors. As
 * many runs work at a time as there are processors, which changes the time, but not the picture. A part of a picture is
 * cut out of the strips that it intersects.
 *
 * The exposure is computed from the first pass, so that a part has the exposure of the whole picture. A draft has no
 * bounced light, but strips too: for each lamp, a thread tests first the object that cast the last shadow, with a
 * smaller tolerance than all others. Pixels near edges thus depend on the pixels that the thread has drawn before.
 *
 * For a small picture, starting several runs would take longer than drawing. A single run of one thread makes it. */
#include "backends/povray/povray_plan.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "kernel/threads.h"

/* STRIP: approximate height in pixels of a strip, the part of the picture that a run renders. SMALL, SMALL_DRAFT:
 * number of pixels of a small picture, and of a draft that is a single run. QUICK: a draft's pixel takes an eighth of
 * the time of a pixel with bounced light. PASS_LEAST, PASS_MOST, PASS_MOST_FINAL: bounds of the longer side of the
 * first pass in pixels. */
enum {
  STRIP = 120,
  SMALL = 1 << 15,
  SMALL_DRAFT = 1 << 18,
  QUICK = 8,
  PASS_LEAST = 200,
  PASS_MOST = 400,
  PASS_MOST_FINAL = 800
};

static uint32_t between(uint32_t least, uint32_t x, uint32_t most) { return x < least ? least : x > most ? most : x; }

static void plan_passes(vs_povray_plan *p, vs_render_quality quality) {
  uint32_t side = p->columns > p->rows ? p->columns : p->rows;
  uint32_t most = quality == VS_RENDER_FINAL ? PASS_MOST_FINAL : PASS_MOST;
  uint32_t longer = between(PASS_LEAST, side / 2, most);
  if (longer > side) longer = side;
  uint32_t columns = between(1, (uint32_t)llround((double)p->columns * longer / side), longer);
  uint32_t rows = between(1, (uint32_t)llround((double)p->rows * longer / side), longer);
  p->pass_count = p->bounced && columns >= VS_POVRAY_PASSES ? VS_POVRAY_PASSES : 1;
  for (uint32_t i = 0; i < p->pass_count; i++) {
    uint32_t from = columns * i / (uint32_t)p->pass_count, to = columns * (i + 1) / (uint32_t)p->pass_count;
    p->jobs[p->count] = (vs_povray_job){ columns, rows, { from, 0, to - from, rows },
                                    .samples = p->bounced ? VS_SAMPLES_KEPT : VS_SAMPLES_OWN };
    snprintf(p->jobs[p->count].name, sizeof p->jobs[p->count].name, "pass%u", i);
    p->count++;
  }
}

/* Returns the number of strips of a picture whose scene is read quickly, before it is made even. */
static uint32_t most_strips(uint32_t columns, uint32_t rows) {
  return between(columns >= 2 * STRIP ? 2 : 1, rows / STRIP, VS_POVRAY_STRIPS);
}

uint32_t vs_povray_tile_top(uint32_t columns, uint32_t rows, uint32_t tiles, uint32_t tile) {
  uint64_t strips = most_strips(columns, rows) / 2 * 2, n = tiles, i = tile;
  if (strips <= 2 || n > rows / 2) return (uint32_t)(rows * i / n);
  if (n <= strips) return (uint32_t)(rows * (strips * i / n) / strips);
  /* tiles n*k/strips to n*(k+1)/strips divide strip k into equal parts */
  uint64_t k = (i * strips + strips - 1) / n, first = n * k / strips;
  while (first > i) first = n * --k / strips;
  if (k >= strips) return rows;
  uint64_t top = rows * k / strips, end = rows * (k + 1) / strips, parts = n * (k + 1) / strips - first;
  return (uint32_t)(top + (end - top) * (i - first) / parts);
}

/* Returns the number of strips of the picture, which is even. Every run of POV-Ray reads the whole scene, and the
 * number is limited so that reading takes at most a quarter of the time for drawing. */
static uint32_t strips_of(const vs_povray_plan *p, uint64_t triangles) {
  uint32_t most = most_strips(p->columns, p->rows);
  uint64_t count = 1 + (uint64_t)p->columns * p->rows / (p->bounced ? 1 : QUICK) / (triangles + 1);
  if (count < 2) count = 2;
  if (count > most) count = most;
  return count > 2 ? (uint32_t)count / 2 * 2 : (uint32_t)count;
}

/* Plans the strips that the selected part of the picture intersects. Two strips are the left and the right half of the
 * picture, because the sky takes less time than the ground. More strips are one above the other. */
static void plan_strips(vs_povray_plan *p, uint64_t triangles) {
  uint32_t count = strips_of(p, triangles), side = count == 2 ? p->columns : p->rows;
  uint32_t begin = count == 2 ? p->wanted.left : p->wanted.top;
  uint32_t end = begin + (count == 2 ? p->wanted.columns : p->wanted.rows);
  for (uint32_t i = 0; i < count; i++) {
    uint32_t from = side * i / count, to = side * (i + 1) / count;
    if (to <= begin || from >= end) continue;
    vs_povray_job *job = &p->jobs[p->count++];
    *job = (vs_povray_job){ p->columns, p->rows, { 0, from, p->columns, to - from }, .smooth = true,
                            .samples = p->bounced ? VS_SAMPLES_GIVEN : VS_SAMPLES_OWN };
    if (count == 2) job->part = (vs_exr_part){ from, 0, to - from, p->rows };
    snprintf(job->name, sizeof job->name, "strip%u", i);
  }
}

vs_povray_plan vs_povray_plan_of(const vs_export_options *o, uint64_t triangles, bool metered, bool alone) {
  vs_povray_plan p = { .columns = o->width > 0 ? (uint32_t)o->width : 1024,
                       .rows = o->height > 0 ? (uint32_t)o->height : 768,
                       .bounced = o->quality != VS_RENDER_DRAFT, .metered = metered };
  vs_exr_part all = { 0, 0, p.columns, p.rows };
  const int *c = o->crop;
  p.wanted = c[2] ? (vs_exr_part){ (uint32_t)c[0], (uint32_t)c[1], (uint32_t)c[2], (uint32_t)c[3] } : all;
  uint64_t pixels = (uint64_t)p.columns * p.rows;
  alone = (alone && p.bounced) || pixels <= SMALL;
  if (!alone && (p.bounced || metered)) plan_passes(&p, o->quality);
  if (!alone && (p.bounced || pixels > SMALL_DRAFT)) plan_strips(&p, triangles);
  else p.jobs[p.count++] = (vs_povray_job){ p.columns, p.rows, all, .smooth = true, .name = "whole" };
  return p;
}

/* Returns the machine's memory in bytes, or 0 if it is unknown. */
static double machine_memory(void) {
  long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? (double)pages * (double)page : 0;
}

/* POV-Ray keeps five single-precision numbers for each pixel of the entire picture, even if it draws only a part. */
static double picture_bytes(const vs_povray_job *job) { return 20. * job->columns * job->rows; }

double vs_povray_megabytes(const vs_povray_job *job) { return ceil(picture_bytes(job) / 1e6); }
bool vs_povray_fits(const vs_povray_job *job) { return picture_bytes(job) <= machine_memory() / 4; }

/* Returns the number of runs of POV-Ray that may work at a time. Each run needs about twenty times the size of the
 * scene's text as memory, and memory for the picture. */
size_t vs_povray_at_once(const vs_export_options *o, const vs_povray_job *job, uint64_t scene) {
  double each = 0x1p26 + 20. * (double)scene + (vs_povray_fits(job) ? picture_bytes(job) : 0);
  double room = machine_memory() / 2 / each;
  size_t threads = vs_kernel_threads(&(vs_kernel_options){ .threads = o->threads });
  return room < 1 ? 1 : room < (double)threads ? (size_t)room : threads;
}
