/* Reads the parameter objects (current-segments) and (current-tolerance) of geometry.scm. */
#include "bind/call/precision.h"

#include "bind/call/take.h"

enum { CURRENT_SEGMENTS, CURRENT_TOLERANCE };

static double current(vs_scheme *vm, size_t which) {
  vs_value all = vm->at.host, v;
  double d;
  if (!vs_is_vector(all) || which >= vs_as_vector(all)->length) return 0;
  vs_value parameter = vs_as_vector(all)->at[which];
  if (!vs_is(parameter, VS_T_PARAMETER)) return 0;
  v = vs_as_parameter(parameter)->value;
  for (vs_value l = vm->parameters; vs_is_pair(l); l = vs_cdr(l)) /* searches the values that parameterize has set,
                                                                   * innermost first */
    if (vs_car(vs_car(l)) == parameter) { v = vs_cdr(vs_car(l)); break; }
  return vs_bind_take_number(vm, v, &d) ? d : 0;
}
int32_t vs_bind_segments(vs_scheme *vm) { return (int32_t)current(vm, CURRENT_SEGMENTS); }
double vs_bind_tolerance(vs_scheme *vm) { return current(vm, CURRENT_TOLERANCE); }
