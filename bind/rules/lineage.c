/* Implements the records of derivations (lineage.h): which rule and operator created each scope. Also implements the
 * table that finds the record of an object. */
#include "bind/rules/lineage.h"

#include "bind/call/positional.h"
#include "bind/state.h"
#include "vm/values/heap.h"

vs_lineage *vs_lineage_new(vs_store *s) {
  vs_lineage *r = vs_store_realloc(s, NULL, 0, sizeof *r);
  if (r) *r = (vs_lineage){ .refs = 1, .store = vs_store_retain(s) };
  return r;
}

void vs_lineage_release(vs_lineage *r) {
  if (!r || --r->refs) return;
  vs_store *s = r->store;
  vs_store_realloc(s, r->at, r->room * sizeof *r->at, 0);
  vs_store_realloc(s, r->sites, r->site_room * sizeof *r->sites, 0);
  vs_store_realloc(s, r, sizeof *r, 0);
  vs_store_release(s);
}

bool vs_lineage_add(vs_lineage *r, vs_lineage_entry entry, const char *rule, const char *op, uint32_t *number) {
  /* Searches the pairs of rule and operator from the last to the first: a program has a few dozen, and mostly uses the
   * latest again. */
  size_t site = r->site_count;
  while (site > 0 && (r->sites[site - 1].rule != rule || r->sites[site - 1].op != op)) site--;
  if (site == 0) {
    if (!vs_store_grow(r->store, &r->sites, &r->site_room, r->site_count + 1, sizeof *r->sites)) return false;
    r->sites[r->site_count++] = (struct vs_lineage_site){ rule, op };
    site = r->site_count;
  }
  if (r->count >= UINT32_MAX || !vs_store_grow(r->store, &r->at, &r->room, r->count + 1, sizeof *r->at)) return false;
  entry.site = (uint32_t)(site - 1);
  *number = (uint32_t)r->count;
  r->at[r->count++] = entry;
  return true;
}

/* ---- the table of derived objects and their records ---- */

struct vs_kept_lineage {
  vs_node *node; /* node of the object, retained */
  vs_lineage *record;
};

static void let_go(struct vs_kept_lineage *k) {
  vs_lineage_release(k->record);
  vs_node_release(k->node);
}

bool vs_lineage_keep(vs_bind *b, vs_node *n, vs_lineage *r) {
  if (b->record_count >= b->record_limit) {
    size_t left = 0;
    for (size_t i = 0; i < b->record_count; i++) {
      if (b->records[i].node->refs == 1)
        let_go(&b->records[i]);
      else
        b->records[left++] = b->records[i];
    }
    b->record_count = left;
    b->record_limit = 2 * left + 16;
  }
  if (!vs_store_grow(b->store, &b->records, &b->record_room, b->record_count + 1, sizeof *b->records)) return false;
  b->records[b->record_count++] = (struct vs_kept_lineage){ vs_node_retain(n), vs_lineage_retain(r) };
  return true;
}

void vs_lineage_free(vs_bind *b) {
  while (b->record_count) let_go(&b->records[--b->record_count]);
  vs_store_realloc(b->store, b->records, b->record_room * sizeof *b->records, 0);
  b->records = NULL, b->record_room = b->record_limit = 0;
}

/* Returns the latest record of the node n. If n has no record and a single child, continues with this child. Returns
 * NULL if no record is found. */
static const vs_lineage *record_of(const vs_bind *b, const vs_node *n) {
  for (;;) {
    for (size_t i = b->record_count; i-- > 0;)
      if (b->records[i].node == n) return b->records[i].record;
    if (n->child_count != 1) return NULL;
    n = n->children[0].node;
  }
}

static bool symbol_or_false(vs_scheme *vm, const char *name, vs_value *out) {
  *out = VS_FALSE;
  return !name || vs_intern_c(vm, name, out);
}

/* (%derivation-record o): returns #f, or a vector with six values for each entry of the object's record, parents first.
 * The values are: the number of the parent entry, the position of the parent scope in it, the number of scopes, the
 * index of a single scope, the rule, the operator. */
vs_status vs_p_derivation_record(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const vs_lineage *r = record_of(vs_call_bind(f), vs_arg_ref(f, 0).node);
  VS_ROOTS(vm, v, 2);
  if (!r) return *out = VS_FALSE, VS_OK;
  if (!vs_make_vector(vm, 6 * r->count, VS_FALSE, &v[0])) return VS_ERROR;
  for (size_t i = 0; i < r->count; i++) {
    const vs_lineage_entry *e = &r->at[i];
    const uint32_t numbers[4] = { e->parent, e->position, e->count, e->index };
    for (int k = 0; k < 6; k++) {
      v[1] = k < 4 ? vs_fix(numbers[k]) : VS_FALSE;
      if (k >= 4 && !symbol_or_false(vm, k == 4 ? r->sites[e->site].rule : r->sites[e->site].op, &v[1]))
        return VS_ERROR;
      vs_gc_store(vm, vs_object_of(v[0]), &vs_as_vector(v[0])->at[6 * i + (size_t)k], v[1]);
    }
    if (!vs_poll_turn(vm, i, 8)) return VS_ERROR;
  }
  *out = v[0];
  return VS_OK;
}
