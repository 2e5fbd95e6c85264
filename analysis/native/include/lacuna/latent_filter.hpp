// Kalman filter of unknown forces in a linear model: equations and sources in
// discovery/efforts/latent/smoother.py.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lacuna_analysis.h"

namespace lacuna {

/// The filter of L hypotheses side by side, from sample to sample. States are the model's, then the forces; outputs are
/// read one after the other, their noises being independent: each is a number, with no matrix to invert.
template <std::size_t L> class Filter {
public:
  Filter(const lacuna_linear_model &model, const lacuna_latent &latent, std::size_t first, std::size_t columns)
      : m(model), c(latent), x(model.states), w(model.states + latent.forces), columns(columns), lanes(L),
        state(w * columns * L), cover(w * w * L), moved(std::max(w * columns, w * w) * L), drive(c.forces * x * L),
        keep(c.forces * L), reads(c.forces * L), crossed(w * L), innovation(columns * L), variance(L) {
    for (std::size_t lane = 0; lane < L; ++lane)
      lanes[lane] = std::min(first + lane, latent.hypotheses - 1) * latent.forces;
    for (std::size_t i = 0; i < x; ++i)
      for (std::size_t lane = 0; lane < L; ++lane)
        cover[(i * w + i) * L + lane] = m.start[i] * m.start[i];
    for (std::size_t j = 0; j < c.forces; ++j)
      for (std::size_t lane = 0; lane < L; ++lane)
        cover[((x + j) * w + x + j) * L + lane] = c.size[lanes[lane] + j] * c.size[lanes[lane] + j];
  }

  /// How output o of sample k reads the forces.
  void look(std::size_t k, std::size_t o) {
    near = m.read + (k * m.outputs + o) * x;
    const double *feed = m.feed + (k * m.outputs + o) * m.inputs;
    for (std::size_t j = 0; j < c.forces; ++j)
      for (std::size_t lane = 0; lane < L; ++lane) {
        const int column = c.column[lanes[lane] + j], sensor = c.sensor[lanes[lane] + j];
        reads[j * L + lane] =
            (sensor == static_cast<int>(o) ? 1.0 : 0.0) + (column >= 0 ? feed[static_cast<std::size_t>(column)] : 0.0);
      }
  }

  /// Take in an output that `look` looked at, `data` [columns]; false: its variance is no positive number. Joseph's
  /// form, in which what rounding has left of the gain's share is taken out again.
  bool read(std::size_t o, const double *data) {
    const double power = m.noise[o] * m.noise[o];
    reading(cover, w, crossed);
    for (std::size_t lane = 0; lane < L; ++lane) {
      double sum = power;
      for (std::size_t i = 0; i < w; ++i)
        sum += row(i, lane) * crossed[i * L + lane];
      variance[lane] = sum;
      if (!(sum > 0)) return false;
    }
    reading(state, columns, innovation);
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t lane = 0; lane < L; ++lane)
        innovation[j * L + lane] = data[j] - innovation[j * L + lane];
    for (std::size_t i = 0; i < w; ++i)
      add(&state[i * columns * L], columns, &crossed[i * L], innovation, 1);
    for (std::size_t i = 0; i < w; ++i)
      add(&cover[i * w * L], w, &crossed[i * L], crossed, -1);
    reading(cover, w, moved);
    for (std::size_t i = 0; i < w; ++i)
      for (std::size_t lane = 0; lane < L; ++lane)
        moved[i * L + lane] = power * crossed[i * L + lane] / variance[lane] - moved[i * L + lane];
    for (std::size_t i = 0; i < w; ++i)
      add(&cover[i * w * L], w, &crossed[i * L], moved, 1);
    return true;
  }

