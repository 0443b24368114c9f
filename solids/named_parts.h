/* Declares the separation of a drawing into its parts. */
#ifndef VS_SOLIDS_NAMED_PARTS_H
#define VS_SOLIDS_NAMED_PARTS_H

#include "model/scene.h"

/* Makes each part of the drawing (node of kind VS_PART) one drawn object: a VS_PART node around the whole content of
 * the part. A part within a part gets the name "outer/inner". Objects outside of all parts stay.
 *
 * parted: true if overlaps of solids are removed, too: earlier parts are then subtracted from later ones, and all parts
 * from solids outside of parts. Returns false and sets e on failure. */
bool vs_scene_parts(vs_scene *scene, bool parted, vs_error *e);

#endif
