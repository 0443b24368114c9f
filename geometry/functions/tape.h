/* Owns tapes: expressions of numbers as lists of operations.
 *
 * A tape has inputs (the function's parameters), steps and outputs (one, or the coordinates of a point). A step is a
 * constant, an input, or an operator of operators.def whose operands are earlier steps. Equal steps are one, and steps
 * on constants alone are worked out when they are added; so a tape is a function's expression without repetition, ready
 * to be gone through from the first step to the last. */
#ifndef VS_GEOMETRY_FUNCTIONS_TAPE_H
#define VS_GEOMETRY_FUNCTIONS_TAPE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
  VS_TAPE_CONSTANT,
  VS_TAPE_INPUT,
#define VS_OPERATOR(id, name, operands, binds, pov, scad, js) VS_TAPE_##id,
#include "geometry/functions/operators.def"
  VS_TAPE_OPERATORS
} vs_tape_operator;

enum { VS_TAPE_INPUTS = 16, VS_TAPE_OUTPUTS = 3, VS_TAPE_STEPS = 100000 };

/* A function of three numbers that is no expression, such as the distance from a mesh: counted, and owned by whoever
 * holds a count. Its value changes by no more than the distance between two places. */
typedef struct vs_tape_field vs_tape_field;
struct vs_tape_field {
  uint32_t refs;
  double (*value)(const vs_tape_field *f, const double at[3], double slope[3]); /* slope may be NULL */
  void (*release)(vs_tape_field *f);                                            /* the last count is gone */
};
void vs_tape_field_release(vs_tape_field *f); /* gives up a count */

typedef struct {
  uint32_t op;
  uint32_t of[3]; /* earlier steps; an input's number in of[0]; unused ones are 0 */
  double value;   /* of a constant; a field's number in the tape */
} vs_tape_step;

typedef struct vs_tape {
  vs_tape_step *step;
  size_t count, room;
  uint32_t *index; /* hash of a step -> its number + 1; 0 free; a power of two of slots */
  size_t slots;
  vs_tape_field **field; /* counts of ours */
  size_t field_count, field_room;
  uint32_t inputs, outputs, output[VS_TAPE_OUTPUTS];
} vs_tape;

/* A tape has at most VS_TAPE_INPUTS inputs. */
vs_tape *vs_tape_new(uint32_t inputs); /* NULL: out of memory */
void vs_tape_free(vs_tape *t);         /* NULL is allowed */

/* Each returns the number of the step, UINT32_MAX when memory is out or the tape is full (VS_TAPE_STEPS). */
uint32_t vs_tape_constant(vs_tape *t, double value);
uint32_t vs_tape_input(vs_tape *t, uint32_t number); /* number < inputs */
/* op is an operator of operators.def. */
uint32_t vs_tape_add(vs_tape *t, vs_tape_operator op, uint32_t a, uint32_t b,
                     uint32_t c); /* operands beyond the operator's own: 0 */

uint32_t vs_tape_add_field(vs_tape *t, vs_tape_field *f, uint32_t x, uint32_t y, uint32_t z);

/* How many operands it has. */
int vs_tape_operands(vs_tape_operator op);
/* The operator of this name and number of operands; VS_TAPE_CONSTANT: none. */
vs_tape_operator vs_tape_named(const char *name, int operands);
double vs_tape_apply(vs_tape_operator op, double a, double b, double c); /* one operator on doubles */

/* A copy of t less every step that no output needs. NULL: out of memory. */
vs_tape *vs_tape_compact(const vs_tape *t);

#endif
