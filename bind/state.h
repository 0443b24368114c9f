/* Owns the interface of state.c: the life of bind/'s data outside of the heap, and the rule for a file's model. */
#ifndef VS_BIND_STATE_H
#define VS_BIND_STATE_H

#include "geometry/measure/node_measures.h"
#include "model/scene.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;
typedef struct vs_bind_parameter vs_bind_parameter;
typedef struct vs_bind_setting vs_bind_setting;
typedef struct vs_bind_back_end vs_bind_back_end;

/* The drawing and all other data that an interpreter has beside its heap; vm->host points to it. */
struct vs_bind {
  vs_scheme *vm;
  vs_store *store;
  vs_scene scene;
  /* Top-level values: the model if nothing was drawn. Each may be a list. `returned` holds its own references. */
  /* shown: printed at the prompt, or drawn and later replaced; no warning that it was thrown away */
  struct { vs_node *node; const vs_origin *origin; bool shown; } *returned;
  size_t returned_count, returned_room;
  bool drew;                       /* the root has a drawing: top-level values do not count */
  const vs_node *drawn_last;       /* the result of the last draw: an address for comparisons, not a reference */
  const vs_node *drawn_away;       /* the same for a draw in a node that has lost the focus since */
  /* objects that bodies threw away, one for each place (thrown.c); holds its own references */
  struct { vs_node *node; const vs_origin *origin; } dropped[16];
  size_t dropped_count;
  uint64_t *told;                  /* the given warnings: hashes of place and kind, open addressing, 0 is free */
  size_t told_count, told_room;
  /* the origins of the latest call chains, valid since that collection */
  struct { uint64_t key; const vs_origin *origin; } recent[64];
  uint64_t recent_collection;
  vs_bind_parameter *parameters;
  size_t parameter_count, parameter_room;
  vs_bind_setting *settings;
  size_t setting_count, setting_room;
  size_t refused;                  /* the number of refused allocations; distinguishes 'no such thing' from 'no
                                    * memory' */
  uint32_t library_files;          /* smaller numbers are the language's own files; so are the files of
                                    * vs_config.shipped */
  vs_inside_cache *inside;         /* the data that contains? has prepared; NULL at first */
  /* Users' kinds (custom.c): the ticket of each number that some node holds, and the numbers that no node holds any
   * more. */
  vs_ticket **tickets;
  uint32_t *gone;
  size_t ticket_count, ticket_room, gone_count;
  vs_error handed;                 /* The fault of a drawing function's result, with the object's place; kind NONE: no
                                    * fault. */
  /* A node of the scene has the focus: the drawing is that node's, and top-level values are no model. */
  bool away;
  /* Calls the host's procedure of the number in the first argument; NULL: there is no host. */
  vs_native_fn *host_call;
  bool handing;                    /* a drawing function is running: draw returns its object, and nothing changes the
                                    * scene */
  struct vs_derivation *growing;   /* the derivation of the running rule; NULL: none (rules/derivation.h) */
  /* The results of derivations with their records (rules/lineage.h); dead ones are removed at the limit. */
  struct vs_kept_lineage *records;
  size_t record_count, record_room, record_limit;
  vs_bind_back_end *back_ends;
  size_t back_end_count, back_end_room;
  bool (*is_built_in)(const char *name); /* returns true for a name or an ending of the library's own formats */
  bool (*is_format)(const vs_bind *b, const char *name); /* returns true if `register-drawing-function` may name it */
  size_t mesh_triangles;           /* the most triangles of an output, also for meshes made before the output; 0: no
                                    * limit */
  bool bad_parameter;              /* the current error is the fault of a -D value: exit 2 */
  /* The host's procedure that shows a warning; origin NULL: no place. */
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  void *warn_context;
};

static inline vs_bind *vs_bind_of(vs_scheme *vm) { return (vs_bind *)vm->host; }

/* Counts of objects: a union counts its children, once for each placement; any other operation is one object. By class,
 * from index VS_CURVE. Returns false when memory is out. */
typedef struct { double all, of[VS_INHERIT]; } vs_bind_counts;

bool vs_bind_open(vs_bind *b, vs_scheme *vm, vs_store *store); /* b must be zero; returns false when memory is out */
void vs_bind_close(vs_bind *b);
void vs_bind_restart(vs_bind *b); /* resets b except for the settings of parameters; the old heap must be gone */
void vs_bind_clear_drawing(vs_bind *b);
/* Keeps the objects in a top-level value. Returns false with the error set. */
bool vs_bind_returned(vs_bind *b, vs_value v, bool shown);
/* Returns true if nothing was drawn, so the top-level values are the model. Otherwise warns of those that the program
 * threw away. */
bool vs_bind_finish(vs_bind *b);
bool vs_bind_count(vs_ref ref, vs_bind_counts *out);

#endif
