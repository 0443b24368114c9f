/* Declares kerning from OpenType fonts, for use in geometry/ alone: pairs in the table GPOS. (FreeType reads the older
 * table kern.) */
#ifndef VS_GEOMETRY_TEXT_KERNING_H
#define VS_GEOMETRY_TEXT_KERNING_H

#include <stddef.h>
#include <stdint.h>

/* Returns the correction of the distance from the glyph `left` to the glyph `right`, in font units; it is negative if
 * they move closer. Returns 0 if the GPOS table has no entry for the pair. The table may contain any bytes. */
double vs_kerning_pair(const unsigned char *table, size_t size, uint32_t left, uint32_t right);

#endif
