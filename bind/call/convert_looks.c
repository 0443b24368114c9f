/* Owns the conversion of arguments that are materials and colours: rows of contracts.def. */
#include "bind/call/convert.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "bind/call/refuse.h"
#include "bind/constructors/files.h"
#include "bind/objects.h"
#include "bind/state.h"
#include "model/looks/ready_materials.h"
#include "vm/front/suggest.h"
#include "vm/machine/fail.h"

/* The spelling that was meant: "#f80", or a name with a slip. */
static vs_status refuse_material(vs_args *f, const vs_bind_param *p, vs_value got, const char *name) {
  char hint[64];
  const char *near = vs_nearest_word(name, vs_ready_material_name);
  if (name[0] == '#' && strlen(name) == 4 && strspn(name + 1, "0123456789abcdefABCDEF") == 3)
    snprintf(hint, sizeof hint, "\"#%c%c%c%c%c%c\"", name[1], name[1], name[2], name[2], name[3], name[3]);
  else if (near) snprintf(hint, sizeof hint, "\"%s\"", near);
  else return vs_bind_refuse_kind(f, p, got);
  return vs_bind_refuse_hint(f, p->name, vs_contract_noun(p->contract), got, hint);
}

/* Three numbers, not all from 0 to 1: from 0 to 255, and not all small, they are what other programs take. */
static vs_status refuse_parts(vs_args *f, const vs_bind_param *p, vs_value got) {
  double c[3];
  char hint[96];
  vs_value l = got;
  for (int i = 0; i < 3; i++, l = vs_cdr(l))
    if (!vs_bind_number(f->vm, vs_car(l), &c[i]) || !(c[i] >= 0 && c[i] <= 255)) return vs_bind_refuse_kind(f, p, got);
  if (c[0] < 32 && c[1] < 32 && c[2] < 32) return vs_bind_refuse_kind(f, p, got);
  snprintf(hint, sizeof hint, "(list %.3g %.3g %.3g)", c[0] / 255, c[1] / 255, c[2] / 255);
  return vs_bind_refuse_hint(f, p->name, vs_contract_noun(p->contract), got, hint);
}

/* a material from a paint, or from a name; a colour also from three numbers */
static bool is_photograph(const char *name) {
  const char *dot = strrchr(name, '.');
  return dot && (!strcasecmp(dot, ".png") || !strcasecmp(dot, ".jpg") || !strcasecmp(dot, ".jpeg"));
}

/* A material by its photograph: a matt surface, the picture a metre wide. */
static vs_status convert_photograph(vs_args *f, vs_value v, vs_arg *out) {
  vs_material m = { .roughness = 0.9, .ior = 1.5, .pattern = { .kind = VS_PATTERN_PICTURE } };
  double mean[3];
  if (vs_bind_picture(f, v, &m.pattern.picture, &m.name, mean) != VS_OK) return VS_ERROR;
  m.red = mean[0], m.green = mean[1], m.blue = mean[2];
  out->material = vs_store_material(f->store, &m);
  return out->material ? VS_OK : vs_fail_memory(f->vm);
}

vs_status vs_convert_material(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->material = vs_foreign_get(v, &vs_paint_type);
  if (out->material) return VS_OK;
  if (vs_is_pair(v) && p->contract == VS_C_COLOR && vs_list_length(v) == 3) {
    double c[3];
    vs_value l = v;
    for (int i = 0; i < 3; i++, l = vs_cdr(l))
      if (!vs_bind_number(f->vm, vs_car(l), &c[i]) || !(c[i] >= 0 && c[i] <= 1)) return refuse_parts(f, p, v);
    vs_material m = { "", c[0], c[1], c[2], .5, 0, 0, 1.5, { 0 } };
    out->material = vs_store_material(f->store, &m);
    return out->material ? VS_OK : vs_fail_memory(f->vm);
  }
  if (!vs_is_string(v) && !vs_is_symbol(v)) return vs_bind_refuse_kind(f, p, v);
  vs_arg name;
  if (!vs_convert_text(f, p, v, &name)) return VS_ERROR;
  if (p->contract == VS_C_MATERIAL && vs_is_string(v) && is_photograph(name.text.at))
    return convert_photograph(f, v, out);
  size_t refused = f->bind->refused;
  out->material = vs_store_ready_material(f->store, name.text.at);
  return out->material                 ? VS_OK
         : f->bind->refused != refused ? vs_fail_memory(f->vm)
                                       : refuse_material(f, p, v, name.text.at);
}
