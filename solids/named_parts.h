/* Declares the separation of a drawing into its parts. */
#ifndef VS_SOLIDS_NAMED_PARTS_H
#define VS_SOLIDS_NAMED_PARTS_H

#include "model/scene.h"

/* Makes each part of the drawing (node of kind VS_PART) a drawn object, in the order of the parts' first places. This
 * object is a VS_PART node around the whole content of the part, and contains no other VS_PART node. The name of a part
 * within a part is "outer/inner". Objects outside of all parts stay as they are.
 *
 * parted: whether solids are separated as well. The earlier parts are then subtracted from each part that overlaps
 * them, and all parts from the solids outside of parts. Rewrites the scene's drawn array, which belongs to the store.
 * Examines only the drawn objects of a drawing without parts. Returns false, with e set, on failure. */
bool vs_scene_parts(vs_scene *scene, bool parted, vs_error *e);

#endif
