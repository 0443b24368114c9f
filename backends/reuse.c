/* Implements the cache of written text for later exports (reuse.h). */
#include "backends/reuse.h"

enum {
  MOST_WORDS = 1 << 22, /* length of the longest key of a cached text in words of 8 bytes: 32 MB, enough for a mesh of a
                         * million corners */
  MOST_TEXT = 1 << 26,  /* length of the longest text that is cached, in bytes */
  LEAST_TEXT = 1024     /* length in bytes of the shortest text that is cached; writing a shorter text again is faster
                         * than finding it */
};

/* ---- keys ---- */

bool vs_reuse_more(vs_reuse *r, void *array, size_t *room, size_t need, size_t size) {
  if (vs_store_grow(r->store, array, room, need, size)) return true;
  r->unfit = true;
  return false;
}

bool vs_reuse_grow(vs_reuse *r, size_t need) {
  r->unfit = r->unfit || r->count + need > MOST_WORDS;
  return !r->unfit && vs_reuse_more(r, &r->words, &r->room, r->count + need, sizeof *r->words);
}

void vs_reuse_put_reals(vs_reuse *r, const double *reals, size_t count) {
  if (count == 0 || !vs_reuse_room(r, count)) return;
  memcpy(r->words + r->count, reals, count * sizeof *reals);
  r->count += count;
}

/* Puts the reals of a single field into the key. For so few numbers, a loop is faster than memcpy. */
static void put_few(vs_reuse *r, const double *reals, size_t count) {
  if (!vs_reuse_room(r, count)) return; /* the key's memory may be full after the array, so more is requested */
  uint64_t *to = r->words + r->count;
  for (size_t i = 0; i < count; i++) memcpy(&to[i], &reals[i], sizeof *to);
  r->count += count;
}

static void put_bytes(vs_reuse *r, const void *bytes, size_t size) {
  size_t words = (size + sizeof *r->words - 1) / sizeof *r->words;
  if (words == 0 || !vs_reuse_room(r, words)) return;
  r->words[r->count + words - 1] = 0;
  memcpy(r->words + r->count, bytes, size);
  r->count += words;
}

/* Puts the values of a node's fields into the key. Texts and materials are interned in the store, which exists longer
 * than the cache, so their addresses identify them. */
void vs_reuse_put_payload(vs_reuse *r, const vs_kind_info *info, const void *data) {
  for (size_t i = 0; i < info->field_count; i++) {
    const void *at = (const char *)data + info->fields[i].offset;
    size_t reals = vs_field_reals[info->fields[i].type];
    if (reals > 0) {
      put_few(r, at, reals);
      continue;
    }
    switch (info->fields[i].type) {
    /* the caller has already put these numeric fields into the key */
    case VS_FIELD_real: case VS_FIELD_point: case VS_FIELD_vector: case VS_FIELD_affine: break;
    case VS_FIELD_integer: vs_reuse_put(r, (uint64_t)(int64_t)*(const vs_field_integer *)at); break;
    case VS_FIELD_boolean: vs_reuse_put(r, *(const vs_field_boolean *)at); break;
    case VS_FIELD_points: {
      const vs_points *p = *(const vs_field_points *)at;
      vs_reuse_put(r, p->count);
      vs_reuse_put_reals(r, &p->at[0].x, 3 * (size_t)p->count);
      break;
    }
    case VS_FIELD_faces: {
      const vs_faces *f = *(const vs_field_faces *)at;
      vs_reuse_put(r, (uint64_t)f->count << 32 | f->corner_count);
      put_bytes(r, f->data, (f->count + 1 + (size_t)f->corner_count) * sizeof *f->data);
      break;
    }
    case VS_FIELD_text: vs_reuse_put(r, (uintptr_t)*(const vs_field_text *)at); break;
    case VS_FIELD_material: vs_reuse_put(r, (uintptr_t)*(const vs_field_material *)at); break;
    case VS_FIELD_ticket: r->unfit = true; break; /* A ticket is a number that the running program uses again for other
                                                   * objects, so it cannot identify an object later. Text that depends
                                                   * on a ticket is not cached. */
    }
  }
}

void vs_reuse_start(vs_reuse *r) {
  r->count = 0;
  r->hash = 1;
  r->unfit = false;
  r->run++;
  for (int kind = 0; kind < VS_NUMBER_KINDS; kind++) r->number_count[kind] = 0;
}

void vs_reuse_mix(vs_reuse *r, uint64_t hash) {
  r->hash = (r->hash ^ hash) * UINT64_C(0x9E3779B97F4A7C15);
  r->hash = (r->hash ^ r->hash >> 32) | 1;
}

void vs_reuse_put_number(vs_reuse *r, vs_number_kind kind, uint32_t number) {
  size_t had = r->local_room[kind], *count = &r->number_count[kind];
  if (!vs_reuse_more(r, &r->locals[kind], &r->local_room[kind], (size_t)number + 1, sizeof *r->locals[kind])) return;
  for (; had < r->local_room[kind]; had++) r->locals[kind][had].run = 0;
  vs_reuse_local *l = &r->locals[kind][number];
  if (l->run != r->run) {
    if (!vs_reuse_more(r, &r->numbers[kind], &r->number_room[kind], *count + 1, sizeof *r->numbers[kind])) return;
    *l = (vs_reuse_local){ r->run, (uint32_t)*count };
    r->numbers[kind][(*count)++] = number;
  }
  vs_reuse_put(r, l->local);
}

/* ---- the layout of a cached text: a header, the text, the positions of numbers in it, lines, warnings; each aligned
 * to 16 bytes (cache.c) ---- */

