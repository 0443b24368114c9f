/* Owns the build switches that expose bugs: set them with -D (make EXTRA=-DVS_DEBUG_STRESS=1). */
#ifndef VS_VM_VALUES_DEBUG_H
#define VS_VM_VALUES_DEBUG_H

#ifndef VS_DEBUG_STRESS        /* 1: collects the nursery at every allocation (less often while the stack is very deep),
                                * and now and then the whole heap, with a check of it (gc.c); overwrites freed memory;
                                * 0: off */
#define VS_DEBUG_STRESS 0
#endif
#ifndef VS_DEBUG_CHECK         /* checks the whole heap after every collection */
#define VS_DEBUG_CHECK 0
#endif
#ifndef VS_DEBUG_TRACE         /* prints every instruction to stderr as it runs */
#define VS_DEBUG_TRACE 0
#endif
#ifndef VS_DEBUG_DUMP          /* prints the code of every procedure when it is compiled */
#define VS_DEBUG_DUMP 0
#endif
#ifndef VS_DEBUG_SMALL         /* tiny nursery and stack, so that programs often exceed them */
#define VS_DEBUG_SMALL 0
#endif

/* A sixth switch is set at run time: vm->fail_after counts allocations down to one that is refused; 0: off. */
#endif
