/* T2: star-connected three-phase motor from rest at full voltage, six-step commutation, the floating leg ideal.
 *
 *   L i_k' = v_k - vn - R i_k - e_k,  e_k = Ke w f_k,  v_k = V | 0 | vn + e_k (floating)
 *   ia + ib + ic = 0                  J w' = Ke sum f_k i_k - B w,  th' = w
 *
 * The ODE form has the states [ia A, ib A, w rad/s, th rad]; the DAE form adds ic, by its own phase equation, and
 * the algebraic vn: the mean of v_k - e_k over the two driven legs, which is the current balance differentiated. */
#include "problem.h"
#include <math.h>

enum { IA, IB, W, TH, IC, VN };

static const double R = 2.1, L = 7e-4, Ke = 0.075, J = 6e-5, B = 2e-4, V = 48.0, pi = 3.14159265358979323846;
static const int pole_pairs = 2;

/* Per sector: the supply of each leg (1 high, 0 low, -1 floating) and the flat top of each back-EMF (the
 * floating phase ramps from -sign to sign). */
static const int leg[6][3] = {{1, 0, -1}, {1, -1, 0}, {-1, 1, 0}, {0, 1, -1}, {0, -1, 1}, {-1, 0, 1}};

typedef struct {
  const int *leg;
  double f[3];     /* shape of the back-EMF, and */
  double slope[3]; /* its derivative with th, 1/rad */
  double drop[3];  /* v_k - vn - e_k of a driven leg but for vn: supply - e_k, V */
  double vn;
} sector;

static int sector_index(const problem_mode *m) {
  return ((m->mode % 6) + 6) % 6;
}

/* `ramp` runs from -1 to 1 over the sector; in sectors where the floating phase falls it is negated. */
static sector at(const problem_mode *m, double w, double th) {
  const int k = sector_index(m);
  const double ramp = -1.0 + 2.0 * (pole_pairs * th - pi / 6 - m->mode * pi / 3) / (pi / 3);
  const double ramp_slope = 6.0 * pole_pairs / pi, sign = k % 2 == 0 ? -1.0 : 1.0;
  sector s = {.leg = leg[k]};
  for (int phase = 0; phase < 3; phase++) {
    const int floating = s.leg[phase] < 0;
    s.f[phase] = floating ? sign * ramp : s.leg[phase] ? 1.0 : -1.0;
    s.slope[phase] = floating ? sign * ramp_slope : 0.0;
    s.drop[phase] = floating ? 0.0 : s.leg[phase] * V - Ke * w * s.f[phase];
  }
  s.vn = 0.5 * (s.drop[0] + s.drop[1] + s.drop[2]);
  return s;
}

static void start(problem_mode *m, double *y) {
  *m = (problem_mode){.mode = -1};
  for (int i = 0; i < 6; i++) {
    y[i] = 0.0;
  }
  y[VN] = at(m, 0.0, 0.0).vn;
}

static double torque(const sector *s, double ia, double ib, double ic) {
  return Ke * (s->f[0] * ia + s->f[1] * ib + s->f[2] * ic);
}

/* Voltage across the resistance and inductance of a phase, V. */
static double phase_voltage(const sector *s, int phase, double vn) {
  return s->leg[phase] < 0 ? 0.0 : s->drop[phase] - vn;
}

static void derivatives(const problem_mode *m, const double *x, double *dx) {
  const sector s = at(m, x[W], x[TH]);
  dx[IA] = (phase_voltage(&s, 0, s.vn) - R * x[IA]) / L;
  dx[IB] = (phase_voltage(&s, 1, s.vn) - R * x[IB]) / L;
  dx[W] = (torque(&s, x[IA], x[IB], -x[IA] - x[IB]) - B * x[W]) / J;
  dx[TH] = x[W];
}

static void residual(const problem_mode *m, const double *y, const double *yp, double *r) {
  const sector s = at(m, y[W], y[TH]);
  r[IA] = L * yp[IA] - phase_voltage(&s, 0, y[VN]) + R * y[IA];
  r[IB] = L * yp[IB] - phase_voltage(&s, 1, y[VN]) + R * y[IB];
  r[W] = J * yp[W] - torque(&s, y[IA], y[IB], y[IC]) + B * y[W];
  r[TH] = yp[TH] - y[W];
  r[IC] = L * yp[IC] - phase_voltage(&s, 2, y[VN]) + R * y[IC];
  r[VN] = 2.0 * y[VN] - s.drop[0] - s.drop[1] - s.drop[2];
}

static void jacobian(const problem_mode *m, const double *y, double cj, double *const *columns) {
  const sector s = at(m, y[W], y[TH]);
  const double current[3] = {y[IA], y[IB], y[IC]};
  columns[IA][IA] = columns[IB][IB] = columns[IC][IC] = L * cj + R;
  columns[W][W] = J * cj + B;
  columns[TH][TH] = cj;
  columns[W][TH] = -1.0;
  columns[VN][VN] = 2.0;
  for (int phase = 0; phase < 3; phase++) {
    const int column = phase == 2 ? IC : phase; /* of this phase's current */
    columns[column][W] = -Ke * s.f[phase];
    columns[TH][W] -= Ke * s.slope[phase] * current[phase];
    if (s.leg[phase] >= 0) {
      columns[W][VN] += Ke * s.f[phase];
      columns[VN][column] = 1.0;
      columns[W][column] = Ke * s.f[phase];
    }
  }
}

static void guards(const problem_mode *m, const double *x, double *g) {
  g[0] = pi / 6 + (m->mode + 1) * pi / 3 - pole_pairs * x[TH];
}

static double next_time_event(const problem_mode *m) {
  (void)m;
  return INFINITY;
}

static void time_event(problem_mode *m) {
  (void)m;
}

static void guard_event(problem_mode *m, const double *x) {
  (void)x;
  m->mode += 1;
}

const problem bldc_t2 = {
    "T2",       4,          5, 6, 1, 1.0, 1e-4, start, derivatives, residual, jacobian, guards, next_time_event,
    time_event, guard_event};
