/* Implements the job of a long computation (job.h): its limits, progress and messages. */
#include "model/job.h"

#include <math.h>

#include "model/assert.h"
#include "model/store/store_inside.h"

static double workers(const vs_job *job) { return job->tally ? job->tally->of[VS_WORK_WORKER].seconds : 0; }

void vs_job_start(vs_job *job) {
  job->late = false;
  job->began = vs_clock();
  job->worked = workers(job);
}

bool vs_job_late(vs_job *job) {
  if (job->limits.seconds <= 0 || (job->tally && job->tally->now == VS_WORK_WORKER)) return false;
  double took = vs_clock() - job->began - (workers(job) - job->worked);
  return job->late = job->late || took > job->limits.seconds;
}

bool vs_job_going(vs_job *job, const char *stage, double fraction) {
  VS_ASSERT(fraction < 1.001);
  if (!job) return true;
  return !vs_job_late(job) && (!job->going || job->going(job->context, stage, fraction));
}

void vs_job_stage(vs_job *job, const char *stage) {
  if (!job) return;
  job->stage = stage;
  job->from = job->told = 0;
  job->share = 1;
}

void vs_job_part(vs_job *job, double from, double share) {
  VS_ASSERT(from >= 0 && share >= 0);
  if (job) job->from = from, job->share = share;
}

bool vs_job_done(vs_job *job, double done) {
  if (!job) return true;
  if (job->stage) job->told = fmax(job->told, job->from + job->share * done);
  return vs_job_going(job, job->stage, job->stage ? job->told : done);
}

void vs_job_note(const vs_job *job, const char *message) {
  if (job && job->note) job->note(job->context, message);
}

void vs_job_warn(const vs_job *job, const vs_origin *origin, const char *message) {
  if (job && job->warn) job->warn(job->context, origin, message);
}

vs_job *vs_store_set_job(vs_store *s, vs_job *job) {
  vs_job *was = s->job;
  s->job = job;
  return was;
}

vs_tally *vs_store_tally(const vs_store *s) { return s->job ? s->job->tally : NULL; }
