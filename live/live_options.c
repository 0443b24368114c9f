/* Implements the reading of files and folders with the callbacks in the options of a live view. */
#include "live/live_options.h"

#include "live/model_files.h"

bool live_options_read(const live_options *o, const char *path, char **text, size_t *length, const char **why) {
  const live_confinement *c = &o->confined;
  return c->read_file != NULL ? c->read_file(c->context, path, text, length, why)
                              : live_file_read(path, text, length, why);
}

bool live_options_list(const live_options *o, const char *path, bool (*take)(void *to, const char *name, size_t length),
                       void *to, const char **why) {
  const live_confinement *c = &o->confined;
  return c->list_folder != NULL ? c->list_folder(c->context, path, take, to, why)
                                : live_folder_list(path, take, to, why);
}
