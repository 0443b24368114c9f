/* Owns what becomes of POV-Ray's picture before it is handed on. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_PICTURE_H
#define VS_BACKENDS_POVRAY_POVRAY_PICTURE_H

#include "backends/povray/povray_plan.h"

/* Where the runs' pictures are, and how light is to become the numbers of a .png. */
typedef struct { const char *folder; const vs_povray_plan *plan; const vs_tone *tone; } vs_povray_result;

/* Puts the plan's picture together into an EXR at a file that is there, without a date; with the layers that the
 * options ask for. */
bool vs_povray_take_picture(vs_emitter *e, const vs_povray_result *r, const char *to);
/* The same as a PNG, by the tone. */
bool vs_povray_develop_picture(vs_emitter *e, const vs_povray_result *r, const char *to);
/* Finds the exposure that the first pass asks for. */
bool vs_povray_meter(vs_emitter *e, const char *folder, const vs_povray_plan *plan, vs_tone_curve curve, double *stops);

#endif
