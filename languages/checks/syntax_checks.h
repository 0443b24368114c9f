/* Declares the check of forms that the language cannot expand. */
#ifndef VS_LANGUAGES_CHECKS_SYNTAX_CHECKS_H
#define VS_LANGUAGES_CHECKS_SYNTAX_CHECKS_H

#include "languages/checks/checks.h"

/* Has the interpreter expand each top-level form, within a procedure that nothing calls; each error is a finding. Uses
 * that depend on the program's own macros, or on a run, are not checked. */
void know_check_syntax(know_findings *f);

#endif
