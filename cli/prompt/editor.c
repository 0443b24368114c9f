/* Edits lines on a terminal by libedit, and implements keys that libedit lacks. While libedit waits for a key, paint.c
 * paints colours over the line. Below the line, paint.c shows the arguments of the procedure at the cursor, or a menu
 * of names.
 *
 * libedit edits one buffer. A newline in the buffer is shown as a line break, so that an expression of several lines
 * can be recalled and edited. Lines that are typed one by one are also returned one by one. The prompt then shows the
 * number of open parentheses. The up key on an empty line moves all lines of the unfinished expression back into the
 * buffer. */
#include "cli/prompt/editor.h"
#include "cli/prompt/completion.h"
#include "cli/prompt/line_buffer.h"
#include "cli/prompt/paint.h"
#include "cli/prompt/source_text.h"
#include "geometry/dynamic.h"

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
/* Codes that no key of a keyboard sends. The editor sends them to itself. */
#define FLASHED "\033[9999~"
#define ENDED "\033[9998~"

/* The functions of libedit, which is loaded when the first editor opens. Linking libedit would make every start of vs
 * slower: loading it and its three libraries would take an eighth of the time of a run. The table is global: libedit
 * passes only the EditLine to callbacks, and el_get is needed to find its cli_editor. */
static struct {
#define EDIT(name) __typeof__(&name) name;
#include "cli/prompt/libedit.def"
} libedit;

static bool load_libedit(void) {
  static const vs_dynamic_name names[] = {
#define EDIT(name) { #name, offsetof(__typeof__(libedit), name) },
#include "cli/prompt/libedit.def"
  };
  vs_error error = { 0 };
  if (vs_dynamic_load(VS_LIBRARY_LIBEDIT, "the prompt's line editor", names, sizeof names / sizeof *names, &libedit,
                      &error))
    return true;
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
  bool taken_back;      /* whether the buffer contains all lines of the unfinished expression, after the up key */
  int back;             /* number of characters from the shown parenthesis back to the cursor; 0 if none is shown */
  ptrdiff_t closed;     /* position of a closing quote that completion has inserted, or 0. If the user types a quote
                         * there, the cursor only moves past it */
  cli_each_command *commands;
  cli_idle idle;
  mbstate_t partial;    /* decoder's state of a character of which only some bytes have been read */
  bool escapes, colours; /* escapes: whether the terminal understands escape sequences, which move the cursor; colours:
                          * whether it shows colours */
  cli_paint paint;      /* position of the painted rows below the line */
  cli_names menu;       /* names of the menu; count is 0 if no menu is shown */
  int chosen;           /* index of the chosen name in the menu; -1: none is chosen yet */
  size_t menu_at, menu_length; /* menu_at, menu_length: cursor position and length of the buffer when the menu was
                                * shown. If they differ now, the menu is no longer valid */
};

/* Returns true if the terminal understands escape sequences. */
static bool has_escapes(int descriptor) {
  const char *term = getenv("TERM");
  return isatty(descriptor) && term && *term && strcmp(term, "dumb") != 0;
}

bool cli_colours(int descriptor) {
  const char *no = getenv("NO_COLOR");
  return has_escapes(descriptor) && !(no && *no);
}

