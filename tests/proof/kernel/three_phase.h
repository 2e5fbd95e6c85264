/* A star-connected trapezoidal machine on a six-step bridge whose floating leg has only its diodes. */
#ifndef PROOF_THREE_PHASE_H
#define PROOF_THREE_PHASE_H

#include "physics.h"

enum { OPEN = 0, FROM_LOW = 1, FROM_HIGH = -1 }; /* the floating leg's diode that conducts: the sign of its current */

static const double DEG = 0.017453292519943295;
/* For positive torque; for negative the two change places. */
static const int HIGH_LEG[6] = {0, 0, 1, 1, 2, 2}, LOW_LEG[6] = {1, 2, 2, 0, 0, 1}, FLOAT_LEG[6] = {2, 1, 0, 2, 1, 0};

typedef struct {
  double R[3], L[3], k[3], e[3], v[3];
  int on[3];  /* carries current: switched, or its diode conducts */
  double bus; /* V, of the upper rail at the bridge */
} machine;

/* Trapezoid of an angle in degrees: 1 from 30 to 150, -1 from 210 to 330. */
static inline double trapezoid(double angle) {
  double a = fmod(angle, 360);
  if (a < 0) a += 360;
  if (a < 30) return a / 30;
  if (a < 150) return 1;
  if (a < 210) return (180 - a) / 30;
  if (a < 330) return -1;
  return (a - 360) / 30;
}

/* Neutral voltage from the currents' sum staying zero. */
static inline double neutral(const machine *m, const double *i) {
  double sum = 0, weight = 0;
  for (int n = 0; n < 3; n++)
    if (m->on[n]) {
      sum += (m->v[n] - m->R[n] * i[n] - m->e[n]) / m->L[n];
      weight += 1 / m->L[n];
    }
  return sum / weight;
}

/* Slopes of the currents; returns the copper loss. */
static inline double currents(const machine *m, const double *i, double *di) {
  double vn = neutral(m, i), copper = 0;
  for (int n = 0; n < 3; n++) {
    di[n] = m->on[n] ? (m->v[n] - vn - m->R[n] * i[n] - m->e[n]) / m->L[n] : 0;
    copper += m->R[n] * i[n] * i[n];
  }
  return copper;
}

static inline double machine_torque(const machine *m, const double *i) {
  return m->k[0] * i[0] + m->k[1] * i[1] + m->k[2] * i[2];
}

/* Sectors, 0 to 6, from 30 electrical degrees on. */
static inline double sector_position(double pp, double angle) {
  double a = fmod(pp * angle / DEG - 30, 360);
  return (a < 0 ? a + 360 : a) / 60;
}

/* Both negative outside of the sector: g[0] below it, g[1] at its end or above. */
static inline void sector_guards(double position, int sector, double *g) {
  double into = fmod(position - sector + 9, 6) - 3;
  g[0] = into;
  g[1] = into < 1 ? 1 - into : -1;
}

/* What keeps the floating leg's diode in its mode, a diode drops `drop`. */
static inline double floating_guard(const machine *m, int diode, int leg, const double *i, double drop) {
  if (diode != OPEN) return diode * i[leg];
  double v = neutral(m, i) + m->e[leg];
  return fmin(v + drop, m->bus + drop - v) + 1e-9;
}

/* The diode that an open leg's potential turns on. */
static inline int open_leg(const machine *m, int leg, const double *i, double drop) {
  double v = neutral(m, i) + m->e[leg];
  if (v < -drop - 1e-9) return FROM_LOW;
  if (v > m->bus + drop + 1e-9) return FROM_HIGH;
  return OPEN;
}

/* The diode that the current of a leg just switched off runs through. */
static inline int freewheeling(double i) {
  return i > 1e-12 ? FROM_LOW : i < -1e-12 ? FROM_HIGH : OPEN;
}

/* A current that reached zero is put there, its rest shared by the other two. */
static inline void cut(double *i, int leg) {
  double rest = i[leg] / 2;
  for (int n = 0; n < 3; n++)
    i[n] = n == leg ? 0 : i[n] + rest;
}

#endif
