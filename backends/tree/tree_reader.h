/* Declares the reading of a drawing from the tree dump that tree.c writes. For tests, and for passing models between
 * programs. */
#ifndef VS_BACKENDS_TREE_TREE_READER_H
#define VS_BACKENDS_TREE_TREE_READER_H

#include "model/scene.h"

/* Adds the objects in the text to the drawing of the scene. The scene's store allocates the nodes. Returns false on
 * failure: the error contains the line, and the scene may have received a part of the objects. */
bool vs_tree_read(vs_scene *scene, const char *text, size_t length, vs_error *e);

#endif
