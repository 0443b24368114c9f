/* Finds the places of a name in all files of a project. Each file that may have the name is analysed. */
#define _GNU_SOURCE
#include "cli/lsp/lsp_project.h"

#include <dirent.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "cli/lsp/lsp_libraries.h"
#include "cli/lsp/lsp_words.h"
#include "languages/analysis/notation.h"
#include "model/store/array.h"

enum { MOST_FILES = 2000, MOST_FOLDERS = 1000, MOST_BYTES = 4 << 20, SECONDS = 10 };

/* The searched name. path: the file of its definition; from: offset of the name there; form: place of the defining
 * form; library: text of the name of the library that the file defines, or NULL. */
typedef struct { char path[PATH_MAX]; char *name; uint32_t from; know_place form; char *library; } target;

/* ---- files ---- */

static bool is_same_file(const char *path, const char *real) {
  char found[PATH_MAX];
  return realpath(path, found) && !strcmp(found, real);
}

/* Returns the editor's document of the file, or NULL. */
static lsp_document *open_document(const lsp_server *s, const char *path) {
  for (size_t i = 0; i < s->count; i++)
    if (is_same_file(s->documents[i]->path, path)) return s->documents[i];
  return NULL;
}

static bool add_file(lsp_project *p, const lsp_server *s, const char *path) {
  for (size_t i = 0; i < p->count; i++)
    if (!strcmp(p->files[i].path, path)) return true;
  if (!VS_GROW(p->files, p->room, p->count + 1)) return false;
  p->files[p->count] = (lsp_project_file){ .path = strdup(path), .open = open_document(s, path), .fresh = true };
  return p->files[p->count++].path != NULL;
}

/* Returns whether the name ends as those of programs and libraries. */
static bool is_program(const char *name) {
  static const char *const endings[] = { ".vs", ".scm", ".ss", ".sld", ".js" };
  const char *dot = strrchr(name, '.');
  for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++)
    if (!strcmp(dot, endings[i])) return true;
  return false;
}

/* Adds the entry of a folder: a program to the files, a folder to the folders that are still to be read. */
static bool add_entry(lsp_project *p, const lsp_server *s, const char *path, char ***folders, size_t *count) {
  struct stat facts;
  if (lstat(path, &facts) != 0) return true;
  if (S_ISREG(facts.st_mode)) return !is_program(path) || facts.st_size > MOST_BYTES || add_file(p, s, path);
  if (!S_ISDIR(facts.st_mode)) return true;
  if (*count == MOST_FOLDERS) return p->whole = false, true;
  (*folders)[*count] = strdup(path);
  return (*folders)[(*count)++] != NULL;
}

/* Adds the programs in the folder and in all folders below it, without hidden ones. */
static bool add_folder(lsp_project *p, const lsp_server *s, const char *root) {
  char **folders = vs_zeros(MOST_FOLDERS, sizeof *folders), path[PATH_MAX];
  size_t count = 0;
  bool ok = folders && (folders[count++] = strdup(root)) != NULL;
  for (size_t i = 0; ok && i < count; i++) {
    DIR *folder = opendir(folders[i]);
    for (const struct dirent *e; folder && ok && (e = readdir(folder)) != NULL;) {
      int n = snprintf(path, sizeof path, "%s/%s", folders[i], e->d_name);
      if (*e->d_name == '.' || !strcmp(e->d_name, "node_modules") || n >= (int)sizeof path) continue;
      if (p->count >= MOST_FILES) p->whole = false;
      else ok = add_entry(p, s, path, &folders, &count);
    }
    if (folder) closedir(folder);
  }
  for (size_t i = 0; i < count; i++) free(folders[i]);
  free(folders);
  return ok;
}

/* Opens the file as a document, unless the editor has it open. Returns false if it cannot be read. */
static bool open_file(lsp_project_file *f) {
  char *text = NULL;
  size_t room = 0, length = 0, got = 1;
  if (f->open) return true;
  FILE *from = fopen(f->path, "rb");
  while (from && got && length < MOST_BYTES && VS_GROW(text, room, length + 65536))
    length += got = fread(text + length, 1, 65536, from);
  if (from) fclose(from);
  f->open = text ? lsp_document_open(f->path, text, length) : NULL;
  f->owned = f->open != NULL;
  free(text);
  return f->owned;
}

/* ---- the definition ---- */

bool lsp_is_top(const knowledge *k, const know_symbol *y) {
  const know_scope *scope = &k->scopes[y->scope];
  return scope->kind == KNOW_SCOPE_PROGRAM || (scope->kind == KNOW_SCOPE_BODY && scope->node &&
                                               know_is(k, know_at(k, scope->node)->first, "define-library"));
}

