/* Finds repeated stretches in a drawing of very many shapes. Generated facades and streets are often one long union.
 *
 * All objects that the drawing places directly, forms and uses of templates, are treated as a row of letters. A letter
 * has a name and a place. Objects that differ only in their places have the same name. The row is divided into blocks.
 * Each block is a letter of the next row, whose name depends on the block's letters and their relative places.
 * Therefore stretches of the drawing that differ only in their places get equal names. Only nearby letters determine
 * where a block ends, so that equal stretches are divided equally: a block ends at the least of several hashes, and
 * sequences of equal letters are divided into pairs. After ten or twenty rows one letter remains.
 *
 * A letter that occurs twice can be a template, whose triangles the file contains once. A template saves text, but
 * costs a Shape for each use. Viewers open and draw a Shape about as slowly as VS_X3D_SHAPE_BYTES of triangles. The row
 * with the least cost is used. All rows together are a few times as long as the first row. */
#include "backends/x3d/repeats.h"

#include <math.h>
#include <string.h>

#include "backends/x3d/bake.h"
#include "backends/x3d/x3d_collect.h"
#include "model/store/hashes.h"

enum { REPEAT_BLOCK = 8 }; /* greatest number of letters (elements of a row) in a block */

typedef struct {
  uint32_t name;
  uint32_t first, count; /* the letter represents these objects of the first row: index of the first, and their
                          * number */
  uint64_t paints;       /* set of the letter's paints: bit p is the paint with number p modulo 64 */
  double bytes;          /* number of bytes of the letter's triangles, if it is a template */
  double loose;          /* cost of the letter without a template, in bytes of triangles. A use of a template costs the
                          * bytes of its triangles or of its Shapes, whichever is less */
  vs_vec3 at;
} repeat_letter;

/* A name of letters: its first occurrence and the number of its occurrences. */
typedef struct {
  uint64_t hash;
  uint32_t block, count;
} repeat_name;

typedef struct {
  vs_emitter *e;
  repeat_letter *row;
  size_t count, room; /* count: number of letters in the row; room: number of letters in the first row */
  uint32_t *blocks;   /* blocks[k]: beginning of block k of the row; the last item is the row's end */
  size_t block_count;
  uint64_t *hashes; /* hash of each letter together with the vector from it to the next letter */
  repeat_name *names;
  size_t name_count;
  uint32_t *table;   /* hash table with open addressing; an entry is a name + 1 */
  size_t table_room; /* size of the table, a power of two */
  double steps;      /* number of steps in a model unit; places are rounded to whole steps before they are compared */
} repeats;

/* ---- comparing objects regardless of their places ---- */

/* Returns x in whole steps. The limits between steps lie at uneven numbers, so that a small rounding error of a round
 * number does not change the result. */
static int64_t repeat_steps(const repeats *r, double x) { return (int64_t)floor(x * r->steps + 0.38196601125); }

static bool repeat_same_way(const repeats *r, vs_vec3 a, vs_vec3 b) {
  return repeat_steps(r, a.x) == repeat_steps(r, b.x) && repeat_steps(r, a.y) == repeat_steps(r, b.y) &&
         repeat_steps(r, a.z) == repeat_steps(r, b.z);
}

static uint64_t repeat_hash_way(const repeats *r, uint64_t h, vs_vec3 v) {
  h = vs_hash_mix(h, (uint64_t)repeat_steps(r, v.x));
  h = vs_hash_mix(h, (uint64_t)repeat_steps(r, v.y));
  return vs_hash_mix(h, (uint64_t)repeat_steps(r, v.z));
}

/* Returns the vector from letter i to the next letter. */
static vs_vec3 repeat_way(const repeats *r, size_t i) { return vs_v3_sub(r->row[i + 1].at, r->row[i].at); }

/* ---- the first row ---- */

/* Returns the place of object i, a form or a use. Sets *what to a number for its shape and paint. The uses follow the
 * forms. */
