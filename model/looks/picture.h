/* Owns pictures that lie on surfaces, and their placement. */
#ifndef VS_MODEL_LOOKS_PICTURE_H
#define VS_MODEL_LOOKS_PICTURE_H

#include <stddef.h>
#include <stdint.h>

/* A photograph or a drawing on surfaces, in the bytes of its file. The store keeps it (vs_store_picture) as long as it
 * lives: formats get the bytes, and no one opens the file a second time. */
typedef struct vs_picture {
  const char *path;            /* interned; for a .pov, which names the file */
  const char *format;          /* "png", "jpeg", "exr" or "hdr": POV-Ray's words */
  const unsigned char *bytes;
  size_t size;
  uint32_t columns, rows;
  uint64_t hash;               /* of path and bytes; the store sets it */
  const struct vs_picture *next; /* for the store alone */
} vs_picture;

/* The direction of a face decides the placement of pictures on it. Directions are counted in steps of 22.5 degrees: by
 * the tilt from straight up and, if that is neither up nor down, by the azimuth. A picture differs from its size by at
 * most 2 percent (cos 11.25 degrees). */
enum { VS_PICTURE_STEPS = 16 /* of a full turn */ };
/* Returns the number of a normal's direction: faces with the same number have one plane for pictures. */
int vs_picture_direction(double x, double y, double z);
/* Returns the axes of pictures on faces of a direction, across and up as seen from outside; for faces that look up or
 * down: x, and y or -y. direction is a result of vs_picture_direction. */
void vs_picture_axes(int direction, double across[3], double up[3]);
/* Returns the position on a picture of a point in metres: in fractions of width and height, from the lower left. The
 * picture has that width and height, in metres and above 0, and that angle. */
void vs_picture_place(double width, double height, double angle, int direction, const double point[3], double out[2]);

#endif
