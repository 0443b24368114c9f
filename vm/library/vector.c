/* Implements the procedures of vectors and bytevectors that have no procedure arguments. Literals are immutable. */
#include "vm/machine/fail.h"
#include "vm/machine/native.h"
#include "vm/machine/poll.h"
#include "vm/numbers/number.h"
#include "vm/library/range.h"
#include "vm/values/heap.h"
#include "vm/values/string_chars.h"

static const int64_t LONGEST = INT64_C(1) << 31; /* greatest length of a vector: the size of an object is 32 bits, in
                                                  * words */

static bool arg_vector(vs_scheme *vm, const vs_value *a, int arg) { return vs_arg_type(vm, a, arg, VS_T_VECTOR); }

static bool arg_mutable(vs_scheme *vm, const vs_value *a, int arg, int type) {
  if (!vs_arg_type(vm, a, arg, type)) return false;
  if (vs_object_of(a[arg])->flags & VS_F_IMMUTABLE)
    return vs_fail_type(vm, arg,
                        type == VS_T_VECTOR ? "a vector that may change, not a literal"
                                            : "a bytevector that may change, not a literal",
                        a[arg]);
  return true;
}

static int64_t vector_length(vs_value v) { return (int64_t)vs_as_vector(v)->length; }

/* Sets *out to a new vector of the elements start to end - 1 of *from, which is a root of the garbage collector. */
static bool vector_slice(vs_scheme *vm, const vs_value *from, int64_t start, int64_t end, vs_value *out) {
  VS_ASSERT(0 <= start && start <= end && end <= (int64_t)vs_as_vector(*from)->length);
  if (!vs_make_vector(vm, (size_t)(end - start), VS_FALSE, out)) return false;
  vs_object *o = vs_object_of(*out);
  for (int64_t i = start; i < end; i++) {
    vs_gc_store(vm, o, &vs_as_vector(*out)->at[i - start], vs_as_vector(*from)->at[i]);
    if (!vs_poll_turn(vm, (uint64_t)i, 1)) return false;
  }
  return true;
}

static vs_status vector_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  *out = vs_bool(vs_is_vector(a[0]));
  return VS_OK;
}

static vs_status vector_make(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t count;
  return vs_arg_index(vm, a, 0, 0, LONGEST, &count) && vs_make_vector(vm, (size_t)count, n > 1 ? a[1] : vs_fix(0), out);
}

static vs_status vector_vector(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!vs_make_vector(vm, (size_t)n, VS_FALSE, out)) return VS_ERROR;
  for (int i = 0; i < n; i++) vs_gc_store(vm, vs_object_of(*out), &vs_as_vector(*out)->at[i], a[i]);
  return VS_OK;
}

static vs_status vector_length_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_vector(vm, a, 0)) return VS_ERROR;
  *out = vs_fix(vector_length(a[0]));
  return VS_OK;
}

static bool vector_index(vs_scheme *vm, const vs_value *a, int64_t *k) {
  int64_t length = vector_length(a[0]);
  if (vs_is_fixnum(a[1]) && vs_fixnum(a[1]) >= 0 && vs_fixnum(a[1]) < length) {
    *k = vs_fixnum(a[1]);
    return true;
  }
  if (length == 0) return vs_fail(vm, vm->sym.range, "the vector is empty");
  return vs_arg_index(vm, a, 1, 0, length - 1, k);
}

static vs_status vector_ref(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t k;
  if (!arg_vector(vm, a, 0) || !vector_index(vm, a, &k)) return VS_ERROR;
  *out = vs_as_vector(a[0])->at[k];
  return VS_OK;
}

static vs_status vector_set(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  int64_t k;
  if (!arg_mutable(vm, a, 0, VS_T_VECTOR) || !vector_index(vm, a, &k)) return VS_ERROR;
  vs_gc_store(vm, vs_object_of(a[0]), &vs_as_vector(a[0])->at[k], a[2]);
  return VS_OK;
}

static vs_status vector_to_list(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t start, end;
  if (!arg_vector(vm, a, 0) || !vs_arg_range(vm, a, n, 1, vector_length(a[0]), &start, &end)) return VS_ERROR;
  *out = VS_NIL;
  for (int64_t i = end; i-- > start;)
    if (!vs_cons(vm, vs_as_vector(a[0])->at[i], *out, out) || !vs_poll_turn(vm, (uint64_t)i, 4)) return VS_ERROR;
  return VS_OK;
}