static vs_affine repeat_thing(const repeats *r, size_t i, uint64_t *what) {
  const vs_x3d *x = r->e->state;
  const vs_x3d_group *g = &x->groups[0];
  if (i >= g->item_count) {
    const vs_x3d_placed *use = &g->uses[i - g->item_count];
    *what = ((uint64_t)use->group + 16) << 32 | use->paint;
    return use->placement;
  }
  const vs_x3d_item *item = &g->items[i];
  vs_x3d_form form = item->form;
  vs_affine place = vs_affine_identity();
  vs_x3d_form_of(r->e, item->ref.node, &form, &place); /* this is true, because the item was a form when it was
                                                        * collected */
  *what = (uint64_t)form << 32 | item->paint;
  return vs_affine_multiply(&item->placement, &place);
}

static bool repeat_same_thing(const repeats *r, size_t a, size_t b) {
  uint64_t what_a, what_b;
  vs_affine at_a = repeat_thing(r, a, &what_a), at_b = repeat_thing(r, b, &what_b);
  bool same = what_a == what_b;
  for (int k = 0; k < 3 && same; k++) same = repeat_same_way(r, vs_affine_column(&at_a, k), vs_affine_column(&at_b, k));
  return same;
}

static bool repeat_same_block(const repeats *r, size_t a, size_t b) {
  size_t from = r->blocks[a], other = r->blocks[b], count = r->blocks[a + 1] - from;
  if (r->blocks[b + 1] - other != count) return false;
  for (size_t i = 0; i < count; i++)
    if (r->row[from + i].name != r->row[other + i].name ||
        (i + 1 < count && !repeat_same_way(r, repeat_way(r, from + i), repeat_way(r, other + i))))
      return false;
  return true;
}

/* ---- names ---- */

/* Returns the name of a block of letters (in the first row: of an object), and counts its occurrences. */
static uint32_t repeat_name_of(repeats *r, size_t block, uint64_t hash, bool things) {
  size_t slot = hash & (r->table_room - 1);
  for (; r->table[slot] != 0; slot = (slot + 1) & (r->table_room - 1)) {
    repeat_name *n = &r->names[r->table[slot] - 1];
    if (n->hash != hash || !(things ? repeat_same_thing(r, n->block, block) : repeat_same_block(r, n->block, block)))
      continue;
    n->count++;
    return r->table[slot] - 1;
  }
  r->names[r->name_count++] = (repeat_name){ hash, (uint32_t)block, 1 };
  r->table[slot] = (uint32_t)r->name_count;
  return (uint32_t)r->name_count - 1;
}

static void repeat_forget_names(repeats *r) {
  r->name_count = 0;
  memset(r->table, 0, r->table_room * sizeof *r->table);
}

static uint64_t repeat_paint_bit(uint32_t paint) { return (uint64_t)1 << (paint & 63); }

static double repeat_shapes(const repeat_letter *l) {
  double n = 0;
  for (uint64_t p = l->paints; p != 0; p &= p - 1) n++;
  return n;
}

/* Computes the bytes of each template's triangles and its paints. Templates use only earlier templates. */
static void repeat_templates(vs_emitter *e, double *bytes, uint64_t *paints) {
  const vs_x3d *x = e->state;
  for (size_t k = 1; k < x->group_count; k++) {
    const vs_x3d_group *g = &x->groups[k];
    bytes[k] = vs_x3d_batch_bytes(x, g);
    paints[k] = 0;
    for (size_t i = 0; g->batches != NULL && i < x->batch_count; i++)
      if (g->batches[i].triangle_count + g->batches[i].point_count > 0) paints[k] |= repeat_paint_bit((uint32_t)i);
    for (size_t i = 0; i < g->item_count; i++) {
      bytes[k] += vs_x3d_form_bytes(g->items[i].form, vs_x3d_facets(e, &g->items[i], 0));
      paints[k] |= repeat_paint_bit(g->items[i].paint);
    }
    for (size_t i = 0; i < g->use_count; i++) {
      bytes[k] += bytes[g->uses[i].group];
      paints[k] |= paints[g->uses[i].group];
    }
  }
}

