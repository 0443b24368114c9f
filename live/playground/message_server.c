/* Implements the functions of libmicrohttpd that live/ calls (live/http.def), for a single window that sends its
 * requests as messages. The page and the server are one program: nothing listens.
 *
 * A response is sent when it is queued. A response from a callback (the events) stays open: playground_pump sends its
 * new bytes. It is closed when the window asks for another. */
#include "live/playground/message_server.h"

#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

enum { PIECE = 1 << 16 };

typedef struct MHD_Response response;
struct MHD_Response {
  void *bytes;
  size_t count;
  MHD_ContentReaderCallback read;
  MHD_ContentReaderFreeCallback done;
  void *context;
  char type[64];
};
struct MHD_Connection { const message *asked; bool answered; };
struct MHD_Daemon { MHD_AccessHandlerCallback handle; MHD_RequestCompletedCallback completed;
  void *(*begun)(void *context, const char *uri, struct MHD_Connection *c);
  void *context, *completed_context, *begun_context; };

/* The only server, and the response for events, which stays open. They are static because libmicrohttpd's functions
 * cannot receive them as arguments. */
static struct MHD_Daemon server;
static response *open_response;
static int open_request;

struct MHD_Daemon *MHD_start_daemon(unsigned flags, uint16_t port, MHD_AcceptPolicyCallback accepts,
                                    void *accepts_context, MHD_AccessHandlerCallback handle, void *context, ...) {
  (void)flags, (void)port, (void)accepts, (void)accepts_context;
  server = (struct MHD_Daemon){ .handle = handle, .context = context };
  va_list options;
  va_start(options, context);
  for (enum MHD_OPTION option; (option = va_arg(options, enum MHD_OPTION)) != MHD_OPTION_END;) {
    if (option == MHD_OPTION_NOTIFY_COMPLETED) {
      server.completed = va_arg(options, MHD_RequestCompletedCallback);
      server.completed_context = va_arg(options, void *);
    } else if (option == MHD_OPTION_URI_LOG_CALLBACK) {
      server.begun = va_arg(options, void *(*)(void *, const char *, struct MHD_Connection *));
      server.begun_context = va_arg(options, void *);
    } else if (option == MHD_OPTION_EXTERNAL_LOGGER || option == MHD_OPTION_NOTIFY_CONNECTION) {
      (void)va_arg(options, void *), (void)va_arg(options, void *);
    } else if (option == MHD_OPTION_CONNECTION_MEMORY_LIMIT) {
      (void)va_arg(options, size_t);
    } else {
      (void)va_arg(options, unsigned);
    }
  }
  va_end(options);
  return &server;
}

void MHD_stop_daemon(struct MHD_Daemon *d) {
  (void)d;
  if (open_response != NULL) MHD_destroy_response(open_response);
  open_response = NULL;
}

const union MHD_ConnectionInfo *MHD_get_connection_info(struct MHD_Connection *c, enum MHD_ConnectionInfoType what,
                                                        ...) {
  static const union MHD_ConnectionInfo nothing = { .connect_fd = -1 }, no_context = { .socket_context = NULL };
  (void)c;
  return what == MHD_CONNECTION_INFO_CONNECTION_FD ? &nothing : &no_context;
}

const char *MHD_lookup_connection_value(struct MHD_Connection *c, enum MHD_ValueKind kind, const char *name) {
  const message *m = c->asked;
  if (kind == MHD_HEADER_KIND) {
    if (strcmp(name, "Host") == 0) return m->host;
    return strcmp(name, "X-VS-Token") == 0 ? m->token : NULL;
  }
  for (const char *at = m->query; *at != 0;) { /* the query contains names and values, each terminated by NUL; an empty
                                                * name ends it */
    const char *value = at + strlen(at) + 1;
    if (strcmp(at, name) == 0) return value;
    at = value + strlen(value) + 1;
  }
  return NULL;
}

int MHD_get_connection_values(struct MHD_Connection *c, enum MHD_ValueKind kind, MHD_KeyValueIterator each,
                              void *context) {
  const char *const headers[][2] = { { "Host", c->asked->host }, { "X-VS-Token", c->asked->token } };
  int count = 0;
  for (size_t i = 0; kind == MHD_HEADER_KIND && i < sizeof headers / sizeof *headers; i++) {
    if (headers[i][1] == NULL) continue;
    count++;
    if (each != NULL && each(context, kind, headers[i][0], headers[i][1]) == MHD_NO) break;
  }
  return count;
}

struct MHD_Response *MHD_create_response_from_buffer(size_t count, void *bytes, enum MHD_ResponseMemoryMode mode) {
  response *r = mode == MHD_RESPMEM_MUST_FREE ? vs_zeros(1, sizeof *r) : NULL;
  if (r != NULL) *r = (response){ .bytes = bytes, .count = count };
  return r;
}

struct MHD_Response *MHD_create_response_from_callback(uint64_t count, size_t block, MHD_ContentReaderCallback read,
                                                       void *context, MHD_ContentReaderFreeCallback done) {
  (void)count, (void)block;
  response *r = vs_zeros(1, sizeof *r);
  if (r != NULL) *r = (response){ .read = read, .done = done, .context = context };
  return r;
}

enum MHD_Result MHD_add_response_header(struct MHD_Response *r, const char *name, const char *value) {
  if (strcmp(name, "Content-Type") == 0) strncpy(r->type, value, sizeof r->type - 1);
  return MHD_YES;
}

enum MHD_Result MHD_queue_response(struct MHD_Connection *c, unsigned status, struct MHD_Response *r) {
  c->answered = true;
  playground_answer(c->asked->id, status, r->type, r->bytes, r->count, r->read != NULL);
  if (r->read == NULL) return MHD_YES;
  response *before = open_response;
  open_response = r;
  open_request = c->asked->id;
  if (before != NULL) MHD_destroy_response(before);
  return MHD_YES;
}

void MHD_destroy_response(struct MHD_Response *r) {
  if (r == open_response) return; /* does not free the response: the window still receives its bytes */
  if (r->done != NULL) r->done(r->context);
  free(r->bytes);
  free(r);
}

void playground_pump(void) {
  static char piece[PIECE];
  while (open_response != NULL) {
    ssize_t got = open_response->read(open_response->context, 0, piece, PIECE);
    if (got == 0) return;
    if (got > 0) {
      playground_part(open_request, piece, (size_t)got);
      continue;
    }
    response *ended = open_response;
    open_response = NULL;
    MHD_destroy_response(ended);
  }
}

void playground_ask(const message *m) {
  struct MHD_Connection c = { .asked = m };
  void *state = server.begun != NULL ? server.begun(server.begun_context, m->path, &c) : NULL;
  const struct { const char *bytes; size_t size; } calls[] = { { NULL, 0 }, { m->body, m->size }, { NULL, 0 } };
  for (size_t i = 0; i < sizeof calls / sizeof *calls && !c.answered; i++) { /* headers, body, end; a refused request
                                                                              * has its answer after its headers */
    size_t size = calls[i].size;
    if (i == 1 && size == 0) continue;
    server.handle(server.context, &c, m->path, m->method, "HTTP/1.1", calls[i].bytes, &size, &state);
  }
  if (server.completed != NULL)
    server.completed(server.completed_context, &c, &state, MHD_REQUEST_TERMINATED_COMPLETED_OK);
}
