/* Sets REPLACED to 1 if a test program may replace the C library's malloc, calloc, realloc and free: the library must
 * be glibc, and no sanitizer may have replaced these functions. A replacement calls the __libc_ functions declared
 * below. */
#ifndef VS_TEST_ALLOCATOR_H
#define VS_TEST_ALLOCATOR_H

#include <stddef.h>

#if defined(__SANITIZE_ADDRESS__)
#define REPLACED 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define REPLACED 0
#endif
#endif
#if !defined(REPLACED) && defined(__GLIBC__)
#define REPLACED 1
#elif !defined(REPLACED)
#define REPLACED 0
#endif

#if REPLACED
void *__libc_malloc(size_t n);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t n);
void __libc_free(void *p);
#endif

#endif
