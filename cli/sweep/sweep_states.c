/* Reads the states of the sets of a sweep from its manifests. */
#include "cli/sweep/sweep_states.h"

#include <stdlib.h>

#include "cli/sweep/sweep_manifest.h"
#include "cli/sweep/sweep_plan.h"
#include "model/store/array.h"

static bool read_states(sweep_plan *p, const char *folder, cli_part_states *out) {
  sweep_table *t = &p->table;
  size_t done = 0;
  sweep_manifest *m = sweep_manifest_read(t, folder);
  if (!m || !VS_FRESH(out->at, t->count)) return sweep_manifest_close(m), false;
  out->count = t->count;
  for (size_t i = 0; i < t->count; i++) {
    sweep_part *part = &t->parts[i];
    if (part->same < i) out->at[i] = out->at[part->same];
    else if (sweep_manifest_is_listed(m, part)) out->at[i] = PART_DONE, out->seconds += part->seconds, done++;
    else if (sweep_manifest_failed(m, part)) {
      out->at[i] = cli_part_state_of(part->code);
      if (!out->code) out->code = part->code;
    } else out->at[i] = PART_MISSING;
  }
  if (done) out->seconds /= (double)done;
  sweep_manifest_close(m);
  return true;
}

bool cli_sweep_states(const cli_options *o, const char *folder, cli_part_states *out) {
  sweep_plan p;
  *out = (cli_part_states){0};
  bool ok = sweep_plan_make(&p, o) && read_states(&p, folder, out);
  sweep_plan_free(&p);
  return ok;
}
