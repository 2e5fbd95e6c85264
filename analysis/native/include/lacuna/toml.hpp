// The part of TOML that settings files use: comments, [table], [[array of tables]], and `key = value` where the value
// is a number, a boolean, a basic string, or a one-line array of these. Anything else is refused with its line.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lacuna::toml {

struct Value {
  using Array = std::vector<Value>;
  std::variant<double, bool, std::string, Array> data;
};

/// One table; its getters throw Error, naming table and key, where the key is missing or of another type.
class Table {
public:
  explicit Table(std::string name = "") : name_(std::move(name)) {}
  bool has(const std::string &key) const { return values_.contains(key); }
  double number(const std::string &key) const;
  std::string text(const std::string &key) const;
  std::vector<std::string> texts(const std::string &key) const;
  void set(const std::string &key, Value value);

private:
  const Value &at(const std::string &key) const;
  std::string name_;
  std::map<std::string, Value> values_;
};

class Document {
public:
  /// Throws Error with the line number where the text is not in this part of TOML.
  explicit Document(std::string_view text);
  /// The table of that name; an Error if there is none or several.
  const Table &table(const std::string &name) const;
  /// All tables of that name, in order.
  std::vector<Table> tables(const std::string &name) const;

private:
  std::multimap<std::string, Table> tables_;
};

} // namespace lacuna::toml
