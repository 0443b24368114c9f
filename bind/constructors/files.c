/* Owns the reading of files that a program names for its geometry: meshes and pictures. */
#include "bind/bind.h"

#include "vm/library/port.h"
#include "vm/front/source.h"

vs_status vs_bind_file(vs_frame *f, const vs_arg *name, vs_value *bytes, const char **shown) {
  vs_scheme *vm = f->vm;
  vs_text path, own;
  vs_text_open(vm, &path, 0);
  vs_text_open(vm, &own, 0);
  bool ok = vs_text_string(&own, name->value) && vs_text_end(&own); /* before anything is made: the name may move
                                                                     * then */
  ok = ok && vs_source_path(vm, name->value, vs_pos_file(vs_call_place(vm)), &path) && vs_text_end(&path) &&
       vs_io_read_file(vm, path.at, bytes);
  if (ok) {
    const char *slash = strrchr(own.at, '/');
    const char *last = slash ? slash + 1 : own.at;
    ok = (*shown = vs_store_text(f->bind->store, last, strlen(last))) || vs_fail_memory(vm);
  }
  vs_text_close(&path);
  vs_text_close(&own);
  return ok ? VS_OK : VS_ERROR;
}
