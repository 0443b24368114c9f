/* Implements the registered types of flat records (flat.h). */
#include "vm/values/flat.h"

#include <float.h>
#include <math.h>

double vs_flat_length(double x, double y, double z) {
  double sum = x * x + y * y + z * z;
  if (sum > 1e-280 && sum < 1e300) return sqrt(sum);
  double most = fmax(fabs(x), fmax(fabs(y), fabs(z)));
  if (!(most > 0) || !(most <= DBL_MAX)) return most;
  x /= most, y /= most, z /= most;
  return most * sqrt(x * x + y * y + z * z);
}

bool vs_flat_callable(const vs_scheme *vm, const vs_value *a, int n) {
  for (int i = 0; i < n; i++)
    if (vm->flat && vm->flat->call && vs_is(a[i], VS_T_FLAT)) {
      uint32_t tag = vs_as_flat(a[i])->h.flags;
      if (vm->flat->at[VS_OP_ADD][tag][tag].rule == VS_RULE_CALL) return true;
    }
  return false;
}
