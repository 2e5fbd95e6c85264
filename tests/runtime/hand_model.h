// Models written by hand against the ABI, so that the runtime is tested without the code generator.
//
// A model is a struct derived from HandModel that hides the static functions it needs and lists its variables.
// HandModel supplies the rest: residual form F = x' - f(t, x), its Jacobian by central differences (dense pattern), and
// functions that do nothing.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "lacuna_runtime.h"

namespace hand {

constexpr double infinity = std::numeric_limits<double>::infinity();

inline mdl_variable variable(const char *name, mdl_storage storage, int index, double start = 0) {
  const int is_parameter = storage == MDL_PARAMETER;
  return {name,         "", "",    "hand.mo", 10 + index, MDL_REAL, storage, index,       1,
          is_parameter, 0,  start, -infinity, infinity,   0,        "",      is_parameter};
}

struct HandModel {
  static constexpr int n_p = 0, n_u = 0, n_x = 1, n_z = 0, n_v = 0, n_d = 0, n_rel = 0, n_sample = 0, n_when = 0,
                       n_asserts = 0, n_messages = 0, time_relation = -1;
  static int parameters(mdl_data *) { return 0; }
  static int samples(const mdl_data *, double *, double *) { return 0; }
  static int roots(mdl_data *, double, const double *, const double *, const double *, double *) { return 0; }
  static int time_relations(mdl_data *, double) { return 0; }
  static double next_time_event(const mdl_data *, double) { return infinity; }
  static int event(mdl_data *, double, double *, const double *, const double *) { return 0; }
  static int check(mdl_data *, double, const double *, const double *, const double *) { return 0; }
  static std::vector<double> start_parameters() { return {}; }
  static std::vector<int> z_index() { return {}; }
};

template <class M> struct Generated {
  static constexpr int n = M::n_x + M::n_z;
  static int starts(mdl_data *m) {
    for (const mdl_variable &v : M::variables()) {
      if (v.storage == MDL_STATE) m->x[v.index] = v.start;
      if (v.storage == MDL_DISCRETE) m->d[v.index] = m->pre_d[v.index] = v.start;
    }
    return 0;
  }
  static int initial_system(mdl_data *m, double t) { return M::rhs(m, t, m->x, m->xdot, m->v); }

  // Rows of x: x' - f(t, x). Rows of z: z - v[z_index], as the explicit form computes it.
  static int residual(mdl_data *m, double t, const double *y, const double *yp, double *r) {
    std::vector<double> xdot(M::n_x + 1), v(M::n_v + 1);
    int status = M::rhs(m, t, y, xdot.data(), v.data());
    for (int i = 0; i < M::n_x; i++)
      r[i] = yp[i] - xdot[i];
    auto z = M::z_index();
    for (int k = 0; k < M::n_z; k++)
      r[M::n_x + k] = y[M::n_x + k] - v[z[k]];
    return status;
  }

  static int jacobian(mdl_data *m, double t, const double *y, const double *yp, double cj, double *values) {
    std::vector<double> low(n), high(n), point(y, y + n);
    for (int j = 0; j < n; j++) {
      double step = 1e-6 * std::fmax(1, std::fabs(y[j]));
      point[j] = y[j] - step;
      int status = residual(m, t, point.data(), yp, low.data());
      point[j] = y[j] + step;
      status |= residual(m, t, point.data(), yp, high.data());
      point[j] = y[j];
      if (status) return status;
      for (int i = 0; i < n; i++)
        values[j * n + i] = (high[i] - low[i]) / (2 * step) + (i == j && j < M::n_x ? cj : 0);
    }
    return 0;
  }

  static const mdl_descriptor *descriptor() {
    static const std::vector<mdl_variable> variables = M::variables();
    static const mdl_equation equation = {"der(x) = f", "hand.mo", 5, ""};
    static const std::vector<mdl_equation> equations(n, equation);
    static const int compared[] = {0};
    static const std::vector<mdl_assert> asserts(M::n_asserts + 1,
                                                 mdl_assert{{"x stays small", "hand.mo", 7, "spring"}, 1, compared});
    static const std::vector<double> p_start = M::start_parameters();
    static const std::vector<int> z_index = M::z_index();
    static const char *const messages[] = {"arrived"};
    static std::vector<mdl_relation> relations(M::n_rel, mdl_relation{{"x > 0", "hand.mo", 6, ""}, 0});
    if constexpr (M::time_relation >= 0) relations[M::time_relation].kind = MDL_OF_TIME;
    static std::vector<int> residual_equation(n), colptr(n + 1), rowidx(n * n);
    for (int i = 0; i < n; i++)
      residual_equation[i] = i;
    for (int i = 0; i <= n; i++)
      colptr[i] = i * n;
    for (int i = 0; i < n * n; i++)
      rowidx[i] = i % n;
    static const mdl_descriptor d = {MDL_ABI_VERSION,
                                     "Hand",
                                     "hash",
                                     M::n_p,
                                     M::n_u,
                                     M::n_x,
                                     M::n_z,
                                     M::n_v,
                                     M::n_d,
                                     M::n_rel,
                                     M::n_sample,
                                     M::n_when,
                                     static_cast<int>(variables.size()),
                                     n,
                                     M::n_asserts,
                                     M::n_messages,
                                     variables.data(),
                                     equations.data(),
                                     asserts.data(),
                                     relations.data(),
                                     messages,
                                     z_index.data(),
                                     residual_equation.data(),
                                     p_start.data(),
                                     0,
                                     1,
                                     1e-6,
                                     0,
                                     n * n,
                                     colptr.data(),
                                     rowidx.data(),
                                     M::parameters,
                                     M::samples,
                                     starts,
                                     initial_system,
                                     M::rhs,
                                     residual,
                                     jacobian,
                                     M::roots,
                                     M::time_relations,
                                     M::next_time_event,
                                     M::event,
                                     M::check,
                                     nullptr,
                                     0,
                                     nullptr,
                                     nullptr,
                                     nullptr,
                                     nullptr,
                                     0,
                                     nullptr,
                                     nullptr,
                                     0,
                                     0,
                                     nullptr,
                                     0,
                                     nullptr,
                                     nullptr,
                                     nullptr,
                                     nullptr,
                                     0,
                                     nullptr,
                                     nullptr,
                                     nullptr,
                                     nullptr,
                                     nullptr,
                                     0,
                                     nullptr,
                                     nullptr,
                                     0,
                                     nullptr,
                                     0,
                                     nullptr,
                                     nullptr,
                                     nullptr,
                                     0,
                                     nullptr};
    return &d;
  }
};

struct Result {
  std::shared_ptr<rt_result> handle;
  size_t rows() const { return rt_result_rows(handle.get()); }
  double time(size_t row) const { return rt_result_time(handle.get())[row]; }
  double at(int column, size_t row) const { return rt_result_column(handle.get(), column)[row]; }
  double last(int column) const { return at(column, rows() - 1); }
  bool is_event(size_t row) const { return rt_result_event_flags(handle.get())[row] != 0; }
  const rt_counters &counters() const { return *rt_result_counters(handle.get()); }
  const rt_failure &failure() const { return *rt_result_failure(handle.get()); }
  std::vector<rt_event_entry> events() const {
    size_t n = 0;
    const rt_event_entry *e = rt_result_events(handle.get(), &n);
    std::vector<rt_event_entry> copy;
    for (size_t k = 0; k < n; k++)
      copy.push_back(e[k]);
    return copy;
  }
};

struct Options {
  std::string solver = "dopri5";
  double rtol = 1e-8, atol = 1e-10, step = 0;
  bool locate = true, events = true;
};

// A session over a hand-written model. Columns are the model's variables in order.
template <class M> class Session {
public:
  explicit Session(const Options &o = {}) {
    char message[300] = "";
    model_ = {rt_model_wrap(Generated<M>::descriptor(), message, sizeof message), rt_model_close};
    rt_options options = {o.solver.c_str(), o.rtol, o.atol, o.step, 0, o.locate, o.events, 0, 0, 0};
    session_ = {rt_session_new(model_.get(), &options, message, sizeof message), rt_session_free};
    EXPECT_NE(session_, nullptr) << message;
    std::vector<int> columns;
    for (int i = 0; i < Generated<M>::descriptor()->n_variables; i++)
      columns.push_back(i);
    EXPECT_EQ(rt_session_outputs(get(), static_cast<int>(columns.size()), columns.data()), RT_OK);
  }
  rt_session *get() const { return session_.get(); }
  Result run(double stop, double interval = 0) {
    rt_session_grid(get(), 0, nullptr, interval);
    return {{rt_session_run(get(), 0, stop), rt_result_free}};
  }

private:
  std::shared_ptr<rt_model> model_;
  std::shared_ptr<rt_session> session_;
};

template <class M> Result simulate(const Options &options, double stop, double interval = 0) {
  return Session<M>(options).run(stop, interval);
}

inline std::vector<std::string> variable_step_solvers() {
  return {"ida", "dopri5", "rodas4"};
}

} // namespace hand
