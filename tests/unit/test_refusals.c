/* Tests that every request for memory may be refused, in some forty programs: every kind of object, every form of the
 * language, every format. Requests are of three kinds: objects of the interpreter's heap, requests of the interpreter
 * to its host, and requests to the C library by geometry and the libraries that it uses (GEOS, FreeType, libzip).
 *
 * Each of the first requests is refused in turn, alone or with all later requests; of later requests only a sample is
 * refused. A run with refusals must end with an error, or write the bytes that it writes without a refusal. The
 * interpreter must work afterwards, and all memory must be freed. */
#define _DEFAULT_SOURCE /* for mkdtemp */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "visualscheme.h"
#include "geometry/files/exr.h"
#include "geometry/files/png_write.h"
#include "tests/unit/allocator.h"
#include "vm/values/gc.h"

/* left: number of requests until one is refused. on: whether requests are counted. good: whether all later requests are
 * refused too. refused: whether a request has been refused */
typedef struct { long left; bool on, good, refused; } refusal;
static refusal host, library; /* host: requests to the host's callback. library: requests to the C library's
                               * allocator */

static bool refuse(refusal *r) {
  if (!r->on) return false;
  if (r->refused && r->good) return true;
  if (r->refused || r->left-- > 0) return false;
  return r->refused = true;
}

#if REPLACED
extern void *volatile refused_for;
void *volatile refused_for; /* address of the caller whose request was refused; in a debugger: info symbol
                             * refused_for */
#define REFUSE (refuse(&library) && (refused_for = __builtin_return_address(0), true))
void *malloc(size_t n) { return REFUSE ? NULL : __libc_malloc(n); }
void *calloc(size_t n, size_t size) { return REFUSE ? NULL : __libc_calloc(n, size); }
void *realloc(void *p, size_t n) { return n && REFUSE ? NULL : __libc_realloc(p, n); }
#else
static void *__libc_realloc(void *p, size_t n) { return realloc(p, n); }
#endif

typedef struct { size_t live; long blocks; int told; char said[200]; } account;

static void *take(void *context, void *old, size_t old_size, size_t new_size) {
  account *b = context;
  if (new_size == 0) {
    if (old) b->blocks--;
    b->live -= old_size;
    free(old);
    return NULL;
  }
  if (new_size > old_size && refuse(&host)) return NULL;
  void *p = __libc_realloc(old, new_size); /* calls the C library's own function, so that the host's request is not
                                            * counted a second time as a request to the library */
  assert_non_null(p);
  if (!old) b->blocks++;
  b->live += new_size - old_size;
  return p;
}
static void told(void *context, const vs_diagnostic *d) {
  account *b = context;
  assert_non_null(d->message);
  b->told++;
  if (d->severity == VS_SEVERITY_ERROR) snprintf(b->said, sizeof b->said, "%s", d->message);
}
static bool drop(void *context, const char *text, size_t length) { return (void)context, (void)text, (void)length, true; }
static bool sum_bytes(void *context, const void *bytes, size_t count) { /* adds the bytes to the hash FNV-1a of the
                                                                         * output */
  uint64_t *sum = context;
  for (size_t i = 0; i < count; i++) *sum = (*sum ^ ((const unsigned char *)bytes)[i]) * UINT64_C(0x100000001B3);
  return true;
}
static bool each_name(void *context, const char *name) { return (void)context, (void)name, true; }

typedef struct { const char *text, *format; } program;
#define SOLIDS "(draw (unite (make-box (xyz 0 0 0) (xyz 2 2 2)) (do-move (with-material 'copper (make-sphere (xyz 2 2 2) 1)) (vxyz 0 0 1))))" \
               "(draw (subtract (make-cylinder (xyz 5 0 0) 3 1) (make-box (xyz 5 0 0) (xyz 7 2 5))))"
