/* Declares the functions of libmicrohttpd, which is loaded when the first view opens. If it were linked, the library
 * and its dependencies would slow each start of vs. */
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

bool live_http_load(live_http *out); /* Loads the library. Returns false, after a message on standard error, if it is
                                      * missing. */

#endif
