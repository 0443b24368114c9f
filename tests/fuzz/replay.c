/* Owns the replay of inputs without libFuzzer: hands each file named to the fuzzer that it is linked with. Every input that once crashed is kept in tests/fuzz/corpus. */
#include "tests/fuzz/fuzz.h"

int main(int argc, char **argv) {
  for (int i = 1; i < argc; i++) {
    FILE *f = fopen(argv[i], "rb");
    static uint8_t bytes[1 << 20];
    if (!f) return perror(argv[i]), 1;
    size_t count = fread(bytes, 1, sizeof bytes, f);
    fclose(f);
    uint8_t *exact = malloc(count ? count : 1); /* so that reading past the end is seen */
    if (!exact) return 1;
    memcpy(exact, bytes, count);
    LLVMFuzzerTestOneInput(exact, count);
    free(exact);
  }
  printf("%d inputs\n", argc - 1);
  return 0;
}
