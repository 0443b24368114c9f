/* Prints the contents of a .3mf file, which is a zip archive: `zipped FILE` prints all its parts, one after another. */
#include <stdio.h>
#include <zip.h>

int main(int argc, char **argv) {
  zip_t *z = argc == 2 ? zip_open(argv[1], ZIP_RDONLY, NULL) : NULL;
  if (!z) return 1;
  for (zip_uint64_t i = 0; i < (zip_uint64_t)zip_get_num_entries(z, 0); i++) {
    zip_file_t *f = zip_fopen_index(z, i, 0);
    char piece[4096];
    zip_int64_t got;
    while (f && (got = zip_fread(f, piece, sizeof piece)) > 0) fwrite(piece, 1, (size_t)got, stdout);
    if (f) zip_fclose(f);
  }
  zip_discard(z);
  return 0;
}
