/* Fuzzes the live view's server: the bytes are requests, one per line, with the body after a tab. The functions below
 * replace libmicrohttpd. They pass a request to the server as libmicrohttpd does, and check the response. */
#include <arpa/inet.h>

#include "tests/fuzz/fuzz.h"

#include "live/live.h"
#include "live/serve.h"

enum { WORDS = 8, ANSWER = 1 << 22 };

struct MHD_Response {
  void *bytes;
  size_t count;
  enum MHD_ResponseMemoryMode mode;
  MHD_ContentReaderCallback read;
  MHD_ContentReaderFreeCallback let_go;
  void *context;
};

/* A request: "METHOD URL?name=value&name=value|Header=value|Header=value\tbody". */
struct MHD_Connection {
  char text[4096], *method, *url;
  struct {
    enum MHD_ValueKind kind;
    char *name, *value;
  } word[WORDS];
  size_t words;
  unsigned status;
};

static MHD_AccessHandlerCallback handler;
static void *handler_context;
static void *(*begin_request)(void *context, const char *uri, struct MHD_Connection *c);

static struct MHD_Daemon *start_daemon(unsigned flags, uint16_t port, MHD_AcceptPolicyCallback accept,
                                       void *accept_context, MHD_AccessHandlerCallback handle, void *context, ...) {
  (void)flags, (void)port, (void)accept, (void)accept_context;
  handler = handle, handler_context = context;
  va_list options;
  va_start(options, context);
  for (int option; (option = va_arg(options, int)) != MHD_OPTION_END;) { /* reads the options that live/serve.c passes
                                                                          * to MHD_start_daemon */
    if (option == MHD_OPTION_URI_LOG_CALLBACK)
      begin_request = va_arg(options, void *(*)(void *, const char *, struct MHD_Connection *));
    else if (option == MHD_OPTION_EXTERNAL_LOGGER) va_arg(options, MHD_LogCallback);
    else if (option == MHD_OPTION_NOTIFY_COMPLETED) va_arg(options, MHD_RequestCompletedCallback);
    else if (option == MHD_OPTION_NOTIFY_CONNECTION) va_arg(options, MHD_NotifyConnectionCallback);
    else if (option == MHD_OPTION_CONNECTION_MEMORY_LIMIT) va_arg(options, size_t);
    else if (option == MHD_OPTION_LISTEN_SOCKET) va_arg(options, int);
    else va_arg(options, unsigned);
    if (option == MHD_OPTION_URI_LOG_CALLBACK || option == MHD_OPTION_EXTERNAL_LOGGER ||
        option == MHD_OPTION_NOTIFY_COMPLETED || option == MHD_OPTION_NOTIFY_CONNECTION)
      va_arg(options, void *);
  }
  va_end(options);
  return (struct MHD_Daemon *)(void *)&handler;
}
static void stop_daemon(struct MHD_Daemon *d) { (void)d; }
/* libmicrohttpd would return the socket of a waiting connection; here no connection waits, so no socket exists. */
static const union MHD_ConnectionInfo *get_connection_info(struct MHD_Connection *c, enum MHD_ConnectionInfoType type,
                                                           ...) {
  (void)c, (void)type;
  return NULL;
}
static const char *lookup(struct MHD_Connection *c, enum MHD_ValueKind kind, const char *name) {
  for (size_t i = 0; i < c->words; i++)
    if (c->word[i].kind == kind && !strcmp(c->word[i].name, name)) return c->word[i].value;
  return NULL;
}
static int values(struct MHD_Connection *c, enum MHD_ValueKind kind, MHD_KeyValueIterator each, void *context) {
  int count = 0;
  for (size_t i = 0; i < c->words; i++)
    if (c->word[i].kind == kind) count++, each(context, kind, c->word[i].name, c->word[i].value);
  return count;
}
static struct MHD_Response *from_buffer(size_t count, void *bytes, enum MHD_ResponseMemoryMode mode) {
  struct MHD_Response *r = calloc(1, sizeof *r);
  if (r) *r = (struct MHD_Response){ .bytes = bytes, .count = count, .mode = mode };
  return r;
}
static struct MHD_Response *from_callback(uint64_t count, size_t block, MHD_ContentReaderCallback read, void *context,
                                          MHD_ContentReaderFreeCallback let_go) {
  struct MHD_Response *r = calloc(1, sizeof *r);
  (void)count, (void)block;
  if (r) *r = (struct MHD_Response){ .read = read, .context = context, .let_go = let_go };
  return r;
}
static enum MHD_Result add_header(struct MHD_Response *r, const char *name, const char *value) {
  (void)r;
  if (strpbrk(name, "\r\n") || strpbrk(value, "\r\n")) abort(); /* a line break in a header would end the headers */
  return MHD_YES;
}
static enum MHD_Result queue(struct MHD_Connection *c, unsigned status, struct MHD_Response *r) {
  char some[4096];
  if (c->status || status < 200 || status > 599) abort();
  c->status = status;
  if (r->read)
    r->read(r->context, 0, some, sizeof some);
  else if (r->count > ANSWER)
    abort();
  else
    for (size_t i = 0; i < r->count; i++) some[i % sizeof some] = ((const char *)r->bytes)[i];
  return MHD_YES;
}
static void destroy(struct MHD_Response *r) {
  if (r->let_go) r->let_go(r->context);
  if (r->mode == MHD_RESPMEM_MUST_FREE) free(r->bytes);
  free(r);
}

static void stop(void *context) { (void)context; }

