/* Laws that several benches conceal. A parameter at zero means that its effect is absent. */
#ifndef PROOF_PHYSICS_H
#define PROOF_PHYSICS_H

#include <math.h>

enum { STUCK = 0, FREE = 9 }; /* otherwise the mode of a friction is the direction of sliding, +1 or -1 */

/* Parameters of one friction, as names: tau_c both directions, tau_d added when positive and taken away when
   negative, tau_e excess of breakaway over sliding, w_s Stribeck speed, mu per transmitted load, pos_* along the
   stroke, sigma bristles. */
/* clang-format off */
#define FRICTION(X, site)                                                                                       \
    X(site##_tau_c) X(site##_tau_d) X(site##_tau_e) X(site##_w_s) X(site##_mu) X(site##_pos_a) X(site##_pos_n)  \
    X(site##_pos_phi) X(site##_sigma0) X(site##_sigma1) X(site##_c2)
/* clang-format on */

typedef struct {
  double tau_c, tau_d, tau_e, w_s, mu, pos_a, pos_n, pos_phi, sigma0, sigma1, c2;
} friction;

static inline double friction_level(const friction *f, double direction, double w, double load, double angle) {
  double level = f->tau_c + direction * f->tau_d;
  if (f->w_s > 0) level += f->tau_e * exp(-(w / f->w_s) * (w / f->w_s));
  if (f->pos_a != 0) level *= 1 + f->pos_a * sin(f->pos_n * angle + f->pos_phi);
  return level + f->mu * fabs(load);
}

static inline int friction_start(const friction *f) {
  return f->sigma0 == 0 && (f->tau_c != 0 || f->tau_e != 0 || f->mu != 0) ? STUCK : FREE;
}

/* What keeps the mode: sliding in its direction, or a drive torque within the level. */
static inline double friction_guard(const friction *f, int mode, double w, double drive, double load, double angle) {
  if (mode == FREE) return 1;
  if (mode != STUCK) return mode * w;
  double direction = drive > 0 ? 1 : -1;
  return friction_level(f, direction, 0, load, angle) - fabs(drive);
}

/* The mode after its guard failed, with the speed at zero. `drive` is the torque that acts at zero speed. */
static inline int friction_change(const friction *f, double drive, double load, double angle) {
  double direction = drive > 0 ? 1 : -1;
  return fabs(drive) <= friction_level(f, direction, 0, load, angle) ? STUCK : (int)direction;
}

/* Torque against the motion; `z` is the bristle deflection and `dz` its derivative, of LuGre's model. */
static inline double friction_torque(const friction *f, int mode, double w, double drive, double load, double angle,
                                     double z, double *dz) {
  *dz = 0;
  double drag = f->c2 * w * fabs(w);
  if (f->sigma0 > 0) {
    double level = friction_level(f, w > 0 ? 1 : -1, w, load, angle);
    *dz = w - f->sigma0 * fabs(w) / level * z;
    return drag + f->sigma0 * z + f->sigma1 * *dz;
  }
  if (mode == FREE) return drag;
  if (mode == STUCK) return drive;
  return drag + mode * friction_level(f, mode, w, load, angle);
}

/* Spring and damper beyond a play; never pulls. `contact` is the side that touches, or 0. */
static inline double contact_torque(int contact, double delta, double speed, double play, double k, double d) {
  if (contact == 0) return 0;
  double t = k * (delta - contact * play / 2) + d * speed;
  return contact * t > 0 ? t : 0;
}

/* What keeps a contact open or closed. */
static inline double contact_guard(int contact, double delta, double play) {
  if (play == 0) return 1;
  return contact == 0 ? play / 2 - fabs(delta) : contact * delta - play / 2;
}

/* Spring and damper beyond either stop; never pulls. No stop where its stiffness is zero. */
static inline double stop_torque(double angle, double w, double low, double high, double k, double d) {
  if (k == 0) return 0;
  if (angle > high) return fmax(0, k * (angle - high) + d * w);
  if (angle < low) return -fmax(0, k * (low - angle) - d * w);
  return 0;
}

static inline double sign_of(double x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/* A sign whose edge is `width` wide: far inside the noise, and not stiff at the steps used here. */
static inline double soft_sign(double x, double width) {
  return x > width ? 1 : x < -width ? -1 : x / width;
}

static inline double limit(double x, double bound) {
  return x > bound ? bound : x < -bound ? -bound : x;
}

#endif
