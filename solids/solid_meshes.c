/* Converts a model's nodes to a problem for the kernel.
 *
 * Every path of the DAG gives separate terms. A mesh is made once for each distinct primitive (equal values, equal
 * facets). The same mesh at the same place with the same paint is a single leaf, however often the expression contains
 * it. The walk keeps its own stack, because a model may be hundreds of thousands of levels deep. */
#include "solids/solid_meshes.h"
#include "geometry/tessellate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/primitives/solid_triangles.h"
#include "kernel/memory.h"
#include "kernel/threads.h"
#include "solids/primitive_meshes.h"
#include "model/store/array.h"
#include "model/store/cache.h"
#include "model/job.h"
#include "model/walk.h"

enum { NO_OBJECTS = -1 };

typedef struct {
  vs_affine placement;
  const vs_material *material;
  const char *layer; /* name of the layer around this level of the walk, interned in the nodes' store */
  size_t first;    /* index in `pending` of the first operand of the operation that this level of the walk has
                    * entered */
  bool difference; /* true if this level of the walk is a difference, which subtracts all its operands except the
                    * first */
  bool off;        /* true if solids at this level of the walk are subtracted from the result */
  uint32_t scope;  /* Number of this level's scope: the innermost operation around it whose bounds are finite.
                    * Half-spaces have no effect outside of these bounds. 0: the entire drawing. */
  const vs_node *scope_node; /* node of this level's scope, the innermost bounded operation around it; NULL: the entire
                              * drawing */
  vs_affine local; /* map from the coordinates of this level of the walk to those of scope_node */
} level;
typedef struct {
  const vs_node *node;
  vs_fineness facets;
  vs_mesh *mesh;
  const vs_cached *held; /* cache entry that contains the arrays of the mesh; NULL if this structure owns them */
  size_t next;           /* index + 1 of the next mesh in the same bucket of the hash table; 0 if there is none */
  const vs_origin *origin;
  const vs_node *scope;  /* for the mesh of a half-space: node of its scope, whose bounds the mesh must cover */
  vs_affine local;       /* placement of the half-space in the coordinates of the node `scope` */
} meshed;
typedef struct { uint32_t leaf, scope; } scoped;

typedef struct {
  vs_kernel k;
  const vs_fineness *facets;
  vs_error *error;
  VS_LIST(vs_kernel_leaf) leaves;
  VS_LIST(const vs_origin *) origins; /* origins[i]: call in the user's text that made leaf i */
  VS_LIST(vs_kernel_term) terms;
  VS_LIST(uint32_t) operands;
  VS_LIST(uint32_t) pending;          /* numbers of the terms that will become operands of operations that the walk has
                                       * not completed */
  VS_LIST(level) levels;              /* stack of the walk: one level for each node on the path to the current node */
  VS_LIST(meshed) meshes;
  VS_LIST(vs_solid_part) parts;
  VS_LIST(uint32_t) paints;           /* paints[i]: first part with the same material and layer as part i */
  VS_LIST(uint32_t) part_table, paint_table; /* Hash tables of parts, and of parts by paint, with open addressing. An
                                              * element is the index of a part + 1; 0: the slot is free. */
  VS_LIST(vs_bounds) within;          /* within[i]: bounds within which leaf i can have an effect; the list is empty if
                                       * there are no half-spaces */
  VS_LIST(uint32_t) scopes;           /* scopes[i]: number of the next scope (bounded operation) around scope i */
  VS_LIST(scoped) scoped;             /* pairs of a leaf and its scope (innermost bounded operation around it), one for
                                       * each occurrence of the leaf */
  /* Hash table of meshes by their nodes' hashes. An element is the index of a mesh + 1; 0: the bucket is empty. The
   * size is a power of two, at least the number of meshes. */
  VS_LIST(size_t) buckets;
  VS_LIST(uint32_t) twins;            /* Hash table of leaves, by mesh, placement, paint and whether they are
                                       * subtracted; open addressing. An element is the index of a leaf + 1; 0: the slot
                                       * is free. */
  VS_LIST(uint8_t) off;               /* off[i]: 1 if leaf i is subtracted from the result */
  VS_LIST(uint32_t) mesh_numbers;     /* mesh_numbers[i]: index in `meshes` of the mesh of leaf i */
  VS_LIST(uint64_t) identities;       /* identities[i]: serial number of the mesh of leaf i; equal meshes have equal
                                       * numbers */
  VS_LIST(uint32_t) plain;            /* indices in `meshes` of the meshes that several threads make after the walk */
  _Atomic size_t made;                /* number of triangles of all meshes made so far */
  vs_cache *cache;                    /* cache of meshes; NULL if there is none */
  int depth;                          /* how many levels below a reference a node counts as an object
                                       * (vs_solid_of_objects); NO_OBJECTS: objects are not distinguished */
  uint32_t object;                    /* number of the object that contains the walk's current node; 0: none */
  bool own;                           /* true if each face is to belong to its primitive (vs_solid_of_leaves); the
                                       * member `object` of a part is then the number of the primitive's mesh */
} builder;

