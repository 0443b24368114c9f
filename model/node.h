/* Declares the model tree: immutable, hashed, reference-counted nodes.
 *
 * A node contains its kind, its payload (the fields of prims.def as a struct), references to its children, and a
 * structural hash, computed when it is created. Two nodes are equal when kind, payload and children are equal; origins
 * are not compared. A reference pairs a node with the origin of the constructor call that created it there. A model
 * outlives the interpreter that created it: each node keeps a reference to its store. Reference counts are not atomic:
 * only one thread creates and releases nodes; kernel threads only read them. */
#ifndef VS_MODEL_NODE_H
#define VS_MODEL_NODE_H

#include <stddef.h>
#include <stdint.h>

#include "model/assert.h"
#include "model/store/store.h"
#include "model/vec.h"

typedef struct vs_node vs_node;

/* ---- arrays that several nodes share: immutable and reference-counted ---- */
typedef struct { uint32_t refs, count; vs_vec3 at[]; } vs_points;
/* data: first count + 1 positions in the list of corners, where the faces begin and the last face ends; then this list,
 * corner_count vertex indices; hash: hash of data */
typedef struct { uint32_t refs, count, corner_count; uint64_t hash; uint32_t data[]; } vs_faces;
static inline const uint32_t *vs_faces_starts(const vs_faces *f) { return f->data; }
static inline const uint32_t *vs_faces_corners(const vs_faces *f) { return f->data + f->count + 1; }

/* ---- tickets: a ticket contains the number of an object outside the model, such as a Scheme procedure; when its last
 * reference is released, a callback gets this number ---- */
typedef struct { uint32_t refs, id; } vs_ticket;

/* ---- C types of the payload's fields ---- */
typedef double vs_field_real;
typedef int32_t vs_field_integer;
typedef bool vs_field_boolean;
typedef vs_vec3 vs_field_point;
typedef vs_vec3 vs_field_vector;
typedef vs_affine vs_field_affine;
typedef const vs_points *vs_field_points;
typedef const vs_faces *vs_field_faces;
typedef const char *vs_field_text; /* text of a field, interned in the store */
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
extern const unsigned char vs_field_reals[]; /* vs_field_reals[t]: number of doubles that a field of type t contains
                                              * directly; 0 for fields that refer to other memory */

/* Defines a struct of fields for each kind of prims.def, for example struct vs_sphere { ... }. */
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
  VS_MIXED /* class of a union whose members have different classes (solid, surface, curve ...) */,
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
  const char *name;  /* name of the kind, as object-kind returns it: "sphere" */
  vs_class class_;
  vs_level level;
  size_t size;       /* size of the kind's payload in bytes */
  size_t field_count;
  const vs_field_info *fields;
} vs_kind_info;
const vs_kind_info *vs_kind_get(vs_kind kind);

/* The role of a kind, and its traits below: the columns ROLE and TRAITS of prims.def, for walks through the tree
 * (vs_node_role, vs_node_has). */
typedef enum { VS_ROLE_SHAPE, VS_ROLE_LEAF, VS_ROLE_MADE, VS_ROLE_PLACED, VS_ROLE_WRAPPER, VS_ROLE_SET } vs_role;
enum {
  VS_IS_ROUND = 1,        /* trait of kinds whose triangles approximate a curved surface */
  VS_IS_SHORT = 2,        /* trait of kinds that every format writes in a few words */
  VS_IS_PLAIN = 4,        /* trait of kinds whose triangles geometry/tessellate.c computes from the fields alone, so
                           * that any thread may do it */
  VS_IS_CONVEX = 8,
  VS_IS_COSTLY = 16,      /* trait of kinds whose mesh takes about as long to compute as those of eight spheres */
  VS_IS_DEAR = 32,        /* trait of kinds whose mesh takes about as long to compute as those of forty spheres */
  VS_IS_SAMPLED = 64,     /* trait of kinds whose bounds are computed from many sample points; for a rotated node, the
                           * box is rotated instead */
  VS_IS_OVERLAPPING = 128, /* trait of kinds whose mesh may intersect itself */
  VS_IS_OF_FIRST = 256,   /* trait of kinds whose nodes are empty if their first child is empty */
  VS_IS_UNRESOLVED = 512  /* trait of kinds that solids/resolve.c replaces before meshing, because they depend on a
                           * solid's mesh or the drawing's size */
};
extern const unsigned char vs_kind_roles[];   /* vs_kind_roles[kind]: the vs_role of the kind */
extern const unsigned short vs_kind_traits[]; /* vs_kind_traits[kind]: the VS_IS_... flags of the kind */

typedef struct { vs_node *node; const vs_origin *origin; } vs_ref;

enum {
  VS_NODE_CLOSED = 1,  /* the node is a closed curve (perhaps placed or coloured) or a region */
  VS_NODE_ENDLESS = 2, /* the node is unbounded: a half-space, or a set with an unbounded result */
  VS_NODE_CUT = 4,     /* the node or a descendant is a half-space, which has no bounds */
  VS_NODE_SUGAR = 8,   /* the node or a descendant has a kind of level SUGAR in prims.def (such as ghost or
                        * highlight) */
  VS_NODE_OPEN = 16,   /* the node or a descendant is a CUSTOM node (of define-primitive) that has no child yet */
  VS_NODE_UNRESOLVED = 32, /* solids/resolve.c must replace this node or a descendant: an endless line, or a node that
                            * needs a solid's mesh (a section, shadow, edges, slice of a thin object, hull of a carved
                            * solid) */
  VS_NODE_CARVED = 64  /* the node or a descendant is an intersection or difference of solids */
};

