/* Owns the record of a derivation: a tree of the scopes, with the rule and the operator that made them. All scopes that
 * one operator made take twenty bytes together; frames and sizes are not kept.
 *
 * A table of the interpreter keeps the records with their objects. It holds a reference to each object. When it has
 * doubled, it releases the objects that have no other references. */
#ifndef VS_BIND_RULES_LINEAGE_H
#define VS_BIND_RULES_LINEAGE_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* The scopes that one operator made from the scope at `position` of the entry `parent`. The first entry is the root,
 * its own parent. */
typedef struct {
  uint32_t parent, position, count;
  uint32_t index; /* the index of a single scope; with several scopes, their positions are their indices */
  uint32_t site;  /* rule and operator, by their number in the record's table */
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
/* Adds an entry for the operator op of a rule (NULL: outside of any rule); the store owns the texts. *number: the
 * entry's place. Returns false when memory is out. */
bool vs_lineage_add(vs_lineage *r, vs_lineage_entry entry, const char *rule, const char *op, uint32_t *number);

/* Keeps the record of a derivation's object. Returns false when memory is out. */
bool vs_lineage_keep(vs_bind *b, vs_node *n, vs_lineage *r);
void vs_lineage_free(vs_bind *b); /* releases all of them */

#endif
