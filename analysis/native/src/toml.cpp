#include "lacuna/toml.hpp"

#include <cctype>
#include <charconv>
#include <utility>

#include "lacuna/error.hpp"

namespace lacuna::toml {

namespace {

constexpr int deepest = 16; // arrays inside each other; settings need one

/// Reads one line of a document; `number` is for messages.
class Line {
public:
  Line(std::string_view text, int number) : rest_(text), number_(number) {}

  [[noreturn]] void refuse(const std::string &why) const {
    throw Error("settings, line " + std::to_string(number_) + ": " + why);
  }

  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\r'))
      rest_.remove_prefix(1);
  }

  bool at_end() {
    skip_blanks();
    return rest_.empty() || rest_.front() == '#';
  }

  bool accept(std::string_view token) {
    skip_blanks();
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  void expect(std::string_view token) {
    if (!accept(token)) refuse("'" + std::string(token) + "' expected");
  }

  void expect_end() {
    if (!at_end()) refuse("unexpected '" + std::string(rest_) + "'");
  }

  std::string bare_key() {
    skip_blanks();
    std::size_t n = 0;
    while (n < rest_.size() &&
           (std::isalnum(static_cast<unsigned char>(rest_[n])) || rest_[n] == '_' || rest_[n] == '-'))
      ++n;
    if (n == 0) refuse("a key of letters, digits, _ and - expected");
    return take(n);
  }

  Value value(int depth = 0) {
    if (accept("true")) return {true};
    if (accept("false")) return {false};
    if (accept("\"")) return {string_tail()};
    if (accept("[")) return {array_tail(depth + 1)};
    return {number()};
  }

private:
  std::string take(std::size_t n) {
    std::string taken(rest_.substr(0, n));
    rest_.remove_prefix(n);
    return taken;
  }

  std::string string_tail() {
    const std::size_t end = rest_.find('"');
    if (end == std::string_view::npos) refuse("the string does not end on this line");
    if (rest_.substr(0, end).find('\\') != std::string_view::npos) refuse("escapes in strings are not supported");
    std::string text = take(end);
    rest_.remove_prefix(1);
    return text;
  }

  Value::Array array_tail(int depth) {
    Value::Array items;
    if (depth > deepest) refuse("arrays are nested more than " + std::to_string(deepest) + " deep");
    if (accept("]")) return items;
    do
      items.push_back(value(depth));
    while (accept(","));
    expect("]");
    return items;
  }

  double number() {
    double result = 0;
    accept("+");
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), result);
    if (error != std::errc() || end == rest_.data())
      refuse("a number, a string in quotes, true, false or an array expected");
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return result;
  }

  std::string_view rest_;
  int number_;
};

[[noreturn]] void refuse(const std::string &table, const std::string &key, const char *why) {
  std::string text("settings: ");
  if (!table.empty()) text.append(table).append(".");
  throw Error(text.append(key).append(" ").append(why));
}

} // namespace

const Value &Table::at(const std::string &key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) refuse(name_, key, "is missing");
  return found->second;
}

double Table::number(const std::string &key) const {
  if (const auto *number = std::get_if<double>(&at(key).data)) return *number;
  refuse(name_, key, "must be a number");
}

std::string Table::text(const std::string &key) const {
  if (const auto *text = std::get_if<std::string>(&at(key).data)) return *text;
  refuse(name_, key, "must be a string");
}

std::vector<std::string> Table::texts(const std::string &key) const {
  std::vector<std::string> result;
  if (const auto *array = std::get_if<Value::Array>(&at(key).data))
    for (const Value &item : *array)
      if (const auto *text = std::get_if<std::string>(&item.data))
        result.push_back(*text);
      else
        refuse(name_, key, "must hold strings only");
  else
    refuse(name_, key, "must be an array of strings");
  return result;
}

void Table::set(const std::string &key, Value value) {
  if (!values_.emplace(key, std::move(value)).second) refuse(name_, key, "is given twice");
}

Document::Document(std::string_view text) {
  auto current = tables_.emplace("", Table());
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    Line line(text.substr(0, end), number);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (line.at_end()) continue;
    if (line.accept("[[")) {
      const std::string name = line.bare_key();
      line.expect("]]");
      current = tables_.emplace(name, Table(name));
    } else if (line.accept("[")) {
      const std::string name = line.bare_key();
      line.expect("]");
      if (tables_.contains(name)) line.refuse("table [" + name + "] is given twice");
      current = tables_.emplace(name, Table(name));
    } else {
      const std::string key = line.bare_key();
      line.expect("=");
      current->second.set(key, line.value());
    }
    line.expect_end();
  }
}

const Table &Document::table(const std::string &name) const {
  const std::size_t count = tables_.count(name);
  if (count != 1) refuse("", name, count == 0 ? "is missing (a table)" : "is given more than once");
  return tables_.find(name)->second;
}

std::vector<Table> Document::tables(const std::string &name) const {
  std::vector<Table> result;
  const auto [first, last] = tables_.equal_range(name);
  for (auto it = first; it != last; ++it)
    result.push_back(it->second);
  return result;
}

} // namespace lacuna::toml
