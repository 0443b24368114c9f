/* Declares the separation of solids whose faces lie in one plane (flush faces). It is for formats whose programs cut by
 * comparing surfaces, as POV-Ray does: otherwise, a thin skin would close a hole whose end is flush with a wall. */
#ifndef VS_PASSES_FLUSH_H
#define VS_PASSES_FLUSH_H

#include "model/scene.h"

/* Enlarges, by 2^-16 of their size, operands of the scene's differences and intersections that have a face in one plane
 * with the solid that they cut, or touch another cutter face to face. Returns false, with e set, on failure. */
bool vs_scene_part_flush(vs_scene *scene, vs_error *e);

#endif
