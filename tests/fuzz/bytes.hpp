// Takes values off the front of what the fuzzer gives; zeros where there is nothing left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

class Bytes {
public:
  Bytes(const std::uint8_t *data, std::size_t size) : at_(data), left_(size) {}

  template <typename T> T next() {
    T value{};
    const std::size_t n = left_ < sizeof value ? left_ : sizeof value;
    if (n) std::memcpy(&value, at_, n);
    at_ += n;
    left_ -= n;
    return value;
  }

  std::size_t left() const { return left_; }
  std::string rest() const { return {reinterpret_cast<const char *>(at_), left_}; }

private:
  const std::uint8_t *at_;
  std::size_t left_;
};

/// What must hold whatever came in.
inline void require(bool holds, const char *what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}
