/* Suggests a correction for calls with plain numbers in place of points or gvectors. */
#include "bind/constructors/regroup.h"

#include "bind/call/procedure.h"
#include "bind/call/take.h"
#include "bind/print.h"

#include <stdio.h>

/* Writes the call that was probably meant if numbers were given in place of a point, a gvector or factors: (do-move o
 * (vxyz 1 0 0)) for (do-move o 1 0 0). Returns false if this form of the procedure has no parameters that fit so. */
static bool group_numbers(vs_scheme *vm, const vs_form *form, const vs_plain_call *call, char *text, size_t room) {
  const vs_value *a = call->at;
  const int n = call->count;
  int used = 0, groups = 0;
  size_t at = (size_t)snprintf(text, room, "(%s", call->name);
  for (const vs_bind_param *p = form->at; p->mode != VS_ARG_END && used < n; p++) {
    int left = 0; /* number of arguments that the required parameters after the current one need */
    for (const vs_bind_param *q = p + 1; q->mode == VS_ARG_REQUIRED; q++) left++;
    double d[3];
    int numbers = 0;
    while (numbers < 3 && used + numbers < n && vs_bind_take_number(vm, a[used + numbers], &d[numbers])) numbers++;
    bool point = p->contract == VS_C_POINT || p->contract == VS_C_POINTS || p->contract == VS_C_THINGS;
    bool vector = p->contract == VS_C_VECTOR || p->contract == VS_C_DIRECTION;
    const char *maker = point ? "xyz" : vector ? "vxyz" : p->contract == VS_C_FACTOR ? "list" : NULL;
    if (maker && numbers == 3 && used + 3 + left <= n) {
      char x[32], y[32], z[32];
      vs_bind_number_text(x, d[0]), vs_bind_number_text(y, d[1]), vs_bind_number_text(z, d[2]);
      at += (size_t)snprintf(text + at, room - at, " (%s %s %s %s)", maker, x, y, z);
      used += 3, groups++;
    } else {
      char x[32];
      double one;
      bool number = vs_bind_take_number(vm, a[used], &one);
      if (maker && number) return false;
      if (number) vs_bind_number_text(x, one);
      at += (size_t)snprintf(text + at, room - at, " %s", number ? x : p->name);
      used++;
    }
    if (at + 80 > room) return false;
    if (p->mode == VS_ARG_REST) p--;
    else if (used == n && p[1].mode == VS_ARG_REQUIRED) return false;
  }
  if (used < n || !groups) return false;
  snprintf(text + at, room - at, ")");
  return true;
}

bool vs_bind_grouped(vs_scheme *vm, const vs_procedure *p, const vs_plain_call *call, char *text, size_t room) {
  for (int i = VS_MAX_FORMS; i-- > 0;) /* tries the procedure's forms from the last, which is the longest */
    if (p->form[i].used && group_numbers(vm, &p->form[i], call, text, room)) return true;
  return false;
}
