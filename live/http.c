/* Loads libmicrohttpd. */
#include "live/http.h"

#include <stddef.h>
#include <stdio.h>

#include "geometry/dynamic.h"

bool live_http_load(live_http *out) {
  static const vs_dynamic_name names[] = {
#define HTTP(name) { "MHD_" #name, offsetof(live_http, name) },
#include "live/http.def"
  };
  vs_error error = { 0 };
  if (vs_dynamic_load(VS_LIBRARY_MICROHTTPD, "the live view", names, sizeof names / sizeof *names, out, &error))
    return true;
  fprintf(stderr, "vs: %s\n", error.message);
  return false;
}
