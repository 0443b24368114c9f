/* Creates height fields from rows of numbers or from picture files. */
#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/constructors/files.h"

#include "bind/print.h"
#include "geometry/files/raster.h"
#include "vm/machine/fail.h"

/* Reads rows of numbers; the first row has the least y. The samples are stored as those of a picture, from the greatest
 * y downwards. */
static vs_status rows_of(vs_args *f, vs_value rows, vs_raster *out) {
  int64_t count = vs_list_length(rows), columns = count > 0 ? vs_list_length(vs_car(rows)) : 0;
  if (count < 0 || (count > 0 && columns < 0))
    return vs_bind_refuse(f, "source", "the name of a PNG or EXR file, or a list of rows, each a list of numbers",
                          rows);
  if (count < 2 || columns < 2)
    return vs_fail(f->vm, f->vm->sym.range,
                   "source must have two or more rows of two or more numbers, got %lld of %lld", (long long)count,
                   (long long)columns);
  vs_error e = { 0 };
  if (!vs_raster_room(out, "source", (uint64_t)columns, (uint64_t)count, &e)) return vs_bind_error(f->vm, &e);
  for (int64_t j = 0; j < count; j++, rows = vs_cdr(rows)) {
    vs_value row = vs_car(rows);
    int64_t length = vs_list_length(row);
    if (length != columns) {
      if (length < 0) return vs_bind_refuse(f, "source", "a list of rows, each a list of numbers", row);
      return vs_fail(f->vm, f->vm->sym.range,
                     "source must have rows of one length: row %lld has %lld numbers, the first %lld", (long long)j + 1,
                     (long long)length, (long long)columns);
    }
    for (int64_t i = 0; i < columns; i++, row = vs_cdr(row)) {
      double *to = &out->at[(size_t)(count - 1 - j) * (size_t)columns + (size_t)i];
      if (!vs_bind_take_number(f->vm, vs_car(row), to))
        return vs_bind_refuse(f, "source", "rows of numbers", vs_car(row));
    }
    if (!vs_poll(f->vm, (uint64_t)columns)) return VS_ERROR;
  }
  return VS_OK;
}

static vs_status picture_of(vs_args *f, const char **name, vs_raster *out) {
  vs_error e = { 0 };
  VS_ROOTS(f->vm, r, 1);
  if (!vs_bind_file(f, &f->arg[0], &r[0], name)) return VS_ERROR;
  vs_file_bytes file = { *name, vs_as_bytes(r[0])->at, (size_t)vs_as_bytes(r[0])->length };
  if (!vs_raster_read(f->store, &file, out, &e))
    return vs_bind_error(f->vm, &e);
  if (out->columns < 2 || out->rows < 2)
    return vs_fail(f->vm, f->vm->sym.range, "%s: the picture must have two or more rows and columns, it has %u x %u",
                   *name, out->columns, out->rows);
  return VS_OK;
}

/* Creates a height field over the rectangle whose opposite corners are arguments 1 and 2. scaled: whether values from 0
 * to 1 are converted to heights from low to high. */
static vs_status field(vs_args *f, const char *name, const vs_raster *r, bool scaled, double low, double high,
                       vs_value *out) {
  vs_vec3 p = f->arg[1].point, q = f->arg[2].point, least = { fmin(p.x, q.x), fmin(p.y, q.y), p.z },
          most = { fmax(p.x, q.x), fmax(p.y, q.y), p.z };
  size_t count = (size_t)r->columns * r->rows;
  vs_vec3 *at = vs_bind_scratch(f, count * sizeof *at);
  if (!at) return VS_ERROR;
  for (uint32_t j = 0; j < r->rows; j++)
    for (uint32_t i = 0; i < r->columns; i++) {
      double z = r->at[(size_t)(r->rows - 1 - j) * r->columns + i], u = (double)i / (r->columns - 1),
             v = (double)j / (r->rows - 1);
      if (scaled) z = z == 1 ? high : low + z * (high - low);
      if (!isfinite(z) || z < low) {
        char shown[32];
        if (isfinite(z)) vs_bind_number_text(shown, z);
        else memcpy(shown, isnan(z) ? "+nan.0" : z > 0 ? "+inf.0" : "-inf.0", 7);
        return vs_fail(f->vm, f->vm->sym.range, "%s%sthe height in row %u, column %u, must be %s, got %s", name,
                       *name ? ": " : "", *name ? r->rows - j : j + 1, i + 1, isfinite(z) ? "at least #:low" : "finite",
                       shown);
      }
      at[(size_t)j * r->columns + i] = vs_v3(i + 1 == r->columns ? most.x : least.x + u * (most.x - least.x),
                                             j + 1 == r->rows ? most.y : least.y + v * (most.y - least.y), p.z + z);
    }
  vs_points *points = vs_points_new(f->store, at, count);
  if (!points) return vs_fail_memory(f->vm);
  bool flat = true;
  for (size_t i = 0; flat && i < count; i++) flat = !(at[i].z > p.z + low);
  vs_status ok = flat ? vs_bind_empty(f, "no height is above #:low", out)
                      : vs_bind_make(f, VS_HEIGHT_FIELD,
                                     &(struct vs_height_field){
                                         .points = points, .columns = (int32_t)r->columns, .low = p.z + low },
                                     NULL, 0, out);
  vs_points_release(f->store, points);
  return ok;
}

vs_status vs_p_make_height_field(vs_args *f, vs_value *out) {
  vs_value source = f->arg[0].value;
  vs_vec3 p = f->arg[1].point, q = f->arg[2].point;
  double low = f->key[0].given ? f->key[0].real : 0, high = f->key[1].given ? f->key[1].real : 1;
  bool picture = vs_is_string(source);
  const char *name = "";
  if (!picture && !vs_is_pair(source) && source != VS_NIL)
    return vs_bind_refuse(f, "source", "the name of a PNG or EXR file, or a list of rows, each a list of numbers",
                          source);
  if (p.z != q.z)
    return vs_bind_refuse(f, "q", "as high as p: the two are corners of a level rectangle", f->arg[2].value);
  if ((picture || f->key[1].given) && high < low)
    return vs_bind_refuse(f, "high", "#:low or more", f->key[1].given ? f->key[1].value : f->key[0].value);
  if (p.x == q.x || p.y == q.y) return vs_bind_empty(f, "the rectangle has no area", out);
  vs_raster r = { .store = f->store };
  vs_status ok = (picture ? picture_of(f, &name, &r) : rows_of(f, source, &r)) &&
                         field(f, name, &r, picture || f->key[1].given, low, high, out)
                     ? VS_OK
                     : VS_ERROR;
  vs_raster_free(&r);
  return ok;
}
