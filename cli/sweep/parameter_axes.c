/* Reads --set of `vs sweep`. */
#include "cli/sweep/parameter_axes.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/sweep/set_files.h"
#include "model/store/array.h"

enum { NUMBER_ROOM = 40, DIGITS = 15 };

void sweep_write_number(double x, int digits, char out[NUMBER_ROOM]) {
  if (x == floor(x) && fabs(x) < 1e15) snprintf(out, NUMBER_ROOM, "%.0f", x + 0.0);
  else snprintf(out, NUMBER_ROOM, "%.*g", digits, x);
}

bool sweep_axis_put(sweep_axis *axis, sweep_set set) {
  if (!VS_GROW(axis->sets, axis->room, axis->count + 1)) return sweep_no_memory();
  axis->sets[axis->count++] = set;
  return true;
}

void sweep_axes_free(sweep_axes *a) {
  for (size_t i = 0; i < a->count; i++) free(a->at[i].sets);
  free(a->at);
  a->at = NULL, a->count = a->room = 0;
}

static bool wrong(const char *text, const char *why) {
  return fprintf(stderr, "vs sweep: --set %s: %s\n", text, why), false;
}

static bool read_number(const char *text, size_t length, double *out) {
  char copy[NUMBER_ROOM], *end;
  if (!length || length >= sizeof copy) return false;
  memcpy(copy, text, length), copy[length] = 0;
  *out = strtod(copy, &end);
  return !*end && isfinite(*out) && *copy != ' ';
}

static bool put_value(sweep_axes *a, sweep_axis *axis, const char *name, const char *value, size_t length) {
  sweep_setting *s = sweep_keep(a->memory, 1, sizeof *s);
  char *kept = s ? sweep_keep_text(a->memory, value, length) : NULL;
  if (!kept) return false;
  *s = (sweep_setting){name, kept};
  return sweep_axis_put(axis, (sweep_set){s, 1});
}

static bool put_number(sweep_axes *a, sweep_axis *axis, const char *name, double x) {
  char text[NUMBER_ROOM];
  sweep_write_number(x, DIGITS, text);
  return put_value(a, axis, name, text, strlen(text));
}

/* A range as typed: FROM..TO, followed by :STEP or /COUNT. */
typedef struct { double from, to, step; long count; char kind; } range;

/* Returns true if the item begins with FROM.. and is therefore a range, or a mistake in one. *good: whether it is
 * complete. The two dots are searched first, since strtod would read one of them as a decimal point. */
static bool read_range(const char *item, size_t length, range *r, bool *good) {
  const char *end = item + length, *dots = item;
  while (dots + 1 < end && !(dots[0] == '.' && dots[1] == '.')) dots++;
  *r = (range){0};
  if (dots + 1 >= end || !read_number(item, (size_t)(dots - item), &r->from)) return false;
  const char *to = dots + 2, *mark = to;
  while (mark < end && *mark != ':' && *mark != '/') mark++;
  *good = read_number(to, (size_t)(mark - to), &r->to);
  if (mark == end) return true;
  double more = 0;
  *good = *good && read_number(mark + 1, (size_t)(end - mark - 1), &more);
  r->kind = *mark, r->step = more, r->count = fabs(more) <= SWEEP_MOST ? (long)more : 0;
  if (r->kind == '/') *good = *good && more == floor(more) && r->count >= 1;
  else *good = *good && more != 0 && (r->to - r->from) * more >= 0;
  return true;
}

static bool put_range(sweep_axes *a, sweep_axis *axis, const char *name, const range *r) {
  bool ok = true;
  if (r->kind == '/') {
    for (long i = 0; ok && i < r->count; i++)
      ok = put_number(a, axis, name,
                      i + 1 < r->count || r->count == 1
                          ? r->from + (r->to - r->from) * (double)i / (double)(r->count > 1 ? r->count - 1 : 1)
                          : r->to);
    return ok;
  }
  double steps = floor((r->to - r->from) / r->step + 1e-9);
  if (steps >= SWEEP_MOST)
    return fprintf(stderr, "vs sweep: --set %s: the range has more than %d values\n", name, SWEEP_MOST), false;
  for (long i = 0; ok && i <= (long)steps; i++) ok = put_number(a, axis, name, r->from + r->step * (double)i);
  return ok;
}

