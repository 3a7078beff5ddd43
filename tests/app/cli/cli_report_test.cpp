#include <algorithm>

#include "app/cli/cli_test.h"
#include "film/image_formats.h"

namespace {

class ReportCommand : public CommandLine {};

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + 1)) ++found;
  return found;
}

/// RFC 4648, section 4.
std::string decoded(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (const char c : base64) {
    if (c == '=') break;
    buffer = buffer << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(buffer >> (bits -= 8) & 255);
  }
  return bytes;
}

TEST_F(ReportCommand, WritesOnePageThatHoldsEverything) {
  const Result result = glimt({"report", "-o", "a/b", "--quick"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "a/b/index.html\n");
  EXPECT_EQ(result.err, "") << "no progress where nobody looks";
  const std::string page = read("a/b/index.html");
  for (int i = 1; i <= 5; ++i) EXPECT_TRUE(has(page, "<h2>Figure " + std::to_string(i))) << i;
  for (const char* time : {">43 s<", ">63 s<", ">91 s<", ">148 s<"}) EXPECT_TRUE(has(page, time)) << time;
  for (const char* part : {"Table 1.", "Table 2.", "Table 3.", "Load balance", "caustics left out", "Size of the lamp",
                           "Distance to the lamp", "Roughness", "Refractive index", "Reflectance", "White metal",
                           "Lost at roughness 1: 6"})
    EXPECT_TRUE(has(page, part)) << part;
  EXPECT_EQ(count(page, "<svg "), 12U) << "one chart of time, nine of stability, two of the light that is lost";
  EXPECT_EQ(count(page, "<img "), 34U) << "2 + 4 + 4 + 3 + 4 pictures in two ways";
  EXPECT_EQ(count(page, "<img "), count(page, "src='data:image/png;base64,"));
  EXPECT_EQ(count(page, "http"), count(page, "<svg xmlns='http://www.w3.org/2000/svg'")) << "nothing is fetched";
  for (const char* part : {"nan", "inf<", ">inf", "-inf"}) EXPECT_FALSE(has(page, part)) << part;
}

TEST_F(ReportCommand, PicturesInThePageAreWholePngFiles) {
  ASSERT_EQ(glimt({"report", "-o", ".", "--quick"}).status, 0);
  const std::string page = read("index.html"), mark = "base64,";
  std::size_t pictures = 0;
  for (std::size_t i = page.find(mark); i != std::string::npos; i = page.find(mark, i), ++pictures) {
    i += mark.size();
    const std::string png = decoded(page.substr(i, page.find('\'', i) - i));
    ASSERT_TRUE(png.starts_with(glimt::png_signature));
    EXPECT_NO_THROW(glimt::decode_png_metadata(png)) << "every checksum holds";
  }
  EXPECT_GT(pictures, 0U);
}

TEST_F(ReportCommand, RefusesAFolderThatCannotBeWrittenBeforeItRenders) {
  write("file", "");
  const Result result = glimt({"report", "-o", "file"});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(has(result.err, "file")) << result.err;
  EXPECT_EQ(glimt({"report"}).status, 2);
}

}  // namespace
