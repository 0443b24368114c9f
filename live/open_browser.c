/* Opens the page of a live view in a browser. */
#include "live/open_browser.h"

#include <spawn.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "live/live_text.h"

extern char **environ;

enum { BROWSER_WORDS = 30 };

/* Starts a browser by a command of $BROWSER: words, with the address in place of %s or after them. Discards its output.
 * Returns false if there is no such program. */
static bool start_browser(char *command, const char *address) {
  char *words[BROWSER_WORDS + 2] = { NULL }, *rest;
  live_text put = { 0 };
  posix_spawn_file_actions_t actions;
  pid_t child;
  int count = 0;
  bool placed = false, started = false;
  for (char *word = strtok_r(command, " ", &rest); word != NULL && count < BROWSER_WORDS;
       word = strtok_r(NULL, " ", &rest)) {
    char *at = placed ? NULL : strstr(word, "%s");
    if (at != NULL) {
      live_putf(&put, "%.*s%s%s", (int)(at - word), word, address, at + 2);
      placed = true;
    }
    words[count++] = at != NULL ? put.at : word;
  }
  char *last = strdup(address);
  if (!placed) words[count] = last;
  if (count > 0 && last != NULL && !put.failed && posix_spawn_file_actions_init(&actions) == 0) {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", 1 /* the value of O_WRONLY, which opens the
                                                                              * file only for writing */, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", 1, 0);
    started = posix_spawnp(&child, words[0], &actions, NULL, words, environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
  }
  free(last);
  live_text_free(&put);
  return started;
}

void live_open_browser(const char *address) {
  const char *browser = getenv("BROWSER");
  if (browser == NULL || *browser == 0) {
    if (getenv("DISPLAY") == NULL && getenv("WAYLAND_DISPLAY") == NULL) return;
    browser = "xdg-open";
  }
  char *copy = strdup(browser), *rest;
  for (char *command = copy != NULL ? strtok_r(copy, ":", &rest) : NULL; command != NULL;
       command = strtok_r(NULL, ":", &rest))
    if (start_browser(command, address)) break;
  free(copy);
}
