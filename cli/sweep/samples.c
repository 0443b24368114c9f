/* Chooses the sets of a sweep. The Sobol sequence is that of the library NLopt, which is loaded for it. */
#include "cli/sweep/samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/dynamic.h"
#include "model/store/array.h"

enum { SAMPLE_DIGITS = 9 };

bool sweep_sample_read(const char *text, sweep_sample *out) {
  static const struct {
    const char *name;
    sweep_sampling how;
  } names[] = { { "lhs:", SWEEP_LATIN }, { "sobol:", SWEEP_SOBOL } };
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    size_t n = strlen(names[i].name);
    if (strncmp(text, names[i].name, n) != 0) continue;
    char *end;
    long count = strtol(text + n, &end, 10);
    out->how = names[i].how, out->count = (size_t)count;
    return end != text + n && !*end && count >= 1 && count <= SWEEP_MOST;
  }
  return false;
}

/* ---- sets ---- */

/* Joins one choice from each axis to a set of parameters. */
static bool join(const sweep_axes *a, const sweep_set *choices, sweep_set *out) {
  size_t count = 0;
  for (size_t i = 0; i < a->count; i++) count += choices[i].count;
  sweep_setting *at = sweep_keep(a->memory, count ? count : 1, sizeof *at);
  *out = (sweep_set){at, 0};
  for (size_t i = 0; at && i < a->count; i++)
    for (size_t k = 0; k < choices[i].count; k++) at[out->count++] = choices[i].at[k];
  return at != NULL;
}

static bool too_many(void) {
  fprintf(stderr, "vs sweep: the combinations are more than %d; --sample lhs:500 runs 500 of them\n", SWEEP_MOST);
  return false;
}

/* Lists every combination; the last axis changes first. */
static bool combine(const sweep_axes *a, sweep_set *choices, sweep_set **sets, size_t *count) {
  size_t all = 1;
  for (size_t i = 0; i < a->count; i++) {
    if (all > SWEEP_MOST / a->at[i].count) return too_many();
    all *= a->at[i].count;
  }
  *sets = sweep_keep(a->memory, all, sizeof **sets);
  for (size_t n = 0; *sets && n < all; n++) {
    size_t rest = n;
    for (size_t i = a->count; i-- > 0; rest /= a->at[i].count) choices[i] = a->at[i].sets[rest % a->at[i].count];
    if (!join(a, choices, &(*sets)[n])) return false;
  }
  *count = all;
  return *sets != NULL;
}

/* Returns the choice at position u of the axis, where u is at least 0 and less than 1. Stores a choice from a range in
 * *own. */
static bool choice_at(const sweep_axes *a, const sweep_axis *axis, double u, sweep_set *out) {
  if (!axis->range) {
    size_t i = (size_t)(u * (double)axis->count);
    return *out = axis->sets[i < axis->count ? i : axis->count - 1], true;
  }
  char text[40];
  sweep_write_number(axis->from + (axis->to - axis->from) * u, SAMPLE_DIGITS, text);
  sweep_setting *own = sweep_keep(a->memory, 1, sizeof *own);
  if (!own || !(own->value = sweep_keep_text(a->memory, text, strlen(text)))) return false;
  own->name = axis->range;
  *out = (sweep_set){own, 1};
  return true;
}

/* ---- random numbers ---- */

/* Returns the next number of SplitMix64 (Steele, Lea, Flood, 2014), from 0 to below 1. */
static double next_random(uint64_t *state) {
  uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* Fills points[i * axes + k] for point i and axis k by a Latin hypercube. */
static bool latin(const sweep_sample *s, size_t axes, double *points) {
  size_t *order;
  uint64_t state = s->seed;
  if (!VS_FRESH(order, s->count)) return sweep_no_memory();
  for (size_t k = 0; k < axes; k++) {
    for (size_t i = 0; i < s->count; i++) order[i] = i;
    for (size_t i = s->count; i-- > 1;) {
      size_t other = (size_t)(next_random(&state) * (double)(i + 1)), was = order[i];
      order[i] = order[other], order[other] = was;
    }
    for (size_t i = 0; i < s->count; i++)
      points[i * axes + k] = ((double)order[i] + next_random(&state)) / (double)s->count;
  }
  free(order);
  return true;
}

/* ---- the Sobol sequence ---- */

/* NLopt's generator, which its library exports and its header does not declare. */
typedef struct nlopt_soboldata_s nlopt_sobol_state;

#define FUNCTIONS(F)                                                                  \
  F(begin, nlopt_sobol_create, nlopt_sobol_state *, (unsigned))                       \
  F(next, nlopt_sobol_next01, void, (nlopt_sobol_state *, double *))                  \
  F(end, nlopt_sobol_destroy, void, (nlopt_sobol_state *))
VS_DYNAMIC_FUNCTIONS(FUNCTIONS);
enum { SOBOL_AXES = 1111 }; /* greatest number of axes of NLopt's generator */

/* Fills points as `latin` does. With a seed other than 0, moves all points by one random vector around the torus. */
static bool sobol(const sweep_sample *s, size_t axes, double *points) {
  dynamic_functions f;
  vs_error e = {0};
  uint64_t state = s->seed;
  if (!vs_dynamic_load(VS_LIBRARY_NLOPT, "--sample sobol", dynamic_names, sizeof dynamic_names / sizeof *dynamic_names,
                       &f, &e))
    return fprintf(stderr, "vs sweep: %s\n", e.message), false;
  if (axes > SOBOL_AXES)
    return fprintf(stderr, "vs sweep: a Sobol sequence has at most %d parameters; --sample lhs:%zu has no limit\n",
                   SOBOL_AXES, s->count), false;
  nlopt_sobol_state *q = f.begin((unsigned)axes);
  if (!q) return sweep_no_memory();
  for (size_t i = 0; i < s->count; i++) f.next(q, points + i * axes);
  f.end(q);
  for (size_t k = 0; s->seed && k < axes; k++) {
    double by = next_random(&state);
    for (size_t i = 0; i < s->count; i++) points[i * axes + k] = fmod(points[i * axes + k] + by, 1);
  }
  return true;
}

/* ---- choosing ---- */

static bool sample(const sweep_axes *a, const sweep_sample *s, sweep_set *choices, sweep_set **sets, size_t *count) {
  double *points;
  if (!VS_FRESH(points, s->count * a->count)) return sweep_no_memory();
  bool ok = s->how == SWEEP_LATIN ? latin(s, a->count, points) : sobol(s, a->count, points);
  *sets = ok ? sweep_keep(a->memory, s->count, sizeof **sets) : NULL;
  ok = *sets != NULL;
  for (size_t i = 0; ok && i < s->count; i++) {
    for (size_t k = 0; ok && k < a->count; k++) ok = choice_at(a, &a->at[k], points[i * a->count + k], &choices[k]);
    ok = ok && join(a, choices, &(*sets)[i]);
  }
  *count = s->count;
  free(points);
  return ok;
}

bool sweep_choose(const sweep_axes *a, const sweep_sample *s, sweep_set **sets, size_t *count) {
  sweep_set *choices;
  if (!VS_FRESH(choices, a->count)) return sweep_no_memory();
  bool ok = s->how == SWEEP_ALL ? combine(a, choices, sets, count) : sample(a, s, choices, sets, count);
  free(choices);
  return ok;
}
