/* Owns sets of small numbers that give the next member from a place on in a few steps. */
#ifndef VS_GEOMETRY_MARKS_H
#define VS_GEOMETRY_MARKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { VS_MARK_LEVELS = 11 }; /* of 64-bit words: more than memory holds */
/* a bit of level k + 1 is set where a word of level k is not 0 */
typedef struct { uint64_t *level[VS_MARK_LEVELS]; int levels; } vs_marks;

bool vs_marks_make(vs_marks *m, size_t count); /* the numbers from 0 below count, none in it; false: out of memory */
void vs_marks_free(vs_marks *m);
void vs_marks_set(vs_marks *m, size_t i, bool in);
size_t vs_marks_next(const vs_marks *m, size_t from); /* the smallest member from `from` on; SIZE_MAX: none */

#endif
