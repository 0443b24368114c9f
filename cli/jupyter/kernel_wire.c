/* Sends and receives the messages of a notebook, by libzmq. libnettle signs them. A message has these parts: addresses,
 * the mark <IDS|MSG>, signature, header, header of the message that it answers, metadata, content. */
#define _GNU_SOURCE
#include "cli/jupyter/kernel_wire.h"

#include <errno.h>
#include <nettle/hmac.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include <zmq.h>

#include "cli/json.h"
#include "geometry/dynamic.h"
#include "model/store/array.h"

#define FUNCTIONS(F)                                                        \
  F(context_new, zmq_ctx_new, void *, (void))                               \
  F(context_end, zmq_ctx_term, int, (void *))                               \
  F(socket, zmq_socket, void *, (void *, int))                              \
  F(close, zmq_close, int, (void *))                                        \
  F(bind, zmq_bind, int, (void *, const char *))                            \
  F(set, zmq_setsockopt, int, (void *, int, const void *, size_t))          \
  F(poll, zmq_poll, int, (zmq_pollitem_t *, int, long))                     \
  F(send, zmq_send, int, (void *, const void *, size_t, int))               \
  F(part_init, zmq_msg_init, int, (zmq_msg_t *))                            \
  F(part_receive, zmq_msg_recv, int, (zmq_msg_t *, void *, int))            \
  F(part_close, zmq_msg_close, int, (zmq_msg_t *))                          \
  F(part_data, zmq_msg_data, void *, (zmq_msg_t *))                         \
  F(part_size, zmq_msg_size, size_t, (const zmq_msg_t *))                   \
  F(part_more, zmq_msg_more, int, (const zmq_msg_t *))
VS_DYNAMIC_FUNCTIONS(FUNCTIONS);

typedef struct {
  void (*set_key)(struct hmac_sha256_ctx *, size_t, const uint8_t *);
  void (*update)(struct hmac_sha256_ctx *, size_t, const uint8_t *);
  void (*digest)(struct hmac_sha256_ctx *, size_t, uint8_t *);
} signing;
static const vs_dynamic_name signing_names[] = {
  { "nettle_hmac_sha256_set_key", offsetof(signing, set_key) },
  { "nettle_hmac_sha256_update", offsetof(signing, update) },
  { "nettle_hmac_sha256_digest", offsetof(signing, digest) },
};

typedef struct { dynamic_functions zmq; signing sign; } functions;
enum { SIGNATURE = 65, MOST_PARTS = 64, MOST_CONNECTION = 65536 };

static const functions *of(const kernel_wire *w) { return w->functions; }

/* ---- opening ---- */

static const struct { const char *port; int kind; } rows[WIRE_SOCKETS] = {
  [WIRE_SHELL] = { "shell_port", ZMQ_ROUTER }, [WIRE_CONTROL] = { "control_port", ZMQ_ROUTER },
  [WIRE_STDIN] = { "stdin_port", ZMQ_ROUTER }, [WIRE_IOPUB] = { "iopub_port", ZMQ_PUB },
  [WIRE_HEARTBEAT] = { "hb_port", ZMQ_REP },
};

static bool load(kernel_wire *w) {
  vs_error e = { 0 };
  functions *f = w->functions = vs_zeros(1, sizeof *f);
  bool ok = f &&
            vs_dynamic_load(VS_LIBRARY_ZEROMQ, "notebooks", dynamic_names, sizeof dynamic_names / sizeof *dynamic_names,
                            &f->zmq, &e) &&
            vs_dynamic_load(VS_LIBRARY_NETTLE, "signatures", signing_names,
                            sizeof signing_names / sizeof *signing_names, &f->sign, &e);
  if (!ok) fprintf(stderr, "vs jupyter: %s\n", f ? e.message : "out of memory");
  else if (!cli_data_open(&w->json)) fprintf(stderr, "vs jupyter: %s\n", w->json.trouble), ok = false;
  return ok;
}

static cli_data read_connection(kernel_wire *w, const char *path) {
  char text[MOST_CONNECTION];
  FILE *from = fopen(path, "rb");
  size_t n = from ? fread(text, 1, sizeof text, from) : 0;
  if (from) fclose(from);
  cli_data all = from ? cli_data_read(&w->json, text, n) : NULL;
  if (!all) fprintf(stderr, "vs jupyter: %s: %s\n", path, from ? "it is no connection file" : strerror(errno));
  return all;
}

