/* Declares the pixels of a picture for a screen. */
#ifndef VS_GEOMETRY_FILES_PIXELS_H
#define VS_GEOMETRY_FILES_PIXELS_H

#include <stdint.h>

/* Three bytes for each pixel: red, green and blue of sRGB; row by row from the top. */
typedef struct { unsigned char *rgb; uint32_t columns, rows; } vs_pixels;

#endif
