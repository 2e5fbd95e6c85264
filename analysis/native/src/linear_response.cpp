// Response of a linear model along a recording.
#include <cstddef>
#include <vector>

#include "lacuna_analysis.h"

using std::size_t;

void lacuna_linear_response(const lacuna_linear_model *model, const int *columns, const double *courses, size_t count,
                            int hold, size_t every, double *outputs) {
  const lacuna_linear_model &m = *model;
  const size_t x = m.states;
  std::vector<double> state(x * count), next(x * count), acting(count);
  for (size_t k = 0; k < m.samples; ++k) {
    const double *now = courses + k * count;
    for (size_t o = 0; k % every == 0 && o < m.outputs; ++o) {
      double *to = outputs + (k / every * m.outputs + o) * count;
      for (size_t j = 0; j < count; ++j)
        to[j] = m.feed[(k * m.outputs + o) * m.inputs + static_cast<size_t>(columns[j])] * now[j];
      for (size_t i = 0; i < x; ++i)
        for (size_t j = 0; j < count; ++j)
          to[j] += m.read[(k * m.outputs + o) * x + i] * state[i * count + j];
    }
    if (k + 1 == m.samples) break;
    for (size_t j = 0; j < count; ++j)
      acting[j] = hold ? now[j] : 0.5 * (now[j] + now[count + j]);
    for (size_t i = 0; i < x; ++i) {
      double *to = &next[i * count];
      for (size_t j = 0; j < count; ++j)
        to[j] = m.drive[(k * x + i) * m.inputs + static_cast<size_t>(columns[j])] * acting[j];
      for (size_t l = 0; l < x; ++l)
        for (size_t j = 0; j < count; ++j)
          to[j] += m.step[(k * x + i) * x + l] * state[l * count + j];
    }
    state.swap(next);
  }
}