static bool full(builder *b) {
  return vs_kernel_fail(&b->k, VS_KERNEL_LIMIT, 0, "the model has too many parts to mesh");
}

static bool add_term(builder *b, vs_term_kind kind, uint32_t first, size_t count) {
  if (b->terms.count >= INT32_MAX) return full(b);
  return VS_PUSH(&b->k, b->terms, ((vs_kernel_term){ kind, first, (uint32_t)count })) &&
         VS_PUSH(&b->k, b->pending, (uint32_t)b->terms.count - 1);
}

/* Makes a term of this kind from the terms in `pending`, from index `first` on, which are its operands. The new term
 * replaces them in `pending`. Returns false on failure. */
static bool close_term(builder *b, vs_term_kind kind, size_t first) {
  size_t count = b->pending.count - first, at = b->operands.count;
  if (at + count >= UINT32_MAX) return full(b);
  for (size_t i = 0; i < count; i++)
    if (!VS_PUSH(&b->k, b->operands, b->pending.at[first + i])) return false;
  b->pending.count = first;
  return add_term(b, kind, (uint32_t)at, count);
}

static bool same_part(const vs_solid_part *a, const vs_solid_part *b, bool leaf) {
  return a->material == b->material && a->layer == b->layer && a->object == b->object &&
         (!leaf || a->leaf.origin == b->leaf.origin);
}

static size_t part_slot(const builder *b, const uint32_t *table, size_t count, const vs_solid_part *part, bool leaf) {
  uint64_t h = ((uint64_t)(uintptr_t)part->material >> 4) * 0x9e3779b97f4a7c15u +
               (leaf ? (uint64_t)(uintptr_t)part->leaf.origin >> 4 : 0) + part->object * 0x94d049bb133111ebu;
  h = (h ^ h >> 29) * 0xbf58476d1ce4e5b9u;
  size_t mask = count - 1, i = (size_t)(h >> 20) & mask;
  while (table[i] && !same_part(&b->parts.at[table[i] - 1], part, leaf)) i = (i + 1) & mask;
  return i;
}

static bool part_of(builder *b, const vs_solid_part *part, uint32_t *tag) {
  if (b->parts.count * 2 >= b->part_table.count) {
    size_t slots = b->part_table.count ? b->part_table.count * 2 : 64;
    if (!VS_ROOM(&b->k, b->part_table.at, b->part_table.room, slots) ||
        !VS_ROOM(&b->k, b->paint_table.at, b->paint_table.room, slots))
      return false;
    memset(b->part_table.at, 0, slots * sizeof(uint32_t));
    memset(b->paint_table.at, 0, slots * sizeof(uint32_t));
    b->part_table.count = slots;
    for (uint32_t i = 0; i < b->parts.count; i++) {
      b->part_table.at[part_slot(b, b->part_table.at, slots, &b->parts.at[i], true)] = i + 1;
      size_t paint = part_slot(b, b->paint_table.at, slots, &b->parts.at[i], false);
      if (!b->paint_table.at[paint]) b->paint_table.at[paint] = i + 1;
    }
  }
  size_t slot = part_slot(b, b->part_table.at, b->part_table.count, part, true),
         paint = part_slot(b, b->paint_table.at, b->part_table.count, part, false);
  if (!b->part_table.at[slot]) {
    if (!VS_PUSH(&b->k, b->parts, *part) || !VS_PUSH(&b->k, b->paints, 0u)) return false;
    b->part_table.at[slot] = (uint32_t)b->parts.count;
    if (!b->paint_table.at[paint]) b->paint_table.at[paint] = (uint32_t)b->parts.count;
    b->paints.at[b->parts.count - 1] = b->paint_table.at[paint] - 1;
  }
  *tag = b->part_table.at[slot] - 1;
  return true;
}

static bool same_place(const vs_affine *a, const vs_affine *b) {
  for (int i = 0; i < 12; i++)
    if (a->m[i / 4][i % 4] != b->m[i / 4][i % 4]) return false;
  return true;
}

static size_t *bucket_of(const builder *b, const vs_node *node) {
  return &b->buckets.at[(node->hash ^ node->hash >> 32) & (b->buckets.count - 1)];
}

