// Generated models run by every solver in several threads at once, under whatever sanitizer this was built with: equal
// runs give equal bytes, and sessions do not know of each other.
//
// run_models stop model.so ... : exit code 0, or 1 with a line for each run that is not as the others.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "lacuna_runtime.h"

namespace {

constexpr int threads = 4;
const char *const solvers[] = {"ida", "dopri5", "rodas4"};

// The last row of all variables, and what the run had to say; sensitivities of the first column where there are any.
struct outcome {
  std::string said;
  std::vector<double> last;
  bool operator==(const outcome &o) const {
    return said == o.said && last.size() == o.last.size() &&
           !std::memcmp(last.data(), o.last.data(), last.size() * sizeof(double));
  }
};

std::vector<int> outputs(const mdl_descriptor *d) {
  std::vector<int> found;
  for (int i = 0; i < d->n_variables; i++)
    if (d->variables[i].storage != MDL_PARAMETER) found.push_back(i);
  return found;
}

// The first parameter that the session takes for a column.
void ask_sensitivity(rt_session *session, const mdl_descriptor *d) {
  for (int i = 0; d->tangents && i < d->n_variables; i++)
    if (d->variables[i].storage == MDL_PARAMETER && !rt_session_sensitivities(session, 1, &i)) return;
}

outcome run(const rt_model *model, const char *solver, double stop) {
  const mdl_descriptor *d = rt_model_descriptor(model);
  char message[500] = "";
  rt_options options = {};
  options.solver = solver;
  options.record_events = 1;
  options.locate_events = 1;
  options.max_steps = 100000;
  rt_session *session = rt_session_new(model, &options, message, sizeof message);
  if (!session) return {message, {}};
  std::vector<int> columns = outputs(d);
  rt_session_outputs(session, static_cast<int>(columns.size()), columns.data());
  rt_session_grid(session, 0, nullptr, stop / 100);
  if (std::strcmp(solver, "rodas4")) ask_sensitivity(session, d);
  rt_result *result = rt_session_run(session, d->start_time, d->start_time + stop);
  outcome found;
  if (result) {
    found.said = rt_result_failure(result)->message;
    size_t rows = rt_result_rows(result);
    for (size_t k = 0; rows && k < columns.size(); k++)
      found.last.push_back(rt_result_column(result, static_cast<int>(k))[rows - 1]);
    rt_result_free(result);
  }
  rt_session_free(session);
  return found;
}

bool agree(const char *path, double stop) {
  char message[500] = "";
  rt_model *model = rt_model_open(path, message, sizeof message);
  if (!model) return std::fprintf(stderr, "%s: %s\n", path, message), false;
  bool equal = true;
  std::vector<outcome> found(threads * 3);
  std::vector<std::thread> running;
  for (int k = 0; k < threads; k++)
    running.emplace_back([&found, model, stop, k] {
      for (int i = 0; i < 3; i++) {
        int solver = (i + k) % 3; // different ones at a time
        found[3 * k + solver] = run(model, solvers[solver], stop);
      }
    });
  for (std::thread &t : running)
    t.join();
  for (int k = 3; k < 3 * threads; k++)
    if (!(found[k] == found[k % 3])) {
      equal = false;
      std::printf("%s, %s: thread %d differs: %s\n", path, solvers[k % 3], k / 3, found[k].said.c_str());
    }
  for (int i = 0; i < 3; i++)
    std::printf("%s %s: %s\n", path, solvers[i], found[i].said.empty() ? "complete" : found[i].said.c_str());
  rt_model_close(model);
  return equal;
}

} // namespace

int main(int argc, char **argv) {
  double stop = argc > 1 ? std::atof(argv[1]) : 0;
  bool all = argc > 2;
  for (int k = 2; k < argc; k++)
    all = agree(argv[k], stop) && all;
  return all ? 0 : 1;
}
