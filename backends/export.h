/* Owns the export of whole drawings: the list of formats, the options of an export, and the one call that writes a
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
  int crop[4];        /* of a rendered picture, the part to render: left, top, columns, rows, in pixels; no columns: all
                       * of it */
  vs_render_quality quality;
  vs_tone tone;       /* the conversion of light to the numbers of a .png */
  bool layers;        /* an .exr also has depth, normal, albedo, id, material and ambient occlusion */
  const char *view;   /* of a drawing: the name of the view; "*": all views; NULL: by the file's name */
  uint64_t byte_limit; /* the greatest size of one output; 0: no limit */
  unsigned threads;   /* the number of processors that a worker program may use; 0: all */
  double worker_seconds; /* the time after which a worker program is stopped; 0: never */
  size_t mesh_bytes, mesh_triangles; /* the most memory for combining solids, and the most triangles of a mesh; 0: no
                                      * limit */
  const void *given;  /* the text that vs_backend_given writes in place of a drawing */
  size_t given_size;
  bool strict;        /* each warning that a format omits or changes something is an error instead */
  bool safe;          /* limits are on: no text of the user reaches a target as directives */
  void *context;      /* for the calls below, any of which may be NULL */
  /* Receives a warning that the output differs from the model, once for each reason. origin may be NULL. */
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  bool (*is_input)(void *context, const char *path); /* Returns true if path is a file that the drawing was made from:
                                                      * it is never replaced. */
  /* Receives the stage, "writing", "meshing" or "rendering", and the fraction from 0 to 1, or negative if it is
   * unknown. false: stop, which is VS_ERROR_INTERRUPT. */
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
extern const vs_backend vs_backend_given; /* Writes the options' `given`, a text that was made elsewhere, into a file
                                           * that appears whole or not at all. */
size_t vs_export_format_count(void);
const vs_format *vs_export_format_at(size_t index);
const vs_format *vs_export_format_find(const char *text); /* Finds "pov", ".pov", "a/b.pov" or "povray"; NULL: there is
                                                           * no such format. */

const char *vs_export_family(const vs_format *format); /* Returns the name that several formats share, "povray" for
                                                        * .png; NULL: it has only its own names. */

/* Replaces the kinds only, ghost, highlight and native and the user-defined kinds by their meaning for this format
 * (passes/sugar.h). Call it before the passes. */
bool vs_export_sugar(vs_scene *scene, const vs_format *format, const vs_export_options *options, vs_error *e);

/* Writes the drawing to a file, which appears whole or not at all ("-": standard output). format NULL: by the path's
 * ending. Returns false on failure, with the reason and the place in *e; nothing remains on disk. */
bool vs_export(const vs_scene *scene, const vs_format *format, const char *path, const vs_export_options *options,
               vs_error *e);
/* Writes the drawing to a sink of the caller. The sink may have received a part when this fails. */
bool vs_export_to(const vs_scene *scene, const vs_format *format, vs_sink_fn *sink, void *context,
                  const vs_export_options *options, vs_error *e);

#endif