  /// From sample k to the next.
  void move(std::size_t k) {
    const double interval = m.time[k + 1] - m.time[k];
    const double *push = m.drive + k * x * m.inputs;
    for (std::size_t j = 0; j < c.forces; ++j)
      for (std::size_t lane = 0; lane < L; ++lane) {
        const int column = c.column[lanes[lane] + j];
        keep[j * L + lane] = std::exp(-interval / c.time[lanes[lane] + j]);
        for (std::size_t i = 0; i < x; ++i)
          drive[(j * x + i) * L + lane] = column >= 0 ? push[i * m.inputs + static_cast<std::size_t>(column)] : 0.0;
      }
    forward(k, state, columns);
    forward(k, cover, w);
    for (std::size_t i = 0; i < w; ++i) // of a symmetric matrix: the other side is turned to the front
      for (std::size_t j = 0; j < i; ++j)
        std::swap_ranges(&cover[(i * w + j) * L], &cover[(i * w + j) * L] + L, &cover[(j * w + i) * L]);
    forward(k, cover, w);
    for (std::size_t j = 0; j < c.forces; ++j)
      for (std::size_t lane = 0; lane < L; ++lane) {
        const double size = c.size[lanes[lane] + j], kept = keep[j * L + lane];
        cover[((x + j) * w + x + j) * L + lane] += size * size * (1 - kept * kept);
      }
  }

  /// Coefficient of state i in the output that is looked at.
  double row(std::size_t i, std::size_t lane) const { return i < x ? near[i] : reads[(i - x) * L + lane]; }

  const lacuna_linear_model &m;
  const lacuna_latent &c;
  const std::size_t x, w, columns;
  std::vector<std::size_t> lanes; // [L] where the forces of each begin
  std::vector<double> state, cover, moved, drive, keep, reads, crossed, innovation,
      variance; // the last index is a lane

private:
  const double *near = nullptr; // [x] how the output that is looked at reads the model's states

  /// What the output is of the columns of `what` [w][count].
  void reading(const std::vector<double> &what, std::size_t count, std::vector<double> &result) const {
    std::fill_n(result.begin(), count * L, 0.0);
    for (std::size_t i = 0; i < x; ++i)
      for (std::size_t j = 0; j < count * L; ++j)
        result[j] += near[i] * what[i * count * L + j];
    for (std::size_t i = x; i < w; ++i)
      for (std::size_t j = 0; j < count; ++j)
        for (std::size_t lane = 0; lane < L; ++lane)
          result[j * L + lane] += reads[(i - x) * L + lane] * what[(i * count + j) * L + lane];
  }

  /// To `row` [count] what the gain of one state makes of `by` [count].
  void add(double *row, std::size_t count, const double *crossed_of, const std::vector<double> &by, double sign) const {
    double gain[L];
    for (std::size_t lane = 0; lane < L; ++lane)
      gain[lane] = sign * crossed_of[lane] / variance[lane];
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t lane = 0; lane < L; ++lane)
        row[j * L + lane] += gain[lane] * by[j * L + lane];
  }

  /// The columns of `what` [w][count] one sample on.
  void forward(std::size_t k, std::vector<double> &what, std::size_t count) {
    const double *step = m.step + k * x * x;
    const std::size_t width = count * L;
    std::fill_n(moved.begin(), x * width, 0.0);
    for (std::size_t i = 0; i < x; ++i) {
      double *to = &moved[i * width];
      for (std::size_t l = 0; l < x; ++l)
        for (std::size_t j = 0; j < width; ++j)
          to[j] += step[i * x + l] * what[l * width + j];
      for (std::size_t j = 0; j < c.forces; ++j) {
        const double *by = &drive[(j * x + i) * L], *from = &what[(x + j) * width];
        if (std::all_of(by, by + L, [](double d) { return d == 0; })) continue;
        for (std::size_t n = 0; n < count; ++n)
          for (std::size_t lane = 0; lane < L; ++lane)
            to[n * L + lane] += by[lane] * from[n * L + lane];
      }
    }
    std::copy_n(moved.begin(), x * width, what.begin());
    for (std::size_t j = 0; j < c.forces; ++j)
      for (std::size_t n = 0; n < count; ++n)
        for (std::size_t lane = 0; lane < L; ++lane)
          what[((x + j) * count + n) * L + lane] *= keep[j * L + lane];
  }
};

} // namespace lacuna
