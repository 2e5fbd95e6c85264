/* C interface of the analysis library, for Python and other languages. Functions that can fail return NULL or a
 * non-zero value and write a message, always terminated, into `message`. A chain may be used by several threads. */
#ifndef LACUNA_ANALYSIS_H
#define LACUNA_ANALYSIS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lacuna_chain lacuna_chain;

typedef struct {
  double rms;            /* A, of the whole record */
  double peak_hz;        /* first peak of the peak-hold spectrum; NaN: none */
  double peak_amplitude; /* A; NaN: none */
  long long peak_bin;    /* -1: none */
  double frequency;      /* Hz, of the fundamental, between the lines; NaN: none */
  double harmonic[4];    /* A, peak-hold amplitude at 0, 1, 2, 3 times the fundamental; NaN: no fundamental */
} lacuna_channel;

typedef struct {
  double rms_mean;   /* A */
  double speed_mean; /* rad/s, over whole turns after the start-up; NaN: not a whole turn, or no angle given */
  int turns;
} lacuna_summary;

typedef enum { LACUNA_PAD_NONE, LACUNA_PAD_SECTION, LACUNA_PAD_RECORD } lacuna_padding;

/* What settings/paper.toml explains; all of it is copied. */
typedef struct {
  double sampling_rate;        /* Hz */
  double duration;             /* s */
  size_t channels;             /* currents */
  const char *const *currents; /* [channels] their names, for messages */
  const char *angle;           /* its name */
  double section, overlap;     /* shares of the record, of a section */
  lacuna_padding padding;      /* to the next power of two */
  double peak_above;           /* Hz */
  double peak_threshold;       /* share of the largest line */
  double speed_after;          /* s */
} lacuna_settings;

lacuna_chain *lacuna_chain_new(const lacuna_settings *settings, char *message, size_t message_size);
void lacuna_chain_free(lacuna_chain *chain);

size_t lacuna_chain_channels(const lacuna_chain *chain);
size_t lacuna_chain_samples(const lacuna_chain *chain); /* of a record */
size_t lacuna_chain_sections(const lacuna_chain *chain);
size_t lacuna_chain_section_length(const lacuna_chain *chain);
size_t lacuna_chain_section_start(const lacuna_chain *chain, size_t section);
size_t lacuna_chain_lines(const lacuna_chain *chain);      /* of a single-sided spectrum */
double lacuna_chain_resolution(const lacuna_chain *chain); /* Hz between lines */

/* Analyse one recording: `currents` points to one array of `samples` values for each channel; `angle` (rad) may be
 * NULL. Writes `channels` [channels], `summary`, and where `held` is not NULL the peak-hold amplitude spectra
 * [channels][lines]. */
int lacuna_chain_analyse(const lacuna_chain *chain, const double *const *currents, const double *angle, size_t samples,
                         lacuna_channel *channels, lacuna_summary *summary, double *held, char *message,
                         size_t message_size);

/* Single-sided spectra of one section of `section_length` samples: amplitude (A) and power (A^2), [lines] each. */
int lacuna_chain_section_spectrum(const lacuna_chain *chain, const double *section, double *amplitude, double *power,
                                  char *message, size_t message_size);

/* Features of a recording as one vector [lacuna_signature_size(channels)]: see lacuna/signature.hpp.
 * Non-zero where a channel has no first peak. */
size_t lacuna_signature_size(size_t channels);
int lacuna_signature(const lacuna_channel *channels, size_t count, double *signature);

typedef struct lacuna_table lacuna_table;

typedef struct {
  double severity, low, high; /* most likely, and its 95 % interval */
  double misfit;              /* squared distance to the map, in standard deviations */
  double paper;               /* by the mean RMS alone */
  int band;                   /* row of the table's bands */
  int covered;                /* 0: the map explains this recording at no severity */
} lacuna_estimate;

/* A severity table from the bytes of its file: see lacuna/severity_table.hpp. Threads may share it. */
lacuna_table *lacuna_table_new(const void *bytes, size_t size, char *message, size_t message_size);
void lacuna_table_free(lacuna_table *table);
size_t lacuna_table_channels(const lacuna_table *table);
/* Severity of a recording from its channels' features. Non-zero where a channel has no first peak. */
int lacuna_table_estimate(const lacuna_table *table, const lacuna_channel *channels, double rms_mean,
                          lacuna_estimate *estimate);

/* The filter of a forecast (analysis/prognosis/filter/filter.py): Gaussians over severity x and logarithm l of a law's
 * rate. Arrays over hypotheses are [laws][histories][columns]. */
typedef struct {
  size_t laws, histories, columns, points;
  const double *severity;                               /* [points] of the laws' tables, rising */
  const double *growth, *age;                           /* [laws][points], age rising */
  const double *life;                                   /* [laws] age at the limit, the unit of wander */
  const double *wander2, *diffusion2, *change, *common; /* [laws][columns] */
  double wide, wide_scale, outlier, outlier_range, change_size;
  double gone; /* a hypothesis of less weight is left out from then on */
} lacuna_hypotheses;

