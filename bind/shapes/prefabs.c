/* Owns the names of the prefabs that come with the language. prefabs.scm runs their files. */
#include "bind/call/call.h"
#include "vm/front/source.h"
#include "vm/values/heap.h"

#include <string.h>

/* (prefab-names): in the order of the alphabet, in which the program holds its files */
vs_status vs_p_prefab_names(vs_args *f, vs_value *out) {
  static const char folder[] = "prefabs/", ending[] = ".vs";
  const size_t before = sizeof folder - 1, after = sizeof ending - 1;
  size_t count = 0;
  VS_ROOTS(f->vm, r, 2);
  r[0] = VS_NIL;
  for (const vs_shipped *s = f->vm->config.shipped; s && s->name; s++) count++;
  while (count-- > 0) {
    const char *name = f->vm->config.shipped[count].name;
    size_t length = strlen(name);
    if (strncmp(name, folder, before) || length <= before + after || strcmp(name + length - after, ending)) continue;
    if (!vs_string_from_utf8(f->vm, name + before, length - before - after, &r[1]) ||
        !vs_cons(f->vm, r[1], r[0], &r[0]))
      return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}
