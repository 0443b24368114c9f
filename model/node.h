/* Owns the model tree: immutable, hashed, reference-counted nodes.
 *
 * A node is plain data: kind, payload (the fields of prims.def as a struct), child references, and a structural hash,
 * computed when it is built. Two nodes are equal by value when kind, payload and the children's nodes are equal;
 * origins do not count. A reference pairs a node with the origin of the constructor call that placed it there. A model
 * outlives the interpreter that built it: nodes hold their store. Reference counts are not atomic: one thread builds
 * and releases; kernel threads only read. */
#ifndef VS_MODEL_NODE_H
#define VS_MODEL_NODE_H

#include <stddef.h>
#include <stdint.h>

#include "model/assert.h"
#include "model/store/store.h"
#include "model/vec.h"

typedef struct vs_node vs_node;

/* ---- shared arrays: immutable once made, reference counted ---- */
typedef struct { uint32_t refs, count; vs_vec3 at[]; } vs_points;
/* data: count + 1 starts, then corner_count indices; hash: of data */
typedef struct { uint32_t refs, count, corner_count; uint64_t hash; uint32_t data[]; } vs_faces;
static inline const uint32_t *vs_faces_starts(const vs_faces *f) { return f->data; }
static inline const uint32_t *vs_faces_corners(const vs_faces *f) { return f->data + f->count + 1; }

/* ---- tickets: each is the number of an object outside the model; its owner learns when no node holds it any more
 * ---- */
typedef struct { uint32_t refs, id; } vs_ticket;

/* ---- payload types ---- */
typedef double vs_field_real;
typedef int32_t vs_field_integer;
typedef bool vs_field_boolean;
typedef vs_vec3 vs_field_point;
typedef vs_vec3 vs_field_vector;
typedef vs_affine vs_field_affine;
typedef const vs_points *vs_field_points;
typedef const vs_faces *vs_field_faces;
typedef const char *vs_field_text; /* interned in the store */
typedef const vs_material *vs_field_material;
typedef const vs_ticket *vs_field_ticket;
typedef enum {
  VS_FIELD_real,
  VS_FIELD_integer,
  VS_FIELD_boolean,
  VS_FIELD_point,
  VS_FIELD_vector,
  VS_FIELD_affine,
  VS_FIELD_points,
  VS_FIELD_faces,
  VS_FIELD_text,
  VS_FIELD_material,
  VS_FIELD_ticket
} vs_field_type;
extern const unsigned char vs_field_reals[]; /* by type: the number of doubles in the field itself, or 0 */

/* struct vs_sphere { ... } and so on for every kind */
#define VS_KIND(upper, lower, name, class_, level, role, traits) struct vs_##lower {
#define VS_FIELD(type, member, argument) vs_field_##type member;
#define VS_KIND_END(upper, lower) unsigned char end_; };
#include "model/prims.def"

typedef enum {
#define VS_KIND(upper, lower, name, class_, level, role, traits) VS_##upper,
#define VS_FIELD(type, member, argument)
#define VS_KIND_END(upper, lower)
#include "model/prims.def"
  VS_KIND_COUNT
} vs_kind;

typedef enum {
  VS_NOTHING,
  VS_CURVE,
  VS_REGION_CLASS,
  VS_SURFACE,
  VS_SOLID,
  VS_MIXED /* a union of several classes */,
  VS_INHERIT
} vs_class;
typedef enum {
  VS_LEVEL_MESH,
  VS_LEVEL_FLAT,
  VS_LEVEL_CURVED,
  VS_LEVEL_SWEPT,
  VS_LEVEL_OPERATION,
  VS_LEVEL_SUGAR
} vs_level;

typedef struct { const char *name, *argument; vs_field_type type; size_t offset; } vs_field_info;
typedef struct {
  const char *name;  /* the result of object-kind: "sphere" */
  vs_class class_;
  vs_level level;
  size_t size;       /* of the payload */
  size_t field_count;
  const vs_field_info *fields;
} vs_kind_info;
const vs_kind_info *vs_kind_get(vs_kind kind);

/* The last two columns of prims.def, for walks of the tree: vs_node_role, vs_node_has. */
typedef enum { VS_ROLE_SHAPE, VS_ROLE_LEAF, VS_ROLE_MADE, VS_ROLE_PLACED, VS_ROLE_WRAPPER, VS_ROLE_SET } vs_role;
enum {
  VS_IS_ROUND = 1,        /* its triangles approximate a smooth surface */
  VS_IS_SHORT = 2,        /* every format writes it in a few words, regardless of its numbers */
  VS_IS_PLAIN = 4,        /* geometry/tessellate.c makes its triangles only from its own numbers: any thread may do
                           * so */
  VS_IS_CONVEX = 8,
  VS_IS_COSTLY = 16,      /* meshing it costs about as much as meshing eight spheres */
  VS_IS_DEAR = 32,        /* meshing it costs about as much as meshing forty spheres */
  VS_IS_SAMPLED = 64,     /* its own bounds come from fine samples: if it is turned, the box around its turned box
                           * suffices */
  VS_IS_OVERLAPPING = 128, /* its mesh may intersect itself */
  VS_IS_OF_FIRST = 256,   /* it is empty if its first child is */
  VS_IS_UNRESOLVED = 512  /* solids/resolve.c replaces it before meshing: it needs a solid's mesh or the drawing's
                           * size */
};
extern const unsigned char vs_kind_roles[];   /* by kind: vs_role */
extern const unsigned short vs_kind_traits[]; /* by kind: VS_IS_... */

typedef struct { vs_node *node; const vs_origin *origin; } vs_ref;