/* Returns the length of the item of a list, which ends at a comma outside of brackets. */
static size_t item_length(const char *at) {
  const char *from = at;
  for (int depth = 0; *at && (*at != ',' || depth > 0); at++) {
    if (*at == '(') depth++;
    else if (*at == ')') depth--;
  }
  return (size_t)(at - from);
}

/* Reads one item of the values of a parameter: a value or a range. */
static bool put_item(sweep_axes *a, sweep_axis *axis, const char *name, const char *item, size_t length, bool sampled) {
  range r;
  bool good = true;
  if (!read_range(item, length, &r, &good)) return put_value(a, axis, name, item, length);
  if (!good) {
    fprintf(stderr,
            "vs sweep: --set %s=%.*s: expected FROM..TO:STEP, as in 1..10:2, or FROM..TO/COUNT, as in 0..1/8\n",
            name, (int)length, item);
    return false;
  }
  if (r.kind) return put_range(a, axis, name, &r);
  if (!sampled || axis->count || item[length]) {
    fprintf(stderr,
            "vs sweep: --set %s=%.*s: the range has no steps: write %s=%.*s:1 for steps of 1, %s=%.*s/5 for 5 values, "
            "or let --sample choose\n",
            name, (int)length, item, name, (int)length, item, name, (int)length, item);
    return false;
  }
  axis->range = name, axis->from = r.from, axis->to = r.to;
  return true;
}

static bool has_name(const sweep_axes *a, const char *name) {
  for (size_t i = 0; i < a->count; i++) {
    const sweep_axis *axis = &a->at[i];
    if (axis->range && !strcmp(axis->range, name)) return true;
    for (size_t k = 0; k < axis->count; k++)
      for (size_t n = 0; n < axis->sets[k].count; n++)
        if (!strcmp(axis->sets[k].at[n].name, name)) return true;
  }
  return false;
}

/* Reads "NAME=ITEM,ITEM,..." up to the next item with a '=' outside of brackets, which begins another parameter. */
static bool read_parameter(sweep_axes *a, const char *text, const char **at, bool sampled) {
  size_t length = item_length(*at);
  const char *equals = memchr(*at, '=', length);
  char *name = equals && equals > *at ? sweep_keep_text(a->memory, *at, (size_t)(equals - *at)) : NULL;
  if (!equals || equals == *at) return wrong(text, "expected NAME=VALUES, as in n=1..10:2");
  if (!name) return false;
  if (has_name(a, name)) return wrong(text, "another --set has values for this parameter; give all in one");
  if (!VS_GROW(a->at, a->room, a->count + 1)) return sweep_no_memory();
  sweep_axis *axis = &a->at[a->count++];
  *axis = (sweep_axis){0};
  for (const char *item = equals + 1;;) {
    size_t n = item_length(item);
    if (!n) return wrong(text, "a value is empty");
    if (!put_item(a, axis, name, item, n, sampled)) return false;
    *at = item + n;
    if (!**at) return true;
    item = ++*at;
    size_t next = item_length(item);
    const char *sign = memchr(item, '=', next), *bracket = memchr(item, '(', next);
    if (sign && (!bracket || sign < bracket)) return true;
  }
}

static bool add_file(sweep_axes *a, const char *path) {
  sweep_axis axis = {0};
  bool ok = sweep_set_file_read(a->memory, path, &axis);
  for (size_t k = 0; ok && k < axis.count; k++)
    for (size_t n = 0; ok && n < axis.sets[k].count; n++)
      if (has_name(a, axis.sets[k].at[n].name)) {
        fprintf(stderr, "vs sweep: --set %s: another --set has values for its parameter %s\n", path,
                axis.sets[k].at[n].name);
        ok = false;
      }
  if (ok && !VS_GROW(a->at, a->room, a->count + 1)) ok = sweep_no_memory();
  if (ok) a->at[a->count++] = axis;
  else free(axis.sets);
  return ok;
}

bool sweep_axes_add(sweep_axes *a, const char *text, bool sampled) {
  if (sweep_is_set_file(text)) return add_file(a, text);
  for (const char *at = text; *at;)
    if (!read_parameter(a, text, &at, sampled)) return false;
  return true;
}