/* Doubles the hash table of meshes if it has no room for one more mesh. */
static bool buckets_grow(builder *b) {
  if (b->meshes.count < b->buckets.count) return true;
  size_t count = b->buckets.count ? 2 * b->buckets.count : 64;
  if (!VS_ROOM(&b->k, b->buckets.at, b->buckets.room, count)) return false;
  memset(b->buckets.at, 0, count * sizeof *b->buckets.at);
  b->buckets.count = count;
  for (size_t i = 0; i < b->meshes.count; i++) {
    size_t *bucket = bucket_of(b, b->meshes.at[i].node);
    b->meshes.at[i].next = *bucket;
    *bucket = i + 1;
  }
  return true;
}

/* Adds the triangles of a mesh to *made, the sum over all shapes, and checks the limit. Counts cached meshes, too, so
 * that earlier runs do not affect whether the limit is exceeded. Returns false if it is. */
static bool count_made(vs_kernel *k, _Atomic size_t *made, size_t triangles) {
  size_t limit = k->options->max_triangles, all = atomic_fetch_add(made, triangles) + triangles;
  return !limit || all <= limit * VS_ON_THE_WAY ||
         vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, VS_SHAPES_OVER, limit * VS_ON_THE_WAY, VS_ON_THE_WAY, limit);
}

static bool mesh_of(builder *b, const vs_ref *ref, const level *at, const vs_fineness *facets, vs_mesh **mesh,
                    uint32_t *number) {
  bool endless = ref->node->kind == VS_HALF_SPACE;
  if (!buckets_grow(b)) return false;
  size_t *bucket = bucket_of(b, ref->node);
  for (size_t i = *bucket; i; i = b->meshes.at[i - 1].next) {
    const meshed *m = &b->meshes.at[i - 1];
    if (m->facets.tolerance != facets->tolerance || m->facets.segments != facets->segments) continue;
    bool sure = true;
    if (endless && m->node->kind == VS_HALF_SPACE &&
        (!same_place(&m->local, &at->local) ||
         (m->scope != at->scope_node &&
          (!m->scope || !at->scope_node || !vs_node_equal(m->scope, at->scope_node, &sure))))) {
      if (!sure) return vs_error_memory(b->error, NULL);
      continue;
    }
    if (m->node != ref->node && (m->node->hash != ref->node->hash || !vs_node_equal(m->node, ref->node, &sure))) {
      if (!sure) return vs_error_memory(b->error, NULL);
      continue;
    }
    *mesh = m->mesh;
    *number = (uint32_t)i - 1;
    return true;
  }
  if (!vs_kernel_report(&b->k, 0)) return false; /* asks the caller whether to continue, because this one shape may have
                                                  * taken long: it may have a million triangles */
  *mesh = vs_zeros(1, sizeof **mesh);
  if (!*mesh) return vs_error_memory(b->error, NULL);
  if (!VS_PUSH(&b->k, b->meshes,
               ((meshed){ ref->node, *facets, *mesh, NULL, *bucket, ref->origin, at->scope_node, at->local }))) {
    free(*mesh);
    return false;
  }
  *bucket = b->meshes.count;
  *number = (uint32_t)b->meshes.count - 1;
  if (ref->node->kind == VS_HALF_SPACE) return true; /* the mesh of a half-space is made later, once the solids that it
                                                      * cuts are known */
  const vs_kept_mesh to = { b->cache, *mesh, &b->meshes.at[*number].held };
  if (vs_node_has(ref->node, VS_IS_PLAIN))
    return vs_primitive_find(&to, ref->node, facets)
               ? count_made(&b->k, &b->made, (*mesh)->triangle_count)
               : VS_PUSH(&b->k, b->plain, *number);
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  if (vs_primitive_shared(&to, ref->node, facets, b->k.options, &why))
    return count_made(&b->k, &b->made, (*mesh)->triangle_count);
  if (!why.origin) why.origin = ref->origin;
  if (b->error) *b->error = why;
  return false;
}

/* ---- meshes that several threads make ---- */

enum {
  FEW = 64,
  CHUNK = 8 /* number of meshes that one task makes if there are many */,
  CURVED = 100 /* approximate number of triangles of a curved shape, for an estimate of the work */,
  SERIAL = 10000 /* number of triangles below which several threads would cost more time than they save */
};

typedef struct { const builder *b; size_t chunk; _Atomic size_t *made; } making;

