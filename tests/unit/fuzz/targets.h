#pragma once

#include <span>
#include <string_view>

/// What reads files that anybody may have made. Each function takes any bytes; it returns whatever they are, or ends
/// the program where something is wrong with glimt.
namespace glimt::fuzz {

/// The text of a scene. What compiles is rendered, one sample a pixel; what is read is written and read back.
void scene(std::string_view bytes);

/// A value for --set on each line, for a scene with everything in it.
void overrides(std::string_view bytes);

/// An EXR, a PFM and a PNG.
void image(std::string_view bytes);

/// A checkpoint. Its checksum is made right first, which only a forger can do.
void checkpoint(std::string_view bytes);

struct Target {
  std::string_view name;
  void (*run)(std::string_view bytes);
};
std::span<const Target> targets();

}  // namespace glimt::fuzz
