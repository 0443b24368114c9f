/* Reads fonts with the library FreeType, which is loaded for the first text. Each store has one instance of the
 * library, and one FreeType face for each font.
 *
 * FreeType allocates its memory from the store, so that limits apply, and a refused allocation is noticed. This is
 * necessary because FreeType omits a table for which there is no memory, and continues. A text without kerning would
 * then look different. */
#include "geometry/text/font.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MODULE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H

#include "geometry/dynamic.h"
#include "geometry/text/fontfile.h"
#include "geometry/text/kerning.h"
#include "model/store/nodemap.h"

/* X macro that lists the FreeType functions that this file calls, as rows F(member, symbol, result, parameters). */
#define FREETYPE_FUNCTIONS(F)                                                                                          \
  F(create, FT_New_Library, FT_Error, (FT_Memory, FT_Library *))                                                       \
  F(modules, FT_Add_Default_Modules, void, (FT_Library))                                                               \
  F(done, FT_Done_Library, FT_Error, (FT_Library))                                                                     \
  F(open_file, FT_New_Face, FT_Error, (FT_Library, const char *, FT_Long, FT_Face *))                                  \
  F(open_memory, FT_New_Memory_Face, FT_Error, (FT_Library, const FT_Byte *, FT_Long, FT_Long, FT_Face *))             \
  F(close, FT_Done_Face, FT_Error, (FT_Face))                                                                          \
  F(index, FT_Get_Char_Index, FT_UInt, (FT_Face, FT_ULong))                                                            \
  F(load, FT_Load_Glyph, FT_Error, (FT_Face, FT_UInt, FT_Int32))                                                       \
  F(decompose, FT_Outline_Decompose, FT_Error, (FT_Outline *, const FT_Outline_Funcs *, void *))                       \
  F(kerning, FT_Get_Kerning, FT_Error, (FT_Face, FT_UInt, FT_UInt, FT_UInt, FT_Vector *))                              \
  F(table, FT_Load_Sfnt_Table, FT_Error, (FT_Face, FT_ULong, FT_Long, FT_Byte *, FT_ULong *))

VS_DYNAMIC_FUNCTIONS(FREETYPE_FUNCTIONS);

typedef struct {
  dynamic_functions call;
  vs_store *store;
  struct FT_MemoryRec_ memory;
  FT_Library library;
  bool refused; /* true if FreeType has asked the store for memory in vain since `refused` was last set to false */
  vs_font *first;
} font_shelf;

struct vs_font {
  vs_store *store; /* store that owns this structure, which holds no reference to the store */
  font_shelf *shelf;
  vs_font *next;
  const char *name;
  FT_Face face;
  void *bytes; /* copy of the bytes of the font's file; NULL if FreeType reads the file itself */
  size_t size;
  double capital;
  vs_nodemap glyphs; /* maps the index of a glyph, plus 1, to the address of its outline (vs_glyph) */
  unsigned char *pairs; /* the GPOS table (kerning) of a font that has no kern table; else NULL */
  size_t pairs_size;
};

/* ---- FreeType's memory: blocks from the store, each preceded by its size ---- */

typedef union { size_t bytes; max_align_t align; } font_block;

static void *font_resize(font_shelf *shelf, void *old, long size) {
  font_block *b = old ? (font_block *)old - 1 : NULL;
  size_t bytes = sizeof *b + (size_t)size;
  b = size < 0 ? NULL : vs_store_realloc(shelf->store, b, b ? b->bytes : 0, bytes);
  if (!b) return shelf->refused = true, NULL;
  b->bytes = bytes;
  return b + 1;
}
static void *font_take(FT_Memory m, long size) { return font_resize(m->user, NULL, size); }
static void *font_change(FT_Memory m, long old_size, long size, void *old) {
  return (void)old_size, font_resize(m->user, old, size);
}
static void font_give(FT_Memory m, void *old) {
  font_block *b = old ? (font_block *)old - 1 : NULL;
  if (b) vs_store_realloc(((font_shelf *)m->user)->store, b, b->bytes, 0);
}

/* ---- the fonts of a store ---- */

