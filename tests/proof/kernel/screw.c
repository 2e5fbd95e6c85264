/* Benches.ScrewEma with everything that can be left out of it.
   Inputs theta_cmd (rad), T_aero (N.m). Outputs u, i, thm, ths. */
#include "benches.h"
#include "physics.h"

/* clang-format off */
#define PARAMETERS(X)                                                                                             \
    X(R) X(L) X(Ke) X(Jm) X(bm) X(N) X(k) X(d) X(Js) X(bs) X(Vdc) X(Kp) X(wmax) X(Kw) X(Ki) FRICTION(X, shaft)    \
    FRICTION(X, surface) X(play) X(k_s) X(tau_l) X(mgl) X(mgl_phi) X(cog_a) X(cog_n) X(cog_phi) X(rip_a)          \
    X(rip_n) X(rip_phi) X(stop_high) X(stop_low) X(k_e) X(d_e) X(V_d) X(sag) X(u_max) X(u_dead) X(heat_k)         \
    X(heat_tau) X(i_sat) X(law_w3) X(law_theta3) X(law_vib) X(law_vib_w) X(law_warm) X(law_warm_tau) X(law_sqrt)
/* clang-format on */

typedef struct {
#define FIELD(name) double name;
  PARAMETERS(FIELD)
} parameters;

enum { I, WM, WS, THM, THS, XI, ZM, ZS, HEAT, STATES };
enum { SHAFT, SURFACE, CONTACT, DROP, MODES };

static const friction *shaft(const parameters *q) {
  return (const friction *)&q->shaft_tau_c;
}
static const friction *surface(const parameters *q) {
  return (const friction *)&q->surface_tau_c;
}

static double transmitted(const parameters *q, const int *mode, const double *x) {
  double delta = x[THM] / q->N - x[THS], speed = x[WM] / q->N - x[WS];
  if (q->play == 0) return q->k * delta + q->d * speed;
  return contact_torque(mode[CONTACT], delta, speed, q->play, q->k, q->d);
}

/* Voltage that the controller asks for, and the derivative of its integrator. */
static double control(const parameters *q, const double *in, const double *x, double *dxi) {
  double reference = limit(q->Kp * q->N * (in[0] - x[THS]), q->wmax);
  double error = reference - x[WM], u = q->Kw * error + q->Ki * x[XI];
  int driven_on = (u > q->Vdc && error > 0) || (u < -q->Vdc && error < 0);
  *dxi = driven_on ? 0 : error;
  return limit(u, q->Vdc);
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
  double unused, u = drive(q, control(q, in, x, &unused), i);
  return u - q->R * (1 + x[HEAT]) * i - q->Ke * flux(q, i) * x[WM];
}

static double motor_side(const parameters *q, double ts, double t, double w, const double *x) {
  double motor = q->Ke * flux(q, x[I]) * x[I], angle = x[THM];
  if (q->rip_a != 0) motor *= 1 + q->rip_a * sin(q->rip_n * angle + q->rip_phi);
  double load = q->bm * w + ts / q->N;
  if (q->cog_a != 0) load += q->cog_a * sin(q->cog_n * angle + q->cog_phi);
  if (q->law_w3 != 0) load += q->law_w3 * w * w * w;
  if (q->law_warm != 0) load += q->law_warm * w * exp(-t / q->law_warm_tau);
  if (q->law_sqrt != 0) load += q->law_sqrt * sign_of(w) * sqrt(fabs(w));
  return motor - load;
}

static double surface_side(const parameters *q, double ts, double t, double w, const double *in, const double *x) {
  double angle = x[THS];
  double load = q->bs * w + in[1] + q->k_s * angle + q->tau_l +
                stop_torque(x[THS], x[WS], q->stop_low, q->stop_high, q->k_e, q->d_e);
  if (q->mgl != 0) load += q->mgl * sin(angle + q->mgl_phi);
  if (q->law_theta3 != 0) load += q->law_theta3 * angle * angle * angle;
  if (q->law_vib != 0) load += q->law_vib * sin(q->law_vib_w * t);
  return ts - load;
}