static bool make_some(vs_kernel *k, void *context, size_t index) {
  const making *all = context;
  const builder *b = all->b;
  for (size_t i = index * all->chunk; i < (index + 1) * all->chunk && i < b->plain.count; i++) {
    const meshed *m = &b->meshes.at[b->plain.at[i]];
    if (!vs_kernel_report(k, 0)) return false; /* asks the caller whether to continue, because this one shape may have
                                                * taken long: it may have a million triangles */
    m->mesh->most = k->options->max_triangles * VS_ON_THE_WAY;
    if (!vs_tessellate(m->node, &m->facets, m->mesh, NULL))
      return m->mesh->over
                 ? count_made(k, all->made, m->mesh->most + 1)
                 : vs_kernel_fail(k, VS_KERNEL_OUT_OF_MEMORY, (uint32_t)i, "out of memory while combining solids");
    m->mesh->most = 0;
    if (!count_made(k, all->made, m->mesh->triangle_count)) return false;
  }
  return true;
}

/* Makes the meshes that the walk has left for several threads. Returns false on failure. */
static bool make_plain(builder *b) {
  making all = { b, b->plain.count < FEW ? 1 : CHUNK, &b->made };
  size_t faces = 0;
  for (size_t i = 0; i < b->plain.count; i++) {
    const vs_node *n = b->meshes.at[b->plain.at[i]].node;
    faces += n->kind == VS_POLYFACE_MESH ? VS_AS(polyface_mesh, n)->faces->count : CURVED;
  }
  if (faces >= SERIAL) b->k.threads = vs_kernel_threads(b->k.options);
  bool ok = vs_kernel_run(&b->k, (b->plain.count + all.chunk - 1) / all.chunk, make_some, &all);
  b->k.threads = 1;
  for (size_t i = 0; ok && i < b->plain.count; i++) {
    meshed *m = &b->meshes.at[b->plain.at[i]];
    vs_primitive_keep(&(vs_kept_mesh){ b->cache, m->mesh, &m->held }, (vs_node *)(uintptr_t)m->node, &m->facets);
    ok = vs_kernel_poll(&b->k, 0);
  }
  if (ok || b->k.error->status != VS_KERNEL_OUT_OF_MEMORY) return ok;
  const meshed *m = &b->meshes.at[b->plain.at[b->k.error->leaf]]; /* a mesh has failed in a thread: makes it again here,
                                                                   * to get its error */
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  if (vs_tessellate(m->node, &m->facets, m->mesh, &why)) return false;
  if (!why.origin) why.origin = m->origin;
  if (b->error) *b->error = why;
  b->k.error->status = VS_KERNEL_FINE;
  return false;
}

static uint64_t leaf_hash(const builder *b, const vs_kernel_leaf *leaf, bool off) {
  uint64_t h = (uint64_t)(uintptr_t)leaf->mesh ^ ((uint64_t)b->paints.at[leaf->tag] << 1 | off) << 40;
  for (int i = 0; i < 12; i++) {
    double x = leaf->placement.m[i / 4][i % 4] + 0.0; /* adding 0 changes -0 to 0, so that equal placements have equal
                                                       * bits in the hash */
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    h = (h ^ bits) * UINT64_C(0x9E3779B97F4A7C15);
    h ^= h >> 29;
  }
  return h;
}

static bool leaf_same(const builder *owner, const vs_kernel_leaf *a, const vs_kernel_leaf *b) {
  for (int i = 0; i < 12; i++)
    if (a->placement.m[i / 4][i % 4] != b->placement.m[i / 4][i % 4]) return false;
  return a->mesh == b->mesh && owner->paints.at[a->tag] == owner->paints.at[b->tag];
}

/* Returns the slot of the hash table `twins` that contains a leaf equal to `leaf`; if there is none, the free slot in
 * which to store it. */
static size_t twin_slot(const builder *b, const vs_kernel_leaf *leaf, bool off) {
  size_t mask = b->twins.count - 1, i = (size_t)leaf_hash(b, leaf, off) & mask;
  for (; b->twins.at[i]; i = (i + 1) & mask) {
    uint32_t other = b->twins.at[i] - 1;
    if (b->off.at[other] == off && leaf_same(b, &b->leaves.at[other], leaf)) break;
  }
  return i;
}

static bool twins_grow(builder *b) {
  size_t slots = b->twins.count ? b->twins.count * 2 : 64;
  if (!VS_ROOM(&b->k, b->twins.at, b->twins.room, slots)) return false;
  memset(b->twins.at, 0, slots * sizeof *b->twins.at);
  b->twins.count = slots;
  for (uint32_t i = 0; i < b->leaves.count; i++) b->twins.at[twin_slot(b, &b->leaves.at[i], b->off.at[i])] = i + 1;
  return true;
}