struct vs_node {
  uint32_t refs;
  uint16_t kind;   /* kind of the node: a value of vs_kind */
  uint8_t class_;  /* class of the node (solid, surface, curve ...): a value of vs_class other than VS_INHERIT, set when
                    * the node is created */
  uint8_t flags;   /* flags of the node: bits VS_NODE_... */
  uint32_t child_count;
  uint32_t depth;  /* number of nodes on the longest path to a leaf, including both ends; 1 for a leaf. At its greatest
                    * value it no longer grows, so that it does not overflow. */
  uint32_t slot;   /* number of the node in the order of a drawing that was computed last (order.h); like refs, it
                    * changes after the node's creation */
  uint32_t form;   /* hash of the node's structure without numbers and placements: nodes of different form cannot be
                    * copies of each other */
  uint64_t hash;   /* hash of the node's kind, payload and children */
  vs_store *store;
  _Alignas(8) const vs_ref children[]; /* references to the children, child_count of them; the node's payload follows in
                                        * memory */
};
_Static_assert(sizeof(vs_node) % 8 == 0 && sizeof(vs_ref) % 8 == 0, "a payload begins at a multiple of 8 bytes");
/* Returns the payload of n, a struct vs_<kind> with its fields. */
static inline const void *vs_node_data(const vs_node *n) { return n->children + n->child_count; }
#define VS_ENDLESS_MESSAGE "the object is endless: intersect it with something finite, or subtract it from that"
/* Returns the payload of n as a struct of its kind. VS_AS(sphere, n) is the payload as a struct vs_sphere. The caller
 * has checked the kind of n. */
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

/* vs_node_next and vs_node_next_whole return child number i, for loops over the children in order. They prefetch
 * memory of a later child, because there may be a million: vs_node_next only its header, vs_node_next_whole also its
 * fields. */
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

/* Returns true if n is a boolean operation. */
static inline bool vs_node_is_set(const vs_node *n) { return vs_node_role(n) == VS_ROLE_SET; }

static inline bool vs_node_is_empty(const vs_node *n) { return n->kind == VS_EMPTY; }
/* Returns true if n is a wrapper: it occupies the same space as its single child. A GHOST is none, because it occupies
 * no space. */
static inline bool vs_node_is_wrapper(const vs_node *n) {
  return n->child_count == 1 && vs_node_role(n) == VS_ROLE_WRAPPER;
}

/* Returns true if n is a look or a name of its single child: a material, a layer or a part. */
static inline bool vs_node_is_look(const vs_node *n) {
  return n->kind == VS_MATERIAL || n->kind == VS_LAYER || n->kind == VS_PART;
}
/* Returns true if n is a placement, a look or a name of its single child. */
static inline bool vs_node_is_around(const vs_node *n) { return n->kind == VS_TRANSFORM || vs_node_is_look(n); }

/* ---- creating; these functions return a new reference, which the caller releases, or NULL when memory is out ---- */
vs_points *vs_points_new(vs_store *s, const vs_vec3 *at, size_t count);
vs_faces *vs_faces_new(vs_store *s, const uint32_t *starts, size_t count, const uint32_t *corners, size_t corner_count);
/* Returns the faces with the order of their corners reversed. Each face still begins with the same corner. */
vs_faces *vs_faces_turned(vs_store *s, const vs_faces *f);
vs_ticket *vs_ticket_new(vs_store *s, uint32_t id);
void vs_ticket_release(vs_store *s, const vs_ticket *t);
/* Adds a reference to p and returns p. */
vs_points *vs_points_retain(vs_points *p);
/* Adds a reference to f and returns f. */
vs_faces *vs_faces_retain(vs_faces *f);
void vs_points_release(vs_store *s, const vs_points *p);
void vs_faces_release(vs_store *s, const vs_faces *f);
/* Creates a node of the kind. data: a struct vs_<kind> with its fields, which is copied; children: references, which
 * are copied. Retains the arrays and nodes to which they refer. Does not check its arguments, because bind/ checks
 * them. */
vs_node *vs_node_new(vs_store *s, vs_kind kind, const void *data, const vs_ref *children, size_t child_count);
/* Adds a reference to n and returns n. */
vs_node *vs_node_retain(vs_node *n);
void vs_node_release(vs_node *n); /* Releases a reference to a node, which may be NULL, and frees the node after the
                                   * last. It does not recurse, so a deep tree needs no additional stack. */
/* Returns true if a and b are equal by value. Compares without recursion, and each pair of shared subtrees only once.
 * When memory is out, returns false and sets *ok to false; ok may be NULL. */
bool vs_node_equal(const vs_node *a, const vs_node *b, bool *ok);
size_t vs_node_bytes(const vs_node *n); /* Returns the number of bytes of this node and of the arrays to which it
                                         * refers, without its children. */
size_t vs_points_bytes(const vs_points *p);
size_t vs_faces_bytes(const vs_faces *f);

#endif
