/* Declares the state that the files of the driver share: driver.c, emitter.c, drawing_plan.c, tree_walk.c,
 * camera_boxes.c and text_runs.c. No other file includes this header. */
#ifndef VS_BACKENDS_DRIVE_H
#define VS_BACKENDS_DRIVE_H

#include <string.h>

#include "backends/backend.h"
#include "backends/reuse.h"
#include "geometry/measure/node_measures.h"
#include "model/store/nodemap.h"

typedef struct {
  vs_ref ref;           /* the first reference to the node that the plan has found */
  uint32_t uses, height; /* uses: number of references to the node. height: number of nested levels in its text; for an
                          * operation whose children are being visited, the greatest height of a child so far */
  uint32_t shown;       /* number of children of an operation that draw something */
  uint32_t definition;  /* number of the node's template, from 1; 0: the node has no template */
  uint32_t weight;      /* approximate length of the node's text, counted in shapes; set only if parts of the text are
                         * cached */
  bool vain, cut;
  bool first_vain, some_vain; /* first_vain: the first child draws nothing. some_vain: some child draws nothing */
  bool bare, painted;   /* bare: true if some part of the node has no material of its own. painted: true if some part
                         * has a material of its own */
  bool layered;         /* true if some part of the node has a layer of its own */
  bool carved;          /* whether the node occurs inside an intersection or a difference */
  vs_node *lowered;     /* simpler kinds that replace the node, retained, or NULL */
  vs_solid *mesh;
} drive_entry;

/* A step of the plan: an entry, and the index of its first child that the plan has not visited. */
typedef struct { size_t entry; uint32_t next; } drive_step;

typedef struct {
  vs_ref ref;
  size_t next, shown;   /* next: index of the next child to visit. shown: number of children passed to the emitter */
  size_t asked;         /* children before this index were already searched in the cache of text */
  const vs_material *material;
  const char *layer, *part;
  vs_affine placement;
  vs_bounds reach;
  bool in_boolean;
  bool silent;          /* whether this is an operation with a single operand that draws something, so that only the
                         * operand is written */
} drive_frame;

struct vs_drive {
  vs_nodemap index;     /* maps a node to the index of the node's entry, plus 1 */
  drive_entry *entries;
  size_t entry_count, entry_room;
  uint32_t *order;      /* indices of the entries, children before parents */
  size_t order_count, order_room;
  drive_step *steps;
  size_t step_count, step_room;
  drive_frame *frames;
  size_t frame_count, frame_room;
  bool operation[VS_KIND_COUNT]; /* operation[k]: true if nodes of kind k are always operations */
  bool brief[VS_KIND_COUNT]; /* brief[k]: true if the text of kind k is as short as the use of a template, unless the
                              * number of facets is set */
  size_t facets_at[VS_KIND_COUNT]; /* facets_at[k]: offset of the number of facets in the data of kind k, in bytes;
                                    * SIZE_MAX: the kind has no such number */
  vs_reuse_line *lines;
  size_t line_count, line_room;
  vs_nodemap paints;    /* maps a material to the material's number */
  const vs_material **materials;
  size_t material_count, material_room;
  vs_node **kept;       /* trees of simpler nodes to which nodes were lowered; they exist until the walk ends */
  size_t kept_count, kept_room;
  const char **said;    /* addresses of the warnings that were already given */
  size_t said_count, said_room;
  vs_bounds_memo bounds;
  vs_solid scratch; /* mesh of a node without an entry, valid until the next such mesh is computed */
  uint32_t ticks; /* number of visited nodes (drive_tick) */
  vs_reuse reuse;       /* cache of the text of earlier outputs (reuse.h) */
  size_t run_frames, run_until; /* for the cached sequence of shapes that is being written. run_frames: number of frames
                                 * (open operations) at its beginning. run_until: index of the child before which it
                                 * ends */
  size_t run_line, run_first;   /* run_line: first line of the cached sequence that is being written. run_first: number
                                 * of recorded line origins before it */
};

/* ---- entries ---- */

static inline bool drive_has(const vs_emitter *e, vs_backend_trait trait) { return vs_backend_has(e->backend, trait); }

static inline bool drive_hull_is_operation(const vs_emitter *e, const vs_node *n) {
  if (!drive_has(e, VS_SHOWS_HULLS) || n->class_ != VS_SOLID || VS_AS(hull, n)->points->count > 0) return false;
  for (uint32_t i = 0; i < n->child_count; i++)
    if (n->children[i].node->class_ != VS_SOLID) return false;
  return true;
}

static inline bool drive_is_operation(const vs_emitter *e, const vs_node *n) {
  if (drive_has(e, VS_VERBATIM) && n->child_count > 0) return true;
  if (n->kind == VS_HULL && !drive_has(e, VS_VERBATIM)) return drive_hull_is_operation(e, n);
  return e->drive->operation[n->kind];
}

/* Data of a node that are equal at all its places. operation: whether the driver visits the node's children. vain:
 * whether the node draws nothing. */
typedef struct { drive_entry *entry; bool operation, vain; } drive_view;

static inline bool drive_leaf_vain(const vs_emitter *e, const vs_node *n) {
  if (drive_has(e, VS_VERBATIM)) return false;
  return n->kind == VS_EMPTY || n->class_ == VS_NOTHING ||
         (n->class_ < VS_MIXED && e->backend->omit[n->class_] != NULL);
}

/* Returns true if the node's own text is as short as the use of a template, so that sharing it saves nothing. A node
 * with a fixed number of facets is not brief, because it may become a mesh. */
static inline bool drive_is_brief(const vs_drive *d, const vs_node *n) {
  vs_field_integer facets = 0;
  if (!d->brief[n->kind]) return false;
  size_t at = d->facets_at[n->kind];
  if (at != SIZE_MAX) memcpy(&facets, (const char *)vs_node_data(n) + at, sizeof facets);
  return facets == 0;
}

/* Returns the data of node n. A leaf whose text is as short as the use of a template has no entry, so none is
 * searched. */
static inline drive_view drive_look(const vs_emitter *e, const vs_node *n) {
  const vs_drive *d = e->drive;
  drive_view v = { NULL, drive_is_operation(e, n), false };
  if (v.operation || (n->refs > 1 && !drive_is_brief(d, n))) {
    const uint64_t *at = vs_nodemap_get(&d->index, n);
    if (at != NULL) v.entry = &d->entries[*at - 1];
  }
  v.vain = v.entry != NULL ? v.entry->vain : drive_leaf_vain(e, n);
  return v;
}

static inline bool drive_vain(const vs_emitter *e, const vs_ref *ref) { return drive_look(e, ref->node).vain; }

/* Returns the node's entry, or NULL if it has none. */
static inline drive_entry *drive_find(const vs_emitter *e, const vs_node *n) {
  const uint64_t *at = n->refs > 1 || drive_is_operation(e, n) ? vs_nodemap_get(&e->drive->index, n) : NULL;
  return at != NULL ? &e->drive->entries[*at - 1] : NULL;
}

/* Counts a visited node, and asks after every 4096 whether the user interrupts. Returns false then. */
static inline bool drive_tick(vs_emitter *e) {
  return (++e->drive->ticks & 0xfff) != 0 || vs_emit_progress(e, "writing", -1);
}

/* ---- emitter.c ---- */

/* Records that the text from line number `line` on has this origin. Returns false if memory is out. */
bool vs_drive_mark(vs_emitter *e, uint32_t line, const vs_origin *origin);

#endif
