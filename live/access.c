/* Implements the access control of the live view's server.
 *
 * The page itself (/, /live.js, /live.css) is equal for everybody and contains no secret. Every other request needs the
 * token in the header X-VS-Token. The page reads the token from the fragment of its address, which browsers never send,
 * not even as a Referer. A request has one Host, one of ours, and no foreign Origin. A foreign page, or a foreign name
 * that resolves to this address, therefore receives nothing. */
#include "live/access.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static bool same_secret(const char *given, const char *token) { /* the comparison takes a time that does not depend on
                                                                 * the number of equal bytes */
  unsigned char difference = strlen(given) != strlen(token);
  for (size_t i = 0; token[i] != 0; i++) difference |= (unsigned char)(token[i] ^ (difference ? 0 : given[i]));
  return difference == 0;
}

static bool own_host(const live_access *a, const char *host) {
  return host != NULL && (strcmp(host, a->hosts[0]) == 0 || strcmp(host, a->hosts[1]) == 0);
}

static enum MHD_Result count_hosts(void *context, enum MHD_ValueKind kind, const char *key, const char *value) {
  (void)kind, (void)value;
  if (strcasecmp(key, "Host") == 0) ++*(size_t *)context;
  return MHD_YES;
}

/* Returns true if everybody may read this path. */
static bool is_open(const char *url) {
  static const char *const open[] = { "/", "/live.js", "/live.css" };
  for (size_t i = 0; i < sizeof open / sizeof *open; i++)
    if (strcmp(url, open[i]) == 0) return true;
  return false;
}

live_refusal live_access_refuse(const live_http *http, struct MHD_Connection *c, const live_access *a, const char *url,
                                size_t most) {
  const char *origin = http->lookup_connection_value(c, MHD_HEADER_KIND, "Origin");
  const char *token = http->lookup_connection_value(c, MHD_HEADER_KIND, "X-VS-Token");
  const char *length = http->lookup_connection_value(c, MHD_HEADER_KIND, "Content-Length");
  size_t hosts = 0;
  http->get_connection_values(c, MHD_HEADER_KIND, count_hosts, &hosts);
  if (hosts > 1) return (live_refusal){ 400, "there are two Host headers\n" };
  if (!own_host(a, http->lookup_connection_value(c, MHD_HEADER_KIND, "Host")))
    return (live_refusal){ 403, "not this host\n" };
  if (origin != NULL && (strncmp(origin, "http://", 7) != 0 || !own_host(a, origin + 7)))
    return (live_refusal){ 403, "not from this page\n" };
  if (!is_open(url) && (token == NULL || !same_secret(token, a->token)))
    return (live_refusal){ 403, "open the address that vs view printed\n" };
  if (length != NULL && strtoull(length, NULL, 10) > most) return (live_refusal){ 413, "that is too long\n" };
  return (live_refusal){ 0, NULL };
}

void live_access_hosts(live_access *a, unsigned port) {
  snprintf(a->hosts[0], sizeof a->hosts[0], "127.0.0.1:%u", port);
  snprintf(a->hosts[1], sizeof a->hosts[1], "localhost:%u", port);
}

bool live_access_word(char out[33]) {
  unsigned char bytes[16];
  int file = open("/dev/urandom", O_RDONLY | O_CLOEXEC);
  bool ok = file >= 0 && read(file, bytes, sizeof bytes) == (ssize_t)sizeof bytes;
  if (file >= 0) close(file);
  for (size_t i = 0; ok && i < sizeof bytes; i++) snprintf(out + 2 * i, 3, "%02x", bytes[i]);
  return ok;
}
