/* Implements the HTTP server of the live view: access control, and the answers to requests.
 *
 * The server listens on the loopback address only. access.c decides which requests it accepts, before their bodies are
 * read. The server serves no file by name.
 *
 * The server limits the number of connections, the bytes of a request's head and body, the bytes of waiting work, the
 * time of a silent client, and the number of slow clients (waiting.h). */
#define _GNU_SOURCE
#include "live/serve.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "live/access.h"
#include "live/model_files.h"
#include "live/live_options.h"
#include "model/signals.h"

enum { BODY_MOST = 16 << 20, CONNECTIONS = 32, WINDOWS = 12, SILENCE = 30, EXPORT_SECONDS = 3600 };

#define ASSET(name) extern const char vs_asset_##name[], vs_asset_##name##_end[];
ASSET(live_html) ASSET(live_js) ASSET(live_css)
#undef ASSET

/* Frames are for panels of VS Code alone: no page of the web has an address with these schemes. */
#define POLICY(styles) \
  "default-src 'none'; script-src 'self'; style-src 'self'" styles "; style-src-attr 'unsafe-inline'; " \
  "connect-src 'self'; img-src 'self' blob: data:; media-src blob:; base-uri 'none'; form-action 'none'; " \
  "frame-ancestors vscode-webview: vscode-file:"

/* began: whether the request's headers were read. zero: whether its path or query contains the character U+0000. */
typedef struct { live_text body; bool too_long, began, zero; } request;

/* ---- answers ---- */

static enum MHD_Result answer_under(live_server *s, struct MHD_Connection *c, struct MHD_Response *r, unsigned status,
                                    const char *type, const char *policy) {
  if (r == NULL) return MHD_NO;
  static const char *const headers[][2] = {
    { "X-Content-Type-Options", "nosniff" }, { "Referrer-Policy", "no-referrer" }, { "Cache-Control", "no-store" },
    { "Cross-Origin-Resource-Policy", "same-origin" }, { "Cross-Origin-Opener-Policy", "same-origin" } };
  s->http.add_response_header(r, "Content-Security-Policy", policy);
  for (size_t i = 0; i < sizeof headers / sizeof *headers; i++)
    s->http.add_response_header(r, headers[i][0], headers[i][1]);
  s->http.add_response_header(r, "Content-Type", type);
  enum MHD_Result ok = s->http.queue_response(c, status, r);
  s->http.destroy_response(r);
  return ok;
}

static enum MHD_Result answer(live_server *s, struct MHD_Connection *c, struct MHD_Response *r, unsigned status,
                              const char *type) {
  return answer_under(s, c, r, status, type, POLICY(""));
}

static enum MHD_Result answer_bytes(live_server *s, struct MHD_Connection *c, unsigned status, const char *type,
                                    const void *bytes, size_t count) {
  char *copy = malloc(count + 1); /* MHD does not accept a pointer to constant data */
  if (copy == NULL) return MHD_NO;
  memcpy(copy, bytes, count);
  return answer(s, c, s->http.create_response_from_buffer(count, copy, MHD_RESPMEM_MUST_FREE), status, type);
}

static enum MHD_Result answer_text(live_server *s, struct MHD_Connection *c, unsigned status, const char *text) {
  return answer_bytes(s, c, status, "text/plain; charset=utf-8", text, strlen(text));
}

static enum MHD_Result answer_live_text(live_server *s, struct MHD_Connection *c, const char *type, live_text *t) {
  if (t->failed || t->at == NULL) {
    live_text_free(t);
    return answer_text(s, c, 500, "out of memory\n");
  }
  struct MHD_Response *r = s->http.create_response_from_buffer(t->length, t->at, MHD_RESPMEM_MUST_FREE);
  if (r == NULL) live_text_free(t);
  return answer(s, c, r, 200, type);
}

static const char *query(const live_server *s, struct MHD_Connection *c, const char *name) {
  return s->http.lookup_connection_value(c, MHD_GET_ARGUMENT_KIND, name);
}

