// Every way in which a run can end early: the status, the words of the message, and the rows recorded so far.
#include "hand_model.h"

namespace {

using namespace hand;

struct Still : HandModel {
  static std::vector<mdl_variable> variables() { return {variable("x", MDL_STATE, 0)}; }
  static int rhs(mdl_data *, double, const double *, double *xdot, double *) {
    xdot[0] = 1;
    return 0;
  }
};

struct Relay : Still { // x' = -sign(x - 0.5): chatters from 0.5 s on
  static constexpr int n_rel = 1;
  static int rhs(mdl_data *m, double, const double *, double *xdot, double *) {
    xdot[0] = m->rel[0] ? -1 : 1;
    return 0;
  }
  static int roots(mdl_data *, double, const double *x, const double *, const double *, double *g) {
    g[0] = x[0] - 0.5;
    return 0;
  }
};

struct Undecided : Still { // when x > 0.5 then flag = not pre(flag), with nothing to stop it
  static constexpr int n_rel = 1, n_d = 1;
  static std::vector<mdl_variable> variables() {
    return {variable("x", MDL_STATE, 0), variable("flag", MDL_DISCRETE, 0)};
  }
  static int roots(mdl_data *, double, const double *x, const double *, const double *, double *g) {
    g[0] = x[0] - 0.5;
    return 0;
  }
  static int event(mdl_data *m, double, double *, const double *, const double *) {
    m->d[0] = m->rel[0] ? 1 - m->pre_d[0] : m->pre_d[0];
    return 0;
  }
};

struct Explodes : HandModel { // x' = x^2 from 1: infinite at 1 s
  static std::vector<mdl_variable> variables() { return {variable("x", MDL_STATE, 0, 1)}; }
  static int rhs(mdl_data *, double, const double *x, double *xdot, double *) {
    xdot[0] = x[0] * x[0];
    return 0;
  }
};

struct NotANumber : Still {
  static int rhs(mdl_data *, double t, const double *, double *xdot, double *) {
    xdot[0] = std::sqrt(0.5 - t);
    return 0;
  }
};

struct Negative : Still { // the model itself refuses what lies beyond 0.5 s
  static int rhs(mdl_data *m, double t, const double *, double *xdot, double *) {
    xdot[0] = 1;
    if (t <= 0.5) return 0;
    m->failure = {MDL_FAILURE_DOMAIN, 0, -1, 0.5 - t, 0};
    return 1;
  }
};

struct Asserting : Still {
  static constexpr int n_asserts = 1;
  static int check(mdl_data *m, double, const double *x, const double *, const double *) {
    if (x[0] <= 0.5) return 0;
    m->failure = {MDL_FAILURE_ASSERT, 0, -1, x[0], 0};
    return -1;
  }
};

struct Terminating : Undecided {
  static constexpr int n_messages = 1;
  static int event(mdl_data *m, double, double *, const double *, const double *) {
    if (m->rel[0]) m->terminated = 1;
    return 0;
  }
};

struct Unbounded : Still {
  static constexpr int n_p = 1;
  static std::vector<double> start_parameters() { return {1}; }
  static std::vector<mdl_variable> variables() {
    mdl_variable p = variable("J", MDL_PARAMETER, 0, 1);
    p.min = 0;
    return {variable("x", MDL_STATE, 0), p};
  }
};

struct NoStart : Still {
  static int rhs(mdl_data *m, double, const double *, double *, double *) {
    m->failure = {MDL_FAILURE_NEWTON, 0, -1, 3, 0};
    return 1;
  }
};

class Failures : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Failures, testing::ValuesIn(variable_step_solvers()),
                         [](const auto &i) { return i.param; });

template <class M>
void expect_failure(const std::string &solver, rt_status status, double time, const std::string &words,
                    double tolerance = 1e-3) {
  Result result = simulate<M>({.solver = solver}, 2);
  EXPECT_EQ(result.failure().status, status) << result.failure().message;
  EXPECT_NEAR(result.failure().time, time, tolerance);
  EXPECT_NE(std::string(result.failure().message).find(words), std::string::npos) << result.failure().message;
  EXPECT_GE(result.rows(), time > 0 ? 3u : 0u) << "what was computed before must be kept";
}

TEST_P(Failures, Chattering) {
  expect_failure<Relay>(GetParam(), RT_CHATTERING, 0.5, "hand.mo:6: chattering");
}
TEST_P(Failures, EventCycle) {
  expect_failure<Undecided>(GetParam(), RT_EVENT_CYCLE, 0.5, "keep changing: flag");
}
TEST_P(Failures, StepCollapse) {
  expect_failure<Explodes>(GetParam(), RT_STEP_COLLAPSE, 1, "hand.mo:10");
}
TEST_P(Failures, NonFinite) {
  expect_failure<NotANumber>(GetParam(), RT_NONFINITE, 0.5, "not a finite number", 1e-2);
}
TEST_P(Failures, DomainError) {
  expect_failure<Negative>(GetParam(), RT_DOMAIN, 0.5, "der(x) = f", 1e-2);
}
TEST_P(Failures, Assert) {
  expect_failure<Asserting>(GetParam(), RT_ASSERT, 1.25, "hand.mo:7: spring: assertion violated", 0.751);
  expect_failure<Asserting>(GetParam(), RT_ASSERT, 1.25, "x stays small (x = ", 0.751);
}
TEST_P(Failures, Initialisation) {
  expect_failure<NoStart>(GetParam(), RT_INITIALISATION, 0, "did not converge");
}

