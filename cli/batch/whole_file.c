/* Writes files that get their names only when they are complete. */
#include "cli/batch/whole_file.h"

#include <errno.h>

FILE *cli_whole_begin(cli_whole_file *f, const char *path) {
  int n = snprintf(f->part, sizeof f->part, "%s.part", path);
  f->path = path, f->to = NULL;
  if (n < 0 || n >= (int)sizeof f->part) return errno = ENAMETOOLONG, NULL;
  return f->to = fopen(f->part, "wb");
}

bool cli_whole_end(cli_whole_file *f, bool ok) {
  if (!f->to) return false;
  ok = !ferror(f->to) && ok;
  if (fclose(f->to) != 0) ok = false;
  ok = ok && rename(f->part, f->path) == 0;
  int why = errno;
  if (!ok) remove(f->part);
  errno = why;
  return ok;
}
