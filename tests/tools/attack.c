/* Runs the programs of tests/limits/attacks.txt: `attack VS ATTACKS FOLDER [sample] [ONLY]` runs each program under its
 * limits. Checks its outcome, its time, and the largest memory of the process. Prints `ok limits/NAME` or `not ok
 * limits/NAME: why`. If other load on the machine made a program late, the program is run again. */
#define _GNU_SOURCE /* for wait4 */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { LINE = 1 << 16, WORDS = 40, TRIES = 3, KILL_AFTER = 30 };
#define MOST_ADDRESSES ((rlim_t)8 << 30) /* limit of a process's address space in bytes, which protects the machine if
                                          * the memory limit of vs fails */
#define SLACK_TIME 0.5
#define SLACK_MEMORY 16.0 /* megabytes by which a process may exceed its memory limit, in addition to a tenth of this
                           * limit */

typedef struct { char name[80], out[16], args[400]; double time, memory; int exit; bool sample; } attack;
typedef struct { double seconds, megabytes; int status; bool killed; } result;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static bool parse(const char *line, attack *a) {
  *a = (attack){ .time = 0.5, .memory = 100, .exit = 4 };
  char copy[LINE], *next = copy, *word;
  snprintf(copy, sizeof copy, "%s", line + 3);
  copy[strcspn(copy, "\n")] = 0;
  for (bool first = true; (word = strsep(&next, " ")) != NULL; first = false) {
    if (first) snprintf(a->name, sizeof a->name, "%.70s", word);
    else if (!strncmp(word, "args=", 5)) {
      snprintf(a->args, sizeof a->args, "%.190s %.190s", word + 5, next ? next : "");
      break;
    } else if (!strncmp(word, "out=", 4)) snprintf(a->out, sizeof a->out, "%.10s", word + 4);
    else if (!strcmp(word, "exit=any")) a->exit = -1;
    else if (!strncmp(word, "exit=", 5)) a->exit = atoi(word + 5);
    else if (!strncmp(word, "time=", 5)) a->time = atof(word + 5);
    else if (!strncmp(word, "memory=", 7)) a->memory = atof(word + 7);
    else if (!strcmp(word, "sample")) a->sample = true;
    else if (*word) return false;
  }
  return *a->name != 0;
}

/* Returns the seconds in which the process was ready to run, but the machine had no free processor. These seconds do
 * not count against the program. */
static double waited(pid_t process) {
  char path[60];
  unsigned long long ran, waits = 0;
  snprintf(path, sizeof path, "/proc/%ld/schedstat", (long)process);
  FILE *f = fopen(path, "r");
  if (f && fscanf(f, "%llu %llu", &ran, &waits) != 2) waits = 0;
  if (f) fclose(f);
  return (double)waits * 1e-9;
}

static void become(const char *vs, const attack *a, const char *program, const char *out, const char *said) {
  char seconds[40], megabytes[40], args[sizeof a->args], *words[WORDS], *next = args, *word;
  int n = 0, to = open(said, O_WRONLY | O_CREAT | O_TRUNC, 0600), nothing = open("/dev/null", O_RDWR);
  struct rlimit all = { MOST_ADDRESSES, MOST_ADDRESSES }, none = { 0, 0 };
  snprintf(seconds, sizeof seconds, "%g", a->time);
  snprintf(megabytes, sizeof megabytes, "%g", a->memory);
  snprintf(args, sizeof args, "%s", a->args);
  words[n++] = (char *)(uintptr_t)vs;
  char *const usual[] = { "-q", "--limit-time", seconds, "--limit-memory", megabytes, "--limit-output", "20" };
  for (size_t i = 0; i < sizeof usual / sizeof *usual; i++) words[n++] = usual[i];
  while ((word = strsep(&next, " ")) != NULL && n < WORDS - 5)
    if (*word) words[n++] = word;
  words[n++] = (char *)(uintptr_t)program;
  if (*a->out) words[n++] = "-o", words[n++] = (char *)(uintptr_t)out;
  words[n] = NULL;
  setrlimit(RLIMIT_AS, &all);
  setrlimit(RLIMIT_CORE, &none);
  dup2(nothing, STDIN_FILENO), dup2(nothing, STDOUT_FILENO), dup2(to, STDERR_FILENO);
  execv(vs, words);
  _exit(127);
}