/* Returns the symbol that the file itself defines at the offset, or 0. */
static know_index defined_at(const knowledge *k, uint32_t from) {
  for (know_index i = 1; i < k->symbol_count; i++) {
    know_index node = k->symbols[i].definition;
    if (node && !k->symbols[i].made && !know_at(k, node)->at.file && know_at(k, node)->at.from == from) return i;
  }
  return 0;
}

/* Returns the symbol at the top level of the file whose defining form contains the place, or 0. */
static know_index defined_around(const knowledge *k, const vs_span *at) {
  for (know_index i = 1; i < k->symbol_count; i++) {
    const know_symbol *y = &k->symbols[i];
    if (!y->definition || y->made || !y->form || know_at(k, y->form)->at.file || !lsp_is_top(k, y)) continue;
    const know_place *f = &know_at(k, y->form)->at;
    bool after = at->line > f->line || (at->line == f->line && at->column >= f->column);
    bool before = at->line < f->end_line || (at->line == f->end_line && at->column <= f->end_column);
    if (after && before) return i;
  }
  return 0;
}

/* Returns the name of the library that the file defines, as its text; the caller frees it. Returns NULL if it defines
 * none. */
static char *library_of(const knowledge *k) {
  for (know_index i = know_at(k, k->files[0].root)->first; i; i = know_at(k, i)->next) {
    know_index head = know_at(k, i)->first, name = head ? know_at(k, head)->next : 0;
    size_t n = 0;
    if (!name || !know_is(k, head, "define-library")) continue;
    const char *text = know_spelling(k, name, &n);
    return strndup(text, n);
  }
  return NULL;
}

/* ---- places ---- */

static bool add_place(lsp_project *p, const lsp_server *s, const char *path, lsp_name_place at) {
  char real[PATH_MAX];
  if (!realpath(path, real) || !add_file(p, s, real)) return true; /* a file that is no longer there */
  for (at.file = 0; strcmp(p->files[at.file].path, real);) at.file++;
  for (size_t i = 0; i < p->place_count; i++)
    if (p->places[i].file == at.file && p->places[i].from == at.from) return true;
  if (!VS_GROW(p->places, p->place_room, p->place_count + 1)) return false;
  p->places[p->place_count++] = at;
  return true;
}

/* Compares two texts, without regard to the number of blanks. */
static bool same_words(const char *a, size_t n, const char *b) {
  const char *end = a + n;
  while (true) {
    size_t x = 0, y = strspn(b, " \t\r\n");
    while (a + x < end && strchr(" \t\r\n", a[x])) x++;
    a += x, b += y;
    if (a == end || !*b) return a == end && !*b;
    if (*a++ != *b++) return false;
  }
}

/* Returns whether the import set at the node is of the library: its name, or a set such as (only SET word). */
static bool names_library(const knowledge *k, know_index set, const char *library) {
  while (set && know_at(k, set)->kind == KNOW_LIST) {
    size_t n = 0;
    const char *text = know_spelling(k, set, &n);
    if (same_words(text, n, library)) return true;
    set = know_at(k, set)->first ? know_at(k, know_at(k, set)->first)->next : 0;
  }
  return false;
}

/* Returns whether the symbol node is a word of a set in an import of the library, as spire in (only (towers spire)
 * spire). */
static bool is_import_word(const knowledge *k, know_index node, const char *library) {
  know_index set = know_at(k, node)->parent, up = set;
  if (!set) return false;
  if (know_at(k, set)->parent && know_is(k, know_at(k, know_at(k, set)->parent)->first, "rename")) {
    if (know_at(k, set)->first != node) return false; /* the new name of a pair in (rename (lib) (old new)) */
    set = up = know_at(k, set)->parent;
  } else if (know_at(k, set)->first == node) return false;
  know_index head = know_at(k, set)->first;
  if (!know_is(k, head, "only") && !know_is(k, head, "except") && !know_is(k, head, "rename")) return false;
  for (; up; up = know_at(k, up)->parent)
    if (know_is(k, know_at(k, up)->first, "import")) return names_library(k, set, library);
  return false;
}

/* Returns whether the symbol is the searched name; *other: under another spelling. */
static bool is_target(knowledge *k, know_index symbol, const target *t, bool *other) {
  const know_symbol *y = &k->symbols[symbol];
  vs_name_info info;
  *other = strcmp(y->text, t->name) != 0;
  if (y->definition)
    return !*other && know_at(k, y->definition)->at.from == t->from &&
           is_same_file(k->files[know_at(k, y->definition)->at.file].path, t->path);
  if (!t->library || !vs_name_get(k->scheme, y->text, &info) || !info.own) return false;
  /* a variable: its place is not known */
  if (!info.at.file || !info.at.line) return !*other && y->kind == KNOW_BUILTIN;
  const know_place *f = &t->form;
  bool after = info.at.line > f->line || (info.at.line == f->line && info.at.column >= f->column);
  bool before = info.at.line < f->end_line || (info.at.line == f->end_line && info.at.column <= f->end_column);
  return after && before && is_same_file(info.at.file, t->path);
}

