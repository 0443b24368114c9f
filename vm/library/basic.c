/* Implements basic procedures: equivalence, booleans, boxes, records and hash tables. */
#include "vm/machine/fail.h"
#include "vm/values/equal.h"
#include "vm/values/heap.h"
#include "vm/values/table.h"

/* ---- equivalence, booleans, kinds ---- */

static vs_status is_eq(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(a[0] == a[1]), VS_OK;
}
static vs_status is_eqv(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(vs_eqv(a[0], a[1])), VS_OK;
}
static vs_status is_equal(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  bool same;
  return vs_equal(vm, a[0], a[1], &same) ? (*out = vs_bool(same), VS_OK) : VS_ERROR;
}
static vs_status not_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(a[0] == VS_FALSE), VS_OK;
}
static bool boolean(vs_value v) { return v == VS_TRUE || v == VS_FALSE; }
static vs_status is_boolean(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(boolean(a[0])), VS_OK;
}
static vs_status is_procedure(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(vs_is_procedure(a[0])), VS_OK;
}

static vs_status boolean_equal(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  bool all = true;
  for (int i = 0; i < n; i++) {
    if (!boolean(a[i])) return vs_fail_type(vm, i, "#t or #f", a[i]);
    all = all && a[i] == a[0];
  }
  return *out = vs_bool(all), VS_OK;
}

static vs_status void_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)a, (void)n, *out = VS_UNSPECIFIC, VS_OK;
}
static vs_status is_void(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(a[0] == VS_UNSPECIFIC), VS_OK;
}

static vs_status hash_of(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return *out = vs_fix((int64_t)(vs_hash(vm, a[0], VS_TABLE_EQUAL, NULL) & 0xFFFFFFFF)), VS_OK;
}

/* ---- boxes ---- */

static vs_status box(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return (void)n, vs_make_box(vm, a[0], out); }
static vs_status is_box(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(vs_is(a[0], VS_T_BOX)), VS_OK;
}
static vs_status unbox(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_arg_type(vm, a, 0, VS_T_BOX) ? (*out = vs_as_box(a[0])->value, VS_OK) : VS_ERROR;
}
static vs_status set_box(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  if (!vs_arg_type(vm, a, 0, VS_T_BOX)) return VS_ERROR;
  vs_gc_store(vm, vs_as_box(a[0]), &vs_as_box(a[0])->value, a[1]);
  return VS_OK;
}

/* ---- records, for define-record-type. The fields of a type are a vector of symbols ---- */

static vs_status make_record_type(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  VS_ROOTS(vm, r, 1);
  int64_t count = vs_list_length(a[1]);
  if (count < 0) return vs_fail_type(vm, 1, "a list of symbols", a[1]);
  if (!vs_make_vector(vm, (size_t)count, VS_FALSE, &r[0])) return VS_ERROR;
  vs_value *field = vs_as_vector(r[0])->at;
  for (vs_value l = a[1]; vs_is_pair(l); l = vs_cdr(l)) vs_gc_store(vm, vs_as_vector(r[0]), field++, vs_car(l));
  vs_record_type *t = (vs_record_type *)(void *)vs_gc_alloc(vm, VS_T_RECORD_TYPE, VS_WORDS(vs_record_type));
  if (!t) return VS_ERROR;
  t->name = a[0];
  t->fields = r[0];
  t->parent = t->data = VS_FALSE;
  return *out = vs_from_object(t), VS_OK;
}

/* (%record type value ...): returns a new record. Fields without a value are #f. */
static vs_status record(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!vs_arg_type(vm, a, 0, VS_T_RECORD_TYPE)) return VS_ERROR;
  size_t count = vs_as_vector(vs_as_record_type(a[0])->fields)->length;
  vs_record *r = (vs_record *)(void *)vs_gc_alloc(vm, VS_T_RECORD, VS_WORDS(vs_record) + count);
  if (!r) return VS_ERROR;
  r->type = a[0];
  for (size_t i = 0; i < count; i++) r->at[i] = i + 1 < (size_t)n ? a[i + 1] : VS_FALSE;
  return *out = vs_from_object(r), VS_OK;
}

static vs_status is_record(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm;
  *out = vs_bool(vs_is(a[0], VS_T_RECORD) && (n < 2 || vs_as_record(a[0])->type == a[1]));
  return VS_OK;
}

/* Returns true if a[0] is a record of the type a[1] that has a field number a[2]. Otherwise sets the error "WHO:
 * expected a TYPE, got V", where WHO is a[who], the accessor's name. a[1] may be any value, since the program may
 * redefine the variable that contains the type. */
