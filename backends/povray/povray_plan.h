/* Owns the interface of povray_plan.c: the division of a picture among runs of POV-Ray. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_PLAN_H
#define VS_BACKENDS_POVRAY_POVRAY_PLAN_H

#include "backends/backend.h"
#include "geometry/files/exr_read.h"

enum { VS_POVRAY_STRIPS = 32 /* the most strips of one picture */, VS_POVRAY_PASSES = 2 /* parts of the first pass */ };

/* The use of samples of bounced light: a run ignores them, keeps them in a file, or takes them from one. */
typedef enum { VS_SAMPLES_OWN, VS_SAMPLES_KEPT, VS_SAMPLES_GIVEN } vs_povray_samples;

/* A run of POV-Ray: a part of a picture of that many columns and rows. */
typedef struct {
  uint32_t columns, rows;
  vs_exr_part part;
  vs_povray_samples samples;
  bool smooth;      /* edges have several rays in a pixel */
  uint32_t threads;
  char name[16];    /* of its files, without an ending */
} vs_povray_job;

typedef struct {
  uint32_t columns, rows; /* of the whole picture */
  vs_exr_part wanted;     /* of it */
  bool bounced;           /* it has bounced light */
  bool metered;           /* its exposure is computed from it */
  size_t pass_count, count; /* the first pass_count jobs are the first pass */
  vs_povray_job jobs[VS_POVRAY_PASSES + VS_POVRAY_STRIPS];
} vs_povray_plan;

/* Returns the plan of a picture. triangles: the number in its scene; metered: its exposure is computed from it; alone:
 * a single run makes all of it. */
vs_povray_plan vs_povray_plan_of(const vs_export_options *o, uint64_t triangles, bool metered, bool alone);
/* Returns how many of the jobs may run at a time: as many as there are processors, but fewer if that would take more
 * than half of the machine's memory. scene: its size in bytes. */
size_t vs_povray_at_once(const vs_export_options *o, const vs_povray_job *job, uint64_t scene);

#endif
