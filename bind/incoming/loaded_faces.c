/* Creates solids and surfaces from the faces of a model file that load_model.scm reads. */
#include <stdlib.h>
#include <string.h>

#include "bind/build.h"
#include "bind/call/positional.h"
#include "bind/call/raise.h"
#include "bind/constructors/meshes.h"
#include "geometry/files/face_shells.h"
#include "geometry/files/polyface.h"
#include "geometry/files/repair.h"
#include "model/store/array.h"
#include "vm/machine/run.h"
#include "vm/values/heap.h"

/* Data for loading a mesh in pieces, one for each material. The list `left` contains the faces of shells that are not
 * closed within their piece, in the order of the pieces. There, piece_end[i] is the number of faces after piece i. */
typedef struct {
  vs_args *f;
  size_t piece_count;
  vs_face_list left;
  size_t *piece_end;
  vs_value *made; /* the list that the native returns; a root of the garbage collector */
} loading;

static bool copy_face(vs_face_list *to, const vs_face_list *from, uint32_t face) {
  bool ok = true;
  for (uint32_t c = from->starts[face]; ok && c < from->starts[face + 1]; c++)
    ok = vs_face_list_point(to, from->points[from->corners[c]]) &&
         vs_face_list_corner(to, (uint32_t)to->point_count - 1);
  return ok && vs_face_list_close(to);
}

/* Adds (piece object mixed) to the result, unless the faces have no area. `mixed`: whether faces of other pieces are
 * among these. Empties the list of faces. */
static vs_status give_faces(loading *l, vs_face_list *faces, size_t piece, bool mixed) {
  vs_args *f = l->f;
  vs_node *n = NULL;
  bool flawless;
  VS_ROOTS(vs_call_vm(f), r, 2);
  vs_status ok = vs_face_list_compact(faces) ? VS_OK : vs_fail_memory(vs_call_vm(f));
  ok = ok && vs_bind_whole_faces(f, "", faces, &flawless, &n);
  vs_face_list_free(faces);
  if (!ok) return VS_ERROR;
  if (vs_node_is_empty(n)) return vs_node_release(n), VS_OK;
  r[1] = VS_NIL;
  return vs_bind_give_node(f, n, &r[0]) && vs_cons(vs_call_vm(f), mixed ? VS_TRUE : VS_FALSE, VS_NIL, &r[1]) &&
         vs_cons(vs_call_vm(f), r[0], r[1], &r[1]) && vs_cons(vs_call_vm(f), vs_fix((int64_t)piece), r[1], &r[1]) &&
         vs_cons(vs_call_vm(f), r[1], *l->made, l->made);
}

/* ---- faces of a piece ---- */

static vs_status refuse_face(const loading *l, const char *why) {
  return vs_fail(vs_call_vm(l->f), vs_call_vm(l->f)->sym.range, "%s", why);
}

static double number_at(const vs_bytes *b, size_t i) {
  double d;
  memcpy(&d, b->at + 8 * i, sizeof d);
  return d;
}

/* Adds the face with the corners at[0] to at[count - 1]. Returns false when memory is out. */
static bool add_face(vs_face_list *l, const vs_bytes *corners, const size_t *at, size_t count) {
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) ok = vs_face_list_corner(l, (uint32_t)number_at(corners, at[i]));
  return ok && vs_face_list_close(l);
}

/* The values of `form`: how the corners of a piece form faces. */
enum { FACES_MARKED = 0, FACES_TRIANGLES = 3, FACES_STRIP = 5, FACES_FAN = 6 };

/* Converts corners to faces. In the form FACES_MARKED, a negative number ends each face, and the corners are copied to
 * the list directly. */
static bool add_faces(vs_face_list *l, const vs_bytes *corners, int64_t form) {
  size_t count = (size_t)corners->length / 8;
  bool ok = true;
  if (form == FACES_MARKED) {
    for (size_t i = 0; ok && i < count; i++) {
      double d = number_at(corners, i);
      ok = d < 0 ? vs_face_list_close(l) : vs_face_list_corner(l, (uint32_t)d);
    }
    return ok && vs_face_list_close(l);
  }
  size_t step = form == FACES_TRIANGLES ? 3 : 1;
  for (size_t i = 0; ok && i + 3 <= count; i += step) {
    size_t at[3] = { form == FACES_FAN ? 0 : i, i + 1, i + 2 };
    if (form == FACES_STRIP && i % 2) at[0] = i + 1, at[1] = i;
    ok = add_face(l, corners, at, 3);
  }
  return ok;
}

