/* Owns the table of kinds that prims.def spells out, and hashing, comparing, retaining and releasing of payloads by it. */
#include "model/kinds.h"

#include <string.h>

#include "model/store.h"

#define VS_CLASS_NOTHING VS_NOTHING
#define VS_CLASS_CURVE VS_CURVE
#define VS_CLASS_REGION VS_REGION_CLASS
#define VS_CLASS_SURFACE VS_SURFACE
#define VS_CLASS_SOLID VS_SOLID
#define VS_CLASS_INHERIT VS_INHERIT

/* Each kind becomes a block of its own, so that here_ names its struct where the fields' offsets are asked for; the row that ends
 * each table of fields stands for "no more" and is not counted. */
const vs_kind_info *vs_kind_get(vs_kind kind) {
  switch (kind) {
#define VS_KIND(upper, lower, name, class_, level)                                                     \
  case VS_##upper: {                                                                                   \
    typedef struct vs_##lower here_;                                                                   \
    static const char name_[] = name;                                                                  \
    enum { class_here_ = (int)VS_CLASS_##class_, level_here_ = (int)VS_LEVEL_##level };                \
    static const vs_field_info fields_[] = {
#define VS_FIELD(type, member, argument) { #member, argument, VS_FIELD_##type, offsetof(here_, member) },
#define VS_KIND_END(upper, lower)                                                                      \
      { NULL, NULL, VS_FIELD_real, 0 } };                                                              \
    static const vs_kind_info info_ = { name_, (vs_class)class_here_, (vs_level)level_here_, sizeof(here_), sizeof fields_ / sizeof *fields_ - 1, fields_ }; \
    return &info_;                                                                                     \
  }
#include "model/prims.def"
    case VS_KIND_COUNT: break;
  }
  return NULL;
}

const unsigned char vs_field_reals[] = { [VS_FIELD_real] = 1, [VS_FIELD_point] = 3, [VS_FIELD_vector] = 3, [VS_FIELD_affine] = 12, [VS_FIELD_ticket] = 0 };

/* One product a number: what comes of it is mixed well at the end. */
static uint64_t vs_payload_hash_reals(uint64_t h, const double *reals, size_t count) {
  for (size_t i = 0; i < count; i++) {
    uint64_t v;
    double d = reals[i] + 0.0; /* -0 is 0 */
    memcpy(&v, &d, sizeof v);
    h = (h ^ v) * UINT64_C(0x9E3779B97F4A7C15);
    h ^= h >> 29;
  }
  return h;
}

uint64_t vs_payload_hash(const vs_kind_info *info, const void *data) {
  uint64_t h = 3;
  for (size_t i = 0; i < info->field_count; i++) {
    const void *at = (const char *)data + info->fields[i].offset;
    size_t reals = vs_field_reals[info->fields[i].type];
    if (reals) {
      h = vs_payload_hash_reals(h, at, reals);
      continue;
    }
    switch (info->fields[i].type) {
      case VS_FIELD_real: case VS_FIELD_point: case VS_FIELD_vector: case VS_FIELD_affine: break; /* above */
      case VS_FIELD_integer: h = vs_hash_mix(h, (uint64_t)(int64_t)*(const int32_t *)at); break;
      case VS_FIELD_boolean: h = vs_hash_mix(h, *(const bool *)at); break;
      case VS_FIELD_points: {
        const vs_points *p = *(const vs_points *const *)at;
        h = vs_hash_mix(h, p->count);
        if (p->count) h = vs_payload_hash_reals(h, &p->at[0].x, 3 * (size_t)p->count);
        break;
      }
      case VS_FIELD_faces: {
        const vs_faces *f = *(const vs_faces *const *)at;
        h = vs_hash_bytes(h, f->data, (f->count + 1 + (size_t)f->corner_count) * sizeof *f->data);
        break;
      }
      case VS_FIELD_text: h = vs_hash_mix(h, vs_text_hash(*(const char *const *)at)); break;
      case VS_FIELD_ticket: h = vs_hash_mix(h, (*(const vs_ticket *const *)at)->id); break;
      case VS_FIELD_material: h = vs_hash_mix(h, vs_material_hash(*(const vs_material *const *)at)); break;
    }
  }
  return h;
}

