// Recorded inputs, linear and held, against the exact answer of a first-order lag x' = -x + u.
#include "hand_model.h"

namespace {

using namespace hand;

struct Lag : HandModel {
  static constexpr int n_u = 1;
  static std::vector<mdl_variable> variables() { return {variable("x", MDL_STATE, 0), variable("u", MDL_INPUT, 0)}; }
  static int rhs(mdl_data *m, double, const double *x, double *xdot, double *) {
    xdot[0] = m->u[0] - x[0];
    return 0;
  }
};

// The lag with a relation on its input: on = u > 0.5.
struct Watched : Lag {
  static constexpr int n_rel = 1, n_d = 1;
  static std::vector<mdl_variable> variables() {
    return {variable("x", MDL_STATE, 0), variable("u", MDL_INPUT, 0), variable("on", MDL_DISCRETE, 0)};
  }
  static int roots(mdl_data *m, double, const double *, const double *, const double *, double *g) {
    g[0] = m->u[0] - 0.5;
    return 0;
  }
  static int event(mdl_data *m, double, double *, const double *, const double *) {
    m->d[0] = m->rel[0];
    return 0;
  }
};

struct Samples {
  std::vector<double> time, values;

  static Samples sine(int n, double dt) { // rough: every sample is a kink or a jump
    Samples s;
    for (int k = 0; k <= n; k++) {
      s.time.push_back(k * dt);
      s.values.push_back(std::sin(40 * s.time[k]) + 0.3 * std::cos(700.0 * k));
    }
    return s;
  }

  // x at the last sample, exactly, sample by sample.
  double lag(rt_interpolation interpolation) const {
    double x = 0;
    for (size_t k = 0; k + 1 < time.size(); k++) {
      double dt = time[k + 1] - time[k], u = values[k];
      double slope = interpolation == RT_LINEAR ? (values[k + 1] - u) / dt : 0;
      x = u + slope * dt - slope + (x - u + slope) * std::exp(-dt); // x' = -x + u + slope s
    }
    return x;
  }
};

template <class M>
Result drive(const Options &options, const Samples &s, rt_interpolation interpolation, double interval = 0) {
  Session<M> session(options);
  EXPECT_EQ(rt_session_input(session.get(), 1, static_cast<int>(s.time.size()), s.time.data(), s.values.data(),
                             interpolation),
            RT_OK);
  return session.run(s.time.back(), interval);
}

class Inputs : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Inputs, testing::ValuesIn(variable_step_solvers()),
                         [](const auto &i) { return i.param; });

TEST_P(Inputs, HeldSamplesGiveTheExactAnswer) {
  Samples s = Samples::sine(500, 1e-3);
  Result result = drive<Lag>({.solver = GetParam(), .rtol = 1e-8, .atol = 1e-10}, s, RT_HOLD);
  ASSERT_EQ(result.failure().status, RT_OK) << result.failure().message;
  EXPECT_NEAR(result.last(0), s.lag(RT_HOLD), 1e-7);
}

TEST_P(Inputs, LinearSamplesGiveTheExactAnswer) {
  Samples s = Samples::sine(500, 1e-3);
  Result result = drive<Lag>({.solver = GetParam(), .rtol = 1e-8, .atol = 1e-10}, s, RT_LINEAR);
  ASSERT_EQ(result.failure().status, RT_OK) << result.failure().message;
  EXPECT_NEAR(result.last(0), s.lag(RT_LINEAR), 1e-7);
}

TEST(InputCost, OneStepMethodsTakeOneStepASample) {
  for (rt_interpolation interpolation : {RT_LINEAR, RT_HOLD}) {
    Result result =
        drive<Lag>({.solver = "dopri5", .rtol = 1e-6, .atol = 1e-8}, Samples::sine(500, 1e-3), interpolation);
    EXPECT_LT(result.counters().steps, 515);
    EXPECT_LT(result.counters().error_test_fails, 5);
  }
}

TEST(InputOrder, IsKeptOverKinksAndJumps) {
  Samples s = Samples::sine(10, 0.1);
  for (rt_interpolation interpolation : {RT_LINEAR, RT_HOLD}) {
    auto error = [&](double step) {
      return std::fabs(drive<Lag>({.solver = "rk4", .step = step}, s, interpolation).last(0) - s.lag(interpolation));
    };
    EXPECT_GT(std::log2(error(0.07) / error(0.07 / 4)) / 2, 3.7); // the steps do not divide the sampling interval
  }
}

