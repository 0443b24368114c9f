/* Writes texts and numbers as JSON. The command reads no JSON, so a JSON library would be larger than this file. */
#include "cli/json.h"

#include <math.h>
#include <string.h>

#include "model/characters.h"

void cli_json_text(FILE *to, const char *text) {
  fputc('"', to);
  char spelled[VS_SPELLED_ROOM];
  for (const char *at = text, *end = text + strlen(text); at < end;)
    fwrite(spelled, 1, vs_spell_json(&at, end, spelled), to);
  fputc('"', to);
}

void cli_json_number(FILE *to, double v) {
  char text[40];
  for (int digits = 15; digits <= 17; digits++) {
    snprintf(text, sizeof text, "%.*g", digits, v);
    double back;
    if (sscanf(text, "%lf", &back) == 1 && back == v) break;
  }
  fputs(isfinite(v) ? text : "null", to);
}
