/* Declares the table from handles to values of the heap, and the calls between host and program, which handles.c
 * implements. */
#ifndef VS_SESSION_HANDLES_H
#define VS_SESSION_HANDLES_H

#include "session/session.h"

/* An entry of the table of handles. The entry's value is in the heap, at the same index in a vector of at.host. uses:
 * number of the host's references to the handle; 0: the entry is free */
typedef struct { uint32_t stamp, uses, next; } vs_held;

/* A procedure of the host. A Scheme procedure that contains the index of this entry calls the host's procedure. */
typedef struct { vs_host_fn *fn; void *context; const char *name; /* name: owned by the store */ } vs_host_entry;

typedef struct { vs_handle property, value; } vs_posted;

typedef struct vs_host_object vs_host_object;

struct vs_handles {
  vs_held *at;
  size_t count, room;
  uint32_t free;      /* index + 1 of the first free entry, or 0 */
  uint32_t stamp;     /* the latest stamp; an interpreter uses no stamp twice, and two interpreters begin with different
                       * stamps */
  vs_host_entry *procedures;
  size_t procedure_count, procedure_room;
  vs_posted *posted;  /* property changes that wait for vs_update, oldest first; they hold references to their
                       * handles */
  size_t posted_count, posted_room;
  char *text;         /* the text that vs_handle_text returned last */
  size_t text_bytes;
  char failure[256];  /* message that the host passed to vs_host_fail last */
  vs_host_object *gone; /* list of host objects without references whose release function must still be called */
};

void vs_session_forget_handles(vs_session *s); /* Deletes all handles, because the heap that contains their values is
                                                * freed. */
void vs_session_free_handles(vs_session *s);
/* Calls the host's release function for each host object to which no value refers any more. */
void vs_session_release_objects(vs_session *s);

/* Sets *out to the value of handle h. If h was released or belongs to another interpreter, reports an error and returns
 * false. */
bool vs_session_held(vs_session *s, const char *who, vs_handle h, vs_value *out);
/* Returns a new handle to *value, which is a root of the garbage collector. When memory is out, reports it and returns
 * 0. */
vs_handle vs_session_hold(vs_session *s, const vs_value *value);

/* Calls the procedure of the language with this name, even if programs cannot name it. argv points to roots of the
 * garbage collector. result points to a root or is NULL. */
vs_outcome vs_session_invoke(vs_session *s, const char *name, size_t count, const vs_value *argv, vs_value *result);

/* Returns true if the interpreter is running. It then reports that function `who` cannot be called now. */
bool vs_session_busy(vs_session *s, const char *who);

/* Calls a procedure of the host; a[0] is its index. */
vs_status vs_session_host_call(vs_scheme *vm, vs_value *a, int n, vs_value *out);

#endif
