#include <gtest/gtest.h>

#include <algorithm>

#include "scene/file/scene_file.h"

namespace glimt {
namespace {

constexpr std::string_view sound = R"(name = "test"

[camera]
eye = [0, 0, 5]
look_at = [0, 0, 0]
up = [0, 1, 0]
fov_y = 45

[image]
width = 40
height = 30

[render]
spp = 16
method = "path"

[material.white]
type = "lambertian"
reflectance = [0.5, 0.5, 0.5]

[material.clay]
type = "oren-nayar"
reflectance = [0.5, 0.5, 0.5]
roughness = 0.6

[material.silver]
type = "mirror"
reflectance = [1, 1, 1]

[material.glass]
type = "glass"
ior = 1.5

[material.lamp]
type = "light"
radiance = [10, 10, 10]

[[sphere]]
name = "ball"
center = [0, 0, 0]
radius = 1
material = "glass"

[[sphere]]
name = "bubble"
center = [0.1, 0, 0]
radius = 0.5
material = "glass"

[[polygon]]
name = "floor"
material = "white"
vertices = [[-3, -2, 3], [3, -2, 3], [3, -2, -3], [-3, -2, -3]]

[[mesh]]
name = "block"
material = "glass"
vertices = [[2, 0, 0], [3, 0, 0], [2, 1, 0], [2, 0, 1]]
triangles = [[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]]
)";

std::string message_of(std::string_view text, std::vector<std::string> overrides = {}) {
  try {
    parse_scene(text, "test.toml", overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

struct Mistake {
  std::string name;
  std::string from;                    ///< text of the sound scene, found once
  std::string to;                      ///< what stands there instead; @ marks the place that the message must name
  std::vector<std::string> fragments;  ///< of the message
};

std::ostream& operator<<(std::ostream& out, const Mistake& mistake) { return out << mistake.name; }

class BadInput : public testing::TestWithParam<Mistake> {};

TEST_P(BadInput, NamesPlaceMistakeAndWhatIsAllowed) {
  const Mistake& mistake = GetParam();
  std::string text(sound);
  const std::size_t at = text.find(mistake.from);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(text.find(mistake.from, at + 1), std::string::npos) << "the text to replace is there twice";
  text.replace(at, mistake.from.size(), mistake.to);
  const std::size_t mark = text.find('@');
  ASSERT_NE(mark, std::string::npos);
  text.erase(mark, 1);
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(mark), '\n');
  const std::size_t line_start = mark == 0 ? 0 : text.rfind('\n', mark - 1) + 1;

  const std::string message = message_of(text);
  const std::string place = "test.toml:" + std::to_string(line) + ":" + std::to_string(mark - line_start + 1) + ": ";
  EXPECT_EQ(message.substr(0, place.size()), place) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const std::string& fragment : mistake.fragments)
    EXPECT_NE(message.find(fragment, place.size()), std::string::npos) << "no '" << fragment << "' in: " << message;
}

const std::vector<Mistake> mistakes{
    // Syntax.
    {"Syntax", "up = [0, 1, 0]\nfov_y", "up = [0, 1, 0\n@fov_y", {"array", "TOML"}},
    {"BareWord", "spp = 16", "spp = @many", {"value"}},
    {"KeyTwice", "width = 40", "width = 40\nwidth = @41", {"redefine", "width"}},
    {"NotUtf8", "name = \"test\"", "name = @\"\xff\"", {"utf-8"}},
    // Missing and unknown keys.
    {"MissingKey",
     "[[sphere]]\nname = \"ball\"\ncenter = [0, 0, 0]\nradius = 1\n",
     "@[[sphere]]\nname = \"ball\"\ncenter = [0, 0, 0]\n",
     {"[[sphere]]", "\"radius\""}},
    {"MissingCameraKey", "[camera]\neye = [0, 0, 5]\n", "@[camera]\n", {"[camera]", "\"eye\""}},
    {"MissingTable",
     "name = \"test\"\n\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y = 45\n",
     "@",
     {"\"camera\""}},
    {"MissingType",
     "[material.silver]\ntype = \"mirror\"\n",
     "@[material.silver]\n",
     {"[material.silver]", "\"type\""}},
    {"MissingParameter",
     "[material.glass]\ntype = \"glass\"\nior = 1.5\n",
     "@[material.glass]\ntype = \"glass\"\n",
     {"[material.glass]", "\"ior\"", "glass"}},
    {"MissingMaterial",
     "[[polygon]]\nname = \"floor\"\nmaterial = \"white\"",
     "@[[polygon]]\nname = \"floor\"",
     {"[[polygon]]", "\"material\""}},
    {"MissingTriangles",
     "[[mesh]]\nname = \"block\"\nmaterial = \"glass\"\nvertices = [[2, 0, 0], [3, 0, 0], [2, 1, 0], [2, 0, "
     "1]]\ntriangles",
     "@[[mesh]]\nname = \"block\"\nmaterial = \"glass\"\nvertices = [[2, 0, 0], [3, 0, 0], [2, 1, 0], [2, 0, 1]]\n#",
     {"[[mesh]]", "\"triangles\""}},
    {"UnknownKey", "radius = 0.5", "@raduis = 0.5", {"unknown key \"raduis\"", "nearest", "\"radius\"", "center"}},
    {"UnknownTable", "[image]", "[@imagee]", {"unknown key \"imagee\"", "\"image\"", "polygon"}},
    {"UnknownSetting", "spp = 16", "@sppp = 16", {"\"sppp\"", "\"spp\"", "shadow_rays"}},
    {"UnknownParameter", "roughness = 0.6", "roughness = 0.6\n@rougness = 0.6", {"\"rougness\"", "\"roughness\""}},
    {"UnknownKeysFirstInTheText", "[[polygon]]\nname", "[[polygon]]\n@z = 1\na = 2\nname", {"\"z\""}},
    {"OtherTypesKey",
     "[material.silver]\n",
     "[material.silver]\n@roughness = 0.1\n",
     {"\"roughness\"", "read by oren-nayar", "not by mirror", "type, reflectance"}},
    // Types.
    {"StringForNumber", "fov_y = 45", "fov_y = @\"45\"", {"fov_y", "expected a number", "found a string"}},
    {"NumberForString", "name = \"bubble\"", "name = @7", {"name", "expected a string", "found an integer"}},
    {"NumberForInteger", "width = 40", "width = @40.5", {"width", "expected an integer", "found a number"}},
    {"NumberForVector", "eye = [0, 0, 5]", "eye = @5", {"eye", "3 numbers", "found an integer"}},
    {"TwoComponents", "eye = [0, 0, 5]", "eye = @[0, 5]", {"eye", "3 numbers", "2 elements"}},
    {"StringInVector", "eye = [0, 0, 5]", "eye = [0, @\"0\", 5]", {"eye[1]", "expected a number", "found a string"}},
    {"NumberForTable",
     "[image]\nwidth = 40\nheight = 30\n",
     "[image]\nwidth = 40\nheight = 30\n[material]\nwood = @3\n",
     {"material.wood", "expected a table", "found an integer"}},
    {"TableForArray", "[[polygon]]", "@[polygon]", {"polygon", "[[polygon]]", "found a table"}},
    {"BooleanForChoice", "method = \"path\"", "method = @true", {"method", "expected a string", "found a boolean"}},
    {"DateForNumber", "fov_y = 45", "fov_y = @2020-01-01", {"expected a number", "found a date"}},
    {"NumbersForVertices",
     "[[-3, -2, 3], [3, -2, 3], [3, -2, -3], [-3, -2, -3]]",
     "[@-3, -2, 3]",
     {"vertices[0]", "3 numbers", "found an integer"}},
    {"NumberForIndex", "[[0, 2, 1]", "[[0, @2.0, 1]", {"triangles[0][1]", "expected an integer", "found a number"}},
    {"FourIndices", "[[0, 2, 1]", "[@[0, 2, 1, 3]", {"triangles[0]", "3 vertex indices", "4 elements"}},
    // Names.
    {"UnknownType", "type = \"mirror\"", "type = @\"miror\"", {"\"miror\"", "\"mirror\"", "oren-nayar"}},
    {"UnknownMethod",
     "method = \"path\"",
     "method = @\"bidirectional\"",
     {"method", "\"bidirectional\"", "path, naive"}},
    {"UnknownMaterial",
     "material = \"white\"",
     "material = @\"whit\"",
     {"polygon \"floor\"", "\"whit\"", "\"white\"", "silver"}},
    {"NameTwice", "name = \"bubble\"", "name = @\"ball\"", {"sphere \"ball\"", "taken"}},
    // Numbers.
    {"Nan", "fov_y = 45", "fov_y = @nan", {"fov_y is nan", "0.001 to 179"}},
    {"Infinite", "radius = 0.5", "radius = @inf", {"sphere \"bubble\"", "radius is inf"}},
    {"NanInVector", "look_at = [0, 0, 0]", "look_at = @[0, nan, 0]", {"look_at[1] is nan"}},
    {"NanInVertex", "[3, -2, 3]", "@[3, -2, nan]", {"polygon \"floor\"", "vertex 1", "nan"}},
    {"NegativeRadius", "radius = 0.5", "radius = @-0.5", {"sphere \"bubble\"", "radius is -0.5", "more than 0"}},
    {"ZeroRadius", "radius = 0.5", "radius = @0", {"radius is 0", "more than 0"}},
    {"ReflectanceAboveOne", "[1, 1, 1]", "@[1, 1.01, 1]", {"material \"silver\"", "reflectance[1] is 1.01", "0 to 1"}},
    {"NegativeReflectance", "[1, 1, 1]", "@[-0.1, 1, 1]", {"reflectance[0] is -0.1", "0 to 1"}},
    {"ZeroIor", "ior = 1.5", "ior = @0", {"material \"glass\"", "ior is 0", "more than 0"}},
    {"NegativeIor", "ior = 1.5", "ior = @-1.5", {"ior is -1.5", "at most 10"}},
    {"Rough", "roughness = 0.6", "roughness = @1.6", {"material \"clay\"", "roughness is 1.6", "0 to 1.57079"}},
    {"NegativeRadiance", "[10, 10, 10]", "@[10, 10, -1]", {"material \"lamp\"", "radiance[2] is -1"}},
    {"FovZero", "fov_y = 45", "fov_y = @0", {"fov_y is 0"}},
    {"FovStraight", "fov_y = 45", "fov_y = @180", {"fov_y is 180", "179"}},
    {"NoSamples", "spp = 16", "spp = @0", {"spp is 0", "1 to 16777216"}},
    {"BeyondInt", "spp = 16", "spp = @5000000000", {"spp is 5000000000", "1 to 16777216"}},
    // Image and camera.
    {"ZeroWidth", "width = 40", "width = @0", {"width is 0", "1 to 16384"}},
    {"NegativeHeight", "height = 30", "height = @-30", {"height is -30", "1 to 16384"}},
    {"AbsurdWidth", "width = 40", "width = @20000", {"width is 20000", "1 to 16384"}},
    {"AbsurdImage", "width = 40\nheight = 30", "width = @16384\nheight = 16384", {"16384 x 16384", "67108864"}},
    {"CameraAtItsTarget", "look_at = [0, 0, 0]", "look_at = @[0, 0, 5]", {"look_at", "eye"}},
    {"UpAlongTheView", "up = [0, 1, 0]", "up = @[0, 0, 2]", {"up", "direction of view"}},
    {"UpZero", "up = [0, 1, 0]", "up = @[0, 0, 0]", {"up is zero"}},
    // Shapes.
    {"TwoVertices",
     "[[-3, -2, 3], [3, -2, 3], [3, -2, -3], [-3, -2, -3]]",
     "@[[-3, -2, 3], [3, -2, 3]]",
     {"polygon \"floor\"", "2 vertices", "3 or more"}},
    {"NoArea",
     "[[-3, -2, 3], [3, -2, 3], [3, -2, -3], [-3, -2, -3]]",
     "@[[-3, -2, 3], [3, -2, 3], [1, -2, 3]]",
     {"no area"}},
    {"AllVerticesCoincide",
     "[[-3, -2, 3], [3, -2, 3], [3, -2, -3], [-3, -2, -3]]",
     "@[[-3, -2, 3], [3, -2, 3], [3, -2, 3], [-3, -2, 3]]",
     {"no area", "3 or more"}},
    {"NonPlanar",
     "[[-3, -2, 3], [3, -2, 3], [3, -2, -3], [-3, -2, -3]]",
     "[[-3, -2, 3], [0, -2, 4], [3, -2, 3], @[3, -1, -3], [-3, -2, -3]]",
     {"vertex 3", "off the plane", "planar"}},
    {"CrossingEdges",
     "[[-3, -2, 3], [3, -2, 3], [3, -2, -3], [-3, -2, -3]]",
     "@[[-3, -2, 3], [3, -2, 3], [-3, -2, -3], [3, -2, -3]]",
     {"edges cross"}},
    {"StarOfFivePoints",
     "[[-3, -2, 3], [3, -2, 3], [3, -2, -3], [-3, -2, -3]]",
     "@[[0, -2, 3], [-1.8, -2, -2.4], [2.9, -2, 0.9], [-2.9, -2, 0.9], [1.8, -2, -2.4]]",
     {"edges cross"}},
    {"IndexOutOfRange", "[1, 2, 3]]", "@[1, 2, 4]]", {"mesh \"block\"", "triangle 3", "vertex 4", "0 to 3"}},
    {"NegativeIndex", "[1, 2, 3]]", "@[-1, 2, 3]]", {"vertex -1", "0 to 3"}},
    {"FlatTriangles", "[[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]]", "@[[0, 2, 2], [1, 1, 3]]", {"none of", "area"}},
    {"NoTriangles", "[[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]]", "@[]", {"no triangles"}},
    {"GlassPolygon",
     "name = \"floor\"\nmaterial = \"white\"",
     "name = \"floor\"\nmaterial = @\"glass\"",
     {"polygon \"floor\"", "open", "closed meshes"}},
    {"GlassOpenMesh",
     "material = \"glass\"\nvertices = [[2, 0, 0], [3, 0, 0], [2, 1, 0], [2, 0, 1]]\ntriangles = [[0, 2, 1], ",
     "material = @\"glass\"\nvertices = [[2, 0, 0], [3, 0, 0], [2, 1, 0], [2, 0, 1]]\ntriangles = [",
     {"mesh \"block\"", "open"}},
    {"OverlappingGlass",
     "[[sphere]]\nname = \"bubble\"\ncenter = [0.1, 0, 0]",
     "@[[sphere]]\nname = \"bubble\"\ncenter = [0.8, 0, 0]",
     {"sphere \"ball\"", "sphere \"bubble\"", "overlap", "apart"}},
};

INSTANTIATE_TEST_SUITE_P(, BadInput, testing::ValuesIn(mistakes),
                         [](const auto& mistake) { return mistake.param.name; });

TEST(BadInputScene, TheSceneWithoutMistakesIsRead) { EXPECT_EQ(message_of(sound), "accepted"); }

TEST(BadInputScene, PlaceIsCountedFromOne) {
  EXPECT_EQ(message_of("name = 5\n[camera]").substr(0, 15), "test.toml:1:8: ");
}

TEST(BadInputScene, EmptyTextAndEmptyScene) {
  EXPECT_EQ(message_of("").substr(0, 15), "test.toml:1:1: ");
  const std::string bare =
      message_of("[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_y = 45\n[image]\nwidth = 4\nheight = 3\n");
  EXPECT_EQ(bare.substr(0, 15), "test.toml:1:1: ");
  EXPECT_NE(bare.find("holds nothing"), std::string::npos);
}

TEST(BadInputScene, NamesWithLineBreaksStayOnOneLine) {
  const std::string message = message_of("\"a\\nb\" = 5\n");
  EXPECT_NE(message.find("\\n"), std::string::npos);
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(BadInputScene, NestingWithoutEndIsRefused) {
  EXPECT_NE(message_of("a = " + std::string(100000, '[')).find("nested"), std::string::npos);
}

TEST(BadInputScene, NoMissingOrDoubledCharacterIsMoreThanAMistake) {
  for (std::size_t i = 0; i < sound.size(); ++i)
    for (const std::string& middle : {std::string(), std::string(2, sound[i])}) {
      const std::string text = std::string(sound.substr(0, i)) + middle + std::string(sound.substr(i + 1));
      const std::string message = message_of(text);
      EXPECT_TRUE(message == "accepted" || message.starts_with("test.toml:")) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

TEST(BadInputScene, FilesThatCannotBeReadAreNamed) {
  const auto message = [](const std::filesystem::path& file) -> std::string {
    try {
      read_scene(file);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("no/such.toml"), "no/such.toml: cannot be read: No such file or directory");
  const std::string folder = testing::TempDir();
  EXPECT_EQ(message(folder), folder + ": cannot be read: Is a directory");
}

struct BadOverride {
  std::vector<std::string> overrides;
  std::string message_begins;
  std::vector<std::string> fragments;
};

TEST(BadInputOverride, IsNamedInsteadOfAPlace) {
  const std::vector<BadOverride> cases{
      {{"fov_y"}, "--set fov_y: ", {"PATH=VALUE"}},
      {{"camera.fov_y="}, "--set camera.fov_y=: ", {"PATH=VALUE"}},
      {{"camera.fov_y=4.5.6"}, "--set camera.fov_y=4.5.6: ", {"PATH=VALUE"}},
      {{"camera.eye=[1,2"}, "--set camera.eye=[1,2: ", {"array"}},
      {{"camera.fov_x=45"}, "--set camera.fov_x=45: ", {"\"fov_x\"", "\"fov_y\""}},
      {{"camera.fov_y=wide"}, "--set camera.fov_y=wide: ", {"expected a number", "found a string"}},
      {{"camera.fov_y=200"}, "--set camera.fov_y=200: ", {"fov_y is 200", "179"}},
      {{"camera.fov_y=200", "camera.up=[0,1,0.1]"}, "--set camera.fov_y=200: ", {"179"}},
      {{"camera=3"}, "--set camera=3: ", {"expected a table"}},
      {{"camera.fov_y.x=3"}, "--set camera.fov_y.x=3: ", {"expected a number", "found a table"}},
      {{"camera.eye.5=3"}, "--set camera.eye.5=3: ", {"\"5\"", "0 to 2"}},
      {{"render.spp=0"}, "--set render.spp=0: ", {"spp is 0"}},
      {{"sphere.bal.radius=2"}, "--set sphere.bal.radius=2: ", {"\"bal\"", "\"ball\"", "0 to 1"}},
      {{"sphere.2.radius=2"}, "--set sphere.2.radius=2: ", {"\"2\"", "0 to 1"}},
      {{"sphere.ball.material=glas"}, "--set sphere.ball.material=glas: ", {"\"glas\"", "\"glass\""}},
      {{"material.white.type=glass"}, "--set material.white.type=glass: ", {"\"ior\""}},
      {{"material.new.type=mirror"}, "--set material.new.type=mirror: ", {"\"reflectance\""}},
      {{"material.silver.roughness=1"}, "--set material.silver.roughness=1: ", {"oren-nayar"}},
      {{"polygon.floor.vertices.2=[0,5,0]"}, "--set polygon.floor.vertices.2=[0,5,0]: ", {"off the plane"}},
      // What breaks a rule together with the file.
      {{"camera.eye=[0,0,0]"}, "--set camera.eye=[0,0,0]: ", {"look_at"}},
      {{"render.spp=3", "sphere.ball.center.0=1", "image.width=7"}, "--set sphere.ball.center.0=1: ", {"overlap"}},
  };
  for (const BadOverride& bad : cases) {
    const std::string message = message_of(sound, bad.overrides);
    EXPECT_EQ(message.substr(0, bad.message_begins.size()), bad.message_begins) << message;
    for (const std::string& fragment : bad.fragments)
      EXPECT_NE(message.find(fragment, bad.message_begins.size()), std::string::npos)
          << "no '" << fragment << "' in: " << message;
  }
}

TEST(BadInputOverride, AMistakeOfTheFileIsNotBlamedOnIt) {
  std::string text(sound);
  text.replace(text.find("fov_y = 45"), 10, "fov_y = 200");
  EXPECT_EQ(message_of(text, {"render.spp=3", "image.width=7"}).substr(0, 15), "test.toml:7:9: ");
}

}  // namespace
}  // namespace glimt
