/* Implements hashes of bytes, names of files for sets of parameters, and the text of contact sheets. */
#define _GNU_SOURCE
#include "cli/batch/part_files.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "model/characters.h"

uint64_t cli_part_hash(uint64_t h, const void *bytes, size_t count) {
  for (const unsigned char *c = bytes; count-- > 0; c++) h = (h ^ *c) * UINT64_C(0x100000001b3);
  return h;
}

bool cli_part_hash_file(const char *path, uint64_t *out) {
  unsigned char part[1 << 14];
  FILE *f = fopen(path, "rb");
  size_t n;
  *out = CLI_HASH_BEGIN;
  while (f && (n = fread(part, 1, sizeof part, f)) > 0) *out = cli_part_hash(*out, part, n);
  bool ok = f && !ferror(f);
  if (f) fclose(f);
  return ok;
}

void cli_part_put_word(char *to, size_t room, const char *text, bool stem) {
  const char *slash = strrchr(text, '/'), *from = stem && slash ? slash + 1 : text;
  const char *dot = stem ? strrchr(from, '.') : NULL;
  size_t used = strlen(to), length = dot && dot > from ? (size_t)(dot - from) : strlen(from);
  for (size_t i = 0; i < length && used + 1 < room; i++) {
    unsigned char c = (unsigned char)from[i];
    to[used++] = c <= ' ' || c == '/' || c == 127 ? '_' : (char)c;
  }
  to[used] = 0;
}

void cli_part_put_set(char *to, size_t room, const char *set) {
  enum { LONGEST = 80 };
  size_t used = strlen(to), from = used;
  bool plain = true;
  for (const char *c = set; *c && used < from + LONGEST && used + 1 < room; c++) {
    bool fits =
        (*c >= '0' && *c <= '9') || (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || strchr("=,.-+_", *c);
    plain = plain && fits;
    to[used++] = fits ? *c : '_';
  }
  to[used] = 0;
  if (plain && used - from == strlen(set)) return;
  snprintf(to + used, room - used, "-%08" PRIx32, (uint32_t)(cli_part_hash(CLI_HASH_BEGIN, set, strlen(set)) >> 16));
}

void cli_part_html(FILE *to, const char *text) {
  char spelled[VS_SPELLED_ROOM];
  for (const char *at = text, *end = text + strlen(text); at < end;)
    fwrite(spelled, 1, vs_spell_xml_value(&at, end, spelled), to);
}

void cli_part_link(FILE *to, const char *file, const char *page) {
  const char *slash = strrchr(page, '/');
  size_t folder = slash ? (size_t)(slash + 1 - page) : 0;
  char *whole = strncmp(file, page, folder) != 0 ? realpath(file, NULL) : NULL;
  for (const char *c = whole ? whole : file + folder; *c; c++) {
    if ((unsigned char)*c <= ' ' || (unsigned char)*c >= 0x7F || strchr("%#?\"<>&\\'", *c))
      fprintf(to, "%%%02X", (unsigned char)*c);
    else fputc(*c, to);
  }
  free(whole);
}