static bool has_field(vs_scheme *vm, const vs_value *a, int who) {
  VS_ROOTS(vm, r, 1);
  bool its = vs_is(a[0], VS_T_RECORD) && vs_as_record(a[0])->type == a[1];
  if (its && (uint64_t)vs_fixnum(a[2]) < vs_record_fields(vs_as_record(a[0]))) return true;
  vs_value type = vs_is(a[1], VS_T_RECORD_TYPE) ? vs_as_record_type(a[1])->name : VS_FALSE;
  vm->native = NULL;
  return vs_cons(vm, a[0], VS_NIL, &r[0]) && vs_fail_with(vm, vm->sym.type, r[0],
                                                          its ? "%s: expected a %s with such a field, got"
                                                              : "%s: expected a %s, got",
                                                          vs_is_symbol(a[who]) ? vs_as_symbol(a[who])->name : "record",
                                                          vs_is_symbol(type) ? vs_as_symbol(type)->name : "record");
}

/* (%record-ref record type index who): returns field number `index` of the record. who: name of the accessor, for
 * errors. */
static vs_status record_ref(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return has_field(vm, a, 3) ? (*out = vs_as_record(a[0])->at[vs_fixnum(a[2])], VS_OK) : VS_ERROR;
}

/* (%record-set! record type index value who): sets field number `index` of the record. who: name of the procedure, for
 * errors. */
static vs_status record_set(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  if (!has_field(vm, a, 4)) return VS_ERROR;
  vs_gc_store(vm, vs_as_record(a[0]), &vs_as_record(a[0])->at[vs_fixnum(a[2])], a[3]);
  return VS_OK;
}

/* ---- hash tables ---- */

static vs_status make_hash(vs_scheme *vm, uint32_t kind, vs_value *a, int n, vs_value *out) {
  if (!vs_make_table(vm, kind, out)) return VS_ERROR;
  if (n == 0) return VS_OK;
  VS_ROOTS(vm, r, 1);
  for (r[0] = a[0]; vs_is_pair(r[0]); r[0] = vs_cdr(r[0])) {
    if (!vs_is_pair(vs_car(r[0]))) return vs_fail_type(vm, 0, "a list of pairs", a[0]);
    if (!vs_table_put(vm, *out, vs_car(vs_car(r[0])), vs_cdr(vs_car(r[0])))) return VS_ERROR;
  }
  return r[0] == VS_NIL || vs_fail_type(vm, 0, "a list of pairs", a[0]);
}
static vs_status make_equal(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return make_hash(vm, VS_TABLE_EQUAL, a, n, out);
}
static vs_status make_eqv(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return make_hash(vm, VS_TABLE_EQV, a, n, out);
}

/* (hash k v ...): returns a new hash table with the value v for each key k. */
static vs_status hash(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n % 2) return vs_fail(vm, vm->sym.arity, "keys and values come in pairs, got %d arguments", n);
  if (!vs_make_table(vm, VS_TABLE_EQUAL, out)) return VS_ERROR;
  for (int i = 0; i < n; i += 2)
    if (!vs_table_put(vm, *out, a[i], a[i + 1])) return VS_ERROR;
  return VS_OK;
}

static vs_status is_hash(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(vs_is(a[0], VS_T_TABLE)), VS_OK;
}

static vs_status hash_get(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_arg_type(vm, a, 0, VS_T_TABLE) || !vs_table_get(vm, a[0], a[1], out)) return VS_ERROR;
  if (*out == VS_VACANT) *out = a[2];
  return VS_OK;
}
static vs_status hash_has(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_arg_type(vm, a, 0, VS_T_TABLE) || !vs_table_get(vm, a[0], a[1], out)) return VS_ERROR;
  return *out = vs_bool(*out != VS_VACANT), VS_OK;
}
static vs_status hash_set(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  return vs_arg_type(vm, a, 0, VS_T_TABLE) && vs_table_put(vm, a[0], a[1], a[2]);
}
static vs_status hash_remove(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  return vs_arg_type(vm, a, 0, VS_T_TABLE) && vs_table_remove(vm, a[0], a[1]);
}
static vs_status hash_clear(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  return vs_arg_type(vm, a, 0, VS_T_TABLE) && vs_table_clear(vm, a[0]);
}
static vs_status hash_count(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_arg_type(vm, a, 0, VS_T_TABLE) ? (*out = vs_fix(vs_as_table(a[0])->count), VS_OK) : VS_ERROR;
}

