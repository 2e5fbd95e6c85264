/* Vectors for IDA, see vector.c. */
#ifndef RT_VECTOR_H
#define RT_VECTOR_H

#include "sundials_compat.h"

/* n zeros; NULL without memory. Clones of it have the same operations. */
N_Vector rt_vector_new(long n, SUNContext context);

#endif
