/* Declares the treatment of materials and layers in sets, offsets and hulls of regions, which become a single
 * region. */
#ifndef VS_PASSES_LOOKS_H
#define VS_PASSES_LOOKS_H

#include "model/scene.h"

/* Moves materials and layers out of flat differences, intersections, offsets, hulls and filled curves, so that each of
 * these has one material and one layer. Rewrites the scene's drawn array. Returns false, with e set, if memory is out
 * or the run is interrupted. */
bool vs_scene_looks(vs_scene *scene, vs_error *e);

#endif
