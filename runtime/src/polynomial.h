/* Polynomials p[0] + p[1] x + ... + p[n] x^n on [0, 1]. */
#ifndef RT_POLYNOMIAL_H
#define RT_POLYNOMIAL_H

enum { RT_MOST_COEFFICIENTS = 6 }; /* of the dense output of any method */

double rt_horner(int n, const double *p, double x);
double rt_floor_of(int n, const double *p);
double rt_spread(int n, const double *p);
void rt_enclose(int n, const double *p, double *low, double *high);
int rt_extremes(int n, const double *p, double *place);
int rt_roots_between(int n, const double *p, int extremes, const double *place, double *root);

#endif
