/* Reports that standard output cannot be written. */
#include "cli/prompt/standard_output.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

void cli_output_fails(cli_session *c) {
  if (!c->output_failed) fprintf(stderr, "vs: standard output: %s\n", strerror(errno));
  c->output_failed = true;
}

void cli_output_flush(cli_session *c) {
  if (fflush(stdout) != 0) cli_output_fails(c);
}

/* Returns true if the process that reads standard output has closed it: such a failure needs no message. */
static bool reader_is_gone(void) {
  struct pollfd out = { .fd = STDOUT_FILENO, .events = POLLOUT };
  return poll(&out, 1, 0) > 0 && (out.revents & (POLLERR | POLLHUP)) != 0;
}

int cli_output_end(int code, bool told) {
  errno = 0;
  bool failed = fflush(stdout) != 0; /* errno remains 0 if an earlier write has failed and nothing is left to write */
  if (!failed && !ferror(stdout) && !told) return code;
  if (code != VS_OUTCOME_DONE && code != VS_OUTCOME_MODEL) return code; /* for all other exit codes, a failure was
                                                                         * already reported */
  if (!told && errno && errno != EPIPE) fprintf(stderr, "vs: standard output: %s\n", strerror(errno));
  else if (!told && !errno && !reader_is_gone())
    fputs("vs: standard output: the text could not be written completely\n", stderr);
  return VS_OUTCOME_USAGE;
}
