/* Declares the walk over a drawn object or the body of a template. */
#ifndef VS_BACKENDS_TREE_WALK_H
#define VS_BACKENDS_TREE_WALK_H

#include "backends/backend.h"

/* Resets the state of the walk, because an earlier walk may have failed at any point. */
void vs_drive_reset(vs_emitter *e);
/* Emits the object and everything below it. body: the object is a template whose body is written, not a reference to
 * it. Returns false on failure; e's error or the writer has the reason. */
bool vs_drive_walk(vs_emitter *e, const vs_ref *root, bool body);
/* Records, for formats with VS_KEEPS_ORIGINS, that the text from the current line on has the origin of the reference.
 * Returns false if memory is out. */
bool vs_drive_mark_ref(vs_emitter *e, const vs_ref *ref);

#endif