/* Reals are compared by their bits: -0 was made 0 when the node was built, and so a not-a-number is equal to itself. */
bool vs_payload_equal(const vs_kind_info *info, const void *a, const void *b) {
  for (size_t i = 0; i < info->field_count; i++) {
    const void *x = (const char *)a + info->fields[i].offset, *y = (const char *)b + info->fields[i].offset;
    bool same = false;
    switch (info->fields[i].type) {
      case VS_FIELD_real: same = !memcmp(x, y, sizeof(double)); break;
      case VS_FIELD_integer: same = *(const int32_t *)x == *(const int32_t *)y; break;
      case VS_FIELD_boolean: same = *(const bool *)x == *(const bool *)y; break;
      case VS_FIELD_point:
      case VS_FIELD_vector: same = !memcmp(x, y, sizeof(vs_vec3)); break;
      case VS_FIELD_affine: same = !memcmp(x, y, sizeof(vs_affine)); break;
      case VS_FIELD_points: {
        const vs_points *p = *(const vs_points *const *)x, *q = *(const vs_points *const *)y;
        same = p == q || (p->count == q->count && !memcmp(p->at, q->at, p->count * sizeof *p->at));
        break;
      }
      case VS_FIELD_faces: {
        const vs_faces *f = *(const vs_faces *const *)x, *g = *(const vs_faces *const *)y;
        same = f == g || (f->count == g->count && f->corner_count == g->corner_count &&
                          !memcmp(f->data, g->data, (f->count + 1 + (size_t)f->corner_count) * sizeof *f->data));
        break;
      }
      case VS_FIELD_text: { /* two stores may meet: then it is the letters that count */
        const char *s = *(const char *const *)x, *t = *(const char *const *)y;
        same = s == t || !strcmp(s, t);
        break;
      }
      case VS_FIELD_ticket: same = (*(const vs_ticket *const *)x)->id == (*(const vs_ticket *const *)y)->id; break;
      case VS_FIELD_material: {
        const vs_material *m = *(const vs_material *const *)x, *n = *(const vs_material *const *)y;
        same = m == n || (!strcmp(m->name, n->name) && vs_material_hash(m) == vs_material_hash(n));
        break;
      }
    }
    if (!same) return false;
  }
  return true;
}

static void vs_payload_no_minus_zero(double *reals, size_t count) {
  for (size_t i = 0; i < count; i++) reals[i] += 0.0;
}

void vs_payload_adopt(const vs_kind_info *info, void *data) {
  for (size_t i = 0; i < info->field_count; i++) {
    void *at = (char *)data + info->fields[i].offset;
    vs_payload_no_minus_zero(at, vs_field_reals[info->fields[i].type]);
    switch (info->fields[i].type) {
      case VS_FIELD_points: vs_points_retain(*(vs_points *const *)at); break;
      case VS_FIELD_faces: vs_faces_retain(*(vs_faces *const *)at); break;
      case VS_FIELD_ticket: (*(vs_ticket *const *)at)->refs++; break;
      case VS_FIELD_real: case VS_FIELD_point: case VS_FIELD_vector: case VS_FIELD_affine: case VS_FIELD_integer: case VS_FIELD_boolean:
      case VS_FIELD_text: case VS_FIELD_material: break;
    }
  }
}

void vs_payload_drop(const vs_kind_info *info, vs_store *s, const void *data) {
  for (size_t i = 0; i < info->field_count; i++) {
    const void *at = (const char *)data + info->fields[i].offset;
    if (info->fields[i].type == VS_FIELD_points) vs_points_release(s, *(const vs_points *const *)at);
    if (info->fields[i].type == VS_FIELD_faces) vs_faces_release(s, *(const vs_faces *const *)at);
    if (info->fields[i].type == VS_FIELD_ticket) vs_ticket_release(s, *(const vs_ticket *const *)at);
  }
}

size_t vs_payload_array_bytes(const vs_kind_info *info, const void *data) {
  size_t bytes = 0;
  for (size_t i = 0; i < info->field_count; i++) {
    const void *at = (const char *)data + info->fields[i].offset;
    if (info->fields[i].type == VS_FIELD_points) bytes += vs_points_bytes(*(const vs_points *const *)at);
    if (info->fields[i].type == VS_FIELD_faces) bytes += vs_faces_bytes(*(const vs_faces *const *)at);
  }
  return bytes;
}
