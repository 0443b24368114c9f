/* Writes .3mf packages (3MF core 1.3): the drawing's solids as closed meshes with a material for each triangle, in a
 * zip file that libzip writes.
 *
 * Every distinct mesh and every part of the drawing is an object; one more object has the copies and the parts as
 * components. Programs disagree about placements that mirror. A mirrored copy is therefore a placement, without
 * mirroring, of a mirrored mesh (twin). The model's XML is collected and compressed in memory, and then written: a
 * zip's directory is at its end, and libzip seeks back and forth. */
#include <math.h>
#include <stddef.h>
#include <string.h>
#include <zip.h>

#include "backends/backend.h"
#include "geometry/dynamic.h"

/* ---- libzip ---- */

#define ZIP_FUNCTIONS(X)                                                                                               \
  X(zip_source_buffer_create) X(zip_open_from_source) X(zip_source_buffer) X(zip_file_add) X(zip_file_set_dostime) \
  X(zip_close) X(zip_discard) \
  X(zip_set_file_compression) X(zip_register_cancel_callback_with_state) X(zip_source_keep) X(zip_source_free) \
  X(zip_source_open) X(zip_source_read) X(zip_source_close)

typedef struct {
#define ZIP_MEMBER(name) __typeof__(&name) name;
  ZIP_FUNCTIONS(ZIP_MEMBER)
#undef ZIP_MEMBER
} zip_library;

static bool zip_load(zip_library *z, vs_error *e) {
  static const vs_dynamic_name names[] = {
#define ZIP_NAME(name) { #name, offsetof(zip_library, name) },
    ZIP_FUNCTIONS(ZIP_NAME)
#undef ZIP_NAME
  };
  return vs_dynamic_load(VS_LIBRARY_LIBZIP, "writing .3mf", names, sizeof names / sizeof *names, z, e);
}

/* ---- the model ---- */

static const char *unit_name(const char *unit) {
  static const char *const names[][2] = {
    { "mm", "millimeter" }, { "cm", "centimeter" }, { "in", "inch" }, { "ft", "foot" }
  };
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(unit, names[i][0]) == 0) return names[i][1];
  return "meter";
}

static void model_materials(vs_emitter *e) {
  vs_puts(e->out, "<basematerials id=\"1\">\n");
  for (size_t i = 0; i <= vs_emit_material_count(e); i++) {
    const vs_material *m = i > 0 ? vs_emit_material_at(e, i) : NULL;
    vs_material shown = m != NULL ? *m : vs_material_of_color(0.86, 0.85, 0.83);
    vs_puts(e->out, "<base name=\"");
    vs_put_xml(e->out, m == NULL ? "plain" : m->name[0] != '\0' ? m->name : "color");
    vs_putf(e->out, "\" displaycolor=\"#%02lX%02lX%02lX%02lX\"/>\n", lround(255 * shown.red), lround(255 * shown.green),
            lround(255 * shown.blue), lround(255 * (1 - 0.8 * shown.transparency)));
  }
  vs_puts(e->out, "</basematerials>\n");
}

static void model_triangle(vs_emitter *e, const vs_solid_copies *c, const vs_mesh *m, size_t index, bool twin) {
  vs_writer *w = e->out;
  const uint32_t *t = m->triangles[index];
  uint32_t tag = m->tags != NULL ? m->tags[index] : 0;
  size_t paint = tag < c->part_count ? vs_emit_material_number(e, c->parts[tag].material) : 0;
  static const char *const names[3] = { "<triangle v1=\"", "\" v2=\"", "\" v3=\"" };
  for (int k = 0; k < 3; k++) {
    vs_puts(w, names[k]);
    vs_put_u32(w, t[twin ? 2 - k : k]);
  }
  if (paint > 0) vs_putf(w, "\" pid=\"1\" p1=\"%zu", paint);
  vs_puts(w, "\"/>\n");
}

/* Returns the layer that all triangles of the mesh have, or NULL if they have several layers or none, or only the name
 * of their part. */
