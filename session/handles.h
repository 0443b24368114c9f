/* Owns the interface of handles.c: a table from handles to values of the heap, and the calls of hosts. */
#ifndef VS_SESSION_HANDLES_H
#define VS_SESSION_HANDLES_H

#include "session/session.h"

/* An entry of the table; its value lies in the heap, in a vector at the same index (at.host, beside nodes.scm's
 * entry). */
typedef struct { uint32_t stamp, uses /* 0: free */, next; } vs_held;

/* A host's procedure, by the number that its Scheme procedure holds. */
typedef struct { vs_host_fn *fn; void *context; const char *name; /* owned by the store */ } vs_host_entry;

typedef struct { vs_handle property, value; } vs_posted;

typedef struct vs_host_object vs_host_object;

struct vs_handles {
  vs_held *at;
  size_t count, room;
  uint32_t free;      /* index + 1 of the first free entry; 0: none */
  uint32_t stamp;     /* the newest stamp; stamps are never used again, and begin at a number specific to the
                       * interpreter */
  vs_host_entry *procedures;
  size_t procedure_count, procedure_room;
  vs_posted *posted;  /* changes that wait for vs_update, oldest first; holds its own references */
  size_t posted_count, posted_room;
  char *text;         /* the last result of vs_handle_text */
  size_t text_bytes;
  char failure[256];  /* the last message of vs_host_fail */
  vs_host_object *gone; /* the host's objects without references, not yet released by the host */
};

void vs_session_forget_handles(vs_session *s); /* forgets the handles of a freed heap */
void vs_session_free_handles(vs_session *s);
/* Calls the host's release function for each object that the collector has freed. */
void vs_session_release_objects(vs_session *s);

/* Sets *out to the value of a handle. Returns false with the error reported if it is not this interpreter's or was
 * released. */
bool vs_session_held(vs_session *s, const char *who, vs_handle h, vs_value *out);
/* Returns a new handle; 0 with the error reported when memory is out. value in a root. */
vs_handle vs_session_hold(vs_session *s, const vs_value *value);

/* Calls the language's procedure of this name, which may be hidden from programs. argv in roots. *result in a root, or
 * NULL. */
vs_outcome vs_session_invoke(vs_session *s, const char *name, size_t count, const vs_value *argv, vs_value *result);

/* Returns true, and reports that `who` cannot be called, if the interpreter is running. */
bool vs_session_busy(vs_session *s, const char *who);

/* The native that calls the host's procedures. */
vs_status vs_session_host_call(vs_scheme *vm, vs_value *a, int n, vs_value *out);

#endif
