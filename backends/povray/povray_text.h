/* Contains the text functions that all files of the POV-Ray back-end use: indentation, points in the scene's units. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_TEXT_H
#define VS_BACKENDS_POVRAY_POVRAY_TEXT_H

#include "backends/povray/povray.h"

static inline void pov_indent(vs_emitter *e) { vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40)); }
static inline void pov_open(vs_emitter *e, const char *word) {
  pov_indent(e);
  vs_puts(e->out, word);
}
static inline vs_emit_status pov_close(vs_emitter *e, const char *word) {
  vs_puts(e->out, word);
  return e->out->failed ? VS_FAILED : VS_EMITTED;
}

/* Returns the point p, which is in model units, in the units of the scene. */
static inline vs_vec3 pov_at(const vs_emitter *e, vs_vec3 p) { return e->unit == 1 ? p : vs_v3_scale(p, e->unit); }

static inline void pov_point(vs_emitter *e, vs_vec3 p) { vs_put_triple(e->out, "<", p, ", ", ">"); }

#endif
