/* Declares the record of a derivation: the tree of its scopes, with the rule and the operator that created each scope.
 * An entry of twenty bytes represents all scopes of one call of an operator. Positions and sizes are not recorded.
 *
 * The interpreter has a table of derived objects and their records, which holds a reference to each object. Whenever
 * the table has doubled in size, objects without other references are removed. */
#ifndef VS_BIND_RULES_LINEAGE_H
#define VS_BIND_RULES_LINEAGE_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* An entry of the record: the `count` scopes that one operator created from one scope, which is number `position` of
 * entry `parent`. The first entry is the root, which is its own parent. */
typedef struct {
  uint32_t parent, position, count;
  uint32_t index; /* index of a single scope among the children of its operator; in an entry of several scopes, the
                   * index of each is its position */
  uint32_t site;  /* index of the pair (rule, operator) in the record's table of such pairs */
} vs_lineage_entry;

typedef struct vs_lineage vs_lineage;
struct vs_lineage {
  uint32_t refs;
  vs_store *store; /* the store in which the record allocates memory, retained */
  vs_lineage_entry *at;
  size_t count, room;
  struct vs_lineage_site {
    const char *rule, *op;
  } *sites;
  size_t site_count, site_room;
};

vs_lineage *vs_lineage_new(vs_store *s); /* Returns an empty record, or NULL when memory is out. */
static inline vs_lineage *vs_lineage_retain(vs_lineage *r) {
  r->refs++;
  return r;
}
void vs_lineage_release(vs_lineage *r); /* Releases a reference to the record. NULL is permitted. */
/* Adds an entry for scopes that the operator op has created in a rule (NULL: outside of any rule). The store owns the
 * two names. Sets *number to the entry's number. Returns false when memory is out. */
bool vs_lineage_add(vs_lineage *r, vs_lineage_entry entry, const char *rule, const char *op, uint32_t *number);

/* Adds the object n of a derivation, and the derivation's record, to the table. Returns false when memory is out. */
bool vs_lineage_keep(vs_bind *b, vs_node *n, vs_lineage *r);
void vs_lineage_free(vs_bind *b); /* Frees the table, and releases all its objects and records. */

#endif
