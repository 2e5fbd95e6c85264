/* Polynomials p[0] + p[1] x + ... + p[n] x^n on [0, 1]: what encloses their values, and all their roots. */
#include "polynomial.h"

#include <float.h>
#include <math.h>

#include "session.h"

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

/* Between *low and *high are the values of p on [0, 1]: its coefficients in the basis of Bernstein. */
void rt_enclose(int n, const double *p, double *low, double *high) {
  double b[RT_MOST_COEFFICIENTS] = {p[0]}, choose = 1;
  for (int k = 0; k <= n; k++) {
    b[k] = p[k] / choose;
    choose *= (double)(n - k) / (k + 1);
  }
  for (int i = 1; i <= n; i++)
    for (int k = n; k >= i; k--)
      b[k] += b[k - 1];
  *low = *high = b[0];
  for (int k = 1; k <= n; k++) {
    *low = rt_min(*low, b[k]);
    *high = rt_max(*high, b[k]);
  }
}

/* The root of p between a and b in [0, 1], where its sign is another one: halved until it is as long as rounding, which
 * are 52 rounds. */
static double root_between(int n, const double *p, double a, double b) {
  bool negative = rt_horner(n, p, a) < 0;
  while (b - a > DBL_EPSILON) {
    double middle = 0.5 * (a + b);
    *((rt_horner(n, p, middle) < 0) == negative ? &a : &b) = middle;
  }
  return b;
}

/* Where p changes its sign in (0, 1), in rising order: between two places where its derivative does, it is monotone. */
int rt_roots_of(int n, const double *p, double *root) {
  double slope[RT_MOST_COEFFICIENTS], turn[RT_MOST_COEFFICIENTS], a = 0;
  int turns = 0, found = 0;
  for (int k = 1; k <= n; k++)
    slope[k - 1] = k * p[k];
  if (n > 1) turns = rt_roots_of(n - 1, slope, turn);
  bool negative = p[0] < 0;
  for (int i = 0; i <= turns; i++) {
    double b = i < turns ? turn[i] : 1;
    if ((rt_horner(n, p, b) < 0) != negative) {
      root[found++] = root_between(n, p, a, b);
      negative = !negative;
    }
    a = b;
  }
  return found;
}

int rt_extremes(int n, const double *p, double *place) {
  double slope[RT_MOST_COEFFICIENTS];
  for (int k = 1; k <= n; k++)
    slope[k - 1] = k * p[k];
  return n > 1 ? rt_roots_of(n - 1, slope, place) : 0;
}
