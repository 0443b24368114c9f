/* The program of the playground: a live view of one model without threads. A worker of the page calls the functions
 * marked EMSCRIPTEN_KEEPALIVE. */
#include <emscripten.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/study.h"
#include "live/live.h"
#include "live/open_browser.h"
#include "live/playground/message_server.h"
#include "live/serve.h"

/* The options of the only view. They are static because functions called from JavaScript cannot receive them. */
static live_options options;
static live_follower *view;
static volatile sig_atomic_t ended;

EM_JS(void, playground_answer,
      (int id, unsigned status, const char *type, const void *bytes, size_t count, bool open), {
  Module.answer(id, status, UTF8ToString(type), HEAPU8.slice(bytes >>> 0, (bytes >>> 0) + (count >>> 0)), !!open);
})
EM_JS(void, playground_part, (int id, const void *bytes, size_t count), {
  Module.part(id, HEAPU8.slice(bytes >>> 0, (bytes >>> 0) + (count >>> 0)));
})

/* Opens the view of a file. Returns false after a message on standard error. The memory limit of a program is that of
 * the page: an allocation beyond it fails, and the program ends with an error. */
EMSCRIPTEN_KEEPALIVE bool playground_open(const char *model) {
  static char *path; /* a copy of the file's name, which the view uses until it is closed */
  if (view != NULL) live_alone_close(view);
  free(path);
  path = strdup(model);
  view = NULL;
  if (path == NULL) return false;
  options = (live_options){ .model = path, .interpreter = vs_options_default(), .output = vs_output_options_default(),
                            .ended = &ended, .check = cli_study_check_text, .send = playground_pump };
  view = live_alone_open(&options);
  return view != NULL;
}

/* Takes the place of live/open_browser.c: a page starts no browser. */
void live_open_browser(const char *address) { (void)address; }

EMSCRIPTEN_KEEPALIVE void playground_run(void) { live_alone_run(view); }

EMSCRIPTEN_KEEPALIVE bool playground_turn(void) {
  bool frames = live_alone_turn(view);
  playground_pump();
  return frames;
}

EMSCRIPTEN_KEEPALIVE void playground_request(int id, const char *method, const char *path, const char *query,
                                             const char *body, size_t size) {
  const live_server *server = live_alone_server(view);
  message m = { id, method, path, query, body, size, server->access.hosts[0], server->access.token };
  playground_ask(&m);
  playground_pump();
}