struct CountedStart : Still {
  static inline int calls = 0;
  static int rhs(mdl_data *m, double, const double *, double *, double *) {
    calls++;
    m->failure = {MDL_FAILURE_NEWTON, 0, -1, 3, 0};
    return 1;
  }
};

TEST_P(Failures, AStartThatFailsIsNotTriedAgainUnchanged) {
  CountedStart::calls = 0;
  expect_failure<CountedStart>(GetParam(), RT_INITIALISATION, 0, "did not converge");
  EXPECT_EQ(CountedStart::calls, 2) << "with what homotopy() is, and with what it is simplified to";
}

struct Sized : Still {
  static std::vector<mdl_variable> variables() { return {variable("x", MDL_STATE, 0, 1)}; }
};

TEST(Starts, LookAheadWhereASizeIsOpenOnly) {
  Options options = {.solver = "rk4", .atol = 0, .step = 0.1};
  EXPECT_LT(simulate<Sized>(options, 1).counters().rhs, simulate<Still>(options, 1).counters().rhs);
}

TEST_P(Failures, TerminateEndsTheRunNormally) {
  Result result = simulate<Terminating>({.solver = GetParam()}, 2);
  EXPECT_EQ(result.failure().status, RT_OK);
  EXPECT_STREQ(rt_result_terminated(result.handle.get()), "arrived");
  EXPECT_NEAR(result.time(result.rows() - 1), 0.5, 1e-9);
  EXPECT_EQ(result.events().back().kind, RT_EVENT_TERMINATE);
}

struct Disagreeing : Still { // the explicit form says x' = 1, the residual form x' = 2
  static int residual(mdl_data *, double, const double *, const double *yp, double *r) {
    r[0] = yp[0] - 2;
    return 0;
  }
};

TEST(Forms, ThatDisagreeAreRefusedWithTheEquation) {
  mdl_descriptor wrong = *Generated<Still>::descriptor();
  wrong.residual = Disagreeing::residual;
  char message[300] = "";
  rt_model *model = rt_model_wrap(&wrong, message, sizeof message);
  rt_options options = {"ida", 0, 0, 0, 0, 1, 1, 0, 0, 0};
  rt_session *session = rt_session_new(model, &options, message, sizeof message);
  ASSERT_NE(session, nullptr) << message;
  rt_result *result = rt_session_run(session, 0, 1);
  EXPECT_EQ(rt_result_failure(result)->status, RT_INCONSISTENT);
  EXPECT_EQ(rt_result_failure(result)->line, 5);
  rt_result_free(result);
  rt_session_free(session);
  rt_model_close(model);
}

TEST(Arguments, AreRefusedWithTheReason) {
  char message[300] = "";
  rt_model *model = rt_model_wrap(Generated<Still>::descriptor(), message, sizeof message);
  rt_options unknown = {"magic", 0, 0, 0, 0, 1, 1, 0, 0, 0}, stepless = {"rk4", 0, 0, 0, 0, 1, 1, 0, 0, 0};
  EXPECT_EQ(rt_session_new(model, &unknown, message, sizeof message), nullptr);
  EXPECT_NE(std::string(message).find("dopri5"), std::string::npos);
  EXPECT_EQ(rt_session_new(model, &stepless, message, sizeof message), nullptr);
  EXPECT_NE(std::string(message).find("needs a step"), std::string::npos);
  rt_model_close(model);
  mdl_descriptor old = *Generated<Still>::descriptor();
  old.abi_version = 0;
  EXPECT_EQ(rt_model_wrap(&old, message, sizeof message), nullptr);
  EXPECT_NE(std::string(message).find("ABI"), std::string::npos);
  EXPECT_EQ(rt_model_open("/nowhere.so", message, sizeof message), nullptr);
  Session<Still> session;
  Result backwards = {{rt_session_run(session.get(), 1, 0), rt_result_free}};
  EXPECT_EQ(backwards.failure().status, RT_ARGUMENT);
}

TEST(Parameters, OutsideBoundsAreRefused) {
  Session<Unbounded> session;
  int row = 1;
  double value = -1;
  EXPECT_EQ(rt_session_parameters(session.get(), 1, &row, &value), RT_BOUND);
  EXPECT_NE(std::string(rt_session_failure(session.get())->message).find("J = -1 is outside its bounds [0, inf]"),
            std::string::npos);
  value = 2;
  EXPECT_EQ(rt_session_parameters(session.get(), 1, &row, &value), RT_OK);
  EXPECT_EQ(rt_result_parameters(session.run(1).handle.get())[0], 2);
  row = 0;
  EXPECT_EQ(rt_session_parameters(session.get(), 1, &row, &value), RT_ARGUMENT);
}

} // namespace