enum {
  VS_NODE_CLOSED = 1,  /* a closed curve, also moved, coloured or bare; a region too */
  VS_NODE_ENDLESS = 2, /* a half-space, or a set that no finite operand bounds */
  VS_NODE_CUT = 4,     /* it contains a half-space */
  VS_NODE_SUGAR = 8,   /* it contains a node of level SUGAR */
  VS_NODE_OPEN = 16,   /* it contains a CUSTOM without a child */
  VS_NODE_UNRESOLVED = 32, /* it contains a node that needs a solid's mesh: a section, a shadow, edges, a slice of
                            * something thin, a hull of a carved solid; or a line without end (solids/resolve.h) */
  VS_NODE_CARVED = 64  /* it contains an intersection or a difference of solids */
};

struct vs_node {
  uint32_t refs;
  uint16_t kind;   /* vs_kind */
  uint8_t class_;  /* vs_class, never VS_INHERIT: computed when the node is built */
  uint8_t flags;   /* VS_NODE_... */
  uint32_t child_count;
  uint32_t depth;  /* 1 for a leaf; saturates */
  uint32_t slot;   /* its number in the last order (order.h): the only member that changes */
  uint32_t form;   /* a hash of its structure without numbers and places: possible copies have the same form */
  uint64_t hash;   /* structural */
  vs_store *store;
  const vs_ref children[]; /* child_count of them; the payload follows */
};
/* Returns the payload: struct vs_<kind>. */
static inline const void *vs_node_data(const vs_node *n) { return n->children + n->child_count; }
#define VS_ENDLESS_MESSAGE "the object is endless: intersect it with something finite, or subtract it from that"
/* VS_AS(sphere, n)->radius is a field of a sphere's payload; the caller has checked n->kind. */
static inline const void *vs_node_data_of(const vs_node *n, vs_kind kind) {
  VS_ASSERT(n->kind == kind);
  (void)kind;
  return vs_node_data(n);
}
enum {
#define VS_KIND(upper, lower, name, class_, level, role, traits) VS_KIND_OF_##lower = VS_##upper,
#define VS_FIELD(type, member, argument)
#define VS_KIND_END(upper, lower)
#include "model/prims.def"
  VS_KIND_OF_END
};
#define VS_AS(lower, n) ((const struct vs_##lower *)vs_node_data_of(n, (vs_kind)VS_KIND_OF_##lower))

/* Returns child i, for callers that visit children in sequence, and prefetches a later one, since there may be a
 * million: with its payload, or only its header. */
enum { VS_NODES_AHEAD = 24 };
static inline const vs_ref *vs_node_next_whole(const vs_node *n, uint32_t i) {
  if (n->child_count - i > VS_NODES_AHEAD) {
    __builtin_prefetch(n->children[i + VS_NODES_AHEAD].node);
    __builtin_prefetch((const char *)n->children[i + VS_NODES_AHEAD].node + 64);
  }
  return &n->children[i];
}
static inline const vs_ref *vs_node_next(const vs_node *n, uint32_t i) {
  if (n->child_count - i > VS_NODES_AHEAD) __builtin_prefetch(n->children[i + VS_NODES_AHEAD].node);
  return &n->children[i];
}

static inline vs_role vs_node_role(const vs_node *n) { return (vs_role)vs_kind_roles[n->kind]; }
static inline bool vs_node_has(const vs_node *n, unsigned trait) { return (vs_kind_traits[n->kind] & trait) != 0; }

/* Returns true for the boolean operations. */
static inline bool vs_node_is_set(const vs_node *n) { return vs_node_role(n) == VS_ROLE_SET; }

/* Returns true for kinds that occupy the same space as their one child. (A GHOST occupies none.) */
static inline bool vs_node_is_wrapper(const vs_node *n) {
  return n->child_count == 1 && vs_node_role(n) == VS_ROLE_WRAPPER;
}

/* ---- building. All return one new reference to the caller, NULL when memory is out. ---- */
vs_points *vs_points_new(vs_store *s, const vs_vec3 *at, size_t count);
vs_faces *vs_faces_new(vs_store *s, const uint32_t *starts, size_t count, const uint32_t *corners, size_t corner_count);
/* reversed, each from the same first corner */
vs_faces *vs_faces_turned(vs_store *s, const vs_faces *f);
vs_ticket *vs_ticket_new(vs_store *s, uint32_t id);
void vs_ticket_release(vs_store *s, const vs_ticket *t);
/* The array is alive. */
vs_points *vs_points_retain(vs_points *p);
/* The array is alive. */
vs_faces *vs_faces_retain(vs_faces *f);
void vs_points_release(vs_store *s, const vs_points *p);
void vs_faces_release(vs_store *s, const vs_faces *f);
/* Copies data (struct vs_<kind>; retains its arrays) and children (retains their nodes). Does not check its arguments:
 * bind/ does. */
vs_node *vs_node_new(vs_store *s, vs_kind kind, const void *data, const vs_ref *children, size_t child_count);
/* The node is alive: a reference exists. */
vs_node *vs_node_retain(vs_node *n);
void vs_node_release(vs_node *n); /* iterative: a deep tree needs no more stack; NULL is fine */
/* Compares by value, without recursion, each pair of shared subtrees once. When memory is out, returns false, and *ok
 * (ok may be NULL) is false. */
bool vs_node_equal(const vs_node *a, const vs_node *b, bool *ok);
size_t vs_node_bytes(const vs_node *n); /* of this node alone, with its arrays */
size_t vs_points_bytes(const vs_points *p);
size_t vs_faces_bytes(const vs_faces *f);

#endif
