/* Implements the rounding of meshes to the numbers of a format. */
#include "backends/format_numbers.h"

#include <stdio.h>

#include "model/job.h"

bool vs_emit_round(vs_emitter *e, vs_mesh *m, vs_numbers numbers, vs_rounded *sum) {
  vs_rounded what;
  vs_tally *tally = vs_store_tally(e->scene->store);
  vs_work_phase was = vs_tally_enter(tally, VS_WORK_MESH);
  vs_kernel_error why;
  vs_kernel_counts counts = { 0 };
  vs_kernel_options options = { .job = e->job, .counts = &counts };
  bool settled = vs_mesh_round(m, numbers, &options, &what, &why);
  vs_tally_enter(tally, was);
  vs_solid_tally_steps(e->scene->store, &counts);
  if (!settled && why.status == VS_KERNEL_INTERRUPTED)
    return vs_error_set(e->error, VS_ERROR_INTERRUPT, NULL, "interrupted");
  if (!settled) return vs_emit_no_memory(e);
  if (sum->dropped == 0) sum->dropped_at = what.dropped_at;
  if (sum->met == 0) sum->at = what.at;
  if (sum->lost == 0) sum->lost_at = what.lost_at;
  sum->dropped += what.dropped;
  sum->lost += what.lost;
  sum->met += what.met;
  sum->met_before += what.met_before;
  return true;
}

bool vs_emit_rounded(vs_emitter *e, const vs_rounded *what) {
  char message[200];
  vs_vec3 at = what->dropped_at;
  if (e->job->warn == NULL) return true;
  if (what->dropped != 0) {
    snprintf(message, sizeof message,
             "%zu slivers are omitted because they are thinner than the steps of this format's numbers; the first is "
             "near %g %g %g",
             what->dropped, at.x, at.y, at.z);
    vs_job_warn(e->job, NULL, message);
  }
  if (what->lost != 0) {
    at = what->lost_at;
    snprintf(message, sizeof message,
             "details that are finer than the steps of this format's numbers are omitted: %zu corner%s, the first is "
             "near %g %g %g",
             what->lost, what->lost == 1 ? "" : "s", at.x, at.y, at.z);
    vs_job_warn(e->job, NULL, message);
  }
  if (what->met == 0) return true;
  at = what->at;
  snprintf(message, sizeof message,
           "rounded to this format's numbers, %zu triangles touch or cross triangles that were only near them, the "
           "first is near %g "
           "%g %g",
           what->met, at.x, at.y, at.z);
  vs_job_warn(e->job, NULL, message);
  return true;
}
