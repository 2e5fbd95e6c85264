#include "malloc_trap.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> count = 0;
}

long allocations() {
  return count;
}

extern "C" {
void *__real_malloc(std::size_t size);
void *__real_calloc(std::size_t number, std::size_t size);
void *__real_realloc(void *memory, std::size_t size);

void *__wrap_malloc(std::size_t size) {
  ++count;
  return __real_malloc(size);
}
void *__wrap_calloc(std::size_t number, std::size_t size) {
  ++count;
  return __real_calloc(number, size);
}
void *__wrap_realloc(void *memory, std::size_t size) {
  ++count;
  return __real_realloc(memory, size);
}
}

// Every other form of operator new, arrays included, comes down to these two.
void *operator new(std::size_t size) {
  ++count;
  if (void *memory = __real_malloc(size)) return memory;
  throw std::bad_alloc();
}

void *operator new(std::size_t size, std::align_val_t alignment) {
  ++count;
  const auto step = static_cast<std::size_t>(alignment);
  if (void *memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  throw std::bad_alloc();
}

void operator delete(void *memory) noexcept {
  std::free(memory);
}
void operator delete(void *memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void *memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void *memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