static void font_free(vs_font *f) {
  vs_store *s = f->store;
  for (size_t i = 0; i < f->glyphs.room; i++) {
    if (!f->glyphs.slots[i].key) continue;
    vs_glyph *g = (vs_glyph *)(uintptr_t)f->glyphs.slots[i].value;
    if (!g) continue;
    vs_store_realloc(s, g->steps, g->room * sizeof *g->steps, 0);
    vs_store_realloc(s, g, sizeof *g, 0);
  }
  vs_nodemap_free(&f->glyphs);
  vs_store_realloc(s, f->bytes, f->size, 0); /* frees the rest of the font; FreeType's face is freed with the library,
                                              * or was never made */
  vs_store_realloc(s, f->pairs, f->pairs_size, 0);
  vs_store_realloc(s, f, sizeof *f, 0);
}

static void font_let_go(vs_store *s, void *kept) {
  font_shelf *shelf = kept;
  if (shelf->library) shelf->call.done(shelf->library); /* frees the library and all its faces */
  for (vs_font *f = shelf->first, *next; f; f = next) {
    next = f->next;
    font_free(f);
  }
  vs_store_realloc(s, shelf, sizeof *shelf, 0);
}

static font_shelf *font_shelf_of(vs_store *s, vs_error *e) {
  void **kept = vs_store_kept(s, font_let_go);
  if (*kept) return *kept;
  font_shelf made = { .store = s };
  if (!vs_dynamic_load(VS_LIBRARY_FREETYPE, "make-text", dynamic_names, sizeof dynamic_names / sizeof *dynamic_names,
                       &made.call, e))
    return NULL;
  font_shelf *shelf = vs_store_realloc(s, NULL, 0, sizeof *shelf);
  bool ok = shelf != NULL;
  if (ok) {
    *shelf = made;
    shelf->memory =
        (struct FT_MemoryRec_){ .user = shelf, .alloc = font_take, .free = font_give, .realloc = font_change };
    ok = !shelf->call.create(&shelf->memory, &shelf->library);
    if (ok) shelf->call.modules(shelf->library);
  }
  if (!ok || shelf->refused) {
    if (shelf && shelf->library) shelf->call.done(shelf->library);
    if (shelf) vs_store_realloc(s, shelf, sizeof *shelf, 0);
    vs_error_memory(e, NULL);
    return NULL;
  }
  *kept = shelf;
  return shelf;
}

/* ---- opening a font ---- */

bool vs_font_is_path(const char *name) {
  static const char *const endings[] = { ".ttf", ".otf", ".ttc", ".otc", ".pfb" };
  size_t length = strlen(name);
  if (strchr(name, '/')) return true;
  for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
    bool same = length > 4;
    for (size_t k = 0; same && k < 4; k++) {
      char c = name[length - 4 + k];
      same = (c >= 'A' && c <= 'Z' ? c + 32 : c) == endings[i][k];
    }
    if (same) return true;
  }
  return false;
}

/* Measures the height of the font's letter H. Sizes of text refer to it, so that they mean the same height in every
 * font. A font of symbols without an H gets the usual height, .7 of the em. */
static bool font_measure(vs_font *f, vs_error *e) {
  uint32_t index = vs_font_index(f, 'H');
  f->capital = 0.7 * f->face->units_per_EM;
  if (!index) return true;
  const vs_glyph *g = vs_font_glyph(f, index, e);
  double top = 0;
  if (!g) return false;
  for (size_t i = 0; i < g->count; i++) top = g->steps[i].to.y > top ? g->steps[i].to.y : top;
  if (top > 0) f->capital = top;
  return true;
}

/* Loads the GPOS table of a font that has no kern table. Returns false when memory is out. */
static bool font_load_pairs(vs_font *f) {
  const dynamic_functions *ft = &f->shelf->call;
  const FT_ULong gpos = 0x47504F53; /* gpos: the name of the table, the four letters 'GPOS', as one number */
  FT_ULong size = 0;
  enum { MOST = 8 << 20 };
  if (FT_HAS_KERNING(f->face) || ft->table(f->face, gpos, 0, NULL, &size) || size == 0 || size > MOST)
    return !f->shelf->refused;
  f->pairs = vs_store_realloc(f->store, NULL, 0, size);
  if (!f->pairs) return false;
  f->pairs_size = size;
  if (ft->table(f->face, gpos, 0, f->pairs, &size)) {
    vs_store_realloc(f->store, f->pairs, f->pairs_size, 0);
    f->pairs = NULL;
    f->pairs_size = 0;
  }
  return !f->shelf->refused;
}

