/* Owns what becomes of kinds of level SUGAR before a drawing is written: only, ghost, highlight, native, and what
 * define-primitive makes.
 *
 * only     the drawing is then what stands in these, where they stand, in the paint they stand in
 * ghost    is in no solid; a format that shows previews gets it beside the drawing
 * highlight is its child; a format that shows previews gets it once more beside the drawing, where it is cut away
 * native   stays for the program that it speaks to, and is its child for all others
 * custom   is its child */
#ifndef VS_PASSES_SUGAR_H
#define VS_PASSES_SUGAR_H

#include "passes/passes.h"
#include "model/scene.h"

typedef enum {
  VS_MARKS_DROP,  /* solids: nothing is shown that is not there */
  VS_MARKS_PAINT, /* beside the drawing, in translucent red (highlight) and grey (ghost) */
  VS_MARKS_KEEP   /* the target has words of its own: highlight stays where it is, ghosts stand beside the drawing */
} vs_mark_style;

typedef struct {
  vs_mark_style highlights, ghosts;
  const char *target; /* of targets.def, or NULL: no native text */
  const char *output; /* what the format is called in messages: ".stl"; NULL: what native text has nothing for it is not
                       * spoken of */
  bool keeps_text;    /* native text without anything for other formats stays, for those who count */
  bool strict;        /* native text that leaves nothing for this format is an error, not a warning */
  bool muted;         /* its native text is switched off all the same, which is said */
  /* Both may be NULL. said: once a kind, with the place of the first. bounds: as vs_pass_options has it, for what is
   * shown where it is cut. */
  void (*said)(void *context, const vs_origin *origin, const char *message);
  void *said_context;
  bool (*bounds)(void *context, const vs_node *n, vs_bounds *out, vs_error *e);
  void *bounds_context;
} vs_sugar_options;

/* Rewrites what the scene draws (its array belongs to the store). A scene without sugar costs one look at each thing
 * drawn. */
bool vs_scene_sugar(vs_scene *scene, const vs_sugar_options *options, vs_error *e);

#endif
