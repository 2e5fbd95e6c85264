#ifndef PROOF_BENCHES_H
#define PROOF_BENCHES_H

#include "hybrid.h"

extern const bench servo, screw, bldc, device, actuator;

#endif
