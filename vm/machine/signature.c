/* Parses the signatures of natives, such as "c r [start end] #:segments". */
#include "vm/machine/signature.h"

#include "model/assert.h"

#include <stdio.h>
#include <string.h>

vs_signature_kind vs_signature_next(const char **at, int *depth, const char **name, size_t *length) {
  const char *s = *at;
  bool rest = false;
  for (;; s++) {
    if (*s == '[') ++*depth;
    else if (*s == ']') --*depth;
    else if (*s == '.' && s[1] == ' ') rest = true;
    else if (*s != ' ') break;
  }
  bool keyword = s[0] == '#' && s[1] == ':';
  if (keyword) s += 2;
  size_t n = 0;
  while (s[n] && s[n] != ' ' && s[n] != '[' && s[n] != ']') n++;
  *name = s; *length = n; *at = s + n;
  return n == 0       ? VS_SIG_END
         : keyword    ? VS_SIG_KEYWORD
         : rest       ? VS_SIG_REST
         : *depth > 0 ? VS_SIG_OPTIONAL
                      : VS_SIG_REQUIRED;
}

vs_signature vs_signature_read(const char *text) {
  vs_signature g = {0, 0, 0, false};
  int depth = 0;
  const char *name;
  size_t length;
  for (;;)
    switch (vs_signature_next(&text, &depth, &name, &length)) {
      case VS_SIG_END: return g;
      case VS_SIG_REQUIRED: g.required++; break;
      case VS_SIG_OPTIONAL: g.optional++; break;
      case VS_SIG_KEYWORD: g.keywords++; break;
      case VS_SIG_REST: g.rest = true; break;
    }
}

void vs_signature_parameter(const char *text, int arg, char *name, size_t size) {
  int depth = 0;
  const char *at;
  size_t length;
  VS_ASSERT(size > 0);
  for (int i = 0;; i++) {
    vs_signature_kind kind = vs_signature_next(&text, &depth, &at, &length);
    if (kind == VS_SIG_END) break;
    if (i == arg && kind != VS_SIG_REST) {
      snprintf(name, size, "%s%.*s", kind == VS_SIG_KEYWORD ? "#:" : "", (int)length, at);
      return;
    }
  }
  snprintf(name, size, "argument %d", arg + 1);
}