/* Returns whether the analysed file imports the library. */
static bool imports(const knowledge *k, const char *library) {
  for (know_index i = 1; library && i <= k->text_nodes; i++)
    if (know_at(k, i)->kind == KNOW_LIST && know_is(k, know_at(k, i)->first, "import"))
      for (know_index set = know_at(k, know_at(k, i)->first)->next; set; set = know_at(k, set)->next)
        if (names_library(k, set, library)) return true;
  return false;
}

/* ---- the searched name ---- */

/* Returns whether the analysed file imports the library with a prefix. */
static bool has_prefix(const knowledge *k, const char *library) {
  for (know_index i = 1; library && i <= k->text_nodes; i++)
    if (know_at(k, i)->kind == KNOW_LIST && know_is(k, know_at(k, i)->first, "prefix") && names_library(k, i, library))
      return true;
  return false;
}

/* Returns the symbol of this name at the top level of the file, or 0. */
static know_index defined_as(const knowledge *k, const char *name) {
  for (know_index i = 1; i < k->symbol_count; i++)
    if (k->symbols[i].definition && lsp_is_top(k, &k->symbols[i]) && !strcmp(k->symbols[i].text, name)) return i;
  return 0;
}

/* Opens the file number i and analyses it. Returns the analysis, or NULL. */
static knowledge *analysed(lsp_project *p, lsp_server *s, size_t i) {
  lsp_project_file *f = &p->files[i];
  return open_file(f) && lsp_document_study(f->open, s->interpreter) ? &f->open->draft->k : NULL;
}

static bool set_target(target *t, const knowledge *own, know_index found, const char *path) {
  const know_symbol *y = &own->symbols[found];
  if (!found) return false;
  snprintf(t->path, sizeof t->path, "%s", path);
  t->name = strdup(y->text);
  t->from = know_at(own, y->definition)->at.from;
  t->form = know_at(own, y->form ? y->form : y->definition)->at;
  t->library = library_of(own);
  return t->name != NULL;
}

/* Sets t to a variable that the document imports from a library of the project: the interpreter knows no place of
 * it. */
static bool find_variable(target *t, lsp_project *p, lsp_server *s, const knowledge *k, const char *name) {
  for (size_t i = 0; i < p->count; i++) {
    size_t n = strlen(p->files[i].path);
    knowledge *own = n > 4 && !strcmp(p->files[i].path + n - 4, ".sld") ? analysed(p, s, i) : NULL;
    know_index found = own ? defined_as(own, name) : 0;
    char *library = found ? library_of(own) : NULL;
    bool ours = library && imports(k, library);
    free(library);
    if (ours) return set_target(t, own, found, p->files[i].path);
  }
  return false;
}

/* Sets t to the definition of the symbol. Returns false if the symbol concerns only its own text. */
static bool find_target(target *t, lsp_project *p, lsp_server *s, lsp_document *d, know_index symbol) {
  knowledge *k = &d->draft->k;
  const know_symbol *y = &k->symbols[symbol];
  vs_name_info info = { 0 };
  char path[PATH_MAX];
  if (y->definition && (!lsp_is_top(k, y) || y->made)) return false;
  if (!y->definition && !lsp_is_imported(k, symbol, &info))
    return vs_name_get(k->scheme, y->text, &info) && info.own && find_variable(t, p, s, k, y->text);
  const char *file = y->definition ? k->files[know_at(k, y->definition)->at.file].path : info.at.file;
  if (!realpath(file, path) || !add_file(p, s, path)) return false;
  size_t i = 0;
  while (strcmp(p->files[i].path, path)) i++;
  const knowledge *own = analysed(p, s, i);
  if (!own) return false;
  return set_target(t, own,
                    y->definition ? defined_at(own, know_at(k, y->definition)->at.from) : defined_around(own, &info.at),
                    path);
}

/* ---- the search ---- */

