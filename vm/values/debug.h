/* Declares build switches that help to find bugs. They are set by -D (make EXTRA=-DVS_DEBUG_STRESS=1). */
#ifndef VS_VM_VALUES_DEBUG_H
#define VS_VM_VALUES_DEBUG_H

#ifndef VS_DEBUG_STRESS        /* 1: collects the nursery at every allocation (less often while the stack is very deep),
                                * sometimes collects and checks the whole heap (gc.c), and overwrites freed memory; 0:
                                * off */
#define VS_DEBUG_STRESS 0
#endif
#ifndef VS_DEBUG_CHECK         /* 1: checks the whole heap after every collection */
#define VS_DEBUG_CHECK 0
#endif
#ifndef VS_DEBUG_TRACE         /* 1: prints every instruction to stderr when it runs */
#define VS_DEBUG_TRACE 0
#endif
#ifndef VS_DEBUG_DUMP          /* 1: prints the code of every procedure when it is compiled */
#define VS_DEBUG_DUMP 0
#endif
#ifndef VS_DEBUG_SMALL         /* 1: the nursery and the stack are so small that programs often exceed them */
#define VS_DEBUG_SMALL 0
#endif

/* Another switch is set at run time. vm->fail_after: number of allocations until one fails, or 0. */
#endif
