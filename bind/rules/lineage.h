/* Owns the record of a derivation: which rule and operator made which scopes, as a tree. Twenty bytes for all scopes
 * that one operator made; frames and sizes are not kept.
 *
 * The records of objects that are still there are kept beside them, in a table of the interpreter: it holds a reference
 * to each object, and when it has grown twofold it lets go of those that nobody else holds. */
#ifndef VS_BIND_RULES_LINEAGE_H
#define VS_BIND_RULES_LINEAGE_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* The scopes that one operator made of the scope at `position` of the entry `parent`. The first entry's parent is
 * itself: it is the root. */
typedef struct {
  uint32_t parent, position, count;
  uint32_t index; /* of the scope, where there is one; of several the position is the index */
  uint32_t site;  /* rule and operator: in the record's table */
} vs_lineage_entry;

typedef struct vs_lineage vs_lineage;
struct vs_lineage {
  uint32_t refs;
  vs_store *store; /* retained */
  vs_lineage_entry *at;
  size_t count, room;
  struct vs_lineage_site {
    const char *rule, *op;
  } *sites;
  size_t site_count, site_room;
};

vs_lineage *vs_lineage_new(vs_store *s); /* NULL: out of memory */
static inline vs_lineage *vs_lineage_retain(vs_lineage *r) {
  r->refs++;
  return r;
}
void vs_lineage_release(vs_lineage *r); /* NULL is fine */
/* Adds an entry made by the operator op of a rule (NULL: of none); texts are the store's. *number: its place. False:
 * out of memory. */
bool vs_lineage_add(vs_lineage *r, vs_lineage_entry entry, const char *rule, const char *op, uint32_t *number);

/* Keeps the record of the object that a derivation gave. False: out of memory. */
bool vs_lineage_keep(vs_bind *b, vs_node *n, vs_lineage *r);
void vs_lineage_free(vs_bind *b); /* lets go of all of them */

#endif
