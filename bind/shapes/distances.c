/* Owns the distance from a solid as a field that tapes may hold. */
#include <stdlib.h>

#include "bind/build.h"
#include "bind/call/refuse.h"
#include "bind/functions/function_values.h"
#include "bind/measures.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/measure/mesh_distance.h"
#include "model/store/array.h"
#include "solids/solid_meshes.h"

typedef struct {
  vs_tape_field field;
  vs_mesh_distance *mesh;
} distance_field;

static double value(const vs_tape_field *f, const double at[3], double slope[3]) {
  vs_vec3 by = { 0, 0, 0 };
  double d = vs_mesh_distance_at(((const distance_field *)(const void *)f)->mesh, vs_v3(at[0], at[1], at[2]), &by);
  if (slope) slope[0] = by.x, slope[1] = by.y, slope[2] = by.z;
  return d;
}

static void release(vs_tape_field *f) {
  distance_field *d = (distance_field *)(void *)f;
  vs_mesh_distance_free(d->mesh);
  free(d);
}

/* (%distance-field o): the field of a solid, of its mesh at a quarter of the usual tolerance */
vs_status vs_p_distance_field(vs_args *f, vs_value *out) {
  distance_field *d = NULL;
  size_t room = 0;
  vs_error e = { 0 };
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_ref ref = f->arg[0].ref;
  if (ref.node->class_ != VS_SOLID) return vs_bind_refuse(f, "o", "a solid", f->arg[0].value);
  vs_fineness facets = vs_bend_facets(f->bind, ref.node);
  facets.tolerance /= 4;
  vs_solid solid = { 0 };
  vs_kernel_options options = { .progress = vs_bind_keep_going, .context = f->vm };
  if (!vs_solid_evaluate(&ref, 1, &facets, &options, &solid, &e))
    return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(f, &e);
  bool ok = VS_GROW(d, room, 1);
  if (ok) *d = (distance_field){ { 1, value, release }, vs_mesh_distance_new(&solid.mesh) };
  vs_solid_free(&solid);
  if (!ok) return vs_fail_memory(f->vm);
  if (!d->mesh) return free(d), vs_fail_memory(f->vm);
  return vs_make_foreign(f->vm, &vs_tape_field_type, &d->field, 0, out);
}

/* (%field-value field x y z) */
vs_status vs_p_field_value(vs_args *f, vs_value *out) {
  const vs_tape_field *field = vs_foreign_get(f->arg[0].value, &vs_tape_field_type);
  return vs_bind_real(f, field->value(field, (const double[]){ f->arg[1].real, f->arg[2].real, f->arg[3].real }, NULL),
                      out);
}
