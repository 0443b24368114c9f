/* Owns the shape of a back-end: the functions that a format's folder gives the driver, and the functions that the
 * driver gives in return.
 *
 * The driver (driver.c) walks the drawing without recursion. It calls the emit function of the node's kind for every
 * node that the format draws. A node whose children the driver does not visit (a primitive, or a profile with its
 * sweep) gets one call, with phase VS_PHASE_LEAF. An operation gets two, VS_PHASE_ENTER before its children and
 * VS_PHASE_LEAVE after them.
 *
 * If a kind has no function, or the function returns VS_LOWER before it has written anything, the driver replaces the
 * node by simpler kinds and tries again. It lowers a shared node once. The simpler kinds may be a tree, which the
 * driver walks in place of the node.
 *
 * The emitter never sees nodes that draw nothing (empty, or of a class that the format omits). A union or difference
 * with a single remaining operand is replaced by that operand.
 *
 * For a format with `define`, the driver makes templates of subtrees that occur at several places, and cuts off
 * subtrees deeper than VS_DEPTH_MAX. It writes each template once before the drawing, and calls `use` at each place. */
#ifndef VS_BACKENDS_BACKEND_H
#define VS_BACKENDS_BACKEND_H

#include "backends/writer.h"
#include "backends/export.h"
#include "geometry/tolerance.h"
#include "kernel/round/rounding.h"
#include "solids/solid_meshes.h"
#include "model/mesh.h"
#include "model/node.h"
#include "passes/sugar.h"
#include "model/scene.h"

enum {
  VS_DEPTH_MAX = 150
}; /* the greatest nesting in one subtree of the output: POV-Ray and OpenSCAD crash at some thousands, and people cannot
    * read that much */

typedef enum {
  VS_EMITTED,
  VS_WHOLE,  /* at VS_PHASE_ENTER: the function has written the node with its children; the driver does not visit
              * them */
  VS_LOWER,
  VS_FAILED
} vs_emit_status;
typedef enum { VS_PHASE_LEAF, VS_PHASE_ENTER, VS_PHASE_LEAVE } vs_phase;

typedef struct vs_emitter vs_emitter;
typedef struct vs_drive vs_drive; /* private to the driver, driver.c */
typedef vs_emit_status vs_emit_fn(vs_emitter *e, const vs_ref *ref, vs_phase phase);

/* The numbers that keep a curve's thickness constant on the picture, near and far, in model units. The radius at a
 * place is share times the depth from eye along forward, but at least `least`. In a parallel view forward is 0 0 0, and
 * the radius is `least`. */
typedef struct { vs_vec3 eye, forward; double share, least; } vs_pen;

struct vs_emitter {
  vs_writer *out;
  const vs_scene *scene;
  const vs_export_options *options;
  const vs_backend *backend;
  vs_error *error;
  const char *path;    /* of the output file, from which names beside it are made; NULL: there is none */
  const char *folder;  /* the worker's folder, for files that the text names; NULL: there is none */
  void *state;         /* private to the back-end; begin makes it, close frees it */
  vs_fineness drawing_facets; /* of objects without a placement */
  vs_fineness facets;    /* in the coordinates of the current output: finer inside a placement that enlarges */
  vs_bounds bounds;    /* of the whole drawing; never empty */
  vs_pen pen;          /* POV-Ray: the thickness of curves */
  double chord;        /* the greatest height of a chord, as a fraction of the drawing's tolerance: 1, or less in a
                        * picture */
  double unit;         /* POV-Ray: the length of a model unit in its scene; see povray_scene.c */
  vs_bounds framed;    /* the bounds that a camera frames: without the material that is cut away */
  vs_bounds *boxes;    /* the bounds of the parts, together tighter than `framed`; the camera frames these */
  size_t box_count, box_room;
  size_t depth;        /* the current nesting, for indentation */
  size_t child_count;  /* at VS_PHASE_ENTER: the number of operands that follow, at least 1; 1 only for a placement or
                        * paint */
  size_t child_index;  /* the index of this node among the operands of its parent */
  const vs_node *body;   /* the template whose body is being written, or NULL */
  const vs_node *parent; /* the operation that holds this node, or NULL */
  bool smooth;         /* this mesh represents a curved object: it gets smooth shading */
  bool in_boolean;     /* inside an intersection or a difference */
  bool carved;         /* at VS_PHASE_ENTER: the node occurs in an intersection or difference, here or elsewhere in the
                        * drawing */
  /* The material and the placement of this node, by all operations above it. */
  const vs_material *material; /* or NULL */
  vs_affine placement;
  vs_bounds reach;     /* in the coordinates of the current output: the space in which a half-space must be exact */
  vs_drive *drive;
  uint64_t triangles;  /* the number written so far, by vs_emit_triangles */
};

