/* Implements named views, and the notes on drawings: dimensions, labels, levels and axes. */
#include <math.h>
#include <string.h>

#include "bind/call/call.h"
#include "bind/call/context.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"

/* The kinds of views that a program can name: name, projection and kind of cut. */
static const struct { const char *name; vs_view view; vs_cut cut; } kinds[] = {
  { "perspective", VS_VIEW_CAMERA, VS_CUT_NONE }, { "panorama", VS_VIEW_PANORAMA, VS_CUT_NONE },
  { "axonometric", VS_VIEW_ALONG, VS_CUT_NONE },  { "isometric", VS_VIEW_ISO, VS_CUT_NONE },
  { "plan", VS_VIEW_TOP, VS_CUT_OWN },            { "section", VS_VIEW_ALONG, VS_CUT_PLANE },
         { "top", VS_VIEW_TOP, VS_CUT_NONE },
  { "bottom", VS_VIEW_BOTTOM, VS_CUT_NONE },      { "front", VS_VIEW_FRONT, VS_CUT_NONE },
            { "back", VS_VIEW_BACK, VS_CUT_NONE },
  { "left", VS_VIEW_LEFT, VS_CUT_NONE },          { "right", VS_VIEW_RIGHT, VS_CUT_NONE },
};
static const char kinds_told[] =
    "one of 'perspective 'panorama 'axonometric 'isometric 'plan 'section 'top 'bottom 'front 'back 'left 'right";

/* Sets *out to the argument's text, interned in the store, or to NULL if the argument is absent. Returns false when
 * memory is out. */
static bool keep_text(vs_args *f, const vs_arg *a, const char **out) {
  *out = NULL;
  if (a->given && !(*out = vs_store_text(f->store, a->text.at, a->text.length))) return vs_fail_memory(f->vm);
  return true;
}

/* Returns true if the text may be a view's name: at most 100 bytes, one line, no slash. The name becomes part of file
 * names and of texts in drawings. */
static bool is_name(const vs_arg *a) {
  for (size_t i = 0; i < a->text.length; i++)
    if ((unsigned char)a->text.at[i] < ' ' || a->text.at[i] == '/' || a->text.at[i] == 0x7f) return false;
  return a->text.length > 0 && a->text.length <= 100;
}

static bool is_sheet(const char *name) {
#define SHEET(sheet, width, height) if (strcmp(name, sheet) == 0) return true;
#include "model/sheets.def"

  return strcmp(name, "none") == 0;
}

/* Sets the eye and the target of the view v from the arguments #:from and #:to, if this kind of view needs them. */
static vs_status take_place(vs_args *f, vs_scene_view *v, const vs_arg *from, const vs_arg *to) {
  bool round = v->view == VS_VIEW_PANORAMA;
  bool pointed = round || v->view == VS_VIEW_CAMERA || (v->view == VS_VIEW_ALONG && v->cut != VS_CUT_PLANE);
  if (!pointed) {
    if (from->given || to->given) return vs_fail(f->vm, f->vm->sym.arity,
        "#:from and #:to are for 'perspective, 'panorama and 'axonometric views");
    return VS_OK;
  }
  if (!from->given || !to->given)
    return vs_fail(f->vm, f->vm->sym.arity, v->view == VS_VIEW_CAMERA ? "a perspective view takes #:from and #:to" :
        round ? "a panorama takes #:from and #:to, the point in its middle" :
        "an axonometric view takes #:from and #:to");
  if (vs_v3_equal(from->point, to->point)) return vs_bind_refuse(f, "to", "another point than from", to->value);
  v->eye = from->point, v->target = to->point;
  vs_vec3 ahead = vs_v3_sub(v->target, v->eye);
  if (round && hypot(ahead.x, ahead.y) < 1e-6 * vs_v3_length(ahead))
    return vs_bind_refuse(f, "to", "a point that is not straight above or below", to->value);
  return VS_OK;
}