static const program programs[] = {
  { "(define (fib n) (if (< n 2) n (+ (fib (- n 1)) (fib (- n 2))))) (fib 12)", NULL },
  { "(define (deep n) (if (= n 0) 0 (+ 1 (deep (- n 1))))) (deep 20000)", NULL },
  { "(define k #f) (define n 0) (let ((v (call/cc (lambda (c) (set! k c) 0)))) (set! n (+ n 1)) (if (< n 3) (k n) n))", NULL },
  { "(define-syntax m (syntax-rules () ((_ (a b ...) ...) (list (list a b ...) ...)))) (m (1 2) (3)) `(1 ,@(list 2 3) #(,(m)))", NULL },
  { "(define-syntax sw (er-macro-transformer (lambda (f r c) (list (r 'list) (caddr f) (cadr f))))) (sw 1 2)", NULL },
  { "(define-record-type p (mk a b) p? (a p-a set-p-a!) (b p-b)) (define x (mk 1 2)) (set-p-a! x 5) (p-a x) (list x)", NULL },
  { "(define-library (l) (export f) (import (scheme base)) (begin (define (f x) (* x x)))) (import (l)) (f 4)", NULL },
  { "(define (f [x any? 1] #:k [k (and integer? positive?) 2] . [r (list-of number?)]) (list x k r)) (f 1 #:k 5 7 8) (f)", NULL },
  { "(guard (e (#t (condition/report-string e))) (car 5)) (with-exception-handler (lambda (e) 1) (lambda () (+ 1 (raise-continuable 'x))))", NULL },
  { "(dynamic-wind (lambda () 0) (lambda () (expt 3 500)) (lambda () 0)) (exact->inexact 1/3) (number->string (expt 7 3000)) (string->number \"1e300\")", NULL },
  { "(define h (make-hash)) (for-each (lambda (i) (hash-set! h (list i) i)) (iota 200)) (hash->list h) (hash-remove! h '(3)) (hash-keys h)", NULL },
  { "(define s (string-append \"abc\" (make-string 50 #\\x3BB))) (string-upcase s) (string-split s \"b\") (string->list s) (string->symbol s) (string-replace s \"a\" \"xx\")", NULL },
  { "(sort (map (lambda (i) (modulo (* i 7919) 101)) (iota 300)) <) (apply + (iota 500)) (append (iota 50) (iota 50)) (list->vector (iota 99))", NULL },
  { "(define p (open-output-string)) (write '(1 \"a\" #\\b 2.5 |x y| #(1 2)) p) (read (open-input-string (get-output-string p))) (printf \"~a ~s\" p p)", NULL },
  { "(define l (list 1 2)) (set-cdr! (cdr l) l) (write l) (equal? l l) (define v (vector 1)) (vector-set! v 0 v) (display v)", NULL },
  { "(for/list ([x (in-range 20)] #:when (odd? x)) (* x x)) (let-values (((a b) (values 1 2))) (list a b)) (case 5 ((1) 2) (else => list)) (do ((i 0 (+ i 1))) ((= i 9)) i)", NULL },
  { "(eval '(let loop ((i 0)) (if (< i 9) (loop (+ i 1)) i)) (interaction-environment)) (eval (cons 'list (iota 3000)) (interaction-environment))", NULL },
  { "(define (walk l) (call/cc (lambda (return) (for-each (lambda (x) (call/cc (lambda (next) (return (cons x next))))) l) '())))"
    "(define p (walk '(1 2 3))) (if (and (pair? p) (< (car p) 3)) ((cdr p) 0)) p", NULL },
  { "(define p (make-parameter 1)) (parameterize ((p 2)) (p)) (force (delay (+ 1 2))) (delay-force (delay 1)) (string->utf8 \"abc\") (char-upcase #\\a) (exact-integer-sqrt 17)", NULL },
  { "(car 5)", NULL },
  { "(error \"a\" 1 '(2 \"t\") #\\c)", NULL },
  { "(error 'who \"~a and ~s\" (string-append \"abc\" \"d\") (vector 1 2.5))", NULL },
  { "(raise (list 'x \"y\"))", NULL },
  { "(define (f x) (+ 1 (g x))) (define (g x) (h x))\n(f 1)", NULL },
  { "(define x 1\n(display x)", NULL },
  { "(define-parameter n 3 #:min 1 #:max 9) (define (column p [r positive? 0.5]) (with-material 'concrete (make-cylinder p 3 r)))"
    "(draw (unite (map column (line-sequence (xyz 0 0 0) (xyz 9 0 0) n))))", "tree" },
  { SOLIDS, "povray" }, { SOLIDS, "openscad" }, { SOLIDS, "x3d" }, { SOLIDS, "x3dv" }, { SOLIDS, "html" }, { SOLIDS, "stl" },
  { SOLIDS, "stl-ascii" }, { SOLIDS, "ply" }, { SOLIDS, "off" }, { SOLIDS, "obj" }, { SOLIDS, "glb" }, { SOLIDS, "3mf" },
  { "(draw (do-sweep (make-circle (xyz 0 0 0) 1/4) (make-spline (list (xyz 0 0 0) (xyz 1 0 4) (xyz 9 0 5))) 0 0.5))", "stl" },
  { "(draw (do-extrude (make-regular-polygon (xyz 0 0 0) 2 6) 3 #:twist 0.5)) (draw (do-revolve (make-circle (xyz 3 0 0) 1) 'y))", "povray" },
  { "(draw (do-loft (list (make-circle (xyz 0 0 0) 1) (make-regular-polygon (xyz 0 0 2) 1 5) (make-circle (xyz 0 0 4) 2))))", "stl" },
  { "(draw (make-surface (lambda (u v) (xyz u v (* u v))) 0 1 0 1)) (draw (make-mesh (list (list (xyz 0 0 0) (xyz 1 0 0)) (list (xyz 0 1 0) (xyz 1 1 1)))))", "x3d" },
  { "(draw (hull (make-sphere (xyz 0 0 0) 1) (make-box (xyz 2 2 2) (xyz 3 3 3))))", "stl" },
  { "(draw (make-cone (xyz 0 0 0) (xyz 0 0 2) 1) (make-cut-cone (xyz 3 0 0) 1 (xyz 3 0 2) 0.5) (make-torus (xyz 9 0 0) 2 0.5) (make-pyramid (xyz 0 5 0) 1 5 (xyz 0 5 3))"
    " (make-wedge (xyz 0 9 0) (xyz 1 11 2)) (make-superellipsoid 0.5 0.5 1) (make-e-cone (xyz 5 5 0) 1 2 (xyz 5 5 3) 0.5))", "openscad" },
  { "(draw (make-polyface-mesh (list (xyz 0 0 0) (xyz 1 0 0) (xyz 0 1 0) (xyz 0 0 1)) '((1 3 2) (1 2 4) (2 3 4) (1 4 3))))"
    "(draw (make-3dface (xyz 0 0 0) (xyz 1 0 0) (xyz 1 1 0) (xyz 0 1 0)) (make-arc (xyz 0 0 0) 1 0 2) (make-donut (xyz 9 9 0) 1 2) (make-ellipse (xyz 0 0 0) 1 2) (make-rectangle (xyz 0 0 0) (xyz 1 1 0)))",
    "povray" },
  { "(define o (intersect (make-box (xyz 0 0 0) (xyz 2 2 2)) (make-sphere (xyz 1 1 1) 1.2))) (list (volume o) (area o) (centroid o) (bounding-box o) (object-count o) (contains? o (xyz 1 1 1)))"
    "(object-children o) (object-arguments o) (equal? o o)", NULL },
  { "(draw (do-slice (do-mirror (do-scale (do-rotate (make-box (xyz 0 0 0) (xyz 1 2 3)) 'z 0.5) 2) 'yz) 'xy)) (camera (xyz 9 9 9) (xyz 0 0 0)) (sun #:azimuth 120 #:altitude 40)", "povray" },
  { "(draw (make-height-field \"heights.exr\" (xy 0 0) (xy 4 4) #:low 0 #:high 1))", "stl" },
  { "(draw (make-height-field \"heights.png\" (xy 0 0) (xy 4 4) #:low 0 #:high 1))", "stl" },
  { "(draw (do-extrude (make-text (xyz 0 0 0) 1 \"ab\") 1))", "stl" },
  { "(draw (do-offset (make-rectangle (xyz 0 0 0) (xyz 2 1 0)) 0.2)) (draw (subtract (make-rectangle (xyz 0 0 0) (xyz 2 1 0)) (make-circle (xyz 1 0.5 0) 0.2)))", "tree" },
  { "(draw (do-extrude (unite (make-rectangle (xyz 0 0 0) (xyz 4 2 0)) (make-rectangle (xyz 1 1 0) (xyz 3 6 0)) (make-circle (xyz 4 4 0) 1.5)) 1))", "stl" },
  { "(draw (intersect (make-rectangle (xyz 0 0 0) (xyz 4 2 0)) (make-circle (xyz 2 1 0) 1.5)) (do-section (unite (make-sphere (xyz 0 0 0) 1) (make-sphere (xyz 1 0 0) 1)) 'xy))", "povray" },
  { "(draw (do-thicken (make-line (list (xyz 0 0 0) (xyz 3 0 0) (xyz 3 3 0))) 0.3))", "stl" },
};
enum { PROGRAMS = sizeof programs / sizeof *programs };
enum { HEAP, HOST_ONCE, HOST_GOOD, LIBRARY_ONCE, LIBRARY_GOOD, WAYS };

