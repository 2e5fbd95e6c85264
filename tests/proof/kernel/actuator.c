/* Benches.FlightControl with everything that can be left out of it.
   Inputs theta_cmd (rad), T_aero (N.m). Outputs ia, ib, ic, thm, ths. */
#include "benches.h"
#include "three_phase.h"

/* clang-format off */
#define PARAMETERS(X)                                                                                           \
    X(R) X(L) X(Ke) X(pp) X(Jm) X(bm) X(N) X(k) X(d) X(Js) X(bs) X(Vdc) X(Kp) X(wmax) X(Kw) X(Ki) X(i_max)      \
    X(Kp_i) X(Ki_i) FRICTION(X, shaft) FRICTION(X, surface) X(Ra) X(Rb) X(Rc) X(short_a) X(short_b) X(short_c)  \
    X(zeta) X(V_d) X(u_max) X(play) X(k_s) X(tau_l) X(cog_a) X(cog_n) X(cog_phi) X(rip_a) X(rip_n) X(rip_phi)   \
    X(stop_high) X(stop_low) X(k_e) X(d_e)
/* clang-format on */

typedef struct {
#define FIELD(name) double name;
  PARAMETERS(FIELD)
} parameters;

enum { IA, IB, IC, WM, WS, THM, THS, X_SPEED, X_CURRENT, ZM, ZS, STATES };
enum { SHAFT, SURFACE, CONTACT, SECTOR, FLOATING, MODES };
enum { G_SHAFT, G_SURFACE, G_CONTACT, G_SECTOR_LOW, G_SECTOR_HIGH, G_FLOATING, GUARDS };
enum { I_WIDTH_MA = 10 };

static const friction *shaft(const parameters *q) {
  return (const friction *)&q->shaft_tau_c;
}
static const friction *surface(const parameters *q) {
  return (const friction *)&q->surface_tau_c;
}

/* A proportional-integral law with its output limited; the integral is held at the limit. */
static double regulate(double gain, double rate, double error, double integral, double bound, double *slope) {
  double free = gain * error + integral;
  int driven_on = (free > bound && error > 0) || (free < -bound && error < 0);
  *slope = driven_on ? 0 : rate * error;
  return limit(free, bound);
}

/* Voltage across the driven pair, with the slopes of the two integrals. */
static double control(const parameters *q, const int *mode, const double *in, const double *x, double *dx) {
  double w_ref = limit(q->Kp * q->N * (in[0] - x[THS]), q->wmax);
  double i_ref = regulate(q->Kw, q->Ki, w_ref - x[WM], x[X_SPEED], q->i_max, &dx[X_SPEED]);
  double i_pair = (x[HIGH_LEG[mode[SECTOR]]] - x[LOW_LEG[mode[SECTOR]]]) / 2;
  return regulate(q->Kp_i, q->Ki_i, i_ref - i_pair, x[X_CURRENT], q->Vdc, &dx[X_CURRENT]);
}

static machine legs(const parameters *q, const int *mode, const double *in, const double *x) {
  machine m = {.bus = q->Vdc};
  double unused[STATES];
  const double dR[3] = {q->Ra, q->Rb, q->Rc}, turns[3] = {1 - q->short_a, 1 - q->short_b, 1 - q->short_c};
  double electrical = q->pp * x[THM] / DEG, modulation = 1 + q->zeta * cos((electrical - 60) * DEG);
  double pair = control(q, mode, in, x, unused);
  if (q->u_max > 0) pair = limit(pair, q->u_max);
  int high = HIGH_LEG[mode[SECTOR]], low = LOW_LEG[mode[SECTOR]], floating = FLOAT_LEG[mode[SECTOR]];
  m.v[high] = (q->Vdc + pair) / 2;
  m.v[low] = (q->Vdc - pair) / 2;
  m.v[floating] = mode[FLOATING] == FROM_HIGH ? q->Vdc : 0;
  for (int n = 0; n < 3; n++) {
    m.R[n] = (q->R + dR[n]) * turns[n];
    m.L[n] = q->L * turns[n] * turns[n];
    m.k[n] = q->Ke * turns[n] * modulation * trapezoid(electrical - 120 * n);
    m.e[n] = m.k[n] * x[WM];
    m.on[n] = n != floating || mode[FLOATING] != OPEN;
    if (q->V_d > 0) m.v[n] -= q->V_d * soft_sign(x[n], I_WIDTH_MA * 1e-3);
  }
  return m;
}

static double transmitted(const parameters *q, const int *mode, const double *x) {
  double delta = x[THM] / q->N - x[THS], speed = x[WM] / q->N - x[WS];
  if (q->play == 0) return q->k * delta + q->d * speed;
  return contact_torque(mode[CONTACT], delta, speed, q->play, q->k, q->d);
}

