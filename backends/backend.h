/* Owns the shape of a back-end: what a format's folder gives the driver, and what the driver gives back.
 *
 * The driver (driver.c) walks the drawing without recursion. For every node that the format draws it calls the kind's
 * emit function: once, with phase VS_PHASE_LEAF, for what has no children to go into (a primitive, or a profile with
 * its sweep); twice, VS_PHASE_ENTER and VS_PHASE_LEAVE, round the children of an operation. A kind without a function,
 * or one whose function answers VS_LOWER before it has written anything, is replaced by simpler kinds and asked again;
 * a shared node is lowered once. Simpler kinds may be a tree: it is walked in the node's place.
 * Nodes that draw nothing (empty, or of a class the format leaves out) are not shown to the emitter, and a union or
 * difference that is left with one operand is that operand.
 * A format with `define` gets subtrees that stand in several places, and those cut off past a depth of VS_DEPTH_MAX,
 * once each before the drawing, and where they are used a call of `use`. */
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
}; /* of nesting in one subtree of the output: POV-Ray and OpenSCAD die of some thousands; users read less */

typedef enum {
  VS_EMITTED,
  VS_WHOLE,  /* at VS_PHASE_ENTER: written with all that is in it; the driver does not go in */
  VS_LOWER,
  VS_FAILED
} vs_emit_status;
typedef enum { VS_PHASE_LEAF, VS_PHASE_ENTER, VS_PHASE_LEAVE } vs_phase;

typedef struct vs_emitter vs_emitter;
typedef struct vs_drive vs_drive; /* the driver's own, driver.c */
typedef vs_emit_status vs_emit_fn(vs_emitter *e, const vs_ref *ref, vs_phase phase);

/* The numbers that make a curve as thick on the picture near and far: its radius at a place is share times the depth
 * from eye along forward, but at least `least`;
 * in a parallel view forward is 0 0 0, and the radius `least`. Model units. */
typedef struct { vs_vec3 eye, forward; double share, least; } vs_pen;

struct vs_emitter {
  vs_writer *out;
  const vs_scene *scene;
  const vs_export_options *options;
  const vs_backend *backend;
  vs_error *error;
  const char *path;    /* of the file being made, for names beside it; NULL: there is none */
  const char *folder;  /* of a worker, for files that its text names; NULL: there is none */
  void *state;         /* the back-end's own, made by begin and freed by close */
  vs_fineness drawing_facets; /* of what stands unplaced */
  vs_fineness facets;    /* in the coordinates of what is being written: finer where its placement makes it larger */
  vs_bounds bounds;    /* of everything drawn; never empty */
  vs_pen pen;          /* POV-Ray: how thick curves are drawn */
  double chord;        /* how high chords are, in parts of the drawing's tolerance: 1, or less in a picture */
  double unit;         /* POV-Ray: how long a model unit is in its scene; see povray_scene.c */
  vs_bounds framed;    /* what a camera frames: without what is cut away */
  vs_bounds *boxes;    /* of its parts: tighter together than the one; what a camera frames */
  size_t box_count, box_room;
  size_t depth;        /* of nesting now, for indentation */
  size_t child_count;  /* at VS_PHASE_ENTER: operands that will follow, at least 1; 1 only for a placement or paint */
  size_t child_index;  /* which operand of its parent this node is */
  const vs_node *body;   /* the template that is being written, or NULL */
  const vs_node *parent; /* the operation round this node, or NULL */
  bool smooth;         /* this mesh stands for a curved thing: shade it round */
  bool in_boolean;     /* inside an intersection or a difference */
  bool carved;         /* at VS_PHASE_ENTER: the node stands in one somewhere in the drawing, here or elsewhere */
  /* Everything painted or placed so far on the way down. */
  const vs_material *material; /* or NULL */
  vs_affine placement;
  vs_bounds reach;     /* in the coordinates of what is being written: where a half-space must be right */
  vs_drive *drive;
  uint64_t triangles;  /* written so far: vs_emit_triangles */
};

struct vs_backend {
  bool (*begin)(vs_emitter *e);
  bool (*item)(vs_emitter *e, size_t index, bool end); /* round each thing drawn; may be NULL */
  bool (*end)(vs_emitter *e);
  void (*close)(vs_emitter *e); /* also after a failure; may be NULL */
  /* Template `id` from 1. open: before its body; !open: after it. Both or neither. */
  bool (*define)(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open);
  bool (*use)(vs_emitter *e, uint32_t id, const vs_ref *ref);
  /* Formats of triangles alone get the union of the drawing's solids instead of a walk, settled for their numbers
   * (kernel/round/rounding.h). */
  bool (*solid)(vs_emitter *e, const vs_solid *solid);
  bool (*copies)(vs_emitter *e, const vs_solid_copies *copies); /* the same with equal parts once; instead of solid */
  vs_numbers numbers;
  /* Runs a worker on the written text. NULL: the text is the output. */
  bool (*render)(vs_emitter *e, const char *text_path, const char *output_path);
  /* Writes what belongs beside e->path (an .mtl), after the text. NULL: nothing. */
  bool (*beside)(vs_emitter *e);
  vs_mark_style highlights, ghosts; /* how it shows them (passes/sugar.h) */
  bool ghosts_in_drafts;   /* and ghosts in pictures of the draft quality alone */
  const char *family;      /* a name for several formats, beside their own; NULL: its own alone */
  const char *native;      /* whose text of `native` it takes, of targets.def; NULL: none */
  bool keep_origins;    /* the text's lines are remembered with the origins of what they hold */
  bool parts_flush;     /* its program keeps skins where faces in one plane are cut: they are parted before (flush.h) */
  bool hulls; /* knows hulls of solids: they are shown as operations; all others, and elsewhere all, as one shape */
  bool draws;           /* makes drawings: it chooses among the scene's views, cuts by itself, and asks for the
                         * solids (vs_lower_drawing): `solid` gets none */
  bool frames;          /* shows the drawing through a camera that frames it */
  bool loose;           /* with solid or copies: what is no solid is walked first, by the rows of emit */
  bool inks;            /* thin things without a material are painted dark before (ink.h) */
  bool lays;            /* its patterns lie on faces rightly where no placement turns them (lay.h) */
  bool groups;          /* large sets are handed over as trees of boxes (vs_sets_group) */
  bool area_sets;       /* is asked about sets of regions before they are lowered to one region */
  bool
      keeps_text; /* what it writes for a node is decided by what drive_key puts into a key, and by nothing that it
                   * wrote before */
  bool verbatim;        /* every node is shown as it is, empty ones too, and the children of all kinds are gone into */
  const char *omit[VS_MIXED]; /* a vs_class that the format leaves out, and why: said once */
  vs_emit_fn *shape;    /* of the primitive solids that have no row of their own; NULL: they are lowered */
  struct { vs_emit_fn *fn; const char *lossy; } emit[VS_KIND_COUNT]; /* lossy: said once as a warning */
};

