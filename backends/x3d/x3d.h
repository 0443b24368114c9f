/* Owns the declarations that the files of the X3D back-end share. x3d_collect.c: the drawing as groups of shapes;
 * repeats.c: repeats become templates; bake.c: the groups that become triangles; x3d_notation.c: the two notations;
 * x3d_scene.c: the contents of the file. Two more files collect by themselves: packed.c, the tree as bytes for
 * VisualScheme's own viewer; page.c, the web page around it.
 *
 * Viewers draw a Shape slowly and a triangle fast: with more than some ten thousand Shapes they are too slow to use.
 * Therefore everything is collected first. Boxes, spheres, cylinders and cones become nodes if they are few; all other
 * objects become one triangle set and one line set for each material. A template is a group that the file contains once
 * (DEF) and uses (USE). If there are too many Shapes, the innermost templates are baked first: that costs the least
 * text, since the file still contains each once. */
#ifndef VS_BACKENDS_X3D_X3D_H
#define VS_BACKENDS_X3D_X3D_H

#include "backends/backend.h"

enum { VS_X3D_NATIVE_MAX = 1500 }; /* the most Shapes */
/* The approximate bytes of baked forms above which they are divided coarsely, and copies of templates stay copies:
 * browsers show some 2 MB of triangles in a second. */
#define VS_X3D_BAKED_MOST 30e6
#define VS_X3D_SHAPE_BYTES 10e3 /* the bytes of triangles that x3dom and X_ITE open and draw in the time of one more
                                 * Shape: a megabyte for some hundred */
enum { VS_X3D_COARSEST = 8 };        /* facets in a full turn */
#define VS_X3D_COARSE_CREASE 1.0     /* radians: more than the angle between two such facets, less than that between a
                                      * wall and its lid */

/* ---- x3d_collect.c ---- */

/* unit forms: half sizes 1, along X3D's Y */
typedef enum { VS_X3D_BOX, VS_X3D_SPHERE, VS_X3D_CYLINDER, VS_X3D_CONE } vs_x3d_form;

typedef struct {
  vs_ref ref;
  vs_affine placement;         /* of the node */
  uint32_t paint;              /* material number */
  vs_x3d_form form;
} vs_x3d_item;

typedef struct { uint32_t group, paint; vs_affine placement; } vs_x3d_placed; /* a template's use */

/* All triangles and lines of one material. Number 0: no material; inside a template that is the paint at its use. */
typedef struct {
  vs_vec3 *vertices, *normals; /* arrays of equal length */
  size_t vertex_count, vertex_room, normal_room;
  uint32_t (*triangles)[3];
  size_t triangle_count, triangle_room;
  vs_vec3 *points;             /* of lines */
  size_t point_count, point_room;
  uint32_t *lines;             /* indices into points; UINT32_MAX ends a line */
  size_t line_count, line_room;
} vs_x3d_batch;

typedef enum { VS_X3D_XML, VS_X3D_CLASSIC } vs_x3d_notation;

/* The drawing (group 0) or a template, by its number. */
typedef struct {
  vs_x3d_item *items;
  size_t item_count, item_room;
  vs_x3d_placed *uses;
  size_t use_count, use_room;
  vs_x3d_batch *batches;       /* one for each material and one for none; NULL: there are no triangles or lines */
  bool bare;                   /* some part takes the paint at its use */
  uint32_t *paints;            /* the paints in which it is used: only 0 if it is not bare */
  size_t paint_count, paint_room;
} vs_x3d_group;

typedef struct {
  vs_x3d_notation notation;
  vs_x3d_group *groups;
  size_t group_count, group_room, group; /* group: the group that is being collected */
  size_t batch_count;          /* of each group with batches */
  uint64_t collected;          /* the number of triangles in all batches */
  int least;                   /* the least facets in a full turn for round forms that are baked; 0: as in other
                                * formats */
  /* x3d_notation.c */
  size_t depth;
  bool in_tag;
} vs_x3d;

void vs_x3d_close(vs_emitter *e);
vs_emit_fn vs_x3d_leaf, vs_x3d_line, vs_x3d_through, vs_x3d_boolean;
bool vs_x3d_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open);
bool vs_x3d_use_template(vs_emitter *e, uint32_t id, const vs_ref *ref);

#define VS_X3D_BACKEND(begin_, end_)                                                                                   \
  .begin = begin_, .end = end_, .close = vs_x3d_close, .define = vs_x3d_define, .use = vs_x3d_use_template,            \
  .family = "x3d", .frames = true, .highlights = VS_MARKS_PAINT, \
  VS_EMIT_SHAPES(vs_x3d_leaf, vs_x3d_line, vs_x3d_through, vs_x3d_boolean)

#endif
