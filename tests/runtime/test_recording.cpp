// What is recorded, and when: grids, event rows, rows at step ends, chosen columns.
#include "hand_model.h"

namespace {

using namespace hand;

// x' = 1, y = 2 x algebraic, k counts the crossings of x over 0.5.
struct Ramp : HandModel {
  static constexpr int n_v = 1, n_d = 1, n_rel = 1;
  static std::vector<mdl_variable> variables() {
    mdl_variable alias = variable("minus_y", MDL_ALGEBRAIC, 0);
    alias.sign = -1;
    return {variable("x", MDL_STATE, 0), variable("y", MDL_ALGEBRAIC, 0), alias, variable("k", MDL_DISCRETE, 0),
            variable("der_x", MDL_DERIVATIVE, 0)};
  }
  static int rhs(mdl_data *m, double, const double *x, double *xdot, double *v) {
    v[0] = 2 * x[0];
    xdot[0] = m->d[0] != 0 ? 2 : 1;
    return 0;
  }
  static int roots(mdl_data *, double, const double *x, const double *, const double *, double *g) {
    g[0] = x[0] - 0.5;
    return 0;
  }
  static int event(mdl_data *m, double, double *, const double *, const double *) {
    m->d[0] = m->rel[0];
    return 0;
  }
};

class Recording : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Recording, testing::ValuesIn(variable_step_solvers()),
                         [](const auto &i) { return i.param; });

TEST_P(Recording, GridWithoutEventRowsIsExactlyTheGrid) {
  Result result = simulate<Ramp>({.solver = GetParam(), .events = false}, 1, 0.1);
  ASSERT_EQ(result.rows(), 11u);
  for (size_t k = 0; k < 11; k++) {
    double t = static_cast<double>(k) * 0.1;
    EXPECT_EQ(result.time(k), t);
    EXPECT_FALSE(result.is_event(k));
    EXPECT_NEAR(result.at(0, k), t < 0.5 ? t : 0.5 + 2 * (t - 0.5), 1e-8);
  }
}

TEST_P(Recording, TheLastRowIsTheStopTimeWhereTheGridDoesNotMeetIt) {
  Result result = simulate<Ramp>({.solver = GetParam(), .events = false}, 1, 0.3);
  ASSERT_EQ(result.rows(), 5u);
  EXPECT_EQ(result.time(3), 3 * 0.3);
  EXPECT_EQ(result.time(4), 1);
  EXPECT_NEAR(result.at(0, 4), 1.5, 1e-8);
}

TEST_P(Recording, EventsHaveARowBeforeAndARowAfter) {
  Result result = simulate<Ramp>({.solver = GetParam()}, 1, 0.4);
  std::vector<size_t> rows;
  for (size_t k = 0; k < result.rows(); k++)
    if (result.is_event(k)) rows.push_back(k);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1], rows[0] + 1);
  EXPECT_EQ(result.time(rows[0]), result.time(rows[1]));
  EXPECT_EQ(result.at(3, rows[0]), 0);
  EXPECT_EQ(result.at(3, rows[1]), 1);
  EXPECT_EQ(result.at(4, rows[0]), 1);
  EXPECT_EQ(result.at(4, rows[1]), 2);
  for (size_t k = 1; k < result.rows(); k++)
    EXPECT_LE(result.time(k - 1), result.time(k));
}

TEST_P(Recording, AlgebraicVariablesFollowFromTheStates) {
  Result result = simulate<Ramp>({.solver = GetParam()}, 1, 0.03);
  for (size_t k = 0; k < result.rows(); k++) {
    EXPECT_EQ(result.at(1, k), 2 * result.at(0, k));
    EXPECT_EQ(result.at(2, k), -result.at(1, k));
  }
}

TEST(StepRows, AreRecordedWithoutAGrid) {
  Result result = simulate<Ramp>({.solver = "rk4", .step = 0.1}, 0.4);
  ASSERT_EQ(result.rows(), 5u);
  for (size_t k = 0; k < 5; k++)
    EXPECT_NEAR(result.time(k), 0.1 * static_cast<double>(k), 1e-12);
}

TEST(Grid, MayBeAnyTimesAndBeginAnywhere) {
  Session<Ramp> session({.solver = "dopri5", .events = false});
  double times[] = {-1, 0.25, 0.25, 0.7, 3};
  ASSERT_EQ(rt_session_grid(session.get(), 5, times, 0), RT_OK);
  Result result = {{rt_session_run(session.get(), 0, 1), rt_result_free}};
  ASSERT_EQ(result.rows(), 3u);
  EXPECT_EQ(result.time(1), 0.25);
  EXPECT_EQ(result.time(2), 0.7);
  double backwards[] = {1, 0};
  EXPECT_EQ(rt_session_grid(session.get(), 2, backwards, 0), RT_ARGUMENT);
}

TEST(InitialStates, OfTheCallerReplaceThoseOfTheModel) {
  Session<Ramp> session;
  int row = 0;
  double value = 0.75;
  ASSERT_EQ(rt_session_initial(session.get(), 1, &row, &value), RT_OK);
  Result result = session.run(0.1, 0.1);
  EXPECT_EQ(result.at(0, 0), 0.75);
  EXPECT_EQ(result.at(3, 0), 1) << "discrete variables must follow the given state";
  row = 1;
  EXPECT_EQ(rt_session_initial(session.get(), 1, &row, &value), RT_ARGUMENT);
}

} // namespace
