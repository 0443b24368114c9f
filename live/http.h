/* Owns libmicrohttpd's functions, loaded when the first view opens: linked in, the library and the ones behind it would
 * cost every start of vs. */
#ifndef VS_LIVE_HTTP_H
#define VS_LIVE_HTTP_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>
#include <sys/socket.h>

#include <microhttpd.h>

typedef struct {
#define HTTP(name) __typeof__(&MHD_##name) name;
#include "live/http.def"
} live_http;

bool live_http_load(live_http *out); /* false: it is missing, and standard error has been told */

#endif
