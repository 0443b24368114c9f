/* Sorts items by integer keys. Sorts short runs by insertion, and then merges the runs unless they are already in
 * order. */
#include "kernel/exact/sort.h"

#include "model/assert.h"

#include <string.h>

void vs_sort_keyed(vs_keyed *at, vs_keyed *scratch, size_t count) {
  enum { RUN = 16 };
  VS_ASSERT(count == 0 || at != scratch);
  for (size_t low = 0; low < count; low += RUN) {
    size_t high = count - low < RUN ? count : low + RUN;
    for (size_t i = low + 1; i < high; i++) {
      vs_keyed x = at[i];
      size_t j = i;
      for (; j > low && x.key < at[j - 1].key; j--) at[j] = at[j - 1];
      at[j] = x;
    }
  }
  for (size_t width = RUN; width < count; width *= 2)
    for (size_t low = 0; low + width < count; low += 2 * width) {
      size_t middle = low + width, high = count - middle < width ? count : middle + width;
      if (at[middle].key >= at[middle - 1].key) continue;
      memcpy(scratch, at + low, width * sizeof *at);
      size_t i = 0, j = middle, out = low;
      while (i < width && j < high) {
        int second = at[j].key < scratch[i].key; /* This comparison is stored as a number instead of causing a branch,
                                                  * because the processor could not predict the branch. */
        const vs_keyed *from = second ? &at[j] : &scratch[i];
        at[out++] = *from;
        j += (size_t)second;
        i += (size_t)!second;
      }
      while (i < width) at[out++] = scratch[i++];
    }
}
