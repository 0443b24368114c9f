/* Contains the table of the primitive solids, indexed by kind. */
#include "geometry/primitives/shape.h"

const vs_shape *vs_shape_of(const vs_node *n) {
  static const vs_shape *const shapes[] = {
#define VS_ENTRY_SHAPE(lower) &vs_shape_##lower
#define VS_ENTRY_LEAF(lower) NULL
#define VS_ENTRY_MADE(lower) NULL
#define VS_ENTRY_PLACED(lower) NULL
#define VS_ENTRY_WRAPPER(lower) NULL
#define VS_ENTRY_SET(lower) NULL
#define VS_KIND(upper, lower, name, class_, level, role, traits) [VS_##upper] = VS_ENTRY_##role(lower),
#define VS_FIELD(type, member, argument)
#define VS_KIND_END(upper, lower)
#include "model/prims.def"
  };
  return shapes[n->kind];
}