/* Sets *out to the list of faces of a piece, a vector #(points corners form). */
static vs_status list_of_piece(const loading *l, vs_value piece, vs_face_list *out) {
  vs_scheme *vm = vs_call_vm(l->f);
  const vs_bytes *points = vs_as_bytes(vs_as_vector(piece)->at[0]), *corners = vs_as_bytes(vs_as_vector(piece)->at[1]);
  size_t point_count = (size_t)points->length / 24, corner_count = (size_t)corners->length / 8;
  if (point_count >= UINT32_MAX || corner_count >= UINT32_MAX) return vs_fail_memory(vm);
  for (size_t i = 0; i < corner_count; i++) {
    double d = number_at(corners, i);
    if (!(d < (double)point_count) || d != floor(d) || (d < 0 && vs_fixnum(vs_as_vector(piece)->at[2]) != FACES_MARKED))
      return refuse_face(l, "a face refers to a point that is not there");
  }
  for (size_t i = 0; i < 3 * point_count; i++)
    if (!isfinite(number_at(points, i))) return refuse_face(l, "a point is not at a finite place");
  bool ok = true;
  for (size_t i = 0; ok && i < point_count; i++)
    ok = vs_face_list_point(out, vs_v3(number_at(points, 3 * i), number_at(points, 3 * i + 1),
                                       number_at(points, 3 * i + 2)));
  ok = ok && add_faces(out, corners, vs_fixnum(vs_as_vector(piece)->at[2])) && vs_face_list_compact(out);
  return ok ? VS_OK : vs_fail_memory(vm);
}

/* Creates a solid from the closed shells of piece i, and adds its other faces to `left`. */
static vs_status load_piece(loading *l, vs_value piece, size_t i) {
  vs_args *f = l->f;
  vs_face_list all = { 0 }, closed = { 0 };
  vs_error e = { 0 };
  vs_status ok = list_of_piece(l, piece, &all);
  uint32_t *shell = vs_fresh(all.face_count + 1, sizeof *shell);
  unsigned char *open = vs_fresh(all.face_count + 1, 1);
  if (ok && (!shell || !open)) ok = vs_fail_memory(vs_call_vm(f));
  if (ok && !vs_face_list_shells(vs_call_store(f), &all, shell, open, &e)) ok = vs_bind_error(vs_call_vm(f), &e);
  for (uint32_t k = 0; ok && k < all.face_count; k++)
    if (!copy_face(open[shell[k]] ? &l->left : &closed, &all, k)) ok = vs_fail_memory(vs_call_vm(f));
  l->piece_end[i] = l->left.face_count;
  if (ok && closed.face_count) ok = give_faces(l, &closed, i, false);
  vs_face_list_free(&all);
  vs_face_list_free(&closed);
  free(shell);
  free(open);
  return ok;
}

/* ---- faces whose shell is closed only with faces of other pieces ---- */

/* Sets owner[s], for each shell s, to the piece that has the largest area in it. A shell's number is that of its first
 * face. area, best: arrays of zeros. */
static void find_owners(const loading *l, const uint32_t *shell, uint32_t *owner, double *area, double *best) {
  const vs_face_list *left = &l->left;
  uint32_t begin = 0;
  for (size_t i = 0; i < l->piece_count; i++) {
    uint32_t end = (uint32_t)l->piece_end[i];
    for (uint32_t k = begin; k < end; k++) {
      vs_vec3 sum = { 0, 0, 0 }, o = left->points[left->corners[left->starts[k]]];
      for (uint32_t c = left->starts[k] + 1; c + 1 < left->starts[k + 1]; c++)
        sum = vs_v3_add(sum, vs_v3_cross(vs_v3_sub(left->points[left->corners[c]], o),
                                         vs_v3_sub(left->points[left->corners[c + 1]], o)));
      area[shell[k]] += vs_v3_length(sum);
    }
    for (uint32_t k = begin; k < end; k++) {
      if (area[shell[k]] > best[shell[k]]) best[shell[k]] = area[shell[k]], owner[shell[k]] = (uint32_t)i;
    }
    for (uint32_t k = begin; k < end; k++) area[shell[k]] = 0;
    begin = end;
  }
}

