/* Declares the division of a picture among runs (processes) of POV-Ray. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_PLAN_H
#define VS_BACKENDS_POVRAY_POVRAY_PLAN_H

#include "backends/backend.h"
#include "geometry/files/exr_read.h"

enum { VS_POVRAY_STRIPS = 32 /* most strips of a picture */, VS_POVRAY_PASSES = 2 /* number of parts of the first pass
                                                                                   * (the small picture that gathers
                                                                                   * bounced light) */ };

/* How a run treats samples of bounced light: it ignores them, keeps them in a file, or reads them from a file. */
typedef enum { VS_SAMPLES_OWN, VS_SAMPLES_KEPT, VS_SAMPLES_GIVEN } vs_povray_samples;

/* A job: one run (process) of POV-Ray, which renders a part of a picture. */
typedef struct {
  uint32_t columns, rows;
  vs_exr_part part;
  vs_povray_samples samples;
  bool smooth;      /* whether pixels at edges are computed from several rays */
  char name[16];    /* name of the job's files, without a suffix */
} vs_povray_job;

typedef struct {
  uint32_t columns, rows; /* size of the entire picture in pixels */
  vs_exr_part wanted;     /* the part of the picture that the job renders */
  bool bounced;           /* whether the picture has bounced light (radiosity) */
  bool metered;           /* whether the exposure is computed from the picture, not set by the user */
  size_t pass_count, count; /* count: number of jobs; pass_count: number of jobs of the first pass, which precede the
                             * others */
  vs_povray_job jobs[VS_POVRAY_PASSES + VS_POVRAY_STRIPS];
} vs_povray_plan;

/* Returns the plan of a picture. triangles: number of triangles in its scene. metered: whether its exposure is computed
 * from the picture. alone: whether a single run of POV-Ray renders the entire picture. */
vs_povray_plan vs_povray_plan_of(const vs_export_options *o, uint64_t triangles, bool metered, bool alone);
/* Returns the first row of a tile of a picture that is divided into tiles, one above the other; for tile = tiles, the
 * number of rows. A tile ends where a strip ends, or lies in one strip: each strip of a tile is rendered as a whole.
 * tiles: at most `rows`. The strips are those of a scene with few triangles. */
uint32_t vs_povray_tile_top(uint32_t columns, uint32_t rows, uint32_t tiles, uint32_t tile);
/* Returns how many of the jobs may run at a time: at most as many as there are processors, and as need no more than
 * half of the machine's memory. The parameter scene is the size of the scene's text in bytes. */
size_t vs_povray_at_once(const vs_export_options *o, const vs_povray_job *job, uint64_t scene);
/* Returns the size in megabytes of the picture that POV-Ray keeps for a job. */
double vs_povray_megabytes(const vs_povray_job *job);
/* Returns true if the job's picture fits into memory: it needs at most a quarter of the machine's memory. Otherwise
 * POV-Ray keeps the picture in a file. */
bool vs_povray_fits(const vs_povray_job *job);

#endif
