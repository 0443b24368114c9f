/* Owns the way back: a drawing from the tree dump that tree.c writes. For tests, and for handing models between
 * programs. */
#ifndef VS_BACKENDS_TREE_TREE_READER_H
#define VS_BACKENDS_TREE_TREE_READER_H

#include "model/scene.h"

/* Draws what the text holds into the scene, whose store makes the nodes. false: the error names the line; the scene may
 * have got part. */
bool vs_tree_read(vs_scene *scene, const char *text, size_t length, vs_error *e);

#endif