static result run(const char *vs, const attack *a, const char *program, const char *out, const char *said) {
  result r = { .seconds = now() };
  pid_t child = fork();
  if (child == 0) become(vs, a, program, out, said);
  struct rusage used;
  pid_t ended;
  double idle = 0, more;
  while ((ended = wait4(child, &r.status, WNOHANG, &used)) == 0) {
    if ((more = waited(child)) > idle) idle = more;
    if (!r.killed && now() - r.seconds > KILL_AFTER) r.killed = true, kill(child, SIGKILL);
    nanosleep(&(struct timespec){ 0, 2000000 }, NULL);
  }
  r.seconds = now() - r.seconds - idle;
  r.megabytes = (double)used.ru_maxrss / 1024;
  return r;
}

/* Returns true if the run kept its limits. An evaluation may last as long as the time limit; if the drawing is also
 * written, the run may last twice as long. */
static bool judge(const attack *a, const result *r, char *why, size_t room) {
  double most = a->time * (*a->out ? 2 : 1) + SLACK_TIME, large = a->memory * 1.1 + SLACK_MEMORY;
  *why = 0;
  if (r->killed) snprintf(why, room, "did not end in %d s", KILL_AFTER);
  else if (WIFSIGNALED(r->status)) snprintf(why, room, "ended by signal %d after %.2f s", WTERMSIG(r->status), r->seconds);
  else if (a->exit >= 0 && WEXITSTATUS(r->status) != a->exit) snprintf(why, room, "ended with %d after %.2f s", WEXITSTATUS(r->status), r->seconds);
  else if (WEXITSTATUS(r->status) > 4) snprintf(why, room, "ended with %d", WEXITSTATUS(r->status));
  else if (r->seconds > most) snprintf(why, room, "took %.2f s, not %.2f", r->seconds, most);
  else if (r->megabytes > large) snprintf(why, room, "took %.0f MB, not %.0f", r->megabytes, large);
  return !*why;
}

static void show(const char *path) {
  char line[400];
  FILE *f = fopen(path, "r");
  for (int i = 0; f && i < 5 && fgets(line, sizeof line, f); i++) printf("    %s%s", line, strchr(line, '\n') ? "" : "\n");
  if (f) fclose(f);
}

int main(int argc, char **argv) {
  if (argc < 4) return 2;
  const char *folder = argv[3], *only = argc > 5 ? argv[5] : "";
  bool sample = argc > 4 && !strcmp(argv[4], "sample"), more;
  FILE *attacks = fopen(argv[2], "r");
  static char line[LINE];
  if (!attacks || !fgets(line, sizeof line, attacks)) return 2;
  char program[400], said[400];
  snprintf(said, sizeof said, "%s/said", folder);
  do {
    attack a;
    while ((more = fgets(line, sizeof line, attacks) != NULL) && strncmp(line, "== ", 3) != 0) continue;
    if (!more) break;
  again:
    if (!parse(line, &a)) return fprintf(stderr, "attack: cannot read %s", line), 2;
    snprintf(program, sizeof program, "%s/%s.vs", folder, a.name);
    FILE *to = fopen(program, "w");
    if (!to) return perror(program), 2;
    while ((more = fgets(line, sizeof line, attacks) != NULL) && strncmp(line, "== ", 3) != 0) fputs(line, to);
    fclose(to);
    if ((!sample || a.sample) && strstr(a.name, only)) {
      char out[500], why[200];
      result r;
      bool good = false;
      snprintf(out, sizeof out, "%s/%s.%s", folder, a.name, a.out);
      for (int i = 0; i < TRIES && !good; i++) {
        r = run(argv[1], &a, program, out, said);
        good = judge(&a, &r, why, sizeof why);
        if (!good && !strstr(why, "took") && !r.killed) break;
      }
      if (good) printf("ok limits/%s: %d after %.2f s, %.0f MB\n", a.name, WEXITSTATUS(r.status), r.seconds, r.megabytes);
      else printf("not ok limits/%s: %s\n", a.name, why), show(said);
      fflush(stdout);
      unlink(out);
    }
    unlink(program);
    if (more) goto again;
  } while (more);
  fclose(attacks);
  return 0;
}
