/* Implements the world cache (cache.h): a hash table with chains, and a list of its entries by last use. */
#include "model/store/cache.h"

#include <string.h>

#include "model/store/nodemap.h"
#include "model/store/store_inside.h"

typedef struct entry entry;
struct entry {
  vs_cached result; /* must be the first member, because callers hold the address of the result instead of the
                     * entry's */
  entry *chain;     /* next entry in the same bucket of the hash table */
  entry *newer, *older;
  uint64_t hash, turn;
  size_t holders;
  size_t own, bytes; /* own: bytes of this entry itself; bytes: `own` plus the bytes of the node in its key */
  vs_node *node;     /* node of the key, to which the entry holds a reference; may be NULL */
  size_t count;
  uint32_t kind;
  _Alignas(16) unsigned char block[]; /* the words of the key, followed by the bytes of the result */
};

struct vs_cache {
  vs_store *store;
  entry **buckets;
  size_t room; /* number of buckets of the hash table, a power of two */
  entry *newest, *oldest;
  size_t limit;
  uint64_t turn, serial;
  bool keeps, busy; /* keeps: true if new results are kept in this turn; busy: true while the hash table or an entry is
                     * being allocated, when no entry may be dropped */
  vs_cache_stats stats;
};

enum { FEW = 64, LEAST = 64 };

vs_cache *vs_store_cache(const vs_store *s) { return s->cache; }

vs_cache *vs_cache_new(vs_store *s, size_t limit) {
  vs_cache *c = vs_store_realloc(s, NULL, 0, sizeof *c);
  if (!c) return NULL;
  *c = (vs_cache){ .store = s, .limit = limit, .keeps = true };
  s->cache = c;
  return c;
}

static void unlink_use(vs_cache *c, entry *e) {
  *(e->newer ? &e->newer->older : &c->newest) = e->older;
  *(e->older ? &e->older->newer : &c->oldest) = e->newer;
}

static void link_newest(vs_cache *c, entry *e) {
  e->newer = NULL;
  e->older = c->newest;
  *(c->newest ? &c->newest->newer : &c->oldest) = e;
  c->newest = e;
}

/* Removes entry e from the cache and frees it. No caller holds its result. */
static void drop(vs_cache *c, entry *e) {
  entry **at = &c->buckets[e->hash & (c->room - 1)];
  VS_ASSERT(e->holders == 0);
  while (*at != e) at = &(*at)->chain;
  *at = e->chain;
  unlink_use(c, e);
  c->stats.entries--;
  c->stats.bytes -= e->bytes;
  vs_node *node = e->node;
  vs_store_realloc(c->store, e, e->own, 0);
  vs_node_release(node);
}

void vs_cache_free(vs_cache *c) {
  if (!c) return;
  while (c->oldest) drop(c, c->oldest);
  c->store->cache = NULL;
  vs_store_realloc(c->store, c->buckets, c->room * sizeof *c->buckets, 0);
  vs_store_realloc(c->store, c, sizeof *c, 0);
}

void vs_cache_turn(vs_cache *c, bool keeps) {
  if (!c) return;
  c->turn++;
  c->keeps = keeps;
}

bool vs_cache_keeps(const vs_cache *c) { return c && c->keeps && c->limit > 0; }
bool vs_cache_asks(const vs_cache *c) { return c && (c->stats.entries > 0 || vs_cache_keeps(c)); }

static uint64_t hash_of(const vs_cache_key *k) {
  uint64_t h = vs_hash_mix(k->kind, k->node ? k->node->hash : 0);
  if (k->hash) return vs_hash_mix(h, k->hash);
  return k->count ? vs_hash_bytes(h, k->words, k->count * sizeof *k->words) : h;
}

static bool same(const entry *e, uint64_t hash, const vs_cache_key *k) {
  if (e->hash != hash || e->kind != k->kind || e->count != k->count || !e->node != !k->node) return false;
  if (k->count && memcmp(e->block, k->words, k->count * sizeof *k->words) != 0) return false;
  /* when memory is out, nodes count as different, so that the result is computed again */
  return e->node == k->node || (e->node->hash == k->node->hash && vs_node_equal(e->node, k->node, NULL));
}

const vs_cached *vs_cache_find(vs_cache *c, const vs_cache_key *key) {
  if (!vs_cache_asks(c)) return NULL;
  uint64_t hash = hash_of(key);
  entry *e = c->room ? c->buckets[hash & (c->room - 1)] : NULL;
  c->busy = true; /* Comparing nodes may allocate memory, which may drop entries. `busy` prevents this. */
  while (e && !same(e, hash, key)) e = e->chain;
  c->busy = false;
  if (!e) return c->stats.misses[key->kind]++, NULL;
  c->stats.hits[key->kind]++;
  unlink_use(c, e);
  link_newest(c, e);
  e->turn = c->turn;
  e->holders++;
  return &e->result;
}

void vs_cache_let_go(vs_cache *c, const vs_cached *held) {
  (void)c;
  if (held) ((entry *)(uintptr_t)held)->holders--;
}

bool vs_cache_shrink(vs_cache *c, size_t bytes) {
  size_t before = c ? c->stats.bytes : 0;
  if (!c || c->busy) return false;
  for (entry *e = c->oldest, *next; e && before - c->stats.bytes < bytes; e = next) {
    next = e->newer;
    if (e->holders) continue;
    drop(c, e);
    c->stats.evicted++;
  }
  return c->stats.bytes < before;
}

