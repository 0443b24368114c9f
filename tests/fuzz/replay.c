/* Fuzzes without libFuzzer: passes each named file to the fuzzer with which it is linked.
 *
 * `-n COUNT` then passes COUNT random changes of these files, which are equal in each run; `-s NUMBER` sets another
 * seed. tests/fuzz/corpus contains every input that once crashed. `-k FILE` writes each input to FILE first, so that
 * after a crash FILE contains the input that caused it. `-j FILE` passes the inputs of a journal (fuzz.h).
 *
 * An input that takes more than SLOW seconds of processor time, or WAITS seconds of elapsed time, ends the process.
 * SLOW is the smaller limit, since an input may merely wait on a busy machine. */
#include "tests/fuzz/fuzz.h"

#include <sys/time.h>

enum { MOST = 1 << 20, FILES = 4096, GROWTH = 4096, SLOW = 30, WAITS = 600 };
typedef struct { uint8_t *at; size_t count; } input;

static uint64_t state = 88172645463325252u;

static uint64_t chance(uint64_t below) { /* returns a random integer less than `below`, by the generator xorshift64* */
  state ^= state >> 12, state ^= state << 25, state ^= state >> 27;
  return below ? (state * 2685821657736338717u >> 16) % below : 0;
}

static void hand(const uint8_t *from, size_t count, const char *keep) {
  uint8_t *exact = malloc(count ? count : 1); /* a block of exactly the input's size, so that a sanitizer finds reads
                                               * past its end */
  FILE *f = keep ? fopen(keep, "wb") : NULL;
  if (!exact) abort();
  memcpy(exact, from, count);
  if (f) fwrite(from, 1, count, f), fclose(f);
  setitimer(ITIMER_PROF, &(struct itimerval){ .it_value.tv_sec = SLOW }, NULL);
  alarm(WAITS);
  LLVMFuzzerTestOneInput(exact, count);
  free(exact);
}

static bool journal(const char *path) {
  uint32_t count;
  static uint8_t bytes[MOST];
  FILE *f = fopen(path, "rb");
  if (!f) return perror(path), false;
  while (fread(&count, sizeof count, 1, f) == 1 && count <= sizeof bytes && fread(bytes, 1, count, f) == count)
    hand(bytes, count, NULL);
  return fclose(f) == 0;
}

/* Makes a few random changes to the input. Each changes a byte, a bit or a number, or inserts, deletes or overwrites a
 * range of bytes, taken from this or another input. */
static size_t change(uint8_t *to, size_t count, const input *all, size_t inputs) {
  static const uint8_t odd[] = { 0, 1, 127, 128, 255, 254, '(', ')', '"', '\\', '#', '\'', ' ', '\n', '0', '9', '-', '.', 'e' };
  for (uint64_t n = 1 + chance(6); n; n--) {
    const input *other = &all[chance(inputs)];
    size_t at = chance(count + 1), from = chance(other->count + 1), length = chance(1 + chance(32));
    switch (chance(6)) {
    case 0: if (at < count) to[at] = odd[chance(sizeof odd)]; break;
    case 1: if (at < count) to[at] ^= (uint8_t)(1 << chance(8)); break;
    case 2: if (at < count) to[at] = (uint8_t)chance(256); break;
    case 3: /* inserts the range of bytes */
      if (length > other->count - from) length = other->count - from;
      if (count + length > GROWTH) break;
      memmove(to + at + length, to + at, count - at);
      memcpy(to + at, other->at + from, length);
      count += length;
      break;
    case 4: /* deletes the range of bytes */
      if (length > count - at) length = count - at;
      memmove(to + at, to + at + length, count - at - length);
      count -= length;
      break;
    default: /* overwrites bytes of the input with the range */
      if (length > other->count - from) length = other->count - from;
      if (length > count - at) length = count - at;
      memcpy(to + at, other->at + from, length);
    }
  }
  return count;
}

int main(int argc, char **argv) {
  static input all[FILES];
  static uint8_t bytes[MOST];
  size_t inputs = 0;
  unsigned long many = 0;
  const char *keep = NULL;
  for (int i = 1; i < argc; i++) {
    if (!strcmp(argv[i], "-n") && i + 1 < argc) many = strtoul(argv[++i], NULL, 10);
    else if (!strcmp(argv[i], "-s") && i + 1 < argc) state += strtoul(argv[++i], NULL, 10) * 0x9E3779B97F4A7C15u, state |= 1;
    else if (!strcmp(argv[i], "-k") && i + 1 < argc) keep = argv[++i];
    else if (!strcmp(argv[i], "-j") && i + 1 < argc) {
      if (!journal(argv[++i])) return 1;
    } else if (inputs < FILES) {
      FILE *f = fopen(argv[i], "rb");
      if (!f) return perror(argv[i]), 1;
      size_t count = fread(bytes, 1, sizeof bytes, f);
      fclose(f);
      hand(bytes, count, keep);
      if (!(all[inputs].at = malloc(count + 1))) return 1;
      memcpy(all[inputs].at, bytes, count);
      all[inputs++].count = count;
    }
  }
  for (unsigned long i = 0; inputs && i < many; i++) {
    const input *from = &all[chance(inputs)];
    size_t count = from->count < GROWTH ? from->count : GROWTH;
    memcpy(bytes, from->at, count);
    hand(bytes, change(bytes, count, all, inputs), keep);
  }
  for (size_t i = 0; i < inputs; i++) free(all[i].at);
  printf("%zu inputs, %lu changed ones\n", inputs, many);
  return 0;
}