static vs_status list_to_vector(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t length = vs_list_length(a[0]);
  if (length < 0) return vs_fail_type(vm, 0, "a list", a[0]);
  if (!vs_make_vector(vm, (size_t)length, VS_FALSE, out)) return VS_ERROR;
  vs_value l = a[0];
  for (int64_t i = 0; i < length; i++, l = vs_cdr(l)) {
    vs_gc_store(vm, vs_object_of(*out), &vs_as_vector(*out)->at[i], vs_car(l));
    if (!vs_poll_turn(vm, (uint64_t)i, 2)) return VS_ERROR;
  }
  return VS_OK;
}

static vs_status vector_fill(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  int64_t start, end;
  if (!arg_mutable(vm, a, 0, VS_T_VECTOR) || !vs_arg_range(vm, a, n, 2, vector_length(a[0]), &start, &end))
    return VS_ERROR;
  for (int64_t i = start; i < end; i++) {
    vs_gc_store(vm, vs_object_of(a[0]), &vs_as_vector(a[0])->at[i], a[1]);
    if (!vs_poll_turn(vm, (uint64_t)i, 1)) return VS_ERROR;
  }
  return VS_OK;
}

static vs_status vector_copy(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t start, end;
  return arg_vector(vm, a, 0) && vs_arg_range(vm, a, n, 1, vector_length(a[0]), &start, &end) &&
         vector_slice(vm, &a[0], start, end, out);
}

/* (vector-copy! to at from [start end]): copies elements start to end - 1 of `from` to `to`, beginning at index `at`.
 * The two ranges may overlap. */
static vs_status vector_copy_to(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  int64_t at, start, end;
  if (!arg_mutable(vm, a, 0, VS_T_VECTOR) || !arg_vector(vm, a, 2) ||
      !vs_arg_range(vm, a, n, 3, vector_length(a[2]), &start, &end) ||
      !vs_arg_index(vm, a, 1, 0, vector_length(a[0]), &at))
    return VS_ERROR;
  if (end - start > vector_length(a[0]) - at)
    return vs_fail(vm, vm->sym.range, "%lld elements do not fit behind index %lld of a vector of %lld",
                   (long long)(end - start), (long long)at, (long long)vector_length(a[0]));
  vs_vector *to = vs_as_vector(a[0]), *from = vs_as_vector(a[2]);
  int64_t count = end - start;
  bool backwards = to == from && at > start;
  for (int64_t k = 0; k < count; k++) {
    int64_t i = backwards ? count - 1 - k : k;
    vs_gc_store(vm, to, &to->at[at + i], from->at[start + i]);
    if (!vs_poll_turn(vm, (uint64_t)k, 1)) return VS_ERROR;
  }
  return VS_OK;
}

static vs_status vector_append(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t total = 0;
  for (int i = 0; i < n; i++) {
    if (!arg_vector(vm, a, i)) return VS_ERROR;
    total += vector_length(a[i]);
  }
  if (!vs_make_vector(vm, (size_t)total, VS_FALSE, out)) return VS_ERROR;
  int64_t at = 0;
  for (int i = 0; i < n; i++)
    for (int64_t k = 0; k < vector_length(a[i]); k++) {
      vs_gc_store(vm, vs_object_of(*out), &vs_as_vector(*out)->at[at], vs_as_vector(a[i])->at[k]);
      if (!vs_poll_turn(vm, (uint64_t)at++, 1)) return VS_ERROR;
    }
  return VS_OK;
}

static vs_status vector_to_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t start, end;
  if (!arg_vector(vm, a, 0) || !vs_arg_range(vm, a, n, 1, vector_length(a[0]), &start, &end)) return VS_ERROR;
  uint32_t widest = 0;
  for (int64_t i = start; i < end; i++) {
    vs_value c = vs_as_vector(a[0])->at[i];
    if (!vs_is_char(c)) return vs_fail_type(vm, 0, "a vector of characters", a[0]);
    if (vs_char(c) > widest) widest = vs_char(c);
    if (!vs_poll_turn(vm, (uint64_t)i, 1)) return VS_ERROR;
  }
  if (!vs_make_string(vm, (size_t)(end - start), widest, out)) return VS_ERROR;
  for (int64_t i = start; i < end; i++) {
    vs_string_put(*out, (size_t)(i - start), vs_char(vs_as_vector(a[0])->at[i]));
    if (!vs_poll_turn(vm, (uint64_t)i, 1)) return VS_ERROR;
  }
  return VS_OK;
}

