// Any input, times and tolerances for a lag x' = u - x: a run that calls itself complete has finite rows.
#include <cmath>

#include "../runtime/hand_model.h"
#include "bytes.hpp"

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

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  static const char *const solvers[] = {"ida", "dopri5", "rodas4", "rk4", "euler"};
  Bytes bytes(data, size);
  char message[600];
  static rt_model *model = rt_model_wrap(Generated<Lag>::descriptor(), message, sizeof message);
  rt_options options{};
  options.solver = solvers[bytes.next<std::uint8_t>() % 5];
  options.rtol = bytes.next<double>();
  options.step = bytes.next<double>();
  options.locate_events = bytes.next<std::uint8_t>() % 2;
  options.record_events = bytes.next<std::uint8_t>() % 2;
  options.max_steps = 200; // what an input does wrong it does soon: more steps only make fewer inputs
  options.patience = 0.2;
  const auto hold = bytes.next<std::uint8_t>() % 2;
  const auto interval = bytes.next<double>(), start = bytes.next<double>(), stop = bytes.next<double>();
  std::vector<double> time, values;
  while (time.empty() || (bytes.left() && time.size() < 64)) {
    time.push_back(bytes.next<double>());
    values.push_back(bytes.next<double>());
  }
  rt_session *session = rt_session_new(model, &options, message, sizeof message);
  if (!session) return 0;
  const int outputs[] = {0};
  if (!(stop - start > 100 * interval) && !rt_session_outputs(session, 1, outputs) &&
      !rt_session_grid(session, 0, nullptr, interval) &&
      !rt_session_input(session, 1, static_cast<int>(time.size()), time.data(), values.data(),
                        hold ? RT_HOLD : RT_LINEAR)) {
    rt_result *result = rt_session_run(session, start, stop);
    require(result != nullptr, "there is a result");
    const bool complete = rt_result_failure(result)->status == RT_OK;
    const double *x = rt_result_column(result, 0);
    for (std::size_t k = 0; complete && k < rt_result_rows(result); ++k)
      require(std::isfinite(x[k]), "rows of a complete run are finite");
    rt_result_free(result);
  }
  rt_session_free(session);
  return 0;
}
