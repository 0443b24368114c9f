/* Declares a row of the table of procedures: forms, keywords and the contracts of arguments. */
#ifndef VS_BIND_CALL_PROCEDURE_H
#define VS_BIND_CALL_PROCEDURE_H

#include <stdbool.h>
#include <stdint.h>

typedef enum {
#define VS_CONTRACT(name, noun, condition, convert) VS_C_##name,
#include "bind/call/contracts.def"
#undef VS_CONTRACT
} vs_contract;

/* Greatest numbers of a row's arguments, forms and keywords; a row with more does not compile. */
enum { VS_MAX_ARGUMENTS = 16, VS_MAX_FORMS = 4, VS_MAX_KEYS = 11 };

typedef enum { VS_ARG_END, VS_ARG_REQUIRED, VS_ARG_OPTIONAL, VS_ARG_REST } vs_parameter_mode;
typedef struct vs_bind_param { char name[14]; uint8_t mode, contract; } vs_bind_param;
typedef struct { bool used; vs_bind_param at[VS_MAX_ARGUMENTS + 1]; } vs_form;

typedef struct vs_procedure {
  vs_form form[VS_MAX_FORMS];
  vs_bind_param key[VS_MAX_KEYS + 1];
} vs_procedure;

#endif