int cli_terminal_width(void) {
  struct winsize size;
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

static int terminal_height(void) {
  struct winsize size;
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 0 ? size.ws_row : 24;
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

/* Returns the lines of the unfinished expression, followed by the buffer up to the cursor. The caller frees the text.
 * Returns NULL when memory is out. */
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

/* Shows the ways to call a procedure, such as "  (make-sphere c r) #:segments", below the current line. */
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
  cli_call call;
  char *before = e ? text_before(e) : NULL;
  bool shown = before && cli_text_call(before, &call) && show_call(e, call.name);
  free(before);
  return shown ? CC_REDISPLAY : CC_ERROR;
}

static int characters(const char *from, const char *to) {
  int n = 0;
  for (; from < to; from++) n += ((unsigned char)*from & 0xC0) != 0x80;
  return n;
}

/* ---- completion of words ---- */

/* Inserts the closing quote after the complete name of a file. */
static bool close_string(cli_editor *e) {
  const LineInfo *info = libedit.el_line(e->line);
  if (info->cursor < info->lastchar && *info->cursor == '"') return true;
  if (libedit.el_insertstr(e->line, "\"") != 0) return false;
  info = libedit.el_line(e->line);
  e->closed = info->cursor - info->buffer;
  return true;
}

/* Inserts a quote, or moves past the quote that completion has inserted at the cursor. */
static unsigned char quote(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  const LineInfo *info = libedit.el_line(line);
  bool there = e && e->closed && info->cursor - info->buffer == e->closed && info->cursor[-1] == '"';
  if (e) e->closed = 0;
  if (there) return CC_NORM;
  return libedit.el_insertstr(line, "\"") == 0 ? CC_REFRESH : CC_ERROR;
}

static void close_menu(cli_editor *e) {
  cli_names_free(&e->menu);
  e->chosen = -1;
}

static void hold_menu(cli_editor *e) { /* records that the menu is for the current content of the buffer */
  const LineInfo *info = libedit.el_line(e->line);
  e->menu_at = (size_t)(info->cursor - info->buffer);
  e->menu_length = (size_t)(info->lastchar - info->buffer);
}

/* Returns true if the menu is shown and the buffer has not changed since then. */
static bool in_menu(const cli_editor *e) {
  const LineInfo *info = libedit.el_line(e->line);
  return e->menu.count && e->menu_at == (size_t)(info->cursor - info->buffer) &&
         e->menu_length == (size_t)(info->lastchar - info->buffer);
}

/* Chooses the name that is `by` places further in the menu, and replaces the word before the cursor by it. */
static unsigned char choose(cli_editor *e, int by) {
  int count = (int)e->menu.count;
  const char *old = e->chosen < 0 ? NULL : e->menu.at[e->chosen];
  size_t length = old ? strlen(old) : e->menu.prefix;
  e->chosen = e->chosen < 0 ? by < 0 ? count - 1 : 0 : (e->chosen + by + count) % count;
  const LineInfo *info = libedit.el_line(e->line);
  if ((size_t)(info->cursor - info->buffer) < length) return CC_ERROR;
  int columns = characters(info->cursor - length, info->cursor);
  if (columns) libedit.el_deletestr(e->line, columns);
  bool ok = libedit.el_insertstr(e->line, e->menu.at[e->chosen]) == 0;
  hold_menu(e);
  return ok ? CC_REFRESH : CC_ERROR;
}

/* Inserts the common beginning of the names, and shows them in a menu. On a terminal whose cursor cannot be moved,
 * shows them as a list if nothing could be inserted. Takes over the names. */
static unsigned char show_names(cli_editor *e, cli_names *n) {
  bool more = n->common > n->prefix;
  if (more) {
    char *end = n->at[0] + n->common, rest = *end;
    *end = 0;
    bool ok = libedit.el_insertstr(e->line, n->at[0] + n->prefix) == 0;
    *end = rest;
    n->prefix = n->common;
    if (!ok) return CC_ERROR;
  }
  if (more && !e->escapes) return CC_REFRESH;
  if (e->escapes) {
    e->menu = *n;
    e->chosen = -1;
    hold_menu(e);
    return CC_REFRESH;
  }
  enum { MOST = 50 };
  line_buffer rows = { 0 };
  if (cli_names_rows(n, -1, cli_terminal_width(), MOST, false, &rows)) printf("\r\n%s", rows.at);
  fflush(stdout);
  free(rows.at);
  cli_names_free(n);
  return CC_REDISPLAY;
}

/* Completes the word before the cursor by the only name that was found. */
static unsigned char insert_only(cli_editor *e, const cli_names *n) {
  const char *name = n->at[0];
  bool folder = *name && name[strlen(name) - 1] == '/', shown = false;
  if (n->kind == CLI_WORD_NAME && !e->escapes) shown = show_call(e, name);
  bool ok = !name[n->prefix] || libedit.el_insertstr(e->line, name + n->prefix) == 0;
  if (ok && n->kind != CLI_WORD_FILE && !folder) ok = libedit.el_insertstr(e->line, " ") == 0;
  const LineInfo *info = libedit.el_line(e->line);
  const char *start = info->cursor;
  while (start > info->buffer && start[-1] != '"') start--;
  if (ok && n->kind == CLI_WORD_FILE && !folder && start > info->buffer) ok = close_string(e);
  return !ok ? CC_ERROR : shown ? CC_REDISPLAY : CC_REFRESH;
}

/* Completes the word before the cursor by the common beginning of all names that were found. If the key is pressed
 * again, the names are chosen one after another. */
static unsigned char complete(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  if (e && in_menu(e)) return choose(e, 1);
  char *before = e ? text_before(e) : NULL;
  if (!before) return CC_ERROR;
  cli_names n;
  cli_call call;
  close_menu(e);
  cli_names_find(e->scheme, e->commands, before, &n);
  unsigned char result = CC_ERROR;
  if (n.count == 1) result = insert_only(e, &n);
  else if (n.count) result = show_names(e, &n);
  else if (!n.prefix && cli_text_call(before, &call) && show_call(e, call.name)) result = CC_REDISPLAY;
  if (result != CC_REFRESH || !e->menu.count) cli_names_free(&n);
  free(before);
  return result;
}

static unsigned char complete_back(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  return e && in_menu(e) ? choose(e, -1) : CC_ERROR;
}

/* Inserts a closing parenthesis. A terminal without colours cannot mark the matching parenthesis, so the cursor briefly
 * moves there. */
static unsigned char close_parenthesis(EditLine *line, int key) {
  char c[2] = {(char)key, 0};
  size_t open[CLI_DEEP];
  bool in_string;
  if (libedit.el_insertstr(line, c) != 0) return CC_ERROR;
  const LineInfo *info = libedit.el_line(line);
  size_t n = (size_t)(info->cursor - info->buffer) - 1, depth = cli_text_open(info->buffer, n, open, &in_string);
  cli_editor *e = editor_of(line);
  if (!e || !depth || in_string || e->colours) return CC_REFRESH;
  struct pollfd more = {.fd = STDIN_FILENO, .events = POLLIN};
  if (poll(&more, 1, 0) > 0) return CC_REFRESH; /* more characters are waiting, as in a paste: the cursor does not move
                                                 * to the matching parenthesis */
  e->back = characters(info->buffer + open[depth - 1], info->cursor);
  libedit.el_cursor(line, -e->back);
  libedit.el_push(line, FLASHED); /* libedit draws only between keys: the code FLASHED makes it call flashed() after it
                                   * has drawn */
  return CC_REFRESH;
}

/* Waits for FLASH milliseconds or the next key, then moves the cursor from the matching parenthesis back. */
static unsigned char flashed(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  if (!e || !e->back) return CC_NORM;
  poll(&(struct pollfd){.fd = STDIN_FILENO, .events = POLLIN}, 1, FLASH);
  libedit.el_cursor(line, e->back);
  e->back = 0;
  return CC_CURSOR;
}

/* Returns the column of the cursor in its line of the buffer. *above: whether the buffer has lines before this line;
 * *below: whether it has lines after it. */
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
  if (e && in_menu(e)) return choose(e, -1);
  const LineInfo *info = libedit.el_line(line);
  bool above, below;
  size_t column = column_of(info, &above, &below);
  if (above) {
    const char *end = info->cursor; /* end: position of the newline that ends the line above */
    while (end[-1] != '\n') end--;
    const char *start = --end;
    while (start > info->buffer && start[-1] != '\n') start--;
    size_t width = (size_t)characters(start, end);
    libedit.el_cursor(line, -(characters(start, info->cursor) - (int)(column < width ? column : width)));
    return CC_CURSOR;
  }
  size_t blanks = strspn(info->buffer, " ");
  if (e && *e->open && !e->taken_back && info->buffer + blanks >= info->lastchar && info->cursor == info->lastchar) {
    /* Moves the lines of the unfinished expression into the buffer. */
    if (blanks) libedit.el_deletestr(line, (int)(info->lastchar - info->buffer));
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
  cli_editor *e = editor_of(line);
  if (e && in_menu(e)) return choose(e, 1);
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

static void paint(cli_editor *e, bool ended);

/* Handles the Enter key. If the buffer contains an unfinished expression of several lines, begins another line;
 * otherwise ends the buffer. */
static unsigned char enter(EditLine *line, int key) {
  (void)key;
  cli_editor *e = editor_of(line);
  if (e && in_menu(e) && e->chosen >= 0) { /* if a name of the menu is chosen, the Enter key only accepts this name */
    close_menu(e);
    return CC_REFRESH;
  }
  const LineInfo *info = libedit.el_line(line);
  bool several = memchr(info->buffer, '\n', (size_t)(info->lastchar - info->buffer)) != NULL;
  if (e && several && vs_read_check(e->scheme, info->buffer,
      (size_t)(info->lastchar - info->buffer)).state == VS_READ_INCOMPLETE) {
    char blanks[64] = "\n", *before = text_before(e);
    size_t n = before ? cli_text_indentation(e->scheme, before) : 0;
    free(before);
    memset(blanks + 1, ' ', n);
    blanks[n + 1] = 0;
    return libedit.el_insertstr(line, blanks) == 0 ? CC_REFRESH : CC_ERROR;
  }
  if (several && info->cursor < info->lastchar) { /* moves the cursor to the end, so that output appears below all
                                                   * lines */
    libedit.el_cursor(line, characters(info->cursor, info->lastchar));
    libedit.el_push(line, "\012");
    return CC_CURSOR;
  }
  if (e && e->escapes) paint(e, true);
  libedit.el_push(line, ENDED);
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
      result = CC_NEWLINE; /* complete lines end the buffer, as the Enter key does */
    }
  }
  free(got.at);
  return result;
}

