/* Owns, for geometry/ alone, kerning as OpenType fonts say it: pairs in the table GPOS. (The older table kern is
 * FreeType's business.) */
#ifndef VS_GEOMETRY_TEXT_KERNING_H
#define VS_GEOMETRY_TEXT_KERNING_H

#include <stddef.h>
#include <stdint.h>

/* How much nearer (negative) or farther right stands to left, in font units; 0 where the table, of any bytes, says
 * nothing. */
double vs_kerning_pair(const unsigned char *table, size_t size, uint32_t left, uint32_t right);

#endif