/* Adds the places that the analysis has. The name of an import's set is none of its symbols. */
static bool add_places(lsp_project *p, const lsp_server *s, knowledge *k, const target *t) {
  unsigned char *verdicts = vs_zeros(k->symbol_count + 1, 1); /* of a symbol: 1: another, 2: the name, 3: spelled
                                                               * otherwise */
  bool ok = verdicts != NULL, ours = imports(k, t->library);
  for (know_index i = 1; ok && i < k->node_count; i++) { /* nodes of loaded files follow those of macros */
    const know_node *n = know_at(k, i);
    bool other = false;
    if (n->kind != KNOW_SYMBOL || n->made) continue;
    lsp_name_place at = { .from = n->at.from, .to = n->at.to };
    if (ours && !strcmp(k->names[n->name].text, t->name) && is_import_word(k, i, t->library)) {
      ok = add_place(p, s, k->files[n->at.file].path, at);
      continue;
    }
    if (!n->symbol || !lsp_is_name_of(k, i, n->symbol)) continue;
    if (!k->symbols[n->symbol].definition && !ours) continue;
    unsigned char *verdict = &verdicts[n->symbol];
    if (!*verdict) *verdict = is_target(k, n->symbol, t, &other) ? other ? 3 : 2 : 1;
    at.other = *verdict == 3;
    if (*verdict > 1) ok = add_place(p, s, k->files[n->at.file].path, at);
  }
  free(verdicts);
  return ok;
}

/* Returns whether no word of the file, and no name of its interpreter, is this name. */
static bool is_fresh(const knowledge *k, const char *name) {
  vs_name_info info;
  for (know_index i = 1; i <= k->text_nodes; i++)
    if (know_at(k, i)->kind == KNOW_SYMBOL && !strcmp(k->names[know_at(k, i)->name].text, name)) return false;
  return !vs_name_get(k->scheme, name, &info);
}

/* Returns whether the text may have the name: its letters, the last word of its library, or the load of a file. */
static bool may_have(const char *text, const target *t) {
  char word[200] = "";
  const char *last = t->library ? strrchr(t->library, ' ') : NULL;
  if (last) snprintf(word, sizeof word, "%.*s", (int)strcspn(last + 1, ")"), last + 1);
  return strstr(text, t->name) || strstr(text, "load") || strstr(text, "include") ||
         (t->library && strstr(text, *word ? word : "import"));
}

/* Searches the file. Returns false when memory is out. */
static bool search(lsp_project *p, lsp_server *s, size_t i, const target *t, const char *new_name) {
  lsp_project_file *f = &p->files[i];
  if (!open_file(f)) return true;
  if (!may_have(f->open->text, t) || !lsp_document_study(f->open, s->interpreter)) return true;
  lsp_document *d = f->open;
  f->prefixed = has_prefix(&d->draft->k, t->library);
  if (new_name) f->fresh = is_fresh(&d->draft->k, new_name);
  bool owned = f->owned, ok = add_places(p, s, &d->draft->k, t);
  if (owned) lsp_document_rest(d);
  return ok;
}

static int by_place(const void *a, const void *b) {
  const lsp_name_place *x = a, *y = b;
  if (x->file != y->file) return x->file < y->file ? -1 : 1;
  return x->from < y->from ? -1 : x->from > y->from;
}

bool lsp_project_find(lsp_project *p, lsp_server *s, lsp_document *d, know_index symbol, const char *new_name) {
  target t = { 0 };
  char folder[PATH_MAX], own[PATH_MAX];
  time_t begun = time(NULL);
  *p = (lsp_project){ .whole = true, .here = true };
  if (*d->path != '/' || !realpath(d->path, own)) return false;
  size_t n = s->root ? strlen(s->root) : 0;
  bool within = n > 1 && !strncmp(own, s->root, n) && own[n] == '/';
  snprintf(folder, sizeof folder, "%s", within ? s->root : own);
  if (!within) *strrchr(folder, '/') = 0;
  bool ok = add_file(p, s, own) && add_folder(p, s, *folder ? folder : "/") && find_target(&t, p, s, d, symbol);
  for (size_t i = 0; ok && i < p->count; i++) {
    if (time(NULL) - begun > SECONDS) p->whole = false;
    else ok = search(p, s, i, &t, new_name);
  }
  if (p->place_count) qsort(p->places, p->place_count, sizeof *p->places, by_place);
  for (size_t i = 0; i < p->place_count; i++) p->here &= !strcmp(p->files[p->places[i].file].path, own);
  for (size_t i = 0; ok && i < p->place_count; i++) ok = open_file(&p->files[p->places[i].file]);
  free(t.library);
  free(t.name);
  return ok;
}

void lsp_project_free(lsp_project *p) {
  for (size_t i = 0; i < p->count; i++) {
    if (p->files[i].owned) lsp_document_free(p->files[i].open);
    free(p->files[i].path);
  }
  free(p->files);
  free(p->places);
  *p = (lsp_project){ 0 };
}

const lsp_document *lsp_project_text(const lsp_project *p, const lsp_name_place *at) {
  return p->files[at->file].open;
}
