/* Collects the results of the instructions EACH and MORE (each.h). */
#include "vm/compiler/each.h"

bool vs_each_keep(vs_scheme *vm, vs_value *row) {
  vs_value *v = &row[VS_EACH_WINDOW];
  if (row[VS_EACH_CAPTURES] == vs_captures(vm)) {
    if (!vs_cons(vm, *v, VS_NIL, v)) return false;
    if (row[VS_EACH_LAST] == VS_NIL) row[VS_EACH_RESULTS] = *v;
    else vs_gc_store(vm, vs_as_pair(row[VS_EACH_LAST]), &vs_as_pair(row[VS_EACH_LAST])->cdr, *v);
    row[VS_EACH_LAST] = *v;
    return true;
  }
  if (row[VS_EACH_CAPTURES] != VS_FALSE) {
    row[VS_EACH_CAPTURES] = VS_FALSE;
    row[VS_EACH_LAST] = row[VS_EACH_RESULTS];
    if (!vs_list_onto(vm, &row[VS_EACH_LAST], VS_NIL, &row[VS_EACH_RESULTS])) return false;
  }
  return vs_cons(vm, *v, row[VS_EACH_RESULTS], &row[VS_EACH_RESULTS]);
}

bool vs_each_end(vs_scheme *vm, vs_value *row) {
  if (row[VS_EACH_CAPTURES] != VS_FALSE) return true;
  row[VS_EACH_LIST] = row[VS_EACH_RESULTS];
  return vs_list_onto(vm, &row[VS_EACH_LIST], VS_NIL, &row[VS_EACH_RESULTS]);
}