struct vs_backend {
  bool (*begin)(vs_emitter *e);
  bool (*item)(vs_emitter *e, size_t index, bool end); /* called before and after each drawn object; may be NULL */
  bool (*end)(vs_emitter *e);
  void (*close)(vs_emitter *e); /* also after a failure; may be NULL */
  /* Writes the beginning (open) or the end (!open) of template `id`, which counts from 1. A back-end has both define
   * and use, or neither. */
  bool (*define)(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open);
  bool (*use)(vs_emitter *e, uint32_t id, const vs_ref *ref);
  /* Writes the union of the drawing's solids, for formats of triangles alone: no walk takes place. The mesh is rounded
   * for the format's numbers (kernel/round/rounding.h). */
  bool (*solid)(vs_emitter *e, const vs_solid *solid);
  bool (*copies)(vs_emitter *e, const vs_solid_copies *copies); /* the same, with equal parts once; a back-end has
                                                                 * either this or solid */
  vs_numbers numbers;
  /* Runs a worker on the written text. NULL: the text is the output. */
  bool (*render)(vs_emitter *e, const char *text_path, const char *output_path);
  /* Writes the files beside e->path (an .mtl), after the text. NULL: there are none. */
  bool (*beside)(vs_emitter *e);
  vs_mark_style highlights, ghosts; /* the way in which the format shows them (passes/sugar.h) */
  bool ghosts_in_drafts;   /* it shows ghosts only in pictures of draft quality */
  const char *family;      /* a name that several formats share, in addition to their own; NULL: none */
  const char *native;      /* the target, of targets.def, whose `native` text this format accepts; NULL: none */
  bool keep_origins;    /* the emitter keeps the origin of each line of the text */
  bool parts_flush;     /* its program keeps skins where a cut has faces in one plane: a pass separates such faces
                         * before (flush.h) */
  bool hulls; /* hulls of solids are shown as operations; all other hulls, and all hulls of other formats, as one
               * shape */
  bool draws;           /* makes drawings: it chooses among the scene's views, cuts the solids itself and requests them
                         * (vs_lower_drawing); `solid` receives none */
  bool frames;          /* shows the drawing through a camera that frames it */
  bool loose;           /* with solid or copies: the driver first walks the objects that are not solid, by the rows of
                         * emit */
  bool inks;            /* a pass paints thin objects without a material dark (ink.h) */
  bool lays;            /* its patterns lie correctly only on faces that no placement turns (lay.h) */
  bool groups;          /* it receives large sets as trees of boxes (vs_sets_group) */
  bool area_sets;       /* its emit function gets sets of regions before they are lowered to one region */
  bool
      keeps_text; /* the text of a node depends only on the values that drive_key puts into a key, not on earlier
                   * output */
  bool verbatim;        /* every node is emitted, empty ones too, and the children of all kinds are visited */
  const char *omit[VS_MIXED]; /* omit[c]: the warning, given once, that the format omits objects of class c; NULL: it
                               * shows them */
  vs_emit_fn *shape;    /* emits the primitive solids that have no row in `emit`; NULL: they are lowered */
  struct { vs_emit_fn *fn; const char *lossy; } emit[VS_KIND_COUNT]; /* lossy: a warning, given once */
};

/* Returns the function that writes n; NULL: n is lowered. */
static inline vs_emit_fn *vs_backend_writes(const vs_backend *b, const vs_node *n) {
  vs_emit_fn *fn = b->emit[n->kind].fn;
  return fn || vs_node_role(n) != VS_ROLE_SHAPE || n->flags & VS_NODE_ENDLESS ? fn : b->shape;
}

#define VS_FORMAT(suffix, backend, name, worker, binary, doc) extern const vs_backend vs_backend_##backend;
#include "backends/backends.def"

/* The rows of formats that show triangles and lines at their places. `leaf` makes triangles of solids and thin objects,
 * `line` takes polylines, `through` follows placement and paint, `boolean` uses the kernel. A kind without a row is
 * lowered: curves become polylines. */
