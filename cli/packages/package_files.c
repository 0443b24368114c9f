/* Copies, removes and hashes the files of a package. Folders are walked in the order of names. */
#define _GNU_SOURCE
#include "cli/packages/package_files.h"

#include <errno.h>
#include <fts.h>
#include <nettle/sha2.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "geometry/dynamic.h"

enum { MOST_FILES = 20000, PIECE = 65536, PATH = 4096 };
#define MOST_BYTES ((long long)256 << 20)

#define FUNCTIONS(F)                                                               \
  F(init, nettle_sha256_init, void, (struct sha256_ctx *))                         \
  F(update, nettle_sha256_update, void, (struct sha256_ctx *, size_t, const uint8_t *)) \
  F(digest, nettle_sha256_digest, void, (struct sha256_ctx *, size_t, uint8_t *))
VS_DYNAMIC_FUNCTIONS(FUNCTIONS);

static bool fail(char why[PACKAGE_WHY], const char *path, const char *reason) {
  snprintf(why, PACKAGE_WHY, "%.180s: %.100s", path, reason);
  return false;
}

static int by_name(const FTSENT **a, const FTSENT **b) { return strcmp((*a)->fts_name, (*b)->fts_name); }

static bool is_skipped(const char *name) {
  static const char *const names[] = { ".git", ".vs", ".vs.new", "vs.lock" };
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (!strcmp(name, names[i])) return true;
  return false;
}

/* Receives a file or a folder of a package. name: its path without the package's folder. */
typedef bool each_fn(void *to, const char *path, const char *name, bool folder, char why[PACKAGE_WHY]);

/* Calls `each` for all files and folders below a folder. skips: whether to skip the files of git and of vs add. */
static bool walk(const char *folder, bool skips, each_fn *each, void *to, char why[PACKAGE_WHY]) {
  char *roots[] = { (char *)(size_t)folder, NULL };
  FTS *all = fts_open(roots, FTS_PHYSICAL | FTS_NOCHDIR, by_name);
  bool ok = all != NULL;
  size_t files = 0, prefix = strlen(folder);
  long long bytes = 0;
  if (!ok) fail(why, folder, strerror(errno));
  for (FTSENT *f; ok && (f = fts_read(all));) {
    const char *name = f->fts_path + prefix + (f->fts_path[prefix] == '/');
    if (f->fts_level > 0 && skips && is_skipped(f->fts_name)) {
      fts_set(all, f, FTS_SKIP);
      continue;
    }
    if (f->fts_info == FTS_DP) continue;
    bool unread = f->fts_info == FTS_DNR || f->fts_info == FTS_ERR || f->fts_info == FTS_NS;
    if (unread) ok = fail(why, f->fts_path, strerror(f->fts_errno));
    else if (f->fts_info == FTS_D) ok = f->fts_level == 0 || each(to, f->fts_path, name, true, why);
    else if (f->fts_info != FTS_F) ok = fail(why, f->fts_path, "a package has no links and no special files");
    else {
      bytes += f->fts_statp->st_size;
      bool small = ++files <= MOST_FILES && bytes <= MOST_BYTES;
      if (!small) ok = fail(why, folder, "a package has at most 20,000 files and 256 MB");
      else ok = each(to, f->fts_path, name, false, why);
    }
  }
  if (all) fts_close(all);
  return ok;
}

/* ---- copying ---- */

static bool copy_one(void *context, const char *path, const char *name, bool folder, char why[PACKAGE_WHY]) {
  const char *root = context;
  char to[PATH], piece[PIECE];
  if (snprintf(to, sizeof to, "%s/%s", root, name) >= (int)sizeof to) return fail(why, path, "the path is too long");
  if (folder) return mkdir(to, 0777) == 0 || fail(why, to, strerror(errno));
  FILE *in = fopen(path, "rb"), *out = in ? fopen(to, "wbx") : NULL;
  bool ok = out != NULL;
  for (size_t n; ok && (n = fread(piece, 1, sizeof piece, in)) > 0;) ok = fwrite(piece, 1, n, out) == n;
  if (ok && ferror(in)) ok = false;
  if (out) ok = fclose(out) == 0 && ok;
  if (in) fclose(in);
  return ok || fail(why, path, strerror(errno));
}

bool package_copy(const char *from, const char *to, char why[PACKAGE_WHY]) {
  if (mkdir(to, 0777) != 0) return fail(why, to, strerror(errno));
  return walk(from, true, copy_one, (char *)(size_t)to, why);
}

/* ---- the hash ---- */

typedef struct { dynamic_functions f; struct sha256_ctx state; } hashing;

static void add(hashing *h, const char *text, size_t length) { h->f.update(&h->state, length, (const uint8_t *)text); }

static bool add_contents(hashing *h, const char *path, char why[PACKAGE_WHY]) {
  char piece[PIECE];
  FILE *in = fopen(path, "rb");
  if (!in) return fail(why, path, strerror(errno));
  for (size_t got; (got = fread(piece, 1, sizeof piece, in)) > 0;) add(h, piece, got);
  bool ok = !ferror(in);
  fclose(in);
  return ok || fail(why, path, "cannot be read");
}

/* Adds the length and text of the name, then the length and contents of the file. The lengths ensure that different
 * folders give different data. */
static bool hash_one(void *context, const char *path, const char *name, bool folder, char why[PACKAGE_WHY]) {
  hashing *h = context;
  char head[80];
  struct stat is;
  if (folder) return true;
  if (stat(path, &is) != 0) return fail(why, path, strerror(errno));
  int n = snprintf(head, sizeof head, "%zu %lld ", strlen(name), (long long)is.st_size);
  add(h, head, (size_t)n);
  add(h, name, strlen(name));
  return add_contents(h, path, why);
}

static bool begin(hashing *h, char why[PACKAGE_WHY]) {
  vs_error e = { 0 };
  bool ok = vs_dynamic_load(VS_LIBRARY_NETTLE, "packages", dynamic_names, sizeof dynamic_names / sizeof *dynamic_names,
                            &h->f, &e);
  if (ok) h->f.init(&h->state);
  else snprintf(why, PACKAGE_WHY, "%.250s", e.message);
  return ok;
}

static void end(hashing *h, char hash[PACKAGE_HASH]) {
  uint8_t bytes[32];
  h->f.digest(&h->state, sizeof bytes, bytes);
  for (size_t i = 0; i < sizeof bytes; i++) snprintf(hash + 2 * i, 3, "%02x", bytes[i]);
}

bool package_hash(const char *folder, char hash[PACKAGE_HASH], char why[PACKAGE_WHY]) {
  hashing h;
  if (!begin(&h, why) || !walk(folder, false, hash_one, &h, why)) return false;
  return end(&h, hash), true;
}

bool package_file_hash(const char *path, char hash[PACKAGE_HASH], char why[PACKAGE_WHY]) {
  hashing h;
  if (!begin(&h, why) || !add_contents(&h, path, why)) return false;
  return end(&h, hash), true;
}

/* ---- removing ---- */

bool package_remove(const char *folder) {
  char *roots[] = { (char *)(size_t)folder, NULL };
  struct stat is;
  if (lstat(folder, &is) != 0) return errno == ENOENT;
  FTS *all = fts_open(roots, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
  bool ok = all != NULL;
  for (FTSENT *f; ok && (f = fts_read(all));)
    if (f->fts_info != FTS_D) ok = remove(f->fts_accpath) == 0;
  if (all) fts_close(all);
  return ok;
}