/* The function that writes n; NULL: n is lowered. */
static inline vs_emit_fn *vs_backend_writes(const vs_backend *b, const vs_node *n) {
  vs_emit_fn *fn = b->emit[n->kind].fn;
  return fn || vs_node_role(n) != VS_ROLE_SHAPE || n->flags & VS_NODE_ENDLESS ? fn : b->shape;
}

#define VS_FORMAT(suffix, backend, name, worker, binary, doc) extern const vs_backend vs_backend_##backend;
#include "backends/backends.def"

/* The rows of formats that show triangles and lines where they stand: leaf makes triangles of what is solid or thin,
 * line takes polylines, through follows placement and paint, boolean has the kernel. A kind without a row is lowered:
 * curves to polylines. */
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

/* ---- what emit functions may call ---- */
bool vs_emit_fail(vs_emitter *e, const vs_ref *ref,
                  const char *message); /* a fault of the model, at the reference; returns false */
bool vs_emit_warn_once(vs_emitter *e, const vs_ref *ref,
                       const char *message); /* once a message (compared by address) */
bool vs_emit_no_memory(vs_emitter *e);
bool vs_emit_progress(vs_emitter *e, const char *stage,
                      double fraction); /* false: interrupted, and the error says so */
/* Counts the triangles that are written, or are about to be: those of a template once. False: more than the limit, and
 * the error says so. */
bool vs_emit_triangles(vs_emitter *e, size_t count);
void vs_emit_watch(vs_emitter *e, vs_writer *w); /* from now on w asks so, too, whenever its buffer is full */
/* For loops that write nothing: asks now and then. */
static inline bool vs_emit_going(vs_emitter *e, size_t turn) {
  return (turn & 0x3fff) != 0 || vs_emit_progress(e, "writing", -1);
}
/* Triangles of any node of solids and surfaces in its own coordinates: booleans by the kernel, the rest by geometry.
 * Kept for nodes that stand in several places; valid until the next call. NULL: failed. */
const vs_solid *vs_emit_mesh(vs_emitter *e, const vs_ref *ref);
/* Must the text paint the node? Does anything in the node lack a material of its own; does anything have one, or a
 * layer of its own? */
enum { VS_LOOKS_BARE = 1, VS_LOOKS_PAINTED = 2, VS_LOOKS_LAYERED = 4 };
unsigned vs_emit_looks(const vs_emitter *e, const vs_node *n);
static inline bool vs_emit_is_bare(const vs_emitter *e, const vs_node *n) {
  return (vs_emit_looks(e, n) & VS_LOOKS_BARE) != 0;
}
static inline bool vs_emit_is_painted(const vs_emitter *e, const vs_node *n) {
  return (vs_emit_looks(e, n) & VS_LOOKS_PAINTED) != 0;
}
/* The drawing's materials, numbered from 1 in the order met; 0: none. Known from begin on. */
size_t vs_emit_material_count(const vs_emitter *e);
const vs_material *vs_emit_material_at(const vs_emitter *e, size_t number);
size_t vs_emit_material_number(const vs_emitter *e, const vs_material *m);
/* Puts out the number of a template or a material. Text that is kept to be written again has it changed there: so those
 * of the walk go this way alone. */
bool vs_emit_put_template_number(vs_emitter *e, uint32_t id);
bool vs_emit_put_material_number(vs_emitter *e, const vs_material *m);
/* The origin of what stands on a line of the text (keep_origins), or NULL. */
const vs_origin *vs_emit_line_origin(const vs_emitter *e, uint32_t line);
/* Memory of the emitter's state, from the store's allocator; grows by half. Items of `size`; false: out of memory,
 * error set. */
bool vs_emit_grow(vs_emitter *e, void *array, size_t *room, size_t need, size_t size);
void vs_emit_release(vs_emitter *e, void *array, size_t room, size_t size);

/* Writes another file, whole or not at all, with e->out turned to it while `fill` runs. */
bool vs_emit_file(vs_emitter *e, const char *path, bool (*fill)(vs_emitter *e));

/* ---- driver.c ---- */
bool vs_drive_scene(vs_emitter *e); /* begin, definitions, the drawing, end */
void vs_drive_free(vs_emitter *e);

#endif
