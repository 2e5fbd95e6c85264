#include "reference_actuator.h"

#include <math.h>
#include <string.h>

enum { A, B, C, W, TH, FILTER, N_STATES = FILTER + 9 };

static const double PI = 3.14159265358979323846;

/* Legs by 60-degree sector, counted from 30 degrees: the one to the supply and the one that floats; the third
 * is at ground. */
static const int HIGH[6] = {A, A, B, B, C, C}, FLOAT[6] = {C, B, A, C, B, A};

typedef enum { DIODE_LOW, DIODE_HIGH, OPEN } float_mode;

typedef struct {
  int sector;     /* not wrapped: sector k spans 30 + 60 k ... 90 + 60 k degrees */
  float_mode leg; /* how the floating leg conducts */
  int stuck;      /* dry friction holds the rotor */
} mode;

typedef struct {
  double i_dot[3], torque, v_float;
} electrical;

static int wrapped(int sector) {
  return ((sector % 6) + 6) % 6;
}

static double trapezoid(double angle) {
  double turn = angle / (2 * PI);
  double degrees = 360 * (turn - floor(turn));
  if (degrees < 30) return degrees / 30;
  if (degrees < 150) return 1;
  if (degrees < 210) return (180 - degrees) / 30;
  if (degrees < 330) return -1;
  return (degrees - 360) / 30;
}

static electrical circuit(const reference_parameters *p, const mode *m, const double *y) {
  electrical out = {{0}, 0, 0};
  double theta_e = p->pp * y[TH], e[3], v[3] = {0};
  double modulation = 1 + p->zeta * cos(theta_e - PI / 3);
  for (int x = 0; x < 3; x++) {
    double k = p->Ke * trapezoid(theta_e - 2 * PI / 3 * x) * modulation;
    e[x] = k * y[W];
    out.torque += k * y[x];
  }
  int s = wrapped(m->sector), floating = FLOAT[s];
  v[HIGH[s]] = p->V;
  v[floating] = m->leg == DIODE_HIGH ? p->V : 0;
  double sum = 0;
  int legs = m->leg == OPEN ? 2 : 3;
  for (int x = 0; x < 3; x++)
    if (x != floating || m->leg != OPEN) sum += v[x] - e[x];
  double v_n = sum / legs;
  for (int x = 0; x < 3; x++)
    if (x != floating || m->leg != OPEN) out.i_dot[x] = (v[x] - v_n - p->R * y[x] - e[x]) / p->L;
  out.v_float = v_n + e[floating];
  return out;
}

static void derivative(const reference_parameters *p, const mode *m, const double *y, double *f) {
  electrical el = circuit(p, m, y);
  double corner = 2 * PI * p->f_cut;
  for (int x = 0; x < 3; x++) {
    const double *s = y + FILTER + 3 * x;
    double *sf = f + FILTER + 3 * x;
    f[x] = el.i_dot[x];
    sf[0] = corner * (y[x] - s[0]);
    sf[1] = corner * (s[0] - s[1]);
    sf[2] = corner * (s[1] - s[2]);
  }
  f[W] = m->stuck ? 0 : (el.torque - p->d * y[W] - p->tau_c) / p->J;
  f[TH] = y[W];
}

static void rk4(const reference_parameters *p, const mode *m, const double *y, double h, double *out) {
  static const double weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}, stage[4] = {0, 0.5, 0.5, 1};
  double k[N_STATES] = {0}, at[N_STATES], sum[N_STATES] = {0};
  for (int s = 0; s < 4; s++) {
    for (int n = 0; n < N_STATES; n++)
      at[n] = y[n] + h * stage[s] * k[n];
    derivative(p, m, at, k);
    for (int n = 0; n < N_STATES; n++)
      sum[n] += weight[s] * k[n];
  }
  for (int n = 0; n < N_STATES; n++)
    out[n] = y[n] + h * sum[n];
}

enum { COMMUTATE, LEG, BREAK_AWAY, N_GUARDS };