static bool add_leaf(builder *b, const vs_ref *ref, const level *at) {
  vs_fineness facets = vs_fineness_placed(b->facets, &at->placement);
  vs_kernel_leaf leaf = { NULL, at->placement, 0, at->material == NULL && !b->own };
  vs_mesh *mesh = NULL;
  if (b->leaves.count >= UINT32_MAX - 1) return full(b);
  uint32_t number = 0;
  if (!mesh_of(b, ref, at, &facets, &mesh, &number) ||
      !part_of(b, &(vs_solid_part){ at->material, at->layer, NULL, *ref, b->own ? number : b->object }, &leaf.tag))
    return false;
  leaf.mesh = mesh;
  if ((b->leaves.count + 1) * 2 > b->twins.count && !twins_grow(b)) return false;
  size_t slot = twin_slot(b, &leaf, at->off);
  if (!b->twins.at[slot]) {
    if (!VS_PUSH(&b->k, b->leaves, leaf) || !VS_PUSH(&b->k, b->origins, ref->origin) ||
        !VS_PUSH(&b->k, b->off, (uint8_t)at->off) || !VS_PUSH(&b->k, b->mesh_numbers, number))
      return false;
    b->twins.at[slot] = (uint32_t)b->leaves.count;
  }
  return VS_PUSH(&b->k, b->scoped, ((scoped){ b->twins.at[slot] - 1, at->scope })) &&
         add_term(b, VS_TERM_LEAF, b->twins.at[slot] - 1, 0);
}

/* Replaces each half-space by a bounded solid. It agrees with the half-space inside the bounds of its scope, the
 * innermost bounded operation around it. Outside of these bounds the half-space has no effect, because the operation is
 * empty there. The solid is thus as small as possible, and combined only with leaves that it can affect. Returns false
 * on failure. */
static bool bound_half_spaces(builder *b) {
  bool any = false, ok = true;
  for (size_t i = 0; i < b->meshes.count && !any; i++) any = b->meshes.at[i].node->kind == VS_HALF_SPACE;
  if (!any) return true;
  if (!VS_ROOM(&b->k, b->within.at, b->within.room, b->leaves.count + 1)) return false;
  vs_bounds *own = vs_fresh(b->meshes.count + 1, sizeof *own), *reach = vs_fresh(b->scopes.count + 1, sizeof *reach);
  ok = own && reach;
  for (size_t i = 0; ok && i < b->meshes.count; i++) own[i] = vs_mesh_bounds(b->meshes.at[i].mesh);
  for (size_t i = 0; ok && i < b->scopes.count; i++) reach[i] = vs_bounds_empty();
  for (size_t i = 0; ok && i < b->scoped.count; i++) {
    const scoped *s = &b->scoped.at[i];
    vs_bounds placed = vs_bounds_transform(&own[b->mesh_numbers.at[s->leaf]], &b->leaves.at[s->leaf].placement);
    vs_bounds_unite(&reach[s->scope], &placed);
  }
  /* Enlarges each scope (bounded operation) by those inside it. Outer scopes have lower numbers, so the loop goes from
   * the last to the first. */
  for (size_t i = b->scopes.count; ok && i-- > 1;) vs_bounds_unite(&reach[b->scopes.at[i]], &reach[i]);
  for (size_t i = 0; ok && i < b->leaves.count; i++)
    b->within.at[i] = b->meshes.at[b->mesh_numbers.at[i]].node->kind == VS_HALF_SPACE ? vs_bounds_empty()
                    : (vs_bounds){ vs_v3(-INFINITY, -INFINITY, -INFINITY), vs_v3(INFINITY, INFINITY, INFINITY) };
  /* own[i] becomes the box that the mesh of half-space i must cover in all places where it occurs. */
  for (size_t i = 0; ok && i < b->scoped.count; i++) {
    const scoped *s = &b->scoped.at[i];
    vs_affine back;
    size_t m = b->mesh_numbers.at[s->leaf];
    if (b->meshes.at[m].node->kind != VS_HALF_SPACE || !vs_affine_invert(&b->leaves.at[s->leaf].placement, &back))
      continue;
    vs_bounds local = vs_bounds_transform(&reach[s->scope], &back);
    vs_bounds_unite(&own[m], &local);
    vs_bounds_unite(&b->within.at[s->leaf], &reach[s->scope]);
  }
  for (size_t i = 0; ok && i < b->meshes.count; i++) {
    meshed *m = &b->meshes.at[i];
    if (m->node->kind != VS_HALF_SPACE) continue;
    ok = vs_half_space_shared(&(vs_kept_mesh){ b->cache, m->mesh, &m->held }, (vs_node *)(uintptr_t)m->node, &own[i]);
  }
  free(own);
  free(reach);
  return ok || vs_error_memory(b->error, NULL);
}