static double motor_side(const parameters *q, const machine *m, double ts, double w, const double *x) {
  double motor = machine_torque(m, x), load = q->bm * w + ts / q->N;
  if (q->rip_a != 0) motor *= 1 + q->rip_a * sin(q->rip_n * x[THM] + q->rip_phi);
  if (q->cog_a != 0) load += q->cog_a * sin(q->cog_n * x[THM] + q->cog_phi);
  return motor - load;
}

static double surface_side(const parameters *q, double ts, double w, const double *in, const double *x) {
  double load = q->bs * w + in[1] + q->k_s * x[THS] + q->tau_l;
  return ts - load - stop_torque(x[THS], x[WS], q->stop_low, q->stop_high, q->k_e, q->d_e);
}

static void start(const double *p, const double *in, const double *x, int *mode) {
  const parameters *q = (const parameters *)p;
  (void)in;
  mode[SHAFT] = friction_start(shaft(q));
  mode[SURFACE] = friction_start(surface(q));
  mode[CONTACT] = 0;
  mode[SECTOR] = (int)sector_position(q->pp, x[THM]) % 6;
  mode[FLOATING] = OPEN;
}

static void derivative(const double *p, const int *mode, double t, const double *in, const double *x, double *dx) {
  const parameters *q = (const parameters *)p;
  (void)t;
  machine m = legs(q, mode, in, x);
  currents(&m, x, dx);
  control(q, mode, in, x, dx);
  double ts = transmitted(q, mode, x);
  double on_motor = motor_side(q, &m, ts, x[WM], x), on_surface = surface_side(q, ts, x[WS], in, x);
  dx[WM] =
      (on_motor - friction_torque(shaft(q), mode[SHAFT], x[WM], on_motor, ts / q->N, x[THM], x[ZM], &dx[ZM])) / q->Jm;
  dx[WS] =
      (on_surface - friction_torque(surface(q), mode[SURFACE], x[WS], on_surface, ts, x[THS], x[ZS], &dx[ZS])) / q->Js;
  dx[THM] = x[WM];
  dx[THS] = x[WS];
}

static void guard(const double *p, const int *mode, double t, const double *in, const double *x, double *g) {
  const parameters *q = (const parameters *)p;
  (void)t;
  machine m = legs(q, mode, in, x);
  double ts = transmitted(q, mode, x);
  g[G_SHAFT] = friction_guard(shaft(q), mode[SHAFT], x[WM], motor_side(q, &m, ts, 0, x), ts / q->N, x[THM]);
  g[G_SURFACE] = friction_guard(surface(q), mode[SURFACE], x[WS], surface_side(q, ts, 0, in, x), ts, x[THS]);
  g[G_CONTACT] = contact_guard(mode[CONTACT], x[THM] / q->N - x[THS], q->play);
  sector_guards(sector_position(q->pp, x[THM]), mode[SECTOR], g + G_SECTOR_LOW);
  g[G_FLOATING] = floating_guard(&m, mode[FLOATING], FLOAT_LEG[mode[SECTOR]], x, q->V_d);
}

static void change(const double *p, const double *g, double t, const double *in, double *x, int *mode) {
  const parameters *q = (const parameters *)p;
  (void)t;
  if (g[G_CONTACT] < 0) mode[CONTACT] = mode[CONTACT] == 0 ? (int)sign_of(x[THM] / q->N - x[THS]) : 0;
  if (g[G_SECTOR_LOW] < 0 || g[G_SECTOR_HIGH] < 0) mode[SECTOR] = (mode[SECTOR] + (g[G_SECTOR_HIGH] < 0 ? 1 : 5)) % 6;
  if (g[G_FLOATING] < 0 && mode[FLOATING] != OPEN) cut(x, FLOAT_LEG[mode[SECTOR]]);
  mode[FLOATING] = freewheeling(x[FLOAT_LEG[mode[SECTOR]]]);
  machine m = legs(q, mode, in, x);
  if (mode[FLOATING] == OPEN) mode[FLOATING] = open_leg(&m, FLOAT_LEG[mode[SECTOR]], x, q->V_d);
  if (g[G_SHAFT] < 0) x[WM] = 0;
  if (g[G_SURFACE] < 0) x[WS] = 0;
  double ts = transmitted(q, mode, x);
  m = legs(q, mode, in, x);
  if (g[G_SHAFT] < 0) mode[SHAFT] = friction_change(shaft(q), motor_side(q, &m, ts, 0, x), ts / q->N, x[THM]);
  if (g[G_SURFACE] < 0) mode[SURFACE] = friction_change(surface(q), surface_side(q, ts, 0, in, x), ts, x[THS]);
}

static void output(const double *p, const int *mode, double t, const double *in, const double *x, double *y) {
  (void)p, (void)mode, (void)t, (void)in;
  y[0] = x[IA];
  y[1] = x[IB];
  y[2] = x[IC];
  y[3] = x[THM];
  y[4] = x[THS];
}

#define NAME(name) #name " "
const bench actuator = {PARAMETERS(NAME), STATES, MODES, GUARDS, 5, start, derivative, guard, change, output};
