/* Declares the walk over a drawn object or the body of a template. */
#ifndef VS_BACKENDS_TREE_WALK_H
#define VS_BACKENDS_TREE_WALK_H

#include "backends/backend.h"

/* Resets the state of the walk, because a walk that failed may have stopped anywhere. */
void vs_drive_reset(vs_emitter *e);
/* Emits the object and everything below it. body: true if the object is the body of its template, which is written
 * instead of a use of the template. Returns false on failure; e's error or the writer has the reason. */
bool vs_drive_walk(vs_emitter *e, const vs_ref *root, bool body);
/* Records, for formats with VS_KEEPS_ORIGINS, that the text from the current line on comes from the reference. Returns
 * false if memory is out. */
bool vs_drive_mark_ref(vs_emitter *e, const vs_ref *ref);

#endif
