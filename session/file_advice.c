/* Implements the advice on files that do not exist. It names a file of the same folder: with the name in another case,
 * with an added suffix, or with a similar name. */
#include "session/file_advice.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "vm/front/suggest.h"
#include "vm/library/port.h"

enum { LONGEST = 100 };

/* rank: how well the file name `best` matches the wanted name. 3: the names differ only in case; 2: `best` has an
 * additional suffix; 1: they differ in one letter; 0: no name was found. */
typedef struct { const char *wanted; char best[LONGEST + 1]; int rank; } search;

/* Returns true if the names, ignoring case, differ by one letter: a replaced, missing or additional letter, or two
 * exchanged letters. */
static bool is_slip(const char *a, const char *b) {
  size_t n = strlen(a), m = strlen(b), front = 0, back = 0;
  while (a[front] && tolower((unsigned char)a[front]) == tolower((unsigned char)b[front])) front++;
  while (back < n - front && back < m - front && a[n - 1 - back] == b[m - 1 - back]) back++;
  size_t left = n - front - back, right = m - front - back;
  bool swapped = left == 2 && right == 2 && a[front] == b[front + 1] && a[front + 1] == b[front];
  return n > 3 && (swapped || (left <= 1 && right <= 1));
}

static bool take(void *context, const char *name, size_t length) {
  search *s = context;
  char found[LONGEST + 1];
  if (length > LONGEST || *name == '.') return true;
  memcpy(found, name, length);
  found[length] = 0;
  size_t n = strlen(s->wanted);
  int rank = !strcasecmp(found, s->wanted)                                                        ? 3
             : !strchr(s->wanted, '.') && !strncasecmp(found, s->wanted, n) && found[n] == '.' ? 2
             : is_slip(s->wanted, found)                                                          ? 1
                                                                                                  : 0;
  /* If several names have equal rank, chooses the first in alphabetical order. The advice therefore does not depend on
   * the order in which the folder is listed. */
  if (!rank || rank < s->rank || (rank == s->rank && strcmp(found, s->best) >= 0)) return true;
  memcpy(s->best, found, length + 1);
  s->rank = rank;
  return true;
}

bool vs_session_advise_file(vs_scheme *vm, vs_text *t) {
  static const char before[] = "cannot open ", behind[] = ": no such file";
  if (!vs_text_end(t) || !t->at) return true;
  const char *path = strstr(t->at, before), *end = path ? strstr(path, behind) : NULL;
  if (!path || !end || strcmp(end, behind) != 0) return true;
  path += sizeof before - 1;
  char folder[LONGEST * 4 + 1], name[LONGEST + 1];
  const char *slash = end;
  while (slash > path && slash[-1] != '/') slash--;
  size_t n = (size_t)(end - slash), m = (size_t)(slash - path);
  if (!n || n > LONGEST || m > sizeof folder - 2) return true;
  if (*path == '~')
    return vs_text_puts(t, "; ~ means no folder here: write the full path, as in \"/home/ada/parts.vs\"");
  memcpy(name, slash, n);
  name[n] = 0;
  memcpy(folder, path, m);
  memcpy(folder + m, m ? "" : ".", m ? 1 : 2);
  search s = {.wanted = name};
  const char *why;
  const vs_io *io = vm->config.io;
  if (!io || !io->list || !io->list(vm->config.user, folder, take, &s, &why) || !s.rank) return true;
  bool ok = vs_text_puts(t, s.rank == 3 ? "; capital letters count: \"" : "; perhaps \"");
  return ok && vs_text_put(t, path, m) && vs_text_puts(t, s.best) && vs_text_puts(t, "\"");
}
