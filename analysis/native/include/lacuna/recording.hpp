// A recording from a CSV file: `time` first, then one column a signal, and perhaps `event` (1: a row that a simulation
// added at an event, off the sampling grid).
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace lacuna {

class Recording {
public:
  /// Reads the named columns at `sampling_rate`, `samples` rows at most. Throws Error naming the column or the line:
  /// missing column, a field that is not a number, a time that is not on the sampling grid, too few samples.
  /// A column `optional` (unless empty) is read too where there is one.
  static Recording read(std::istream &csv, const std::vector<std::string> &columns, const std::string &optional,
                        double sampling_rate, std::size_t samples);

  std::span<const double> column(std::size_t k) const { return columns_[k]; }
  /// The optional column; empty where the file has none.
  std::span<const double> optional() const { return optional_; }

private:
  std::vector<std::vector<double>> columns_;
  std::vector<double> optional_;
};

} // namespace lacuna
