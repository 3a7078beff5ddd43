#pragma once

#include <cstddef>
#include <new>

/// Memory of films and pictures. Pages of 4 kB, to be given and to be given back, take a film longer than a path
/// through each of its pixels; huge ones, where the system has them, do not.
namespace glimt {

/// Asks for huge pages in memory that has not been written to yet.
void use_huge_pages(void* memory, std::size_t bytes);

/// Zeros; null where there is no memory.
void* allocate_zeros(std::size_t bytes);
void free_zeros(void* memory, std::size_t bytes);

/// Allocator of memory that is zero without being written to, so that a large film is there at once and its pages come
/// as they are needed.
template <class T>
struct ZeroedMemory {
  using value_type = T;

  T* allocate(std::size_t n) {
    if (void* memory = allocate_zeros(n * sizeof(T))) return static_cast<T*>(memory);
    throw std::bad_alloc();
  }
  void deallocate(T* memory, std::size_t n) { free_zeros(memory, n * sizeof(T)); }
  void construct(T*) {}
  void construct(T* place, const T& value) { *place = value; }

  bool operator==(const ZeroedMemory&) const = default;
};

}  // namespace glimt
