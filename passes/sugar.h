/* Declares the removal of the kinds of level SUGAR before a drawing is written: only, ghost, highlight, native, and
 * kinds of define-primitive.
 *
 *   only       the drawing becomes the children of the `only` nodes, in their places and paint
 *   ghost      belongs to no solid; a format that shows previews gets it beside the drawing
 *   highlight  becomes its child; a format that shows previews also gets it beside the drawing, where it is cut away
 *   native     stays for its own program; for all others it becomes its child
 *   custom     becomes its child */
#ifndef VS_PASSES_SUGAR_H
#define VS_PASSES_SUGAR_H

#include "model/job.h"
#include "passes/passes.h"
#include "model/scene.h"

typedef enum {
  VS_MARKS_DROP,  /* shows neither ghosts nor the cut-away parts of highlights, for formats of solids */
  VS_MARKS_PAINT, /* adds highlights in translucent red and ghosts in grey to the drawing */
  VS_MARKS_KEEP   /* keeps highlights in place, and adds ghosts to the drawing, for targets that can express both */
} vs_mark_style;

typedef struct {
  vs_mark_style highlights, ghosts;
  const char *target; /* target of targets.def; NULL: no native text is written */
  const char *output; /* name of the format in messages, such as ".stl"; NULL: no warning about native text without an
                       * alternative */
  bool keeps_text;    /* true: native text that has no alternative for other formats is kept, so that it can be
                       * counted */
  bool strict;        /* true: native text without an alternative for this format causes an error instead of a
                       * warning */
  bool muted;         /* true: native text is never written, and a warning is given */
  const vs_job *job;  /* receives a warning once for each kind, with the first place; may be NULL */
} vs_sugar_options;

/* Rewrites the scene's drawn array, which belongs to the store. For a scene without nodes of level SUGAR it only
 * examines each drawn object. */
bool vs_scene_sugar(vs_scene *scene, const vs_sugar_options *options, vs_error *e);

#endif