static bool repeat_first_row(repeats *r, const double *bytes, const uint64_t *paints) {
  const vs_x3d *x = r->e->state;
  const vs_x3d_group *g = &x->groups[0];
  for (size_t i = 0; i < r->count; i++) {
    uint64_t what;
    if ((i & 0xfff) == 0 && !vs_emit_progress(r->e, "meshing", -1)) return false;
    vs_affine at = repeat_thing(r, i, &what);
    uint64_t hash = vs_hash_mix(1, what);
    for (int k = 0; k < 3; k++) hash = repeat_hash_way(r, hash, vs_affine_column(&at, k));
    repeat_letter *l = &r->row[i];
    *l = (repeat_letter){
      .name = repeat_name_of(r, i, hash, true), .first = (uint32_t)i, .count = 1, .at = vs_affine_column(&at, 3)
    };
    if (i >= g->item_count) {
      l->bytes = bytes[g->uses[i - g->item_count].group];
      l->paints = paints[g->uses[i - g->item_count].group];
      l->loose = fmin(l->bytes, VS_X3D_SHAPE_BYTES * repeat_shapes(l));
    } else {
      l->bytes = l->loose = vs_x3d_form_bytes(g->items[i].form, vs_x3d_facets(r->e, &g->items[i], 0));
      l->paints = repeat_paint_bit(g->items[i].paint);
    }
  }
  return true;
}

/* ---- the next row ---- */

static void repeat_hash_letters(repeats *r) {
  for (size_t i = 0; i < r->count; i++) {
    uint64_t h = vs_hash_mix(2, r->row[i].name);
    r->hashes[i] = i + 1 < r->count ? repeat_hash_way(r, h, repeat_way(r, i)) : h;
  }
}

/* Divides the row into blocks and stores the beginnings of the blocks. */
static void repeat_cut(repeats *r) {
  const uint64_t *h = r->hashes;
  r->block_count = 0;
  for (size_t i = 0; i < r->count;) {
    size_t end = i + 1;
    while (end < r->count && h[end] == h[i]) end++;
    r->blocks[r->block_count++] = (uint32_t)i;
    if (end - i > 1) {
      for (i += 2; i < end; i += 2) r->blocks[r->block_count++] = (uint32_t)i;
      if (i > end) i = end;
      continue;
    }
    for (i++; i < r->count && i - r->blocks[r->block_count - 1] < REPEAT_BLOCK; i++) {
      bool run = i + 1 < r->count && h[i] == h[i + 1], least = i + 1 < r->count && h[i] < h[i - 1] && h[i] < h[i + 1];
      if (run || least) break;
    }
  }
  r->blocks[r->block_count] = (uint32_t)r->count;
}

static bool repeat_next_row(repeats *r) {
  repeat_hash_letters(r);
  repeat_cut(r);
  repeat_forget_names(r);
  for (size_t k = 0; k < r->block_count; k++) {
    uint64_t hash = 3;
    if ((k & 0xfff) == 0 && !vs_emit_progress(r->e, "meshing", -1)) return false;
    for (size_t i = r->blocks[k]; i < r->blocks[k + 1]; i++) {
      hash = vs_hash_mix(hash, r->row[i].name);
      if (i + 1 < r->blocks[k + 1]) hash = repeat_hash_way(r, hash, repeat_way(r, i));
    }
    r->hashes[k] =
        repeat_name_of(r, k, hash, false); /* the hash of block k overwrites an earlier letter's hash, which is no
                                            * longer needed: each block has at least one letter */
  }
  for (size_t k = 0; k < r->block_count; k++) {
    repeat_letter l = r->row[r->blocks[k]];
    l.name = (uint32_t)r->hashes[k];
    for (size_t i = r->blocks[k] + 1; i < r->blocks[k + 1]; i++) {
      l.count += r->row[i].count;
      l.bytes += r->row[i].bytes;
      l.loose += r->row[i].loose;
      l.paints |= r->row[i].paints;
    }
    r->row[k] = l;
  }
  r->count = r->block_count;
  return true;
}

