/* Contains the table of node kinds, generated from prims.def. Hashes, compares, retains and releases payloads by this
 * table. */
#include "model/kinds.h"

#include <math.h>
#include <string.h>

#include "model/store/store_inside.h"

#define VS_CLASS_NOTHING VS_NOTHING
#define VS_CLASS_CURVE VS_CURVE
#define VS_CLASS_REGION VS_REGION_CLASS
#define VS_CLASS_SURFACE VS_SURFACE
#define VS_CLASS_SOLID VS_SOLID
#define VS_CLASS_INHERIT VS_INHERIT

/* In vs_kind_get, each kind has a block in which the name here_ is the struct of the kind's fields, to compute their
 * offsets. Each table of fields ends with a row of zeros, which is not counted. */
const vs_kind_info *vs_kind_get(vs_kind kind) {
  switch (kind) {
#define VS_KIND(upper, lower, name, class_, level, role, traits)                                                     \
  case VS_##upper: {                                                                                   \
    typedef struct vs_##lower here_;                                                                   \
    static const char name_[] = name;                                                                  \
    enum { class_here_ = (int)VS_CLASS_##class_, level_here_ = (int)VS_LEVEL_##level };                \
    static const vs_field_info fields_[] = {
#define VS_FIELD(type, member, argument) { #member, argument, VS_FIELD_##type, offsetof(here_, member) },
#define VS_KIND_END(upper, lower)                                                                      \
      { NULL, NULL, VS_FIELD_real, 0 } };                                                              \
    static const vs_kind_info info_ = { name_, (vs_class)class_here_, (vs_level)level_here_, sizeof(here_), \
                                        sizeof fields_ / sizeof *fields_ - 1, fields_ }; \
    return &info_;                                                                                     \
  }
#include "model/prims.def"
    case VS_KIND_COUNT: break;
  }
  return NULL;
}

const unsigned char vs_kind_roles[] = {
#define VS_KIND(upper, lower, name, class_, level, role, traits) [VS_##upper] = VS_ROLE_##role,
#define VS_FIELD(type, member, argument)
#define VS_KIND_END(upper, lower)
#include "model/prims.def"
};

const unsigned short vs_kind_traits[] = {
#define VS_KIND(upper, lower, name, class_, level, role, traits) [VS_##upper] = traits,
#define VS_FIELD(type, member, argument)
#define VS_KIND_END(upper, lower)
#include "model/prims.def"
};

const unsigned char vs_field_reals[] = {
  [VS_FIELD_real] = 1, [VS_FIELD_point] = 3, [VS_FIELD_vector] = 3, [VS_FIELD_affine] = 12, [VS_FIELD_ticket] = 0
};

/* ---- macros that hash, compare, retain or release one field, for each type of field ---- */

/* Returns the hash h combined with the number d, by one multiplication. At the end, the caller mixes the bits of the
 * hash once more. */
static inline uint64_t hash_step(uint64_t h, double d) {
  uint64_t v;
  memcpy(&v, &d, sizeof v);
  h = (h ^ v) * UINT64_C(0x9E3779B97F4A7C15);
  return h ^ h >> 29;
}
static inline uint64_t settle_reals(uint64_t h, double *reals, size_t count) {
  for (size_t i = 0; i < count; i++) h = hash_step(h, reals[i] += 0.0); /* adding 0.0 changes -0 to 0, so that equal
                                                                         * numbers have equal hashes */
  return h;
}
static inline uint64_t settle_real(uint64_t h, double *at) { return settle_reals(h, at, 1); }
static inline uint64_t settle_point(uint64_t h, vs_vec3 *at) {
  return hash_step(hash_step(hash_step(h, at->x += 0.0), at->y += 0.0), at->z += 0.0);
}
static inline uint64_t settle_vector(uint64_t h, vs_vec3 *at) { return settle_point(h, at); }
static inline uint64_t settle_affine(uint64_t h, vs_affine *at) {
  for (int row = 0; row < 3; row++) h = settle_reals(h, at->m[row], 4);
  return h;
}
static inline uint64_t settle_integer(uint64_t h, const int32_t *at) { return vs_hash_mix(h, (uint64_t)(int64_t)*at); }
static inline uint64_t settle_boolean(uint64_t h, const bool *at) { return vs_hash_mix(h, *at); }
static uint64_t settle_points(uint64_t h, const vs_points *const *at) {
  vs_points *p = vs_points_retain((vs_points *)(uintptr_t)*at);
  h = vs_hash_mix(h, p->count);
  for (size_t i = 0; i < p->count; i++) h = hash_step(hash_step(hash_step(h, p->at[i].x), p->at[i].y), p->at[i].z);
  return h;
}
static uint64_t settle_faces(uint64_t h, const vs_faces *const *at) {
  vs_faces *f = vs_faces_retain((vs_faces *)(uintptr_t)*at);
  return vs_hash_mix(h, f->hash);
}
static uint64_t settle_text(uint64_t h, const char *const *at) { return vs_hash_mix(h, vs_text_hash(*at)); }
static uint64_t settle_material(uint64_t h, const vs_material *const *at) {
  return vs_hash_mix(h, vs_material_hash(*at));
}
static uint64_t settle_ticket(uint64_t h, const vs_ticket *const *at) {
  ((vs_ticket *)(uintptr_t)*at)->refs++;
  return vs_hash_mix(h, (*at)->id);
}

