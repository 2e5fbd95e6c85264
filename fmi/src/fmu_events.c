/* Model exchange: the importer integrates and finds events; what happens at them is the runtime's own event. */
#include <math.h>
#include <string.h>

#include "clock.h"
#include "fmu.h"
#include "past.h"

/* Positive while a relation keeps its value. */
static double margin(const rt_session *s, int r) {
  return rt_margin(s, r, s->g[r]);
}

/* A relation has switched. One that holds ends where its guard arrives at zero; one that does not begins beyond it. */
static bool has_switched(const rt_session *s, int r) {
  double now = margin(s, r);
  return now < 0 || (now == 0 && s->data.rel[r] && rt_margin(s, r, s->g_previous[r]) > 0);
}

/* Time goes on from here: the guards are those of the start of a step. */
static void begin_step(fmu *f) {
  rt_session *s = f->session;
  memcpy(s->g_previous, s->g, (size_t)s->d->n_rel * sizeof *s->g);
  for (int i = 0; i < f->n_indicators; i++)
    rt_extend_guard(s, f->indicator[i], fabs(s->g[f->indicator[i]]));
  s->t_previous = s->t;
  rt_branch_begin(s);
}

/* What has become due at the present time: relations whose guards have passed, ticks, time relations. */
bool fmu_enter_event(fmu *f) {
  rt_session *s = f->session;
  if (f->mode != FMU_CONTINUOUS && f->mode != FMU_STEP) return fmu_refuse(f, "event mode follows a step");
  bool from_step = f->mode == FMU_STEP;
  f->mode = FMU_EVENT;
  if (from_step) return true; /* the runtime's own steps have found it */
  if (!fmu_refresh(f)) return false;
  s->pending = rt_clock_due(s);
  for (int i = 0; i < f->n_indicators; i++) {
    int r = f->indicator[i];
    s->flip[r] = has_switched(s, r);
    if (s->flip[r]) s->pending |= RT_PENDING_STATE;
  }
  return true;
}

/* Sample clocks whose start or interval has been tuned: the next tick is the first that has not passed. */
static bool reset_clocks(fmu *f) {
  rt_session *s = f->session;
  rt_clock *c = &s->clock;
  double start[64], interval[64];
  int n = s->d->n_sample;
  if (!n) return true;
  if (n > 64) return fmu_refuse(f, "parameters of a model with more than 64 sample clocks cannot be tuned");
  memcpy(start, c->first, (size_t)n * sizeof *start);
  memcpy(interval, c->interval, (size_t)n * sizeof *interval);
  if (s->d->samples(&s->data, c->first, c->interval))
    return fmu_done(f, rt_fail_model(s, s->t, "computing sample times"));
  for (int i = 0; i < n; i++) {
    if (c->first[i] == start[i] && c->interval[i] == interval[i]) continue;
    if (!(c->interval[i] > 0)) return fmu_refuse(f, "sample() number %d has interval %.9g s", i + 1, c->interval[i]);
    c->next[i] = (long)rt_max(0, ceil((s->t - c->tolerance - c->first[i]) / c->interval[i]));
  }
  rt_clock_look(s);
  return true;
}

/* What a delay looks back by is fixed in a run: its past reaches no further. */
static bool keeps_delays(fmu *f) {
  rt_session *s = f->session;
  rt_delays *d = s->delays;
  if (!d) return true;
  if (s->d->delay_times(&s->data, d->at_node)) return fmu_done(f, rt_fail_model(s, s->t, "computing delays"));
  for (int k = 0; k < d->n; k++)
    if (d->at_node[k] != d->seconds[k])
      return fmu_refuse(f, "delay() number %d cannot be tuned in a run: %.9g s, not %.9g s", k + 1, d->seconds[k],
                        d->at_node[k]);
  return true;
}

/* What depends on parameters that were set. */
bool fmu_retune(fmu *f) {
  rt_session *s = f->session;
  memcpy(s->data.p, s->p_run, (size_t)s->d->n_p * sizeof *s->p_run);
  if (s->d->parameters(&s->data)) return fmu_done(f, rt_fail_model(s, s->t, "computing parameters"));
  rt_status status = rt_check_parameters(s);
  if (!status) status = rt_scale_parameters(s);
  if (status) return fmu_done(f, status);
  rt_scale_start(s);
  f->untuned = f->fresh = false;
  return keeps_delays(f) && reset_clocks(f);
}

