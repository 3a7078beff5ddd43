// libFuzzer's entry. GLIMT_FUZZ_TARGET names the target.
#include <cstddef>
#include <cstdint>

#include "unit/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  glimt::fuzz::GLIMT_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
