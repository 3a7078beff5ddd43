#include "film/image_file.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>
#include <stb_image.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

using namespace glimt;
namespace fs = std::filesystem;

namespace {

const Metadata some_metadata{{"scene", "name = \"R\u00e4ume\"\n# two lines\n"}, {"samples", "5"}, {"version", "0.1.0"}};

/// A folder of its own for each test.
class ImageFile : public testing::Test {
 protected:
  ImageFile() {
    fs::create_directories(folder);
    for (int i = 0; i < 3 * 5; ++i) {
      const auto value = static_cast<float>(i);
      film.add(i / 3, 0, value / 8, value / 16, value / 32);
      film.add(i / 3, 1, value / 4, value / 16, 0);
    }
    film.finish_pass(6);
  }
  ~ImageFile() override {
    fs::permissions(folder, fs::perms::owner_all);
    fs::remove_all(folder);
  }

  static std::string read(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  }
  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  const fs::path folder = fs::path(testing::TempDir()) / ("glimt_" + std::to_string(getpid()));
  Film film{5, 1, 8};
};

/// What f throws as an ImageFileError; every message must name the file.
template <class F>
std::string message_of(const fs::path& file, F f) {
  try {
    f();
  } catch (const ImageFileError& error) {
    EXPECT_NE(std::string(error.what()).find(file.filename().string()), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "nothing thrown";
}

std::string read_error(const fs::path& file) {
  return message_of(file, [&] { read_image(file); });
}

std::string write_error(const fs::path& file) {
  return message_of(file, [&] { check_writable(file); });
}

void expect_has(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" lacks \"" << part << "\"";
}

TEST_F(ImageFile, PngIsTheDisplayedPicture) {
  const Display display{1.5};
  write_image(folder / "a.png", film, display, some_metadata);
  int width, height, channels;
  stbi_uc* pixels = stbi_load((folder / "a.png").c_str(), &width, &height, &channels, 0);
  ASSERT_TRUE(pixels);
  EXPECT_EQ(width, 5);
  EXPECT_EQ(height, 1);
  EXPECT_EQ(channels, 3);
  EXPECT_EQ(std::vector<std::uint8_t>(pixels, pixels + 15), to_srgb8(film.mean(), display));
  stbi_image_free(pixels);
}

TEST_F(ImageFile, PngCarriesTheMetadataAndTheDisplay) {
  write_image(folder / "a.png", film, {-0.25}, some_metadata);
  Metadata expected = some_metadata;
  expected["dither"] = "on";
  expected["exposure"] = "-0.25";
  expected["tone"] = "linear";
  expected["view"] = "image";
  EXPECT_EQ(read_metadata(folder / "a.png"), expected);
}

TEST_F(ImageFile, ExrHasTheMeanAndItsErrorAsFloats) {
  write_image(folder / "a.exr", film, {}, some_metadata);
  Imf::InputFile input((folder / "a.exr").c_str());
  std::vector<std::string> names;
  std::vector<std::vector<float>> values;
  for (auto channel = input.header().channels().begin(); channel != input.header().channels().end(); ++channel) {
    EXPECT_EQ(channel.channel().type, Imf::FLOAT);
    names.emplace_back(channel.name());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"B", "G", "R", "error.B", "error.G", "error.R"}));
  Imf::FrameBuffer buffer;
  values.resize(names.size(), std::vector<float>(5));
  for (std::size_t i = 0; i < names.size(); ++i)
    buffer.insert(names[i], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values[i].data()), sizeof(float), 0));
  input.setFrameBuffer(buffer);
  input.readPixels(0, 0);
  const Image mean = film.mean(), error = film.standard_error();
  for (std::size_t i = 0; i < names.size(); ++i)
    for (int x = 0; x < 5; ++x) {
      const Image& expected = i < 3 ? mean : error;
      EXPECT_EQ(values[i][static_cast<std::size_t>(x)], expected.pixel(x, 0)[2 - i % 3]) << names[i] << " " << x;
    }
  EXPECT_EQ(read_metadata(folder / "a.exr"), some_metadata);
}

TEST_F(ImageFile, ExrAndPfmReadBackExactly) {
  Film tall(3, 7, 1);
  for (int i = 0; i < 21; ++i) tall.add(i, 0, static_cast<float>(i) / 64, 0.3f, 1e-7f * static_cast<float>(i));
  tall.finish_pass(1);
  for (const char* name : {"a.exr", "a.pfm"}) {
    write_image(folder / name, tall, {}, {});
    const Image image = read_image(folder / name);
    EXPECT_EQ(image.width, 3);
    EXPECT_EQ(image.height, 7);
    EXPECT_EQ(image.rgb, tall.mean().rgb) << name;
    EXPECT_TRUE(read_metadata(folder / name).empty());
  }
}

