// Evidence of unknown forces: equations and sources in
// discovery/efforts/latent/smoother.py.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lacuna/lanes.hpp"
#include "lacuna/latent_filter.hpp"

namespace {

using std::size_t;

constexpr size_t side_by_side = 8; // hypotheses: whole cache lines

LACUNA_WIDEST
bool weigh(const lacuna_linear_model &m, const lacuna_latent &c, size_t first, const double *data,
           const unsigned char *seen, size_t columns, double *gram, double *log_determinant) {
  constexpr size_t L = side_by_side;
  lacuna::Filter<L> filter(m, c, first, columns);
  std::vector<double> sums(columns * columns * L), logs(L);
  for (size_t k = 0; k < m.samples; ++k) {
    for (size_t o = 0; o < m.outputs; ++o) {
      if (!seen[k * m.outputs + o]) continue;
      filter.look(k, o);
      if (!filter.read(o, data + (k * m.outputs + o) * columns)) return false;
      for (size_t i = 0; i < columns; ++i) {
        double weighed[L];
        for (size_t lane = 0; lane < L; ++lane)
          weighed[lane] = filter.innovation[i * L + lane] / filter.variance[lane];
        for (size_t j = 0; j <= i; ++j) // of a symmetric matrix
          for (size_t lane = 0; lane < L; ++lane)
            sums[(i * columns + j) * L + lane] += weighed[lane] * filter.innovation[j * L + lane];
      }
      for (size_t lane = 0; lane < L; ++lane)
        logs[lane] += std::log(filter.variance[lane] / (m.noise[o] * m.noise[o]));
    }
    if (k + 1 < m.samples) filter.move(k);
  }
  for (size_t lane = 0; lane < std::min(L, c.hypotheses - first); ++lane) {
    log_determinant[first + lane] += logs[lane];
    double *whole = gram + (first + lane) * columns * columns;
    for (size_t i = 0; i < columns; ++i)
      for (size_t j = 0; j < columns; ++j)
        whole[i * columns + j] += sums[(std::max(i, j) * columns + std::min(i, j)) * L + lane];
  }
  return true;
}

} // namespace

int lacuna_latent_evidence(const lacuna_linear_model *model, const lacuna_latent *latent, const double *data,
                           const unsigned char *seen, size_t columns, double *gram, double *log_determinant) {
  for (size_t first = 0; first < latent->hypotheses; first += side_by_side)
    if (!weigh(*model, *latent, first, data, seen, columns, gram, log_determinant)) return 1;
  return 0;
}