typedef struct { uint64_t size, slots, lines, said, triangles; } header;

static size_t padded(uint64_t size) { return (size_t)(size + 15) & ~(size_t)15; }

bool vs_reuse_find(vs_reuse *r, vs_reused *out) {
  const vs_cached *held =
      r->unfit ? NULL : vs_cache_find(r->cache, &(vs_cache_key){ VS_CACHED_TEXT, NULL, r->words, r->count, r->hash });
  if (held == NULL) return false;
  header h;
  memcpy(&h, held->data, sizeof h);
  const char *at = (const char *)held->data + padded(sizeof h);
  *out = (vs_reused){
    .held = held, .text = at, .size = (size_t)h.size, .slot_count = (size_t)h.slots, .triangles = (size_t)h.triangles
  };
  out->slots = (const uint64_t *)(const void *)(at += padded(h.size));
  at += padded(h.slots * sizeof *out->slots);
  out->lines = (const vs_reuse_line *)(const void *)at;
  out->line_count = (size_t)h.lines;
  out->said = (const char *const *)(const void *)(at + padded(h.lines * sizeof *out->lines));
  out->said_count = (size_t)h.said;
  return true;
}

bool vs_reuse_put_out(const vs_reuse *r, const vs_reused *found, vs_writer *w) {
  size_t at = 0;
  for (size_t i = 0; i < found->slot_count; i++) {
    uint64_t slot = found->slots[i];
    size_t place = (size_t)(slot >> 32);
    vs_put(w, found->text + at, place - at);
    vs_put_u32(w, r->numbers[slot & 1][slot >> 8 & 0xffffff]);
    at = place + (slot >> 1 & 0x7f);
  }
  return vs_put(w, found->text + at, found->size - at);
}

static void catch_part(void *context, const void *bytes, size_t count) {
  vs_reuse *r = context;
  if (r->unfit) return;
  r->unfit = count > MOST_TEXT || r->caught_count > MOST_TEXT - count;
  if (r->unfit || !vs_reuse_more(r, &r->caught, &r->caught_room, r->caught_count + count, 1)) return;
  memcpy(r->caught + r->caught_count, bytes, count);
  r->caught_count += count;
}

void vs_reuse_begin(vs_reuse *r, vs_writer *w) {
  r->open = true;
  r->from = w->bytes;
  r->caught_count = r->said_count = r->slot_count = 0;
  w->tap = catch_part;
  w->tap_context = r;
  w->tap_from = w->used;
}

void vs_reuse_numbered(vs_reuse *r, const vs_writer *w, vs_number_kind kind, uint32_t number) {
  if (!r->open || r->unfit) return;
  const vs_reuse_local *l = number < r->local_room[kind] ? &r->locals[kind][number] : NULL;
  uint64_t digits = 1;
  for (uint32_t n = number; n >= 10; n /= 10) digits++;
  r->unfit = l == NULL || l->run != r->run || l->local > 0xffffff || w->bytes - r->from > MOST_TEXT;
  if (!r->unfit && vs_reuse_more(r, &r->slots, &r->slot_room, r->slot_count + 1, sizeof *r->slots))
    r->slots[r->slot_count++] = (w->bytes - r->from) << 32 | (uint64_t)l->local << 8 | digits << 1 | kind;
}

void vs_reuse_warned(vs_reuse *r, const char *message) {
  if (!r->open || r->unfit) return;
  for (size_t i = 0; i < r->said_count; i++)
    if (r->said[i] == message) return;
  if (vs_reuse_more(r, &r->said, &r->said_room, r->said_count + 1, sizeof *r->said)) r->said[r->said_count++] = message;
}

void vs_reuse_end(vs_reuse *r, vs_writer *w, const vs_reuse_line *lines, size_t line_count) {
  r->open = false;
  w->tap = NULL;
  if (r->unfit || w->failed || w->bytes - r->from < LEAST_TEXT || !vs_cache_keeps(r->cache)) return;
  const char *text = w->buffer + w->tap_from;
  if (r->caught_count > 0) {
    catch_part(r, text, w->used - w->tap_from);
    text = r->caught;
    if (r->unfit) return;
  }
  header h = { w->bytes - r->from, r->slot_count, line_count, r->said_count, r->triangles };
  const vs_cache_piece pieces[] = { { &h, sizeof h },
                                    { text, (size_t)h.size },
                                    { r->slots, r->slot_count * sizeof *r->slots },
                                    { lines, line_count * sizeof *lines },
                                    { r->said, r->said_count * sizeof *r->said } };
  vs_cache_let_go(r->cache,
                  vs_cache_keep(r->cache, &(vs_cache_key){ VS_CACHED_TEXT, NULL, r->words, r->count, r->hash }, pieces,
                                sizeof pieces / sizeof *pieces));
}

void vs_reuse_free(vs_reuse *r) {
  vs_store_realloc(r->store, r->words, r->room * sizeof *r->words, 0);
  vs_store_realloc(r->store, r->caught, r->caught_room, 0);
  for (int kind = 0; kind < VS_NUMBER_KINDS; kind++) {
    vs_store_realloc(r->store, r->numbers[kind], r->number_room[kind] * sizeof *r->numbers[kind], 0);
    vs_store_realloc(r->store, r->locals[kind], r->local_room[kind] * sizeof *r->locals[kind], 0);
  }
  vs_store_realloc(r->store, r->slots, r->slot_room * sizeof *r->slots, 0);
  vs_store_realloc(r->store, r->said, r->said_room * sizeof *r->said, 0);
  *r = (vs_reuse){ .store = r->store };
}