/* ---- events ---- */

typedef struct {
  live_server *server;
  int socket;
  unsigned long next;
  live_text text;
  size_t sent;
  bool first;
} listener;

/* Returns true if the window has closed its side of the connection. A failed write would also show this, but there may
 * be nothing to write for a long time. */
static bool gone(int socket) {
  char byte;
  ssize_t got = recv(socket, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return got == 0 || (got < 0 && socket >= 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
}

static struct timespec in_seconds(int seconds) {
  struct timespec until;
  clock_gettime(CLOCK_MONOTONIC, &until);
  until.tv_sec += seconds;
  return until;
}

static ssize_t listener_read(void *context, uint64_t position, char *buffer, size_t most) {
  listener *l = context;
  live_publish *p = l->server->publish;
  (void)position;
  while (l->sent >= l->text.length) {
    live_text_free(&l->text);
    l->sent = 0;
    pthread_mutex_lock(&p->lock);
    if (l->first) { /* a new window receives the whole state, and then each event */
      l->next = p->event_count;
      if (p->state != NULL) {
        live_puts(&l->text, "event: state\ndata: ");
        live_puts(&l->text, p->state);
        live_puts(&l->text, "\n\n");
      }
      l->first = false;
    } else if (l->next == p->event_count && !p->ended && p->alone != NULL) {
      pthread_mutex_unlock(&p->lock);
      return 0; /* returns no bytes now; the window will request events again */
    } else if (l->next == p->event_count && !p->ended) {
      struct timespec until = in_seconds(5);
      /* writes a line without data, because a failed write shows that the window is gone */
      if (pthread_cond_timedwait(&p->changed, &p->lock, &until) == ETIMEDOUT) live_puts(&l->text, ": here\n\n");
      if (gone(l->socket)) {
        pthread_mutex_unlock(&p->lock);
        return MHD_CONTENT_READER_END_WITH_ERROR;
      }
    }
    if (p->event_count - l->next > LIVE_EVENTS) { /* the window was too slow and has missed events; the newest state
                                                   * contains everything that it missed */
      l->next = p->event_count;
      if (p->state != NULL) {
        live_puts(&l->text, "event: state\ndata: ");
        live_puts(&l->text, p->state);
        live_puts(&l->text, "\n\n");
      }
    }
    for (; l->next < p->event_count; l->next++) live_puts(&l->text, p->events[l->next % LIVE_EVENTS]);
    bool ended = p->ended, failed = l->text.failed;
    pthread_mutex_unlock(&p->lock);
    if (failed) return MHD_CONTENT_READER_END_WITH_ERROR;
    if (ended && l->text.length == 0) return MHD_CONTENT_READER_END_OF_STREAM;
  }
  size_t count = l->text.length - l->sent < most ? l->text.length - l->sent : most;
  memcpy(buffer, l->text.at + l->sent, count);
  l->sent += count;
  return (ssize_t)count;
}

static void listener_free(void *context) {
  listener *l = context;
  pthread_mutex_lock(&l->server->publish->lock);
  l->server->publish->windows--;
  pthread_cond_broadcast(&l->server->publish->changed); /* wakes new windows, which wait while too many windows are
                                                         * open */
  pthread_mutex_unlock(&l->server->publish->lock);
  live_text_free(&l->text);
  free(l);
}

static enum MHD_Result serve_events(live_server *s, struct MHD_Connection *c) {
  listener *l = calloc(1, sizeof *l);
  if (l == NULL) return MHD_NO;
  const union MHD_ConnectionInfo *info = s->http.get_connection_info(c, MHD_CONNECTION_INFO_CONNECTION_FD);
  l->server = s;
  l->socket = info != NULL ? info->connect_fd : -1;
  l->first = true;
  pthread_mutex_lock(&s->publish->lock);
  /* A page that is reloaded repeatedly leaves connections of closed windows behind. If there are too many windows,
   * wakes their threads, which write and thereby find out whether their window is gone, and waits until one ends. */
  struct timespec until = in_seconds(1);
  if (s->publish->windows >= WINDOWS && s->publish->alone == NULL) pthread_cond_broadcast(&s->publish->changed);
  while (s->publish->windows >= WINDOWS && !s->publish->ended && s->publish->alone == NULL)
    if (pthread_cond_timedwait(&s->publish->changed, &s->publish->lock, &until) == ETIMEDOUT) break;
  bool room = s->publish->windows < WINDOWS;
  if (room) s->publish->windows++;
  pthread_mutex_unlock(&s->publish->lock);
  if (!room) {
    free(l);
    return answer_text(s, c, 503, "too many windows are open\n");
  }
  struct MHD_Response *r =
      s->http.create_response_from_callback(MHD_SIZE_UNKNOWN, 4096, listener_read, l, listener_free);
  if (r == NULL) listener_free(l);
  return answer(s, c, r, 200, "text/event-stream");
}

/* ---- the scene ---- */

static void put_u32(live_text *t, uint32_t x) {
  const unsigned char b[4] = { (unsigned char)x, (unsigned char)(x >> 8), (unsigned char)(x >> 16),
                               (unsigned char)(x >> 24) };
  live_add(t, b, 4);
}

/* Answers with the scene: "VSL1", the version and the number of pieces. Each piece has its hash (8 bytes) and its
 * length, with the highest bit set if its bytes follow. Then these bytes follow. have: the version whose pieces the
 * window still has. */
static enum MHD_Result serve_scene(live_server *s, struct MHD_Connection *c) {
  const char *have = query(s, c, "have");
  unsigned version = have != NULL ? (unsigned)strtoul(have, NULL, 10) : 0;
  live_scene *scene = live_scene_take(s->publish);
  if (scene == NULL) return answer_text(s, c, 404, "there is no scene yet\n");
  live_text t = { 0 };
  live_puts(&t, "VSL1");
  put_u32(&t, scene->version);
  put_u32(&t, (uint32_t)scene->chunks.count);
  bool *missing = calloc(scene->chunks.count + 1, sizeof *missing);
  if (missing != NULL) {
    pthread_mutex_lock(&s->publish->lock);
    const live_chunks *past = version > 0 && s->publish->past_version[version % LIVE_VERSIONS] == version
                                  ? &s->publish->past[version % LIVE_VERSIONS]
                                  : NULL;
    for (size_t i = 0; i < scene->chunks.count; i++)
      missing[i] = past == NULL || !live_chunks_have(past, scene->chunks.at[i].hash, scene->chunks.at[i].length);
    pthread_mutex_unlock(&s->publish->lock);
    for (size_t i = 0; i < scene->chunks.count; i++) {
      put_u32(&t, (uint32_t)scene->chunks.at[i].hash);
      put_u32(&t, (uint32_t)(scene->chunks.at[i].hash >> 32));
      put_u32(&t, scene->chunks.at[i].length | (missing[i] ? 0x80000000u : 0));
    }
    for (size_t i = 0; i < scene->chunks.count; i++)
      if (missing[i]) live_add(&t, scene->bytes + scene->chunks.at[i].from, scene->chunks.at[i].length);
  } else {
    t.failed = true;
  }
  free(missing);
  live_scene_release(s->publish, scene);
  return answer_live_text(s, c, "application/octet-stream", &t);
}

/* ---- the source text of the model ---- */

static const char READ_ONLY[] = "the model is untrusted: this view is read only, and starts no external program\n";
static const char NO_SOURCE[] = "the view follows a prompt: there is no file behind it\n";

static enum MHD_Result serve_source(live_server *s, struct MHD_Connection *c) {
  char *text = NULL;
  size_t length = 0;
  const char *why;
  if (s->model == NULL) return answer_text(s, c, 404, NO_SOURCE);
  if (!live_options_read(s->options, s->model, &text, &length, &why)) return answer_text(s, c, 404, why);
  live_text t = { 0 };
  live_puts(&t, "{\"path\":");
  live_json(&t, s->model);
  live_putf(&t, ",\"hash\":\"%016llx\",\"text\":", (unsigned long long)live_file_hash(text, length));
  live_json_bytes(&t, text, length);
  live_puts(&t, "}");
  free(text);
  return answer_live_text(s, c, "application/json", &t);
}

static enum MHD_Result save_source(live_server *s, struct MHD_Connection *c, const live_text *body) {
  const char *expected = query(s, c, "hash"), *text = body->at != NULL ? body->at : "";
  if (s->model == NULL) return answer_text(s, c, 404, NO_SOURCE);
  if (expected == NULL) return answer_text(s, c, 400, "the request does not name the version that it replaces\n");
  const char *why = live_file_write(s->model, text, body->length, strtoull(expected, NULL, 16));
  if (why == LIVE_NEWER) return answer_text(s, c, 409, why);
  if (why != NULL) return answer_text(s, c, 500, why);
  live_text t = { 0 };
  live_putf(&t, "{\"hash\":\"%016llx\"}", (unsigned long long)live_file_hash(text, body->length));
  return answer_live_text(s, c, "application/json", &t);
}

/* ---- other requests ---- */

static bool each_name(void *context, const char *name) {
  live_text *t = context;
  if (t->length > 60000) return false;
  if (t->length > 1) live_puts(t, ",");
  live_json(t, name);
  return true;
}

static enum MHD_Result serve_names(live_server *s, struct MHD_Connection *c) {
  const char *prefix = query(s, c, "prefix");
  live_text t = { 0 };
  live_puts(&t, "[");
  pthread_mutex_lock(&s->names_lock);
  if (s->names != NULL && prefix != NULL) vs_complete(s->names, prefix, each_name, &t);
  pthread_mutex_unlock(&s->names_lock);
  live_puts(&t, "]");
  return answer_live_text(s, c, "application/json", &t);
}

/* Answers with the forms in which a name of the language can be called, which the window shows below the source. The
 * answer is an empty object if there is no such name. */
static enum MHD_Result serve_name(live_server *s, struct MHD_Connection *c) {
  const char *name = query(s, c, "of");
  vs_name_info info;
  live_text t = { 0 };
  live_puts(&t, "{");
  pthread_mutex_lock(&s->names_lock);
  if (s->names != NULL && name != NULL && vs_name_get(s->names, name, &info)) {
    live_puts(&t, "\"call\":");
    live_json(&t, info.call);
    live_puts(&t, ",\"keywords\":");
    live_json(&t, info.keywords);
    live_puts(&t, ",\"doc\":");
    live_json(&t, info.doc);
  }
  pthread_mutex_unlock(&s->names_lock);
  live_puts(&t, "}");
  return answer_live_text(s, c, "application/json", &t);
}

/* Answers with the formats of outputs, which a window offers, in the library's order. */
static enum MHD_Result serve_formats(live_server *s, struct MHD_Connection *c) {
  size_t count;
  const vs_format_info *formats = vs_format_list(&count);
  live_text t = { 0 };
  live_puts(&t, "[");
  for (size_t i = 0; i < count; i++) {
    if (s->options->read_only && formats[i].worker != NULL) continue;
    live_puts(&t, t.length > 1 ? ",{\"name\":" : "{\"name\":");
    live_json(&t, formats[i].name);
    live_puts(&t, ",\"suffix\":");
    live_json(&t, formats[i].suffix);
    live_puts(&t, ",\"doc\":");
    live_json(&t, formats[i].doc);
    live_puts(&t, formats[i].worker != NULL ? ",\"worker\":true}" : ",\"worker\":false}");
  }
  live_puts(&t, "]");
  return answer_live_text(s, c, "application/json", &t);
}

/* Checks a text that a window is editing, and answers with the findings as `vs check --json` writes them. */
static enum MHD_Result serve_check(live_server *s, struct MHD_Connection *c, const live_text *body) {
  char *bytes = NULL;
  size_t count = 0;
  FILE *to = s->options->check != NULL && s->model != NULL ? open_memstream(&bytes, &count) : NULL;
  if (to == NULL) return answer_text(s, c, 404, "nobody checks here\n");
  const char *text = body->at != NULL ? body->at : "";
  pthread_mutex_lock(&s->names_lock); /* runs only one check at a time, because each may need much memory and seconds */
  bool ok = s->options->check(&s->options->interpreter, s->model, text, body->length, to);
  pthread_mutex_unlock(&s->names_lock);
  ok = fclose(to) == 0 && ok;
  enum MHD_Result result =
      ok ? answer_bytes(s, c, 200, "application/json", bytes, count) : answer_text(s, c, 500, "out of memory\n");
  free(bytes);
  return result;
}

static enum MHD_Result wish(live_server *s, struct MHD_Connection *c, live_wish_kind kind, const char *name,
                            const char *value) {
  live_wish *w = name != NULL && value != NULL ? live_wish_new(kind, name, value) : NULL;
  if (w == NULL) return answer_text(s, c, 400, "something is missing\n");
  w->coarse = query(s, c, "coarse") != NULL;
  return live_wish_put(s->publish, &s->publish->wishes, w) ? answer_text(s, c, 202, "ok\n")
                                                           : answer_text(s, c, 503, "too many requests are waiting\n");
}

/* Puts a request into a queue, waits for its result, and answers with it. Takes ownership of w. */
static enum MHD_Result await(live_server *s, struct MHD_Connection *c, live_queue *queue, live_wish *w,
                             const char *type) {
  live_publish *p = s->publish;
  if (!live_wish_put(p, queue, w))
    return answer_text(s, c, 503, "too many requests are waiting\n");
  struct timespec until;
  clock_gettime(CLOCK_MONOTONIC, &until);
  until.tv_sec += EXPORT_SECONDS;
  if (p->alone != NULL) p->alone(p->alone_context, true);
  pthread_mutex_lock(&p->lock);
  while (!w->done && !p->ended && p->alone == NULL)
    if (pthread_cond_timedwait(&p->changed, &p->lock, &until) == ETIMEDOUT) break;
  bool done = w->done;
  if (!done) w->abandoned = w->cancelled = true;
  pthread_mutex_unlock(&p->lock);
  if (!done) return answer_text(s, c, 503, "it took too long\n");
  live_text t = w->result;
  w->result = (live_text){ 0 };
  vs_outcome outcome = w->outcome;
  bool cancelled = w->cancelled;
  live_wish_free(w);
  if (outcome == VS_OUTCOME_DONE) return answer_live_text(s, c, type, &t);
  unsigned status = cancelled || outcome == VS_OUTCOME_INTERRUPTED ? 499 : 422;
  enum MHD_Result result = answer_text(s, c, status,
                                       t.length > 0    ? t.at
                                       : status == 499 ? "the model has changed, or Stop was pressed: export again\n"
                                                       : "the output was not made; the messages say why\n");
  live_text_free(&t);
  return result;
}

/* GET: answers with the current drawing in a format; a saved file may interrupt it. POST: answers with the drawing that
 * the model has for the parameter values in the body. The side (aside.h) makes it; `id` is the window's name for the
 * request. */
static enum MHD_Result export(live_server *s, struct MHD_Connection *c, const live_text *values) {
  const char *format = query(s, c, "format"), *size = query(s, c, "size"), *id = query(s, c, "id");
  const vs_format_info *info = format != NULL ? vs_format_find(format) : NULL;
  live_publish *p = s->publish;
  if (values != NULL && s->model == NULL) return answer_text(s, c, 404, NO_SOURCE);
  if (info != NULL && info->worker != NULL && s->options->read_only) return answer_text(s, c, 403, READ_ONLY);
  live_wish *w = info != NULL ? live_wish_new(LIVE_EXPORT, info->name, size != NULL ? size : "") : NULL;
  if (w == NULL) return answer_text(s, c, 400, "there is no such format\n");
  w->given = strdup(values != NULL && values->at != NULL ? values->at : "");
  w->id = strdup(id != NULL ? id : "");
  if (w->given == NULL || w->id == NULL) {
    live_wish_free(w);
    return answer_text(s, c, 500, "out of memory\n");
  }
  return await(s, c, values != NULL ? &p->asides : &p->wishes, w, "application/octet-stream");
}

/* Answers with the description of the face at a point of the model (live.c). */
static enum MHD_Result serve_face(live_server *s, struct MHD_Connection *c) {
  const char *at = query(s, c, "at");
  live_wish *w = at != NULL ? live_wish_new(LIVE_FACE, "", at) : NULL;
  if (w == NULL) return answer_text(s, c, 400, "a point is missing\n");
  return await(s, c, &s->publish->wishes, w, "application/json");
}

/* Answers with the page. The page's editor adds style sheets. The security policy allows them by a nonce (a random
 * word) that only this answer contains, in place of @nonce@. */
static enum MHD_Result serve_page(live_server *s, struct MHD_Connection *c) {
  static const char mark[] = "@nonce@";
  char nonce[33], policy[sizeof POLICY(" 'nonce-'") + sizeof nonce];
  live_text t = { 0 };
  if (!live_access_word(nonce)) return answer_text(s, c, 500, "no random numbers\n");
  snprintf(policy, sizeof policy, POLICY(" 'nonce-%s'"), nonce);
  const char *at = vs_asset_live_html, *end = vs_asset_live_html_end, *found;
  while ((found = memmem(at, (size_t)(end - at), mark, sizeof mark - 1)) != NULL) {
    live_add(&t, at, (size_t)(found - at));
    live_puts(&t, nonce);
    at = found + sizeof mark - 1;
  }
  live_add(&t, at, (size_t)(end - at));
  struct MHD_Response *r = t.failed ? NULL : s->http.create_response_from_buffer(t.length, t.at, MHD_RESPMEM_MUST_FREE);
  if (r == NULL) live_text_free(&t);
  return answer_under(s, c, r, 200, "text/html; charset=utf-8", policy);
}

static const struct { const char *url, *type, *from, *end; } assets[] = {
  { "/live.js", "text/javascript; charset=utf-8", vs_asset_live_js, vs_asset_live_js_end },
  { "/live.css", "text/css; charset=utf-8", vs_asset_live_css, vs_asset_live_css_end },
};

/* Answers a request that access.c has accepted. libmicrohttpd omits the body of an answer to HEAD. */
static enum MHD_Result dispatch(live_server *s, struct MHD_Connection *c, const char *url, const char *method,
                                const live_text *body) {
  bool get = strcmp(method, "GET") == 0 || strcmp(method, "HEAD") == 0, post = strcmp(method, "POST") == 0;
  for (size_t i = 0; get && i < sizeof assets / sizeof *assets; i++)
    if (strcmp(url, assets[i].url) == 0)
      return answer_bytes(s, c, 200, assets[i].type, assets[i].from, (size_t)(assets[i].end - assets[i].from));
  if (get && strcmp(url, "/") == 0) return serve_page(s, c);
  if (strcmp(url, "/events") == 0 && strcmp(method, "HEAD") == 0)
    return answer_bytes(s, c, 200, "text/event-stream", "", 0); /* answers HEAD without a stream, which would not end */
  if (get && strcmp(url, "/events") == 0) return serve_events(s, c);
  if (get && strcmp(url, "/scene") == 0) return serve_scene(s, c);
  if (get && strcmp(url, "/source") == 0) return serve_source(s, c);
  if (get && strcmp(url, "/names") == 0) return serve_names(s, c);
  if (get && strcmp(url, "/name") == 0) return serve_name(s, c);
  if (get && strcmp(url, "/formats") == 0) return serve_formats(s, c);
  if (get && strcmp(url, "/face") == 0) return serve_face(s, c);
  if ((get || post) && strcmp(url, "/export") == 0) return export(s, c, post ? body : NULL);
  if (post && strcmp(url, "/cancel") == 0 && query(s, c, "id") != NULL) {
    live_wish_cancel(s->publish, query(s, c, "id"));
    return answer_text(s, c, 202, "ok\n");
  }
  static const char *const changing[] = { "/source", "/try", "/check", "/prompt" };
  for (size_t i = 0; post && s->options->read_only && i < sizeof changing / sizeof *changing; i++)
    if (strcmp(url, changing[i]) == 0) return answer_text(s, c, 403, READ_ONLY);
  if (post && strcmp(url, "/source") == 0) return save_source(s, c, body);
  if (post && strcmp(url, "/check") == 0) return serve_check(s, c, body);
  if (post && strcmp(url, "/set") == 0) return wish(s, c, LIVE_SET, query(s, c, "name"), body->at);
  if (post && strcmp(url, "/try") == 0) return wish(s, c, LIVE_TRY, "", body->at != NULL ? body->at : "");
  if (post && strcmp(url, "/input") == 0) return wish(s, c, LIVE_INPUT, query(s, c, "kind"), body->at);
  if (post && strcmp(url, "/prompt") == 0) return wish(s, c, LIVE_PROMPT, "", body->at);
  if (post && strcmp(url, "/stop") == 0) {
    s->stop(s->stop_context);
    return answer_text(s, c, 202, "ok\n");
  }
  return answer_text(s, c, 404, "there is nothing here\n");
}

/* Returns the connection's entry in the table of connections that wait (waiting.h). */
static live_waiter *waiter(const live_server *s, struct MHD_Connection *c) {
  const union MHD_ConnectionInfo *info = s->http.get_connection_info(c, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
  return info != NULL ? info->socket_context : NULL;
}

static void connected(void *context, struct MHD_Connection *c, void **place, enum MHD_ConnectionNotificationCode what) {
  live_server *s = context;
  if (what == MHD_CONNECTION_NOTIFY_STARTED) {
    const union MHD_ConnectionInfo *info = s->http.get_connection_info(c, MHD_CONNECTION_INFO_CONNECTION_FD);
    *place = info != NULL ? live_waiter_begin(&s->waiting, info->connect_fd) : NULL;
  } else {
    live_waiter_end(&s->waiting, *place);
    *place = NULL;
  }
}

/* Creates the request of a connection. libmicrohttpd later passes it to `handle` and to `completed`. uri: path and
 * query as the client sent them, before libmicrohttpd decodes them. A decoded %00 would end the text early. */
static void *begun(void *context, const char *uri, struct MHD_Connection *c) {
  (void)context, (void)c;
  request *r = calloc(1, sizeof *r);
  if (r != NULL) r->zero = strstr(uri, "%00") != NULL;
  return r;
}

static enum MHD_Result handle(void *context, struct MHD_Connection *c, const char *url, const char *method,
                              const char *version, const char *data, size_t *size, void **state) {
  live_server *s = context;
  request *r = *state;
  (void)version;
  if (r == NULL) return MHD_NO;
  if (!r->began) { /* decides when the headers are read but no byte of the body: a refused client should not send its
                    * body */
    r->began = true;
    live_refusal no = live_access_refuse(&s->http, c, &s->access, url, BODY_MOST);
    if (no.why == NULL && r->zero) no = (live_refusal){ 400, "the address contains %00\n" };
    if (no.why == NULL) return MHD_YES;
    live_waiter_asked(&s->waiting, waiter(s, c));
    return answer_text(s, c, no.status, no.why);
  }
  if (*size > 0) {
    if (r->body.length + *size > BODY_MOST) r->too_long = true;
    else live_add(&r->body, data, *size);
    *size = 0;
    return MHD_YES;
  }
  live_waiter_asked(&s->waiting, waiter(s, c));
  if (r->too_long || r->body.failed) return answer_text(s, c, 413, "that is too long\n");
  if (r->body.at != NULL && strlen(r->body.at) < r->body.length)
    return answer_text(s, c, 400, "the body contains the character U+0000\n");
  return dispatch(s, c, url, method, &r->body);
}

static void completed(void *context, struct MHD_Connection *c, void **state, enum MHD_RequestTerminationCode how) {
  request *r = *state;
  live_server *s = context;
  if (how == MHD_REQUEST_TERMINATED_COMPLETED_OK) live_waiter_waits(&s->waiting, waiter(s, c));
  if (r == NULL) return;
  live_text_free(&r->body);
  free(r);
  *state = NULL;
}

/* ---- opening ---- */

/* drops messages of the library about clients that vanish, which is not an error */
static void quiet(void *context, const char *format, va_list arguments) {
  (void)context, (void)format, (void)arguments;
}

void live_server_address(const live_server *s, char out[LIVE_ADDRESS]) {
  snprintf(out, LIVE_ADDRESS, "http://127.0.0.1:%u/#%s", s->port, s->access.token);
}

bool live_server_listen(live_server *s) {
  struct sockaddr_in loopback = { .sin_family = AF_INET, .sin_port = 0, .sin_addr.s_addr = htonl(INADDR_LOOPBACK) };
  socklen_t size = sizeof loopback;
  if (!live_access_word(s->access.token)) {
    fprintf(stderr, "vs: no random numbers for the live view's token\n");
    return false;
  }
  if (s->publish->alone != NULL) return live_access_hosts(&s->access, 0), true; /* a view without threads opens no
                                                                                 * socket */
  s->socket = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (s->socket >= 0 && bind(s->socket, (struct sockaddr *)&loopback, size) == 0 &&
      listen(s->socket, CONNECTIONS) == 0 && getsockname(s->socket, (struct sockaddr *)&loopback, &size) == 0) {
    s->port = ntohs(loopback.sin_port);
    live_access_hosts(&s->access, s->port);
    return true;
  }
  if (s->socket >= 0) close(s->socket);
  fprintf(stderr, "vs: the live view could not listen on 127.0.0.1\n");
  return false;
}

bool live_server_open(live_server *s) {
  if (vs_asset_live_js_end - vs_asset_live_js < 1000 && s->publish->alone == NULL) {
    fprintf(stderr,
            "vs: this vs was built without the live view's page: run `npm ci --ignore-scripts` and build again\n");
    return false;
  }
  pthread_mutex_init(&s->names_lock, NULL);
  live_waiting_open(&s->waiting);
  s->names = vs_new(NULL);
  sigset_t was;
  vs_signals_hold(&was); /* the command's signal handlers must not run in the server's threads */
  s->daemon = s->http.start_daemon(MHD_USE_INTERNAL_POLLING_THREAD | MHD_USE_THREAD_PER_CONNECTION | MHD_USE_ERROR_LOG,
                                   0, NULL, NULL, handle, s, MHD_OPTION_EXTERNAL_LOGGER, quiet, NULL,
                                   MHD_OPTION_URI_LOG_CALLBACK, begun, NULL, MHD_OPTION_LISTEN_SOCKET, s->socket,
                                   MHD_OPTION_CONNECTION_LIMIT, (unsigned)CONNECTIONS, MHD_OPTION_CONNECTION_TIMEOUT,
                                   (unsigned)SILENCE, MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)32768,
                                   MHD_OPTION_NOTIFY_COMPLETED, completed, s, MHD_OPTION_NOTIFY_CONNECTION, connected,
                                   s, MHD_OPTION_END);
  vs_signals_release(&was);
  if (s->daemon == NULL) fprintf(stderr, "vs: the live view could not listen on 127.0.0.1\n");
  return s->daemon != NULL;
}

void live_server_close(live_server *s) {
  if (s->daemon != NULL) s->http.stop_daemon(s->daemon);
  else if (s->port != 0) close(s->socket);
  s->daemon = NULL;
  vs_free(s->names);
  s->names = NULL;
  pthread_mutex_destroy(&s->names_lock);
  live_waiting_close(&s->waiting);
}