static const char *const way_names[] = { "an object of the heap", "a request of the host once", "the host for good", "a request of the C library once", "the C library for good" };

/* Runs the program. *sum: a checksum of its output, which a refusal must not change. */
static vs_outcome perform(vs_scheme *s, const program *p, uint64_t *sum) {
  *sum = UINT64_C(0xCBF29CE484222325);
  vs_drawing_clear(s);
  vs_outcome outcome = vs_eval_text(s, "program", 1, p->text, strlen(p->text), VS_EVAL_PRINT);
  vs_summary summary;
  if (outcome != VS_OUTCOME_DONE || !p->format) return outcome;
  outcome = vs_drawing_summary(s, &summary);
  return outcome == VS_OUTCOME_DONE ? vs_write_drawing_to(s, p->format, NULL, sum_bytes, sum) : outcome;
}

/* How a program ends without a refusal. sum: checksum of its output. said: its last message. */
typedef struct { vs_outcome outcome; uint64_t sum; char said[200]; } ending;

static void refuse_in(vs_scheme *s, account *b, size_t which, int way, const ending *w) {
  vs_outcome wanted = w->outcome;
  uint64_t wanted_sum = w->sum;
  uint64_t sum;
  const program *p = &programs[which];
  long most = which % 4 == 0 ? 40 : 12; /* refuses each of the first `most` requests, then a smaller and smaller
                                         * fraction of the later requests */
  for (long n = 0;; n += n < most ? 1 : 1 + n / 5) {
    b->said[0] = 0;
    int before = b->told;
    host = (refusal){ n, way == HOST_ONCE || way == HOST_GOOD, way == HOST_GOOD, false };
    library = (refusal){ n, way == LIBRARY_ONCE || way == LIBRARY_GOOD, way == LIBRARY_GOOD, false };
    if (way == HEAP) vs_gc_fail_after(s, (size_t)n + 1);
    vs_outcome outcome = perform(s, p, &sum);
    bool refused = host.refused || library.refused || (way == HEAP && s->fail_after == 0);
    host.on = library.on = false;
    vs_gc_fail_after(s, 0);
    if (outcome != wanted && outcome != VS_OUTCOME_MACHINE) fail_msg("%s\n  refused %s, number %ld: ended with %d: %s", p->text, way_names[way], n, (int)outcome, b->said);
    if (outcome == VS_OUTCOME_MODEL && strcmp(b->said, w->said) != 0) fail_msg("%s\n  refused %s, number %ld: told as the model's: %s", p->text, way_names[way], n, b->said);
    if (outcome == wanted && sum != wanted_sum && p->format) fail_msg("%s\n  refused %s, number %ld: something else was written", p->text, way_names[way], n);
    if (outcome == VS_OUTCOME_MACHINE && b->told == before && !(refused && way == HOST_GOOD)) fail_msg("%s\n  refused %s, number %ld: nothing was said", p->text, way_names[way], n);
    if (!refused) {
      if (outcome != wanted) fail_msg("%s\n  nothing refused (%ld): ended with %d: %s", p->text, n, (int)outcome, b->said);
      break;
    }
  }
  if (vs_eval_text(s, "after", 1, "(define after (+ 1 2))", 22, 0) != VS_OUTCOME_DONE) fail_msg("after %s: %s", p->text, b->said);
}