static void start(const double *p, const double *in, const double *x, int *mode) {
  const parameters *q = (const parameters *)p;
  (void)in, (void)x;
  mode[SHAFT] = friction_start(shaft(q));
  mode[SURFACE] = friction_start(surface(q));
  mode[CONTACT] = 0;
  friction d = drop(q);
  mode[DROP] = friction_start(&d);
}

static void derivative(const double *p, const int *mode, double t, const double *in, const double *x, double *dx) {
  const parameters *q = (const parameters *)p;
  double ts = transmitted(q, mode, x);
  double v = winding_voltage(q, in, x[I], x), unused;
  friction d = drop(q);
  double on_motor = motor_side(q, ts, t, x[WM], x), on_surface = surface_side(q, ts, t, x[WS], in, x);
  control(q, in, x, &dx[XI]);
  dx[I] = (v - friction_torque(&d, mode[DROP], x[I], v, 0, 0, 0, &unused)) / q->L;
  dx[WM] =
      (on_motor - friction_torque(shaft(q), mode[SHAFT], x[WM], on_motor, ts / q->N, x[THM], x[ZM], &dx[ZM])) / q->Jm;
  dx[WS] =
      (on_surface - friction_torque(surface(q), mode[SURFACE], x[WS], on_surface, ts, x[THS], x[ZS], &dx[ZS])) / q->Js;
  dx[THM] = x[WM];
  dx[THS] = x[WS];
  dx[HEAT] = q->heat_tau > 0 ? (q->heat_k * q->R * (1 + x[HEAT]) * x[I] * x[I] - x[HEAT]) / q->heat_tau : 0;
}

static void guard(const double *p, const int *mode, double t, const double *in, const double *x, double *g) {
  const parameters *q = (const parameters *)p;
  double ts = transmitted(q, mode, x);
  double on_motor = motor_side(q, ts, t, 0, x), on_surface = surface_side(q, ts, t, 0, in, x);
  friction d = drop(q);
  g[DROP] = friction_guard(&d, mode[DROP], x[I], winding_voltage(q, in, 0, x), 0, 0);
  g[SHAFT] = friction_guard(shaft(q), mode[SHAFT], x[WM], on_motor, ts / q->N, x[THM]);
  g[SURFACE] = friction_guard(surface(q), mode[SURFACE], x[WS], on_surface, ts, x[THS]);
  g[CONTACT] = contact_guard(mode[CONTACT], x[THM] / q->N - x[THS], q->play);
}

static void change(const double *p, const double *g, double t, const double *in, double *x, int *mode) {
  const parameters *q = (const parameters *)p;
  if (g[CONTACT] < 0) mode[CONTACT] = mode[CONTACT] == 0 ? (int)sign_of(x[THM] / q->N - x[THS]) : 0;
  if (g[DROP] < 0) {
    friction d = drop(q);
    x[I] = 0;
    mode[DROP] = friction_change(&d, winding_voltage(q, in, 0, x), 0, 0);
  }
  if (g[SHAFT] < 0) x[WM] = 0;
  if (g[SURFACE] < 0) x[WS] = 0;
  double ts = transmitted(q, mode, x);
  if (g[SHAFT] < 0) mode[SHAFT] = friction_change(shaft(q), motor_side(q, ts, t, 0, x), ts / q->N, x[THM]);
  if (g[SURFACE] < 0) mode[SURFACE] = friction_change(surface(q), surface_side(q, ts, t, 0, in, x), ts, x[THS]);
}

static void output(const double *p, const int *mode, double t, const double *in, const double *x, double *y) {
  const parameters *q = (const parameters *)p;
  double unused;
  (void)mode, (void)t;
  y[0] = control(q, in, x, &unused);
  y[1] = x[I];
  y[2] = x[THM];
  y[3] = x[THS];
}

#define NAME(name) #name " "
const bench screw = {PARAMETERS(NAME), STATES, MODES, MODES, 4, start, derivative, guard, change, output};