TEST_F(ImageFile, PfmIsLittleEndianFromTheBottomUp) {
  Film two(1, 2, 1);
  two.add(0, 0, 1, 0, 0);     // top
  two.add(1, 0, 0, 0, 0.5f);  // bottom
  two.finish_pass(1);
  write_image(folder / "a.pfm", two, {}, {});
  const char expected[] =
      "PF\n1 2\n-1.0\n"
      "\0\0\0\0\0\0\0\0\0\0\0\x3f"
      "\0\0\x80\x3f\0\0\0\0\0\0\0\0";
  EXPECT_EQ(read(folder / "a.pfm"), std::string(expected, sizeof expected - 1));
}

TEST_F(ImageFile, ReadsGreyAndBigEndianPfm) {
  const std::string one_and_two("\x3f\x80\0\0\x40\0\0\0", 8);
  EXPECT_EQ(read_image(write("a.pfm", "Pf\n2 1\n1.0\n" + one_and_two)).rgb, (std::vector<float>{1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(read_image(write("a.pfm", "Pf 1 2 0.5\n" + one_and_two)).rgb,
            (std::vector<float>{1, 1, 1, 0.5f, 0.5f, 0.5f}))
      << "bottom row first, scaled";
}

TEST_F(ImageFile, RefusesDamagedPfm) {
  expect_has(read_error(write("a.pfm", "PF\n2 2\n-1\n" + std::string(47, 'x'))), "cut short");
  expect_has(read_error(write("a.pfm", "PF\n2147483647 2147483647\n-1\n")), "cut short");
  expect_has(read_error(write("a.pfm", "PF\n99999999999 1\n-1\n")), "width");
  expect_has(read_error(write("a.pfm", "PF\n2 -2\n-1\n")), "size");
  expect_has(read_error(write("a.pfm", "PF\n2 two\n-1\n")), "height");
  expect_has(read_error(write("a.pfm", "PF\n2 2\n0\n")), "scale");
  expect_has(read_error(write("a.pfm", "PF\n2 2\nnan\n")), "scale");
  expect_has(read_error(write("a.pfm", "PF\n2 2\n-1")), "cut short");
  expect_has(read_error(write("a.pfm", "PF\n")), "width");
}

TEST_F(ImageFile, RefusesWhatIsNoRadianceImage) {
  write_image(folder / "a.png", film, {}, {});
  expect_has(read_error(folder / "a.png"), "allowed are EXR and PFM");
  expect_has(read_error(write("a.exr", "")), "empty");
  expect_has(read_error(write("a.exr", "hello")), "neither an EXR nor a PFM");
  expect_has(read_error(write("a.exr", "PFM")), "neither an EXR nor a PFM");
  expect_has(read_error(folder / "missing.exr"), "No such file");
  expect_has(read_error(folder), "folder");
}

// Every prefix, and every byte turned over, of a sound file: an error or an image, and nothing else.
TEST_F(ImageFile, SurvivesDamagedExr) {
  write_image(folder / "a.exr", film, {}, some_metadata);
  const std::string sound = read(folder / "a.exr");
  for (std::size_t size = 0; size < sound.size(); ++size) {
    const fs::path file = write("b.exr", sound.substr(0, size));
    EXPECT_THROW(read_image(file), ImageFileError) << size << " of " << sound.size() << " bytes";
  }
  for (std::size_t i = 4; i < sound.size(); ++i) {
    std::string damaged = sound;
    damaged[i] = static_cast<char>(~damaged[i]);
    const fs::path file = write("b.exr", damaged);
    for (const bool metadata : {false, true}) try {
        metadata ? static_cast<void>(read_metadata(file)) : static_cast<void>(read_image(file));
      } catch (const ImageFileError&) {
      }
  }
}

TEST_F(ImageFile, SurvivesDamagedPng) {
  write_image(folder / "a.png", film, {}, some_metadata);
  const std::string sound = read(folder / "a.png");
  for (std::size_t size = 8; size < sound.size(); ++size)
    EXPECT_THROW(read_metadata(write("b.png", sound.substr(0, size))), ImageFileError) << size;
  for (std::size_t i = 8; i < sound.size(); ++i) {
    std::string damaged = sound;
    damaged[i] = static_cast<char>(~damaged[i]);
    EXPECT_THROW(read_metadata(write("b.png", damaged)), ImageFileError) << i;
  }
}

TEST_F(ImageFile, ExrNeedsAllThreeChannels) {
  Imf::Header header(4, 4);
  header.channels().insert("R", Imf::Channel(Imf::HALF));
  header.channels().insert("G", Imf::Channel(Imf::HALF));
  Imf::OutputFile((folder / "a.exr").c_str(), header);
  expect_has(read_error(folder / "a.exr"), "no channel B");
}

TEST_F(ImageFile, ReadsHalfFloatsAndShiftedWindows) {
  Imf::Header header(Imath::Box2i({0, 0}, {9, 9}), Imath::Box2i({-2, 3}, {-1, 3}));
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::HALF));
  std::vector<half> pixels{half(1), half(2), half(3), half(4), half(5), half(6)};
  Imf::FrameBuffer buffer;
  for (int c = 0; c < 3; ++c)
    buffer.insert(std::string(1, "RGB"[c]),
                  Imf::Slice(Imf::HALF, reinterpret_cast<char*>(pixels.data() + c + 6), 3 * sizeof(half), 0));
  {
    Imf::OutputFile output((folder / "a.exr").c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(1);
  }
  const Image image = read_image(folder / "a.exr");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  EXPECT_EQ(image.rgb, (std::vector<float>{1, 2, 3, 4, 5, 6}));
}

// A header that asks for 2^20 x 2^20 pixels (16 TB) over a few bytes of data.
TEST_F(ImageFile, RefusesHugeExrWindows) {
  write_image(folder / "a.exr", film, {}, {});
  std::string bytes = read(folder / "a.exr");
  const std::size_t window = bytes.find("box2i") + 6 + 4;
  for (const std::int32_t side : {(1 << 20) - 1, 1 << 24, std::numeric_limits<std::int32_t>::max() - 1}) {
    std::memcpy(bytes.data() + window + 8, &side, 4);
    std::memcpy(bytes.data() + window + 12, &side, 4);
    EXPECT_NE(read_error(write("b.exr", bytes)), "nothing thrown") << side;
  }
}

TEST_F(ImageFile, WritableFilesPassWithoutATrace) {
  for (const char* name : {"a.png", "a.exr", "a.pfm", "a.PNG", "a.Exr"})
    EXPECT_EQ(write_error(folder / name), "nothing thrown");
  EXPECT_EQ(files_in_folder(), 0u);
  write("a.png", "old");
  EXPECT_EQ(write_error(folder / "a.png"), "nothing thrown");
  EXPECT_EQ(read(folder / "a.png"), "old");
}

TEST_F(ImageFile, RefusesWhatCannotBeWrittenAndSaysWhy) {
  for (const char* name : {"a.jpg", "a", "png"}) expect_has(write_error(folder / name), "allowed are .png");
  expect_has(write_error(folder / "none" / "a.png"), "does not exist");
  fs::create_directory(folder / "b.png");
  expect_has(write_error(folder / "b.png"), "is a folder");
  write("c", "");
  expect_has(write_error(folder / "c" / "a.png"), "is not a folder");
  expect_has(write_error(folder / (std::string(300, 'x') + ".png")), "too long");
  ASSERT_EQ(mkfifo((folder / "d.png").c_str(), 0600), 0);
  expect_has(write_error(folder / "d.png"), "not a regular file");
}

TEST_F(ImageFile, RefusesProtectedFoldersAndFiles) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  write("a.png", "old");
  fs::permissions(folder / "a.png", fs::perms::owner_read);
  expect_has(write_error(folder / "a.png"), "write-protected");
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  expect_has(write_error(folder / "b.png"), "Permission denied");
}

TEST_F(ImageFile, AFailedWriteLeavesTheOldFileAndNoOther) {
  const fs::path old = write("a.png", "old");
  EXPECT_THROW(write_png(old, {1 << 20, 1 << 20, {}}, {}, {}), ImageFileError) << "too large for a PNG";
  EXPECT_EQ(read(old), "old");
  EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(ImageFile, ReplacesFilesAndFollowsLinks) {
  const fs::path old = write("a.pfm", "old");
  fs::create_symlink(old, folder / "link.pfm");
  write_image(folder / "link.pfm", film, {}, {});
  EXPECT_TRUE(fs::is_symlink(folder / "link.pfm"));
  EXPECT_EQ(read_image(old).rgb, film.mean().rgb);
  EXPECT_EQ(files_in_folder(), 2u);
}

TEST_F(ImageFile, RelativePathsAreInTheCurrentFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  EXPECT_EQ(write_error("a.png"), "nothing thrown");
  write_image("a.png", film, {}, {});
  fs::current_path(before);
  EXPECT_TRUE(fs::exists(folder / "a.png"));
}

}  // namespace
