/* Benches.DcServo and Benches.Joint with everything that can be left out of them.
   Input u (V), or the torque (N.m) when `torque_input` is 1. Outputs i, w, theta. */
#include "benches.h"
#include "physics.h"

/* clang-format off */
#define PARAMETERS(X)                                                                                          \
    X(R) X(L) X(Ke) X(J) X(b) X(torque_input) FRICTION(X, shaft) X(k_s) X(theta_0) X(tau_l) X(mgl) X(mgl_phi)  \
    X(cog_a) X(cog_n) X(cog_phi) X(rip_a) X(rip_n) X(rip_phi) X(J_share) X(k_c) X(d_c) X(play) X(stop_high)    \
    X(stop_low) X(k_e) X(d_e) X(V_d) X(sag) X(u_max) X(u_dead) X(heat_k) X(heat_tau) X(i_sat) X(law_w3)        \
    X(law_theta3) X(law_wsin) X(law_vib) X(law_vib_w) X(law_warm) X(law_warm_tau) X(law_sqrt) X(law_iw)
/* clang-format on */

typedef struct {
#define FIELD(name) double name;
  PARAMETERS(FIELD)
} parameters;

enum { I, W, THETA, W_LOAD, THETA_LOAD, Z, HEAT, STATES };
enum { SHAFT, CONTACT, DROP, MODES };

static const friction *shaft(const parameters *q) {
  return (const friction *)&q->shaft_tau_c;
}

static double coupling_torque(const parameters *q, const int *mode, const double *x) {
  double delta = x[THETA] - x[THETA_LOAD], speed = x[W] - x[W_LOAD];
  if (q->J_share == 0) return 0;
  if (q->play == 0) return q->k_c * delta + q->d_c * speed;
  return contact_torque(mode[CONTACT], delta, speed, q->play, q->k_c, q->d_c);
}

static double drive(const parameters *q, double u, double i) {
  if (fabs(u) <= q->u_dead) u = 0;
  if (q->u_max > 0) u = limit(u, q->u_max);
  if (q->sag > 0) u *= fmax(0, 1 - q->sag * fabs(i));
  return u;
}

static double flux(const parameters *q, double i) {
  return q->i_sat > 0 ? 1 / (1 + (i / q->i_sat) * (i / q->i_sat)) : 1;
}

/* The dead time's voltage acts on the current as dry friction on a speed. */
static friction drop(const parameters *q) {
  return (friction){.tau_c = q->V_d};
}

static double winding_voltage(const parameters *q, const double *in, double i, const double *x) {
  return drive(q, in[0], i) - q->R * (1 + x[HEAT]) * i - q->Ke * flux(q, i) * x[W];
}

/* Torque on the motor side but for its dry friction: what acts on the rotor at speed w. */
static double rotor_torque(const parameters *q, const int *mode, double t, const double *in, const double *x) {
  double w = x[W], angle = x[THETA];
  double motor = q->torque_input > 0 ? drive(q, in[0], 0) : q->Ke * flux(q, x[I]) * x[I];
  if (q->rip_a != 0) motor *= 1 + q->rip_a * sin(q->rip_n * angle + q->rip_phi);
  double load = q->b * w + q->k_s * (angle - q->theta_0) + q->tau_l +
                stop_torque(x[THETA], x[W], q->stop_low, q->stop_high, q->k_e, q->d_e) + coupling_torque(q, mode, x);
  if (q->mgl != 0) load += q->mgl * sin(angle + q->mgl_phi);
  if (q->cog_a != 0) load += q->cog_a * sin(q->cog_n * angle + q->cog_phi);
  if (q->law_w3 != 0) load += q->law_w3 * w * w * w;
  if (q->law_theta3 != 0) load += q->law_theta3 * angle * angle * angle;
  if (q->law_wsin != 0) load += q->law_wsin * w * (1 + sin(angle));
  if (q->law_vib != 0) load += q->law_vib * sin(q->law_vib_w * t);
  if (q->law_warm != 0) load += q->law_warm * w * exp(-t / q->law_warm_tau);
  if (q->law_sqrt != 0) load += q->law_sqrt * sign_of(w) * sqrt(fabs(w));
  if (q->law_iw != 0) load += q->law_iw * x[I] * fabs(w);
  return motor - load;
}

