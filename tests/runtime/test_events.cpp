// Events with known instants: bouncing, impacts of a driven oscillator, time and sample events.
#include <algorithm>

#include "hand_model.h"

namespace {

using namespace hand;

// A ball of height h and speed v that keeps 80 % of its speed at each impact.
struct Ball : HandModel {
  static constexpr int n_x = 2, n_rel = 1, n_when = 1;
  static constexpr double g = 9.81, keep = 0.8;
  static std::vector<mdl_variable> variables() { return {variable("h", MDL_STATE, 0, 1), variable("v", MDL_STATE, 1)}; }
  static int rhs(mdl_data *, double, const double *x, double *xdot, double *) {
    xdot[0] = x[1];
    xdot[1] = -g;
    return 0;
  }
  static int roots(mdl_data *, double, const double *x, const double *, const double *, double *guard) {
    guard[0] = -x[0];
    return 0;
  }
  static int event(mdl_data *m, double, double *x, const double *, const double *) {
    if (m->rel[0] && !m->when[0] && !m->initial) {
      x[1] = -keep * x[1];
      m->reinitialised = 1;
    }
    m->when[0] = m->rel[0];
    return 0;
  }
  static double impact(int n) { // time of the n-th impact, n >= 1
    double fall = std::sqrt(2 / g), t = fall;
    for (int k = 1; k < n; k++)
      t += 2 * fall * std::pow(keep, k);
    return t;
  }
};

// x'' = -x + cos 2t, thrown back at x = -0.5 with 80 % of the speed.
struct Impacts : HandModel {
  static constexpr int n_x = 2, n_rel = 1, n_when = 1;
  static std::vector<mdl_variable> variables() { return {variable("x", MDL_STATE, 0, 1), variable("v", MDL_STATE, 1)}; }
  static int rhs(mdl_data *, double t, const double *x, double *xdot, double *) {
    xdot[0] = x[1];
    xdot[1] = -x[0] + std::cos(2 * t);
    return 0;
  }
  static int roots(mdl_data *, double, const double *x, const double *, const double *, double *guard) {
    guard[0] = -0.5 - x[0];
    return 0;
  }
  static int event(mdl_data *m, double, double *x, const double *, const double *) {
    if (m->rel[0] && !m->when[0] && !m->initial) {
      x[1] = -0.8 * x[1];
      m->reinitialised = 1;
    }
    m->when[0] = m->rel[0];
    return 0;
  }
};

// Two guards that cross at the same instant, and one that crosses later in the same step.
struct Together : HandModel {
  static constexpr int n_x = 1, n_d = 3, n_rel = 3;
  static std::vector<mdl_variable> variables() {
    return {variable("x", MDL_STATE, 0), variable("a", MDL_DISCRETE, 0), variable("b", MDL_DISCRETE, 1),
            variable("c", MDL_DISCRETE, 2)};
  }
  static int rhs(mdl_data *, double, const double *, double *xdot, double *) {
    xdot[0] = 1;
    return 0;
  }
  static int roots(mdl_data *, double, const double *x, const double *, const double *, double *guard) {
    guard[0] = x[0] - 0.5;
    guard[1] = 2 * x[0] - 1;
    guard[2] = x[0] - 0.51;
    return 0;
  }
  static int event(mdl_data *m, double, double *, const double *, const double *) {
    for (int r = 0; r < 3; r++)
      m->d[r] = m->rel[r];
    return 0;
  }
};

// x' = 1 before 0.3 s and -1 after; count at 0, 0.1, 0.2 ... s.
struct Clocked : HandModel {
  static constexpr int n_x = 1, n_d = 1, n_rel = 1, n_sample = 1, n_when = 1, time_relation = 0;
  static constexpr double switch_time = 0.3;
  static std::vector<mdl_variable> variables() {
    return {variable("x", MDL_STATE, 0), variable("count", MDL_DISCRETE, 0)};
  }
  static int samples(const mdl_data *, double *start, double *interval) {
    start[0] = 0;
    interval[0] = 0.1;
    return 0;
  }
  static int rhs(mdl_data *m, double, const double *, double *xdot, double *) {
    xdot[0] = m->rel[0] ? -1 : 1;
    return 0;
  }
  static int time_relations(mdl_data *m, double t) {
    m->rel[0] = t >= switch_time;
    return 0;
  }
  static double next_time_event(const mdl_data *, double t) { return t < switch_time ? switch_time : infinity; }
  static int event(mdl_data *m, double, double *, const double *, const double *) {
    m->d[0] = m->pre_d[0] + (m->tick[0] && !m->when[0] ? 1 : 0);
    m->when[0] = m->tick[0];
    return 0;
  }
};

class Events : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Events, testing::ValuesIn(variable_step_solvers()),
                         [](const auto &i) { return i.param; });

TEST_P(Events, BallBouncesWhenItShould) {
  Result result = simulate<Ball>({.solver = GetParam()}, Ball::impact(8) + 0.01);
  ASSERT_EQ(result.failure().status, RT_OK) << result.failure().message;
  std::vector<rt_event_entry> impacts;
  for (const rt_event_entry &e : result.events())
    if (e.direction > 0) impacts.push_back(e);
  ASSERT_EQ(impacts.size(), 8u);
  for (int k = 0; k < 8; k++)
    EXPECT_NEAR(impacts[k].time, Ball::impact(k + 1), 1e-7);
}

