/* Declares the removal of the kinds of level SUGAR before a drawing is written: only, ghost, highlight, native,
 * part, and kinds of define-primitive.
 *
 *   only       the drawing becomes the children of the `only` nodes, in their places and materials
 *   ghost      belongs to no solid; a format that shows previews gets it beside the drawing
 *   highlight  becomes its child; a format that shows previews also gets it beside the drawing, where it is cut away
 *   native     stays for its own program; for all others it becomes its child
 *   part       stays for formats that have a name for it; for all others it becomes its child
 *   custom     becomes its child */
#ifndef VS_PASSES_SUGAR_H
#define VS_PASSES_SUGAR_H

#include "model/job.h"
#include "passes/passes.h"
#include "model/scene.h"

typedef enum {
  VS_MARKS_DROP,  /* removes ghosts, and shows no highlight where its part is cut away; for formats of solids */
  VS_MARKS_PAINT, /* adds highlights in translucent red and ghosts in grey to the drawing; for formats that show
                   * previews */
  VS_MARKS_KEEP   /* keeps highlights in place, and adds ghosts to the drawing; for programs that can mark objects as
                   * highlights and ghosts */
} vs_mark_style;

typedef struct {
  vs_mark_style highlights, ghosts;
  vs_mark_style faults; /* how the format shows the scene's objects that break a rule; VS_MARKS_KEEP: as ghosts */
  const char *target; /* program of targets.def whose native text is written; NULL if no native text is written */
  const char *output; /* name of the format for messages, such as ".stl"; NULL: no warnings about native text without a
                       * replacement */
  bool keeps_parts;   /* true if nodes of kind VS_PART stay */
  bool keeps_text;    /* true if native text that has no replacement for other formats is kept, so that it can be
                       * counted */
  bool strict;        /* true if native text without a replacement for this format causes an error instead of a
                       * warning */
  bool muted;         /* true if native text but "no_shadow" is never written, and causes a warning */
  const vs_job *job;  /* job that receives a warning once for each kind, with the first place of such a node; may be
                       * NULL */
} vs_sugar_options;

/* Removes ghosts, highlights, native texts and other nodes of level SUGAR from the scene's drawn array, which belongs
 * to the store, and adds the faults of the scene. For a scene without such nodes and faults it only examines each drawn
 * object. Returns false, with e set, on failure. */
bool vs_scene_sugar(vs_scene *scene, const vs_sugar_options *options, vs_error *e);

#endif
