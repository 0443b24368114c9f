/* Edits lines on a terminal by libedit, and implements keys that libedit lacks.
 *
 * libedit edits one buffer. A newline in the buffer is shown as a line break, so that an expression of several lines
 * can be recalled and edited. Lines that are typed one by one are also returned one by one. The prompt then shows the
 * number of open parentheses. The up key on an empty line moves all lines of the unfinished expression back into the
 * buffer. */
#include "cli/prompt/editor.h"
#include "cli/prompt/line_buffer.h"
#include "geometry/dynamic.h"

#include <dirent.h>
#include <errno.h>
#include <histedit.h>
#include <locale.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <wchar.h>

enum { LOOK_MS = 40, HISTORY_ENTRIES = 2000, FLASH = 250 /* FLASH: milliseconds for which a matching parenthesis is
                                                          * shown */ };
#define FLASHED "\033[9999~" /* code of a key that no keyboard has */

/* The functions of libedit, which is loaded when the first editor opens. If it were linked, loading it and its three
 * libraries would take an eighth of the time of every run. The table is global: libedit passes only the EditLine to
 * callbacks, and el_get is needed to find its cli_editor. */
static struct {
#define EDIT(name) __typeof__(&name) name;
#include "cli/prompt/libedit.def"
} libedit;

static bool load_libedit(void) {
  static const char *const files[] = { "libedit.so.2", "libedit.so.0", "libedit.so", NULL };
  static const vs_dynamic_library library = { files, "libedit2", "the prompt's line editor" };
  static const vs_dynamic_name names[] = {
#define EDIT(name) { #name, offsetof(__typeof__(libedit), name) },
#include "cli/prompt/libedit.def"
  };
  vs_error error = { 0 };
  if (vs_dynamic_load(&library, names, sizeof names / sizeof *names, &libedit, &error)) return true;
  fprintf(stderr, "vs: %s\n", error.message);
  return false;
}

struct cli_editor {
  vs_scheme *scheme;
  EditLine *line;
  History *history;
  char *history_path;   /* path of the history file; NULL if there is none */
  const char *prompt, *open;
  line_buffer pasted;   /* complete lines of a paste, returned together */
  line_buffer rest;     /* the text of a paste after its last newline, with which the next buffer begins */
  bool taken_back;      /* whether the buffer contains the lines of the unfinished expression, too */
  int back;             /* number of characters from the shown parenthesis back to the cursor; 0 if none is shown */
  ptrdiff_t closed;     /* position where completion has inserted a closing quote, so that typing one there only moves
                         * past it; 0 if there is none */
  void (*commands)(void (*each)(void *context, const char *name), void *context);
  cli_idle idle;
  mbstate_t partial;    /* state of a character whose bytes have not all been read */
};

bool cli_colours(int descriptor) {
  const char *no = getenv("NO_COLOR"), *term = getenv("TERM");
  return isatty(descriptor) && !(no && *no) && term && strcmp(term, "dumb") != 0;
}