static const char *model_layer(const vs_solid_copies *c, const vs_mesh *m) {
  const char *layer = NULL;
  for (size_t i = 0; i < m->triangle_count; i++) {
    uint32_t tag = m->tags != NULL ? m->tags[i] : 0;
    const char *own = tag < c->part_count ? c->parts[tag].layer : NULL;
    if (own == NULL || own == c->parts[tag].part || (i > 0 && own != layer)) return NULL;
    layer = own;
  }
  return layer;
}

/* Writes a mesh as an object, named after its layer. twin: whether the mesh is mirrored in x, and the order of its
 * triangles' corners reversed. */
static void model_object(vs_emitter *e, const vs_solid_copies *c, size_t mesh, size_t id, bool twin) {
  const vs_mesh *m = &c->meshes.meshes[mesh];
  vs_writer *w = e->out;
  if (!vs_emit_triangles(e, m->triangle_count)) w->failed = true;
  const char *layer = model_layer(c, m);
  vs_putf(w, "<object id=\"%zu\" type=\"model\" pid=\"1\" pindex=\"0", id);
  if (layer != NULL) {
    vs_puts(w, "\" name=\"");
    vs_put_xml(w, layer);
  }
  vs_puts(w, "\">\n<mesh>\n<vertices>\n");
  for (size_t i = 0; i < m->vertex_count && !w->failed; i++) {
    vs_vec3 v = m->vertices[i];
    vs_puts(w, "<vertex x=\"");
    vs_put_number(w, twin ? -v.x : v.x);
    vs_puts(w, "\" y=\"");
    vs_put_number(w, v.y);
    vs_puts(w, "\" z=\"");
    vs_put_number(w, v.z);
    vs_puts(w, "\"/>\n");
  }
  vs_puts(w, "</vertices>\n<triangles>\n");
  for (size_t i = 0; i < m->triangle_count && !w->failed; i++) model_triangle(e, c, m, i, twin);
  vs_puts(w, "</triangles>\n</mesh>\n</object>\n");
}

static size_t model_id(size_t mesh, bool twin) { return 2 + 2 * mesh + twin; }

static void model_component(vs_emitter *e, const vs_kernel_copy *copy) {
  bool twin = vs_affine_determinant(&copy->place) < 0;
  vs_putf(e->out, "<component objectid=\"%zu\" transform=\"", model_id(copy->mesh, twin));
  for (int column = 0; column < 4; column++)
    for (int row = 0; row < 3; row++) {
      if (column > 0 || row > 0) vs_puts(e->out, " ");
      vs_put_number(e->out, twin && column == 0 ? -copy->place.m[row][column] : copy->place.m[row][column]);
    }
  vs_puts(e->out, "\"/>\n");
}

/* Returns the part of the drawing to which the copy belongs, or NULL. */
static const char *model_part(const vs_solid_copies *c, const vs_kernel_copy *copy) {
  const vs_mesh *m = &c->meshes.meshes[copy->mesh];
  uint32_t tag = m->tags != NULL && m->triangle_count > 0 ? m->tags[0] : 0;
  return tag < c->part_count ? c->parts[tag].part : NULL;
}

/* Writes the objects of the drawing's parts, with the copies of each part as components. Copies of a part follow each
 * other. Returns the id of the first object; *count: their number. */
static size_t model_parts(vs_emitter *e, const vs_solid_copies *c, size_t *count) {
  const vs_kernel_copies *k = &c->meshes;
  vs_writer *w = e->out;
  size_t first = model_id(k->mesh_count, false);
  *count = 0;
  for (size_t i = 0; i < k->copy_count && !w->failed; i++) {
    const char *part = model_part(c, &k->copies[i]);
    if (part == NULL) continue;
    if (i == 0 || model_part(c, &k->copies[i - 1]) != part) {
      vs_putf(w, "<object id=\"%zu\" type=\"model\" name=\"", first + (*count)++);
      vs_put_xml(w, part);
      vs_puts(w, "\" partnumber=\"");
      vs_put_xml(w, part);
      vs_puts(w, "\">\n<components>\n");
    }
    model_component(e, &k->copies[i]);
    if (i + 1 == k->copy_count || model_part(c, &k->copies[i + 1]) != part) vs_puts(w, "</components>\n</object>\n");
  }
  return first;
}

