/* Declares the job: the data of one long computation, such as the write of an output, for all layers below its caller.
 *
 * It holds the limits, the clock, the account, the progress and the messages. The caller makes it, and passes its
 * address down to all code that the computation calls. Only the callbacks `going`, `warn` and `note` lead back to the
 * caller: no layer calls another function above it. */
#ifndef VS_MODEL_JOB_H
#define VS_MODEL_JOB_H

#include "model/tally.h"

/* Limits of a job. Each member is the greatest value that is allowed; 0: no limit. */
typedef struct {
  double seconds;        /* seconds from vs_job_start to the end of the job, without the time of worker programs */
  double worker_seconds; /* seconds that one worker program (such as POV-Ray) may run */
  uint64_t output_bytes; /* size of one output in bytes */
  size_t mesh_bytes;     /* memory for the union and difference of solids, in bytes */
  size_t mesh_triangles; /* number of triangles of one mesh */
} vs_job_limits;

typedef struct vs_job {
  /* Callback that reports progress. stage: "writing", "meshing" or "rendering"; NULL: nothing new to show. fraction:
   * completed part, 0 to 1; negative if unknown. Returns false to stop the job, which then ends with
   * VS_ERROR_INTERRUPT. If the pointer is NULL, the job never stops. */
  bool (*going)(void *context, const char *stage, double fraction);
  /* Callback that receives a warning, once for each reason. origin: place in the source to which the warning refers;
   * may be NULL. If the pointer is NULL, warnings are dropped. */
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  /* Callback that receives a line for the summary that the user sees, such as the view, scale and sheet of a drawing.
   * If the pointer is NULL, lines are dropped. */
  void (*note)(void *context, const char *message);
  void *context;      /* first argument of the functions `going`, `warn` and `note` */
  vs_tally *tally;    /* account of times and memory, which outlives the job; NULL: nothing is counted */
  vs_job_limits limits;
  bool late;          /* true if the time limit has stopped the job */
  double began, worked; /* began: clock at vs_job_start, in seconds; worked: seconds that worker programs had used until
                         * then */
  const char *stage;  /* stage whose progress vs_job_done reports, such as "meshing"; NULL if no stage is counted */
  double from, share, told; /* progress in the current stage, as fractions of the stage. from: where the current part
                             * begins; share: size of this part; told: greatest fraction that was reported */
} vs_job;

/* Starts the clock for the job's limit of seconds. */
void vs_job_start(vs_job *job);
/* Returns true if the job has used up its time limit. The time of external programs does not count, because rendering a
 * picture takes longer than computing the model. */
bool vs_job_late(vs_job *job);
/* Reports the stage and the completed fraction to the caller (see `going`). Returns false if the job must end because
 * the caller stops it or it is late. If job is NULL, returns true. */
bool vs_job_going(vs_job *job, const char *stage, double fraction);
/* Starts to count the progress of a stage; its first part is the entire stage. If stage is NULL, no stage is counted
 * from now on. job may be NULL. */
void vs_job_stage(vs_job *job, const char *stage);
/* Begins a part of the current stage: `share` of the stage, beginning at `from`, both as fractions. job may be NULL. */
void vs_job_part(vs_job *job, double from, double share);
/* Reports progress by vs_job_going. done: completed fraction of the current part, which is converted to a fraction of
 * the stage. Reported fractions never decrease, although each part begins at 0. Returns false if the job must end. */
bool vs_job_done(vs_job *job, double done);
/* Passes a line for the summary to the caller's function `note`. job may be NULL. */
void vs_job_note(const vs_job *job, const char *message);
/* Passes a warning to the caller's function `warn`. job may be NULL. */
void vs_job_warn(const vs_job *job, const vs_origin *origin, const char *message);

/* Sets the job for all code that works on the store's nodes. Returns the job that was set before, or NULL. The caller
 * owns the job, and sets another job before it frees this one. */
vs_job *vs_store_set_job(vs_store *s, vs_job *job);
vs_tally *vs_store_tally(const vs_store *s); /* Returns the account of times and memory of the store's job, or NULL. */

#endif