int cli_terminal_width(void) {
  struct winsize size;
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/* ---- the history of lines ---- */

/* Returns the path $XDG_STATE_HOME/visualscheme/history, after creating its folders. The caller frees it. Returns NULL
 * if this fails. */
static char *history_path(void) {
  const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
  const char *const tail = "/visualscheme/history";
  bool own = state && *state == '/';
  if (!own && (!home || *home != '/')) return NULL;
  const char *base = own ? state : home, *middle = own ? "" : "/.local/state";
  size_t room = strlen(base) + strlen(middle) + strlen(tail) + 1;
  char *path = malloc(room);
  if (!path) return NULL;
  snprintf(path, room, "%s%s%s", base, middle, tail);
  for (char *slash = path; (slash = strchr(slash + 1, '/')) != NULL;) {
    *slash = 0;
    bool ok = mkdir(path, 0700) == 0 || errno == EEXIST;
    *slash = '/';
    if (!ok) {
      free(path);
      return NULL;
    }
  }
  return path;
}

void cli_editor_remember(cli_editor *e, const char *line, size_t length) {
  HistEvent event;
  while (length && strchr(" \t\r\n", line[length - 1])) length--;
  if (!length || strspn(line, " \t\r\n") >= length) return;
  char *copy = malloc(length + 1);
  if (!copy) return;
  memcpy(copy, line, length);
  copy[length] = 0;
  libedit.history(e->history, &event, H_ENTER, copy);
  free(copy);
}

/* ---- the text at the cursor ---- */

/* Returns the unfinished lines and the buffer up to the cursor. The caller frees the text. Returns NULL when memory is
 * out. */
static char *text_before(cli_editor *e) {
  const LineInfo *info = libedit.el_line(e->line);
  size_t open = e->taken_back ? 0 : strlen(e->open), n = (size_t)(info->cursor - info->buffer);
  char *all = malloc(open + n + 1);
  if (!all) return NULL;
  memcpy(all, e->open, open);
  memcpy(all + open, info->buffer, n);
  all[open + n] = 0;
  return all;
}

/* Scans Scheme text. Stores in `open` the positions of up to `room` parentheses that are open at its end, and returns
 * their number. Sets *in_string if the text ends within a string. */
static size_t scan(const char *at, size_t length, size_t *open, size_t room, bool *in_string) {
  size_t depth = 0;
  bool string = false;
  for (size_t i = 0; i < length; i++) {
    char c = at[i];
    if (string) {
      if (c == '\\') i++;
      else if (c == '"') string = false;
    } else if (c == '"') string = true;
    else if (c == ';') while (i + 1 < length && at[i + 1] != '\n') i++;
    else if (c == '#' && i + 2 < length && at[i + 1] == '\\') i += 2;
    else if (c == '(' || c == '[') {
      if (depth < room) open[depth] = i;
      depth++;
    } else if ((c == ')' || c == ']') && depth) depth--;
  }
  if (in_string) *in_string = string;
  return depth < room ? depth : room;
}

enum { DEEP = 256 };

/* Writes the name of the procedure whose call contains the cursor. Returns false if there is none. */
static bool called(const char *before, char *room, size_t size) {
  size_t open[DEEP], depth = scan(before, strlen(before), open, DEEP, NULL);
  while (depth-- > 0) {
    const char *name = before + open[depth] + 1;
    size_t n = strcspn(name, " \t\n()[]'`,;\"");
    if (!n || n >= size) continue;
    memcpy(room, name, n);
    room[n] = 0;
    return true;
  }
  return false;
}

/* Shows how a procedure is called, such as "  (make-sphere c r) #:segments", below the current line. */
static bool show_call(cli_editor *e, const char *name) {
  vs_name_info info;
  if (!vs_name_get(e->scheme, name, &info) || !*info.call) return false;
  putchar('\n');
  for (const char *at = info.call; *at;) {
    size_t n = strcspn(at, "\n");
    printf("  %.*s%s%s\n", (int)n, at, *info.keywords ? " " : "", info.keywords);
    at += n + (at[n] == '\n');
  }
  fflush(stdout);
  return true;
}

static cli_editor *editor_of(EditLine *line) {
  cli_editor *e;
  return libedit.el_get(line, EL_CLIENTDATA, &e) == 0 ? e : NULL;
}

static unsigned char signature(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  char *before = e ? text_before(e) : NULL, name[100];
  bool shown = before && called(before, name, sizeof name) && show_call(e, name);
  free(before);
  return shown ? CC_REDISPLAY : CC_ERROR;
}

/* ---- completion of words ---- */

typedef struct { char **at; size_t count, room; bool failed; const char *prefix; } names;

static bool collect(void *context, const char *name) {
  names *n = context;
  if (n->count == n->room) {
    size_t room = n->room ? n->room * 2 : 64;
    char **grown = realloc(n->at, room * sizeof *grown);
    if (!grown) return !(n->failed = true);
    n->at = grown;
    n->room = room;
  }
  n->at[n->count] = strdup(name);
  n->failed = !n->at[n->count];
  if (!n->failed) n->count++;
  return !n->failed;
}

static void collect_matching(void *context, const char *name) {
  names *n = context;
  if (strncmp(name, n->prefix, strlen(n->prefix)) == 0) collect(n, name);
}

static int by_text(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* Collects the paths of files that begin with the prefix. Paths of folders end in a slash. */
static void collect_files(names *n) {
  const char *slash = strrchr(n->prefix, '/');
  size_t folder = slash ? (size_t)(slash - n->prefix) + 1 : 0;
  char path[1024], full[1400];
  if (folder >= sizeof path) return;
  memcpy(path, n->prefix, folder);
  path[folder] = 0;
  DIR *d = opendir(folder ? path : ".");
  if (!d) return;
  for (struct dirent *entry; (entry = readdir(d)) != NULL;) {
    if (strncmp(entry->d_name, n->prefix + folder, strlen(n->prefix + folder)) != 0) continue;
    if (entry->d_name[0] == '.' && n->prefix[folder] != '.') continue;
    if (snprintf(full, sizeof full - 1, "%s%s", path, entry->d_name) >= (int)sizeof full - 1) continue;
    struct stat st;
    if (stat(full, &st) == 0 && S_ISDIR(st.st_mode)) strcat(full, "/");
    collect(n, full);
  }
  closedir(d);
  if (n->count) qsort(n->at, n->count, sizeof *n->at, by_text);
}

static void collect_keywords(cli_editor *e, const char *before, names *n) {
  char name[100], word[80];
  vs_name_info info;
  if (!called(before, name, sizeof name) || !vs_name_get(e->scheme, name, &info)) return;
  for (const char *at = info.keywords; *at;) {
    size_t length = strcspn(at, " ");
    snprintf(word, sizeof word, "%.*s", (int)length, at);
    collect_matching(n, word);
    at += length + (at[length] == ' ');
  }
}

static void print_names(const names *n) {
  enum { MOST = 200 };
  size_t widest = 0, shown = n->count < MOST ? n->count : MOST, width = (size_t)cli_terminal_width();
  for (size_t i = 0; i < shown; i++)
    if (strlen(n->at[i]) > widest) widest = strlen(n->at[i]);
  size_t across = width / (widest + 2) ? width / (widest + 2) : 1, down = (shown + across - 1) / across;
  putchar('\n');
  for (size_t row = 0; row < down; row++)
    for (size_t i = row; i < shown; i += down) printf("%-*s%s", i + down < shown ? (int)widest + 2 : 0, n->at[i],
        i + down < shown ? "" : "\n");
  if (shown < n->count) printf("... and %zu more\n", n->count - shown);
  fflush(stdout);
}

/* The kind of the word before the cursor. */
typedef enum { WORD_NAME, WORD_KEYWORD, WORD_FILE, WORD_COMMAND } word_kind;

static word_kind word_at(const char *before, const char **start) {
  bool in_string;
  size_t open[DEEP], n = strlen(before);
  const char *end = before + n, *line = before + n;
  while (line > before && line[-1] != '\n') line--;
  const char *first = line + strspn(line, " \t");
  if (*first == ',') { /* a command of the prompt, or its argument: a file or a name */
    const char *space = strpbrk(first, " \t");
    if (!space) return *start = first + 1, WORD_COMMAND;
    const char *argument = space + strspn(space, " \t");
    static const char *const files[] = {"write", "run", "load", "save", "render", "reload"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
      if (!strncmp(first + 1, files[i], (size_t)(space - first - 1)) && space - first > 1) return *start = argument,
          WORD_FILE;
  }
  scan(before, n, open, DEEP, &in_string);
  if (in_string) {
    *start = end;
    while (*start > before && (*start)[-1] != '"') --*start;
    return WORD_FILE;
  }
  *start = end;
  while (*start > before && !strchr(" \t\n()[]'`,;\"", (*start)[-1])) --*start;
  return (*start)[0] == '#' && (*start)[1] == ':' ? WORD_KEYWORD : WORD_NAME;
}

/* Inserts the closing quote after the complete name of a file. */
static bool close_string(cli_editor *e) {
  const LineInfo *info = libedit.el_line(e->line);
  if (info->cursor < info->lastchar && *info->cursor == '"') return true;
  if (libedit.el_insertstr(e->line, "\"") != 0) return false;
  info = libedit.el_line(e->line);
  e->closed = info->cursor - info->buffer;
  return true;
}

/* Inserts a quote, or moves past the one that completion has inserted. */
static unsigned char quote(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  const LineInfo *info = libedit.el_line(line);
  bool there = e && e->closed && info->cursor - info->buffer == e->closed && info->cursor[-1] == '"';
  if (e) e->closed = 0;
  if (there) return CC_NORM;
  return libedit.el_insertstr(line, "\"") == 0 ? CC_REFRESH : CC_ERROR;
}

static unsigned char complete(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  char *before = e ? text_before(e) : NULL;
  if (!before) return CC_ERROR;
  const char *start;
  word_kind kind = word_at(before, &start);
  names n = {.prefix = start};
  size_t length = strlen(start);
  if (kind == WORD_FILE) collect_files(&n);
  else if (kind == WORD_COMMAND) e->commands(collect_matching, &n);
  else if (kind == WORD_KEYWORD) collect_keywords(e, before, &n);
  else if (length) vs_complete(e->scheme, start, collect, &n);
  size_t common = n.count ? strlen(n.at[0]) : 0;
  for (size_t i = 1; i < n.count; i++) {
    size_t same = 0;
    while (same < common && n.at[i][same] == n.at[0][same]) same++;
    common = same;
  }
  while (common > length && ((unsigned char)n.at[0][common] & 0xC0) == 0x80) common--; /* the common start of the names
                                                                                        * is shortened to whole
                                                                                        * characters */
  unsigned char result = CC_ERROR;
  if (common > length || n.count == 1) {
    bool shown = false;
    if (n.count == 1 && kind == WORD_NAME) shown = show_call(e, n.at[0]);
    n.at[0][common] = 0;
    bool ok = common == length || libedit.el_insertstr(line, n.at[0] + length) == 0;
    bool folder = common && n.at[0][common - 1] == '/';
    if (ok && n.count == 1 && kind != WORD_FILE && !folder) ok = libedit.el_insertstr(line, " ") == 0;
    if (ok && n.count == 1 && kind == WORD_FILE && !folder && start > before && start[-1] == '"') ok = close_string(e);
    result = !ok ? CC_ERROR : shown ? CC_REDISPLAY : CC_REFRESH;
  } else if (n.count) {
    print_names(&n);
    result = CC_REDISPLAY;
  } else if (kind == WORD_NAME) {
    char name[100];
    if (called(before, name, sizeof name) && show_call(e, name)) result = CC_REDISPLAY;
  }
  for (size_t i = 0; i < n.count; i++) free(n.at[i]);
  free(n.at);
  free(before);
  return result;
}

/* ---- functions of keys ---- */

static int characters(const char *from, const char *to) {
  int n = 0;
  for (; from < to; from++) n += ((unsigned char)*from & 0xC0) != 0x80;
  return n;
}

/* Inserts a closing parenthesis, and briefly moves the cursor to the matching one. */
static unsigned char close_parenthesis(EditLine *line, int key) {
  char c[2] = {(char)key, 0};
  size_t open[DEEP];
  bool in_string;
  if (libedit.el_insertstr(line, c) != 0) return CC_ERROR;
  const LineInfo *info = libedit.el_line(line);
  size_t n = (size_t)(info->cursor - info->buffer) - 1, depth = scan(info->buffer, n, open, DEEP, &in_string);
  cli_editor *e = editor_of(line);
  if (!e || !depth || in_string) return CC_REFRESH;
  struct pollfd more = {.fd = STDIN_FILENO, .events = POLLIN};
  if (poll(&more, 1, 0) > 0) return CC_REFRESH; /* more characters are waiting, as in a paste: do not move the cursor */
  e->back = characters(info->buffer + open[depth - 1], info->cursor);
  libedit.el_cursor(line, -e->back);
  libedit.el_push(line, FLASHED); /* libedit draws only between keys: this key without a keyboard calls flashed() after
                                   * drawing */
  return CC_REFRESH;
}

/* Waits for a moment or the next key, and moves the cursor from the matching parenthesis back. */
static unsigned char flashed(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  if (!e || !e->back) return CC_NORM;
  poll(&(struct pollfd){.fd = STDIN_FILENO, .events = POLLIN}, 1, FLASH);
  libedit.el_cursor(line, e->back);
  e->back = 0;
  return CC_CURSOR;
}

/* Returns the column of the cursor in its line of the buffer. Sets *above and *below to whether the buffer has lines
 * before and after it. */
static size_t column_of(const LineInfo *info, bool *above, bool *below) {
  const char *line = info->cursor;
  while (line > info->buffer && line[-1] != '\n') line--;
  *above = line > info->buffer;
  *below = memchr(info->cursor, '\n', (size_t)(info->lastchar - info->cursor)) != NULL;
  size_t column = 0;
  for (const char *at = line; at < info->cursor; at++) column += ((unsigned char)*at & 0xC0) != 0x80;
  return column;
}

static unsigned char line_up(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  const LineInfo *info = libedit.el_line(line);
  bool above, below;
  size_t column = column_of(info, &above, &below);
  if (above) {
    const char *end = info->cursor; /* the newline at the end of the line above */
    while (end[-1] != '\n') end--;
    const char *start = --end;
    while (start > info->buffer && start[-1] != '\n') start--;
    size_t width = (size_t)characters(start, end);
    libedit.el_cursor(line, -(characters(start, info->cursor) - (int)(column < width ? column : width)));
    return CC_CURSOR;
  }
  if (e && *e->open && !e->taken_back && info->lastchar == info->buffer) { /* moves the lines of the unfinished
                                                                            * expression into the buffer */
    size_t n = strlen(e->open);
    char *copy = strdup(e->open);
    if (!copy) return CC_ERROR;
    if (n && copy[n - 1] == '\n') copy[n - 1] = 0;
    e->taken_back = libedit.el_insertstr(line, copy) == 0;
    free(copy);
    e->prompt = "> ";
    return CC_REFRESH;
  }
  libedit.el_push(line, "\020");
  return CC_NORM;
}

static unsigned char line_down(EditLine *line, int key) {
  (void)key;
  const LineInfo *info = libedit.el_line(line);
  bool above, below;
  size_t column = column_of(info, &above, &below);
  if (!below) {
    libedit.el_push(line, "\016");
    return CC_NORM;
  }
  const char *start = (const char *)memchr(info->cursor, '\n', (size_t)(info->lastchar - info->cursor)) + 1, *end =
      start;
  while (end < info->lastchar && *end != '\n') end++;
  size_t width = (size_t)characters(start, end);
  libedit.el_cursor(line, characters(info->cursor, start) + (int)(column < width ? column : width));
  return CC_CURSOR;
}

/* Returns the number of blanks for the start of the line after this text: two more than the column of the innermost
 * open parenthesis, at most 60. */
static size_t indentation(const char *all) {
  size_t open[DEEP], depth = scan(all, strlen(all), open, DEEP, NULL), column = 0;
  if (!depth) return 0;
  for (const char *at = all + open[depth - 1]; at > all && at[-1] != '\n'; at--) column++;
  return column + 2 < 60 ? column + 2 : 60;
}

/* Ends the buffer. If it contains an unfinished expression of several lines, begins another line instead. */
static unsigned char enter(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  const LineInfo *info = libedit.el_line(line);
  bool several = memchr(info->buffer, '\n', (size_t)(info->lastchar - info->buffer)) != NULL;
  if (e && several && vs_read_check(e->scheme, info->buffer,
      (size_t)(info->lastchar - info->buffer)).state == VS_READ_INCOMPLETE) {
    char blanks[64] = "\n", *before = text_before(e);
    size_t n = before ? indentation(before) : 0;
    free(before);
    memset(blanks + 1, ' ', n);
    blanks[n + 1] = 0;
    return libedit.el_insertstr(line, blanks) == 0 ? CC_REFRESH : CC_ERROR;
  }
  if (several && info->cursor < info->lastchar) { /* moves the cursor to the end, so that output appears below all
                                                   * lines */
    libedit.el_cursor(line, characters(info->cursor, info->lastchar));
    libedit.el_push(line, "\015");
    return CC_CURSOR;
  }
  libedit.el_push(line, "\012");
  return CC_NORM;
}

/* Inserts a newline into the buffer, even after a complete expression. */
static unsigned char new_line(EditLine *line, int key) {
  (void)key;
  return libedit.el_insertstr(line, "\n") == 0 ? CC_REFRESH : CC_ERROR;
}

/* Inserts pasted text, which a terminal sends between ESC [ 200 ~ and ESC [ 201 ~. Its characters do not count as keys;
 * tabs become blanks. Complete lines end the buffer, and the text after them begins the next. */
static unsigned char paste(EditLine *line, int key) {
  (void)key;
  static const char end[] = "\033[201~";
  cli_editor *e = editor_of(line);
  line_buffer got = {0};
  char c;
  bool ok = e != NULL;
  while (ok && libedit.el_getc(line, &c) == 1) {
    if (c == '\r') c = '\n';
    ok = cli_line_buffer_add(&got, c == '\t' ? "  " : &c, c == '\t' ? 2 : 1);
    if (got.length >= sizeof end - 1 && memcmp(got.at + got.length - (sizeof end - 1), end, sizeof end - 1) == 0) {
      got.length -= sizeof end - 1;
      got.at[got.length] = 0;
      break;
    }
  }
  unsigned char result = CC_ERROR;
  char *last = ok && got.length ? strrchr(got.at, '\n') : NULL;
  if (ok && got.length && !last) result = libedit.el_insertstr(line, got.at) == 0 ? CC_REFRESH : CC_ERROR;
  else if (last) {
    const LineInfo *info = libedit.el_line(line);
    ok = cli_line_buffer_add(&e->pasted, info->buffer, (size_t)(info->cursor - info->buffer)) &&
         cli_line_buffer_add(&e->pasted, got.at, (size_t)(last + 1 - got.at)) &&
         cli_line_buffer_add(&e->rest, last + 1, strlen(last + 1)) &&
         cli_line_buffer_add(&e->rest, info->cursor, (size_t)(info->lastchar - info->cursor));
    if (ok) {
      fwrite(got.at, 1, (size_t)(last + 1 - got.at), stdout); /* shows the lines as if they had been typed */
      fflush(stdout);
      result = CC_NEWLINE; /* the pasted text ends the buffer */
    }
  }
  free(got.at);
  return result;
}

/* ---- opening and closing the editor ---- */

static char *prompt_text(EditLine *line) {
  cli_editor *e = editor_of(line);
  return (char *)(e ? e->prompt : "");
}

void cli_editor_close(cli_editor *e) {
  HistEvent event;
  if (!e) return;
  if (e->line) fputs("\033[?2004l", stdout), fflush(stdout);
  if (e->history && e->history_path && libedit.history(e->history, &event, H_SAVE,
      e->history_path) >= 0) chmod(e->history_path, 0600);
  if (e->line) libedit.el_end(e->line);
  if (e->history) libedit.history_end(e->history);
  free(e->history_path);
  free(e->pasted.at);
  free(e->rest.at);
  free(e);
}

cli_editor *cli_editor_open(vs_scheme *scheme, void (*commands)(void (*each)(void *context, const char *name),
    void *context)) {
  static const struct { const char *keys, *does; } bound[] = {
      {"^I", "vs-complete"}, {"^R", "em-inc-search-prev"}, {")", "vs-close"}, {"]", "vs-close"},
          {"\"", "vs-quote"}, {"^M", "vs-enter"},
          {"\\e[200~", "vs-paste"}, {FLASHED, "vs-flashed"},
      {"\\e[A", "vs-up"}, {"\\eOA", "vs-up"}, {"\\e[B", "vs-down"}, {"\\eOB", "vs-down"}, {"\\e^M", "vs-newline"},
          {"\\e?", "vs-signature"},
      {"\\eOP", "vs-signature"}, {"\\e[11~", "vs-signature"},
      /* Keys that move by words, as sent by xterm, screen, rxvt, the Linux console and others. */
      {"\\e[1;5D", "ed-prev-word"}, {"\\e[1;5C", "em-next-word"}, {"\\e[1;3D", "ed-prev-word"}, {"\\e[1;3C",
          "em-next-word"}, {"\\e[1;9D", "ed-prev-word"},
      {"\\e[1;9C", "em-next-word"}, {"\\e[5D", "ed-prev-word"}, {"\\e[5C", "em-next-word"}, {"\\eOd",
          "ed-prev-word"}, {"\\eOc", "em-next-word"},
      {"\\e\\e[D", "ed-prev-word"}, {"\\e\\e[C", "em-next-word"}, {"\\e[1;2D", "ed-prev-char"}, {"\\e[1;2C",
          "ed-next-char"}, {"\\eb", "ed-prev-word"}, {"\\ef", "em-next-word"},
      {"\\e[1;5A", "vs-up"}, {"\\e[1;5B", "vs-down"}, {"\\e[1;2A", "vs-up"}, {"\\e[1;2B", "vs-down"}, {"\\e[1;3A",
          "vs-up"}, {"\\e[1;3B", "vs-down"},
      {"\\e[H", "ed-move-to-beg"}, {"\\e[F", "ed-move-to-end"}, {"\\eOH", "ed-move-to-beg"}, {"\\eOF",
          "ed-move-to-end"}, {"\\e[1~", "ed-move-to-beg"}, {"\\e[4~", "ed-move-to-end"},
      {"\\e[7~", "ed-move-to-beg"}, {"\\e[8~", "ed-move-to-end"}, {"\\e[1;5H", "ed-move-to-beg"}, {"\\e[1;5F",
          "ed-move-to-end"},
      {"\\e[3~", "ed-delete-next-char"}, {"\\e[3;5~", "em-delete-next-word"}, {"\\e^?", "ed-delete-prev-word"},
          {"\\e[5~", "vs-up"}, {"\\e[6~", "vs-down"}, {"\\e[2~", "ed-redisplay"},
  };
  HistEvent event;
  if (!isatty(STDIN_FILENO) || !isatty(STDOUT_FILENO) || !load_libedit()) return NULL;
  cli_editor *e = calloc(1, sizeof *e);
  if (!e) return NULL;
  e->scheme = scheme, e->prompt = "> ", e->open = "", e->commands = commands;
  setlocale(LC_CTYPE, "");
  e->line = libedit.el_init("vs", stdin, stdout, stderr);
  e->history = libedit.history_init();
  if (!e->line || !e->history) {
    cli_editor_close(e);
    return NULL;
  }
  libedit.history(e->history, &event, H_SETSIZE, HISTORY_ENTRIES);
  libedit.history(e->history, &event, H_SETUNIQUE, 1);
  e->history_path = history_path();
  if (e->history_path) libedit.history(e->history, &event, H_LOAD, e->history_path);
  libedit.el_set(e->line, EL_CLIENTDATA, e);
  libedit.el_set(e->line, EL_PROMPT, prompt_text);
  libedit.el_set(e->line, EL_EDITOR, "emacs");
  libedit.el_set(e->line, EL_HIST, libedit.history, e->history);
  libedit.el_set(e->line, EL_ADDFN, "vs-complete", "complete the word before the cursor", complete);
  libedit.el_set(e->line, EL_ADDFN, "vs-close", "close a parenthesis and show the one it closes", close_parenthesis);
  libedit.el_set(e->line, EL_ADDFN, "vs-flashed", "move the cursor back behind the closed parenthesis", flashed);
  libedit.el_set(e->line, EL_ADDFN, "vs-quote", "insert a quote, unless completion has inserted it", quote);
  libedit.el_set(e->line, EL_ADDFN, "vs-enter", "end the line, or begin another of an open expression", enter);
  libedit.el_set(e->line, EL_ADDFN, "vs-newline", "begin another line", new_line);
  libedit.el_set(e->line, EL_ADDFN, "vs-paste", "insert pasted text", paste);
  libedit.el_set(e->line, EL_ADDFN, "vs-up", "the line above, or the entry before", line_up);
  libedit.el_set(e->line, EL_ADDFN, "vs-down", "the line below, or the entry after", line_down);
  libedit.el_set(e->line, EL_ADDFN, "vs-signature", "show how the procedure is called", signature);
  for (size_t i = 0; i < sizeof bound / sizeof *bound; i++)
    libedit.el_set(e->line, EL_BIND, bound[i].keys, bound[i].does, NULL);
  libedit.el_set(e->line, EL_SIGNAL, 0);
  return e;
}

/* Reads a character as libedit does. While no key is pressed, calls the idle functions. */
static int read_key(EditLine *line, wchar_t *key) {
  cli_editor *e = editor_of(line);
  for (;;) {
    struct pollfd in = {.fd = STDIN_FILENO, .events = POLLIN};
    int ready = poll(&in, 1, e->idle.look ? LOOK_MS : -1);
    if (ready < 0) return -1;
    if (ready == 0) {
      if (!e->idle.look || !e->idle.look(e->idle.context)) continue;
      fputs("\r\033[K", stdout);
      e->idle.act(e->idle.context);
      fflush(stdout);
      libedit.el_set(line, EL_REFRESH);
      continue;
    }
    char byte;
    ssize_t got = read(STDIN_FILENO, &byte, 1);
    if (got <= 0) return (int)got;
    size_t used = mbrtowc(key, &byte, 1, &e->partial);
    if (used == (size_t)-2) continue;
    if (used != (size_t)-1) return 1;
    memset(&e->partial, 0, sizeof e->partial); /* invalid bytes are dropped */
  }
}

void cli_editor_idle(cli_editor *e, cli_idle idle) {
  e->idle = idle;
  libedit.el_set(e->line, EL_GETCFN, read_key);
}

bool cli_editor_has_more(const cli_editor *e) {
  struct pollfd more = {.fd = STDIN_FILENO, .events = POLLIN};
  return e->rest.length > 0 || poll(&more, 1, 0) > 0;
}

const char *cli_editor_line(cli_editor *e, const char *prompt, const char *open, size_t *length, bool *whole) {
  e->prompt = prompt, e->open = open, e->taken_back = false, e->closed = 0, e->back = 0;
  e->pasted.length = 0;
  fputs("\033[?2004h", stdout); /* asks the terminal to mark pasted text */
  fflush(stdout);
  if (e->rest.length) {
    libedit.el_push(e->line, e->rest.at);
    e->rest.length = 0;
  }
  int count = 0;
  errno = 0;
  const char *line = libedit.el_gets(e->line, &count);
  int error = errno;
  fputs("\033[?2004l", stdout);
  fflush(stdout);
  errno = error;
  *whole = e->taken_back;
  if (e->pasted.length) {
    *length = e->pasted.length;
    return e->pasted.at;
  }
  if (!line || count <= 0) return NULL;
  *length = (size_t)count;
  return line;
}