/* Writes the model. plain: array for whether each mesh has a placement that does not mirror; twins: array for whether
 * each mesh has a placement that mirrors. Both arrays have mesh_count items, which are all false before the call. */
static bool model_write(vs_emitter *e, const vs_solid_copies *c, bool *plain, bool *twins) {
  const vs_kernel_copies *k = &c->meshes;
  vs_writer *w = e->out;
  vs_puts(w, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model "
             "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" xml:lang=\"en-US\" unit=\"");
  vs_puts(w, unit_name(e->scene->units));
  vs_puts(w, "\">\n<metadata name=\"Title\">");
  vs_put_xml(w, e->scene->title);
  vs_puts(w, "</metadata>\n<metadata name=\"Application\">VisualScheme</metadata>\n<resources>\n");
  model_materials(e);
  for (size_t i = 0; i < k->copy_count; i++)
    (vs_affine_determinant(&k->copies[i].place) < 0 ? twins : plain)[k->copies[i].mesh] = true;
  for (size_t i = 0; i < k->mesh_count; i++) {
    if (plain[i]) model_object(e, c, i, model_id(i, false), false);
    if (twins[i]) model_object(e, c, i, model_id(i, true), true);
    if (!vs_emit_progress(e, "writing", -1)) return false;
  }
  size_t part_count, first = model_parts(e, c, &part_count), whole = first + part_count;
  vs_putf(w, "<object id=\"%zu\" type=\"model\">\n<components>\n", whole);
  for (size_t i = 0; i < k->copy_count && !w->failed; i++)
    if (model_part(c, &k->copies[i]) == NULL) model_component(e, &k->copies[i]);
  for (size_t i = 0; i < part_count; i++) vs_putf(w, "<component objectid=\"%zu\"/>\n", first + i);
  vs_putf(w, "</components>\n</object>\n</resources>\n<build>\n<item objectid=\"%zu\"/>\n</build>\n</model>\n", whole);
  return !w->failed;
}

/* ---- the package ---- */

typedef struct { vs_emitter *e; char *at; size_t count, room; } memory;

static bool memory_sink(void *context, const void *bytes, size_t count) {
  memory *m = context;
  if (!vs_emit_grow(m->e, &m->at, &m->room, m->count + count, 1)) return false;
  memcpy(m->at + m->count, bytes, count);
  m->count += count;
  return true;
}

static bool model_gather(vs_emitter *e, const vs_solid_copies *c, memory *out) {
  vs_store *store = e->scene->store;
  size_t room = 2 * c->meshes.mesh_count + 1;
  vs_writer *was = e->out, *w = vs_store_realloc(store, NULL, 0, sizeof *w);
  bool *placed = vs_store_realloc(store, NULL, 0, room);
  bool ok = (w != NULL && placed != NULL) || vs_emit_no_memory(e);
  if (ok) {
    memset(placed, 0, room);
    vs_writer_init(w, memory_sink, out);
    vs_emit_watch(e, w);
    e->out = w;
    ok = model_write(e, c, placed, placed + c->meshes.mesh_count) && vs_writer_flush(w);
    e->out = was;
  }
  if (placed != NULL) vs_store_realloc(store, placed, room, 0);
  if (w != NULL) vs_store_realloc(store, w, sizeof *w, 0);
  return ok;
}

/* The level of compression, from 1 to 9. Level 9, libzip's default, takes seven times as long and saves 4 %. */
enum { PACKING = 5 };

