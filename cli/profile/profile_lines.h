/* Declares the samples of a run, by lines of the program. */
#ifndef VS_CLI_PROFILE_PROFILE_LINES_H
#define VS_CLI_PROFILE_PROFILE_LINES_H

#include "visualscheme.h"

/* A line of the program. own: seconds in the line itself; whole: also in the calls that it makes. */
typedef struct { const char *file; uint32_t line; double own, whole, bytes; size_t stamp; } profile_line;

typedef struct {
  vs_profile_call_info *calls; size_t count, room; /* the tree of calls; each comes after its caller */
  double *whole;             /* whole[i]: seconds of call i and of the calls that it makes */
  uint32_t *line_of;         /* line_of[i]: index of the line of call i */
  profile_line *lines; size_t line_count; /* lines of the program, sorted by time, the most first */
  double seconds, bytes;     /* sums of all calls */
  size_t looks;              /* number of samples in the profile */
} profile_tree;

/* Reads the samples of the interpreter. Returns false when memory is out. profile_tree_free frees the tree. */
bool profile_tree_read(profile_tree *t, vs_scheme *scheme);
void profile_tree_free(profile_tree *t);
/* Copies line `number` of the file from this column on into room, without blanks at its ends; "" if it cannot be
 * read. */
void profile_line_text(const char *file, uint32_t number, uint32_t column, char *room, size_t size);

#endif
