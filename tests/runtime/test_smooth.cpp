// Smooth problems with known solutions: order of convergence, accuracy against tolerance, stiffness, dense output.
#include "hand_model.h"

namespace {

using namespace hand;

// x' = -x + y cos t, y' = sin(t) - x y: nonlinear and driven, without events.
struct Driven : HandModel {
  static constexpr int n_x = 2;
  static std::vector<mdl_variable> variables() {
    return {variable("x", MDL_STATE, 0, 1), variable("y", MDL_STATE, 1, 0.5)};
  }
  static int rhs(mdl_data *, double t, const double *x, double *xdot, double *) {
    xdot[0] = -x[0] + x[1] * std::cos(t);
    xdot[1] = std::sin(t) - x[0] * x[1];
    return 0;
  }
};

// Prothero-Robinson: x' = -1e6 (x - cos t) - sin t; the solution is cos t.
struct Stiff : HandModel {
  static std::vector<mdl_variable> variables() { return {variable("x", MDL_STATE, 0, 1)}; }
  static int rhs(mdl_data *, double t, const double *x, double *xdot, double *) {
    xdot[0] = -1e6 * (x[0] - std::cos(t)) - std::sin(t);
    return 0;
  }
};

// Series RLC after a voltage step, with the inductor voltage as an algebraic unknown of the residual form.
struct Rlc : HandModel {
  static constexpr int n_x = 2, n_z = 1, n_v = 1;
  static constexpr double R = 1, L = 1e-3, C = 1e-5, U = 5;
  static std::vector<int> z_index() { return {0}; }
  static std::vector<mdl_variable> variables() {
    return {variable("i", MDL_STATE, 0), variable("uC", MDL_STATE, 1), variable("uL", MDL_ALGEBRAIC, 0)};
  }
  static int rhs(mdl_data *, double, const double *x, double *xdot, double *v) {
    v[0] = U - R * x[0] - x[1];
    xdot[0] = v[0] / L;
    xdot[1] = x[0] / C;
    return 0;
  }
  static double capacitor(double t) {
    double a = R / (2 * L), w = std::sqrt(1 / (L * C) - a * a);
    return U * (1 - std::exp(-a * t) * (std::cos(w * t) + a / w * std::sin(w * t)));
  }
};

// 60 coupled masses in a row: large enough for the sparse solver.
struct Chain : HandModel {
  static constexpr int n_x = 60;
  static std::vector<mdl_variable> variables() {
    static const std::vector<std::string> names = [] {
      std::vector<std::string> all;
      for (int i = 0; i < n_x; i++)
        all.push_back("x" + std::to_string(i));
      return all;
    }();
    std::vector<mdl_variable> list;
    for (int i = 0; i < n_x; i++)
      list.push_back(variable(names[i].c_str(), MDL_STATE, i, i == 0));
    return list;
  }
  static int rhs(mdl_data *, double, const double *x, double *xdot, double *) {
    for (int i = 0; i < n_x; i++)
      xdot[i] = (i ? x[i - 1] : 0) - 2 * x[i] + (i + 1 < n_x ? x[i + 1] : 0);
    return 0;
  }
};

double observed_order(const std::string &solver, double coarse) {
  double exact = simulate<Driven>({.solver = "dopri5", .rtol = 1e-13, .atol = 1e-14}, 3).last(0);
  double errors[2];
  for (int i = 0; i < 2; i++)
    errors[i] = std::fabs(simulate<Driven>({.solver = solver, .step = coarse / (1 << i)}, 3).last(0) - exact);
  return std::log2(errors[0] / errors[1]);
}

TEST(Order, EulerIsOne) {
  EXPECT_NEAR(observed_order("euler", 0.005), 1, 0.1);
}
TEST(Order, ClassicalRungeKuttaIsFour) {
  EXPECT_NEAR(observed_order("rk4", 0.05), 4, 0.2);
}
TEST(Order, DormandPrinceIsFive) {
  EXPECT_NEAR(observed_order("dopri5", 0.1), 5, 0.3);
}
TEST(Order, RodasIsFour) {
  EXPECT_NEAR(observed_order("rodas4", 0.05), 4, 0.3);
}

class Smooth : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Smooth, testing::ValuesIn(variable_step_solvers()),
                         [](const auto &i) { return i.param; });

TEST_P(Smooth, RlcFollowsItsClosedFormAtEveryOutputPoint) {
  Result result = simulate<Rlc>({.solver = GetParam(), .rtol = 1e-8, .atol = 1e-10}, 2e-3, 1e-5);
  ASSERT_EQ(result.failure().status, RT_OK) << result.failure().message;
  ASSERT_EQ(result.rows(), 201u);
  for (size_t k = 0; k < result.rows(); k++) {
    EXPECT_NEAR(result.at(1, k), Rlc::capacitor(result.time(k)), 2e-6 * Rlc::U);
    EXPECT_NEAR(result.at(2, k), Rlc::U - Rlc::R * result.at(0, k) - result.at(1, k), 1e-14);
  }
}

TEST_P(Smooth, TighterToleranceGivesSmallerError) {
  double exact = simulate<Driven>({.solver = "dopri5", .rtol = 1e-13, .atol = 1e-14}, 3).last(0), previous = 1;
  for (double rtol : {1e-4, 1e-6, 1e-8}) {
    double error =
        std::fabs(simulate<Driven>({.solver = GetParam(), .rtol = rtol, .atol = 0.01 * rtol}, 3).last(0) - exact);
    EXPECT_LT(error, 50 * rtol);
    EXPECT_LT(error, previous);
    previous = error;
  }
}

TEST(StiffProblem, ImplicitMethodsTakeFewSteps) {
  for (const char *solver : {"ida", "rodas4"}) {
    Result result = simulate<Stiff>({.solver = solver, .rtol = 1e-6, .atol = 1e-8}, 3);
    ASSERT_EQ(result.failure().status, RT_OK) << result.failure().message;
    EXPECT_NEAR(result.last(0), std::cos(3.), 1e-5);
    EXPECT_LT(result.counters().steps, 400);
  }
}

TEST(SparseSolver, AgreesWithTheExplicitMethod) {
  Result sparse = simulate<Chain>({.solver = "ida"}, 2), reference = simulate<Chain>({.solver = "dopri5"}, 2);
  ASSERT_EQ(sparse.failure().status, RT_OK) << sparse.failure().message;
  for (int i = 0; i < Chain::n_x; i++)
    EXPECT_NEAR(sparse.last(i), reference.last(i), 1e-6);
}

TEST(Counters, CountTheWorkOfAFixedStepRunExactly) {
  Result result = simulate<Driven>({.solver = "rk4", .step = 0.01}, 1);
  EXPECT_EQ(result.counters().steps, 100);
  EXPECT_EQ(result.counters().state_events, 0);
  EXPECT_EQ(result.counters().jacobians, 0);
  // four evaluations a step, and one in each pass of the two initial and the terminal event iterations
  EXPECT_EQ(result.counters().rhs - result.counters().event_passes - 1, 400);
}

TEST(Sessions, GiveTheSameBytesEveryTime) {
  for (const std::string &solver : variable_step_solvers()) {
    Session<Driven> session({.solver = solver});
    Result first = session.run(2, 0.01), second = session.run(2, 0.01);
    ASSERT_EQ(first.rows(), second.rows());
    for (size_t k = 0; k < first.rows(); k++)
      EXPECT_EQ(first.at(0, k), second.at(0, k));
    EXPECT_EQ(first.counters().steps, second.counters().steps);
  }
}

} // namespace