static double rest_torque(const parameters *q, const int *mode, double t, const double *in, const double *x) {
  double at_rest[STATES];
  for (int j = 0; j < STATES; j++)
    at_rest[j] = x[j];
  at_rest[W] = 0;
  return rotor_torque(q, mode, t, in, at_rest);
}

static void start(const double *p, const double *in, const double *x, int *mode) {
  const parameters *q = (const parameters *)p;
  (void)in, (void)x;
  mode[SHAFT] = friction_start(shaft(q));
  mode[CONTACT] = 0;
  friction d = drop(q);
  mode[DROP] = friction_start(&d);
}

static void derivative(const double *p, const int *mode, double t, const double *in, const double *x, double *dx) {
  const parameters *q = (const parameters *)p;
  double torque = rotor_torque(q, mode, t, in, x);
  double held = mode[SHAFT] == STUCK ? torque : 0;
  double lost = friction_torque(shaft(q), mode[SHAFT], x[W], held, 0, x[THETA], x[Z], &dx[Z]);
  double v = winding_voltage(q, in, x[I], x), unused;
  friction d = drop(q);
  double dropped = friction_torque(&d, mode[DROP], x[I], v, 0, 0, 0, &unused);
  dx[I] = q->torque_input > 0 ? 0 : (v - dropped) / q->L;
  dx[W] = (torque - lost) / (q->J * (1 - q->J_share));
  dx[THETA] = x[W];
  dx[W_LOAD] = q->J_share > 0 ? coupling_torque(q, mode, x) / (q->J * q->J_share) : 0;
  dx[THETA_LOAD] = x[W_LOAD];
  dx[HEAT] = q->heat_tau > 0 ? (q->heat_k * q->R * (1 + x[HEAT]) * x[I] * x[I] - x[HEAT]) / q->heat_tau : 0;
}

static void guard(const double *p, const int *mode, double t, const double *in, const double *x, double *g) {
  const parameters *q = (const parameters *)p;
  double held = mode[SHAFT] == STUCK ? rest_torque(q, mode, t, in, x) : 0;
  friction d = drop(q);
  g[DROP] = friction_guard(&d, mode[DROP], x[I], winding_voltage(q, in, 0, x), 0, 0);
  g[SHAFT] = friction_guard(shaft(q), mode[SHAFT], x[W], held, 0, x[THETA]);
  g[CONTACT] = contact_guard(mode[CONTACT], x[THETA] - x[THETA_LOAD], q->play);
}

static void change(const double *p, const double *g, double t, const double *in, double *x, int *mode) {
  const parameters *q = (const parameters *)p;
  if (g[CONTACT] < 0) mode[CONTACT] = mode[CONTACT] == 0 ? (int)sign_of(x[THETA] - x[THETA_LOAD]) : 0;
  if (g[DROP] < 0) {
    friction d = drop(q);
    x[I] = 0;
    mode[DROP] = friction_change(&d, winding_voltage(q, in, 0, x), 0, 0);
  }
  if (g[SHAFT] < 0) {
    x[W] = 0;
    mode[SHAFT] = friction_change(shaft(q), rest_torque(q, mode, t, in, x), 0, x[THETA]);
  }
}

static void output(const double *p, const int *mode, double t, const double *in, const double *x, double *y) {
  (void)p, (void)mode, (void)t, (void)in;
  y[0] = x[I];
  y[1] = x[W];
  y[2] = x[THETA];
}

#define NAME(name) #name " "
const bench servo = {PARAMETERS(NAME), STATES, MODES, MODES, 3, start, derivative, guard, change, output};
