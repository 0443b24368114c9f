/* Declares tapes: numerical expressions as lists of operations.
 *
 * A tape has inputs (the function's parameters), steps and outputs (one, or the coordinates of a point). A step is a
 * constant, an input, or an operator of operators.def whose operands are earlier steps. Equal steps are stored once,
 * and steps whose operands are constants are computed when they are added. Thus a tape is an expression without
 * repetition, which is evaluated from the first step to the last. */
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

/* A function of a point in space that is not an expression, such as the distance from a mesh. Its values at two points
 * differ by at most the distance of the points. It has a reference count. */
typedef struct vs_tape_field vs_tape_field;
struct vs_tape_field {
  uint32_t refs;
  double (*value)(const vs_tape_field *f, const double at[3], double slope[3]); /* returns the value at the point `at`
                                                                                 * and sets slope, unless it is NULL, to
                                                                                 * the gradient */
  void (*release)(vs_tape_field *f);                                            /* frees the field; called when the last
                                                                                 * reference to f is released */
};
void vs_tape_field_release(vs_tape_field *f); /* releases one reference to the field f */

typedef struct {
  uint32_t op;
  uint32_t of[3]; /* indices of the step's operands, which are earlier steps. If the step is an input, of[0] is the
                   * number of the input. Unused elements are 0. */
  double value;   /* for a constant: its value; for a field: its index in the tape's list of fields */
} vs_tape_step;

typedef struct vs_tape {
  vs_tape_step *step;
  size_t count, room;
  uint32_t *index; /* hash table that finds a step by its contents; a slot has the index of the step plus 1, or 0 if the
                    * slot is free */
  size_t slots;
  vs_tape_field **field; /* fields that the steps use; the tape holds one reference to each field */
  size_t field_count, field_room;
  uint32_t inputs, outputs, output[VS_TAPE_OUTPUTS];
} vs_tape;

/* Returns a new tape with `inputs` inputs, at most VS_TAPE_INPUTS, or NULL when memory is out. */
vs_tape *vs_tape_new(uint32_t inputs);
void vs_tape_free(vs_tape *t);         /* frees the tape t, which may be NULL */

/* Returns the index of the step that is the constant `value`; adds the step if the tape does not have it. Returns
 * UINT32_MAX when memory is out or the tape has VS_TAPE_STEPS steps. */
uint32_t vs_tape_constant(vs_tape *t, double value);
uint32_t vs_tape_input(vs_tape *t, uint32_t number); /* returns the index of the step for the input with this number;
                                                      * otherwise as vs_tape_constant */
/* Returns the index of the step with the operator op (operators.def) and the operands a, b and c, which are indices of
 * steps. Adds the step if the tape does not have it. */
uint32_t vs_tape_add(vs_tape *t, vs_tape_operator op, uint32_t a, uint32_t b,
                     uint32_t c); /* operands that the operator op does not have must be 0 */

/* Returns the index of the step that is the value of field f at a point, whose coordinates are the steps x, y and z.
 * Returns UINT32_MAX on failure. */
uint32_t vs_tape_add_field(vs_tape *t, vs_tape_field *f, uint32_t x, uint32_t y, uint32_t z);

/* Returns the number of operands of the operator op. */
int vs_tape_operands(vs_tape_operator op);
/* Returns the operator with this name and number of operands, or VS_TAPE_CONSTANT if there is none. */
vs_tape_operator vs_tape_named(const char *name, int operands);
double vs_tape_apply(vs_tape_operator op, double a, double b, double c); /* returns the result of the operator op for
                                                                          * operands with these values */

/* Returns a copy of t without the steps that no output needs, or NULL when memory is out. */
vs_tape *vs_tape_compact(const vs_tape *t);

#endif
