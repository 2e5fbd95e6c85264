/* Benches.BldcDrive with everything that can be left out of it.
   Inputs v_bus (V), dir (+1, -1, held). Outputs ia, ib, ic, theta, w. */
#include "benches.h"
#include "three_phase.h"

/* clang-format off */
#define PARAMETERS(X)                                                                                             \
    X(R) X(L) X(Ke) X(J) X(b) X(pp) FRICTION(X, shaft) X(Ra) X(Rb) X(Rc) X(La) X(Lb) X(Lc) X(short_a) X(short_b)  \
    X(short_c) X(zeta) X(V_d) X(sag) X(u_max) X(k_s) X(tau_l) X(mgl) X(mgl_phi) X(cog_a) X(cog_n) X(cog_phi)      \
    X(rip_a) X(rip_n) X(rip_phi) X(iron) X(i_sat) X(heat_k) X(heat_tau) X(law_w3) X(law_warm) X(law_warm_tau)     \
    X(law_sqrt)
/* clang-format on */

typedef struct {
#define FIELD(name) double name;
  PARAMETERS(FIELD)
} parameters;

enum { IA, IB, IC, W, THETA, Z, HEAT, STATES };
enum { SHAFT, SECTOR, FLOATING, DIRECTION, MODES };
enum { G_SHAFT, G_SECTOR_LOW, G_SECTOR_HIGH, G_FLOATING, G_DIRECTION, GUARDS };
enum { I_WIDTH_MA = 2 };

static const friction *shaft(const parameters *q) {
  return (const friction *)&q->shaft_tau_c;
}

/* Legs and windings at a state; `v` is what a leg applies, a switched leg or one on its diode. */
static machine legs(const parameters *q, const int *mode, const double *in, const double *x) {
  machine m;
  const double dR[3] = {q->Ra, q->Rb, q->Rc}, dL[3] = {q->La, q->Lb, q->Lc};
  const double turns[3] = {1 - q->short_a, 1 - q->short_b, 1 - q->short_c};
  double electrical = q->pp * x[THETA] / DEG;
  double modulation = 1 + q->zeta * cos((electrical - 60) * DEG);
  int sector = mode[SECTOR], forward = mode[DIRECTION] > 0;
  int high = forward ? HIGH_LEG[sector] : LOW_LEG[sector], floating = FLOAT_LEG[sector];
  m.bus = q->u_max > 0 ? fmin(in[0], q->u_max) : in[0];
  if (q->sag > 0) m.bus -= q->sag * (x[high] + (mode[FLOATING] == FROM_HIGH ? x[floating] : 0));
  for (int n = 0; n < 3; n++) {
    double saturation = q->i_sat > 0 ? 1 / (1 + (x[n] / q->i_sat) * (x[n] / q->i_sat)) : 1;
    m.R[n] = (q->R + dR[n]) * turns[n] * (1 + x[HEAT]);
    m.L[n] = (q->L + dL[n]) * turns[n] * turns[n];
    m.k[n] = q->Ke * turns[n] * modulation * trapezoid(electrical - 120 * n) * saturation;
    m.e[n] = m.k[n] * x[W];
    m.on[n] = n != floating || mode[FLOATING] != OPEN;
    m.v[n] = n == high || (n == floating && mode[FLOATING] == FROM_HIGH) ? m.bus : 0;
    if (q->V_d > 0) m.v[n] -= q->V_d * soft_sign(x[n], I_WIDTH_MA * 1e-3);
  }
  return m;
}

