/* Reads files of point clouds for programs. */
#include "bind/call/call.h"
#include "bind/call/give.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/constructors/files.h"
#include "geometry/files/pointfile.h"
#include "vm/machine/run.h"
#include "vm/values/heap.h"

/* Returns false, with the error set, on an interrupt. */
static bool keep_reading(void *vm) { return vs_poll(vm, 1 << 16); }

/* (load-points file): returns the list of points in the order of the file. */
vs_status vs_p_load_points(vs_args *f, vs_value *out) {
  const char *name = f->arg[0].text.at;
  vs_face_list l = { 0 };
  vs_error e = { 0 };
  VS_ROOTS(f->vm, r, 2);
  if (!vs_point_file_is(name))
    return vs_bind_refuse(f, "file", "a name that ends in .xyz, .txt, .csv, .las or .ply", f->arg[0].value);
  if (!vs_bind_file(f, &f->arg[0], &r[0], &name)) return VS_ERROR;
  vs_file_bytes file = { name, vs_as_bytes(r[0])->at, (size_t)vs_as_bytes(r[0])->length };
  bool ok = vs_point_file_read(&file, (vs_poller){ keep_reading, f->vm }, &l, &e);
  if (!ok && e.kind != VS_ERROR_INTERRUPT) vs_bind_error(f->vm, &e);
  r[0] = VS_NIL;
  for (size_t i = l.point_count; ok && i-- > 0;)
    ok = vs_poll(f->vm, 4) && vs_bind_give_point(f, l.points[i], &r[1]) && vs_cons(f->vm, r[1], r[0], &r[0]);
  vs_face_list_free(&l);
  *out = r[0];
  return ok;
}
