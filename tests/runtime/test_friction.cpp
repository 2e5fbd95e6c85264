// Dry friction against closed forms: stick-slip on a belt, and a braked mass that sticks for good.
#include "hand_model.h"

namespace {

using namespace hand;

constexpr double pi = 3.14159265358979323846;

// A mass held by a spring on a belt that moves at V: sticks until the spring pulls with Fs, slides with Fk until it
// moves with the belt.
struct Belt : HandModel {
  static constexpr int n_x = 2, n_d = 1, n_rel = 2, n_when = 2;
  static constexpr double k = 100, mass = 1, V = 0.1, Fs = 4, Fk = 3;
  static std::vector<mdl_variable> variables() {
    return {variable("x", MDL_STATE, 0), variable("v", MDL_STATE, 1, V), variable("stick", MDL_DISCRETE, 0, 1)};
  }
  static int rhs(mdl_data *m, double, const double *x, double *xdot, double *) {
    xdot[0] = x[1];
    xdot[1] = m->d[0] != 0 ? 0 : (Fk - k * x[0]) / mass;
    return 0;
  }
  static int roots(mdl_data *, double, const double *x, const double *, const double *, double *guard) {
    guard[0] = k * x[0] - Fs;
    guard[1] = x[1] - V;
    return 0;
  }
  static int event(mdl_data *m, double, double *x, const double *, const double *) {
    m->d[0] = m->pre_d[0];
    if (m->pre_d[0] != 0 && m->rel[0] && !m->when[0]) m->d[0] = 0;
    if (m->pre_d[0] == 0 && m->rel[1] && !m->when[1]) {
      m->d[0] = 1;
      x[1] = V;
      m->reinitialised = 1;
    }
    m->when[0] = m->pre_d[0] != 0 && m->rel[0];
    m->when[1] = m->pre_d[0] == 0 && m->rel[1];
    return 0;
  }
  static double slip_time() {
    double w = std::sqrt(k / mass), a = (Fs - Fk) / k;
    return (2 * pi - 2 * std::atan(a * w / V)) / w;
  }
  static double stick_time() { return 2 * (Fs - Fk) / (k * V); }
};

// A braked mass: Coulomb friction stops it, and it sticks for good. mode: 1 sliding, 0 stuck.
struct Brake : HandModel {
  static constexpr int n_x = 2, n_d = 1, n_rel = 1;
  static std::vector<mdl_variable> variables() {
    return {variable("s", MDL_STATE, 0), variable("v", MDL_STATE, 1, 2), variable("mode", MDL_DISCRETE, 0, 1)};
  }
  static int rhs(mdl_data *m, double, const double *x, double *xdot, double *) {
    xdot[0] = m->d[0] != 0 ? x[1] : 0;
    xdot[1] = m->d[0] != 0 ? -4 : 0;
    return 0;
  }
  static int roots(mdl_data *, double, const double *x, const double *, const double *, double *guard) {
    guard[0] = x[1];
    return 0;
  }
  static int event(mdl_data *m, double, double *x, const double *, const double *) {
    m->d[0] = m->pre_d[0] != 0 && m->rel[0];
    if (m->d[0] == 0 && m->pre_d[0] != 0) {
      x[1] = 0;
      m->reinitialised = 1;
    }
    return 0;
  }
};

class Friction : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Friction, testing::ValuesIn(variable_step_solvers()),
                         [](const auto &i) { return i.param; });

TEST_P(Friction, BeltGivesStickAndSlipTimesOfTheClosedForm) {
  Result result = simulate<Belt>({.solver = GetParam()}, 5);
  ASSERT_EQ(result.failure().status, RT_OK) << result.failure().message;
  double release = Belt::Fs / (Belt::k * Belt::V), period = Belt::slip_time() + Belt::stick_time();
  std::vector<double> releases, catches;
  for (const rt_event_entry &e : result.events())
    if (e.direction > 0) (e.index == 0 ? releases : catches).push_back(e.time);
  ASSERT_EQ(releases.size(), static_cast<size_t>((5 - release) / period) + 1);
  for (size_t k = 0; k < releases.size(); k++)
    EXPECT_NEAR(releases[k], release + static_cast<double>(k) * period, 1e-6);
  for (size_t k = 0; k < catches.size(); k++)
    EXPECT_NEAR(catches[k] - releases[k], Belt::slip_time(), 1e-6);
}

TEST_P(Friction, StuckMassDoesNotCreep) {
  Result result = simulate<Brake>({.solver = GetParam()}, 100);
  ASSERT_EQ(result.failure().status, RT_OK) << result.failure().message;
  ASSERT_EQ(result.counters().state_events, 1);
  EXPECT_NEAR(result.events()[0].time, 0.5, 1e-9);
  EXPECT_EQ(result.last(1), 0);
  size_t row = 0;
  while (result.at(2, row) != 0)
    row++;
  EXPECT_EQ(result.last(0), result.at(0, row));
}

} // namespace
