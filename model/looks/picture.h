/* Declares pictures that lie on surfaces, and how they lie there. */
#ifndef VS_MODEL_LOOKS_PICTURE_H
#define VS_MODEL_LOOKS_PICTURE_H

#include <stddef.h>
#include <stdint.h>

/* A photograph or a drawing that lies on surfaces, as its file has it. Kept by the store (vs_store_picture) as long as
 * it lives: formats get the bytes, and nobody opens the file a second time. */
typedef struct vs_picture {
  const char *path;            /* interned; for a .pov, which names the file */
  const char *format;          /* "png", "jpeg", "exr" or "hdr": POV-Ray's words */
  const unsigned char *bytes;
  size_t size;
  uint32_t columns, rows;
  uint64_t hash;               /* of path and bytes; the store sets it */
  const struct vs_picture *next; /* the store's own */
} vs_picture;

/* Pictures lie on faces by the way that these look. The directions are counted in steps of 22.5 degrees, by the tilt
 * from straight up and, where it is neither up nor down, by the azimuth: a picture is at most 2 percent off its size
 * (cos 11.25 degrees). */
enum { VS_PICTURE_STEPS = 16 /* of a full turn */ };
/* The number of the direction of a normal: faces of one number have one plane to lie on. */
int vs_picture_direction(double x, double y, double z);
/* Across and up on the faces of a direction as one looks at them from outside; up and down: x, and y or -y. direction
 * is one that vs_picture_direction gives. */
void vs_picture_axes(int direction, double across[3], double up[3]);
/* The place of a picture, so wide and high in metres and turned so, on which a point in metres lies: in parts of its
 * width and height, from its lower left. width and height are above 0. */
void vs_picture_place(double width, double height, double angle, int direction, const double point[3], double out[2]);

#endif
