/* Declares the emitter: the output and the current state of the walk over the drawing. Each emit function receives the
 * emitter. Also declares the functions of the driver that emit functions may call. */
#ifndef VS_BACKENDS_EMITTER_H
#define VS_BACKENDS_EMITTER_H

#include "backends/export.h"
#include "backends/writer.h"
#include "geometry/tolerance.h"
#include "model/scene.h"
#include "solids/solid_meshes.h"

typedef struct vs_emitter vs_emitter;
typedef struct vs_drive vs_drive; /* private to the driver (drive.h) */

/* Thickness of curves in the picture: constant, both near and far. The radius of a curve at a point is `share` times
 * the depth of the point from `eye` along `forward`, but at least `least`, in model units. */
typedef struct { vs_vec3 eye, forward; double share, least; } vs_pen;

struct vs_emitter {
  vs_writer *out;
  const vs_scene *scene;
  const vs_export_options *options;
  vs_job *job;         /* limits, messages and progress of the output, from the caller's options; without options, a job
                        * without limits */
  const vs_backend *backend;
  vs_error *error;
  vs_error flaw;       /* fault of an output file that is nevertheless complete; it is reported after the file is in its
                        * place */
  const char *path;    /* path of the output file, from which the names of further files beside it are formed; NULL:
                        * there is no output file */
  const char *folder;  /* folder of the worker program, for files that the text refers to; NULL: there is no such
                        * folder */
  void *state;         /* data of the back-end; its `begin` allocates them and its `close` frees them */
  vs_fineness drawing_facets; /* fineness (size of facets) of objects outside all placements */
  vs_fineness facets;    /* fineness (size of facets) in the coordinates of the current output: finer inside a placement
                          * that enlarges */
  vs_bounds bounds;    /* bounds of the entire drawing; never empty */
  vs_pen pen;          /* thickness of curves in POV-Ray */
  double chord;        /* greatest distance of a chord from its arc, as a fraction of the drawing's tolerance: 1, or
                        * less in a rendered picture */
  double unit;         /* length of a model unit in POV-Ray's scene; see povray_scene.c */
  vs_bounds framed;    /* bounds that a camera shows: those of the drawing without the material that cuts remove */
  vs_bounds *boxes;    /* bounds of the drawing's parts, which the camera shows; together they are smaller than
                        * `framed` */
  size_t box_count, box_room;
  size_t depth;        /* current depth of nesting, for indentation */
  size_t child_count;  /* at VS_PHASE_ENTER: number of operands of the operation that draw something: 1 for a placement
                        * or paint, above 1 for other operations */
  size_t child_index;  /* index of this node among the operands of its parent */
  const vs_node *body;   /* template whose body is being written, or NULL */
  const vs_node *parent; /* operation that contains this node, or NULL */
  bool smooth;         /* whether the current mesh represents a curved object and needs smooth shading */
  bool in_boolean;     /* true if this node is inside an intersection or a difference */
  bool carved;         /* at VS_PHASE_ENTER: whether the node occurs in an intersection or difference at any of its
                        * places in the drawing */
  /* Material, layer and placement of the current node, computed from all operations above it. */
  const vs_material *material; /* material of the node, or NULL */
  const char *layer;   /* name of the innermost layer around the node or, if there is none, of the part; or NULL */
  const char *part;    /* name of the part to which the node belongs, or NULL */
  vs_affine placement;
  vs_bounds reach;     /* space outside which a half-space has no effect, in the coordinates of the current output */
  vs_drive *drive;
  uint64_t triangles;  /* number of triangles written so far, counted by vs_emit_triangles */
};

/* ---- functions for emit functions ---- */

bool vs_emit_fail(vs_emitter *e, const vs_ref *ref,
                  const char *message); /* Reports a fault of the model, with the place of ref; returns false. */
bool vs_emit_warn_once(vs_emitter *e, const vs_ref *ref,
                       const char *message); /* Gives a warning with the place of ref, once for each message; messages
                                              * are compared by address. */
bool vs_emit_no_memory(vs_emitter *e);
bool vs_emit_progress(vs_emitter *e, const char *stage,
                      double fraction); /* Reports the completed fraction of the work, 0 to 1. Returns false if the user
                                         * interrupts; e's error is then set. */
/* Adds `count` triangles, written now or later, to e->triangles. The triangles of a template count once. Returns false,
 * and sets the error, if the sum exceeds the limit. */
bool vs_emit_triangles(vs_emitter *e, size_t count);
void vs_emit_watch(vs_emitter *e, vs_writer *w); /* Makes the writer w test for an interrupt each time its buffer is
                                                  * full. */
/* Returns false if the user interrupts. For loops that write nothing. turn: number of the iteration; it tests only in
 * every 16384th iteration. */
static inline bool vs_emit_going(vs_emitter *e, size_t turn) {
  return (turn & 0x3fff) != 0 || vs_emit_progress(e, "writing", -1);
}
/* Returns the triangles of a solid or surface, in the node's own coordinates. If a node occurs at several places, the
 * driver keeps its triangles; those of other nodes are valid until the next call. Returns NULL on failure. */
const vs_solid *vs_emit_mesh(vs_emitter *e, const vs_ref *ref);
/* Flags for the materials and layers inside a node. BARE: some part has no material of its own. PAINTED: some part has
 * a material of its own. LAYERED: some part has a layer of its own. Writers use the flags to decide whether the text
 * must paint the node. */
enum { VS_LOOKS_BARE = 1, VS_LOOKS_PAINTED = 2, VS_LOOKS_LAYERED = 4 };
unsigned vs_emit_looks(const vs_emitter *e, const vs_node *n);
static inline bool vs_emit_is_bare(const vs_emitter *e, const vs_node *n) {
  return (vs_emit_looks(e, n) & VS_LOOKS_BARE) != 0;
}
static inline bool vs_emit_is_painted(const vs_emitter *e, const vs_node *n) {
  return (vs_emit_looks(e, n) & VS_LOOKS_PAINTED) != 0;
}
/* vs_emit_material_count returns the number of the drawing's materials. They are numbered from 1 in the order of the
 * walk; the number 0 means no material. The numbers are known before `begin` is called. */
size_t vs_emit_material_count(const vs_emitter *e);
const vs_material *vs_emit_material_at(const vs_emitter *e, size_t number);
size_t vs_emit_material_number(const vs_emitter *e, const vs_material *m);
/* vs_emit_put_template_number and vs_emit_put_material_number write a number that may change: if the text is cached and
 * written again, the driver replaces it by the current number. Inside the walk, every number of a template or material
 * must therefore be written by one of them. */
bool vs_emit_put_template_number(vs_emitter *e, uint32_t id);
bool vs_emit_put_material_number(vs_emitter *e, const vs_material *m);
/* Returns the origin (place in the program) of the objects on a line of the text, or NULL. For formats with
 * VS_KEEPS_ORIGINS. */
const vs_origin *vs_emit_line_origin(const vs_emitter *e, uint32_t line);
/* Grows an array of the emitter's state to at least `need` items, and by at least half, in memory from the store's
 * allocator. `size` is the size of an item in bytes. Returns false, and sets the error, if memory is out. */
bool vs_emit_grow(vs_emitter *e, void *array, size_t *room, size_t need, size_t size);
void vs_emit_release(vs_emitter *e, void *array, size_t room, size_t size);

#endif
