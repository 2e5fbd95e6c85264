/* The paper's actuator written out by hand, apart from the model language, the code generator and the runtime:
 * classical Runge-Kutta of fixed step whose events are located inside the step. The tests compare the
 * analysis chain, and the generated model, with it. */
#ifndef REFERENCE_ACTUATOR_H
#define REFERENCE_ACTUATOR_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double V;     /* V, supply */
  double R, L;  /* ohm, H, per phase */
  double Ke;    /* V.s/rad, peak, per phase */
  double pp;    /* pole pairs */
  double J, d;  /* kg.m2, N.m.s/rad */
  double tau_c; /* N.m, dry friction */
  double f_cut; /* Hz, corner of each low-pass section */
  double zeta;  /* relative static eccentricity, 0..1 */
} reference_parameters;

/* The consistent parameter set, healthy rotor. */
reference_parameters reference_defaults(void);

/* Simulate from standstill at the angle where phase a's back-EMF crosses zero rising. Row k of `out`, at time
 * k*step, holds the filtered currents a, b, c (A), the rotor speed (rad/s) and its angle (rad).
 * Returns the number of located events, or -1 where an event cannot be located. */
int reference_simulate(const reference_parameters *p, double step, int rows, double (*out)[5]);

#ifdef __cplusplus
}
#endif
#endif
