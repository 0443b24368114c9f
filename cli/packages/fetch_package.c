/* Fetches a package from a folder, or by git. Nothing of the package runs: no hook, no submodule, no filter. */
#include "cli/packages/fetch_package.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

bool is_git_address(const char *source) {
  size_t n = strcspn(source, "#");
  return strstr(source, "://") || !strncmp(source, "git@", 4) || (n > 4 && !strncmp(source + n - 4, ".git", 4));
}

/* Runs git with these words. output receives the first line that git prints; it may be NULL. Returns git's exit code,
 * or 127 if git is missing. */
static int git(const char *const *words, char *output, size_t size) {
  static const char *const first[] = { "git", "-c", "core.hooksPath=/dev/null", "-c", "protocol.ext.allow=never",
                                       "-c", "advice.detachedHead=false", "-c", "core.autocrlf=false" };
  enum { FIRST = sizeof first / sizeof *first, MOST = 30 };
  char *all[MOST] = { NULL };
  int ends[2], status = 0;
  size_t n = 0;
  for (; n < FIRST; n++) all[n] = (char *)(size_t)first[n];
  for (; *words && n + 1 < MOST; words++) all[n++] = (char *)(size_t)*words;
  if (pipe(ends) != 0) return 127;
  fflush(stdout);
  pid_t process = fork();
  if (process == 0) {
    int nothing = open("/dev/null", O_RDONLY);
    setenv("GIT_TERMINAL_PROMPT", "0", 1);
    setenv("GIT_LFS_SKIP_SMUDGE", "1", 1);
    if (nothing >= 0) dup2(nothing, STDIN_FILENO);
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    execvp(all[0], all);
    _exit(127);
  }
  close(ends[1]);
  size_t used = 0;
  char piece[256];
  for (ssize_t got; process > 0 && (got = read(ends[0], piece, sizeof piece)) != 0;) {
    if (got < 0 && errno != EINTR) break;
    for (ssize_t i = 0; output && i < got && used + 1 < size; i++) output[used++] = piece[i];
  }
  close(ends[0]);
  if (output && size) output[used] = 0, output[strcspn(output, "\r\n")] = 0;
  while (process > 0 && waitpid(process, &status, 0) < 0 && errno == EINTR) {}
  return process > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : 127;
}

static fetch_outcome failed(char why[PACKAGE_WHY], const char *source, int code) {
  snprintf(why, PACKAGE_WHY, "%.150s: %s", source, code == 127 ? "git is missing (package git)" : "git failed");
  return NO_GIT;
}

static fetch_outcome fetch_by_git(const char *source, const char *to, char commit[80], char why[PACKAGE_WHY]) {
  char address[PATH_MAX], clone[PATH_MAX + 10];
  const char *name = strchr(source, '#');
  snprintf(address, sizeof address, "%.*s", (int)(name ? (size_t)(name - source) : strlen(source)), source);
  snprintf(clone, sizeof clone, "%s.clone", to);
  const char *wanted = *commit ? commit : name ? name + 1 : "HEAD";
  if (*address == '-' || *wanted == '-' || !*wanted) {
    snprintf(why, PACKAGE_WHY, "%.150s: this is no address of git", source);
    return NOT_FETCHED;
  }
  char taken[80], branch[200];
  const char *const get[] = { "clone", "--quiet", "--no-checkout", "--no-recurse-submodules", "--", address, clone,
                              NULL };
  const char *const check_out[] = { "-C", clone, "checkout", "--quiet", "--detach", wanted, "--", NULL };
  snprintf(branch, sizeof branch, "origin/%.180s", wanted);
  const char *const check_out_branch[] = { "-C", clone, "checkout", "--quiet", "--detach", branch, "--", NULL };
  const char *const ask[] = { "-C", clone, "rev-parse", "HEAD", NULL };
  int code = git(get, NULL, 0);
  if (!code && (*commit || !name || (code = git(check_out_branch, NULL, 0)) != 0)) code = git(check_out, NULL, 0);
  if (!code) code = git(ask, taken, sizeof taken);
  fetch_outcome outcome = code ? failed(why, source, code) : package_copy(clone, to, why) ? FETCHED : NOT_FETCHED;
  if (!code) snprintf(commit, 80, "%s", taken);
  package_remove(clone);
  return outcome;
}

fetch_outcome package_fetch(const char *source, const char *to, char commit[80], char why[PACKAGE_WHY]) {
  struct stat is;
  if (is_git_address(source)) return fetch_by_git(source, to, commit, why);
  if (stat(source, &is) != 0 || !S_ISDIR(is.st_mode)) {
    snprintf(why, PACKAGE_WHY, "%.150s: there is no such folder; an address of git has :// or ends in .git; "
             "for a name of an index give --index", source);
    return NOT_FETCHED;
  }
  *commit = 0;
  return package_copy(source, to, why) ? FETCHED : NOT_FETCHED;
}