/* ---- costs ---- */

/* Returns true if the letter costs less as a template than without a template. */
static bool repeat_pays(const repeats *r, const repeat_letter *l) {
  double uses = r->names[l->name].count;
  return uses > 1 && l->bytes + uses * VS_X3D_SHAPE_BYTES * repeat_shapes(l) < uses * l->loose;
}

static double repeat_cost(const repeats *r) {
  double cost = 0;
  for (size_t i = 0; i < r->count; i++) {
    const repeat_letter *l = &r->row[i];
    cost += repeat_pays(r, l) ? VS_X3D_SHAPE_BYTES * repeat_shapes(l) + l->bytes / r->names[l->name].count : l->loose;
  }
  return cost;
}

/* ---- templates ---- */

/* Makes a template of a letter's objects, with the letter's place as origin of its coordinates. */
static bool repeat_define(repeats *r, const repeat_letter *l) {
  vs_emitter *e = r->e;
  vs_x3d *x = e->state;
  vs_affine home = vs_affine_translation(vs_v3_scale(l->at, -1));
  if (!vs_emit_grow(e, &x->groups, &x->group_room, x->group_count + 1, sizeof *x->groups)) return false;
  vs_x3d_group *to = &x->groups[x->group_count++];
  const vs_x3d_group *g = &x->groups[0];
  *to = (vs_x3d_group){ .bare = true };
  for (size_t i = l->first; i < l->first + l->count; i++)
    if (i < g->item_count) {
      if (!vs_emit_grow(e, &to->items, &to->item_room, to->item_count + 1, sizeof *to->items)) return false;
      to->items[to->item_count] = g->items[i];
      to->items[to->item_count++].placement = vs_affine_multiply(&home, &g->items[i].placement);
    } else {
      const vs_x3d_placed *use = &g->uses[i - g->item_count];
      if (!vs_emit_grow(e, &to->uses, &to->use_room, to->use_count + 1, sizeof *to->uses)) return false;
      to->uses[to->use_count++] = (vs_x3d_placed){ use->group, use->paint, vs_affine_multiply(&home, &use->placement) };
    }
  return true;
}

/* Makes templates of the row's letters that cost less as templates, and uses in place of their objects. All other
 * objects remain unchanged. */
static bool repeat_take(repeats *r) {
  vs_emitter *e = r->e;
  vs_x3d *x = e->state;
  vs_x3d_placed *uses = NULL;
  size_t use_count = 0, use_room = 0, kept_items = 0, first_group = x->group_count, most = x->groups[0].use_count;
  bool ok = true;
  memset(r->table, 0, r->table_room * sizeof *r->table); /* from this point, the table maps a name to its template */
  for (size_t k = 0; k < r->count && ok; k++) {
    const repeat_letter *l = &r->row[k];
    bool pays = repeat_pays(r, l);
    if (pays && r->table[l->name] == 0) {
      ok = repeat_define(r, l);
      r->table[l->name] = (uint32_t)(x->group_count - 1);
    }
    ok = ok &&
         vs_emit_grow(e, &uses, &use_room, use_count + 1 + most, sizeof *uses); /* the array has room for all uses that
                                                                                 * existed before */
    if (ok && pays) uses[use_count++] = (vs_x3d_placed){ r->table[l->name], 0, vs_affine_translation(l->at) };
    r->row[k].name = pays ? 1 : 0;
  }
  vs_x3d_group *g = &x->groups[0];
  if (ok && x->group_count > first_group) {
    for (size_t k = 0; k < r->count; k++)
      for (size_t i = r->row[k].first; r->row[k].name == 0 && i < r->row[k].first + r->row[k].count; i++)
        if (i < g->item_count)
          g->items[kept_items++] = g->items[i];
        else
          uses[use_count++] = g->uses[i - g->item_count];
    g->item_count = kept_items;
    vs_emit_release(e, g->uses, g->use_room, sizeof *g->uses);
    g->uses = uses;
    g->use_count = use_count;
    g->use_room = use_room;
  } else {
    vs_emit_release(e, uses, use_room, sizeof *uses);
  }
  return ok;
}