/* Frees a font that could be read only partly. */
static void font_drop(vs_font *f) {
  if (f->face) f->shelf->call.close(f->face);
  font_free(f);
}

/* The source of a font: the contents of a font file in `bytes`, which are copied; or if bytes is NULL, the file at
 * `path`. */
typedef struct { const char *name, *path; const void *bytes; size_t size; } font_source;

static vs_font *font_open(font_shelf *shelf, vs_store *s, const font_source *source, vs_error *e) {
  const char *name = source->name, *path = source->path;
  const void *bytes = source->bytes;
  size_t size = source->size;
  vs_font *f = vs_store_realloc(s, NULL, 0, sizeof *f);
  const char *kept = vs_store_text(s, name, strlen(name));
  if (f) *f = (vs_font){ .store = s, .shelf = shelf, .name = kept, .glyphs = { .store = s } };
  if (f && bytes && (f->bytes = vs_store_realloc(s, NULL, 0, size ? size : 1)) != NULL) {
    memcpy(f->bytes, bytes, size);
    f->size = size ? size : 1;
  }
  if (!f || !kept || (bytes && !f->bytes)) {
    if (f) font_free(f);
    vs_error_memory(e, NULL);
    return NULL;
  }
  shelf->refused = false;
  errno = 0;
  int problem = bytes ? shelf->call.open_memory(shelf->library, f->bytes, (FT_Long)size, 0, &f->face)
                      : shelf->call.open_file(shelf->library, path, 0, &f->face);
  if (shelf->refused || problem == FT_Err_Out_Of_Memory || (problem && errno == ENOMEM)) {
    vs_error_memory(e, NULL);
    font_drop(f);
    return NULL;
  }
  if (problem || !FT_IS_SCALABLE(f->face) || f->face->units_per_EM == 0) {
    vs_error_set(e, VS_ERROR_MODEL, NULL,
                 problem == FT_Err_Cannot_Open_Resource ? "there is no file \"%.300s\""
                                                        : "\"%.300s\" is no font with outlines",
                 path ? path : name);
    font_drop(f);
    return NULL;
  }
  f->next = shelf->first;
  shelf->first = f;
  if (!font_measure(f, e) || !(font_load_pairs(f) || vs_error_memory(e, NULL))) {
    shelf->first = f->next;
    font_drop(f);
    return NULL;
  }
  return f;
}

static vs_font *font_find(const font_shelf *shelf, const char *name) {
  for (vs_font *f = shelf->first; f; f = f->next)
    if (!strcmp(f->name, name)) return f;
  return NULL;
}

vs_font *vs_font_get(vs_store *s, const char *name, vs_error *e) {
  char path[1024];
  font_shelf *shelf = font_shelf_of(s, e);
  if (!shelf) return NULL;
  vs_font *f = font_find(shelf, name);
  if (f) return f;
  if (vs_font_is_path(name)) return font_open(shelf, s, &(font_source){ .name = name, .path = name }, e);
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  if (vs_font_file(name, path, sizeof path, &why))
    return font_open(shelf, s, &(font_source){ .name = name, .path = path }, e);
  if (why.kind != VS_ERROR_NONE) {
    if (e) *e = why;
    return NULL;
  }
  char families[300];
  vs_font_families(families, sizeof families);
  if (!*name)
    vs_error_set(e, VS_ERROR_WORKER, NULL, "the font DejaVu Sans is missing: it is in the package fonts-dejavu-core");
  else if (*families)
    vs_error_set(e, VS_ERROR_MODEL, NULL, "there is no font \"%.100s\"; there is: %s", name, families);
  else vs_error_set(e, VS_ERROR_MODEL, NULL, "there is no font \"%.100s\", nor any other", name);
  return NULL;
}

bool vs_font_known(vs_store *s, const char *name) {
  void **kept = vs_store_kept(s, font_let_go);
  return *kept && font_find(*kept, name);
}

bool vs_font_add(vs_store *s, const char *name, const void *bytes, size_t size, vs_error *e) {
  font_shelf *shelf = font_shelf_of(s, e);
  if (!shelf) return false;
  return font_find(shelf, name) || font_open(shelf, s, &(font_source){ name, NULL, bytes, size }, e);
}

/* ---- properties of a font ---- */

double vs_font_capital(const vs_font *f) { return f->capital; }