/* Returns true if the walk visits the children of n: a wrapper, a placement, or an operation on several children. Any
 * other node counts as a primitive here. */
static bool goes_in(const vs_node *n) {
  vs_role role = vs_node_role(n);
  return role == VS_ROLE_PLACED || role == VS_ROLE_SET ||
         (role == VS_ROLE_WRAPPER && (n->child_count || n->kind != VS_CUSTOM));
}

static bool enter(builder *b, vs_walk *walk, const vs_ref *ref) {
  const vs_node *n = ref->node;
  level now = { vs_affine_identity(), NULL, NULL, b->pending.count, n->kind == VS_DIFFERENCE, false, 0, NULL,
                vs_affine_identity() };
  if (b->levels.count) {
    const level *up = &b->levels.at[b->levels.count - 1];
    now.placement = up->placement;
    now.material = up->material;
    now.layer = up->layer;
    now.scope = up->scope;
    now.scope_node = up->scope_node;
    now.local = up->local;
    now.off = up->off != (up->difference && b->pending.count > up->first);
  }
  if (b->depth != NO_OBJECTS && b->levels.count == (size_t)b->depth) b->object++;
  if (n->kind == VS_TRANSFORM) {
    now.placement = vs_affine_multiply(&now.placement, &VS_AS(transform, n)->matrix);
    now.local = vs_affine_multiply(&now.local, &VS_AS(transform, n)->matrix);
  }
  if (b->scopes.count == 0 && !VS_PUSH(&b->k, b->scopes, 0u)) return false; /* scope 0, the outermost, is the entire
                                                                             * drawing */
  if ((n->kind == VS_INTERSECTION || n->kind == VS_DIFFERENCE) && !(n->flags & VS_NODE_ENDLESS)) {
    if (!VS_PUSH(&b->k, b->scopes, now.scope)) return false;
    now.scope = (uint32_t)b->scopes.count - 1;
    now.scope_node = n;
    now.local = vs_affine_identity();
  }
  if (n->kind == VS_MATERIAL) now.material = VS_AS(material, n)->material;
  if (n->kind == VS_LAYER) now.layer = VS_AS(layer, n)->name;
  if (n->kind == VS_PART && !now.layer) now.layer = VS_AS(part, n)->name;
  if (!VS_PUSH(&b->k, b->levels, now)) return false;
  bool solid = n->class_ == VS_SOLID || n->class_ == VS_MIXED;
  if (solid && goes_in(n)) return true;
  vs_walk_skip(walk);
  return solid ? add_leaf(b, ref, &now) : add_term(b, VS_TERM_UNION, 0, 0); /* a node that is no solid counts as an
                                                                             * empty operand */
}

static bool leave(builder *b, const vs_ref *ref) {
  const vs_node *n = ref->node;
  size_t first = b->levels.at[--b->levels.count].first;
  if (!vs_node_is_set(n) || !(n->class_ == VS_SOLID || n->class_ == VS_MIXED)) return true;
  return close_term(b,
                    n->kind == VS_UNION          ? VS_TERM_UNION
                    : n->kind == VS_INTERSECTION ? VS_TERM_INTERSECTION
                                                 : VS_TERM_DIFFERENCE,
                    first);
}

static bool walk_one(builder *b, const vs_ref *root) {
  vs_walk *walk = vs_walk_new(root->node->store, *root);
  if (!walk) return vs_error_memory(b->error, root->origin);
  vs_ref ref;
  bool ok = true;
  for (vs_walk_event e; ok && (e = vs_walk_next(walk, &ref, NULL)) != VS_WALK_DONE;) {
    if (e == VS_WALK_FAILED) ok = vs_error_memory(b->error, root->origin);
    else ok = e == VS_WALK_ENTER ? enter(b, walk, &ref) : leave(b, &ref);
    ok = ok && vs_kernel_poll(&b->k, 0);
  }
  vs_walk_free(walk);
  return ok;
}

static vs_error_kind kind_of(vs_kernel_status s) {
  switch (s) {
  case VS_KERNEL_FINE: return VS_ERROR_NONE;
  case VS_KERNEL_OPEN: case VS_KERNEL_INSIDE_OUT: case VS_KERNEL_NOT_FINITE: case VS_KERNEL_INTERNAL:
    return VS_ERROR_MODEL;
  case VS_KERNEL_OUT_OF_MEMORY: return VS_ERROR_MEMORY;
  case VS_KERNEL_LIMIT: return VS_ERROR_LIMIT;
  case VS_KERNEL_INTERRUPTED: return VS_ERROR_INTERRUPT;
  }
  return VS_ERROR_MEMORY;
}

