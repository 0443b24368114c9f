/* Owns random drawings of every kind of node, for tests of what rewrites them; and what must not change about them. */
#ifndef VS_TESTS_DRAWINGS_H
#define VS_TESTS_DRAWINGS_H

#include <stdio.h>

#include "geometry/measure/node_measures.h"
#include "model/scene.h"

enum { DRAWN_MOST = 3 };
typedef struct { vs_ref at[DRAWN_MOST]; size_t count; } drawing; /* each a reference of its own */

/* The drawing of this seed. Every reference in it has an origin of its own, "random.vs" with a line of its own. */
drawing drawing_make(vs_store *s, uint64_t seed);
drawing drawing_retain(const drawing *d);
void drawing_release(drawing *d);
void drawing_print(const drawing *d, FILE *out); /* as the tree dump has it */

/* Does it fail? Asked again and again for smaller drawings. */
typedef bool drawing_fails(void *context, const drawing *d);
void drawing_shrink(drawing *d, drawing_fails *fails, void *context); /* *d becomes the smallest that was found */

/* The parts of a drawing: every primitive on every path to one, in order, where it stands, its paint and origins. */
typedef struct drawing_look drawing_look;
typedef struct drawing_memo drawing_memo; /* what looks at equal parts have in common; must outlive them */
drawing_memo *drawing_memo_new(void);
void drawing_memo_free(drawing_memo *m);
drawing_look *drawing_look_new(const drawing *d, drawing_memo *m); /* NULL: too many paths to look at */
void drawing_look_free(drawing_look *l);
/* A point in the box of one of the parts: which, and where in it, by four numbers of 0..1. */
vs_vec3 drawing_look_point(const drawing_look *l, double which, double x, double y, double z);
/* Is `after` what `before` was: the same primitives in order (where less is allowed, some may be gone; where templates were
 * made, a primitive may have the origin of its place), places, bounds, paint, origins? Else why. */
bool drawing_same_parts(const drawing_look *before, const drawing_look *after, bool less, bool templates, char *why, size_t room);
/* The same set of its parts, whatever they were; after drawing_same_parts. Where parts that cannot meet are left out it is not. */
bool drawing_same_sets(drawing_look *before, drawing_look *after, uint64_t seed, char *why, size_t room);
/* The same at p: inside or not, and by which primitives. *close: p is so near a surface that both answers are right. */
bool drawing_same_at(drawing_look *before, drawing_look *after, vs_vec3 p, bool *inside, bool *close, char *why, size_t room);

#endif
