/* Owns the switches that make bugs show: set them with -D when building (make EXTRA=-DVS_DEBUG_STRESS=1). */
#ifndef VS_VM_VALUES_DEBUG_H
#define VS_VM_VALUES_DEBUG_H

#ifndef VS_DEBUG_STRESS        /* 1 = collect the nursery at every allocation (fewer while the stack is very deep), and
                                  the whole heap, with a check of it, once for so many (gc.c); what is freed is
                                  overwritten; 0 = off */
#define VS_DEBUG_STRESS 0
#endif
#ifndef VS_DEBUG_CHECK         /* walk and check the whole heap after every collection */
#define VS_DEBUG_CHECK 0
#endif
#ifndef VS_DEBUG_TRACE         /* print every instruction to stderr as it runs */
#define VS_DEBUG_TRACE 0
#endif
#ifndef VS_DEBUG_DUMP          /* print the code of every procedure as it is compiled */
#define VS_DEBUG_DUMP 0
#endif
#ifndef VS_DEBUG_SMALL         /* tiny nursery and stack, to cross their edges all the time */
#define VS_DEBUG_SMALL 0
#endif

/* The sixth, failing the n-th allocation, is at run time: vm->fail_after counts allocations down to a refusal; 0 =
   off. */
#endif
