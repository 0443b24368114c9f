/* Runs commands of vs in processes of their own, which do not affect the server. */
#include "cli/mcp/mcp_process.h"

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

#include "cli/confine.h"
#include "model/store/array.h"

/* Limits of a command: bytes of its output, and seconds in total. The limits of the interpreter usually end a command
 * earlier. */
enum { MOST_SAID = 1 << 20, MOST_SECONDS = 600, MOST_LINE = 64 << 20, PIECE = 65536 };

/* ---- standard input ---- */

/* Reads the bytes that have arrived. Sets p->ended at the end of the input, and when a line is too long. */
static void take_input(mcp_process *p) {
  if (!VS_GROW(p->input, p->input_room, p->input_count + PIECE) || p->input_count > MOST_LINE) {
    p->ended = true;
    return;
  }
  ssize_t n = read(STDIN_FILENO, p->input + p->input_count, PIECE - 1);
  if (n > 0) p->input_count += (size_t)n;
  else if (n == 0 || errno != EINTR) p->ended = true;
}

char *mcp_next_line(mcp_process *p, size_t *length) {
  if (p->input_taken) memmove(p->input, p->input + p->input_taken, p->input_count -= p->input_taken);
  p->input_taken = 0;
  size_t from = 0;
  while (true) {
    char *end = p->input_count > from ? memchr(p->input + from, '\n', p->input_count - from) : NULL;
    from = p->input_count;
    if (end || (p->ended && p->input_count)) {
      if (!end) end = p->input + p->input_count++;
      *end = 0;
      *length = (size_t)(end - p->input);
      p->input_taken = *length + 1;
      return p->input;
    }
    if (p->ended || *p->interrupts) return NULL;
    take_input(p);
  }
}

/* Returns true if a line that has arrived cancels the request that is being answered. */
static bool is_cancelled(mcp_process *p) {
  size_t from = p->input_taken;
  for (char *end; from < p->input_count && (end = memchr(p->input + from, '\n', p->input_count - from));
       from = (size_t)(end - p->input) + 1) {
    cli_data m = cli_data_read(p->json, p->input + from, (size_t)(end - p->input) - from);
    const char *method = cli_data_text(p->json, m, "method", NULL);
    bool mine = method && !strcmp(method, "notifications/cancelled") &&
                cli_data_same(p->json, cli_data_at(p->json, m, "params.requestId"), p->id);
    cli_data_free(p->json, m);
    if (mine) return true;
  }
  return false;
}

/* ---- the process ---- */

void mcp_word(mcp_command *c, const char *word) {
  if (c->count + 1 < sizeof c->words / sizeof *c->words) c->words[c->count++] = word;
}

void mcp_command_free(mcp_command *c) {
  free(c->said);
  c->said = NULL, c->said_count = c->said_room = 0;
}

static int become_command(const mcp_process *p, mcp_command *c, int output) {
  int input = open("/dev/null", O_RDONLY);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (input < 0 || dup2(input, STDIN_FILENO) < 0 || dup2(output, STDOUT_FILENO) < 0 ||
      dup2(output, STDERR_FILENO) < 0 || (c->folder && chdir(c->folder) != 0)) return VS_OUTCOME_MACHINE;
  setvbuf(stdout, NULL, _IOLBF, 0);
  if (c->reads_only) cli_confine(".", NULL, 0, NULL);
  return p->run((int)c->count, (char **)(uintptr_t)c->words);
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Adds text that the command prints. Returns false at its end. */
static bool take_said(mcp_command *c, int from) {
  char piece[PIECE];
  ssize_t n = read(from, piece, sizeof piece);
  if (n < 0) return errno == EINTR;
  size_t kept = c->said_count + (size_t)n > MOST_SAID ? MOST_SAID - c->said_count : (size_t)n;
  if (VS_GROW(c->said, c->said_room, c->said_count + kept + 1)) {
    memcpy(c->said + c->said_count, piece, kept);
    c->said_count += kept;
    c->said[c->said_count] = 0;
  }
  return n > 0;
}

/* Reads the command's output until it ends. Returns 0, or a negative reason to end the process. The end of the server's
 * standard input is no such reason. */
static int listen_to(mcp_process *p, mcp_command *c, int from) {
  double end = now() + MOST_SECONDS;
  if (is_cancelled(p)) return MCP_CANCELLED; /* the client's notice that cancels the request arrived together with the
                                              * request */
  while (true) {
    struct pollfd ready[3] = { { .fd = from, .events = POLLIN }, { .fd = STDOUT_FILENO },
                               { .fd = STDIN_FILENO, .events = POLLIN } };
    double left = end - now();
    if (left <= 0 || *p->interrupts) return left <= 0 ? MCP_TOO_LONG : MCP_CANCELLED;
    int found = poll(ready, p->ended ? 2 : 3, (int)(1000 * left) + 1);
    if (found <= 0) continue;
    if (ready[0].revents && !take_said(c, from)) return 0;
    if (ready[1].revents & POLLERR) return MCP_CANCELLED; /* nobody reads the server's answers any more */
    if (p->ended || !ready[2].revents) continue;
    take_input(p);
    if (is_cancelled(p)) return MCP_CANCELLED;
  }
}

int mcp_run_command(mcp_process *p, mcp_command *c) {
  int ends[2], status = 0;
  fflush(stdout);
  if (!VS_GROW(c->said, c->said_room, 1) || pipe(ends) != 0) return MCP_NO_PROCESS;
  *c->said = 0;
  pid_t process = fork();
  if (process == 0) {
    close(ends[0]);
    exit(become_command(p, c, ends[1]));
  }
  close(ends[1]);
  int why = process > 0 ? listen_to(p, c, ends[0]) : MCP_NO_PROCESS;
  close(ends[0]);
  if (process < 0) return why;
  if (why) kill(process, SIGKILL);
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {}
  return why ? why : WIFEXITED(status) ? WEXITSTATUS(status) : MCP_CRASHED;
}
