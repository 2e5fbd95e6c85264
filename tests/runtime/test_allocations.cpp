// Every allocation of the runtime fails once: the run says so.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>

#include "hand_model.h"

extern "C" {
void *__libc_malloc(std::size_t size);
void *__libc_calloc(std::size_t count, std::size_t size);
void *__libc_realloc(void *old, std::size_t size);
}

namespace {

long allowed = -1; // allocations until one fails; below zero: none does

// Those of the runtime itself: SUNDIALS 6.4 crashes where its own fail.
bool fails(void *caller) {
  Dl_info from;
  if (allowed < 0 || !dladdr(caller, &from) || !std::strstr(from.dli_fname, "lacuna_runtime")) return false;
  return allowed-- == 0;
}

} // namespace

// These take the place of the C library's for the runtime, too.
extern "C" {
void *malloc(std::size_t size) {
  return fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size);
}
void *calloc(std::size_t count, std::size_t size) {
  return fails(__builtin_return_address(0)) ? nullptr : __libc_calloc(count, size);
}
void *realloc(void *old, std::size_t size) {
  return fails(__builtin_return_address(0)) ? nullptr : __libc_realloc(old, size);
}
}

namespace {

using namespace hand;

// A ball that bounces: x' = v, v' = -9.81, v := -v/2 at x < 0; an input adds to the force.
struct Ball : HandModel {
  static constexpr int n_x = 2, n_u = 1, n_rel = 1, n_when = 1;
  static std::vector<mdl_variable> variables() {
    return {variable("x", MDL_STATE, 0, 1), variable("v", MDL_STATE, 1), variable("u", MDL_INPUT, 0)};
  }
  static int rhs(mdl_data *m, double, const double *x, double *xdot, double *) {
    xdot[0] = x[1];
    xdot[1] = m->u[0] - 9.81;
    return 0;
  }
  static int roots(mdl_data *, double, const double *x, const double *, const double *, double *g) {
    g[0] = -x[0];
    return 0;
  }
  static int event(mdl_data *m, double, double *x, const double *, const double *) {
    if (m->rel[0] && !m->when[0]) {
      x[1] = -x[1] / 2;
      m->reinitialised = 1;
    }
    m->when[0] = m->rel[0];
    return 0;
  }
};

struct Outcome {
  bool refused = false;
  int status = RT_OK;
  double last = 0;
};

Outcome run(const char *solver) {
  static const double time[] = {0, 0.5, 1}, values[] = {0, 1, 0};
  static const int outputs[] = {0, 1};
  char message[600];
  Outcome outcome;
  rt_model *model = rt_model_wrap(Generated<Ball>::descriptor(), message, sizeof message);
  const rt_options options = {solver, 1e-6, 1e-8, 1e-3, 0, 1, 1, 0, 0, 0};
  rt_session *session = model ? rt_session_new(model, &options, message, sizeof message) : nullptr;
  rt_result *result = nullptr;
  if (session && !rt_session_outputs(session, 2, outputs) && !rt_session_grid(session, 0, nullptr, 0.01) &&
      !rt_session_input(session, 2, 3, time, values, RT_LINEAR))
    result = rt_session_run(session, 0, 1);
  outcome.refused = !result;
  if (result) {
    outcome.status = rt_result_failure(result)->status;
    const std::size_t rows = rt_result_rows(result);
    if (rows) outcome.last = rt_result_column(result, 0)[rows - 1];
    rt_result_free(result);
  }
  if (session) rt_session_free(session);
  if (model) rt_model_close(model);
  return outcome;
}

} // namespace

class Allocations : public testing::TestWithParam<const char *> {};

TEST_P(Allocations, FailOneByOneWithoutACrash) {
  const Outcome good = run(GetParam());
  ASSERT_EQ(good.status, RT_OK);
  int failed = 0, number = 0;
  for (bool reached = true; reached; ++number) {
    allowed = number;
    const Outcome outcome = run(GetParam());
    reached = allowed < 0;
    allowed = -1;
    if (outcome.refused || outcome.status != RT_OK)
      ++failed;
    else
      EXPECT_EQ(outcome.last, good.last) << number;
  }
  EXPECT_GT(number, 5);
  EXPECT_EQ(failed, number - 1); // all but the last, in which none failed
}

INSTANTIATE_TEST_SUITE_P(Solvers, Allocations, testing::Values("ida", "dopri5", "rodas4", "rk4"),
                         [](const auto &name) { return std::string(name.param); });
