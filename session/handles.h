/* Owns the values that a host holds: a table from handles to values of the heap, and the calls that hosts make. */
#ifndef VS_SESSION_HANDLES_H
#define VS_SESSION_HANDLES_H

#include "session/session.h"

/* An entry of the table; its value lies in the heap, in a vector of the same index (nodes.scm's room of at.host). */
typedef struct { uint32_t stamp, uses /* 0: free */, next; } vs_held;

/* A procedure of the host's, by the number that its Scheme procedure holds. */
typedef struct { vs_host_fn *fn; void *context; const char *name; /* the store's */ } vs_host_entry;

typedef struct { vs_handle property, value; } vs_posted;

typedef struct vs_host_object vs_host_object;

struct vs_handles {
  vs_held *at;
  size_t count, room;
  uint32_t free;      /* index + 1 of the first free entry; 0: none */
  uint32_t stamp;     /* of the newest; they are never used again, and begin at a number of the interpreter's own */
  vs_host_entry *procedures;
  size_t procedure_count, procedure_room;
  vs_posted *posted;  /* changes that wait for vs_update, oldest first; references of our own */
  size_t posted_count, posted_room;
  char *text;         /* what vs_handle_text gave last */
  size_t text_bytes;
  char failure[256];  /* what vs_host_fail said */
  vs_host_object *gone; /* objects of the host's that nothing holds any more; it has not been told yet */
};

void vs_session_forget_handles(vs_session *s); /* of a heap that is gone */
void vs_session_free_handles(vs_session *s);
/* Tells the host of its objects that the collector let go of. */
void vs_session_release_objects(vs_session *s);

/* The value of a handle. False: it is none of this interpreter's, or was released; the host has been told. */
bool vs_session_held(vs_session *s, const char *who, vs_handle h, vs_value *out);
/* A new handle, 0 where there is no memory; the host has been told. value in a root. */
vs_handle vs_session_hold(vs_session *s, const vs_value *value);

/* Calls the procedure of the language with this name; it may be one that programs do not see. argv in roots. *result in
 * a root, or NULL. */
vs_outcome vs_session_invoke(vs_session *s, const char *name, size_t count, const vs_value *argv, vs_value *result);

/* Runs something in the interpreter now? Then the host is told that `who` cannot be called. */
bool vs_session_busy(vs_session *s, const char *who);

/* The native that procedures of the host's are called through. */
vs_status vs_session_host_call(vs_scheme *vm, vs_value *a, int n, vs_value *out);

#endif
