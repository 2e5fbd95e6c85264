/* Benches.FrictionDevice with everything that can be left out of it. Inputs x (m), v (m/s). Output F (N). */
#include "benches.h"
#include "physics.h"

#define PARAMETERS(X) X(c) FRICTION(X, device) X(k_s) X(x_0) X(F_0) X(law_v3) X(law_sqrt)

typedef struct {
#define FIELD(name) double name;
  PARAMETERS(FIELD)
} parameters;

enum { Z, UNUSED, STATES };

static double force(const parameters *q, const double *in, double z, double *dz) {
  double x = in[0], v = in[1];
  const friction *f = (const friction *)&q->device_tau_c;
  double F = q->c * v + q->k_s * (x - q->x_0) + q->F_0 + q->law_v3 * v * v * v;
  if (q->law_sqrt != 0) F += q->law_sqrt * sign_of(v) * sqrt(fabs(v));
  int mode = f->tau_c == 0 && f->tau_e == 0 ? FREE : (int)sign_of(v);
  return F + friction_torque(f, mode, v, 0, 0, x, z, dz);
}

static void start(const double *p, const double *in, const double *x, int *mode) {
  (void)p, (void)in, (void)x, (void)mode;
}

static void derivative(const double *p, const int *mode, double t, const double *in, const double *x, double *dx) {
  (void)mode, (void)t;
  dx[UNUSED] = 0;
  force((const parameters *)p, in, x[Z], &dx[Z]);
}

static void guard(const double *p, const int *mode, double t, const double *in, const double *x, double *g) {
  (void)p, (void)mode, (void)t, (void)in, (void)x, (void)g;
}

static void change(const double *p, const double *g, double t, const double *in, double *x, int *mode) {
  (void)p, (void)g, (void)t, (void)in, (void)x, (void)mode;
}

static void output(const double *p, const int *mode, double t, const double *in, const double *x, double *y) {
  double unused;
  (void)mode, (void)t;
  y[0] = force((const parameters *)p, in, x[Z], &unused);
}

#define NAME(name) #name " "
const bench device = {PARAMETERS(NAME), STATES, 0, 0, 1, start, derivative, guard, change, output};
