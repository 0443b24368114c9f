/* Writes X3D's two notations: XML and classic (that of VRML). */
#include "backends/x3d/x3d_notation.h"

#include <string.h>

#include "backends/x3d/x3d.h"

static vs_x3d *text_state(vs_emitter *e) { return e->state; }
static bool text_classic(vs_emitter *e) { return text_state(e)->notation == VS_X3D_CLASSIC; }

static void text_indent(vs_emitter *e) { vs_put_spaces(e->out, 2 * text_state(e)->depth); }

/* In XML, the start tag stays open for fields until the first child or the end of the node. */
static void text_close_tag(vs_emitter *e) {
  if (text_state(e)->in_tag) vs_puts(e->out, ">\n");
  text_state(e)->in_tag = false;
}

void vs_x3d_node(vs_emitter *e, const char *field, const char *type, const char *def) {
  text_close_tag(e);
  text_indent(e);
  if (text_classic(e)) {
    if (field != NULL) vs_putf(e->out, "%s ", field);
    if (def != NULL) vs_putf(e->out, "DEF %s ", def);
    vs_putf(e->out, "%s {\n", type);
  } else {
    vs_putf(e->out, "<%s", type);
    if (def != NULL) vs_putf(e->out, " DEF='%s'", def);
    text_state(e)->in_tag = true;
  }
  text_state(e)->depth++;
}

void vs_x3d_use(vs_emitter *e, const char *field, const char *type, const char *name) {
  text_close_tag(e);
  text_indent(e);
  if (text_classic(e)) {
    if (field != NULL) vs_putf(e->out, "%s ", field);
    vs_putf(e->out, "USE %s\n", name);
  } else {
    vs_putf(e->out, "<%s USE='%s'></%s>\n", type, name, type);
  }
}

void vs_x3d_children(vs_emitter *e) {
  text_close_tag(e);
  if (!text_classic(e)) return;
  text_indent(e);
  vs_puts(e->out, "children [\n");
  text_state(e)->depth++;
}

void vs_x3d_end(vs_emitter *e, const char *type, bool had_children) {
  vs_x3d *x = text_state(e);
  if (text_classic(e)) {
    if (had_children) {
      x->depth--;
      text_indent(e);
      vs_puts(e->out, "]\n");
    }
    x->depth--;
    text_indent(e);
    vs_puts(e->out, "}\n");
    return;
  }
  x->depth--;
  if (x->in_tag) {
    vs_puts(e->out, "/>\n");
  } else {
    text_indent(e);
    vs_putf(e->out, "</%s>\n", type);
  }
  x->in_tag = false;
}

void vs_x3d_field(vs_emitter *e, const char *name, bool many) {
  if (text_classic(e)) {
    text_indent(e);
    vs_putf(e->out, many ? "%s [" : "%s ", name);
  } else {
    vs_putf(e->out, " %s='", name);
  }
}

void vs_x3d_field_end(vs_emitter *e, bool many) { vs_puts(e->out, text_classic(e) ? (many ? "]\n" : "\n") : "'"); }

void vs_x3d_words(vs_emitter *e, const char *name, const char *value) {
  vs_x3d_field(e, name, false);
  if (text_classic(e) && (strcmp(value, "true") == 0 || strcmp(value, "false") == 0))
    vs_puts(e->out, value[0] == 't' ? "TRUE" : "FALSE");
  else vs_puts(e->out, value);
  vs_x3d_field_end(e, false);
}

void vs_x3d_text(vs_emitter *e, const char *name, const char *value, bool many) {
  vs_x3d_field(e, name, many);
  if (text_classic(e)) {
    vs_puts(e->out, "\"");
    char spelled[VS_SPELLED_ROOM];
    for (const char *at = value, *end = value + strlen(value); at < end && !e->out->failed;) {
      if (*at == '"' || *at == '\\') vs_puts(e->out, "\\");
      vs_put(e->out, spelled, vs_spell_line(&at, end, spelled));
    }
    vs_puts(e->out, "\"");
  } else {
    char spelled[VS_SPELLED_ROOM];
    if (many) vs_puts(e->out, "\"");
    for (const char *at = value, *end = value + strlen(value); at < end && !e->out->failed;) {
      if (many && (*at == '"' || *at == '\\')) vs_puts(e->out, "\\");
      vs_put(e->out, spelled, vs_spell_xml(&at, end, spelled));
    }
    if (many) vs_puts(e->out, "\"");
  }
  vs_x3d_field_end(e, many);
}

void vs_x3d_number(vs_emitter *e, const char *name, double value) {
  vs_x3d_field(e, name, false);
  vs_put_number(e->out, value);
  vs_x3d_field_end(e, false);
}

void vs_x3d_vector(vs_emitter *e, const char *name, vs_vec3 value) {
  vs_x3d_field(e, name, false);
  vs_put_triple(e->out, "", value, " ", "");
  vs_x3d_field_end(e, false);
}

void vs_x3d_turn(vs_emitter *e, const char *name, vs_vec3 axis, double angle) {
  vs_x3d_field(e, name, false);
  vs_put_triple(e->out, "", axis, " ", " ");
  vs_put_number(e->out, angle);
  vs_x3d_field_end(e, false);
}
