/* Implements the native for reflected daylight, which library/visualscheme/analysis/light.scm calls. */
#include "geometry/light/daylight.h"

#include "bind/analysis/number_vectors.h"
#include "bind/call/call.h"
#include "bind/call/scratch.h"
#include "bind/workshop/sunlight.h"
#include "vm/machine/fail.h"

enum { PART = 1024 }; /* paths between two polls */

/* Sets *d to the surfaces of *s, with the reflectance of each object from the vector in the argument 3. */
static bool take_surfaces(vs_args *f, const vs_shades *s, vs_daylit *d) {
  size_t objects = f->arg[5].refs.count, triangle = 0;
  const double *parts = vs_bind_numbers(f, 3, objects);
  double *reflectances = vs_bind_scratch(f, (s->mesh.triangle_count + 1) * sizeof *reflectances);
  if (!parts || !reflectances) return false;
  for (size_t i = 0; i < objects; i++)
    while (triangle < s->ends[i]) reflectances[triangle++] = parts[i];
  *d = (vs_daylit){ s->any ? &s->tree : NULL, reflectances, f->arg[4].real, 1e-6 * s->size };
  return true;
}

/* Sets *light to the reflected daylight of the place i. */
static bool light_place(vs_args *f, const vs_daylit *d, size_t i, double *light) {
  size_t all = (size_t)f->arg[2].integer;
  vs_vec3 at = f->arg[0].points.at[i], normal = vs_v3_unit(f->arg[1].points.at[i]);
  *light = 0;
  for (size_t first = 0; first < all; first += PART) {
    size_t end = first + PART < all ? first + PART : all;
    *light += vs_daylight_reflected(d, at, normal, (vs_light_paths){ first, end, all });
    if (!vs_poll(f->vm, 64 * PART)) return false;
  }
  return true;
}

/* (%reflected-daylight points normals rays reflectances ground among): returns a vector of the daylight that reaches
 * each point by reflections. reflectances: a vector with a number for each object of `among`. */
vs_status vs_p_reflected_daylight(vs_args *f, vs_value *out) {
  vs_shades s;
  vs_daylit d;
  size_t count = f->arg[0].points.count;
  if (f->arg[1].points.count != count)
    return vs_fail(f->vm, f->vm->sym.range, "normals must be as many as points");
  double *lights = vs_bind_scratch(f, (count + 1) * sizeof *lights);
  bool ok = vs_bind_shades(f, 5, &s) && lights && take_surfaces(f, &s, &d);
  for (size_t i = 0; ok && i < count; i++) ok = light_place(f, &d, i, &lights[i]);
  vs_bind_shades_free(f, &s);
  return ok && vs_bind_give_numbers(f, lights, count, out) ? VS_OK : VS_ERROR;
}
