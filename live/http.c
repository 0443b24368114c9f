/* Owns loading libmicrohttpd. See http.h. */
#include "live/http.h"

#include <dlfcn.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

bool live_http_load(live_http *out) {
  static const char *const files[] = { "libmicrohttpd.so.12", "libmicrohttpd.so" };
  static const struct { const char *name; size_t offset; } functions[] = {
#define HTTP(name) { "MHD_" #name, offsetof(live_http, name) },
#include "live/http.def"
  };
  void *handle = NULL;
  for (size_t i = 0; handle == NULL && i < sizeof files / sizeof *files; i++) handle = dlopen(files[i], RTLD_NOW | RTLD_LOCAL);
  if (handle == NULL) {
    fprintf(stderr, "vs: the live view needs the library libmicrohttpd; it is in the package libmicrohttpd12\n");
    return false;
  }
  for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
    void *found = dlsym(handle, functions[i].name);
    if (found == NULL) {
      fprintf(stderr, "vs: libmicrohttpd is too old: it has no %s\n", functions[i].name);
      return false;
    }
    memcpy((char *)out + functions[i].offset, &found, sizeof found); /* ISO C has no cast from an object's address to a function's */
  }
  return true; /* it stays loaded until the process ends */
}
