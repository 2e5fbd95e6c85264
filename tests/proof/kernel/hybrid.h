/* A hybrid system at a fixed step: classical Runge-Kutta between events, every event located by bisection. */
#ifndef PROOF_HYBRID_H
#define PROOF_HYBRID_H

enum { MAX_STATES = 24, MAX_MODES = 8, MAX_GUARDS = 16, MAX_INPUTS = 4, MAX_OUTPUTS = 6 };

typedef struct {
  const char *parameters; /* names, separated by spaces, in the order of the parameter array */
  int states, modes, guards, outputs;
  /* Modes at the first instant, before the first call of `change`. */
  void (*start)(const double *p, const double *in, const double *x, int *mode);
  void (*derivative)(const double *p, const int *mode, double t, const double *in, const double *x, double *dx);
  /* A guard below zero ends its mode. */
  void (*guard)(const double *p, const int *mode, double t, const double *in, const double *x, double *g);
  /* New modes (and states projected on them) where a guard is below zero. */
  void (*change)(const double *p, const double *g, double t, const double *in, double *x, int *mode);
  void (*output)(const double *p, const int *mode, double t, const double *in, const double *x, double *y);
} bench;

typedef struct {
  int samples, inputs, substeps;
  double period;       /* s, of the samples */
  const double *input; /* samples x inputs */
  const int *hold;     /* per input: 1 held from its sample on, 0 linear */
  double delay;        /* s, by which the inputs arrive late */
  const double *lag;   /* per output: time constant of its sensor, s; 0 = none */
} experiment;

/* y is samples x outputs. Returns 0, or 1 when a state stopped being finite. */
int simulate(const bench *b, const double *p, const double *x0, const experiment *e, double *y);

#endif