static vs_status take_cut(vs_args *f, vs_scene_view *v, const vs_arg *cut) {
  if (v->cut == VS_CUT_PLANE && !(cut->given && cut->value != VS_FALSE))
    return vs_fail(f->vm, f->vm->sym.arity,
                   "a section takes #:cut, a plane; the view looks at the plane along its normal");
  if (!cut->given) return VS_OK;
  bool section = v->cut == VS_CUT_PLANE;
  v->cut = cut->value != VS_FALSE ? VS_CUT_PLANE : VS_CUT_NONE;
  if (v->cut == VS_CUT_NONE) return VS_OK;
  v->cut_point = cut->line.at, v->cut_normal = vs_v3_unit(cut->line.direction);
  if (section) v->eye = v->cut_point, v->target = vs_v3_add(v->cut_point, v->cut_normal);
  return VS_OK;
}

/* Sets the aperture of the view's camera, and the point that is in focus: the target, unless the program gives another
 * point. */
static vs_status take_aperture(vs_args *f, vs_scene_view *v, const vs_arg *aperture, const vs_arg *focus) {
  v->focus = focus->given ? focus->point : v->target;
  v->aperture = aperture->given ? aperture->real : 0;
  if (focus->given && !aperture->given)
    return vs_fail(f->vm, f->vm->sym.arity, "takes #:focus with #:aperture, the lens's f-number");
  if (!(vs_v3_dot(vs_v3_sub(v->focus, v->eye), vs_v3_sub(v->target, v->eye)) > 0))
    return vs_bind_refuse(f, "focus", "a point before the eye", focus->value);
  return VS_OK;
}

/* Sets whether vertical edges of the model are drawn vertically in the picture. */
static vs_status take_upright(vs_args *f, vs_scene_view *v, const vs_arg *upright) {
  vs_vec3 ahead = vs_v3_sub(v->target, v->eye);
  v->upright = upright->given && upright->boolean;
  if (v->upright && hypot(ahead.x, ahead.y) < 0.05 * vs_v3_length(ahead))
    return vs_bind_refuse(f, "upright", "#f where the view looks straight up or down", upright->value);
  return VS_OK;
}

vs_status vs_p_camera(vs_args *f, vs_value *out) {
  const vs_arg *k = f->key; /* the call's keywords in order: lens, upright, aperture, focus */
  vs_scene_view v = { .view = VS_VIEW_CAMERA, .eye = f->arg[0].point, .target = f->arg[1].point };
  (void)out;
  if (vs_v3_equal(v.eye, v.target)) return vs_bind_refuse(f, "target", "another point than eye", f->arg[1].value);
  v.lens = k[0].given ? k[0].real : 35;
  if (take_aperture(f, &v, &k[2], &k[3]) != VS_OK || take_upright(f, &v, &k[1]) != VS_OK) return VS_ERROR;
  if (!vs_bind_handing(f->vm)) vs_scene_look(vs_bind_scene(f->vm), &v);
  return VS_OK;
}

vs_status vs_p_view(vs_args *f, vs_value *out) {
  const vs_arg *k = f->key; /* the call's keywords in order: from, to, lens, upright, cut, scale, sheet, hidden,
                             * aperture, focus */
  vs_scene_view v = { .view = VS_VIEW_CAMERA, .cut = VS_CUT_NONE, .lens = 35 };
  (void)out;
  if (!is_name(&f->arg[0])) return vs_bind_refuse(f, "name", "a name of 1 to 100 letters, without / and line breaks",
      f->arg[0].value);
  if (f->arg[1].given) {
    size_t i = 0, n = sizeof kinds / sizeof *kinds;
    while (i < n && strcmp(kinds[i].name, f->arg[1].text.at) != 0) i++;
    if (i == n) return vs_bind_refuse(f, "kind", kinds_told, f->arg[1].value);
    v.view = kinds[i].view, v.cut = kinds[i].cut;
  }
  if (take_place(f, &v, &k[0], &k[1]) != VS_OK) return VS_ERROR;
  if (v.view != VS_VIEW_CAMERA && (k[2].given || k[3].given || k[8].given || k[9].given))
    return vs_fail(f->vm, f->vm->sym.arity, "#:lens, #:upright, #:aperture and #:focus are for perspective views");
  if (v.view == VS_VIEW_CAMERA && take_aperture(f, &v, &k[8], &k[9]) != VS_OK) return VS_ERROR;
  if (k[2].given) v.lens = k[2].real;
  if (take_upright(f, &v, &k[3]) != VS_OK) return VS_ERROR;
  if (take_cut(f, &v, &k[4]) != VS_OK) return VS_ERROR;
  if (k[5].given) v.scale = k[5].real;
  if (k[6].given && !is_sheet(k[6].text.at)) return vs_bind_refuse(f, "sheet",
      "one of \"A4\" \"A3\" \"A2\" \"A1\" \"A0\", or 'none", k[6].value);
  v.hidden = k[7].given && k[7].boolean;
  if (!keep_text(f, &f->arg[0], &v.name) || !keep_text(f, &k[6], &v.sheet)) return VS_ERROR;
  return vs_bind_handing(f->vm) || vs_scene_add_view(vs_bind_scene(f->vm), &v) ? VS_OK : vs_fail_memory(f->vm);
}

