/* Declares the check of forms that the language cannot expand. */
#ifndef VS_LANGUAGES_CHECKS_SYNTAX_CHECKS_H
#define VS_LANGUAGES_CHECKS_SYNTAX_CHECKS_H

#include "languages/checks/checks.h"

/* Checks each top-level form: the interpreter expands it within a procedure that is never called. Each error is a
 * finding. Forms that depend on the program's own macros, or on a run, are not checked. */
void know_check_syntax(know_findings *f);

#endif
