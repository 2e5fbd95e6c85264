// The step of the Gaussian-sum filter from test to test: equations and sources in analysis/prognosis/filter/filter.py.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "lacuna_analysis.h"

namespace {

constexpr double root_2pi = 2.5066282746310002;
constexpr double impossible = 120; // square of a deviation whose density is 1e-26 of the greatest
constexpr double steepest = 50.0;  // growth of a deviation between two tests: beyond it a Gaussian means nothing

/// log2 of a positive normal number to 0.01, enough to begin a search with: exponent, and a parabola over the mantissa.
double about_log2(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const double m = std::bit_cast<double>((bits & 0xFFFFFFFFFFFFFULL) | 0x3FF0000000000000ULL) - 1;
  return static_cast<double>(static_cast<std::int64_t>(bits >> 52) - 1023) + m * (1.3465 - 0.3465 * m);
}

/// Growth and age of one law between the points of its table; beyond both ends growth is constant.
struct Law {
  const double *x, *g, *u;
  std::size_t last;
  double per_octave;

  std::size_t cell(double at) const {
    if (!(at > x[0])) return 0;
    if (at >= x[last - 1]) return last - 1;
    auto k = std::min(static_cast<std::size_t>(about_log2(at / x[0]) * per_octave), last - 1);
    while (k > 0 && at < x[k])
      --k;
    while (k + 1 < last && at >= x[k + 1])
      ++k;
    return k;
  }
  double growth(std::size_t k, double at) const {
    const double inside = std::clamp(at, x[0], x[last]);
    return g[k] + (g[k + 1] - g[k]) * (inside - x[k]) / (x[k + 1] - x[k]);
  }
  double age(std::size_t k, double at) const {
    if (at <= x[0]) return u[0] + (at - x[0]) / g[0];
    if (at >= x[last]) return u[last] + (at - x[last]) / g[last];
    return u[k] + (u[k + 1] - u[k]) * (at - x[k]) / (x[k + 1] - x[k]);
  }
  /// The severity at an age, and its cell, looked for from cell `k` on.
  double severity(std::size_t &k, double at) const {
    if (at <= u[0]) {
      k = 0;
      return x[0] + (at - u[0]) * g[0];
    }
    if (at >= u[last]) {
      k = last - 1;
      return x[last] + (at - u[last]) * g[last];
    }
    if (at >= u[std::min(k + 16, last)])
      k = static_cast<std::size_t>(std::upper_bound(u + k + 16, u + last + 1, at) - u) - 1;
    while (k + 1 < last && at >= u[k + 1])
      ++k;
    return x[k] + (x[k + 1] - x[k]) * (at - u[k]) / (u[k + 1] - u[k]);
  }
};

struct Gaussian {
  double x, l, xx, xl, ll, along, turn;
};

Gaussian predicted_of(const Law &law, Gaussian b, double use, double wander2, double diffusion2, double life) {
  const double moved = std::exp(std::min(b.l, 700.0)) * use;
  std::size_t k = law.cell(b.x);
  const double here = law.growth(k, b.x), age = law.age(k, b.x);
  const double x = law.severity(k, age + moved), growth = law.growth(k, x);
  b.along = std::min(growth / here, steepest);
  b.turn = std::min(moved * growth, steepest);
  const double xl = b.along * b.xl + b.turn * b.ll;
  b.xx = b.along * b.along * b.xx + b.turn * (b.along * b.xl + xl) + diffusion2 * std::max(x - b.x, 0.0);
  b.xl = xl;
  b.ll += wander2 * std::min(moved / life, 1.0);
  b.x = x;
  return b;
}

/// Sums over the ways in which a test can be read.
struct Merged {
  double total, dx = 0, dl = 0, xx, xl, ll;

  Merged(const Gaussian &b, double density)
      : total(density), xx(density * b.xx), xl(density * b.xl), ll(density * b.ll) {}

