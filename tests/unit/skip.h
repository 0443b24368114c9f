/* Owns how a unit test says why it cannot run here: tests/run.sh reads the line. After cmocka's header. */
#ifndef VS_TESTS_SKIP_H
#define VS_TESTS_SKIP_H

#include <stdio.h>

#define SKIP_TEST(why) (printf("skip %s\n", why), skip())

#endif
