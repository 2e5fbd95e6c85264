// Columns of readings whitened by the filter of one hypothesis, and the transpose of that: equations and sources in
// discovery/efforts/latent/smoother.py.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lacuna/lanes.hpp"
#include "lacuna/latent_filter.hpp"

namespace {

using lacuna::Lanes;
using lacuna::lanes;
using std::size_t;

struct Passes {
  const lacuna_linear_model &m;
  const lacuna_latent_gains &gains;
  const size_t x, forces, w;
  const unsigned char *seen;

  Passes(const lacuna_linear_model &model, const lacuna_latent_gains &gains, size_t forces, const unsigned char *seen)
      : m(model), gains(gains), x(model.states), forces(forces), w(x + forces), seen(seen) {}
};

/// Columns [samples][outputs][stride], the first `lanes` of `count` at most, whitened.
LACUNA_WIDEST
void whiten(const Passes &by, double *data, size_t stride, size_t count) {
  const size_t x = by.x, outputs = by.m.outputs;
  std::vector<Lanes> state(by.w), next(x);
  for (size_t k = 0; k < by.m.samples; ++k) {
    for (size_t n = k * outputs; n < (k + 1) * outputs; ++n) {
      Lanes innovation;
      if (by.seen[n]) {
        Lanes expected;
        for (size_t i = 0; i < by.w; ++i)
          expected.add(by.gains.row[n * by.w + i], state[i]);
        innovation = Lanes::load(data + n * stride, count).less(expected);
        for (size_t i = 0; i < by.w; ++i)
          state[i].add(by.gains.gain[n * by.w + i], innovation);
      }
      innovation.over(by.gains.deviation[n]).store(data + n * stride, count);
    }
    if (k + 1 == by.m.samples) break;
    for (size_t i = 0; i < x; ++i) {
      Lanes sum;
      for (size_t l = 0; l < x; ++l)
        sum.add(by.m.step[(k * x + i) * x + l], state[l]);
      for (size_t j = 0; j < by.forces; ++j)
        sum.add(by.gains.drive[(k * x + i) * by.forces + j], state[x + j]);
      next[i] = sum;
    }
    std::copy(next.begin(), next.end(), state.begin());
    for (size_t j = 0; j < by.forces; ++j)
      state[x + j] = Lanes::scaled(by.gains.keep[k * by.forces + j], state[x + j]);
  }
}

/// `pull` [w] on the states of sample k + 1, taken back to sample k.
void back_over(const Passes &by, size_t k, std::vector<Lanes> &pull, std::vector<Lanes> &before) {
  const size_t x = by.x;
  for (size_t i = 0; i < x; ++i) {
    Lanes sum;
    for (size_t l = 0; l < x; ++l)
      sum.add(by.m.step[(k * x + l) * x + i], pull[l]);
    before[i] = sum;
  }
  for (size_t j = 0; j < by.forces; ++j) {
    Lanes sum;
    for (size_t l = 0; l < x; ++l)
      sum.add(by.gains.drive[(k * x + l) * by.forces + j], pull[l]);
    sum.add(by.gains.keep[k * by.forces + j], pull[x + j]);
    before[x + j] = sum;
  }
  pull.swap(before);
}

/// The transpose of `whiten`.
LACUNA_WIDEST
void whiten_transposed(const Passes &by, double *data, size_t stride, size_t count) {
  const size_t outputs = by.m.outputs;
  std::vector<Lanes> pull(by.w), before(by.w);
  for (size_t k = by.m.samples; k-- > 0;) {
    if (k + 1 < by.m.samples) back_over(by, k, pull, before);
    for (size_t n = (k + 1) * outputs; n-- > k * outputs;) {
      Lanes reading;
      if (by.seen[n]) {
        reading = Lanes::load(data + n * stride, count).over(by.gains.deviation[n]);
        for (size_t i = 0; i < by.w; ++i)
          reading.add(-by.gains.gain[n * by.w + i], pull[i]);
        for (size_t i = 0; i < by.w; ++i)
          pull[i].add(by.gains.row[n * by.w + i], reading);
      }
      reading.store(data + n * stride, count);
    }
  }
}

} // namespace

int lacuna_latent_filter(const lacuna_linear_model *model, const lacuna_latent *latent, const unsigned char *seen,
                         lacuna_latent_gains *gains) {
  const lacuna_linear_model &m = *model;
  lacuna::Filter<1> filter(m, *latent, 0, 1);
  const size_t w = filter.w, forces = latent->forces;
  const double none = 0;
  std::fill_n(gains->deviation, m.samples * m.outputs, 1.0);
  for (size_t k = 0; k < m.samples; ++k) {
    for (size_t o = 0, n = k * m.outputs; o < m.outputs; ++o, ++n) {
      if (!seen[n]) continue;
      filter.look(k, o);
      if (!filter.read(o, &none)) return 1;
      gains->deviation[n] = std::sqrt(filter.variance[0]);
      for (size_t i = 0; i < w; ++i) {
        gains->row[n * w + i] = filter.row(i, 0);
        gains->gain[n * w + i] = filter.crossed[i] / filter.variance[0];
      }
    }
    if (k + 1 == m.samples) break;
    filter.move(k);
    std::copy_n(filter.keep.begin(), forces, gains->keep + k * forces);
    for (size_t i = 0; i < m.states; ++i)
      for (size_t j = 0; j < forces; ++j)
        gains->drive[(k * m.states + i) * forces + j] = filter.drive[j * m.states + i];
  }
  return 0;
}

void lacuna_latent_whiten(const lacuna_linear_model *model, const lacuna_latent_gains *gains, size_t forces,
                          double *data, const unsigned char *seen, size_t columns) {
  const Passes passes(*model, *gains, forces, seen);
  for (size_t j = 0; j < columns; j += lanes)
    whiten(passes, data + j, columns, columns - j);
}

void lacuna_latent_whiten_transposed(const lacuna_linear_model *model, const lacuna_latent_gains *gains, size_t forces,
                                     double *data, const unsigned char *seen, size_t columns) {
  const Passes passes(*model, *gains, forces, seen);
  for (size_t j = 0; j < columns; j += lanes)
    whiten_transposed(passes, data + j, columns, columns - j);
}
