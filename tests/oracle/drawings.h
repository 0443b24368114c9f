/* Declares random drawings of every kind of node, for tests of passes that rewrite drawings. Also declares comparisons
 * of the properties that a pass must keep. */
#ifndef VS_TESTS_DRAWINGS_H
#define VS_TESTS_DRAWINGS_H

#include <stdio.h>

#include "geometry/measure/node_measures.h"
#include "model/scene.h"

enum { DRAWN_MOST = 3 };
typedef struct { vs_ref at[DRAWN_MOST]; size_t count; } drawing; /* at[i]: top-level entry i of the drawing; the array
                                                                  * holds a reference to each */

/* Returns the drawing of this seed. Every reference in it has a distinct origin: "random.vs" with a distinct line. */
drawing drawing_make(vs_store *s, uint64_t seed);
drawing drawing_retain(const drawing *d);
void drawing_release(drawing *d);
void drawing_print(const drawing *d, FILE *out); /* prints the drawing in the form of the tree dump */

/* Returns true if the drawing still shows the fault. drawing_shrink calls this function for smaller and smaller
 * drawings. */
typedef bool drawing_fails(void *context, const drawing *d);
void drawing_shrink(drawing *d, drawing_fails *fails, void *context); /* replaces *d by the smallest failing drawing
                                                                       * that it finds */

/* The parts of a drawing. For every path from the root to a primitive, in order, a look contains the primitive with its
 * placement, paint and origins. */
typedef struct drawing_look drawing_look;
typedef struct drawing_memo drawing_memo; /* cache of data that several looks share for equal parts; it must be freed
                                           * after the looks */
drawing_memo *drawing_memo_new(void);
void drawing_memo_free(drawing_memo *m);
drawing_look *drawing_look_new(const drawing *d, drawing_memo *m); /* returns the look of the drawing, or NULL if the
                                                                    * drawing has too many paths */
void drawing_look_free(drawing_look *l);
/* Returns a point in the box of a part. Four numbers of 0..1 select the part and the position in its box. */
vs_vec3 drawing_look_point(const drawing_look *l, double which, double x, double y, double z);
/* Returns true if `after` has the parts of `before`: equal primitives in order, with equal placements, bounds, paint
 * and origins. With `less`, `after` may lack parts. With `templates`, a primitive may have the origin of the place
 * where its template is used. If false, writes the reason to `why`. */
bool drawing_same_parts(const drawing_look *before, const drawing_look *after, bool less, bool templates, char *why, size_t room);
/* Returns true if the two looks combine their parts by equivalent set operations, for parts of any shape. Call it after
 * drawing_same_parts. The answer is false after passes that omit parts which cannot intersect. */
bool drawing_same_sets(drawing_look *before, drawing_look *after, uint64_t seed, char *why, size_t room);
/* Returns true if the two looks agree at the point p: whether p is inside the drawing, and inside which primitives.
 * Sets *close if p is so close to a surface that rounding may decide. */
bool drawing_same_at(drawing_look *before, drawing_look *after, vs_vec3 p, bool *inside, bool *close, char *why, size_t room);

#endif
