#pragma once

#include <cstddef>
#include <new>

/// Memory of films and pictures. The system hands out memory in pages. With pages of 4 kB this takes longer than
/// tracing a path through every pixel of the film. With huge pages, where the system has them, it takes no time.
namespace glimt {

/// Asks for huge pages in memory that has not been written to yet.
void use_huge_pages(void* memory, std::size_t bytes);

/// Zeros; null where there is no memory.
void* allocate_zeros(std::size_t bytes);
void free_zeros(void* memory, std::size_t bytes);

/// Allocates memory that the system has filled with zeros. Nothing writes to it first, so a large film is there at once
/// and takes a page only when a sample is added to it.
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
