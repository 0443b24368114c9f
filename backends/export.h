/* Owns the way out for whole drawings: the list of formats, the options of an export, and the one call that writes a
 * file. */
#ifndef VS_BACKENDS_EXPORT_H
#define VS_BACKENDS_EXPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "backends/writer.h"
#include "geometry/pictures/tone.h"
#include "model/scene.h"

typedef enum { VS_RENDER_GOOD, VS_RENDER_DRAFT, VS_RENDER_FINAL } vs_render_quality; /* of rendered pictures */

typedef struct {
  int width, height;  /* pixels, of pictures and pages; 0: 1024 x 768 */
  int crop[4];        /* of a rendered picture, the part within width and height: left, top, columns, rows; no columns:
                       * all of it */
  vs_render_quality quality;
  vs_tone tone;       /* how light becomes the numbers of a .png */
  bool layers;        /* an .exr has depth, normal, albedo, id, material and ambient occlusion, too */
  const char *view;   /* of a drawing: the name of what it shows; "*": all views; NULL: by the file's name */
  uint64_t byte_limit; /* of one output; 0: none */
  unsigned threads;   /* processors that a worker program may use; 0: all */
  double worker_seconds; /* a worker program is stopped after so long; 0: never */
  size_t mesh_bytes, mesh_triangles; /* what combining solids may take, and how many a mesh may have; 0: no limit */
  const void *given;  /* what vs_backend_given writes, in place of a drawing */
  size_t given_size;
  bool strict;        /* what a format leaves out, or shows otherwise than modelled, is an error instead of a warning */
  bool safe;          /* limits are on: nothing of the user's reaches a target as directives */
  void *context;      /* for the calls below, any of which may be NULL */
  /* Something the output does not show as modelled; said once a reason. origin may be NULL. */
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  bool (*is_input)(void *context, const char *path); /* a file that the drawing was made from: it is never replaced */
  /* stage: "writing", "meshing", "rendering"; fraction 0..1, or negative where unknown. false: stop, which is
   * VS_ERROR_INTERRUPT. */
  bool (*progress)(void *context, const char *stage, double fraction);
} vs_export_options;

void vs_export_options_init(vs_export_options *o);

/* ---- formats: the rows of backends.def, in its order ---- */
typedef struct vs_backend vs_backend;
typedef struct {
  const char *suffix; /* without the dot: "pov" */
  const char *name;   /* for --format: "povray" */
  const char *doc;    /* one line */
  const char *worker; /* the program that must be installed, or NULL */
  bool binary;        /* not for a terminal */
  const vs_backend *backend;
} vs_format;
extern const vs_backend vs_backend_given; /* writes the options' `given`: text that was made elsewhere, into a file that
                                           * appears whole or not at all */
size_t vs_export_format_count(void);
const vs_format *vs_export_format_at(size_t index);
const vs_format *vs_export_format_find(const char *text); /* "pov", ".pov", "a/b.pov" or "povray"; NULL: no such */

const char *vs_export_family(const vs_format *format); /* "povray" for .png; NULL: none but its own names */

/* Returns the drawing as this format gets it: only, ghost, highlight, native and user-defined kinds settled
 * (passes/sugar.h). Before the passes. */
bool vs_export_sugar(vs_scene *scene, const vs_format *format, const vs_export_options *options, vs_error *e);

/* Writes the drawing to a file, which appears whole or not at all ("-": standard output). format NULL: by the path's
 * ending. On false *e says why and where; nothing is left behind. */
bool vs_export(const vs_scene *scene, const vs_format *format, const char *path, const vs_export_options *options,
               vs_error *e);
/* The same to a sink of the caller's, which may have got part of it when this fails. */
bool vs_export_to(const vs_scene *scene, const vs_format *format, vs_sink_fn *sink, void *context,
                  const vs_export_options *options, vs_error *e);

#endif