typedef struct {
  double *x, *l, *xx, *xl, *ll, *w;
} lacuna_beliefs;

typedef struct {
  const double *use, *value, *below, *above; /* [histories]; use since the test before */
  const unsigned char *valid;                /* [histories] 0: a test without a reading */
} lacuna_tests;

/* Take `beliefs` over one test of each history. Writes `outlier` (probability that the test says nothing) and
 * `evidence` (its likelihood), [histories]. `predicted` (all but w), `along` and `turn` (dx'/dx, dx'/dl) may be NULL.
 */
void lacuna_hypotheses_test(const lacuna_hypotheses *hypotheses, const lacuna_tests *tests, lacuna_beliefs *beliefs,
                            lacuna_beliefs *predicted, double *along, double *turn, double *outlier, double *evidence);

/* Probability `reached` [histories][points] that a use is reached, given its logarithm `log_use` (-inf: none), by sums
 * of lognormals [histories][lognormals]; a mean of -inf is reached already. To 4e-8 a lognormal. */
void lacuna_lognormals_reached(const double *mean, const double *sd, const double *weight, size_t histories,
                               size_t lognormals, const double *log_use, size_t points, double *reached);

/* A linear model along a recording of `samples`. From sample k to the next x -> step[k] x + drive[k] q with q held, and
 * y = read[k] x + feed[k] q. */
typedef struct {
  size_t samples, states, outputs, inputs;
  const double *time;  /* [samples] s, rising */
  const double *step;  /* [samples - 1][states][states] */
  const double *drive; /* [samples - 1][states][inputs] */
  const double *read;  /* [samples][outputs][states] */
  const double *feed;  /* [samples][outputs][inputs] */
  const double *noise; /* [outputs] standard deviations; NULL for a response */
  const double *start; /* [states] standard deviations at the first sample; NULL for a response */
} lacuna_linear_model;

/* Hypotheses about unknown forces, Ornstein-Uhlenbeck processes: arrays [hypotheses][forces]. */
typedef struct {
  size_t hypotheses, forces;
  const int *column;         /* of the inputs, in which the force acts; -1: in none */
  const int *sensor;         /* output to whose reading it is added; -1: to none */
  const double *size, *time; /* standard deviation; time constant, s */
} lacuna_latent;

/* Columns of readings `data` [samples][outputs][columns], where `seen` [samples][outputs], whitened by the filter of
 * each hypothesis: adds their products to `gram` [hypotheses][columns][columns], and the logarithm of the determinant
 * of the innovations' covariance, in units of the noise, to `log_determinant` [hypotheses]. Not zero: a variance is no
 * positive number. */
int lacuna_latent_evidence(const lacuna_linear_model *model, const lacuna_latent *latent, const double *data,
                           const unsigned char *seen, size_t columns, double *gram, double *log_determinant);

/* What the filter of one hypothesis does at each reading and from each sample to the next: the same to every column. */
typedef struct {
  double *row, *gain; /* [samples][outputs][states, then forces] coefficients in a reading; shares of its innovation */
  double *deviation;  /* [samples][outputs] of the innovations; 1 where none is seen */
  double *drive;      /* [samples - 1][states][forces] */
  double *keep;       /* [samples - 1][forces] */
} lacuna_latent_gains;

/* Of the first hypothesis. Not zero: a variance is no positive number. */
int lacuna_latent_filter(const lacuna_linear_model *model, const lacuna_latent *latent, const unsigned char *seen,
                         lacuna_latent_gains *gains);

/* Columns of readings, as above, whitened in their place; zero where not `seen`. */
void lacuna_latent_whiten(const lacuna_linear_model *model, const lacuna_latent_gains *gains, size_t forces,
                          double *data, const unsigned char *seen, size_t columns);

/* The transpose of that, as a matrix of readings by readings. */
void lacuna_latent_whiten_transposed(const lacuna_linear_model *model, const lacuna_latent_gains *gains, size_t forces,
                                     double *data, const unsigned char *seen, size_t columns);

/* Mean and standard deviation [forces][samples] of the forces of the first hypothesis, given `readings`
 * [samples][outputs]. */
int lacuna_latent_smooth(const lacuna_linear_model *model, const lacuna_latent *latent, const double *readings,
                         const unsigned char *seen, double *mean, double *deviation);

/* Outputs [samples / every, rounded up][outputs][count], at one sample in `every`, from rest to each of `courses`
 * [samples][count] in input `columns` [count], held from sample to sample or linear between them. */
void lacuna_linear_response(const lacuna_linear_model *model, const int *columns, const double *courses, size_t count,
                            int hold, size_t every, double *outputs);

/* The transpose of that of courses in one input, linear between samples: `courses` [samples][count] from `outputs`
 * [samples / every, rounded up][outputs][count]. */
void lacuna_linear_response_transposed(const lacuna_linear_model *model, size_t column, const double *outputs,
                                       size_t count, size_t every, double *courses);

/* The implementation of the Fourier transform that this library was built with: "FFTW" or "Eigen". */
const char *lacuna_transform_name(void);

#ifdef __cplusplus
}
#endif
#endif
