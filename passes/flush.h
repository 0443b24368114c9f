/* Owns the parting of faces in one plane, for formats whose programs cut by comparing surfaces, as POV-Ray does: there
 * a skin would close a hole that is flush with a wall. */
#ifndef VS_PASSES_FLUSH_H
#define VS_PASSES_FLUSH_H

#include "model/scene.h"

/* In each difference and intersection of the scene, enlarges by 2^-16 of its size each operand that shares a plane with
 * the solid that it cuts, and each cutter that meets another face to face. The surface that stays does not move. */
bool vs_scene_part_flush(vs_scene *scene, vs_error *e);

#endif
