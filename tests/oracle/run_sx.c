/* Evaluates .sx files with the kernel. For each file it prints the volume, the number of triangles, whether the mesh is
 * closed, and the time in seconds.
 *
 * usage: run_sx [-t threads] [-g] [-o out.stl] FILE...
 *
 * -g also prints the longest time between two calls of the progress callback, in processor time of the calling thread,
 * and the completed fraction at that time. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "tests/oracle/sx.h"

static char *slurp(const char *path) {
  FILE *f = fopen(path, "rb");
  if (!f) return NULL;
  size_t n = 0, room = 1 << 16;
  char *text = malloc(room);
  for (size_t got; text && (got = fread(text + n, 1, room - n - 1, f)) > 0;) {
    n += got;
    if (room - n < 2) text = realloc(text, room *= 2);
  }
  if (text) text[n] = 0;
  fclose(f);
  return text;
}

typedef struct { double last, longest, done, at; } gaps;
static double cpu(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
static bool watch(void *context, const char *stage, double done) {
  (void)stage;
  gaps *g = context;
  double now = cpu();
  if (now - g->last > g->longest) g->longest = now - g->last, g->at = g->done;
  g->last = now;
  g->done = done;
  return true;
}

int main(int argc, char **argv) {
  const char *stl = NULL;
  vs_kernel_options options = { .threads = 0 };
  int failures = 0;
  gaps g = { 0 };
  vs_job job = { .context = &g };
  for (int i = 1; i < argc; i++) {
    if (!strcmp(argv[i], "-o") && i + 1 < argc) { stl = argv[++i]; continue; }
    if (!strcmp(argv[i], "-g")) { job.going = watch, options.job = &job; continue; }
    if (!strcmp(argv[i], "-t") && i + 1 < argc) { options.threads = (uint32_t)atoi(argv[++i]); continue; }
    char *text = slurp(argv[i]);
    sx_problem p;
    if (!text || !sx_parse(text, &p)) { fprintf(stderr, "%s: cannot read\n", argv[i]); return 2; }
    vs_mesh m = { 0 };
    vs_kernel_error e;
    struct timespec a, b;
    g = (gaps){ .last = cpu() };
    clock_gettime(CLOCK_MONOTONIC, &a);
    bool fine = vs_kernel_evaluate(&p.problem, &options, &m, &e), sure = true;
    clock_gettime(CLOCK_MONOTONIC, &b);
    if (fine) {
      bool closed = vs_mesh_closed(&m, &sure);
      watch(&g, NULL, 1);
      if (options.job) printf("longest gap %.1f ms, at %.3f; ", 1e3 * g.longest, g.at);
      printf("%s volume %.12g triangles %zu %s %.3f s\n", argv[i], vs_mesh_volume(&m), m.triangle_count, closed ? "closed" : "OPEN",
             (double)(b.tv_sec - a.tv_sec) + 1e-9 * (double)(b.tv_nsec - a.tv_nsec));
      failures += !closed;
      if (stl && !sx_write_stl(&m, stl)) fprintf(stderr, "cannot write %s\n", stl);
    } else {
      printf("%s ERROR leaf %u: %s\n", argv[i], e.leaf, e.message);
      failures++;
    }
    fflush(stdout);
    vs_mesh_free(&m);
    sx_free(&p);
    free(text);
  }
  return failures != 0;
}
