// Columns side by side, in as wide a unit as the processor has: what is done to each is the same, and so to the bit on
// every processor (no fused multiply-add, no sums across columns).
#pragma once

#include <cstddef>
#include <cstring>

// A function by the widest unit there is, chosen when the library is loaded: before sanitizers can follow.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&                           \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LACUNA_WIDEST __attribute__((target_clones("avx512f", "avx2", "default"), flatten))
#else
#define LACUNA_WIDEST
#endif

namespace lacuna {

constexpr std::size_t lanes = 16; // two cache lines: four registers of AVX, which hide one another's latency

/// Columns that stay in registers.
struct Lanes {
  typedef double Register __attribute__((vector_size(32), aligned(8)));
  Register a{}, b{}, c{}, d{};

  /// To each column what a number makes of those of others.
  void add(double by, const Lanes &from) {
    a += by * from.a;
    b += by * from.b;
    c += by * from.c;
    d += by * from.d;
  }
  Lanes less(const Lanes &other) const { return {a - other.a, b - other.b, c - other.c, d - other.d}; }
  Lanes over(double divisor) const { return {a / divisor, b / divisor, c / divisor, d / divisor}; }
  static Lanes scaled(double by, const Lanes &from) { return {by * from.a, by * from.b, by * from.c, by * from.d}; }

  static Lanes load(const double *from) {
    Lanes to;
    std::memcpy(&to.a, from, sizeof a);
    std::memcpy(&to.b, from + 4, sizeof b);
    std::memcpy(&to.c, from + 8, sizeof c);
    std::memcpy(&to.d, from + 12, sizeof d);
    return to;
  }
  void store(double *to) const {
    std::memcpy(to, &a, sizeof a);
    std::memcpy(to + 4, &b, sizeof b);
    std::memcpy(to + 8, &c, sizeof c);
    std::memcpy(to + 12, &d, sizeof d);
  }

  /// The first `count` columns, and zeros.
  static Lanes load(const double *from, std::size_t count) {
    if (count >= lanes) return load(from);
    double each[lanes] = {};
    std::memcpy(each, from, count * sizeof(double));
    return load(each);
  }
  void store(double *to, std::size_t count) const {
    if (count >= lanes) return store(to);
    double each[lanes];
    store(each);
    std::memcpy(to, each, count * sizeof(double));
  }
};

} // namespace lacuna