/* ---- waiting for a key ---- */

/* Appends a row of at most `width` columns with the ways to call a procedure. The argument at the cursor is in bold
 * type. */
static bool put_hint(cli_editor *e, const cli_call *call, int width, line_buffer *to) {
  vs_name_info info;
  char text[600];
  if (!vs_name_get(e->scheme, call->name, &info) || !*info.call) return false;
  int n = snprintf(text, sizeof text, "  %s%s%s%s%s", info.call, *info.keywords ? " " : "", info.keywords,
                   *info.doc ? "  " : "", info.doc);
  if (n < 0) return false;
  return cli_hint_row(text, strlen(info.call) + 2, call->argument, width, e->colours, to);
}

/* Paints colours over the line. Below the line, paints the menu or the ways to call the procedure at the cursor. ended:
 * the line was accepted, so neither a marked bracket nor rows below it are painted. */
static void paint(cli_editor *e, bool ended) {
  enum { MENU = 8 };
  char *before = text_before(e);
  const LineInfo *info = libedit.el_line(e->line);
  size_t open = e->taken_back ? 0 : strlen(e->open), length = (size_t)(info->lastchar - info->buffer);
  cli_painted line = { .text = info->buffer, .length = length, .cursor = (size_t)(info->cursor - info->buffer),
                       .prompt = (int)strlen(e->prompt), .width = cli_terminal_width(), .height = terminal_height() };
  line_buffer all = { 0 }, classes = { 0 }, below = { 0 };
  cli_call call = { .argument = -1 };
  if (!in_menu(e)) close_menu(e);
  bool ok = before && cli_line_buffer_add(&all, e->open, open) && cli_line_buffer_add(&all, info->buffer, length);
  if (ok && e->colours && all.length && cli_line_buffer_add(&classes, all.at, all.length)) {
    cli_text_classes(e->scheme, all.at, all.length, ended ? SIZE_MAX : open + line.cursor, (unsigned char *)classes.at);
    line.classes = (unsigned char *)classes.at + open;
  }
  bool calls = ok && !ended && cli_text_call(before, &call);
  int room = cli_paint_room(&line);
  if (e->menu.count && !ended) {
    line.rows = cli_names_rows(&e->menu, e->chosen, line.width, room - 1 < MENU ? room - 1 : MENU, e->colours, &below);
    if (e->chosen >= 0) snprintf(call.name, sizeof call.name, "%s", e->menu.at[e->chosen]);
    calls = e->chosen >= 0 && e->menu.kind == CLI_WORD_NAME;
  }
  if (calls && room > 1 && put_hint(e, &call, line.width, &below)) line.rows++;
  line.below = below.at;
  cli_paint_show(&e->paint, &line);
  free(before);
  free(all.at);
  free(classes.at);
  free(below.at);
}

