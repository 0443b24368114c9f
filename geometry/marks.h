/* Declares sets of small numbers, in which the next member from a given number on is found in a few steps. */
#ifndef VS_GEOMETRY_MARKS_H
#define VS_GEOMETRY_MARKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { VS_MARK_LEVELS = 11 }; /* Greatest number of levels in a set. Each level has a 64th of the words of the level
                               * below, so this suffices for any set that fits into memory. */
/* A set of numbers. Bit i of level 0 is set if i is a member. Bit i of level k + 1 is set if word i of level k is not
 * 0. */
typedef struct { uint64_t *level[VS_MARK_LEVELS]; int levels; } vs_marks;

bool vs_marks_make(vs_marks *m, size_t count); /* makes m the empty set of numbers below count; returns false when
                                                * memory is out */
void vs_marks_free(vs_marks *m);
void vs_marks_set(vs_marks *m, size_t i, bool in);
size_t vs_marks_next(const vs_marks *m, size_t from); /* returns the smallest member of m that is at least `from`, or
                                                       * SIZE_MAX if there is none */

#endif