  void add(double share, double miss, double pxx, double pxl, double pll, double variance) {
    const double sharpness = 1 / (pxx + variance), gain = pxx * sharpness, turned = pxl * sharpness;
    if (miss * miss * sharpness > impossible) return;
    const double p = share / root_2pi * std::exp(-0.5 * miss * miss * sharpness) * std::sqrt(sharpness);
    const double ex = gain * miss, el = turned * miss;
    total += p;
    dx += p * ex;
    dl += p * el;
    xx += p * (pxx - gain * pxx + ex * ex);
    xl += p * (pxl - gain * pxl + ex * el);
    ll += p * (pll - turned * pxl + el * el);
  }

  void apply(Gaussian &b) const {
    const double each = 1 / total, ex = dx * each, el = dl * each;
    b.x += ex;
    b.l += el;
    b.xx = xx * each - ex * ex;
    b.xl = xl * each - ex * el;
    b.ll = ll * each - el * el;
  }
};

/// The likelihood of a reading, after which `b` is the posterior.
double updated(const lacuna_hypotheses &h, Gaussian &b, double value, double below, double above, double change,
               double common) {
  const double miss = value - b.x, deviation = miss < 0 ? above : below;
  const double variance = (1 - common) * deviation * deviation;
  Merged merged(b, h.outlier / h.outlier_range);
  merged.add(1 - h.wide - h.outlier - change, miss, b.xx, b.xl, b.ll, variance);
  if (h.wide > 0) merged.add(h.wide, miss, b.xx, b.xl, b.ll, h.wide_scale * h.wide_scale * variance);
  if (change > 0) {
    const double jump = h.change_size * h.change_size;
    merged.add(change, miss, b.xx + jump * b.turn * b.turn, b.xl + jump * b.turn, b.ll + jump, variance);
  }
  merged.apply(b);
  return merged.total;
}

} // namespace

void lacuna_hypotheses_test(const lacuna_hypotheses *hypotheses, const lacuna_tests *tests, lacuna_beliefs *beliefs,
                            lacuna_beliefs *predicted, double *along, double *turn, double *outlier, double *evidence) {
  const lacuna_hypotheses &h = *hypotheses;
  const std::size_t last = h.points - 1;
  const double per_octave = static_cast<double>(last) / std::log2(h.severity[last] / h.severity[0]);
  for (std::size_t b = 0; b < h.histories; ++b) {
    double sum = 0, before = 0;
    for (std::size_t s = 0; s < h.laws; ++s) {
      const Law law{h.severity, h.growth + s * h.points, h.age + s * h.points, last, per_octave};
      for (std::size_t k = 0; k < h.columns; ++k) {
        const std::size_t i = (s * h.histories + b) * h.columns + k, c = s * h.columns + k;
        if (beliefs->w[i] < h.gone) {
          beliefs->w[i] = 0;
          continue;
        }
        before += beliefs->w[i];
        const Gaussian old{beliefs->x[i], beliefs->l[i], beliefs->xx[i], beliefs->xl[i], beliefs->ll[i], 0, 0};
        Gaussian g = predicted_of(law, old, tests->use[b], h.wander2[c], h.diffusion2[c], h.life[s]);
        if (predicted) {
          predicted->x[i] = g.x, predicted->l[i] = g.l;
          predicted->xx[i] = g.xx, predicted->xl[i] = g.xl, predicted->ll[i] = g.ll;
          along[i] = g.along, turn[i] = g.turn;
        }
        if (tests->valid[b])
          beliefs->w[i] *= updated(h, g, tests->value[b], tests->below[b], tests->above[b], h.change[c], h.common[c]);
        sum += beliefs->w[i];
        beliefs->x[i] = g.x, beliefs->l[i] = g.l;
        beliefs->xx[i] = g.xx, beliefs->xl[i] = g.xl, beliefs->ll[i] = g.ll;
      }
    }
    outlier[b] = tests->valid[b] ? before * h.outlier / h.outlier_range / sum : 0;
    evidence[b] = tests->valid[b] ? sum / before : 1;
    for (std::size_t s = 0; s < h.laws; ++s)
      for (std::size_t k = 0; k < h.columns; ++k)
        beliefs->w[(s * h.histories + b) * h.columns + k] /= sum;
  }
}