/* What is pending happens, and what follows from inputs and parameters that were set. */
bool fmu_happen(fmu *f, fmu_news *news) {
  rt_session *s = f->session;
  *news = (fmu_news){false};
  if (f->retuned) {
    s->pending |= RT_PENDING_JUMP;
    news->nominals_changed = true;
    if (f->untuned && !fmu_retune(f)) return false;
    f->retuned = false;
  }
  if (f->driven) s->pending |= RT_PENDING_JUMP;
  if (s->pending) {
    s->input_time = NAN;
    /* An importer's solver is as exact as it likes: a guard that hardly moves is no chattering while time goes on. */
    if (!f->co_simulation && s->t - s->last_event > s->clock.tolerance) s->futile_events = 0;
    if (!fmu_done(f, rt_happen(s))) return false;
    news->states_changed = memcmp(s->x_before, s->data.x, (size_t)s->d->n_x * sizeof(double)) != 0;
    s->resume = false; /* the importer decides how far the next step goes */
  }
  s->result->n_events = 0;
  f->driven = false;
  f->fresh = true;
  news->terminate = s->data.terminated != 0;
  news->next = rt_clock_next(s);
  news->next_defined = isfinite(news->next);
  return true;
}

bool fmu_set_time(fmu *f, double time) {
  rt_session *s = f->session;
  if (!isfinite(time)) return fmu_refuse(f, "time is %g", time);
  if (time != s->t) f->fresh = false;
  s->t = s->t_end = time;
  s->stop = rt_max(s->stop, time);
  return true;
}

static bool counts(fmu *f, size_t n, int wanted) {
  return n == (size_t)wanted || fmu_refuse(f, "%zu values where there are %d", n, wanted);
}

bool fmu_set_states(fmu *f, size_t n, const double *x) {
  if (!counts(f, n, f->session->d->n_x)) return false;
  memcpy(f->session->data.x, x, (size_t)f->session->d->n_x * sizeof *x);
  f->fresh = false;
  return true;
}

bool fmu_states(fmu *f, size_t n, double *x) {
  if (!counts(f, n, f->session->d->n_x) || !fmu_refresh(f)) return false;
  memcpy(x, f->session->data.x, n * sizeof *x);
  return true;
}

bool fmu_derivatives(fmu *f, size_t n, double *xdot) {
  if (!counts(f, n, f->session->d->n_x) || !fmu_refresh(f)) return false;
  memcpy(xdot, f->session->data.xdot, n * sizeof *xdot);
  return true;
}

/* Positive while a relation that holds goes on holding, negative while one that does not goes on not holding. */
bool fmu_indicators(fmu *f, size_t n, double *z) {
  rt_session *s = f->session;
  if (!counts(f, n, f->n_indicators) || !fmu_refresh(f)) return false;
  for (int i = 0; i < f->n_indicators; i++) {
    int r = f->indicator[i];
    double keeps = margin(s, r);
    z[i] = s->data.rel[r] ? keeps : -keeps;
    if (keeps > 0) rt_extend_guard(s, r, fabs(s->g[r])); /* how far it goes may be seen here only */
  }
  return true;
}

/* A step of the importer is accepted. An event that it has not seen is one of this step. */
bool fmu_completed_step(fmu *f, bool *event, bool *terminate) {
  rt_session *s = f->session;
  *event = false;
  if (!fmu_refresh(f)) return false;
  for (int i = 0; i < f->n_indicators; i++)
    *event |= has_switched(s, f->indicator[i]);
  if (!*event) begin_step(f);
  s->steps_taken++;
  *terminate = s->data.terminated != 0;
  rt_status status = rt_check_asserts(s);
  return fmu_done(f, status || *event ? status : rt_check_point(s, true));
}

/* Back to where time goes on. */
bool fmu_leave_event(fmu *f) {
  if (f->mode != FMU_EVENT) return fmu_refuse(f, "only event mode is left this way");
  fmu_news news;
  if ((f->retuned || f->driven) && !fmu_happen(f, &news)) return false;
  if (!fmu_refresh(f)) return false;
  begin_step(f);
  f->mode = f->co_simulation ? FMU_STEP : FMU_CONTINUOUS;
  return true;
}

bool fmu_nominals(fmu *f, size_t n, double *nominals) {
  if (!counts(f, n, f->session->d->n_x) || !fmu_refresh(f)) return false;
  for (size_t i = 0; i < n; i++) {
    double size = f->session->nominal[i];
    nominals[i] = size > 0 && isfinite(size) ? size : 1;
  }
  return true;
}
