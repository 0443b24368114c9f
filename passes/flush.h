/* Owns parting faces in one plane for formats whose programs cut by comparing surfaces, as POV-Ray does: there a hole
 * flush with a wall stays closed by a skin. */
#ifndef VS_PASSES_FLUSH_H
#define VS_PASSES_FLUSH_H

#include "model/scene.h"

/* In each difference and intersection of the scene, what shares a plane with what it cuts becomes larger by 2^-16 of
 * that, and so does a cutter that meets another one face to face. The surface that stays is where it was. */
bool vs_scene_part_flush(vs_scene *scene, vs_error *e);

#endif