static vs_status string_to_vector(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t start, end;
  if (!vs_arg_type(vm, a, 0, VS_T_STRING) || !vs_arg_range(vm, a, n, 1, vs_as_string(a[0])->length, &start, &end) ||
      !vs_make_vector(vm, (size_t)(end - start), VS_FALSE, out))
    return VS_ERROR;
  for (int64_t i = start; i < end; i++) {
    vs_as_vector(*out)->at[i - start] = VS_CHAR(vs_string_at(a[0], (size_t)i)); /* a character is no heap object, so
                                                                                 * that storing it needs no write
                                                                                 * barrier */
    if (!vs_poll_turn(vm, (uint64_t)i, 1)) return VS_ERROR;
  }
  return VS_OK;
}

/* ---- bytevectors ---- */

static bool arg_bytes(vs_scheme *vm, const vs_value *a, int arg) { return vs_arg_type(vm, a, arg, VS_T_BYTES); }
static int64_t bytes_length(vs_value v) { return (int64_t)vs_as_bytes(v)->length; }

static bool arg_byte(vs_scheme *vm, const vs_value *a, int arg, uint8_t *byte) {
  int64_t b;
  if (!vs_arg_index(vm, a, arg, 0, 255, &b)) return false;
  *byte = (uint8_t)b;
  return true;
}

static bool bytes_index(vs_scheme *vm, const vs_value *a, int64_t *k) {
  if (bytes_length(a[0]) == 0) return vs_fail(vm, vm->sym.range, "the bytevector is empty");
  return vs_arg_index(vm, a, 1, 0, bytes_length(a[0]) - 1, k);
}

static vs_status bytes_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  *out = vs_bool(vs_is(a[0], VS_T_BYTES));
  return VS_OK;
}

static vs_status bytes_make(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t count;
  uint8_t fill = 0;
  if (!vs_arg_index(vm, a, 0, 0, LONGEST, &count) || (n > 1 && !arg_byte(vm, a, 1, &fill)) ||
      !vs_make_bytes(vm, (size_t)count, out))
    return VS_ERROR;
  return fill == 0 || vs_poll_set(vm, vs_as_bytes(*out)->at, fill, (size_t)count);
}

static vs_status bytes_bytevector(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!vs_make_bytes(vm, (size_t)n, out)) return VS_ERROR;
  for (int i = 0; i < n; i++)
    if (!arg_byte(vm, a, i, &vs_as_bytes(*out)->at[i])) return VS_ERROR;
  return VS_OK;
}

static vs_status bytes_length_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_bytes(vm, a, 0)) return VS_ERROR;
  *out = vs_fix(bytes_length(a[0]));
  return VS_OK;
}

static vs_status bytes_ref(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t k;
  if (!arg_bytes(vm, a, 0) || !bytes_index(vm, a, &k)) return VS_ERROR;
  *out = vs_fix(vs_as_bytes(a[0])->at[k]);
  return VS_OK;
}

static vs_status bytes_set(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  int64_t k;
  uint8_t byte;
  if (!arg_mutable(vm, a, 0, VS_T_BYTES) || !bytes_index(vm, a, &k) || !arg_byte(vm, a, 2, &byte)) return VS_ERROR;
  vs_as_bytes(a[0])->at[k] = byte;
  return VS_OK;
}

static vs_status bytes_copy(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t start, end;
  if (!arg_bytes(vm, a, 0) || !vs_arg_range(vm, a, n, 1, bytes_length(a[0]), &start, &end) ||
      !vs_make_bytes(vm, (size_t)(end - start), out))
    return VS_ERROR;
  return vs_poll_move(vm, vs_as_bytes(*out)->at, vs_as_bytes(a[0])->at + start, (size_t)(end - start));
}

static vs_status bytes_copy_to(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  int64_t at, start, end;
  if (!arg_mutable(vm, a, 0, VS_T_BYTES) || !arg_bytes(vm, a, 2) ||
      !vs_arg_range(vm, a, n, 3, bytes_length(a[2]), &start, &end) ||
      !vs_arg_index(vm, a, 1, 0, bytes_length(a[0]), &at))
    return VS_ERROR;
  if (end - start > bytes_length(a[0]) - at)
    return vs_fail(vm, vm->sym.range, "%lld bytes do not fit behind index %lld of a bytevector of %lld",
                   (long long)(end - start), (long long)at, (long long)bytes_length(a[0]));
  return vs_poll_move(vm, vs_as_bytes(a[0])->at + at, vs_as_bytes(a[2])->at + start, (size_t)(end - start));
}

static vs_status bytes_append(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t total = 0;
  for (int i = 0; i < n; i++) {
    if (!arg_bytes(vm, a, i)) return VS_ERROR;
    total += bytes_length(a[i]);
  }
  if (!vs_make_bytes(vm, (size_t)total, out)) return VS_ERROR;
  uint8_t *at = vs_as_bytes(*out)->at;
  for (int i = 0; i < n; i++) {
    if (!vs_poll_move(vm, at, vs_as_bytes(a[i])->at, (size_t)bytes_length(a[i]))) return VS_ERROR;
    at += bytes_length(a[i]);
  }
  return VS_OK;
}

