/* Counts the allocations of the test program and of the static libraries linked into it: operator new, and malloc,
 * calloc and realloc by the linker's --wrap. */
#ifndef MALLOC_TRAP_H
#define MALLOC_TRAP_H

/* Allocations so far, by any thread. */
long allocations();

#endif
