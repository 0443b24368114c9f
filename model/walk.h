/* Declares a walk through a DAG without recursion, along every path. It reports each node before its children (enter)
 * and after them (leave). */
#ifndef VS_MODEL_WALK_H
#define VS_MODEL_WALK_H

#include "model/node.h"

typedef enum { VS_WALK_ENTER, VS_WALK_LEAVE, VS_WALK_DONE, VS_WALK_FAILED } vs_walk_event;
typedef struct vs_walk vs_walk;
vs_walk *vs_walk_new(vs_store *s, vs_ref root);
vs_walk_event vs_walk_next(vs_walk *w, vs_ref *ref, size_t *depth); /* Moves to the next event of the walk: the node
                                                                     * *ref at *depth is entered or left. Returns the
                                                                     * event, its end, or VS_WALK_FAILED if memory is
                                                                     * out. */
/* Skips the children of the node that the walk has just entered. The event of leaving this node still follows. */
void vs_walk_skip(vs_walk *w);
void vs_walk_free(vs_walk *w);

#endif