/* Ends the text at its first character that occurs in `ends`. Returns the text after that character, or NULL if there
 * is none. */
static char *cut(char *at, const char *ends) {
  char *end = at ? strpbrk(at, ends) : NULL;
  if (end) *end++ = 0;
  return end;
}

/* Returns true if the status says that the server refused the request because of its headers. */
static bool refused(unsigned status) { return status == 400 || status == 403 || status == 413; }

static void add_words(struct MHD_Connection *c, char *at, const char *ends, enum MHD_ValueKind kind) {
  for (char *next; at && c->words < WORDS; at = next) {
    next = cut(at, ends);
    char *value = cut(at, "=");
    c->word[c->words].kind = kind, c->word[c->words].name = at, c->word[c->words++].value = value;
  }
}

/* Takes the requests of the browser's windows from the queue, as the session and its side thread do. */
static void take_wishes(live_publish *p) {
  for (live_wish *w; (w = live_wish_take(p, &p->wishes, 0)) != NULL;) live_wish_free(w);
  for (live_wish *w; (w = live_wish_take(p, &p->asides, 0)) != NULL;) live_wish_free(w);
  p->wishes.now = p->asides.now = NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static live_publish publish;
  static live_server server;
  static live_options options;
  static struct MHD_Connection c;
  static char path[] = "/tmp/fuzz_live_XXXXXX";
  if (!server.publish) {
    const int f = mkstemp(path);
    if (f < 0 || write(f, "(car 5)", 7) != 7 || close(f)) abort();
    unlink(path); /* deletes the file, so that only a request can create it from here on */
    server = (live_server){ .http = { .start_daemon = start_daemon,
                                      .stop_daemon = stop_daemon,
                                      .get_connection_info = get_connection_info,
                                      .lookup_connection_value = lookup,
                                      .get_connection_values = values,
                                      .create_response_from_buffer = from_buffer,
                                      .create_response_from_callback = from_callback,
                                      .add_response_header = add_header,
                                      .queue_response = queue,
                                      .destroy_response = destroy },
                            .publish = &publish,
                            .model = path,
                            .stop = stop,
                            .options = &options };
    live_access_hosts(&server.access, 8080); /* the requests of the corpus name port 8080; nothing listens on it */
    if (!live_access_word(server.access.token) || !live_publish_open(&publish) || !live_server_open(&server)) abort();
    enum { SCENE = 60000 };
    live_scene *scene = calloc(1, sizeof *scene);
    if (!scene || !(scene->bytes = malloc(SCENE))) abort();
    for (size_t i = 0; i < SCENE; i++) scene->bytes[i] = (unsigned char)(i * i >> 5);
    scene->uses = scene->version = 1, scene->count = SCENE;
    if (!live_chunks_cut(scene->bytes, SCENE, &scene->chunks) || !live_chunks_sorted(&scene->chunks, &scene->sorted))
      abort();
    live_publish_scene(&publish, scene);
    live_publish_state(&publish, strdup("{\"good\":true}"));
    publish.ended = true; /* ends the publication, so that no request waits for a change */
  }
  fuzz_note(data, size, true);
  for (size_t from = 0, to; from < size; from = to + 1) {
    for (to = from; to < size && data[to] != '\n'; to++) {}
    if (to - from >= sizeof c.text) continue;
    memset(&c, 0, sizeof c);
    memcpy(c.text, data + from, to - from);
    char *body = cut(c.text, "\t"), *headers = cut(c.text, "|");
    c.method = c.text, c.url = cut(c.text, " ");
    if (!c.url) continue;
    char *arguments = cut(c.url, "?");
    add_words(&c, headers, "|", MHD_HEADER_KIND);
    for (size_t i = 0; i < c.words; i++)
      if (c.word[i].value && !strcmp(c.word[i].value, "TOKEN")) c.word[i].value = server.access.token;
    add_words(&c, arguments, "&", MHD_GET_ARGUMENT_KIND);
    void *state = begin_request(NULL, c.url, &c);
    size_t count = 0;
    enum MHD_Result ok = handler(handler_context, &c, c.url, c.method, "HTTP/1.1", NULL, &count, &state);
    for (size_t sent = 0, all = body ? strlen(body) : 0; ok == MHD_YES && !c.status && sent < all; sent += 7 - count) {
      count = all - sent < 7 ? all - sent : 7;
      const size_t piece = count;
      ok = handler(handler_context, &c, c.url, c.method, "HTTP/1.1", body + sent, &count, &state);
      if (ok == MHD_YES && count != 0) abort();
      if (piece < 7) break;
    }
    count = 0;
    if (ok == MHD_YES && !c.status) handler(handler_context, &c, c.url, c.method, "HTTP/1.1", NULL, &count, &state);
    const char *host = lookup(&c, MHD_HEADER_KIND, "Host"), *token = lookup(&c, MHD_HEADER_KIND, "X-VS-Token");
    const bool page = !strcmp(c.url, "/") || !strcmp(c.url, "/live.js") || !strcmp(c.url, "/live.css");
    if (c.status && !refused(c.status) &&
        (!host || (strcmp(host, server.access.hosts[0]) && strcmp(host, server.access.hosts[1]))))
      abort();
    if (c.status && !refused(c.status) && !page && (!token || strcmp(token, server.access.token)))
      abort(); /* the server must not answer a request without the token */
    struct {
      live_text body;
    } *r = state;
    if (r) live_text_free(&r->body), free(state);
    take_wishes(&publish);
  }
  unlink(path);
  return 0;
}