uint64_t vs_payload_settle(vs_kind kind, void *data) {
  uint64_t h = 3;
  switch (kind) {
#define VS_KIND(upper, lower, name, class_, level, role, traits)                                                       \
  case VS_##upper: {                                                                                                   \
    struct vs_##lower *d = data;                                                                                       \
    (void)d;
#define VS_FIELD(type, member, argument) h = settle_##type(h, &d->member);
#define VS_KIND_END(upper, lower) break; }
#include "model/prims.def"
    case VS_KIND_COUNT: break;
  }
  return h;
}

static inline bool reals_within(const double *reals, size_t count, double most) {
  bool within = true;
  for (size_t i = 0; i < count; i++) within &= fabs(reals[i]) <= most;
  return within;
}
static inline bool within_real(const double *at, double most) { return fabs(*at) <= most; }
static inline bool within_point(const vs_vec3 *at, double most) {
  return (fabs(at->x) <= most) & (fabs(at->y) <= most) & (fabs(at->z) <= most);
}
static inline bool within_vector(const vs_vec3 *at, double most) { return within_point(at, most); }
static inline bool within_affine(const vs_affine *at, double most) {
  return reals_within(at->m[0], 4, most) && reals_within(at->m[1], 4, most) && reals_within(at->m[2], 4, most);
}
static bool within_points(const vs_points *const *at, double most) {
  bool within = true;
  for (size_t i = 0; *at && i < (*at)->count; i++) within &= within_point(&(*at)->at[i], most);
  return within;
}
#define within_integer(at, most) true
#define within_boolean(at, most) true
#define within_faces(at, most) true
#define within_text(at, most) true
#define within_material(at, most) true
#define within_ticket(at, most) true

bool vs_kind_within(vs_kind kind, const void *data, double most) {
  bool within = true;
  switch (kind) {
#define VS_KIND(upper, lower, name, class_, level, role, traits)                                                       \
  case VS_##upper: {                                                                                                   \
    const struct vs_##lower *d = data;                                                                                 \
    (void)d;
#define VS_FIELD(type, member, argument) within &= within_##type(&d->member, most);
#define VS_KIND_END(upper, lower) break; }
#include "model/prims.def"
    case VS_KIND_COUNT: break;
  }
  return within;
}

/* The macros drop_TYPE release the memory outside the payload to which a field of this type refers, or count its
 * bytes. */
#define drop_real(s, at)
#define drop_point(s, at)
#define drop_vector(s, at)
#define drop_affine(s, at)
#define drop_integer(s, at)
#define drop_boolean(s, at)
#define drop_text(s, at)
#define drop_material(s, at)
#define drop_points(s, at) vs_points_release(s, *(at));
#define drop_faces(s, at) vs_faces_release(s, *(at));
#define drop_ticket(s, at) vs_ticket_release(s, *(at));

void vs_payload_drop(vs_kind kind, vs_store *s, const void *data) {
  (void)s;
  switch (kind) {
#define VS_KIND(upper, lower, name, class_, level, role, traits)                                                       \
  case VS_##upper: {                                                                                                   \
    const struct vs_##lower *d = data;                                                                                 \
    (void)d;
#define VS_FIELD(type, member, argument) drop_##type(s, &d->member)
#define VS_KIND_END(upper, lower) break; }
#include "model/prims.def"
    case VS_KIND_COUNT: break;
  }
}

#define bytes_real(at) 0
#define bytes_point(at) 0
#define bytes_vector(at) 0
#define bytes_affine(at) 0
#define bytes_integer(at) 0
#define bytes_boolean(at) 0
#define bytes_text(at) 0
#define bytes_material(at) 0
#define bytes_ticket(at) 0
#define bytes_points(at) vs_points_bytes(*(at))
#define bytes_faces(at) vs_faces_bytes(*(at))

size_t vs_payload_array_bytes(vs_kind kind, const void *data) {
  size_t bytes = 0;
  switch (kind) {
#define VS_KIND(upper, lower, name, class_, level, role, traits)                                                       \
  case VS_##upper: {                                                                                                   \
    const struct vs_##lower *d = data;                                                                                 \
    (void)d;
#define VS_FIELD(type, member, argument) bytes += bytes_##type(&d->member);
#define VS_KIND_END(upper, lower) break; }
#include "model/prims.def"
    case VS_KIND_COUNT: break;
  }
  return bytes;
}

/* Returns true if two payloads are equal. Reals are compared by their bits: new nodes contain no -0, and a NaN equals
 * itself. */
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
        same = f == g || (f->hash == g->hash && f->count == g->count && f->corner_count == g->corner_count &&
                          !memcmp(f->data, g->data, (f->count + 1 + (size_t)f->corner_count) * sizeof *f->data));
        break;
      }
      case VS_FIELD_text: { /* compares the letters, because equal texts of different stores have different addresses */
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