static double rotor_torque(const parameters *q, const machine *m, double t, double w, const double *x) {
  double motor = machine_torque(m, x), angle = x[THETA];
  if (q->rip_a != 0) motor *= 1 + q->rip_a * sin(q->rip_n * angle + q->rip_phi);
  double load = (q->b + q->iron) * w + q->k_s * angle + q->tau_l;
  if (q->mgl != 0) load += q->mgl * sin(angle + q->mgl_phi);
  if (q->cog_a != 0) load += q->cog_a * sin(q->cog_n * angle + q->cog_phi);
  if (q->law_w3 != 0) load += q->law_w3 * w * w * w;
  if (q->law_warm != 0) load += q->law_warm * w * exp(-t / q->law_warm_tau);
  if (q->law_sqrt != 0) load += q->law_sqrt * sign_of(w) * sqrt(fabs(w));
  return motor - load;
}

static void start(const double *p, const double *in, const double *x, int *mode) {
  const parameters *q = (const parameters *)p;
  mode[SHAFT] = friction_start(shaft(q));
  mode[SECTOR] = (int)sector_position(q->pp, x[THETA]) % 6;
  mode[FLOATING] = OPEN;
  mode[DIRECTION] = in[1] > 0 ? 1 : -1;
}

static void derivative(const double *p, const int *mode, double t, const double *in, const double *x, double *dx) {
  const parameters *q = (const parameters *)p;
  machine m = legs(q, mode, in, x);
  double copper = currents(&m, x, dx);
  double torque = rotor_torque(q, &m, t, x[W], x);
  double lost = friction_torque(shaft(q), mode[SHAFT], x[W], torque, 0, x[THETA], x[Z], &dx[Z]);
  dx[W] = (torque - lost) / q->J;
  dx[THETA] = x[W];
  dx[HEAT] = q->heat_tau > 0 ? (q->heat_k * copper - x[HEAT]) / q->heat_tau : 0;
}

static void guard(const double *p, const int *mode, double t, const double *in, const double *x, double *g) {
  const parameters *q = (const parameters *)p;
  machine m = legs(q, mode, in, x);
  g[G_SHAFT] = friction_guard(shaft(q), mode[SHAFT], x[W], rotor_torque(q, &m, t, 0, x), 0, x[THETA]);
  sector_guards(sector_position(q->pp, x[THETA]), mode[SECTOR], g + G_SECTOR_LOW);
  g[G_FLOATING] = floating_guard(&m, mode[FLOATING], FLOAT_LEG[mode[SECTOR]], x, q->V_d);
  g[G_DIRECTION] = in[1] * mode[DIRECTION];
}

static void change(const double *p, const double *g, double t, const double *in, double *x, int *mode) {
  const parameters *q = (const parameters *)p;
  if (g[G_SECTOR_LOW] < 0 || g[G_SECTOR_HIGH] < 0) mode[SECTOR] = (mode[SECTOR] + (g[G_SECTOR_HIGH] < 0 ? 1 : 5)) % 6;
  if (g[G_DIRECTION] < 0) mode[DIRECTION] = in[1] > 0 ? 1 : -1;
  if (g[G_FLOATING] < 0 && mode[FLOATING] != OPEN) cut(x, FLOAT_LEG[mode[SECTOR]]);
  mode[FLOATING] = freewheeling(x[FLOAT_LEG[mode[SECTOR]]]);
  machine m = legs(q, mode, in, x);
  if (mode[FLOATING] == OPEN) mode[FLOATING] = open_leg(&m, FLOAT_LEG[mode[SECTOR]], x, q->V_d);
  if (g[G_SHAFT] < 0) {
    x[W] = 0;
    m = legs(q, mode, in, x);
    mode[SHAFT] = friction_change(shaft(q), rotor_torque(q, &m, t, 0, x), 0, x[THETA]);
  }
}

static void output(const double *p, const int *mode, double t, const double *in, const double *x, double *y) {
  (void)p, (void)mode, (void)t, (void)in;
  y[0] = x[IA];
  y[1] = x[IB];
  y[2] = x[IC];
  y[3] = x[THETA];
  y[4] = x[W];
}

#define NAME(name) #name " "
const bench bldc = {PARAMETERS(NAME), STATES, MODES, GUARDS, 5, start, derivative, guard, change, output};
