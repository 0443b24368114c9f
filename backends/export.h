/* Declares the export of drawings: the list of formats, the options of an export, and the functions that write a
 * file. */
#ifndef VS_BACKENDS_EXPORT_H
#define VS_BACKENDS_EXPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "backends/known_files.h"
#include "backends/writer.h"
#include "geometry/pictures/tone.h"
#include "model/job.h"
#include "model/scene.h"

typedef enum { VS_RENDER_GOOD, VS_RENDER_DRAFT, VS_RENDER_FINAL } vs_render_quality; /* quality of rendered pictures */

typedef struct {
  int width, height;  /* size of pictures and pages in pixels; 0: the default size, 1024 x 768 */
  int crop[4];        /* part of a picture to render: left, top, columns and rows in pixels; if columns is 0, the whole
                       * picture */
  vs_render_quality quality;
  vs_tone tone;       /* how the light of a rendered picture is converted to the values of a .png */
  bool layers;        /* whether an .exr also contains depth, normal, albedo, id, material and ambient occlusion */
  const char *view;   /* name of the view of a drawing; "*": all views; NULL: the view with whose name the file's name
                       * ends */
  unsigned threads;   /* number of processors that a worker program may use; 0: all processors */
  const void *given;  /* finished text, which vs_backend_given writes instead of a drawing */
  size_t given_size;
  bool keeps_parts;   /* whether the named parts of the model (nodes of kind VS_PART) are kept, also for formats that
                       * have no names for parts */
  bool up_y;          /* whether formats with VS_TURNS get the model with Y upwards instead of Z */
  const char *units;  /* the unit of lengths in drawings in .dxf and in formats with VS_UNITS, from vs_unit_at; NULL:
                       * the model's own unit */
  bool strict;        /* whether a warning that a format omits or changes an object is an error */
  bool safe;          /* true if limits are set: no text of the user then reaches a worker program as directives */
  const vs_known_files *inputs; /* input files of the model, which no export replaces; NULL: none */
  vs_job *job;        /* limits, messages and progress of this output; NULL: there are no limits, and messages are
                       * dropped */
} vs_export_options;

void vs_export_options_init(vs_export_options *o);

/* ---- formats: the rows of backends.def, in its order ---- */
typedef struct vs_backend vs_backend;
typedef struct {
  const char *suffix; /* file suffix without the dot, such as "pov" */
  const char *name;   /* name for --format, such as "povray" */
  const char *doc;    /* description in one line */
  const char *worker; /* name of the program that must be installed, or NULL */
  bool binary;        /* true if the output is binary; it is then not written to a terminal */
  const vs_backend *backend;
} vs_format;
extern const vs_backend vs_backend_given; /* A back-end that writes a finished text, options->given, into a file. The
                                           * file appears completely or not at all. */
size_t vs_export_format_count(void);
const vs_format *vs_export_format_at(size_t index);
const vs_format *vs_export_format_find(const char *text); /* Returns the format for "pov", ".pov", "a/b.pov" or
                                                           * "povray", or NULL if there is no such format. */

/* Returns the factor from lengths of the model to lengths in `units`, a name from vs_unit_at; 1 if units is NULL. */
double vs_export_units(const vs_scene *scene, const char *units);
const char *vs_export_family(const vs_format *format); /* Returns the name that the format has in common with other
                                                        * formats ("povray" for .png), or NULL if it has none. */

/* Replaces the kinds only, ghost, highlight, native and the user-defined kinds by simpler kinds that have their meaning
 * in this format (passes/sugar.h). Call it before the passes. */
bool vs_export_sugar(vs_scene *scene, const vs_format *format, const vs_export_options *options, vs_error *e);

/* Writes the drawing to a file, which appears completely or not at all. The path "-" is standard output. format NULL:
 * the path's suffix selects the format. Returns false on failure, with the reason and the place in *e; no partial file
 * remains on disk. */
bool vs_export(const vs_scene *scene, const vs_format *format, const char *path, const vs_export_options *options,
               vs_error *e);
/* Writes the drawing by calls of the function `sink`. After a failure, the sink may have received a part of the
 * output. */
bool vs_export_to(const vs_scene *scene, const vs_format *format, vs_sink_fn *sink, void *context,
                  const vs_export_options *options, vs_error *e);

#endif