TEST_P(Events, BallKeepsItsEnergyBetweenImpacts) {
  Result result = simulate<Ball>({.solver = GetParam()}, Ball::impact(5), 0.001);
  int impacts = 0;
  for (size_t k = 0; k < result.rows(); k++) {
    if (k > 0 && result.is_event(k) && result.time(k) == result.time(k - 1) && result.at(1, k) > 0 &&
        result.at(1, k - 1) < 0)
      impacts++;
    double energy = Ball::g * result.at(0, k) + 0.5 * result.at(1, k) * result.at(1, k);
    EXPECT_NEAR(energy, Ball::g * std::pow(Ball::keep, 2 * impacts), 1e-6);
  }
  EXPECT_GE(impacts, 4);
}

TEST_P(Events, BallThatBouncesForeverIsReportedBeforeItFallsThrough) {
  double rest = Ball::impact(1000);
  Result result = simulate<Ball>({.solver = GetParam()}, 2 * rest);
  EXPECT_EQ(result.failure().status, RT_CHATTERING) << result.failure().message;
  EXPECT_NEAR(result.failure().time, rest, 1e-4);
  for (size_t k = 0; k < result.rows(); k++)
    EXPECT_GT(result.at(0, k), -1e-8);
}

TEST_P(Events, GuardsThatCrossTogetherAreOneEvent) {
  Result result = simulate<Together>({.solver = GetParam()}, 1);
  auto events = result.events();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].time, events[1].time);
  EXPECT_NEAR(events[0].time, 0.5, 1e-9);
  EXPECT_EQ(events[2].index, 2);
  EXPECT_NEAR(events[2].time, 0.51, 1e-9);
  EXPECT_EQ(result.last(1) + result.last(2) + result.last(3), 3);
}

TEST_P(Events, TimeEventsHappenExactlyOnTime) {
  Result result = simulate<Clocked>({.solver = GetParam()}, 1);
  ASSERT_EQ(result.failure().status, RT_OK) << result.failure().message;
  EXPECT_NEAR(result.last(0), 0.3 - 0.7, 1e-12);
  EXPECT_EQ(result.last(1), 11); // ticks at both ends of the run
  EXPECT_EQ(result.counters().time_events, 1);
  auto events = result.events();
  auto at = std::find_if(events.begin(), events.end(), [](const rt_event_entry &e) { return e.kind == RT_EVENT_TIME; });
  ASSERT_NE(at, events.end());
  EXPECT_EQ(at->time, 0.3);
}

TEST(EventOrder, IsKeptWhenEventsAreLocatedAndFallsToOneWhenNot) {
  double exact = simulate<Impacts>({.solver = "dopri5", .rtol = 1e-13, .atol = 1e-14}, 6).last(0);
  auto error = [&](const char *solver, double step, bool locate) {
    Result result = simulate<Impacts>({.solver = solver, .step = step, .locate = locate}, 6);
    EXPECT_GT(result.counters().state_events, 2);
    return std::fabs(result.last(0) - exact);
  };
  EXPECT_GT(std::log2(error("rk4", 0.04, true) / error("rk4", 0.01, true)) / 2, 3.8);
  // its dense output is of order 3, which is what an event sees
  EXPECT_GT(std::log2(error("rodas4", 0.04, true) / error("rodas4", 0.01, true)) / 2, 3);
  EXPECT_GT(std::log2(error("dopri5", 0.08, true) / error("dopri5", 0.02, true)) / 2, 4);
  EXPECT_NEAR(std::log2(error("euler", 4e-4, true) / error("euler", 1e-4, true)) / 2, 1, 0.15);
  EXPECT_NEAR(std::log2(error("rk4", 1e-2, false) / error("rk4", 1e-2 / 64, false)) / 6, 1, 0.5);
}

TEST(EventTimes, AgreeBetweenSolversWithinTenTimesTheTolerance) {
  for (double rtol : {1e-5, 1e-7, 1e-9}) {
    auto exact = simulate<Impacts>({.solver = "dopri5", .rtol = 1e-13, .atol = 1e-14}, 6).events();
    for (const std::string &solver : variable_step_solvers()) {
      auto events = simulate<Impacts>({.solver = solver, .rtol = rtol, .atol = 0.01 * rtol}, 6).events();
      ASSERT_EQ(events.size(), exact.size()) << solver << " at " << rtol;
      for (size_t k = 0; k < exact.size(); k++)
        EXPECT_NEAR(events[k].time, exact[k].time, 10 * rtol * 6) << solver;
    }
  }
}

TEST(EventCounters, TellKindsApart) {
  Result result = simulate<Clocked>({}, 1);
  EXPECT_EQ(result.counters().sample_events, 11);
  EXPECT_EQ(result.counters().state_events, 0);
  EXPECT_EQ(result.counters().restarts, 1); // a tick that changes no derivative restarts nothing
}

TEST(WithoutLocation, EventsFallOnStepEnds) {
  Result result = simulate<Ball>({.solver = "rk4", .step = 0.01, .locate = false}, 2);
  ASSERT_GT(result.counters().state_events, 2);
  for (const rt_event_entry &e : result.events())
    EXPECT_NEAR(std::remainder(e.time, 0.01), 0, 1e-12);
}

} // namespace