/* Makes room for more bytes: drops entries whose last use was in an earlier turn. Returns false if these do not free
 * enough. */
static bool make_room(vs_cache *c, size_t bytes) {
  if (bytes > c->limit / 2) return false;
  for (entry *e = c->oldest, *next; e && c->stats.bytes > c->limit - bytes; e = next) {
    next = e->newer;
    if (e->turn == c->turn) break; /* The list is sorted by last use, so all later entries were also used in this turn,
                                    * and stay. */
    if (e->holders) continue;
    drop(c, e);
    c->stats.evicted++;
  }
  return c->stats.bytes <= c->limit - bytes;
}

/* Sums the bytes of the node and its descendants, including nodes that have other references. Returns false if the sum
 * exceeds `most`, or memory is out. */
static bool node_bytes(vs_node *n, size_t most, size_t *bytes) {
  *bytes = 0;
  if (!n) return true;
  if (!n->child_count) return *bytes = vs_node_bytes(n), true;
  vs_nodemap seen = { .store = n->store };
  vs_node **stack = NULL;
  size_t count = 0, room = 0;
  bool ok = vs_nodemap_put(&seen, n, NULL) != NULL;
  for (vs_node *at = n; ok; at = stack[--count]) {
    *bytes += vs_node_bytes(at);
    if (*bytes > most) ok = false;
    for (uint32_t i = 0; ok && i < at->child_count; i++) {
      bool found;
      ok = vs_nodemap_put(&seen, at->children[i].node, &found) != NULL;
      if (!ok || found) continue;
      if (count == room) {
        size_t more = room ? 2 * room : FEW;
        vs_node **grown = vs_store_realloc(n->store, stack, room * sizeof *stack, more * sizeof *stack);
        if (!grown) { ok = false; break; }
        stack = grown, room = more;
      }
      stack[count++] = at->children[i].node;
    }
    if (!count) break;
  }
  vs_store_realloc(n->store, stack, room * sizeof *stack, 0);
  vs_nodemap_free(&seen);
  return ok;
}

static bool grow(vs_cache *c) {
  if (c->stats.entries < c->room) return true;
  size_t room = c->room ? c->room * 2 : LEAST;
  entry **grown = vs_store_realloc(c->store, NULL, 0, room * sizeof *grown);
  if (!grown) return c->room > 0; /* if memory is out, the hash table keeps its size, and the lists in its buckets
                                   * become longer */
  memset(grown, 0, room * sizeof *grown);
  for (entry *e = c->oldest; e; e = e->newer) {
    e->chain = grown[e->hash & (room - 1)];
    grown[e->hash & (room - 1)] = e;
  }
  vs_store_realloc(c->store, c->buckets, c->room * sizeof *grown, 0);
  c->buckets = grown;
  c->room = room;
  return true;
}

static entry *keep(vs_cache *c, const vs_cache_key *key, const vs_cache_piece *pieces, size_t count) {
  size_t size = 0, words = (key->count * sizeof *key->words + 15) & ~(size_t)15, held;
  for (size_t i = 0; i < count; i++) size += (pieces[i].size + 15) & ~(size_t)15;
  size_t own = sizeof(entry) + words + size;
  /* A ticket belongs to one program, and the cache outlives programs: nodes with tickets are not cached. */
  if (key->node && key->node->flags & VS_NODE_SUGAR) return NULL;
  if (own > c->limit / 2 || !node_bytes(key->node, c->limit / 2, &held) || !make_room(c, own + held) || !grow(c))
    return NULL;
  entry *e = vs_store_realloc(c->store, NULL, 0, own);
  if (!e) return NULL;
  *e = (entry){ .hash = hash_of(key),
                .turn = c->turn,
                .holders = 1,
                .own = own,
                .bytes = own + held,
                .node = key->node,
                .count = key->count,
                .kind = key->kind };
  e->result = (vs_cached){ ++c->serial, e->block + words, size };
  if (e->node) vs_node_retain(e->node);
  if (key->count) memcpy(e->block, key->words, key->count * sizeof *key->words);
  unsigned char *to = e->block + words;
  for (size_t i = 0; i < count; i++) {
    if (pieces[i].size) memcpy(to, pieces[i].at, pieces[i].size);
    to += (pieces[i].size + 15) & ~(size_t)15;
  }
  return e;
}

const vs_cached *vs_cache_keep(vs_cache *c, const vs_cache_key *key, const vs_cache_piece *pieces, size_t count) {
  if (!vs_cache_keeps(c)) return NULL;
  c->busy = true; /* The allocation of the new entry may drop entries, and change the hash table at the place that was
                   * found. `busy` prevents this. */
  entry *e = keep(c, key, pieces, count);
  c->busy = false;
  if (!e) return c->stats.refused++, NULL;
  entry **bucket = &c->buckets[e->hash & (c->room - 1)];
  e->chain = *bucket;
  *bucket = e;
  link_newest(c, e);
  c->stats.entries++;
  c->stats.bytes += e->bytes;
  if (c->stats.bytes > c->stats.peak) c->stats.peak = c->stats.bytes;
  return &e->result;
}

vs_cache_stats vs_cache_count(const vs_cache *c) { return c ? c->stats : (vs_cache_stats){ .entries = 0 }; }
