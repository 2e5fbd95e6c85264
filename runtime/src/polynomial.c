/* Polynomials p[0] + p[1] x + ... + p[n] x^n on [0, 1]: what encloses their values, and all their roots. */
#include "polynomial.h"

#include <float.h>
#include <math.h>

#include "session.h"

static const double half_of_digits = 0x1p-26;

double rt_horner(int n, const double *p, double x) {
  double sum = p[n];
  for (int k = n - 1; k >= 0; k--)
    sum = sum * x + p[k];
  return sum;
}

/* No value of p on [0, 1] is less than this. */
double rt_floor_of(int n, const double *p) {
  double sum = p[0];
  for (int k = 1; k <= n; k++)
    sum += rt_min(p[k], 0);
  return sum;
}

/* No two values of p on [0, 1] are further apart. */
double rt_spread(int n, const double *p) {
  double sum = 0;
  for (int k = 1; k <= n; k++)
    sum += fabs(p[k]);
  return sum;
}

static inline __attribute__((always_inline)) void enclose(int n, const double *p, double *low, double *high) {
  static const double per_choice[][RT_MOST_COEFFICIENTS] = {{1},
                                                            {1, 1},
                                                            {1, 1. / 2, 1},
                                                            {1, 1. / 3, 1. / 3, 1},
                                                            {1, 1. / 4, 1. / 6, 1. / 4, 1},
                                                            {1, 1. / 5, 1. / 10, 1. / 10, 1. / 5, 1}};
  double b[RT_MOST_COEFFICIENTS] = {p[0]};
  for (int k = 1; k <= n; k++)
    b[k] = p[k] * per_choice[n][k];
  for (int i = 1; i <= n; i++)
    for (int k = n; k >= i; k--)
      b[k] += b[k - 1];
  double least = b[0], most = b[0];
  for (int k = 1; k <= n; k++) {
    least = rt_min(least, b[k]);
    most = rt_max(most, b[k]);
  }
  *low = least;
  *high = most;
}

/* Between *low and *high are the values of p on [0, 1]: its coefficients in the basis of Bernstein. */
void rt_enclose(int n, const double *p, double *low, double *high) {
  if (n == 4) /* as of dopri5: unrolled */
    enclose(4, p, low, high);
  else
    enclose(n, p, low, high);
}

/* The root of p between a and b in [0, 1], where its sign is another one, known as well as that: by Newton's steps,
 * taken so far beyond the root that the other end moves in too. Where they leave the interval, or three of them have
 * not halved it, the next look is at its middle, so that it ends. */
static double root_between(int n, const double *p, double a, double b, double well) {
  bool negative = rt_horner(n, p, a) < 0;
  double x = 0.5 * (a + b), length = b - a;
  for (int i = 1; b - a > well; i++) {
    double value = p[n], slope = 0;
    for (int k = n - 1; k >= 0; k--) {
      slope = slope * x + value;
      value = value * x + p[k];
    }
    bool before = (value < 0) == negative, creeps = i % 3 == 0 && b - a > 0.5 * length;
    *(before ? &a : &b) = x;
    if (i % 3 == 0) length = b - a;
    x += (before ? 0.5 : -0.5) * well - value / slope;
    if (creeps || !(x > a && x < b)) x = 0.5 * (a + b);
  }
  return b;
}

/* Where p changes its sign in (0, 1), in rising order: between two of its extremes it is monotone. */
static int changes(int n, const double *p, int extremes, const double *place, double well, double *root) {
  int found = 0;
  bool negative = p[0] < 0;
  double a = 0;
  for (int i = 0; i <= extremes; i++) {
    double b = i < extremes ? place[i] : 1;
    if ((rt_horner(n, p, b) < 0) != negative) {
      root[found++] = root_between(n, p, a, b, well);
      negative = !negative;
    }
    a = b;
  }
  return found;
}

int rt_roots_between(int n, const double *p, int extremes, const double *place, double *root) {
  return changes(n, p, extremes, place, DBL_EPSILON, root);
}

/* Where the derivative of p changes its sign, whose extremes are found in the same way; nowhere where its first
 * coefficient is larger than all it changes by. A value at an extreme errs by the square of what its place does. */
int rt_extremes(int n, const double *p, double *place) {
  double slope[RT_MOST_COEFFICIENTS], turn[RT_MOST_COEFFICIENTS];
  for (int k = 1; k <= n; k++)
    slope[k - 1] = k * p[k];
  if (n < 2 || fabs(slope[0]) > rt_spread(n - 1, slope)) return 0;
  return changes(n - 1, slope, rt_extremes(n - 1, slope, turn), turn, half_of_digits, place);
}