#define VS_EMIT_SHAPES(leaf, line, through, boolean)                                                                   \
  .shape = (leaf),                                                                                                     \
  .emit = { [VS_LINE] = { line, NULL },                                                                                \
            [VS_REGION] = { leaf, NULL },                                                                              \
            [VS_TEXT] = { leaf, NULL },                                                                                \
            [VS_HULL] = { leaf, NULL },                                                                                \
            [VS_REVOLVE] = { leaf, NULL },                                                                             \
            [VS_LOFT] = { leaf, NULL },                                                                                \
            [VS_RULED_LOFT] = { leaf, NULL },                                                                          \
            [VS_GUIDED_LOFT] = { leaf, NULL },                                                                         \
            [VS_GRID_SURFACE] = { leaf, NULL },                                                                        \
            [VS_GRID_MESH] = { leaf, NULL },                                                                           \
            [VS_POLYFACE_MESH] = { leaf, NULL },                                                                       \
            [VS_EXTRUDE] = { leaf, NULL },                                                                             \
            [VS_SWEEP] = { leaf, NULL },                                                                               \
            [VS_THICKEN] = { leaf, NULL },                                                                             \
            [VS_TRANSFORM] = { through, NULL },                                                                        \
            [VS_MATERIAL] = { through, NULL },                                                                         \
            [VS_LAYER] = { through, NULL },                                                                            \
            [VS_UNION] = { through, NULL },                                                                            \
            [VS_INTERSECTION] = { boolean, NULL },                                                                     \
            [VS_DIFFERENCE] = { boolean, NULL } }

/* ---- functions that emit functions call ---- */
bool vs_emit_fail(vs_emitter *e, const vs_ref *ref,
                  const char *message); /* Reports a fault of the model at the reference; returns false. */
bool vs_emit_warn_once(vs_emitter *e, const vs_ref *ref,
                       const char *message); /* Warns once for each message (compared by address). */
bool vs_emit_no_memory(vs_emitter *e);
bool vs_emit_progress(vs_emitter *e, const char *stage,
                      double fraction); /* Returns false when the user interrupts; the error says so. */
/* Counts triangles that are written now or next; those of a template count once. Returns false, and sets the error,
 * when they exceed the limit. */
bool vs_emit_triangles(vs_emitter *e, size_t count);
void vs_emit_watch(vs_emitter *e, vs_writer *w); /* From now on w also checks for an interrupt whenever its buffer is
                                                  * full. */
/* Returns false when the user interrupts. For loops that write nothing: it checks once in 16384 turns. */
static inline bool vs_emit_going(vs_emitter *e, size_t turn) {
  return (turn & 0x3fff) != 0 || vs_emit_progress(e, "writing", -1);
}
/* Returns triangles of any node of solids and surfaces, in the node's own coordinates: booleans by the kernel, others
 * by geometry. The driver keeps those of nodes that occur at several places; others are valid until the next call.
 * NULL: failed. */
const vs_solid *vs_emit_mesh(vs_emitter *e, const vs_ref *ref);
/* The materials and layers inside a node: BARE if some part has no material of its own, PAINTED if some part has one,
 * LAYERED if some part has a layer of its own. Writers use them to decide whether the text must paint the node. */
enum { VS_LOOKS_BARE = 1, VS_LOOKS_PAINTED = 2, VS_LOOKS_LAYERED = 4 };
unsigned vs_emit_looks(const vs_emitter *e, const vs_node *n);
static inline bool vs_emit_is_bare(const vs_emitter *e, const vs_node *n) {
  return (vs_emit_looks(e, n) & VS_LOOKS_BARE) != 0;
}
static inline bool vs_emit_is_painted(const vs_emitter *e, const vs_node *n) {
  return (vs_emit_looks(e, n) & VS_LOOKS_PAINTED) != 0;
}
/* The drawing's materials, numbered from 1 in the order of the walk; 0: none. They are known before begin is called. */
size_t vs_emit_material_count(const vs_emitter *e);
const vs_material *vs_emit_material_at(const vs_emitter *e, size_t number);
size_t vs_emit_material_number(const vs_emitter *e, const vs_material *m);
/* Writes the number of a template or a material. The driver changes these numbers in text that it keeps and writes
 * again. Therefore every such number inside the walk goes through these two functions. */
bool vs_emit_put_template_number(vs_emitter *e, uint32_t id);
bool vs_emit_put_material_number(vs_emitter *e, const vs_material *m);
/* Returns the origin of the objects on a line of the text (keep_origins), or NULL. */
const vs_origin *vs_emit_line_origin(const vs_emitter *e, uint32_t line);
/* Grows an array of the emitter's state by half, in memory from the store's allocator. `size` is that of an item.
 * Returns false, and sets the error, when memory is out. */
bool vs_emit_grow(vs_emitter *e, void *array, size_t *room, size_t need, size_t size);
void vs_emit_release(vs_emitter *e, void *array, size_t room, size_t size);

/* Writes another file, whole or not at all; while `fill` runs, e->out goes to it. */
bool vs_emit_file(vs_emitter *e, const char *path, bool (*fill)(vs_emitter *e));

/* ---- driver.c ---- */
bool vs_drive_scene(vs_emitter *e); /* Writes begin, definitions, the drawing and end. */
void vs_drive_free(vs_emitter *e);

#endif
