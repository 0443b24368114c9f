/* Owns what the files of the X3D back-end share. x3d_collect.c: the drawing as groups of shapes; repeats.c: what
 * repeats becomes templates; bake.c: which groups become triangles;
 * x3d_notation.c: the two notations; x3d_scene.c: what is written. Beside them, with collecting of its own: packed.c,
 * the tree as bytes for our own viewer; page.c, the web page round that.
 *
 * Viewers draw a Shape slowly and a triangle fast: past some ten thousand Shapes they crawl. Therefore everything is
 * collected first. Few enough boxes, spheres, cylinders and cones become nodes of their own; all else becomes one
 * triangle set and one line set a material. A template is a group that stands once in the file (DEF) and is used (USE);
 * where there would be too many Shapes the innermost templates are baked first: that costs the least text, for they are
 * still said once. */
#ifndef VS_BACKENDS_X3D_X3D_H
#define VS_BACKENDS_X3D_X3D_H

#include "backends/backend.h"

enum { VS_X3D_NATIVE_MAX = 1500 }; /* Shapes of their own, at most */
/* Bytes of baked forms, about, from which on they are cut coarsely, and beyond which copies of templates stay copies:
 * browsers show some 2 MB of triangles in a second. */
#define VS_X3D_BAKED_MOST 30e6
#define VS_X3D_SHAPE_BYTES 10e3 /* triangles that x3dom and X_ITE open and draw in the time of one more Shape: a
                                 * megabyte for some hundred */
enum { VS_X3D_COARSEST = 8 };        /* facets a turn */
#define VS_X3D_COARSE_CREASE 1.0     /* radians: more than from one such facet to the next, less than from a wall to its
                                      * lid */

/* ---- x3d_collect.c ---- */

/* unit forms: half sizes 1, on X3D's Y */
typedef enum { VS_X3D_BOX, VS_X3D_SPHERE, VS_X3D_CYLINDER, VS_X3D_CONE } vs_x3d_form;

typedef struct {
  vs_ref ref;
  vs_affine placement;         /* of the node */
  uint32_t paint;              /* material number */
  vs_x3d_form form;
} vs_x3d_item;

typedef struct { uint32_t group, paint; vs_affine placement; } vs_x3d_placed; /* a template's use */

/* All that one material paints. Number 0: no material; inside a template that is the paint of where it is used. */
typedef struct {
  vs_vec3 *vertices, *normals; /* side by side */
  size_t vertex_count, vertex_room, normal_room;
  uint32_t (*triangles)[3];
  size_t triangle_count, triangle_room;
  vs_vec3 *points;             /* of lines */
  size_t point_count, point_room;
  uint32_t *lines;             /* indices into points, UINT32_MAX ends a line */
  size_t line_count, line_room;
} vs_x3d_batch;

typedef enum { VS_X3D_XML, VS_X3D_CLASSIC } vs_x3d_notation;

/* The drawing (group 0) or a template, by its number. */
typedef struct {
  vs_x3d_item *items;
  size_t item_count, item_room;
  vs_x3d_placed *uses;
  size_t use_count, use_room;
  vs_x3d_batch *batches;       /* one a material and one for none; NULL: nothing is triangles */
  bool bare;                   /* something in it takes the paint of where it is used */
  uint32_t *paints;            /* in which it is used: only 0 where it is not bare */
  size_t paint_count, paint_room;
} vs_x3d_group;

typedef struct {
  vs_x3d_notation notation;
  vs_x3d_group *groups;
  size_t group_count, group_room, group; /* group: what is being collected */
  size_t batch_count;          /* of each group that has batches */
  uint64_t collected;          /* triangles, of all batches */
  int least;                   /* facets a turn, at least, of round forms that are baked; 0: as everywhere */
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