static void *beat(void *context) {
  kernel_wire *w = context;
  zmq_msg_t part;
  while (true) { /* receives until zmq closes the context */
    of(w)->zmq.part_init(&part);
    int n = of(w)->zmq.part_receive(&part, w->sockets[WIRE_HEARTBEAT], 0);
    if (n >= 0) of(w)->zmq.send(w->sockets[WIRE_HEARTBEAT], of(w)->zmq.part_data(&part), (size_t)n, 0);
    of(w)->zmq.part_close(&part);
    if (n < 0 && errno != EINTR) break;
  }
  of(w)->zmq.close(w->sockets[WIRE_HEARTBEAT]);
  return NULL;
}

bool wire_open(kernel_wire *w, const char *path, bool *missing) {
  *w = (kernel_wire){ 0 };
  *missing = !load(w);
  cli_data all = *missing ? NULL : read_connection(w, path);
  if (!all) return false;
  const char *ip = cli_data_text(&w->json, all, "ip", NULL), *key = cli_data_text(&w->json, all, "key", NULL);
  const char *transport = cli_data_text(&w->json, all, "transport", NULL);
  snprintf(w->key, sizeof w->key, "%s", key ? key : "");
  snprintf(w->session, sizeof w->session, "vs-%ld-%lld", (long)getpid(), (long long)time(NULL));
  w->context = of(w)->zmq.context_new();
  bool ok = w->context && (!transport || !strcmp(transport, "tcp"));
  for (int i = 0; ok && i < WIRE_SOCKETS; i++) {
    char address[200];
    int linger = 1000;
    snprintf(address, sizeof address, "tcp://%s:%lld", ip ? ip : "127.0.0.1",
             cli_data_number(&w->json, all, rows[i].port, -1));
    w->sockets[i] = of(w)->zmq.socket(w->context, rows[i].kind);
    ok = w->sockets[i] && of(w)->zmq.set(w->sockets[i], ZMQ_LINGER, &linger, sizeof linger) == 0 &&
         of(w)->zmq.bind(w->sockets[i], address) == 0;
    if (!ok) fprintf(stderr, "vs jupyter: %s: the address cannot be used\n", address);
  }
  cli_data_free(&w->json, all);
  w->beats = ok && pthread_create(&w->heart, NULL, beat, w) == 0;
  return ok && w->beats;
}

void wire_close(kernel_wire *w) {
  for (int i = 0; i < WIRE_SOCKETS; i++)
    if (w->sockets[i] && !(i == WIRE_HEARTBEAT && w->beats)) of(w)->zmq.close(w->sockets[i]);
  if (w->context) of(w)->zmq.context_end(w->context);
  if (w->beats) pthread_join(w->heart, NULL);
  cli_data_close(&w->json);
  free(w->functions);
  *w = (kernel_wire){ 0 };
}

/* ---- signatures ---- */

/* Sets hex to the signature of the message's four parts, or to "" if the connection has no key. */
static void sign(const kernel_wire *w, const wire_part parts[4], char hex[SIGNATURE]) {
  struct hmac_sha256_ctx state;
  uint8_t bytes[SHA256_DIGEST_SIZE];
  *hex = 0;
  if (!*w->key) return;
  of(w)->sign.set_key(&state, strlen(w->key), (const uint8_t *)w->key);
  for (int i = 0; i < 4; i++) of(w)->sign.update(&state, parts[i].length, (const uint8_t *)parts[i].at);
  of(w)->sign.digest(&state, sizeof bytes, bytes);
  for (size_t i = 0; i < sizeof bytes; i++) snprintf(hex + 2 * i, 3, "%02x", bytes[i]);
}

/* Compares two signatures in a time that does not depend on their bytes, against guessing. */
static bool is_same(const char *a, const wire_part *b) {
  size_t n = strlen(a);
  unsigned char differs = n != b->length;
  for (size_t i = 0; i < n && i < b->length; i++) differs |= (unsigned char)(a[i] ^ b->at[i]);
  return !differs;
}

/* ---- receiving ---- */

static bool receive_parts(kernel_wire *w, void *socket, wire_part parts[MOST_PARTS], size_t *count) {
  bool more = true, ok = true;
  while (more) {
    zmq_msg_t part;
    of(w)->zmq.part_init(&part);
    if (of(w)->zmq.part_receive(&part, socket, 0) < 0) ok = more = false;
    else {
      size_t n = of(w)->zmq.part_size(&part), room = 0;
      wire_part p = { 0 };
      ok = ok && *count < MOST_PARTS && VS_GROW(p.at, room, n + 1);
      if (ok) memcpy(p.at, of(w)->zmq.part_data(&part), n), p.at[n] = 0, p.length = n, parts[(*count)++] = p;
      more = of(w)->zmq.part_more(&part) != 0;
    }
    of(w)->zmq.part_close(&part);
  }
  return ok;
}

