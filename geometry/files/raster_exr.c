/* Chooses the channels of an EXR picture that contain heights. */
#include "geometry/files/raster_exr.h"

#include <string.h>

#include "geometry/files/exr_read.h"

/* Sets names[k] to the name of the k-th channel to read. Returns the number of channels, 1 or 3; 0: no channel fits. */
static size_t exr_choose_channels(const vs_exr_view *view, const char *names[3]) {
  const char *rgb[3] = { NULL, NULL, NULL }, *y = NULL, *only = NULL;
  int others = 0;
  for (size_t i = 0; i < view->count; i++) {
    const char *name = view->channels[i].name;
    if (!strcmp(name, "Y")) y = name;
    for (int k = 0; k < 3; k++)
      if (name[0] == "RGB"[k] && !name[1]) rgb[k] = name;
    if (strcmp(name, "A")) only = name, others++;
  }
  names[0] = y ? y : others == 1 && !view->more ? only : NULL;
  if (names[0]) return 1;
  memcpy(names, rgb, sizeof rgb);
  return rgb[0] && rgb[1] && rgb[2] ? 3 : 0;
}

typedef struct { vs_raster *r; const char *name; } exr_heights;

static bool exr_choose_heights(void *context, const vs_exr_view *view, vs_exr_target *targets, size_t *used,
                               vs_error *e) {
  exr_heights *h = context;
  const char *names[3];
  *used = exr_choose_channels(view, names);
  if (!*used)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture has neither Y nor one channel nor R, G and B",
                        h->name);
  if (!vs_raster_room(h->r, h->name, view->columns, view->rows, e)) return false;
  for (size_t k = 0; k < *used; k++)
    targets[k] = (vs_exr_target){ .name = names[k], .share = *used == 1 ? 1 : vs_raster_share[k], .sum = h->r->at };
  return true;
}

bool vs_raster_exr(vs_raster *r, const vs_file_bytes *file, vs_error *e) {
  return vs_exr_decode(r->store, file, NULL, exr_choose_heights, &(exr_heights){ r, file->name }, e);
}
