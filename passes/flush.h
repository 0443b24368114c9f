/* Declares the separation of solids whose faces lie in one plane (flush faces). It is for formats whose programs cut by
 * comparing surfaces, as POV-Ray does: otherwise, a thin skin would close a hole whose end is flush with a wall. */
#ifndef VS_PASSES_FLUSH_H
#define VS_PASSES_FLUSH_H

#include "model/scene.h"

/* Enlarges some operands of the scene's differences and intersections by 2^-16 of their size. These are operands with a
 * face in one plane with the solid that they cut, and cutters that touch another cutter face to face. The surface of
 * the result does not move. Returns false, with e set, on failure. */
bool vs_scene_part_flush(vs_scene *scene, vs_error *e);

#endif
