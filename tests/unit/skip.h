/* Prints the line by which a unit test reports that it cannot run, and why; tests/run.sh reads this line. Include it
 * after cmocka's header. */
#ifndef VS_TESTS_SKIP_H
#define VS_TESTS_SKIP_H

#include <stdio.h>

#define SKIP_TEST(why) (printf("skip %s\n", why), skip())

#endif
