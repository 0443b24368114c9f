/* Owns writing PNG pictures by libpng's simple interface, loaded at the first one. Nothing in them is dated. */
#include "geometry/files/png_write.h"

#include <png.h>
#include <string.h>

#include "geometry/files/raster.h"

typedef struct {
  int (*write)(png_imagep, void *, png_alloc_size_t *, int, const void *, png_int_32, const void *);
  void (*free)(png_imagep);
} png_functions;

static const vs_dynamic_name png_names[] = {
  { "png_image_write_to_memory", offsetof(png_functions, write) },
  { "png_image_free", offsetof(png_functions, free) },
};

bool vs_png_write(vs_store *store, const unsigned char *rgb, uint32_t columns, uint32_t rows, unsigned char **bytes,
                  size_t *size, size_t *room, vs_error *e) {
  png_functions call;
  if (!vs_dynamic_load(&vs_png_library, png_names, sizeof png_names / sizeof *png_names, &call, e)) return false;
  png_image image;
  memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = columns, image.height = rows, image.format = PNG_FORMAT_RGB;
  png_alloc_size_t most = PNG_IMAGE_PNG_SIZE_MAX(image), used = most;
  unsigned char *at = vs_store_realloc(store, NULL, 0, most);
  if (!at) return vs_error_memory(e, NULL);
  bool ok = call.write(&image, at, &used, 0, rgb, (png_int_32)(columns * 3), NULL) != 0;
  if (!ok) {
    vs_store_realloc(store, at, most, 0);
    if (strstr(image.message, "memory")) vs_error_memory(e, NULL);
    else vs_error_set(e, VS_ERROR_MODEL, NULL, "the PNG picture cannot be written: %s", image.message);
  } else *bytes = at, *size = used, *room = most;
  call.free(&image);
  return ok;
}
