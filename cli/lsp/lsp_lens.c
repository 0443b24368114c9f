/* Answers with the lens of a text (a clickable line above its drawing), and starts the live view that the lens shows: a
 * process of `vs view`, which ends with the server. */
#include "cli/lsp/lsp_lens.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "cli/lsp/lsp_words.h"
#include "model/store/array.h"

enum { START_SECONDS = 20 /* the longest time until `vs view` prints its address */ };

/* ---- the lens ---- */

static bool defines(const knowledge *k, know_index form) {
  for (know_index i = 1; i < k->symbol_count; i++)
    if (k->symbols[i].form == form) return true;
  return false;
}

know_index lsp_drawing_of(const knowledge *k) {
  for (know_index i = 1; i <= k->text_nodes; i++) {
    const know_node *n = know_at(k, i);
    const know_symbol *s = n->symbol ? &k->symbols[n->symbol] : NULL;
    if (s && !n->at.file && !n->made && n->role == KNOW_REFERENCE && !s->definition && !strcmp(s->text, "draw"))
      return i;
  }
  know_index last = 0;
  for (know_index i = know_at(k, k->files[0].root)->first; i; i = know_at(k, i)->next)
    if (!defines(k, i)) last = i;
  return last;
}

void lsp_lens(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  bool known = d && know_reads(d->path) && lsp_document_study(d, s->interpreter);
  know_index drawing = known ? lsp_drawing_of(&d->draft->k) : 0;
  fputc('[', s->to);
  if (drawing) {
    fputc('{', s->to);
    lsp_put_node_range(s->to, "range", &d->draft->k, drawing);
    fputs(",\"command\":{\"title\":\"Show the model\",\"command\":\"" LSP_SHOW_COMMAND "\",\"arguments\":[", s->to);
    lsp_put(s->to, d->uri);
    fputs("]}}", s->to);
  }
  fputc(']', s->to);
}

/* ---- live views ---- */

/* Replaces this new process by `vs view`. */
static void become_view(const lsp_server *s, const char *path, int output) {
  char *words[] = { (char *)"vs", (char *)"view", (char *)(s->shows ? "-q" : "--"), (char *)(s->shows ? "--" : path),
                    s->shows ? (char *)(uintptr_t)path : NULL, NULL };
  int input = open("/dev/null", O_RDONLY);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
  if (s->interpreter->library_path) setenv("VS_LIBRARY_PATH", s->interpreter->library_path, 1);
  if (input >= 0 && dup2(input, STDIN_FILENO) >= 0 && dup2(output, STDOUT_FILENO) >= 0)
    execv("/proc/self/exe", words);
  _exit(127);
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Reads the line in which `vs view` prints its address. Returns false if the view ends, or takes too long. */
static bool read_address(int from, char *address, size_t room) {
  size_t n = 0;
  for (double end = now() + START_SECONDS; n + 1 < room;) {
    struct pollfd ready = { .fd = from, .events = POLLIN };
    double left = end - now();
    if (left <= 0) return false;
    int found = poll(&ready, 1, (int)(1000 * left) + 1);
    if (found < 0 && errno != EINTR) return false;
    if (found <= 0) continue;
    if (read(from, address + n, 1) != 1) return false;
    if (address[n] == '\n') {
      address[n] = 0;
      return true;
    }
    n++;
  }
  return false;
}

static void end_view(lsp_view *v) {
  if (v->process > 0) {
    kill(v->process, SIGTERM);
    while (waitpid(v->process, NULL, 0) < 0 && errno == EINTR) {}
  }
  free(v->path);
}

void lsp_views_end(lsp_server *s) {
  for (size_t i = 0; i < s->view_count; i++) end_view(&s->views[i]);
  free(s->views);
  s->views = NULL, s->view_count = 0;
}

/* Returns the running view of the file, or NULL. Forgets views that have ended. */
static lsp_view *view_of(lsp_server *s, const char *path) {
  lsp_view *found = NULL;
  size_t kept = 0;
  for (size_t i = 0; i < s->view_count; i++) {
    if (waitpid(s->views[i].process, NULL, WNOHANG) != 0) {
      s->views[i].process = 0;
      end_view(&s->views[i]);
      continue;
    }
    s->views[kept] = s->views[i];
    if (!strcmp(s->views[kept].path, path)) found = &s->views[kept];
    kept++;
  }
  s->view_count = kept;
  return found;
}

static lsp_view *start_view(lsp_server *s, const char *path) {
  int pipes[2];
  if (!VS_GROW(s->views, s->view_room, s->view_count + 1) || pipe(pipes) != 0) return NULL;
  lsp_view v = { .path = strdup(path), .process = fork() };
  if (v.process == 0) {
    close(pipes[0]);
    become_view(s, path, pipes[1]);
  }
  close(pipes[1]);
  bool started = v.path && v.process > 0 && read_address(pipes[0], v.address, sizeof v.address);
  close(pipes[0]);
  if (!started) {
    end_view(&v);
    return NULL;
  }
  s->views[s->view_count] = v;
  return &s->views[s->view_count++];
}

void lsp_command(lsp_server *s, cli_data parameters) {
  const char *name = cli_data_text(&s->json, parameters, "command", NULL);
  cli_data arguments = cli_data_at(&s->json, parameters, "arguments");
  const char *uri = cli_data_count(&s->json, arguments)
                        ? cli_data_text(&s->json, cli_data_nth(&s->json, arguments, 0), "", NULL) : NULL;
  lsp_document *d = uri ? lsp_find_uri(s, uri) : NULL;
  s->refused = "vs lsp has no such command";
  if (!name || strcmp(name, LSP_SHOW_COMMAND)) return;
  s->refused = "the argument is the address of an open text";
  if (!d) return;
  s->refused = "save the text in a file first";
  if (access(d->path, R_OK) != 0) return;
  const lsp_view *v = view_of(s, d->path);
  if (!v) v = start_view(s, d->path);
  s->refused = "vs view did not start";
  if (!v) return;
  s->refused = NULL;
  if (s->shows) s->show = v->address;
  lsp_put(s->to, v->address);
}
