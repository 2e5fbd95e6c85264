// Smoother of unknown forces: equations and sources in
// discovery/efforts/latent/smoother.py.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lacuna/latent_filter.hpp"

namespace {

using std::size_t;

/// What a smoother needs of one hypothesis: its point before each sample, and each reading that was taken in.
struct Reading {
  size_t sample;
  std::vector<double> row, gain;
  double innovation, variance;
};

/// The one that the filter has just taken in.
Reading reading(const lacuna::Filter<1> &filter, size_t sample) {
  Reading read{sample, std::vector<double>(filter.w), filter.crossed, filter.innovation[0], filter.variance[0]};
  for (size_t i = 0; i < filter.w; ++i) {
    read.row[i] = filter.row(i, 0);
    read.gain[i] /= read.variance;
  }
  return read;
}

/// r and N of de Jong (1989) taken back over one reading.
void back_over(const Reading &read, std::vector<double> &pull, std::vector<double> &weight) {
  const size_t w = pull.size();
  double along = 0;
  std::vector<double> turned(w);
  for (size_t i = 0; i < w; ++i)
    along += read.gain[i] * pull[i];
  for (size_t i = 0; i < w; ++i)
    pull[i] += read.row[i] * (read.innovation / read.variance - along);
  for (size_t i = 0; i < w; ++i)
    for (size_t j = 0; j < w; ++j)
      turned[i] += weight[i * w + j] * read.gain[j];
  double both = 1 / read.variance;
  for (size_t i = 0; i < w; ++i)
    both += read.gain[i] * turned[i];
  for (size_t i = 0; i < w; ++i)
    for (size_t j = 0; j < w; ++j)
      weight[i * w + j] += both * read.row[i] * read.row[j] - turned[i] * read.row[j] - read.row[i] * turned[j];
}

/// The matrix of one hypothesis from sample k to the next, [w][w].
std::vector<double> transition(const lacuna_linear_model &m, const lacuna_latent &c, size_t k) {
  const size_t x = m.states, w = x + c.forces;
  std::vector<double> result(w * w);
  for (size_t i = 0; i < x; ++i) {
    std::copy_n(m.step + (k * x + i) * x, x, &result[i * w]);
    for (size_t j = 0; j < c.forces; ++j)
      if (c.column[j] >= 0) result[i * w + x + j] = m.drive[(k * x + i) * m.inputs + static_cast<size_t>(c.column[j])];
  }
  for (size_t j = 0; j < c.forces; ++j)
    result[(x + j) * w + x + j] = std::exp(-(m.time[k + 1] - m.time[k]) / c.time[j]);
  return result;
}

/// r and N taken back over a step.
void back_over(const std::vector<double> &step, std::vector<double> &pull, std::vector<double> &weight) {
  const size_t w = pull.size();
  std::vector<double> from(w), half(w * w), whole(w * w);
  for (size_t l = 0; l < w; ++l)
    for (size_t i = 0; i < w; ++i) {
      from[i] += step[l * w + i] * pull[l];
      for (size_t j = 0; j < w; ++j)
        half[i * w + j] += step[l * w + i] * weight[l * w + j];
    }
  for (size_t i = 0; i < w; ++i)
    for (size_t l = 0; l < w; ++l)
      for (size_t j = 0; j < w; ++j)
        whole[i * w + j] += half[i * w + l] * step[l * w + j];
  pull.swap(from);
  weight.swap(whole);
}

} // namespace

int lacuna_latent_smooth(const lacuna_linear_model *model, const lacuna_latent *latent, const double *readings,
                         const unsigned char *seen, double *mean, double *deviation) {
  const lacuna_linear_model &m = *model;
  lacuna::Filter<1> filter(m, *latent, 0, 1);
  const size_t w = filter.w, n = m.samples;
  std::vector<double> states(n * w), covers(n * w * w);
  std::vector<Reading> taken;
  for (size_t k = 0; k < n; ++k) {
    std::copy(filter.state.begin(), filter.state.end(), &states[k * w]);
    std::copy(filter.cover.begin(), filter.cover.end(), &covers[k * w * w]);
    for (size_t o = 0; o < m.outputs; ++o) {
      if (!seen[k * m.outputs + o]) continue;
      filter.look(k, o);
      if (!filter.read(o, readings + k * m.outputs + o)) return 1;
      taken.push_back(reading(filter, k));
    }
    if (k + 1 < n) filter.move(k);
  }
  std::vector<double> pull(w), weight(w * w);
  for (size_t k = n; k-- > 0;) {
    if (k + 1 < n) back_over(transition(m, *latent, k), pull, weight);
    for (; !taken.empty() && taken.back().sample == k; taken.pop_back())
      back_over(taken.back(), pull, weight);
    for (size_t j = 0; j < latent->forces; ++j) {
      const size_t at = m.states + j;
      const double *row = &covers[(k * w + at) * w];
      double value = states[k * w + at], variance = row[at];
      for (size_t i = 0; i < w; ++i) {
        value += row[i] * pull[i];
        for (size_t l = 0; l < w; ++l)
          variance -= row[i] * weight[i * w + l] * row[l];
      }
      mean[j * n + k] = value;
      deviation[j * n + k] = std::sqrt(std::max(variance, 0.0));
    }
  }
  return 0;
}