/* Adds a file to the package. libzip reads and compresses `bytes` only in zip_close, so they must exist until then. */
static bool package_add(const zip_library *z, zip_t *zip, const char *name, const void *bytes, size_t count) {
  zip_source_t *source = z->zip_source_buffer(zip, bytes, count, 0);
  zip_int64_t at = source != NULL ? z->zip_file_add(zip, name, source, ZIP_FL_ENC_UTF_8) : -1;
  if (at < 0) {
    z->zip_source_free(source); /* frees the source here, because the archive frees only a source that was added to
                                 * it */
    return false;
  }
  return z->zip_set_file_compression(zip, (zip_uint64_t)at, ZIP_CM_DEFLATE, PACKING) == 0 &&
         z->zip_file_set_dostime(zip, (zip_uint64_t)at, 0, 0x21, 0) == 0; /* the date is 1980-01-01, so that equal
                                                                           * models make equal bytes */
}

static int package_stops(zip_t *zip, void *context) { return (void)zip, !vs_emit_progress(context, "packing", -1); }

static bool package_close(const zip_library *z, zip_t *zip, const memory *model) {
  static const char types[] =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Types "
      "xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
      "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
      "<Default Extension=\"model\" "
      "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n</Types>\n";
  static const char relations[] =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships "
      "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
      "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n</Relationships>\n";
  bool ok = package_add(z, zip, "[Content_Types].xml", types, sizeof types - 1) &&
            package_add(z, zip, "_rels/.rels", relations, sizeof relations - 1) &&
            package_add(z, zip, "3D/3dmodel.model", model->at, model->count);
  /* While libzip compresses, it calls package_stops often, so that the user can interrupt it. */
  ok = ok && z->zip_register_cancel_callback_with_state(zip, package_stops, NULL, model->e) == 0;
  if (ok && z->zip_close(zip) == 0) return true;
  z->zip_discard(zip);
  return false;
}

static bool package_copy(vs_emitter *e, const zip_library *z, zip_source_t *source) {
  char part[4096];
  zip_int64_t count;
  if (z->zip_source_open(source) != 0)
    return vs_error_set(e->error, VS_ERROR_MEMORY, NULL, "the .3mf package could not be made");
  while ((count = z->zip_source_read(source, part, sizeof part)) > 0 && vs_put(e->out, part, (size_t)count)) continue;
  z->zip_source_close(source);
  return count == 0 || vs_error_set(e->error, VS_ERROR_MEMORY, NULL, "the .3mf package could not be made");
}

static bool threemf_copies(vs_emitter *e, const vs_solid_copies *c) {
  zip_library z;
  memory model = { .e = e };
  if (!zip_load(&z, e->error)) return false;
  bool ok = model_gather(e, c, &model) && vs_emit_progress(e, "writing", -1);
  zip_source_t *package = ok ? z.zip_source_buffer_create(NULL, 0, 0, NULL) : NULL;
  zip_t *zip = package != NULL ? z.zip_open_from_source(package, ZIP_TRUNCATE, NULL) : NULL;
  if (ok && zip == NULL) ok = vs_emit_no_memory(e);
  if (zip != NULL) {
    z.zip_source_keep(package); /* adds a reference to the source, because closing the archive releases one */
    ok = package_close(&z, zip, &model) ? package_copy(e, &z, package)
         : e->error->kind == VS_ERROR_INTERRUPT
             ? false
             : vs_error_set(e->error, VS_ERROR_MEMORY, NULL, "the .3mf package could not be made");
  }
  if (package != NULL) z.zip_source_free(package);
  vs_emit_release(e, model.at, model.room, 1);
  return ok && !e->out->failed;
}

static bool threemf_nothing(vs_emitter *e) { return !e->out->failed; }

const vs_backend vs_backend_threemf = { .begin = threemf_nothing,
                                        .end = threemf_nothing,
                                        .copies = threemf_copies,
                                        .numbers = VS_NUMBERS_DIGITS,
                                        .traits = VS_UNITS | VS_NAMES,
                                        .omit = { [VS_CURVE] = "3MF holds solids: curves are omitted",
                                                  [VS_REGION_CLASS] = "3MF holds solids: flat regions are omitted",
                                                  [VS_SURFACE] = "3MF holds solids: open surfaces are omitted" } };
