/* Declares the data that an interpreter has outside of its Scheme heap, and the functions of state.c for these data. */
#ifndef VS_BIND_STATE_H
#define VS_BIND_STATE_H

#include "geometry/measure/node_measures.h"
#include "model/job.h"
#include "model/scene.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;
typedef struct vs_bind_parameter vs_bind_parameter;
typedef struct vs_bind_report vs_bind_report;
typedef struct vs_design_rule vs_design_rule;
typedef struct vs_bind_setting vs_bind_setting;
typedef struct vs_bind_back_end vs_bind_back_end;

/* The drawing and all other data of an interpreter outside of its heap. vm->host points to it. */
struct vs_bind {
  vs_scheme *vm;
  vs_store *store;
  vs_scene scene;
  /* The top-level values: objects that are values of top-level expressions. If nothing was drawn, they are the model.
   * Their nodes are retained. */
  /* shown: whether the value was printed at the prompt, or was drawn and later replaced; vs then does not warn that it
   * is unused */
  struct { vs_node *node; const vs_origin *origin; bool shown; } *returned;
  size_t returned_count, returned_room;
  bool drew;                       /* whether the program has drawn in the root node, so that the top-level values are
                                    * not the model */
  const vs_node *drawn_last;       /* node that the last `draw` returned, by which its result is recognized; not
                                    * retained */
  const vs_node *drawn_away;       /* value of drawn_last for a scene node that has lost the focus; not retained */
  /* the program's unused objects: values of expressions in bodies, at most one for each place (thrown.c); nodes
   * retained */
  struct { vs_node *node; const vs_origin *origin; } dropped[16];
  size_t dropped_count;
  uint64_t *told;                  /* hash table of the warnings that were given: each entry is a hash of place and
                                    * kind, or 0 if free */
  size_t told_count, told_room;
  /* Cache of origins of recent call chains, valid until the next garbage collection. */
  struct { uint64_t key; const vs_origin *origin; } recent[64];
  uint64_t recent_collection;
  vs_bind_parameter *parameters;
  size_t parameter_count, parameter_room;
  vs_bind_report *reports;         /* numbers that the program has reported, in the order of the first report of each */
  size_t report_count, report_room;
  vs_design_rule *design_rules;    /* rules of the design that the program has tested, in their order */
  size_t design_rule_count, design_rule_room;
  vs_bind_setting *settings;
  size_t setting_count, setting_room;
  size_t refused;                  /* number of refused allocations so far; if it has grown during a search, a result
                                    * 'not found' means that memory is out */
  uint32_t library_files;          /* files with smaller numbers are sources of the language, as are the files of
                                    * vs_config.shipped */
  vs_inside_cache *inside;         /* data that the procedure contains? has prepared for its last object, or NULL */
  /* Objects of kinds that users define (custom.c). tickets[n]: the counter of the nodes with number n, or NULL if there
   * is none. gone: numbers whose last node was released. */
  vs_ticket **tickets;
  uint32_t *gone;
  size_t ticket_count, ticket_room, gone_count;
  vs_error handed;                 /* fault in the result of a drawing function, with the place of the object; kind
                                    * VS_ERROR_NONE if there is no fault */
  /* whether a scene node other than the root has the focus. Then the drawing is that of this node, and top-level values
   * are not the model */
  bool away;
  /* Native that calls the host's procedure whose number is its first argument; NULL if there is no host. */
  vs_native_fn *host_call;
  bool handing;                    /* whether a drawing function is running; `draw` then only returns its argument, and
                                    * the scene does not change */
  struct vs_derivation *growing;   /* derivation of the running rule (rules/derivation.h), or NULL */
  /* Objects that derivations have created, with their records (rules/lineage.h). When the table is full, objects
   * without other references are removed. */
  struct vs_kept_lineage *records;
  size_t record_count, record_room, record_limit;
  vs_bind_back_end *back_ends;
  size_t back_end_count, back_end_room;
  bool (*is_built_in)(const char *name); /* returns true if the name or suffix is that of a built-in format */
  bool (*is_format)(const vs_bind *b, const char *name); /* returns true if the name is that of a format for
                                                          * register-drawing-function */
  size_t mesh_triangles;           /* greatest number of triangles in an output, also for meshes computed before the
                                    * output; 0: no limit */
  bool bad_parameter;              /* whether a setting by the option -D caused the current error; the exit status is
                                    * then 2 */
  /* Limits, progress and messages of long computations in procedures. Its context pointer is the vs_bind. When a limit
   * of the program ends a computation, the VM's error is set. The host sets the job's members warn and tally. */
  vs_job job;
};

static inline vs_bind *vs_bind_of(vs_scheme *vm) { return (vs_bind *)vm->host; }

/* Counts of objects. A union counts as its children, once for each place of the union; every other operation is one
 * object. of[c] is the number of objects of class c. */
typedef struct { double all, of[VS_INHERIT]; } vs_bind_counts;

bool vs_bind_open(vs_bind *b, vs_scheme *vm, vs_store *store); /* Initialises b, all bytes of which must be zero before.
                                                                * Returns false when memory is out. */
void vs_bind_close(vs_bind *b);
void vs_bind_restart(vs_bind *b); /* Resets b for another run, except for the settings of parameters. The old heap must
                                   * have been freed. */
void vs_bind_clear_drawing(vs_bind *b);
/* Stores the objects in a top-level value as a possible part of the model. If it fails, sets the error and returns
 * false. */
bool vs_bind_returned(vs_bind *b, vs_value v, bool shown);
/* Returns true if nothing was drawn, so that the top-level values are the model. Otherwise warns about top-level values
 * that were not drawn. */
bool vs_bind_finish(vs_bind *b);
/* Counts the objects of ref. Returns false, with the error in e, if memory is out or the run is interrupted. */
bool vs_bind_count(vs_ref ref, vs_bind_counts *out, vs_error *e);

#endif
