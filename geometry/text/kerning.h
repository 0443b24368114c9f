/* Owns, for geometry/ alone, kerning from OpenType fonts: pairs in the table GPOS. (FreeType reads the older table
 * kern.) */
#ifndef VS_GEOMETRY_TEXT_KERNING_H
#define VS_GEOMETRY_TEXT_KERNING_H

#include <stddef.h>
#include <stdint.h>

/* Returns the change of the distance from left to right (negative: nearer), in font units; 0 if the table, of any
 * bytes, has no entry. */
double vs_kerning_pair(const unsigned char *table, size_t size, uint32_t left, uint32_t right);

#endif