/* ---- notes on drawings ---- */

static vs_status add_note(vs_args *f, vs_scene_note note, const vs_arg *text, const vs_arg *view) {
  if (!keep_text(f, text, &note.text) || !keep_text(f, view, &note.view)) return VS_ERROR;
  return vs_bind_handing(f->vm) || vs_scene_add_note(vs_bind_scene(f->vm), &note) ? VS_OK : vs_fail_memory(f->vm);
}

vs_status vs_p_dimension(vs_args *f, vs_value *out) {
  const vs_arg *k = f->key; /* the call's keywords in order: offset, text, view */
  (void)out;
  if (vs_v3_equal(f->arg[0].point, f->arg[1].point)) return vs_bind_refuse(f, "q", "another point than p",
      f->arg[1].value);
  vs_scene_note note = { VS_NOTE_DIMENSION, f->arg[0].point, f->arg[1].point, k[0].given ? k[0].real : NAN, NULL,
      NULL };
  return add_note(f, note, &k[1], &k[2]);
}

vs_status vs_p_label(vs_args *f, vs_value *out) {
  (void)out;
  return add_note(f, (vs_scene_note){ .kind = VS_NOTE_LABEL, .p = f->arg[0].point }, &f->arg[1], &f->key[0]);
}

vs_status vs_p_level(vs_args *f, vs_value *out) {
  (void)out;
  return add_note(f, (vs_scene_note){ .kind = VS_NOTE_LEVEL, .p = vs_v3(0, 0, f->arg[0].real) }, &f->arg[1],
      &f->key[0]);
}

/* (%sheet-table cells columns title): adds a table to the sheet. cells: texts, row by row, separated by the character
 * U+001F. title: text, empty for none. */
vs_status vs_p_sheet_table(vs_args *f, vs_value *out) {
  (void)out;
  const char *at = f->arg[0].text.at, *end = at + f->arg[0].text.length;
  vs_growing cells = { .size = sizeof(const char *) };
  for (const char *past; at <= end; at = past + 1) {
    past = memchr(at, 0x1f, (size_t)(end - at));
    if (!past) past = end;
    const char **cell = vs_bind_grow(f, &cells);
    if (!cell) return VS_ERROR;
    if (!(*cell = vs_store_text(f->store, at, (size_t)(past - at)))) return vs_fail_memory(f->vm);
  }
  const size_t columns = (size_t)f->arg[1].integer;
  vs_scene_table t = { .cells = cells.at, .rows = cells.count / columns, .columns = columns };
  if (f->arg[2].text.length && !keep_text(f, &f->arg[2], &t.title)) return VS_ERROR;
  return vs_bind_handing(f->vm) || vs_scene_add_table(vs_bind_scene(f->vm), &t) ? VS_OK : vs_fail_memory(f->vm);
}

vs_status vs_p_grid_axis(vs_args *f, vs_value *out) {
  (void)out;
  if (vs_v3_equal(f->arg[1].point, f->arg[2].point)) return vs_bind_refuse(f, "q", "another point than p",
      f->arg[2].value);
  return add_note(f, (vs_scene_note){ .kind = VS_NOTE_AXIS, .p = f->arg[1].point, .q = f->arg[2].point }, &f->arg[0],
      &f->key[0]);
}
