#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <new>
#include <random>

#include "app/own_folder.h"
#include "import/import.h"
#include "mesh/mesh_file.h"
#include "scene/file/scene_file.h"
#include "unit/import/mitsuba_text.h"
#include "unit/mesh/mesh_bytes.h"

// Files that are sound but for some bytes: each is read or refused with one line, within the memory
// that its size allows.
namespace {

std::atomic<std::size_t> taken{0}, most_taken{0};

// AddressSanitizer has allocation functions of its own.
#ifndef __SANITIZE_ADDRESS__
void* counted(std::size_t size) {
  constexpr std::size_t head = alignof(std::max_align_t);
  auto* block = static_cast<char*>(std::malloc(size + head));
  if (!block) throw std::bad_alloc();
  *reinterpret_cast<std::size_t*>(block) = size;
  const std::size_t now = taken += size;
  for (std::size_t most = most_taken; now > most && !most_taken.compare_exchange_weak(most, now);) {
  }
  return block + head;
}

void release(void* memory) {
  if (!memory) return;
  char* block = static_cast<char*>(memory) - alignof(std::max_align_t);
  taken -= *reinterpret_cast<std::size_t*>(block);
  std::free(block);
}
#endif

}  // namespace

#ifndef __SANITIZE_ADDRESS__
void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
#endif

namespace glimt {
namespace {

using namespace testing;

/// What reading may take: bytes in all, for a file of so many.
std::size_t allowed(std::size_t file_size) { return (std::size_t{64} << 20) + 256 * file_size; }

std::string mutated(std::string bytes, std::mt19937& random) {
  static const std::vector<std::string> words{
      "0",  "-1",       "3",  "100000000", "4294967295", "1e999",      "nan", "-inf", "f 1 2 3\n", "/",
      "\"", "{",        "}",  "[",         "]",          "<",          ">",   "$a",   "\n",        "\r",
      " ",  "\xff\xff", "\\", "null",      "true",       "2147483648", "v ",  "list", "usemtl x\n"};
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (std::size_t edits = 1 + below(6); edits > 0; --edits) {
    if (bytes.empty()) bytes = " ";
    const std::size_t at = below(bytes.size()), length = 1 + below(std::min<std::size_t>(bytes.size() - at, 24));
    switch (below(7)) {
      case 0:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(below(bytes.size()), bytes.substr(at, length));
        break;
      case 4:
        bytes.insert(at, words[below(words.size())]);
        break;
      case 5:
        bytes.replace(at, length, words[below(words.size())]);
        break;
      default:
        bytes.resize(below(8) == 0 ? at : bytes.size());
    }
  }
  return bytes;
}

struct Seed {
  std::string name;  ///< of the file
  std::string bytes;
};

std::vector<Seed> seeds() {
  nlohmann::json embedded = gltf_triangle();
  embedded["buffers"][0]["uri"] =
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAIA/AAABAAIAAAA=";
  return {{"a.obj", obj_tetrahedron},
          {"a.ply", ply_tetrahedron},
          {"b.ply", binary_ply_tetrahedron(false)},
          {"c.ply", binary_ply_tetrahedron(true)},
          {"a.glb", glb_triangle()},
          {"a.gltf", embedded.dump(1)},
          {"a.xml", mitsuba_room}};
}

class MeshFuzz : public OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    std::ofstream("part.obj") << obj_tetrahedron;
    std::ofstream("part.ply") << ply_tetrahedron;
  }

  /// Reads `count` files that are made of each sound one.
  void read_mutants(int count, unsigned seed) {
    int accepted = 0, refused = 0;
    for (const Seed& sound : seeds()) {
      ASSERT_NO_THROW(import_scene(written(sound.name, sound.bytes))) << sound.name;
      std::mt19937 random(seed);
      for (int i = 0; i < count; ++i) {
        const std::string bytes = mutated(sound.bytes, random);
        const std::filesystem::path file = written(sound.name, bytes);
        const std::size_t before = taken;
        most_taken = before;
        try {
          import_scene(file);
          ++accepted;
        } catch (const SceneError& error) {
          ++refused;
          EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
        EXPECT_LT(most_taken - before, allowed(bytes.size()));
        if (HasFailure()) FAIL() << sound.name << ", seed " << seed << ", mutant " << i << ":\n" << bytes;
      }
    }
    EXPECT_GT(accepted, count / 10) << "the mutants are too wild to test what is read";
    EXPECT_GT(refused, count / 10);
  }

 private:
  static std::filesystem::path written(const std::string& name, const std::string& bytes) {
    std::ofstream(name, std::ios::binary) << bytes;
    return name;
  }
};

TEST_F(MeshFuzz, MutantsAreReadOrRefused) { read_mutants(100, 1); }

class MeshFuzzLong : public MeshFuzz {};

TEST_F(MeshFuzzLong, TenThousandMutantsAreReadOrRefused) { read_mutants(10000 / 7 + 1, 2); }

}  // namespace
}  // namespace glimt