static bool key_waits(int milliseconds) {
  return poll(&(struct pollfd){ .fd = STDIN_FILENO, .events = POLLIN }, 1, milliseconds) != 0;
}

/* Reads a character as libedit does. While no key is pressed, paints the line and calls the idle functions. */
static int read_key(EditLine *line, wchar_t *key) {
  cli_editor *e = editor_of(line);
  bool painted = !e->escapes || !mbsinit(&e->partial);
  for (;;) {
    if (!painted && !key_waits(0)) paint(e, false);
    painted = true;
    struct pollfd in = {.fd = STDIN_FILENO, .events = POLLIN};
    int ready = poll(&in, 1, e->idle.look ? LOOK_MS : -1);
    if (ready != 0) cli_paint_erase(&e->paint);
    if (ready < 0) return -1;
    if (ready == 0) {
      if (!e->idle.look || !e->idle.look(e->idle.context)) continue;
      cli_paint_erase(&e->paint);
      fputs(e->escapes ? "\r\033[K" : "\r", stdout);
      e->idle.act(e->idle.context);
      fflush(stdout);
      libedit.el_set(line, EL_REFRESH);
      painted = !e->escapes;
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

/* ---- opening and closing the editor ---- */

static char *prompt_text(EditLine *line) {
  cli_editor *e = editor_of(line);
  return (char *)(e ? e->prompt : "");
}

void cli_editor_close(cli_editor *e) {
  HistEvent event;
  if (!e) return;
  if (e->line && e->escapes) fputs("\033[?2004l", stdout), fflush(stdout);
  close_menu(e);
  if (e->history && e->history_path && libedit.history(e->history, &event, H_SAVE,
      e->history_path) >= 0) chmod(e->history_path, 0600);
  if (e->line) libedit.el_end(e->line);
  if (e->history) libedit.history_end(e->history);
  free(e->history_path);
  free(e->pasted.at);
  free(e->rest.at);
  free(e);
}

cli_editor *cli_editor_open(vs_scheme *scheme, cli_each_command *commands) {
  static const struct { const char *keys, *does; } bound[] = {
      {"^I", "vs-complete"}, {"\\e[Z", "vs-complete-back"}, {"^R", "em-inc-search-prev"},
          {")", "vs-close"}, {"]", "vs-close"},
          {"\"", "vs-quote"}, {"^M", "vs-enter"}, {"^J", "vs-enter"}, {ENDED, "ed-newline"},
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
  e->scheme = scheme, e->prompt = "> ", e->open = "", e->commands = commands, e->chosen = -1;
  e->escapes = has_escapes(STDOUT_FILENO), e->colours = cli_colours(STDOUT_FILENO);
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
  libedit.el_set(e->line, EL_ADDFN, "vs-complete-back", "go back in the menu", complete_back);
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
  libedit.el_set(e->line, EL_GETCFN, read_key);
  return e;
}

void cli_editor_idle(cli_editor *e, cli_idle idle) { e->idle = idle; }

bool cli_editor_has_more(const cli_editor *e) {
  struct pollfd more = {.fd = STDIN_FILENO, .events = POLLIN};
  return e->rest.length > 0 || poll(&more, 1, 0) > 0;
}

const char *cli_editor_line(cli_editor *e, const char *prompt, const char *open, size_t *length, bool *whole) {
  e->prompt = prompt, e->open = open, e->taken_back = false, e->closed = 0, e->back = 0;
  e->pasted.length = 0;
  if (e->escapes) fputs("\033[?2004h", stdout); /* asks the terminal to mark pasted text */
  fflush(stdout);
  if (e->rest.length) {
    libedit.el_push(e->line, e->rest.at);
    e->rest.length = 0;
  } else if (*open && !key_waits(0)) {
    char blanks[64];
    size_t n = cli_text_indentation(e->scheme, open);
    memset(blanks, ' ', n);
    blanks[n] = 0;
    if (n) libedit.el_push(e->line, blanks);
  }
  int count = 0;
  errno = 0;
  const char *line = libedit.el_gets(e->line, &count);
  int error = errno;
  if (e->escapes) fputs("\033[?2004l", stdout);
  fflush(stdout);
  close_menu(e);
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