void vs_solid_free(vs_solid *s) {
  vs_mesh_free(&s->mesh);
  free(s->parts);
  *s = (vs_solid){ .part_count = 0 };
}

void vs_solid_tally_steps(vs_store *s, const vs_kernel_counts *counts) {
  vs_tally *t = vs_store_tally(s);
  for (int i = 0; t && i < VS_STEP_COUNT; i++) t->steps[i] += counts->seconds[i];
}

static void tally_up(vs_tally *t, const vs_kernel_counts *c) {
  if (!t) return;
  t->clusters += c->clusters;
  t->combined += c->combined;
  t->copied += c->copied;
  t->remembered += c->remembered;
  vs_tally_also(t, c->peak);
}

/* The destination of the result: `one` or `many`, and the other pointer is NULL. depth and own become the members of
 * `builder` with these names. */
typedef struct {
  vs_solid *one;
  vs_solid_copies *many;
  int depth; /* number of levels below a reference at which a node counts as an object (vs_solid_of_objects) */
  bool own;
} target;

/* Adds the references to the builder as one problem for the kernel: their union. Returns false on failure. */
static bool build(builder *b, const vs_ref *refs, size_t count) {
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) {
    ok = !(refs[i].node->flags & VS_NODE_ENDLESS) ||
         vs_error_set(b->error, VS_ERROR_MODEL, refs[i].origin, VS_ENDLESS_MESSAGE);
    ok = ok && walk_one(b, &refs[i]);
  }
  ok = ok && make_plain(b) && close_term(b, VS_TERM_UNION, 0) && bound_half_spaces(b);
  for (size_t i = 0; ok && b->cache && i < b->leaves.count; i++) {
    const vs_cached *held = b->meshes.at[b->mesh_numbers.at[i]].held;
    ok = VS_PUSH(&b->k, b->identities, held ? held->serial : 0) && vs_kernel_poll(&b->k, 0);
  }
  vs_kernel_lap(&b->k, VS_STEP_SHAPES);
  return ok;
}

static bool solve(const builder *b, const vs_kernel_options *options, target to) {
  vs_kernel_problem problem = { b->leaves.at,
                                b->terms.at,
                                b->operands.at,
                                (uint32_t)b->leaves.count,
                                (uint32_t)b->terms.count,
                                (uint32_t)b->operands.count,
                                b->paints.at,
                                b->identities.at,
                                b->within.at };
  return to.one ? vs_kernel_evaluate(&problem, options, &to.one->mesh, b->k.error)
                : vs_kernel_evaluate_copies(&problem, options, &to.many->meshes, b->k.error);
}

/* Warns if the kernel's grid has changed the volume of parts by more than a hundredth. The warning has the origin of
 * the first such part. */
static void warn_coarse(const builder *b, const vs_kernel_options *options, const vs_kernel_counts *counts) {
  char message[200], more[40] = "";
  if (!counts->coarse || !options->warns) return;
  if (counts->coarse > 1) snprintf(more, sizeof more, " (and %zu more parts)", counts->coarse - 1);
  snprintf(message, sizeof message,
           "this part is too small for the solids that it touches: all of them are computed in steps of %.3g, which "
           "makes this part %.0f %% "
           "%s%s",
           counts->coarse_step, 100 * fabs(counts->coarse_by), counts->coarse_by > 0 ? "larger" : "smaller", more);
  vs_job_warn(options->job, b->origins.at[counts->coarse_leaf], message);
}

/* Copies the kernel's error to the builder's error. If the kernel's error has a leaf, adds the origin of this leaf.
 * Keeps an error that was already set. */
static void take_failure(const builder *b) {
  const vs_kernel_error *why = b->k.error;
  if (why->status == VS_KERNEL_FINE) return;
  bool placed = why->status == VS_KERNEL_OPEN || why->status == VS_KERNEL_INSIDE_OUT ||
                why->status == VS_KERNEL_NOT_FINITE || why->status == VS_KERNEL_INTERNAL;
  vs_error_set(b->error, kind_of(why->status), placed && why->leaf < b->origins.count ? b->origins.at[why->leaf] : NULL,
               "%s", why->message);
}