static vs_status bytes_fill(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  int64_t start, end;
  uint8_t byte;
  if (!arg_mutable(vm, a, 0, VS_T_BYTES) || !arg_byte(vm, a, 1, &byte) ||
      !vs_arg_range(vm, a, n, 2, bytes_length(a[0]), &start, &end))
    return VS_ERROR;
  return vs_poll_set(vm, vs_as_bytes(a[0])->at + start, byte, (size_t)(end - start));
}

static vs_status utf8_to_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t start, end;
  vs_text t;
  if (!arg_bytes(vm, a, 0) || !vs_arg_range(vm, a, n, 1, bytes_length(a[0]), &start, &end)) return VS_ERROR;
  if (!vs_poll(vm, (uint64_t)(end - start))) return VS_ERROR;
  for (int64_t i = start; i < end;) {
    uint32_t c;
    size_t used = vs_utf8_decode((const char *)vs_as_bytes(a[0])->at + i, (size_t)(end - i), &c);
    if (!used) return vs_fail(vm, vm->sym.range, "the bytes are not UTF-8 from index %lld on", (long long)i);
    i += (int64_t)used;
  }
  vs_text_open(vm, &t, 0); /* copies the bytes, since creating the string may move them */
  bool ok =
      vs_text_put(&t, (const char *)vs_as_bytes(a[0])->at + start, (size_t)(end - start)) && vs_text_to_string(&t, out);
  vs_text_close(&t);
  return ok;
}

static vs_status string_to_utf8(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t start, end;
  vs_text t;
  if (!vs_arg_type(vm, a, 0, VS_T_STRING) || !vs_arg_range(vm, a, n, 1, vs_as_string(a[0])->length, &start, &end))
    return VS_ERROR;
  vs_text_open(vm, &t, 0);
  bool ok = true;
  for (int64_t i = start; ok && i < end; i++)
    ok = vs_text_char(&t, vs_string_at(a[0], (size_t)i)) && vs_poll_turn(vm, (uint64_t)i, 4);
  ok = ok && vs_make_bytes(vm, t.count, out);
  if (ok && t.count) ok = vs_poll_move(vm, vs_as_bytes(*out)->at, t.at, t.count);
  vs_text_close(&t);
  return ok;
}

static const vs_native_def defs[] = {
  { "vector?", "x", vector_p, 0, NULL },
  { "make-vector", "n [fill]", vector_make, 0, NULL },
  { "vector", ". elements", vector_vector, 0, NULL },
  { "vector-length", "vector", vector_length_, 0, NULL },
  { "vector-ref", "vector index", vector_ref, 0, "the element at index, counted from 0" },
  { "vector-set!", "vector index value", vector_set, 0, NULL },
  { "vector->list", "vector [start end]", vector_to_list, 0, NULL },
  { "list->vector", "list", list_to_vector, 0, NULL },
  { "vector-fill!", "vector fill [start end]", vector_fill, 0, NULL },
  { "vector-copy subvector", "vector [start end]", vector_copy, 0, NULL },
  { "vector-copy!", "to at from [start end]", vector_copy_to, 0, NULL },
  { "vector-append", ". vectors", vector_append, 0, NULL },
  { "vector->string", "vector [start end]", vector_to_string, 0, NULL },
  { "string->vector", "string [start end]", string_to_vector, 0, NULL },
  { "bytevector?", "x", bytes_p, 0, NULL },
  { "make-bytevector", "n [byte]", bytes_make, 0, NULL },
  { "bytevector", ". bytes", bytes_bytevector, 0, NULL },
  { "bytevector-length", "bytevector", bytes_length_, 0, NULL },
  { "bytevector-u8-ref", "bytevector index", bytes_ref, 0, NULL },
  { "bytevector-u8-set!", "bytevector index byte", bytes_set, 0, NULL },
  { "bytevector-copy", "bytevector [start end]", bytes_copy, 0, NULL },
  { "bytevector-copy!", "to at from [start end]", bytes_copy_to, 0, NULL },
  { "bytevector-append", ". bytevectors", bytes_append, 0, NULL },
  { "bytevector-fill!", "bytevector byte [start end]", bytes_fill, 0, NULL },
  { "utf8->string", "bytevector [start end]", utf8_to_string, 0, NULL },
  { "string->utf8", "string [start end]", string_to_utf8, 0, NULL },
  { NULL, NULL, NULL, 0, NULL }
};
const vs_native_table vs_vector_natives = { "vector", defs };