/* ---- the search ---- */

/* Makes row `number` of letters, counted from 0. */
static bool repeat_row(repeats *r, size_t number, const double *bytes, const uint64_t *paints) {
  const vs_x3d *x = r->e->state;
  repeat_forget_names(r);
  r->count = x->groups[0].item_count + x->groups[0].use_count;
  if (!repeat_first_row(r, bytes, paints)) return false;
  for (size_t k = 0; k < number; k++)
    if (!repeat_next_row(r)) return false;
  return true;
}

static bool repeat_search(repeats *r, const double *bytes, const uint64_t *paints) {
  size_t best = 0, number = 0;
  if (!repeat_row(r, 0, bytes, paints)) return false;
  double least = repeat_cost(r);
  for (size_t before = r->count + 1; r->count > 1 && r->count < before;) {
    before = r->count;
    if (!repeat_next_row(r)) return false;
    number++;
    double cost = repeat_cost(r);
    if (cost < least) {
      least = cost;
      best = number;
    }
  }
  return repeat_row(r, best, bytes, paints) && repeat_take(r);
}

bool vs_x3d_repeats(vs_emitter *e) {
  vs_x3d *x = e->state;
  vs_store *store = e->scene->store;
  size_t count = x->groups[0].item_count + x->groups[0].use_count, groups = x->group_count;
  double diagonal = vs_v3_length(vs_v3_sub(e->bounds.max, e->bounds.min));
  if (count < 2 || count > UINT32_MAX / 4 || !(diagonal > 0)) return true;
  repeats r = { .e = e, .room = count, .table_room = 16, .steps = ldexp(1, 40) / diagonal };
  while (r.table_room < 2 * count) r.table_room *= 2;
  r.row = vs_store_realloc(store, NULL, 0, count * sizeof *r.row);
  r.blocks = vs_store_realloc(store, NULL, 0, (count + 1) * sizeof *r.blocks);
  r.hashes = vs_store_realloc(store, NULL, 0, count * sizeof *r.hashes);
  r.names = vs_store_realloc(store, NULL, 0, count * sizeof *r.names);
  r.table = vs_store_realloc(store, NULL, 0, r.table_room * sizeof *r.table);
  double *bytes = vs_store_realloc(store, NULL, 0, groups * sizeof *bytes);
  uint64_t *paints = vs_store_realloc(store, NULL, 0, groups * sizeof *paints);
  bool ok = (r.row != NULL && r.blocks != NULL && r.hashes != NULL && r.names != NULL && r.table != NULL &&
             bytes != NULL && paints != NULL) ||
            vs_emit_no_memory(e);
  if (ok) {
    repeat_templates(e, bytes, paints);
    ok = repeat_search(&r, bytes, paints);
  }
  vs_emit_release(e, r.row, count, sizeof *r.row);
  vs_emit_release(e, r.blocks, count + 1, sizeof *r.blocks);
  vs_emit_release(e, r.hashes, count, sizeof *r.hashes);
  vs_emit_release(e, r.names, count, sizeof *r.names);
  vs_emit_release(e, r.table, r.table_room, sizeof *r.table);
  vs_emit_release(e, bytes, groups, sizeof *bytes);
  vs_emit_release(e, paints, groups, sizeof *paints);
  return ok;
}