typedef enum { LIST_KEYS, LIST_VALUES, LIST_PAIRS } list_what;
/* Returns the keys, values or entries of a hash table as a list in insertion order. */
static vs_status hash_list(vs_scheme *vm, vs_value *a, list_what what, vs_value *out) {
  if (!vs_arg_type(vm, a, 0, VS_T_TABLE)) return VS_ERROR;
  VS_ROOTS(vm, r, 3);                             /* roots of the garbage collector: first pair, last pair, new
                                                   * element */
  uint32_t position = 0;
  vs_value key, value;
  r[0] = r[1] = VS_NIL;
  for (uint32_t i = 1; vs_table_next(a[0], &position, &key, &value); i++) {
    r[2] = what == LIST_KEYS ? key : value;
    if (what == LIST_PAIRS && !vs_cons(vm, key, value, &r[2])) return VS_ERROR;
    if (!vs_cons(vm, r[2], VS_NIL, &r[2]) || !vs_poll_turn(vm, i, 8)) return VS_ERROR;
    if (r[1] == VS_NIL) r[0] = r[2];
    else vs_gc_store(vm, vs_as_pair(r[1]), &vs_as_pair(r[1])->cdr, r[2]);
    r[1] = r[2];
  }
  return *out = r[0], VS_OK;
}
static vs_status hash_keys(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, hash_list(vm, a, LIST_KEYS, out);
}
static vs_status hash_values(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, hash_list(vm, a, LIST_VALUES, out);
}
static vs_status hash_to_list(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, hash_list(vm, a, LIST_PAIRS, out);
}

static vs_status hash_is_eqv(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_arg_type(vm, a, 0, VS_T_TABLE) ? (*out = vs_bool(vs_as_table(a[0])->kind != VS_TABLE_EQUAL), VS_OK)
                                           : VS_ERROR;
}

static vs_status hash_copy(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_arg_type(vm, a, 0, VS_T_TABLE) || !vs_make_table(vm, vs_as_table(a[0])->kind, out)) return VS_ERROR;
  uint32_t position = 0;
  vs_value key, value;
  while (vs_table_next(a[0], &position, &key, &value))
    if (!vs_table_put(vm, *out, key, value)) return VS_ERROR;
  return VS_OK;
}

static const vs_native_def defs[] = {
    {"eq?", "a b", is_eq, 0, NULL},
    {"eqv?", "a b", is_eqv, 0, NULL},
    {"equal?", "a b", is_equal, 0, "the same in content"},
    {"not", "x", not_, 0, NULL},
    {"boolean?", "x", is_boolean, 0, NULL},
    {"boolean=?", "a b . more", boolean_equal, 0, NULL},
    {"procedure?", "x", is_procedure, 0, NULL},
    {"void", ". ignored", void_, 0, NULL},
    {"void?", "x", is_void, 0, NULL},
    {"equal-hash hash-code", "x", hash_of, 0, NULL},
    {"box", "x", box, 0, NULL},
    {"box?", "x", is_box, 0, NULL},
    {"unbox", "box", unbox, 0, NULL},
    {"set-box!", "box x", set_box, 0, NULL},
    {"%make-record-type", "name fields", make_record_type, 0, NULL},
    {"%record", "type . values", record, 0, NULL},
    {"%record?", "x [type]", is_record, 0, NULL},
    {"%record-ref", "record type index who", record_ref, 0, NULL},
    {"%record-set!", "record type index value who", record_set, 0, NULL},
    {"make-hash make-equal-hash", "[alist]", make_equal, 0, "a hash table with keys by equal?"},
    {"make-hasheqv make-hasheq", "[alist]", make_eqv, 0, "a hash table with keys by eqv?"},
    {"hash", ". keys-and-values", hash, 0, NULL},
    {"hash? hash-table?", "x", is_hash, 0, NULL},
    {"%hash-get", "table key missing", hash_get, 0, NULL},
    {"hash-has-key? hash-contains? hash-table-contains? hash-table-exists?", "table key", hash_has, 0, NULL},
    {"hash-set! hash-table-set!", "table key value", hash_set, 0, NULL},
    {"hash-remove! hash-table-delete!", "table key", hash_remove, 0, NULL},
    {"hash-clear! hash-table-clear!", "table", hash_clear, 0, NULL},
    {"hash-count hash-table-count hash-table-size", "table", hash_count, 0, NULL},
    {"hash-keys hash-table-keys", "table", hash_keys, 0, "the keys, in the order of their insertion"},
    {"hash-values hash-table-values", "table", hash_values, 0, NULL},
    {"hash->list hash-table->alist", "table", hash_to_list, 0, "pairs of key and value, in the order of insertion"},
    {"%hash-eqv?", "table", hash_is_eqv, 0, NULL},
    {"hash-copy hash-table-copy", "table", hash_copy, 0, NULL},
    {NULL, NULL, NULL, 0, NULL},
};
const vs_native_table vs_basic_natives = {"basic", defs};
