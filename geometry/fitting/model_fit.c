/* Runs the steps of a fit (model_fit.h). */
#include "geometry/fitting/model_fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/fitting/fit_candidates.h"
#include "geometry/fitting/fit_judgement.h"
#include "model/store/array.h"

#define FINE (1. / 50000) /* facet tolerance of the model's mesh in steps 3 and 4 of the fit, as a fraction of the
                           * diagonal of the model's box */

static bool run(vs_fit_search *f, vs_fit_place *places) {
  size_t count = 0;
  vs_fit_candidate best, second;
  const vs_fit_problem *p = f->p;
  for (size_t j = 0; j < f->numbers; j++)
    f->begin[0][j] = vs_fit_number_outer(&p->numbers[j], vs_fit_number_inner(&p->numbers[j], p->numbers[j].start));
  vs_fit_find_core(f);
  for (int core = f->core_count * 50 < p->count * 49; core >= 0 && !f->out->stopped; core--) {
    size_t found = 0;
    vs_fit_take_points(f, core);
    if (!vs_fit_find_starts(f, places + count, &found)) return false;
    count += found;
  }
  if (!count) return vs_error_set(f->e, VS_ERROR_INTERRUPT, NULL, "interrupted before anything was fitted");
  if (!vs_fit_from_places(f, places, count, &best, &second)) return false;
  f->motion = best.motion;
  f->tolerance = f->diagonal * FINE;
  vs_mesh_distance_free(f->field);
  f->field = NULL;
  const vs_fit_effort efforts[] = { { 4 * VS_FIT_FIRST, 4, 25, 1e-6 }, { p->most, 2, 25, 1e-6 } };
  for (size_t i = 0; i < 2 && !f->out->stopped; i++) {
    if (!vs_fit_improve(f, &efforts[i], best.unknowns) && f->failed) return false;
    vs_fit_settle(f, best.unknowns);
    if (p->count <= efforts[i].points) break;
  }
  for (size_t j = 0; j < f->numbers; j++) {
    f->out->numbers[j].value = vs_fit_number_outer(&p->numbers[j], best.unknowns[j]);
    f->out->numbers[j].rival = f->out->rival ? vs_fit_number_outer(&p->numbers[j], second.unknowns[j]) : 0;
    f->out->numbers[j].low = -INFINITY, f->out->numbers[j].high = INFINITY, f->out->numbers[j].error = INFINITY;
  }
  f->out->motion = f->motion;
  bool stopped = f->out->stopped, refused;
  if (!stopped && !vs_fit_judge(f, best.unknowns)) return false;
  vs_fit_numbers_at(f, best.unknowns, f->trial);
  if (!f->field || memcmp(f->trial, f->made_at, f->numbers * sizeof *f->trial)) {
    vs_mesh_distance *fresh;
    if (!vs_fit_make_field(f, f->trial, &fresh, &refused)) {
      if (!f->failed) vs_error_set(f->e, VS_ERROR_INTERRUPT, NULL, "interrupted before anything was fitted");
      return false;
    }
    vs_mesh_distance_free(f->field);
    f->field = fresh;
  }
  if (!vs_fit_summarise(f)) return false;
  f->out->doubt = vs_fit_doubt_of(f);
  return true;
}

bool vs_model_fit_solve(const vs_fit_problem *p, vs_model_fit *out, vs_error *e) {
  size_t numbers = p->number_count, unknowns = numbers + (p->placed ? 0 : VS_RIGID_UNKNOWNS), room = 0,
         rooms[8] = { 0 };
  *out = (vs_model_fit){ 0 };
  if (numbers > VS_FIT_UNKNOWNS_MOST)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "%zu parameters are more than the %d that can be fitted at once",
                        numbers, VS_FIT_UNKNOWNS_MOST);
  if (p->count <= unknowns)
    return vs_error_set(e, VS_ERROR_FILE, NULL, "%zu point%s; to find %zu parameter%s%s needs more than %zu", p->count,
                        p->count == 1 ? "" : "s", numbers, numbers == 1 ? "" : "s",
                        p->placed ? "" : " and the scan's place", unknowns);
  vs_fit_search f = { .p = p, .out = out, .e = e, .numbers = numbers, .unknowns = unknowns };
  size_t core_room = 0, most = p->most > 4 * VS_FIT_FIRST ? p->most : 4 * VS_FIT_FIRST;
  if (most > p->count) most = p->count;
  vs_fit_place *places = NULL;
  bool ok = VS_GROW(out->numbers, rooms[0], numbers + 1) && VS_GROW(out->distances, rooms[1], p->count) &&
            VS_GROW(f.at, rooms[2], 5 * (unknowns + 1)) && VS_GROW(f.places, rooms[3], most) &&
            VS_GROW(f.slopes, rooms[4], most) && VS_GROW(f.distances, rooms[5], 2 * most) &&
            VS_GROW(f.core, core_room, p->count) && VS_GROW(places, room, VS_FIT_STARTS_MOST + VS_FIT_PLACES_TRIED);
  if (ok) {
    memset(out->numbers, 0, (numbers + 1) * sizeof *out->numbers);
    memset(out->distances, 0, p->count * sizeof *out->distances);
    f.made_at = f.at + unknowns + 1, f.trial = f.made_at + unknowns + 1;
    f.begin[0] = f.trial + unknowns + 1, f.begin[1] = f.begin[0] + unknowns + 1;
    f.other = f.distances + most;
    ok = run(&f, places);
    out->field = f.field;
  } else
    vs_error_memory(e, NULL);
  free(f.at), free(f.places), free(f.slopes), free(f.distances), free(f.core), free(places);
  return ok;
}

void vs_model_fit_free(vs_model_fit *f) {
  vs_mesh_distance_free(f->field);
  free(f->numbers), free(f->distances);
  *f = (vs_model_fit){ 0 };
}