/* Creates solids from the closed shells, in the order of their owners, and surfaces from the other faces. The array
 * next is for lists: first a link for each face, then the first face of each piece. */
static vs_status give_left(loading *l, const uint32_t *shell, const unsigned char *open, const uint32_t *owner,
                           uint32_t *next) {
  const vs_face_list *left = &l->left;
  uint32_t *first = next + left->face_count, begin = 0;
  vs_status ok = VS_OK;
  for (size_t i = 0; i < l->piece_count; i++) first[i] = UINT32_MAX;
  for (uint32_t k = (uint32_t)left->face_count; k-- > 0;)
    if (!open[shell[k]]) next[k] = first[owner[shell[k]]], first[owner[shell[k]]] = k;
  for (size_t i = 0; ok && i < l->piece_count; i++) {
    vs_face_list solid = { 0 }, sheet = { 0 };
    for (uint32_t k = first[i]; ok && k != UINT32_MAX; k = next[k])
      if (!copy_face(&solid, left, k)) ok = vs_fail_memory(vs_call_vm(l->f));
    for (uint32_t k = begin; ok && k < l->piece_end[i]; k++)
      if (open[shell[k]] && !copy_face(&sheet, left, k)) ok = vs_fail_memory(vs_call_vm(l->f));
    begin = (uint32_t)l->piece_end[i];
    if (ok && solid.face_count) ok = give_faces(l, &solid, i, true);
    if (ok && sheet.face_count) ok = give_faces(l, &sheet, i, false);
    vs_face_list_free(&solid);
    vs_face_list_free(&sheet);
  }
  return ok;
}

static vs_status load_left(loading *l) {
  vs_args *f = l->f;
  size_t n = l->left.face_count;
  if (!n) return VS_OK;
  vs_error e = { 0 };
  uint32_t *shell = vs_fresh(n, sizeof *shell), *owner = vs_zeros(n, sizeof *owner),
           *next = vs_fresh(n + l->piece_count, sizeof *next);
  unsigned char *open = vs_fresh(n, 1);
  double *area = vs_zeros(n, sizeof *area), *best = vs_zeros(n, sizeof *best);
  vs_status ok = shell && owner && next && open && area && best && vs_face_list_compact(&l->left)
                     ? VS_OK : vs_fail_memory(vs_call_vm(f));
  if (ok && !vs_face_list_shells(vs_call_store(f), &l->left, shell, open, &e)) ok = vs_bind_error(vs_call_vm(f), &e);
  if (ok) {
    find_owners(l, shell, owner, area, best);
    ok = give_left(l, shell, open, owner, next);
  }
  free(shell);
  free(owner);
  free(next);
  free(open);
  free(area);
  free(best);
  return ok;
}

/* (%loaded-faces pieces): pieces is a list of #(points corners form). Returns a list of (piece object mixed). piece:
 * number of the piece whose material the object has. mixed: whether the object contains faces of other pieces. */
vs_status vs_p_loaded_faces(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 2); /* roots of the garbage collector: the result, the pieces not yet read */
  r[0] = VS_NIL, r[1] = vs_arg_value(f, 0);
  loading l = { .f = f, .made = &r[0] };
  for (vs_value p = r[1]; vs_is_pair(p); p = vs_cdr(p)) l.piece_count++;
  l.piece_end = vs_fresh(l.piece_count + 1, sizeof *l.piece_end);
  vs_status ok = l.piece_end ? VS_OK : vs_fail_memory(vm);
  for (size_t i = 0; ok && i < l.piece_count; i++, r[1] = vs_cdr(r[1])) ok = load_piece(&l, vs_car(r[1]), i);
  ok = ok && load_left(&l);
  vs_face_list_free(&l.left);
  free(l.piece_end);
  *out = r[0];
  return ok;
}
