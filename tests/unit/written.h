/* Contains what the tests of formats share: the text of a drawing in a format, and a folder for files. */
#ifndef VS_TESTS_WRITTEN_H
#define VS_TESTS_WRITTEN_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "backends/export.h"
#include "tests/unit/scenes.h"

/* ---- a sink that writes into memory ---- */

typedef struct { char *text; size_t used, room; } memory;

static inline bool memory_sink(void *context, const void *bytes, size_t count) {
  memory *m = context;
  if (m->used + count + 1 > m->room) {
    m->room = 2 * (m->used + count + 1);
    m->text = realloc(m->text, m->room);
    if (m->text == NULL) return false;
  }
  memcpy(m->text + m->used, bytes, count);
  m->used += count;
  m->text[m->used] = '\0';
  return true;
}

static int warnings;
static char last_warning[256];
static inline void count_warning(void *context, const vs_origin *origin, const char *message) {
  (void)context, (void)origin;
  warnings++;
  snprintf(last_warning, sizeof last_warning, "%s", message);
}

/* Returns the drawing in a format; the caller frees it. Returns NULL on failure, with the reason in e. */
static inline char *written_quietly(test_model *m, const char *format, size_t *length, vs_error *e) {
  memory out = { NULL, 0, 0 };
  vs_export_options options;
  vs_export_options_init(&options);
  vs_job job = { .warn = count_warning };
  options.job = &job;
  if (!vs_export_to(&m->scene, vs_export_format_find(format), memory_sink, &out, &options, e)) {
    free(out.text);
    return NULL;
  }
  if (length != NULL) *length = out.used;
  return out.text;
}

static inline char *written(test_model *m, const char *format) {
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  char *text = written_quietly(m, format, NULL, &e);
  if (text == NULL) fail_msg("%s: %s", format, e.message);
  return text;
}

static inline void assert_holds(const char *text, const char *part) {
  if (strstr(text, part) == NULL) fail_msg("no `%s` in:\n%.4000s", part, text);
}

static inline void assert_lacks(const char *text, const char *part) {
  if (strstr(text, part) != NULL) fail_msg("`%s` in:\n%.4000s", part, text);
}

/* ---- files ---- */

typedef struct { char folder[64], path[128]; } place;

static inline void place_open(place *p, const char *name) {
  snprintf(p->folder, sizeof p->folder, "/tmp/vs-test-XXXXXX");
  assert_non_null(mkdtemp(p->folder));
  snprintf(p->path, sizeof p->path, "%s/%s", p->folder, name);
}

static inline int place_files(place *p) {
  char command[256], answer[32] = "";
  snprintf(command, sizeof command, "ls -A %s | wc -l", p->folder);
  FILE *f = popen(command, "r");
  assert_non_null(f);
  assert_non_null(fgets(answer, sizeof answer, f));
  pclose(f);
  return atoi(answer);
}

static inline void place_close(place *p) {
  unlink(p->path);
  rmdir(p->folder);
}

static inline bool installed(const char *program) {
  char command[128];
  snprintf(command, sizeof command, "command -v %s > /dev/null 2>&1", program);
  if (system(command) == 0) return true;
  printf("skip: %s is not installed\n", program);
  return false;
}

#endif
