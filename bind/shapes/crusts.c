/* Owns shells: a surface with thickness, a solid made hollow. */
#include "bind/build.h"
#include "bind/call/refuse.h"
#include "bind/measures.h"
#include "bind/objects.h"
#include "bind/print.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/files/polyface.h"
#include "geometry/profiles/thicken.h"
#include "model/store/array.h"

/* (make-crust o thickness #:side): 'in, 'out or 'both */
vs_status vs_p_make_crust(vs_args *f, vs_value *out) {
  double t = f->arg[1].real, outwards = 0, inwards = t;
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_node *o = f->arg[0].ref.node;
  if (vs_bind_is_empty(o)) return vs_bind_empty(f, "there is nothing to make a crust of", out);
  if (o->class_ != VS_SOLID && o->class_ != VS_SURFACE)
    return vs_bind_refuse(f, "o", "a solid or a surface", f->arg[0].value);
  if (f->key[0].given) {
    const char *side = vs_as_symbol(f->key[0].value)->name;
    bool both = !strcmp(side, "both"), outside = !strcmp(side, "out");
    if (!both && !outside && strcmp(side, "in"))
      return vs_bind_refuse(f, "side", "'in, 'out or 'both", f->key[0].value);
    outwards = both ? t / 2 : outside ? t : 0, inwards = t - outwards;
  }
  vs_mesh m = { 0 }, shell = { 0 };
  vs_vec3 at;
  bool turns = false;
  vs_error e = { 0 };
  vs_status status = vs_bend_triangles(f, f->arg[0].ref, &m);
  if (status && !vs_thicken_surface(&m, outwards, inwards, &shell, &at, &turns)) status = vs_fail_memory(f->vm);
  if (status && turns) {
    char x[32], y[32], z[32];
    vs_bind_number_text(x, at.x), vs_bind_number_text(y, at.y), vs_bind_number_text(z, at.z);
    status = vs_fail(f->vm, f->vm->sym.range, "the surface bends more tightly than the thickness near (xyz %s %s %s)",
                     x, y, z);
  }
  uint32_t *starts = NULL;
  size_t room = 0;
  vs_node *node = NULL;
  if (status && !VS_GROW(starts, room, shell.triangle_count + 1)) status = vs_fail_memory(f->vm);
  for (size_t i = 0; status && i <= shell.triangle_count; i++) starts[i] = (uint32_t)(3 * i);
  if (status) {
    vs_polygons faces = { shell.vertices, shell.vertex_count, starts, &shell.triangles[0][0], shell.triangle_count };
    node = vs_polyface_make(f->store, &faces, &e);
    if (!node) status = vs_bind_error(f, &e);
  }
  free(starts);
  vs_mesh_free(&m), vs_mesh_free(&shell);
  return status ? vs_bind_node(f, node, out) : VS_ERROR;
}
