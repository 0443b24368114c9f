/* Declares a back-end: the functions by which a format's folder writes a drawing. The driver (tree_walk.c) calls them.
 * emitter.h declares the functions that they may call in turn.
 *
 * The driver walks the drawing without recursion. It calls the emit function of a node's kind for every node that the
 * format draws. If the driver does not visit a node's children (a primitive, or a profile with its sweep), it calls the
 * emit function once, with phase VS_PHASE_LEAF. For an operation it calls the function twice: VS_PHASE_ENTER before the
 * children and VS_PHASE_LEAVE after them.
 *
 * If a kind has no emit function, or the function returns VS_LOWER before it has written anything, the driver lowers
 * the node: it replaces the node by simpler kinds and tries again. It lowers a shared node once. The simpler kinds may
 * form a tree, which the driver walks in place of the node.
 *
 * An emit function never receives nodes that draw nothing: empty nodes, and nodes of a class that the format omits. If
 * a union or difference has a single operand that draws something, the driver writes only this operand.
 *
 * For a format with `define`, the driver makes templates of subtrees that occur at several places. It also makes
 * templates of the subtrees that lie deeper than VS_DEPTH_MAX. It writes each template once before the drawing, and
 * calls `use` at each place of the template. */
#ifndef VS_BACKENDS_BACKEND_H
#define VS_BACKENDS_BACKEND_H

#include "backends/emitter.h"
#include "backends/export.h"
#include "backends/writer.h"
#include "geometry/tolerance.h"
#include "kernel/round/rounding.h"
#include "solids/solid_meshes.h"
#include "model/mesh.h"
#include "model/node.h"
#include "passes/sugar.h"
#include "model/scene.h"

enum {
  VS_DEPTH_MAX = 150
}; /* VS_DEPTH_MAX: greatest depth of nesting in one subtree of the output, because POV-Ray and OpenSCAD crash at some
    * thousand levels */

typedef enum {
  VS_EMITTED,
  VS_WHOLE,  /* result of an emit function at VS_PHASE_ENTER: the function has written the node with its children, and
              * the driver does not visit the children */
  VS_LOWER,
  VS_FAILED
} vs_emit_status;
typedef enum { VS_PHASE_LEAF, VS_PHASE_ENTER, VS_PHASE_LEAVE } vs_phase;

typedef vs_emit_status vs_emit_fn(vs_emitter *e, const vs_ref *ref, vs_phase phase);

/* Flags of a format, by which the driver decides how to treat the format's drawings. */
typedef enum {
  VS_SHOWS_GHOSTS_IN_DRAFTS = 1 << 0, /* the format shows objects marked as `ghost` only in pictures of draft quality */
  VS_KEEPS_ORIGINS = 1 << 1, /* the emitter records the origin of each line of the text: the place in the user's
                              * program */
  VS_PARTS_FLUSH = 1 << 2,   /* a pass first separates solids whose faces lie in one plane (flush.h): the format's
                              * program leaves thin skins when it cuts such solids */
  VS_SHOWS_HULLS = 1 << 3,   /* the format writes hulls of solids as operations, and every other hull as one shape */
  VS_DRAWS = 1 << 4,         /* the format is a drawing on sheets. It selects the scene's views and cuts the solids
                              * itself (vs_lower_drawing); its function `solid` is not called with solids */
  VS_FRAMES = 1 << 5,        /* the format shows the model through a camera, which is placed so that the whole model is
                              * visible */
  VS_LOOSE = 1 << 6,         /* for a format with `solid` or `copies`: the driver first walks the objects that are not
                              * solids, and calls their functions in `emit` */
  VS_INKS = 1 << 7,          /* a pass gives a dark material to thin objects without a material (ink.h) */
  VS_LAYS = 1 << 8,          /* the format draws patterns correctly only on faces that no placement rotates (lay.h) */
  VS_GROUPS = 1 << 9,        /* the driver first converts sets of very many parts to trees of boxes (vs_sets_group) */
  VS_AREA_SETS = 1 << 10,    /* the format's emit function receives unions and differences of regions; for other formats
                              * the driver first computes a single region */
  VS_KEEPS_TEXT = 1 << 11,   /* the text of a node depends only on the values in its cache key, not on earlier output,
                              * so that it can be cached for the next output */
  VS_TURNS = 1 << 13,        /* the option --up y rotates the drawing for this format, which prescribes no upward
                              * axis */
  VS_UNITS = 1 << 15,        /* the option --units converts the lengths of the drawing for this format */
  VS_NAMES = 1 << 14,      /* the format has a name for each part of the drawing (solids/named_parts.h) */
  VS_VERBATIM = 1 << 12      /* the driver emits every node as it is, including empty nodes, and visits the children of
                              * all kinds */
} vs_backend_trait;