static void test_programs(void **state) {
  (void)state;
  for (size_t i = 0; i < PROGRAMS; i++) {
    account b = { 0 };
    vs_options o = vs_options_default();
    o.alloc = take, o.alloc_context = &b;
    o.host.context = &b, o.host.diagnose = told, o.host.output = drop;
    o.host.value = NULL;
    vs_scheme *s = vs_new(&o);
    assert_non_null(s);
    ending plain = { 0 };
    /* Runs the program without a refusal first: this also loads libraries that are loaded at first use. */
    vs_outcome wanted = plain.outcome = perform(s, &programs[i], &plain.sum);
    if (wanted == VS_OUTCOME_MACHINE || wanted == VS_OUTCOME_USAGE) fail_msg("%s: %s", programs[i].text, b.said);
    if (wanted == VS_OUTCOME_MODEL && programs[i].format) fail_msg("%s: %s", programs[i].text, b.said);
    snprintf(plain.said, sizeof plain.said, "%s", b.said);
    for (int way = 0; way < (REPLACED ? WAYS : LIBRARY_ONCE); way++) refuse_in(s, &b, i, way, &plain);
    if (getenv("REFUSALS_TIMES")) print_message("%5.1f s %.60s %s\n", (double)clock() / CLOCKS_PER_SEC, programs[i].text, programs[i].format ? programs[i].format : "");
    assert_true(vs_gc_check(s));
    vs_free(s);
    if (b.live || b.blocks) fail_msg("%s: %zu bytes in %ld blocks were not given back", programs[i].text, b.live, b.blocks);
  }
}

