#include "film/large_memory.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <memory>

namespace glimt {
namespace {

constexpr std::size_t page = 4096;
constexpr std::size_t huge_page = std::size_t{1} << 21;

bool is_large(std::size_t bytes) { return bytes >= huge_page / 2; }

std::size_t whole_pages(std::size_t bytes) { return (bytes + huge_page - 1) / huge_page * huge_page; }

}  // namespace

void use_huge_pages(void* memory, std::size_t bytes) {
  if (is_large(bytes) && std::align(page, huge_page, memory, bytes)) madvise(memory, bytes, MADV_HUGEPAGE);
}

void* allocate_zeros(std::size_t bytes) {
  if (!is_large(bytes)) return std::calloc(bytes, 1);
  if (bytes > SIZE_MAX / 2) return nullptr;
  // One page more than needed, so that aligned huge pages can be cut out.
  const std::size_t size = whole_pages(bytes);
  std::size_t left = size + huge_page;
  void* const start = mmap(nullptr, left, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (start == MAP_FAILED) return nullptr;
  void* memory = start;
  std::align(huge_page, size, memory, left);
  char* const end = static_cast<char*>(memory) + size;
  if (const std::size_t before = size + huge_page - left; before > 0) munmap(start, before);
  if (const std::size_t behind = left - size; behind > 0) munmap(end, behind);
  use_huge_pages(memory, size);
  return memory;
}

void free_zeros(void* memory, std::size_t bytes) {
  if (is_large(bytes))
    munmap(memory, whole_pages(bytes));
  else
    std::free(memory);
}

}  // namespace glimt
