// Guards that are told to be far from zero by how far states move: what a run computes must not depend on it.
#include <algorithm>

#include "hand_model.h"

namespace {

using namespace hand;

// Two oscillators and guards of one state, of two, and of a state and the time; each switching pushes the first.
struct Watched : HandModel {
  static constexpr int n_x = 4, n_rel = 3, n_d = 1;
  static std::vector<mdl_variable> variables() {
    return {variable("a", MDL_STATE, 0, 1), variable("va", MDL_STATE, 1), variable("b", MDL_STATE, 2, 0.3),
            variable("vb", MDL_STATE, 3)};
  }
  static int rhs(mdl_data *m, double t, const double *x, double *xdot, double *) {
    xdot[0] = x[1];
    xdot[1] = -40 * x[0] + (m->rel[0] ? 3 : -2) + std::sin(3 * t);
    xdot[2] = x[3];
    xdot[3] = -2000 * x[2] - x[3] + 100 * (m->rel[1] ? 1 : -1) + (m->rel[2] ? 20 : 0);
    return 0;
  }
  static void moved(double t, const double *x, double *g) {
    g[0] = x[0];
    g[1] = x[0] - 2 * x[2];
    g[2] = x[2] + 0.1 * t;
  }
  static int roots(mdl_data *, double t, const double *x, const double *, const double *, double *g) {
    moved(t, x, g);
    g[0] -= 0.4;
    g[2] -= 0.25;
    return 0;
  }
};

long calls, refused;

int rates(mdl_data *, double t, const double *x, double *g) {
  calls++;
  Watched::moved(t, x, g);
  return 0;
}

// As a model whose slopes cannot be asked for: not in the direction of one state, or of the time, alone.
int rates_of_steps(mdl_data *m, double t, const double *x, double *g) {
  bool still = t == 0 || t == 1;
  for (int i = 0; i < Watched::n_x; i++)
    still = still && (x[i] == 0 || x[i] == 1);
  if (still && t + x[0] + x[1] + x[2] + x[3] == 1) {
    refused++;
    return 1;
  }
  return rates(m, t, x, g);
}

Result run(int (*guard_rates)(mdl_data *, double, const double *, double *), const char *solver) {
  static const unsigned char affine[] = {1, 1, 1};
  mdl_descriptor d = *Generated<Watched>::descriptor();
  d.affine_guards = affine;
  d.guard_rates = guard_rates;
  char message[200] = "";
  rt_model *model = rt_model_wrap(&d, message, sizeof message);
  rt_options options = {};
  options.solver = solver;
  options.rtol = 1e-7;
  options.locate_events = 1;
  rt_session *session = rt_session_new(model, &options, message, sizeof message);
  const int rows[] = {0, 1, 2, 3};
  rt_session_outputs(session, 4, rows);
  rt_session_grid(session, 0, nullptr, 0);
  Result result{std::shared_ptr<rt_result>(rt_session_run(session, 0, 10), rt_result_free)};
  rt_session_free(session);
  rt_model_close(model);
  return result;
}

TEST(GuardsFarAway, ChangeNothingButTheWork) {
  for (const char *solver : {"dopri5", "ida", "rodas4"}) {
    calls = refused = 0;
    Result asked = run(rates, solver);
    long with = calls;
    Result without = run(rates_of_steps, solver);
    long all = calls - with;
    ASSERT_EQ(asked.failure().status, RT_OK) << asked.failure().message;
    EXPECT_GT(asked.counters().state_events, 50);
    EXPECT_GT(refused, 0);
    EXPECT_LT(with, 0.9 * static_cast<double>(all)) << solver;
    ASSERT_EQ(asked.rows(), without.rows()) << solver;
    for (size_t row = 0; row < asked.rows(); row++) {
      ASSERT_EQ(asked.time(row), without.time(row)) << solver;
      for (int j = 0; j < Watched::n_x; j++)
        ASSERT_EQ(asked.at(j, row), without.at(j, row)) << solver;
    }
    EXPECT_EQ(asked.counters().rhs, without.counters().rhs) << solver;
  }
}

} // namespace