double vs_font_line(const vs_font *f) { return f->face->height > 0 ? f->face->height : 1.2 * f->face->units_per_EM; }

double vs_font_descent(const vs_font *f) { return f->face->descender < 0 ? -f->face->descender : 0; }

uint32_t vs_font_index(const vs_font *f, uint32_t character) { return f->shelf->call.index(f->face, character); }

double vs_font_kerning(const vs_font *f, uint32_t left, uint32_t right) {
  FT_Vector by;
  if (f->pairs) return vs_kerning_pair(f->pairs, f->pairs_size, left, right);
  return FT_HAS_KERNING(f->face) && !f->shelf->call.kerning(f->face, left, right, FT_KERNING_UNSCALED, &by)
             ? (double)by.x
             : 0;
}

/* ---- outlines of glyphs ---- */

typedef struct { vs_store *store; vs_glyph *glyph; } font_drawing;

static int font_step(void *drawing, vs_glyph_step step) {
  font_drawing *d = drawing;
  vs_glyph *g = d->glyph;
  if (g->count == g->room) {
    size_t room = g->room ? 2 * g->room : 32;
    vs_glyph_step *grown = vs_store_realloc(d->store, g->steps, g->room * sizeof *grown, room * sizeof *grown);
    if (!grown) return 1;
    g->steps = grown;
    g->room = room;
  }
  g->steps[g->count++] = step;
  return 0;
}

static vs_font_point font_point(const FT_Vector *v) { return (vs_font_point){ (double)v->x, (double)v->y }; }
static int font_move(const FT_Vector *to, void *d) {
  return font_step(d, (vs_glyph_step){ .kind = VS_STEP_MOVE, .to = font_point(to) });
}
static int font_line(const FT_Vector *to, void *d) {
  return font_step(d, (vs_glyph_step){ .kind = VS_STEP_LINE, .to = font_point(to) });
}
static int font_quadratic(const FT_Vector *b, const FT_Vector *to, void *d) {
  return font_step(d, (vs_glyph_step){ .kind = VS_STEP_QUADRATIC, .b = font_point(b), .to = font_point(to) });
}
static int font_cubic(const FT_Vector *a, const FT_Vector *b, const FT_Vector *to, void *d) {
  return font_step(
      d, (vs_glyph_step){ .kind = VS_STEP_CUBIC, .a = font_point(a), .b = font_point(b), .to = font_point(to) });
}

const vs_glyph *vs_font_glyph(vs_font *f, uint32_t index, vs_error *e) {
  static const FT_Outline_Funcs functions = { font_move, font_line, font_quadratic, font_cubic, 0, 0 };
  const dynamic_functions *ft = &f->shelf->call;
  const void *key = (const void *)((uintptr_t)index + 1);
  const uint64_t *known = vs_nodemap_get(&f->glyphs, key);
  if (known && *known) return (const vs_glyph *)(uintptr_t)*known;
  uint64_t *place = vs_nodemap_put(&f->glyphs, key, NULL);
  vs_glyph *g = place ? vs_store_realloc(f->store, NULL, 0, sizeof *g) : NULL;
  if (!g) {
    vs_error_memory(e, NULL);
    return NULL;
  }
  *g = (vs_glyph){ .count = 0 };
  font_drawing d = { f->store, g };
  f->shelf->refused = false;
  int problem = ft->load(f->face, index, FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP);
  if (!problem) {
    g->advance = (double)f->face->glyph->metrics.horiAdvance;
    if (f->face->glyph->format == FT_GLYPH_FORMAT_OUTLINE)
      problem = ft->decompose(&f->face->glyph->outline, &functions, &d);
  }
  if (problem || f->shelf->refused) {
    if (problem == 1 || f->shelf->refused) vs_error_memory(e, NULL); /* the callback font_step has returned 1, or
                                                                      * FreeType was refused memory: memory is out */
    else
      vs_error_set(e, VS_ERROR_MODEL, NULL, "the font \"%.100s\" is damaged: glyph %lu cannot be read", f->name,
                   (unsigned long)index);
    vs_store_realloc(f->store, g->steps, g->room * sizeof *g->steps, 0);
    vs_store_realloc(f->store, g, sizeof *g, 0);
    return NULL;
  }
  *place = (uint64_t)(uintptr_t)g;
  return g;
}
