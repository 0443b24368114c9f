/* Declares pictures on surfaces, and the functions that place them. */
#ifndef VS_MODEL_LOOKS_PICTURE_H
#define VS_MODEL_LOOKS_PICTURE_H

#include <stddef.h>
#include <stdint.h>

/* A photograph or drawing for surfaces, as the bytes of its file. The store owns it (vs_store_picture) until the store
 * is freed. Formats write these bytes, so that the file is read only once. */
typedef struct vs_picture {
  const char *path;            /* path of the picture's file, interned; .pov files contain it */
  const char *format;          /* format of the file: "png", "jpeg", "exr" or "hdr", which are keywords of POV-Ray */
  const unsigned char *bytes;
  size_t size;
  uint32_t columns, rows;
  uint64_t hash;               /* hash of the path and the file's bytes, which the store computes */
  double mean[3];              /* mean colour of the picture, if a material uses it: sRGB components, 0 to 1 */
  const struct vs_picture *next; /* next picture in the store's list */
} vs_picture;

/* Number of steps of 22.5 degrees in a full turn. The direction of a face decides how pictures lie on it, and is
 * rounded to such steps: its tilt, and unless it is horizontal, its azimuth. The rounding changes the size of a picture
 * by at most 2 percent (cos 11.25 degrees). */
enum { VS_PICTURE_STEPS = 16 /* number of steps of 22.5 degrees in a full turn */ };
/* Returns the number of the direction to which the normal (x, y, z) is rounded. On all faces with equal numbers,
 * pictures lie in parallel planes. */
int vs_picture_direction(double x, double y, double z);
/* Sets the axes of pictures on faces with this direction, a result of vs_picture_direction. As seen from outside,
 * `across` points right and `up` points up; on horizontal faces, they are x, and y or -y. */
void vs_picture_axes(int direction, double across[3], double up[3]);
/* Sets out to the position of `point` (in metres) on a picture, as fractions of its width and height, counted from its
 * lower left corner. `width`, `height`: size of the picture in metres, above 0; `angle`: its rotation in degrees. */
void vs_picture_place(double width, double height, double angle, int direction, const double point[3], double out[2]);

#endif
