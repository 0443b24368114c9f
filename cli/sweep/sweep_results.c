/* Writes the table of a sweep, its contact sheet and its best rows. */
#define _GNU_SOURCE
#include "cli/sweep/sweep_results.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/batch/part_files.h"
#include "cli/json.h"

enum { BEST = 10 };

/* The page's scripts, which the build links into the program. */
extern const char vs_asset_parallel_coordinates_js[], vs_asset_parallel_coordinates_js_end[];
extern const char vs_asset_scatter_js[], vs_asset_scatter_js_end[];

/* ---- CSV (RFC 4180) ---- */

static void put_cell(FILE *to, const char *text, bool first) {
  if (!first) fputc(',', to);
  if (!strpbrk(text, ",\"\r\n")) {
    fputs(text, to);
    return;
  }
  fputc('"', to);
  for (; *text; text++) {
    if (*text == '"') fputc('"', to);
    fputc(*text, to);
  }
  fputc('"', to);
}

static size_t most_files(const sweep_table *t) { return t->count ? t->parts[0].file_count : 0; }

void sweep_write_table(FILE *to, const sweep_table *t, const size_t *rows, size_t count) {
  for (size_t i = 0; i < t->column_count; i++) put_cell(to, t->columns[i], i == 0);
  for (size_t i = 0; i < t->number_count; i++) put_cell(to, t->numbers[i], false);
  fputs(",outcome", to);
  for (size_t k = 0; k < most_files(t); k++) {
    const char *dot = strrchr(t->parts[0].files[k].path, '.');
    put_cell(to, most_files(t) > 1 && dot ? dot + 1 : "file", false);
  }
  fputc('\n', to);
  for (size_t r = 0; r < count; r++) {
    const sweep_part *p = &t->parts[rows[r]];
    for (size_t i = 0; i < t->column_count; i++) {
      const char *value = sweep_value(p, t->columns[i]);
      put_cell(to, value ? value : "", i == 0);
    }
    for (size_t i = 0; i < t->number_count; i++) {
      double x = sweep_number_of(p, i);
      fputc(',', to);
      if (!isnan(x)) cli_json_number(to, x);
    }
    put_cell(to, p->fate == SWEEP_FAILED ? "failed" : "done", false);
    for (size_t k = 0; k < most_files(t); k++) put_cell(to, p->fate == SWEEP_FAILED ? "" : p->files[k].path, false);
    fputc('\n', to);
  }
}

/* ---- the contact sheet ---- */

static bool is_picture(const char *file) {
  const char *dot = strrchr(file, '.');
  return dot && (!strcmp(dot, ".png") || !strcmp(dot, ".svg"));
}

static void put_caption(FILE *to, const sweep_table *t, const sweep_part *p) {
  fputs("<figcaption>", to);
  for (size_t i = 0; i < p->set.count; i++) {
    if (i) fputs(", ", to);
    cli_part_html(to, p->set.at[i].name), fputc('=', to), cli_part_html(to, p->set.at[i].value);
  }
  for (size_t i = 0; i < p->number_count; i++) {
    fputs("<br>", to), cli_part_html(to, t->numbers[p->numbers[i].column]);
    fprintf(to, " %.6g", p->numbers[i].value);
  }
  if (p->message) fputs("<br>", to), cli_part_html(to, p->message);
  fputs("</figcaption>", to);
}

/* Writes the values of the part as JSON for the page's script: parameters, then numbers. */
static void put_values(FILE *to, const sweep_table *t, const sweep_part *p) {
  char *text = NULL;
  size_t size;
  FILE *list = open_memstream(&text, &size);
  if (!list) return;
  fputc('[', list);
  for (size_t i = 0; i < t->column_count; i++) {
    const char *value = sweep_value(p, t->columns[i]);
    char *end = NULL;
    double x = value ? strtod(value, &end) : NAN;
    if (i) fputc(',', list);
    if (!value) fputs("null", list);
    else if (*value && !*end && isfinite(x)) cli_json_number(list, x);
    else cli_json_text(list, value);
  }
  for (size_t i = 0; i < t->number_count; i++) {
    fputs(i + t->column_count ? "," : "", list);
    cli_json_number(list, sweep_number_of(p, i));
  }
  fputc(']', list);
  if (fclose(list) == 0) fputs(" data-values=\"", to), cli_part_html(to, text), fputc('"', to);
  free(text);
}

/* Writes the names of the axes as JSON. */
static void put_axes(FILE *to, const sweep_table *t) {
  char *text = NULL;
  size_t size;
  FILE *list = open_memstream(&text, &size);
  if (!list) return;
  fputc('[', list);
  for (size_t i = 0; i < t->column_count + t->number_count; i++) {
    fputs(i ? "," : "", list);
    cli_json_text(list, i < t->column_count ? t->columns[i] : t->numbers[i - t->column_count]);
  }
  fputc(']', list);
  if (fclose(list) == 0) fputs("<body data-axes=\"", to), cli_part_html(to, text), fputs("\">\n", to);
  free(text);
}

static void put_script(FILE *to, const char *text, const char *end) {
  fputs("<script>\n", to);
  fwrite(text, 1, (size_t)(end - text), to);
  fputs("</script>\n", to);
}

void sweep_write_sheet(FILE *to, const sweep_table *t, const size_t *rows, size_t count, const char *path) {
  fputs(
      "<!doctype html><meta charset=\"utf-8\"><title>Sweep</title>\n<style>body{font:13px sans-serif;margin:24px;"
      "display:grid;grid-template-columns:repeat(auto-fill,minmax(240px,1fr));gap:24px}figure{margin:0}img{width:100%;"
      "height:auto;display:block}figcaption{padding-top:6px;color:#444}</style>\n",
      to);
  put_axes(to, t);
  for (size_t r = 0; r < count; r++) {
    const sweep_part *p = &t->parts[rows[r]];
    fputs("<figure", to), put_values(to, t, p), fputc('>', to);
    for (size_t k = 0; p->fate != SWEEP_FAILED && k < p->file_count; k++) {
      const char *file = p->files[k].path, *slash = strrchr(file, '/');
      fputs("<a href=\"", to), cli_part_link(to, file, path), fputs("\">", to);
      if (is_picture(file)) fputs("<img loading=\"lazy\" src=\"", to), cli_part_link(to, file, path), fputs("\">", to);
      else cli_part_html(to, slash ? slash + 1 : file), fputs("<br>", to);
      fputs("</a>", to);
    }
    if (p->fate == SWEEP_FAILED) fputs("failed", to);
    put_caption(to, t, p);
    fputs("</figure>\n", to);
  }
  put_script(to, vs_asset_parallel_coordinates_js, vs_asset_parallel_coordinates_js_end);
  put_script(to, vs_asset_scatter_js, vs_asset_scatter_js_end);
}

/* ---- the best rows ---- */

void sweep_write_best(FILE *to, const sweep_table *t, const size_t *rows, size_t count) {
  for (size_t r = 0; r < count && r < BEST; r++) {
    const sweep_part *p = &t->parts[rows[r]];
    fprintf(to, "%zu. %s", r + 1, p->name);
    for (size_t i = 0; i < p->number_count; i++)
      fprintf(to, "%s %s %.6g", i ? "," : ":", t->numbers[p->numbers[i].column], p->numbers[i].value);
    fputc('\n', to);
  }
}