/* Frees the builder. of: store of the nodes, or NULL. If the store is abandoned, its meshes stay allocated. */
static void builder_free(builder *b, const vs_store *of) {
  for (size_t i = 0; i < b->meshes.count && !vs_store_is_abandoned(of); i++) {
    if (b->meshes.at[i].held) vs_cache_let_go(b->cache, b->meshes.at[i].held);
    else vs_mesh_free(b->meshes.at[i].mesh);
    free(b->meshes.at[i].mesh);
  }
  VS_DROP(&b->k, b->leaves);
  VS_DROP(&b->k, b->origins);
  VS_DROP(&b->k, b->twins);
  VS_DROP(&b->k, b->off);
  VS_DROP(&b->k, b->mesh_numbers);
  VS_DROP(&b->k, b->scopes);
  VS_DROP(&b->k, b->within);
  VS_DROP(&b->k, b->scoped);
  VS_DROP(&b->k, b->identities);
  VS_DROP(&b->k, b->plain);
  VS_DROP(&b->k, b->terms);
  VS_DROP(&b->k, b->operands);
  VS_DROP(&b->k, b->pending);
  VS_DROP(&b->k, b->levels);
  VS_DROP(&b->k, b->meshes);
  VS_DROP(&b->k, b->buckets);
  VS_DROP(&b->k, b->parts);
  VS_DROP(&b->k, b->paints);
  VS_DROP(&b->k, b->part_table);
  VS_DROP(&b->k, b->paint_table);
  free(b);
}

static bool evaluate(const vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options,
                     target to, vs_error *error) {
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  builder *b = vs_zeros(1, sizeof *b);
  if (!b) return vs_error_memory(error, NULL);
  vs_tally *tally = count ? vs_store_tally(refs[0].node->store) : NULL;
  vs_work_phase was = vs_tally_enter(tally, VS_WORK_MESH);
  vs_kernel_counts counts = { 0 };
  vs_kernel_options mine = options ? *options : (vs_kernel_options){ .job = NULL };
  if (count && !mine.cache) mine.cache = vs_store_cache(refs[0].node->store);
  b->cache = vs_cache_asks(mine.cache) ? mine.cache : NULL;
  b->k.options = &mine;
  b->k.error = &why;
  b->k.threads = 1;
  b->facets = facets;
  b->depth = to.depth, b->own = to.own;
  b->error = error;
  vs_kernel_time(&b->k, counts.seconds);
  bool ok = build(b, refs, count);
  mine.counts = &counts;
  ok = ok && solve(b, &mine, to);
  if (ok) {
    warn_coarse(b, &mine, &counts);
    *(to.one ? &to.one->parts : &to.many->parts) = b->parts.at;
    *(to.one ? &to.one->part_count : &to.many->part_count) = b->parts.count;
    *(to.one ? &to.one->straightened : &to.many->straightened) = counts.straightened;
    b->parts.at = NULL;
  } else {
    take_failure(b);
  }
  tally_up(tally, &counts);
  if (count) vs_solid_tally_steps(refs[0].node->store, &counts);
  builder_free(b, count ? refs[0].node->store : NULL);
  vs_tally_enter(tally, was);
  return ok;
}

bool vs_solid_evaluate(const vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options,
                       vs_solid *out, vs_error *error) {
  *out = (vs_solid){ .part_count = 0 };
  if (evaluate(refs, count, facets, options, (target){ .one = out, .depth = NO_OBJECTS }, error)) return true;
  vs_solid_free(out);
  return false;
}

bool vs_solid_of_objects(const vs_refs *refs, int depth, const vs_fineness *facets, const vs_kernel_options *options,
                         vs_solid *out, vs_error *error) {
  *out = (vs_solid){ .part_count = 0 };
  if (evaluate(refs->at, refs->count, facets, options, (target){ .one = out, .depth = depth }, error)) return true;
  vs_solid_free(out);
  return false;
}

bool vs_solid_of_leaves(vs_ref ref, const vs_fineness *facets, const vs_kernel_options *options, vs_solid *out,
                        vs_error *error) {
  *out = (vs_solid){ .part_count = 0 };
  if (evaluate(&ref, 1, facets, options, (target){ .one = out, .depth = NO_OBJECTS, .own = true }, error)) return true;
  vs_solid_free(out);
  return false;
}

bool vs_solid_evaluate_copies(const vs_ref *refs, size_t count, const vs_fineness *facets,
                              const vs_kernel_options *options, vs_solid_copies *out, vs_error *error) {
  *out = (vs_solid_copies){ .part_count = 0 };
  /* after a failure the kernel leaves its result empty */
  return evaluate(refs, count, facets, options, (target){ .many = out, .depth = NO_OBJECTS }, error);
}

void vs_solid_copies_free(vs_solid_copies *s) {
  vs_kernel_copies_free(&s->meshes);
  free(s->parts);
  *s = (vs_solid_copies){ .part_count = 0 };
}
