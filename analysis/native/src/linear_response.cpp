// Response of a linear model along a recording, and its transpose.
#include <algorithm>
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

void lacuna_linear_response_transposed(const lacuna_linear_model *model, size_t column, const double *outputs,
                                       size_t count, size_t every, double *courses) {
  const lacuna_linear_model &m = *model;
  const size_t x = m.states;
  std::vector<double> pull(x * count), before(x * count);
  for (size_t k = m.samples; k-- > 0;) {
    double *now = courses + k * count;
    std::fill_n(now, count, 0.0);
    if (k + 1 < m.samples) {
      std::fill(before.begin(), before.end(), 0.0);
      for (size_t i = 0; i < x; ++i) {
        const double *from = &pull[i * count], *step = m.step + (k * x + i) * x;
        const double half = 0.5 * m.drive[(k * x + i) * m.inputs + column];
        for (size_t j = 0; j < count; ++j)
          now[j] += half * from[j];
        for (size_t j = 0; j < count; ++j)
          now[count + j] += half * from[j];
        for (size_t l = 0; l < x; ++l)
          for (size_t j = 0; j < count; ++j)
            before[l * count + j] += step[l] * from[j];
      }
      pull.swap(before);
    }
    for (size_t o = 0; k % every == 0 && o < m.outputs; ++o) {
      const double *from = outputs + (k / every * m.outputs + o) * count, *read = m.read + (k * m.outputs + o) * x;
      const double feed = m.feed[(k * m.outputs + o) * m.inputs + column];
      for (size_t j = 0; j < count; ++j)
        now[j] += feed * from[j];
      for (size_t i = 0; i < x; ++i)
        for (size_t j = 0; j < count; ++j)
          pull[i * count + j] += read[i] * from[j];
    }
  }
}
