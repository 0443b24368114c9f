/* Declares the parser of scripts. The grammar is that of ECMAScript 3 without regular expressions, `with`, getters and
 * calls of eval. */
#ifndef VS_LANGUAGES_JAVASCRIPT_PARSER_H
#define VS_LANGUAGES_JAVASCRIPT_PARSER_H

#include "languages/javascript/script.h"

/* Reads the text, which must outlive the script. Returns false with s->trouble and s->trouble_at set, or with
 * s->no_memory set. The caller calls vs_script_close also after a failure. */
bool vs_script_parse(vs_script *s, const char *text, size_t size, vs_script_resize *resize, void *context);

#endif
