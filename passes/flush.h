/* Declares the separation of faces that lie in a single plane. It is for formats whose programs cut by comparing
 * surfaces, as POV-Ray does: without it, a thin skin would close a hole that is flush with a wall. */
#ifndef VS_PASSES_FLUSH_H
#define VS_PASSES_FLUSH_H

#include "model/scene.h"

/* Enlarges operands in each difference and intersection of the scene by 2^-16 of their size. It enlarges operands that
 * share a plane with the solid that they cut, and cutters that touch another cutter face to face. The surface of the
 * result does not move. */
bool vs_scene_part_flush(vs_scene *scene, vs_error *e);

#endif
