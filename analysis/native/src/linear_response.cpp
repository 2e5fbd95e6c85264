// Response of a linear model along a recording, and its transpose.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "lacuna/lanes.hpp"
#include "lacuna_analysis.h"

using lacuna::Lanes;
using lacuna::lanes;
using std::size_t;

namespace {

/// Of one row of a matrix [inputs] what acts on each lane.
inline Lanes driven(const double *row, const int *columns, size_t count, bool alike, const Lanes &acting) {
  if (alike) return Lanes::scaled(row[columns[0]], acting);
  double each[lanes];
  acting.store(each);
  for (size_t j = 0; j < count; ++j)
    each[j] *= row[columns[j]];
  return Lanes::load(each);
}

/// Of the first `lanes` columns.
LACUNA_WIDEST
void respond(const lacuna_linear_model &m, const int *columns, const double *courses, size_t stride, size_t count,
             int hold, size_t every, double *outputs) {
  const size_t x = m.states;
  const bool alike = std::all_of(columns, columns + count, [&](int c) { return c == columns[0]; });
  std::vector<Lanes> state(x), next(x);
  Lanes then = Lanes::load(courses, count);
  for (size_t k = 0; k < m.samples; ++k) {
    const Lanes now = then;
    for (size_t o = 0; k % every == 0 && o < m.outputs; ++o) {
      const size_t row = k * m.outputs + o;
      Lanes sum = driven(m.feed + row * m.inputs, columns, count, alike, now);
      for (size_t i = 0; i < x; ++i)
        sum.add(m.read[row * x + i], state[i]);
      sum.store(outputs + (k / every * m.outputs + o) * stride, count);
    }
    if (k + 1 == m.samples) break;
    then = Lanes::load(courses + (k + 1) * stride, count);
    Lanes acting = now;
    if (!hold) {
      acting.add(1.0, then);
      acting = Lanes::scaled(0.5, acting);
    }
    for (size_t i = 0; i < x; ++i) {
      const size_t row = k * x + i;
      Lanes sum = driven(m.drive + row * m.inputs, columns, count, alike, acting);
      for (size_t l = 0; l < x; ++l)
        sum.add(m.step[row * x + l], state[l]);
      next[i] = sum;
    }
    state.swap(next);
  }
}

/// The transpose of that of courses in one input, linear between samples.
LACUNA_WIDEST
void respond_transposed(const lacuna_linear_model &m, size_t column, const double *outputs, size_t stride, size_t count,
                        size_t every, double *courses) {
  const size_t x = m.states;
  std::vector<Lanes> pull(x), before(x);
  Lanes then;
  for (size_t k = m.samples; k-- > 0;) {
    Lanes now;
    if (k + 1 < m.samples) {
      for (size_t i = 0; i < x; ++i) {
        Lanes sum;
        for (size_t l = 0; l < x; ++l)
          sum.add(m.step[(k * x + l) * x + i], pull[l]);
        before[i] = sum;
        now.add(0.5 * m.drive[(k * x + i) * m.inputs + column], pull[i]);
      }
      then.add(1.0, now);
      then.store(courses + (k + 1) * stride, count);
      pull.swap(before);
    }
    for (size_t o = 0; k % every == 0 && o < m.outputs; ++o) {
      const size_t row = k * m.outputs + o;
      const Lanes from = Lanes::load(outputs + (k / every * m.outputs + o) * stride, count);
      now.add(m.feed[row * m.inputs + column], from);
      for (size_t i = 0; i < x; ++i)
        pull[i].add(m.read[row * x + i], from);
    }
    then = now;
  }
  then.store(courses, count);
}

} // namespace

void lacuna_linear_response(const lacuna_linear_model *model, const int *columns, const double *courses, size_t count,
                            int hold, size_t every, double *outputs) {
  for (size_t j = 0; j < count; j += lanes)
    respond(*model, columns + j, courses + j, count, std::min(lanes, count - j), hold, every, outputs + j);
}
void lacuna_linear_response_transposed(const lacuna_linear_model *model, size_t column, const double *outputs,
                                       size_t count, size_t every, double *courses) {
  for (size_t j = 0; j < count; j += lanes)
    respond_transposed(*model, column, outputs + j, count, count - j, every, courses + j);
}