/* Each guard is negative while the mode lasts. The rotor never stops again once it turns. */
static void guards(const reference_parameters *p, const mode *m, const double *y, double *g) {
  electrical el = circuit(p, m, y);
  double current = y[FLOAT[wrapped(m->sector)]];
  g[COMMUTATE] = p->pp * y[TH] - (PI / 6 + PI / 3 * (m->sector + 1));
  if (m->leg == DIODE_LOW)
    g[LEG] = -current;
  else if (m->leg == DIODE_HIGH)
    g[LEG] = current;
  else
    g[LEG] = fmax(el.v_float - p->V, -el.v_float);
  g[BREAK_AWAY] = m->stuck ? el.torque - p->tau_c : -1;
}

static float_mode open_or_diode(const reference_parameters *p, const mode *m, const double *y) {
  mode open = *m;
  open.leg = OPEN;
  double v = circuit(p, &open, y).v_float;
  return v > p->V ? DIODE_HIGH : v < 0 ? DIODE_LOW : OPEN;
}

static void change_mode(const reference_parameters *p, mode *m, int guard, double *y) {
  if (guard == BREAK_AWAY) {
    m->stuck = 0;
  } else if (guard == COMMUTATE) {
    m->sector++;
    double current = y[FLOAT[wrapped(m->sector)]];
    m->leg = current > 0 ? DIODE_LOW : current < 0 ? DIODE_HIGH : open_or_diode(p, m, y);
  } else if (m->leg == OPEN) {
    m->leg = open_or_diode(p, m, y);
  } else {
    y[FLOAT[wrapped(m->sector)]] = 0;
    m->leg = OPEN;
    m->leg = open_or_diode(p, m, y);
  }
}

/* Fraction of the step after which `guard` is first positive, by bisection to rounding. */
static double locate(const reference_parameters *p, const mode *m, const double *y, double h, int guard) {
  double low = 0, high = 1, at[N_STATES], g[N_GUARDS];
  for (int n = 0; n < 50; n++) {
    double middle = 0.5 * (low + high);
    rk4(p, m, y, h * middle, at);
    guards(p, m, at, g);
    if (g[guard] > 0)
      high = middle;
    else
      low = middle;
  }
  return high;
}

/* One output step with as many events as it holds; the number of events, or -1 if they do not end. */
static int step_with_events(const reference_parameters *p, mode *m, double *y, double step) {
  double left = step, next[N_STATES], g[N_GUARDS];
  for (int events = 0; events < 20; events++) {
    double first = 2;
    int which = -1;
    rk4(p, m, y, left, next);
    guards(p, m, next, g);
    for (int k = 0; k < N_GUARDS; k++) {
      double fraction = g[k] > 0 ? locate(p, m, y, left, k) : 2;
      if (fraction < first) {
        first = fraction;
        which = k;
      }
    }
    if (which < 0) {
      memcpy(y, next, sizeof next);
      return events;
    }
    rk4(p, m, y, left * first, next);
    memcpy(y, next, sizeof next);
    left *= 1 - first;
    change_mode(p, m, which, y);
  }
  return -1;
}

reference_parameters reference_defaults(void) {
  return (reference_parameters){.V = 28,
                                .R = 2.13,
                                .L = 720e-6,
                                .Ke = 0.12476,
                                .pp = 2,
                                .J = 2.5e-5,
                                .d = 3e-5,
                                .tau_c = 0.09357,
                                .f_cut = 129.7,
                                .zeta = 0};
}

int reference_simulate(const reference_parameters *p, double step, int rows, double (*out)[5]) {
  double y[N_STATES] = {0};
  mode m = {.sector = -1, .leg = OPEN, .stuck = 1};
  int total = 0;
  for (int row = 0; row < rows; row++) {
    out[row][0] = y[FILTER + 2];
    out[row][1] = y[FILTER + 5];
    out[row][2] = y[FILTER + 8];
    out[row][3] = y[W];
    out[row][4] = y[TH];
    int events = step_with_events(p, &m, y, step);
    if (events < 0) return -1;
    total += events;
  }
  return total;
}
