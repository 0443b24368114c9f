/* Contains the declarations for the files of the X3D back-end. The file x3d_collect.c converts the drawing to groups of
 * shapes; bake.c converts shapes that X3D cannot place to triangles. The file x3d_scene.c writes the contents of the
 * file, x3d_notation.c its two notations. Two more files do not use these groups: packed.c writes the tree as bytes for
 * VisualScheme's own viewer, and page.c the web page around it.
 *
 * Everything is collected before the file is written. Boxes, spheres, cylinders and cones are always nodes of their
 * own: other programs read them as such. All other objects become one triangle set and one line set for each material.
 * A template is a group that the file contains once (DEF) and refers to (USE). */
#ifndef VS_BACKENDS_X3D_X3D_H
#define VS_BACKENDS_X3D_X3D_H

#include "backends/backend.h"

/* ---- x3d_collect.c ---- */

/* unit forms with half sizes 1, along X3D's axis Y */
typedef enum { VS_X3D_BOX, VS_X3D_SPHERE, VS_X3D_CYLINDER, VS_X3D_CONE } vs_x3d_form;

typedef struct {
  vs_ref ref;
  vs_affine placement;         /* placement of the object's node */
  uint32_t paint;              /* number of the object's material */
  vs_x3d_form form;
} vs_x3d_item;

typedef struct { uint32_t group, paint; vs_affine placement; } vs_x3d_placed; /* a use of a template: number of the
                                                                               * template, paint and placement */

/* A batch: all triangles and lines of a single material in a group. The shapes in batch number 0 have no material; in a
 * template, they get the paint of the template's use. */
typedef struct {
  vs_vec3 *vertices, *normals; /* positions and unit normals of the vertices of triangles; the arrays have equal
                                * lengths */
  size_t vertex_count, vertex_room, normal_room;
  uint32_t (*triangles)[3];
  size_t triangle_count, triangle_room;
  vs_vec3 *points;             /* points of lines */
  size_t point_count, point_room;
  uint32_t *lines;             /* indices into points; UINT32_MAX ends a line */
  size_t line_count, line_room;
} vs_x3d_batch;

typedef enum { VS_X3D_XML, VS_X3D_CLASSIC } vs_x3d_notation;

/* A group of objects: the drawing (group 0), a template, or a part of the drawing. */
typedef struct {
  vs_x3d_item *items;
  size_t item_count, item_room;
  vs_x3d_placed *uses;
  size_t use_count, use_room;
  vs_x3d_batch *batches;       /* batches[i]: the triangles and lines of material i, or of no material for i = 0; NULL:
                                * the group has no triangles or lines */
  bool bare;                   /* whether a part of the group has no material, and gets the paint of the group's use */
  uint32_t *paints;            /* paints with which the group is used; only 0 if the group is not bare */
  size_t paint_count, paint_room;
  const char *part;            /* name of the drawing's part that the group is; NULL: the group is no part */
} vs_x3d_group;

typedef struct {
  vs_x3d_notation notation;
  vs_x3d_group *groups;
  size_t group_count, group_room, group; /* group: index of the group that is being collected */
  size_t batch_count;          /* length of the array `batches` of each group that has one */
  uint64_t collected;          /* number of triangles in all batches */
  /* Members that x3d_notation.c uses: the depth of nesting, and whether a start tag is open. */
  size_t depth;
  bool in_tag;
} vs_x3d;

void vs_x3d_close(vs_emitter *e);
vs_emit_fn vs_x3d_leaf, vs_x3d_line, vs_x3d_through, vs_x3d_boolean;
bool vs_x3d_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open);
bool vs_x3d_use_template(vs_emitter *e, uint32_t id, const vs_ref *ref);

#define VS_X3D_BACKEND(begin_, end_)                                                                                   \
  .begin = begin_, .end = end_, .close = vs_x3d_close, .define = vs_x3d_define, .use = vs_x3d_use_template,            \
  .family = "x3d", .traits = VS_FRAMES | VS_NAMES, .highlights = VS_MARKS_PAINT, \
  VS_EMIT_SHAPES(vs_x3d_leaf, vs_x3d_line, vs_x3d_through, vs_x3d_boolean)

#endif
