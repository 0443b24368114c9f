/* Allocates the large blocks of memory of the command vs. Each is a separate memory mapping, aligned and marked for
 * huge pages.
 *
 * A large model writes to all of its memory once. With small pages, the system needs longer to provide them than the
 * model needs to fill them: for a million cylinders, it takes a quarter of the time. Smaller blocks come from the C
 * library. */
#define _GNU_SOURCE /* declares mremap */
#include "cli/large_blocks.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { HUGE_PAGE = 2 << 20, PAGE = 4 << 10 };

static size_t mapped_size(size_t bytes) { return (bytes + PAGE - 1) & ~(size_t)(PAGE - 1); }
static bool is_mapped(size_t bytes) { return bytes >= HUGE_PAGE; }

static void *map(size_t size, int protection) {
  void *p =
      mmap(NULL, size, protection, MAP_PRIVATE | MAP_ANONYMOUS | (protection == PROT_NONE ? MAP_NORESERVE : 0), -1, 0);
  return p == MAP_FAILED ? NULL : p;
}

/* Maps `size` bytes at a multiple of the size of huge pages. If memory does not suffice for that, maps them
 * anywhere. */
static char *map_aligned(size_t size, int protection) {
  char *p = map(size + HUGE_PAGE, protection);
  if (!p) return map(size, protection);
  size_t before = (size_t)(-(uintptr_t)p) & (HUGE_PAGE - 1), after = HUGE_PAGE - before;
  if (before) munmap(p, before);
  if (after) munmap(p + before + size, after);
  return p + before;
}

static void ask_for_huge_pages(void *p, size_t size) {
#ifdef MADV_HUGEPAGE
  madvise(p, size, MADV_HUGEPAGE); /* if the system refuses, the pages stay small, which is no failure */
#else
  (void)p, (void)size;
#endif
}

static void *map_new(size_t bytes) {
  char *p = bytes > SIZE_MAX - 2 * (size_t)HUGE_PAGE ? NULL : map_aligned(mapped_size(bytes), PROT_READ | PROT_WRITE);
  if (p) ask_for_huge_pages(p, mapped_size(bytes));
  return p;
}

/* Changes the size of a mapped block. Its pages are moved without copying. Returns NULL when memory is out. */
static void *map_resize(void *old, size_t old_bytes, size_t bytes) {
  if (bytes > SIZE_MAX - 2 * (size_t)HUGE_PAGE) return NULL;
  size_t old_size = mapped_size(old_bytes), size = mapped_size(bytes);
  void *p = old_size == size ? old : mremap(old, old_size, size, 0);
  if (p == MAP_FAILED) {
    char *to = map_aligned(size, PROT_NONE);
    p = to ? mremap(old, old_size, size, MREMAP_MAYMOVE | MREMAP_FIXED, to) : MAP_FAILED;
    if (p == MAP_FAILED) {
      if (to) munmap(to, size);
      return NULL;
    }
  }
  if (size > old_size) ask_for_huge_pages(p, size);
  return p;
}

void *cli_memory(void *context, void *old, size_t old_size, size_t new_size) {
  (void)context;
  bool was = old && is_mapped(old_size), is = is_mapped(new_size);
  if (!was && !is) {
    if (new_size) return realloc(old, new_size);
    free(old);
    return NULL;
  }
  if (was && is) return map_resize(old, old_size, new_size);
  void *new = is ? map_new(new_size) : new_size ? malloc(new_size) : NULL;
  if (new_size && !new) return NULL;
  if (old && new_size) memcpy(new, old, old_size < new_size ? old_size : new_size);
  if (was) munmap(old, mapped_size(old_size));
  else free(old);
  return new;
}