/* Tests refusals while an interpreter is opened, a text is checked for completeness, names are completed, and
 * parameters are set. */
static void test_around(void **state) {
  (void)state;
  for (int good = 0; good < 2; good++)
    for (long n = 0;; n++) {
      account b = { 0 };
      vs_options o = vs_options_default();
      o.alloc = take, o.alloc_context = &b, o.library_path = "a:b";
      o.host.context = &b, o.host.diagnose = told;
      host = (refusal){ n, true, good == 1, false };
      vs_scheme *s = vs_new(&o);
      if (s) {
        vs_read_check(s, "(let ((x 1)) \"abc", 17);
        vs_complete(s, "make-", each_name, NULL);
        vs_parameter_set(s, "n", "4");
        vs_eval_text(s, "text", 1, "(define-parameter n 3)", 22, 0);
        vs_parameter_info info;
        if (vs_parameter_count(s)) vs_parameter_get(s, 0, &info);
        host.on = false;
        assert_int_equal(vs_eval_text(s, "text", 1, "(define x 1)", 12, 0), VS_OUTCOME_DONE);
      }
      host.on = false;
      vs_free(s);
      assert_int_equal(b.live, 0);
      assert_int_equal(b.blocks, 0);
      if (!host.refused) break;
    }
}

static void *aside(void *context, void *old, size_t old_size, size_t new_size) {
  (void)context, (void)old_size;
  if (new_size) return realloc(old, new_size);
  return free(old), NULL;
}

static bool keep(const char *name, const unsigned char *bytes, size_t size) {
  FILE *f = fopen(name, "wb");
  bool ok = f && fwrite(bytes, 1, size, f) == size;
  return (!f || fclose(f) == 0) && ok;
}

/* Makes picture files for height fields, with several chunks of compressed data, in a new folder that becomes the
 * current folder. */
static int make_pictures(void **state) {
  static char folder[] = "/tmp/refusals-XXXXXX";
  (void)state;
  if (!mkdtemp(folder) || chdir(folder) != 0) return 1;
  enum { SIDE = 40 };
  vs_error e = { 0 };
  vs_store *store = vs_store_new(aside, NULL);
  vs_exr x = { .store = store, .columns = SIDE, .rows = SIDE };
  unsigned char rgb[SIDE * SIDE * 3];
  vs_made_bytes file = { NULL, 0, 0 };
  float *at = vs_exr_add(&x, "Y", VS_EXR_FLOAT, &e);
  for (size_t i = 0; at && i < SIDE * SIDE; i++) at[i] = (float)(i % 37) / 37, memset(rgb + 3 * i, (int)(i % 37) * 7, 3);
  bool ok = at && vs_exr_write(&x, &file, &e) && keep("heights.exr", file.at, file.size);
  if (ok) vs_store_realloc(store, file.at, file.room, 0);
  vs_pixels pixels = { rgb, SIDE, SIDE };
  ok = ok && vs_png_write(store, &pixels, &file, &e) && keep("heights.png", file.at, file.size);
  if (ok) vs_store_realloc(store, file.at, file.room, 0);
  vs_exr_free(&x);
  vs_store_release(store);
  return !ok;
}
static int remove_pictures(void **state) {
  char folder[200];
  (void)state;
  remove("heights.exr");
  remove("heights.png");
  return !getcwd(folder, sizeof folder) || rmdir(folder) != 0;
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_programs), cmocka_unit_test(test_around) };
  return cmocka_run_group_tests_name("refusals", tests, make_pictures, remove_pictures);
}
