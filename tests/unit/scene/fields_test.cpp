#include "scene/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "material/list.h"
#include "scene/file/text.h"
#include "scene/validate/validate.h"

namespace glimt {
namespace {

/// Keys differ, everything is documented on one line, ranges hold something, choices are told apart.
template <class T>
void check_table(std::span<const Field<T>> fields) {
  std::set<std::string_view> keys;
  for (const Field<T>& field : fields) {
    SCOPED_TRACE(field.key);
    EXPECT_TRUE(keys.insert(field.key).second);
    EXPECT_FALSE(field.doc.empty());
    EXPECT_EQ(field.doc.find('\n'), std::string_view::npos);
    if (const auto* choice = std::get_if<Choice<T>>(&field.member)) {
      const std::set<std::string_view> names(choice->names.begin(), choice->names.end());
      EXPECT_EQ(names.size(), choice->names.size());
      for (int i = 0; i < static_cast<int>(choice->names.size()); ++i) {
        T object;
        choice->set(object, i);
        EXPECT_EQ(choice->get(object), i);
      }
      continue;
    }
    EXPECT_LT(field.min, field.max);
  }
}

TEST(Fields, TablesAreSound) {
  check_table(settings_fields());
  check_table(camera_fields());
  check_table(image_fields());
  check_table(sphere_fields());
  for (const MaterialInfo& info : material_infos()) check_table(std::span<const Field<Material>>(info.fields));
}

TEST(Fields, DefaultsAreInRange) {
  Scene scene;
  for (const MaterialInfo& info : material_infos())
    scene.materials.push_back({.name = std::string(info.name), .type = std::string(info.name)});
  scene.spheres = {{.name = "ball", .material = "mirror"}};
  for (const Problem& problem : validate(scene)) ADD_FAILURE() << problem.message;
}

TEST(Fields, EveryMaterialTypeIsListedOnce) {
  std::set<std::string_view> names;
  for (const MaterialInfo& info : material_infos()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(&material_info(info.name), &info);
  }
  EXPECT_EQ(find_material_info("wood"), nullptr);
  EXPECT_THROW(material_info("wood"), std::invalid_argument);
}

TEST(Fields, SwitchingTheTypeKeepsWhatBothHaveAndLosesNothing) {
  Material m = Material{.name = "ball", .type = "oren-nayar"}
                   .with(OrenNayar::reflectance, {0.1, 0.2, 0.3})
                   .with(OrenNayar::roughness, 1)
                   .with(Eon::roughness, 0.25);
  const Material before = m;
  m.type = "mirror";
  EXPECT_EQ(m.get(Mirror::reflectance), glm::dvec3(0.1, 0.2, 0.3));
  m.type = "eon";
  EXPECT_EQ(m.get(Eon::roughness), 0.25) << "another quantity than Oren-Nayar's";
  m.type = "oren-nayar";
  EXPECT_EQ(m, before);
}

TEST(Fields, AValueEqualToTheDefaultIsNoDifference) {
  const Material plain{.name = "glass", .type = "glass"};
  EXPECT_EQ(plain.with(Glass::ior, Glass::ior.fallback), plain);
  EXPECT_EQ(plain.with(Glass::ior, 2).with(Glass::ior, 1.5), plain);
  EXPECT_NE(plain.with(Glass::ior, 2), plain);
}

TEST(Fields, ChoicesSetTheValueTheyName) {
  const auto named = [](const auto& fields, std::string_view key, std::string_view name, auto& object) {
    for (const auto& field : fields)
      if (field.key == key) {
        const auto& choice = std::get<3>(field.member);
        choice.set(object, static_cast<int>(std::ranges::find(choice.names, name) - choice.names.begin()));
        return;
      }
    FAIL() << "no " << key;
  };
  Settings settings;
  named(settings_fields(), "method", "naive", settings);
  EXPECT_EQ(settings.method, Method::naive);
  named(settings_fields(), "method", "path", settings);
  EXPECT_EQ(settings.method, Method::path);
  named(settings_fields(), "light_sampling", "solid-angle", settings);
  EXPECT_EQ(settings.light_sampling, LightSampling::solid_angle);
  named(settings_fields(), "light_sampling", "auto", settings);
  EXPECT_EQ(settings.light_sampling, LightSampling::automatic);
  named(settings_fields(), "mis", "on", settings);
  EXPECT_EQ(settings.mis, Mis::on);
  named(settings_fields(), "sampler", "lattice", settings);
  EXPECT_EQ(settings.sampler, Sampler::lattice);
  named(settings_fields(), "sampler", "centres", settings);
  EXPECT_EQ(settings.sampler, Sampler::centres);
  named(settings_fields(), "caustics", "off", settings);
  EXPECT_EQ(settings.caustics, Caustics::off);
  named(settings_fields(), "caustics", "only", settings);
  EXPECT_EQ(settings.caustics, Caustics::only);
  named(settings_fields(), "sphere_connections", "off", settings);
  EXPECT_EQ(settings.sphere_connections, SphereConnections::off);
  named(settings_fields(), "roulette", "constant", settings);
  EXPECT_EQ(settings.roulette, Roulette::constant);
  named(settings_fields(), "roulette", "throughput", settings);
  EXPECT_EQ(settings.roulette, Roulette::throughput);
  Material material;
  named(material_info("oren-nayar").fields, "formula", "report", material);
  EXPECT_EQ(material.get(OrenNayar::formula), OrenNayarFormula::report);
  named(material_info("oren-nayar").fields, "formula", "published", material);
  EXPECT_EQ(material.get(OrenNayar::formula), OrenNayarFormula::published);
  named(material_info("glass").fields, "fresnel", "schlick", material);
  EXPECT_EQ(material.get(Glass::fresnel), Fresnel::schlick);
  named(material_info("glass").fields, "fresnel", "exact", material);
  EXPECT_EQ(material.get(Glass::fresnel), Fresnel::exact);
}

// A method sets what it is made of, and nothing that is not an estimator.
TEST(Fields, MethodsSetTheirParts) {
  Settings settings{
      .spp = 7, .target_error = 0.5, .shadow_rays = 3, .seed = 9, .mis = Mis::on, .light_paths = 2, .max_depth = 4};
  set_method(settings, Method::report);
  EXPECT_EQ(settings, (Settings{.spp = 7,
                                .target_error = 0.5,
                                .shadow_rays = 3,
                                .seed = 9,
                                .method = Method::report,
                                .light_sampling = LightSampling::area,
                                .roulette = Roulette::constant,
                                .sampler = Sampler::centres,
                                .caustics = Caustics::off,
                                .light_paths = 0,
                                .sphere_connections = SphereConnections::off,
                                .path_sharing = PathSharing::off}));
  set_method(settings, Method::path);
  EXPECT_EQ(settings, (Settings{.spp = 7, .target_error = 0.5, .shadow_rays = 3, .seed = 9}));
}

TEST(Text, NumbersAreShortAndPlain) {
  EXPECT_EQ(number_text(20), "20");
  EXPECT_EQ(number_text(-3.6), "-3.6");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(1e6), "1000000");
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(-0.0), "-0.0");
  EXPECT_EQ(number_text(0x1p66), "73786976294838206464.0");  // as an integer it would not fit 64 bits
}

TEST(Text, StringsAndKeysAreEscaped) {
  EXPECT_EQ(toml_string("a \"b\" \\ \n\t\x01"), R"("a \"b\" \\ \n\t\u0001")");
  EXPECT_EQ(key_text("wall_1-a"), "wall_1-a");
  EXPECT_EQ(key_text("wall 1"), "\"wall 1\"");
  EXPECT_EQ(key_text(""), "\"\"");
}

TEST(Text, NearestIsTheLeastEdited) {
  const std::string_view known[] = {"radius", "center", "name", "material"};
  EXPECT_EQ(nearest("raduis", known), "radius");
  EXPECT_EQ(nearest("centre", known), "center");
  EXPECT_EQ(nearest("mat", known), "name");  // "name": 3 edits; "material": 5
  EXPECT_EQ(nearest("materials", known), "material");
  EXPECT_EQ(nearest("name", known), "name");
  EXPECT_EQ(nearest("x", {}), "");
}

}  // namespace
}  // namespace glimt