TEST(InputSamples, ThatDoNotChangeCostNothing) {
  Samples constant;
  for (int k = 0; k <= 1000; k++) {
    constant.time.push_back(k * 1e-3);
    constant.values.push_back(1 + (k >= 500));
  }
  for (const std::string &solver : variable_step_solvers()) {
    Result result = drive<Lag>({.solver = solver}, constant, RT_HOLD);
    EXPECT_EQ(result.counters().input_jumps, 1);
    EXPECT_LT(result.counters().steps, 200);
  }
}

TEST(InputSamples, HoldTheirFirstAndLastValueOutside) {
  Samples late = {{1, 2}, {3, 5}};
  Session<Lag> session({.solver = "dopri5"});
  rt_session_input(session.get(), 1, 2, late.time.data(), late.values.data(), RT_LINEAR);
  Result result = session.run(4, 0.5);
  for (size_t k = 0; k < result.rows(); k++)
    EXPECT_NEAR(result.at(1, k), 3 + 2 * std::fmin(1, std::fmax(0, result.time(k) - 1)), 1e-12);
}

TEST(InputSamples, AreRecordedAsGiven) {
  Samples s = Samples::sine(50, 1e-2);
  for (const char *solver : {"ida", "dopri5"}) {
    for (rt_interpolation interpolation : {RT_LINEAR, RT_HOLD}) {
      Result result = drive<Lag>({.solver = solver}, s, interpolation, 1e-2);
      ASSERT_EQ(result.rows(), 51u);
      for (size_t k = 0; k + 1 < result.rows(); k++)
        EXPECT_NEAR(result.at(1, k), s.values[k], 1e-10);
    }
  }
}

TEST_P(Inputs, AreTheSameInEveryRunOfASession) {
  for (rt_interpolation interpolation : {RT_LINEAR, RT_HOLD}) {
    Samples s = {{0, 0.3, 0.6, 1}, {0, 0, 1, 1}};
    Session<Lag> session({.solver = GetParam()});
    rt_session_input(session.get(), 1, 4, s.time.data(), s.values.data(), interpolation);
    Result first = session.run(1), again = session.run(1);
    EXPECT_EQ(again.last(0), first.last(0));
    EXPECT_EQ(again.counters().steps, first.counters().steps);
  }
}

TEST_P(Inputs, CrossingsOfAnInputAreEvents) {
  Samples ramp = {{0, 1, 2}, {0, 1, 0}};
  auto events = drive<Watched>({.solver = GetParam()}, ramp, RT_LINEAR).events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_NEAR(events[0].time, 0.5, 1e-9);
  EXPECT_NEAR(events[1].time, 1.5, 1e-9);
}

TEST_P(Inputs, JumpsSwitchRelationsAtOnce) {
  Samples pulse = {{0, 1, 1.001}, {0, 1, 0}};
  Result result = drive<Watched>({.solver = GetParam()}, {{0, 1, 1.001, 2}, {0, 1, 0, 0}}, RT_HOLD, 0.0005);
  ASSERT_EQ(result.failure().status, RT_OK) << result.failure().message;
  for (size_t k = 0; k < result.rows(); k++)
    EXPECT_EQ(result.at(2, k), result.time(k) > 0.9999 && result.time(k) < 1.0009) << result.time(k);
}

TEST(InputErrors, NameTheInputAndTheTime) {
  Session<Lag> session;
  double time[] = {0, 1, 1}, values[] = {0, 1, NAN};
  EXPECT_EQ(rt_session_input(session.get(), 1, 3, time, values, RT_LINEAR), RT_ARGUMENT);
  EXPECT_NE(std::string(rt_session_failure(session.get())->message).find("input u: time does not increase at 1 s"),
            std::string::npos);
  time[2] = 2;
  EXPECT_EQ(rt_session_input(session.get(), 1, 3, time, values, RT_LINEAR), RT_ARGUMENT);
  EXPECT_EQ(rt_session_input(session.get(), 0, 2, time, values, RT_LINEAR), RT_ARGUMENT);
}

} // namespace