struct vs_backend {
  bool (*begin)(vs_emitter *e);
  bool (*item)(vs_emitter *e, size_t index, bool end); /* called before (end false) and after (end true) the drawn
                                                        * object number `index`; may be NULL */
  bool (*end)(vs_emitter *e);
  void (*close)(vs_emitter *e); /* frees the back-end's data (the emitter's `state`), also after a failure; may be
                                 * NULL */
  /* Writes the beginning (open) or the end (!open) of the template with number `id`, counted from 1. A back-end has
   * both `define` and `use`, or neither. */
  bool (*define)(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open);
  bool (*use)(vs_emitter *e, uint32_t id, const vs_ref *ref);
  /* Writes the union of the drawing's solids, for formats that contain only triangles; the driver then does not walk
   * the drawing. The mesh is rounded to the numbers that the format can store (kernel/round/rounding.h). */
  bool (*solid)(vs_emitter *e, const vs_solid *solid);
  bool (*copies)(vs_emitter *e, const vs_solid_copies *copies); /* Writes the union of the drawing's solids, in which
                                                                 * each group of equal parts is stored once. A back-end
                                                                 * has `copies` or `solid`, not both. */
  vs_numbers numbers;
  bool objects; /* whether the mesh of all solids keeps the faces of different objects separate */
  /* Runs a worker program on the written text. NULL: the text itself is the output. */
  bool (*render)(vs_emitter *e, const char *text_path, const char *output_path);
  /* Writes further files beside the file e->path, such as an .mtl. NULL: the format has no such files. */
  bool (*beside)(vs_emitter *e);
  vs_mark_style highlights, ghosts; /* how the format shows the marks `highlight` and `ghost` (passes/sugar.h) */
  const char *family;      /* name that several formats have in common, such as "povray" for .png, or NULL */
  const char *native;      /* name of the program (a row of targets.def) whose language the user may write in `native`
                            * objects for this format; NULL: the format accepts no such text */
  unsigned traits;      /* traits of the format: values of vs_backend_trait, joined by | */
  const char *omit[VS_MIXED]; /* omit[c]: warning, given once, that the format omits objects of class c; NULL: the
                               * format shows them */
  vs_emit_fn *shape;    /* emits the primitive solids that have no function in `emit`; NULL: the driver replaces them by
                         * simpler kinds */
  /* fn: function that writes nodes of this kind. lossy: warning, given once, that the format shows this kind
   * incompletely or inexactly; NULL: the format shows it exactly */
  struct { vs_emit_fn *fn; const char *lossy; } emit[VS_KIND_COUNT];
};

static inline bool vs_backend_has(const vs_backend *b, vs_backend_trait trait) { return (b->traits & trait) != 0; }

/* Returns the function that writes n. Returns NULL if the driver must replace n by simpler kinds. */
static inline vs_emit_fn *vs_backend_writes(const vs_backend *b, const vs_node *n) {
  vs_emit_fn *fn = b->emit[n->kind].fn;
  return fn || vs_node_role(n) != VS_ROLE_SHAPE || n->flags & VS_NODE_ENDLESS ? fn : b->shape;
}

#define VS_FORMAT(suffix, backend, name, worker, binary, doc) extern const vs_backend vs_backend_##backend;
#include "backends/backends.def"

/* The table `emit` for formats that contain triangles and lines with their positions. It names the functions that write
 * triangles (`leaf`), polylines (`line`), placements and paint (`through`), and combinations of solids (`boolean`). The
 * driver replaces all other kinds by simpler kinds. */
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
            [VS_PART] = { through, NULL },                                                                            \
            [VS_UNION] = { through, NULL },                                                                            \
            [VS_INTERSECTION] = { boolean, NULL },                                                                     \
            [VS_DIFFERENCE] = { boolean, NULL } }

/* Writes another file than e->path, completely or not at all. While the function `fill` runs, e->out writes to that
 * file. */
bool vs_emit_file(vs_emitter *e, const char *path, bool (*fill)(vs_emitter *e));

#endif
