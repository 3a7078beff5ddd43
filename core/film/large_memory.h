#pragma once

#include <cstddef>
#include <new>

/// Memory for films and pictures. The system hands out memory in pages. With pages of 4 kB this takes longer than
/// tracing one path through every pixel of the film. With huge pages, if the system has them, it takes next to no time.
namespace glimt {

/// Asks the system for huge pages. The memory must not have been written to yet.
void use_huge_pages(void* memory, std::size_t bytes);

/// Allocates memory filled with zeros; null where there is none.
void* allocate_zeros(std::size_t bytes);
void free_zeros(void* memory, std::size_t bytes);

/// An allocator of memory that the system fills with zeros. Nothing writes to it first. So making a large film takes no
/// time, and the film takes a page only when a sample is added to it.
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
