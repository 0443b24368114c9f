/* Owns the declarations that the files of the driver share. driver.c: plan and walk; text_runs.c: the runs whose text
 * is kept. No other file includes this one. */
#ifndef VS_BACKENDS_DRIVE_H
#define VS_BACKENDS_DRIVE_H

#include <string.h>

#include "backends/backend.h"
#include "backends/reuse.h"
#include "geometry/measure/node_measures.h"
#include "model/store/nodemap.h"

typedef struct {
  vs_ref ref;           /* the first reference to it */
  uint32_t uses, height; /* height, for an operation whose children are being visited: the greatest of theirs */
  uint32_t shown;       /* of an operation: the number of children that are not vain */
  uint32_t definition;  /* the template's number from 1, or 0 */
  uint32_t weight;      /* the approximate length of its text, counted in shapes; the use of a template counts 1; at
                         * most HEAVY of text_runs.c. Set only if runs are used. */
  bool vain, cut;
  bool first_vain, some_vain; /* of its children */
  bool bare, painted;   /* some part has no material of its own; some part has one */
  bool layered;         /* some part has a layer of its own */
  bool carved;          /* it occurs in an intersection or a difference */
  vs_node *lowered;     /* retained, or NULL */
  vs_solid *mesh;
} drive_entry;

/* A step of the plan: an entry, and the first of its children that the plan has not visited. */
typedef struct { size_t entry; uint32_t next; } drive_step;

typedef struct {
  vs_ref ref;
  size_t next, shown;   /* children: visited, passed to the emitter */
  size_t asked;         /* the search for runs is done for all children before this one */
  const vs_material *material;
  vs_affine placement;
  vs_bounds reach;
  bool in_boolean;
  bool silent;          /* an operation with one operand left, which is itself not shown */
} drive_frame;

struct vs_drive {
  vs_nodemap index;     /* node -> entry + 1 */
  drive_entry *entries;
  size_t entry_count, entry_room;
  uint32_t *order;      /* entries, children first */
  size_t order_count, order_room;
  drive_step *steps;
  size_t step_count, step_room;
  drive_frame *frames;
  size_t frame_count, frame_room;
  bool operation[VS_KIND_COUNT]; /* kinds that are always operations */
  bool brief[VS_KIND_COUNT]; /* kinds with a text as short as a template's use, unless the number of facets is set */
  size_t facets_at[VS_KIND_COUNT]; /* the position of the facets in the kind's data; SIZE_MAX: it has none */
  vs_reuse_line *lines;
  size_t line_count, line_room;
  vs_nodemap paints;    /* material -> its number */
  const vs_material **materials;
  size_t material_count, material_room;
  vs_node **kept;       /* the trees that nodes were lowered to; they live until the walk ends */
  size_t kept_count, kept_room;
  const char **said;    /* the warnings already given, by address */
  size_t said_count, said_room;
  vs_bounds_memo bounds;
  double from, share, told; /* the current mesh: the fraction of the whole at which it begins, and its share; the last
                             * reported fraction */
  vs_solid scratch; /* the mesh of a node without entry, valid until the next call */
  uint32_t ticks;
  vs_reuse reuse;       /* runs (text_runs.c) */
  size_t run_frames, run_until; /* of the run that is being written: the number of open frames at its beginning; the
                                 * child before which it ends */
  size_t run_line, run_first;   /* its first line; the number of line origins before it */
};

/* ---- entries ---- */

static inline bool drive_hull_is_operation(const vs_emitter *e, const vs_node *n) {
  if (!e->backend->hulls || n->class_ != VS_SOLID || VS_AS(hull, n)->points->count > 0) return false;
  for (uint32_t i = 0; i < n->child_count; i++)
    if (n->children[i].node->class_ != VS_SOLID) return false;
  return true;
}

static inline bool drive_is_operation(const vs_emitter *e, const vs_node *n) {
  if (e->backend->verbatim && n->child_count > 0) return true;
  return n->kind == VS_HULL && !e->backend->verbatim ? drive_hull_is_operation(e, n) : e->drive->operation[n->kind];
}

/* The facts about a node that do not depend on its place. A leaf with one owner has no entry. */
typedef struct { drive_entry *entry; bool operation, vain; } drive_view;

static inline bool drive_leaf_vain(const vs_emitter *e, const vs_node *n) {
  if (e->backend->verbatim) return false;
  return n->kind == VS_EMPTY || n->class_ == VS_NOTHING ||
         (n->class_ < VS_MIXED && e->backend->omit[n->class_] != NULL);
}

/* Returns true if the node's own text is as short as the use of a template: sharing it would save nothing. A node with
 * a fixed number of facets may become a mesh, and is not brief. */
static inline bool drive_is_brief(const vs_drive *d, const vs_node *n) {
  vs_field_integer facets = 0;
  if (!d->brief[n->kind]) return false;
  size_t at = d->facets_at[n->kind];
  if (at != SIZE_MAX) memcpy(&facets, (const char *)vs_node_data(n) + at, sizeof facets);
  return facets == 0;
}

/* Returns the facts about n. Skips the look-up for a brief leaf, whose entry adds nothing to the node itself. */
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

/* ---- text_runs.c ---- */

/* The text from this line on comes from this origin. */
bool vs_drive_mark(vs_emitter *e, uint32_t line, const vs_origin *origin);

#endif
