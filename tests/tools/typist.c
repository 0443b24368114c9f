/* Types lines into a program on a pseudo-terminal: `typist PROGRAM ARGS... < KEYS > SCREEN`.
 *
 * It types each line of KEYS once the program has been silent for most of a second, or for less when the program shows
 * its prompt again. In a line, \n \t \e \\ and \xHH mean keys (\x03 is ctrl-C), and \w waits up to 60 seconds for the
 * next prompt. It prints the program's output without cursor movements; with --escapes before PROGRAM it prints all of
 * the output, ESC as \e and a backspace as \b. Exits with the program's code. */
#define _GNU_SOURCE /* for posix_openpt and related functions, and TIOCSCTTY */
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PATIENCE = 700, /* milliseconds of silence after which the next line is typed; on a busy machine a program may be
                        * silent for several hundred milliseconds */
       AT_PROMPT = 150 /* milliseconds of silence after a prompt until the next line is typed */ };

/* Copies the program's output to standard output until it is silent for `patience` ms, or for less if the output ends
 * in a new line with a prompt. Returns false once the program has closed the terminal. */
static int listen_to(int terminal, int patience, int escapes) {
  static int escape; /* whether the output is inside an escape sequence: ESC [ ... letter */
  int lines = 0, width = 0;
  char last[2] = {0, 0};
  struct pollfd p = {.fd = terminal, .events = POLLIN};
  while (poll(&p, 1, lines > 0 && width <= 40 && last[0] == '>' && last[1] == ' ' ? AT_PROMPT : patience) > 0) {
    char text[4096];
    ssize_t got = read(terminal, text, sizeof text);
    if (got <= 0) return 0;
    for (ssize_t i = 0; i < got; i++) {
      char c = text[i];
      if (escapes && (c == 27 || c == '\b')) printf("\\%c", c == 27 ? 'e' : 'b');
      else if (escapes && escape) putchar(c);
      if (escape == 1) escape = c == '[' ? 2 : 0;
      else if (escape == 2) escape = c >= '@' && c <= '~' ? 0 : 2;
      else if (c == 27) escape = 1;
      else if (c != '\r') {
        if (!escapes || c != '\b') putchar(c);
        last[0] = last[1], last[1] = c;
        width++;
        if (c == '\n') lines++, width = 0;
      }
    }
  }
  return 1;
}

static size_t unescape(char *line, int *patience) {
  char *to = line;
  for (char *from = line; *from && *from != '\n'; from++) {
    if (*from != '\\' || !from[1]) { *to++ = *from; continue; }
    switch (*++from) {
    case 'n': *to++ = '\r'; break; /* \n is the Enter key, which sends a carriage return */
    case 't': *to++ = '\t'; break;
    case 'e': *to++ = 27; break;
    case 'w': *patience = 60000; break;
    case 'x': {
      char digits[3] = {from[1], from[1] ? from[2] : 0, 0};
      *to++ = (char)strtol(digits, NULL, 16);
      from += strlen(digits);
      break;
    }
    default: *to++ = *from;
    }
  }
  return (size_t)(to - line);
}

int main(int argc, char **argv) {
  int escapes = argc > 1 && strcmp(argv[1], "--escapes") == 0;
  argc -= escapes, argv += escapes;
  int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  char *name = terminal >= 0 && grantpt(terminal) == 0 && unlockpt(terminal) == 0 ? ptsname(terminal) : NULL;
  if (argc < 2 || !name) {
    fprintf(stderr, "typist: no terminal\n");
    return 77;
  }
  pid_t child = fork();
  if (child == 0) {
    setsid();
    int own = open(name, O_RDWR);
    if (own < 0 || ioctl(own, TIOCSCTTY, 0) < 0) _exit(127);
    struct winsize size = {.ws_row = 24, .ws_col = 100};
    ioctl(own, TIOCSWINSZ, &size);
    dup2(own, 0), dup2(own, 1), dup2(own, 2);
    close(terminal);
    signal(SIGINT, SIG_DFL); /* a process in the background inherits an ignored SIGINT; the program under test must
                              * receive SIGINT */
    execvp(argv[1], argv + 1);
    _exit(127);
  }
  char line[4096];
  int open_still = listen_to(terminal, 1000, escapes);
  while (open_still && fgets(line, sizeof line, stdin)) {
    int patience = PATIENCE;
    size_t length = unescape(line, &patience);
    if (write(terminal, line, length) != (ssize_t)length) break;
    open_still = listen_to(terminal, patience, escapes);
  }
  if (open_still) listen_to(terminal, 500, escapes);
  close(terminal); /* closing the terminal sends a hangup to a program that still waits for input */
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
