/* Searches the font folders of the system and of the user for the file of a font family.
 *
 * The name "DejaVu Sans Bold" finds the file DejaVuSans-Bold.ttf: names are compared by letters and digits only,
 * without regard to case. A family without a style may be the file of its Regular or Book style. Thus a font is found
 * without opening any file. Folders are searched in a fixed order, and their files in order of names. Therefore the
 * same machine always finds the same file. */
#define _XOPEN_SOURCE 700
#include "geometry/text/fontfile.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "geometry/text/font.h"
#include "model/store/array.h"

enum { NAME_ROOM = 128, PATH_ROOM = 1024, DEPTH_MAX = 5 };

typedef struct { char folder[PATH_ROOM]; int depth; } font_folder;
/* A function that a search calls for each font file; the order of calls depends only on the files' names. Returns true
 * to stop the search. */
typedef bool font_file_fn(void *context, const char *path, const char *plain);

static void plain_name(const char *text, size_t length, char out[NAME_ROOM]) {
  size_t n = 0;
  for (size_t i = 0; i < length && n + 1 < NAME_ROOM; i++) {
    char c = text[i];
    if (c >= 'A' && c <= 'Z') c = (char)(c + 32);
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (unsigned char)c >= 128) out[n++] = c;
  }
  out[n] = '\0';
}

static int by_name(const struct dirent **a, const struct dirent **b) { return strcmp((*a)->d_name, (*b)->d_name); }

/* Searches the folder `root` and its subfolders for font files, and calls fn for each. Sets *stop to true if fn ended
 * the search. Returns false when memory is out. */
static bool search_below(const char *root, font_file_fn *fn, void *context, bool *stop) {
  size_t count = 1, room = 16;
  font_folder *todo = vs_fresh(room, sizeof *todo);
  bool ok = todo != NULL;
  if (ok) {
    snprintf(todo[0].folder, PATH_ROOM, "%s", root);
    todo[0].depth = 0;
  }
  while (ok && count && !*stop) {
    font_folder now = todo[--count];
    struct dirent **list = NULL;
    int entries = scandir(now.folder, &list, NULL, by_name);
    if (entries < 0 && errno == ENOMEM) ok = false;
    for (int i = 0; i < entries; i++) {
      char path[2 * PATH_ROOM];
      struct stat info;
      size_t length = strlen(list[i]->d_name);
      snprintf(path, sizeof path, "%s/%s", now.folder, list[i]->d_name);
      if (ok && !*stop && list[i]->d_name[0] != '.' && strlen(path) < PATH_ROOM && stat(path, &info) == 0) {
        if (S_ISDIR(info.st_mode) && now.depth < DEPTH_MAX) {
          ok = VS_GROW(todo, room, count + 1);
          if (ok) {
            memcpy(todo[count].folder, path, PATH_ROOM);
            todo[count++].depth = now.depth + 1;
          }
        } else if (S_ISREG(info.st_mode) && length > 4 && vs_font_is_path(list[i]->d_name)) {
          char plain[NAME_ROOM];
          plain_name(list[i]->d_name, length - 4, plain);
          *stop = fn(context, path, plain);
        }
      }
      free(list[i]);
    }
    free(list);
  }
  free(todo);
  return ok;
}

static bool search(font_file_fn *fn, void *context) {
  static const char *const folders[] = {
    "~/.fonts",       "~/.local/share/fonts",  "/usr/local/share/fonts",   "/usr/share/fonts",
    "/Library/Fonts", "/System/Library/Fonts", "/opt/homebrew/share/fonts"
  };
  const char *home = getenv("HOME");
  bool stop = false, ok = true;
  for (size_t i = 0; ok && !stop && i < sizeof folders / sizeof *folders; i++) {
    char path[PATH_ROOM];
    if (folders[i][0] == '~' && (!home || home[0] != '/' || strlen(home) > PATH_ROOM / 2)) continue;
    snprintf(path, sizeof path, "%s%s", folders[i][0] == '~' ? home : "", folders[i] + (folders[i][0] == '~'));
    ok = search_below(path, fn, context, &stop);
  }
  return ok;
}

/* ---- search for one family ---- */

typedef struct { char wanted[NAME_ROOM]; int best; char *path; size_t room; } font_wish;

static bool wish_look(void *context, const char *path, const char *plain) {
  static const char *const styles[] = { "", "regular", "book", "roman", "medium" };
  font_wish *w = context;
  size_t length = strlen(w->wanted);
  if (strncmp(plain, w->wanted, length) != 0) return false;
  for (int i = 0; i < w->best; i++)
    if (!strcmp(plain + length, styles[i])) {
      w->best = i;
      snprintf(w->path, w->room, "%s", path);
    }
  return w->best == 0;
}

bool vs_font_file(const char *family, char *path, size_t room, vs_error *e) {
  font_wish w = { .best = 5, .path = path, .room = room };
  if (!*family) family = "DejaVu Sans";
  plain_name(family, strlen(family), w.wanted);
  if (!*w.wanted) return false;
  if (!search(wish_look, &w)) return vs_error_memory(e, NULL);
  return w.best < 5;
}

/* ---- list of all families ---- */

typedef struct { char *text; size_t room, used; } font_list;

/* Adds a family's name to the list, converted from a file name: "DejaVuSans-Bold.ttf" becomes "DejaVu Sans Bold". */
static bool list_look(void *context, const char *path, const char *plain) {
  font_list *l = context;
  char shown[NAME_ROOM];
  size_t n = 0;
  const char *name = strrchr(path, '/') + 1, *end = name + strlen(name) - 4;
  (void)plain;
  for (const char *c = name; c < end && n + 2 < sizeof shown; c++) {
    bool capital = *c >= 'A' && *c <= 'Z', small = c > name && c[-1] >= 'a' && c[-1] <= 'z';
    if (*c == '-' || *c == '_') {
      if (n) shown[n++] = ' ';
      continue;
    }
    if (capital && small && !(n >= 4 && !memcmp(shown + n - 4, "Deja", 4))) shown[n++] = ' ';
    shown[n++] = *c;
  }
  shown[n] = '\0';
  if (!strcmp(shown, "DejaVu Sans")) return false; /* omits the default family, with which the list already begins */
  int wrote = snprintf(l->text + l->used, l->room - l->used, "%s%s", l->used ? ", " : "", shown);
  if (wrote < 0 || (size_t)wrote >= l->room - l->used) {
    l->text[l->used] = '\0';
    return true;
  }
  l->used += (size_t)wrote;
  return false;
}

/* vs_font_families puts the default font first in the list, if it is installed, so that messages begin with the same
 * text on every machine. */
void vs_font_families(char *text, size_t room) {
  static const char usual[] = "DejaVu Sans";
  char path[PATH_ROOM];
  font_list l = { text, room, 0 };
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  *text = '\0';
  if (room > sizeof usual && vs_font_file(usual, path, sizeof path, &why)) {
    memcpy(text, usual, sizeof usual);
    l.used = sizeof usual - 1;
  }
  search(list_look, &l);
}