/* Makes a message from its received parts. The message then owns its addresses and its header. */
static bool take_parts(kernel_wire *w, wire_message *m, wire_part *parts, size_t count) {
  static const char mark[] = "<IDS|MSG>";
  char hex[SIGNATURE];
  size_t at = 0;
  while (at < count && !is_same(mark, &parts[at])) at++;
  if (count < 6 || at > count - 6 || at > WIRE_ADDRESSES) return false;
  sign(w, &parts[at + 2], hex);
  if (!is_same(hex, &parts[at + 1])) return false;
  m->head = cli_data_read(&w->json, parts[at + 2].at, parts[at + 2].length);
  m->content = cli_data_read(&w->json, parts[at + 5].at, parts[at + 5].length);
  if (!m->head || !m->content || !cli_data_text(&w->json, m->head, "msg_type", NULL)) return false;
  for (; m->addresses < at; m->addresses++) {
    m->address[m->addresses] = parts[m->addresses];
    parts[m->addresses].at = NULL;
  }
  m->header = parts[at + 2], parts[at + 2].at = NULL;
  return true;
}

bool wire_receive(kernel_wire *w, wire_message *m, int milliseconds) {
  static const wire_socket order[] = { WIRE_CONTROL, WIRE_SHELL };
  zmq_pollitem_t ready[2] = { { w->sockets[WIRE_CONTROL], 0, ZMQ_POLLIN, 0 },
                              { w->sockets[WIRE_SHELL], 0, ZMQ_POLLIN, 0 } };
  if (of(w)->zmq.poll(ready, 2, milliseconds) <= 0) return false;
  int i = ready[0].revents ? 0 : 1;
  wire_part parts[MOST_PARTS];
  size_t count = 0;
  *m = (wire_message){ .from = order[i] };
  bool ok = receive_parts(w, w->sockets[order[i]], parts, &count) && take_parts(w, m, parts, count);
  for (size_t k = 0; k < count; k++) free(parts[k].at);
  if (!ok) wire_message_free(w, m);
  return ok;
}

void wire_message_free(kernel_wire *w, wire_message *m) {
  for (size_t i = 0; i < m->addresses; i++) free(m->address[i].at);
  free(m->header.at);
  cli_data_free(&w->json, m->head);
  cli_data_free(&w->json, m->content);
  *m = (wire_message){ 0 };
}

/* ---- sending ---- */

static void send_part(kernel_wire *w, void *socket, const char *text, size_t length, bool more) {
  of(w)->zmq.send(socket, text, length, more ? ZMQ_SNDMORE : 0);
}

static void send_message(kernel_wire *w, wire_socket to, const wire_message *m, const char *type, const char *content) {
  char hex[SIGNATURE], date[40], *header = NULL;
  size_t length = 0;
  time_t now = time(NULL);
  struct tm utc;
  strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
  FILE *text = open_memstream(&header, &length);
  if (!text) return;
  fprintf(text, "{\"msg_id\":\"%s-%lu\",\"session\":\"%s\",\"username\":\"vs\",\"date\":\"%s\",\"msg_type\":\"%s\","
                "\"version\":\"5.3\"}", w->session, ++w->sent, w->session, date, type);
  if (fclose(text) == 0) {
    wire_part none = { (char *)(size_t) "{}", 2 };
    wire_part parts[4] = { { header, length }, m->header.at ? m->header : none, none,
                           { (char *)(size_t)content, strlen(content) } };
    void *socket = w->sockets[to];
    sign(w, parts, hex);
    for (size_t i = 0; to != WIRE_IOPUB && i < m->addresses; i++)
      send_part(w, socket, m->address[i].at, m->address[i].length, true);
    if (to == WIRE_IOPUB) send_part(w, socket, type, strlen(type), true);
    send_part(w, socket, "<IDS|MSG>", 9, true);
    send_part(w, socket, hex, strlen(hex), true);
    for (int i = 0; i < 4; i++) send_part(w, socket, parts[i].at, parts[i].length, i < 3);
  }
  free(header);
}

void wire_reply(kernel_wire *w, const wire_message *m, const char *type, const char *content) {
  send_message(w, m->from, m, type, content);
}

void wire_publish(kernel_wire *w, const wire_message *m, const char *type, const char *content) {
  send_message(w, WIRE_IOPUB, m, type, content);
}
