#include "lacuna/recording.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <optional>

#include "lacuna/error.hpp"

namespace lacuna {

namespace {

// How far, in sampling periods, the time of a row may be from its place on the grid: rounding of decimal text. A row at
// an event may be near the grid by chance, and is a sample only if it is on it.
constexpr double time_slack = 1e-2, event_slack = 1e-7;

/// Header fields; quotes protect commas, as in "x[1,2]".
std::vector<std::string> split_header(const std::string &line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else if (c != '\r')
      fields.back() += c;
  }
  return fields;
}

class Rows {
public:
  Rows(std::istream &csv, std::size_t width) : csv_(csv), fields_(width) {}

  /// The next row's fields (empty fields are NaN), or nothing at the end.
  const std::vector<double> *next() {
    if (!std::getline(csv_, line_)) return nullptr;
    ++number_;
    const char *at = line_.data(), *end = at + line_.size();
    if (end > at && end[-1] == '\r') --end;
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      at = read_field(at, end, fields_[k]);
      const bool last = k + 1 == fields_.size();
      if (last != (at == end)) refuse("has not the " + std::to_string(fields_.size()) + " fields of the header");
      if (!last) ++at;
    }
    return &fields_;
  }

  [[noreturn]] void refuse(const std::string &why) const {
    throw Error("recording, line " + std::to_string(number_) + ": " + why);
  }

private:
  /// Reads up to the next comma or the end of the line, which it returns.
  const char *read_field(const char *at, const char *end, double &value) const {
    value = std::nan("");
    const char *stop = std::find(at, end, ',');
    while (at < stop && *at == ' ')
      ++at;
    if (at == stop) return stop;
    const auto [rest, error] = std::from_chars(at, stop, value);
    if (error != std::errc() || rest != stop) refuse(std::string(at, stop) + " is not a number");
    return stop;
  }

  std::istream &csv_;
  std::string line_;
  std::vector<double> fields_;
  std::size_t number_ = 1;
};

/// The place of a column; an Error where two are called so.
std::optional<std::size_t> position(const std::vector<std::string> &header, const std::string &name) {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) return std::nullopt;
  if (std::find(found + 1, header.end(), name) != header.end())
    throw Error("recording: two columns are called '" + name + "'");
  return static_cast<std::size_t>(found - header.begin());
}

std::string listed(const std::vector<std::string> &names) {
  std::string text;
  for (const std::string &name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

} // namespace

Recording Recording::read(std::istream &csv, const std::vector<std::string> &columns, const std::string &optional,
                          double sampling_rate, std::size_t samples) {
  std::string line;
  if (!std::getline(csv, line)) throw Error("recording: the file is empty");
  const std::vector<std::string> header = split_header(line);
  if (header.front() != "time") throw Error("recording: the first column must be 'time', not '" + header.front() + "'");
  const auto event = position(header, "event");
  std::vector<std::size_t> places;
  for (const std::string &name : columns) {
    const auto place = position(header, name);
    if (!place) throw Error("recording: there is no column '" + name + "'; it has " + listed(header));
    places.push_back(*place);
  }
  const auto extra = optional.empty() ? std::nullopt : position(header, optional);
  Recording recording;
  recording.columns_.resize(columns.size());
  for (auto &column : recording.columns_)
    column.reserve(samples);
  Rows rows(csv, header.size());
  double start = std::nan("");
  for (std::size_t taken = 0; taken < samples;) {
    const std::vector<double> *row = rows.next();
    if (!row)
      throw Error("recording: it ends after " + std::to_string(taken) + " samples, " + std::to_string(samples) +
                  " are needed");
    const double time = row->front();
    if (taken == 0) start = time;
    const double off_grid = std::abs((time - start) * sampling_rate - static_cast<double>(taken));
    const bool at_event = event && (*row)[*event] != 0;
    if (!(off_grid <= (at_event ? event_slack : time_slack))) {
      if (at_event) continue;
      rows.refuse("time " + std::to_string(time) + " s is not sample " + std::to_string(taken) + " at " +
                  std::to_string(sampling_rate) + " Hz");
    }
    for (std::size_t k = 0; k < places.size(); ++k)
      recording.columns_[k].push_back((*row)[places[k]]);
    if (extra) recording.optional_.push_back((*row)[*extra]);
    ++taken;
  }
  return recording;
}

} // namespace lacuna
