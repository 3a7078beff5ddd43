#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "accuracy/glossy_parts.h"
#include "kernel/scattering/albedo.h"
#include "kernel/scattering/surfaces.h"
#include "statistics_helpers.h"

using namespace glimt;

// Glossy lobes: samples against densities, energy and reciprocity. The probability of a false alarm is alpha for each
// test. Their pictures are in glossy_pictures_test.cpp.
namespace {

constexpr double alpha = 1e-4;
constexpr double pi = std::numbers::pi;

using V = Vec3<float>;
using Table = Surfaces<float, Features{}>;

dvec3 to_double(const V& v) { return {v.x, v.y, v.z}; }
V to_float(const dvec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// A material's surface with the normal z.
class Sample {
 public:
  Sample(const Material& material, bool front) : compiled_(compile(ball(material))), table_(compiled_) {
    at_.point = at_.normal = {0, 0, 1};
    at_.front = front;
    at_.surface = 0;
    table_.look_up_kind(at_);
  }
  ScatterSample<float> sample(const V& wo, float u, float v, float lobe) const {
    return table_.sample(seen_from(wo), wo, {u, v}, lobe);
  }
  /// BSDF |cos|, green.
  double evaluate(const V& wi, const V& wo) const {
    return static_cast<double>(table_.evaluate(seen_from(wo), wi, wo, wi.z, wo.z).y) * std::abs(to_double(wi).z) / pi;
  }
  double pdf_w(const V& wi, const V& wo) const {
    return static_cast<double>(table_.pdf_w(seen_from(wo), wi, wo, wi.z, wo.z));
  }

 private:
  static Scene ball(const Material& material) {
    Scene scene;
    scene.materials = {material};
    scene.spheres = {{"", material.name, {0, 0, 0}, 1}};
    return scene;
  }
  Interaction<float> seen_from(const V& wo) const {
    Interaction<float> at = at_;
    at.cos_o = wo.z;
    return at;
  }

  CompiledScene compiled_;
  Table table_;
  Interaction<float> at_{};
};

V towards(double angle, double turn = 0.3) {
  return to_float({std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)});
}

/// Polar cells around a direction. Those of a narrow lobe are evenly spaced in the logarithm of the angle to it; those
/// of a wide one in the angle itself, around the normal, with the horizon at their end.
class Cells {
 public:
  static constexpr int rings = 32, sectors = 8, count = rings * sectors;

  /// `thin`: seen from the normal, the lobe is narrow around it, as a highlight at grazing angle is.
  Cells(const dvec3& lobe, bool narrow, bool thin)
      : narrow_(narrow), thin_(thin), axis_(narrow ? lobe : dvec3{0, 0, lobe.z > 0 ? 1 : -1}) {
    x_ = normalize(cross(std::abs(axis_.z) < 0.9 ? dvec3{0, 0, 1} : dvec3{1, 0, 0}, axis_));
    y_ = cross(axis_, x_);
  }
  std::size_t of(const dvec3& w) const {
    const double angle = std::atan2(length(cross(axis_, w)), dot(axis_, w));
    const double turn = std::atan2(dot(w, y_), dot(w, x_)) / (2 * pi) + 0.5;
    const double place = narrow_ ? std::log(angle / smallest) / step : angle / (pi / 2) * rings;
    const int ring = std::clamp(static_cast<int>(place), 0, rings - 1);
    return static_cast<std::size_t>(ring * sectors + std::min(static_cast<int>(turn * sectors), sectors - 1));
  }
  /// Integral of f over each cell, by the midpoint rule.
  template <class Function>
  std::vector<double> integrals(Function f) const {
    const int fine = thin_ ? 8 : 24, fine_turns = thin_ ? 160 : 24;
    std::vector<double> sums(count);
    for (int ring = 0; ring < rings; ++ring)
      for (int i = 0; i < fine; ++i) {
        const double low = edge(ring, i, fine), high = edge(ring, i + 1, fine), angle = (low + high) / 2;
        // cos(low) - cos(high), without cancellation for small angles.
        const double ring_area = 2 * std::sin(angle) * std::sin((high - low) / 2) * 2 * pi;
        for (int k = 0; k < sectors * fine_turns; ++k) {
          const double turn = 2 * pi * ((k + 0.5) / (sectors * fine_turns) - 0.5);
          const dvec3 w = std::sin(angle) * (std::cos(turn) * x_ + std::sin(turn) * y_) + std::cos(angle) * axis_;
          sums[static_cast<std::size_t>(ring * sectors + k / fine_turns)] += f(w) * ring_area / (sectors * fine_turns);
        }
      }
    return sums;
  }

 private:
  static constexpr double smallest = 2e-5;
  static inline const double step = std::log(pi / smallest) / rings;
  double edge(int ring, int i, int fine) const {
    const double place = ring + static_cast<double>(i) / fine;
    return !narrow_ ? pi / 2 * place / rings : place == 0 ? 0 : smallest * std::exp(step * place);
  }

  bool narrow_, thin_;
  dvec3 axis_, x_, y_;
};

struct Model {
  std::string name;
  Material material;
  bool front;
  double roughness;

  bool narrow(double view) const { return roughness < 0.2 || (roughness < 0.3 && view < 1.3); }
};

std::vector<Model> models(const std::vector<double>& roughness) {
  std::vector<Model> all;
  for (const double r : roughness) {
    const std::string text = " of roughness " + std::to_string(r);
    all.push_back({"metal" + text, metal(r), true, r});
    all.push_back({"glass" + text + " from outside", frosted(r), true, r});
    all.push_back({"glass" + text + " from inside", frosted(r), false, r});
  }
  return all;
}

const std::vector<double> sweep{0.04, 0.1, 0.25, 0.5, 1};
const std::vector<double> views{0.02, 0.6, 1.2, 1.5};

/// The directions around which the model's two lobes lie: mirrored and refracted.
std::vector<dvec3> lobe_axes(const Model& model, const dvec3& wo) {
  std::vector<dvec3> axes{{-wo.x, -wo.y, wo.z}};
  if (model.material.type != "glass") return axes;
  const double eta = model.front ? 1.5 : 1 / 1.5, sin2 = (1 - wo.z * wo.z) / (eta * eta);
  axes.push_back(normalize(dvec3{-wo.x / eta, -wo.y / eta, -std::sqrt(std::max(1 - sin2, 1e-4))}));
  return axes;
}

// Samples follow pdf_w, and their weight is BSDF |cos| / pdf_w. What is lost below the surface has the rest of the
// probability.
TEST(Glossy, SamplesFollowTheirDensity) {
  constexpr int samples = 40000;
  const std::vector<Model> all = models(sweep);
  const double level = sidak(alpha, static_cast<double>(all.size() * views.size()));
  for (const Model& model : all)
    for (const double view : views) {
      const Sample surface(model.material, model.front);
      const V wo = towards(view);
      std::vector<Cells> cells;
      std::vector<double> probability, count;
      for (const dvec3& axis : lobe_axes(model, to_double(wo))) {
        cells.emplace_back(axis, model.narrow(view), model.roughness < 0.4 && !model.narrow(view));
        const bool above = axis.z > 0;
        const auto part = cells.back().integrals(
            [&](const dvec3& w) { return (w.z > 0) == above ? surface.pdf_w(to_float(w), wo) : 0.0; });
        probability.insert(probability.end(), part.begin(), part.end());
      }
      double found = 0;
      for (const double p : probability) found += p;
      EXPECT_LT(found, 1.003) << model.name << ", view " << view;
      probability.push_back(std::max(1 - found, 0.0));
      count.assign(probability.size(), 0);
      std::mt19937 random(7);
      std::uniform_real_distribution<float> number(0, 1);
      for (int i = 0; i < samples; ++i) {
        const float u = number(random), v = number(random), lobe = number(random);
        const ScatterSample<float> s = surface.sample(wo, u, v, lobe);
        if (!(s.weight.y > 0)) {
          ++count.back();
          continue;
        }
        const dvec3 wi = to_double(s.direction);
        const std::size_t part = wi.z > 0 ? 0 : 1;
        ASSERT_LT(part, cells.size()) << model.name << ", sample " << i;
        ASSERT_EQ(s.crosses, wi.z < 0) << model.name << ", sample " << i;
        ++count[part * Cells::count + cells[part].of(wi)];
        // Rounding of the direction moves the density by its slope, which is steepest for narrow lobes.
        const double pdf = surface.pdf_w(s.direction, wo), slack = 2e-2;
        ASSERT_NEAR(static_cast<double>(s.pdf_w) / pdf, 1, slack)
            << model.name << ", view " << view << ", sample " << i << ", cos " << wi.z;
        const double eta2 = s.crosses ? static_cast<double>(s.inverse_eta2) : 1;
        ASSERT_NEAR(static_cast<double>(s.weight.y) * eta2 * pdf / surface.evaluate(s.direction, wo), 1, slack)
            << model.name << ", view " << view << ", sample " << i << ", cos " << wi.z;
      }
      double chi2 = 0, freedom = -1, rest = 0, rest_expected = 0;
      for (std::size_t i = 0; i < count.size(); ++i) {
        const double expected = samples * probability[i];
        if (expected < 10) {
          rest += count[i], rest_expected += expected;
        } else {
          chi2 += (count[i] - expected) * (count[i] - expected) / expected, ++freedom;
        }
      }
      if (rest_expected > 1) chi2 += (rest - rest_expected) * (rest - rest_expected) / rest_expected, ++freedom;
      EXPECT_GT(chi_square_tail(chi2, freedom), level)
          << model.name << ", view " << view << ": chi^2 " << chi2 << " of " << freedom << ", seed 7";
    }
}

/// Mean weight of samples, over the strata of a grid, and the integral of BSDF |cos|.
struct Albedo {
  double sampled, integral;
};
/// `through_factor` is on what is refracted.
Albedo albedo(const Model& model, double view, double through_factor = 1) {
  constexpr int side = 100;
  const Sample surface(model.material, model.front);
  const V wo = towards(view);
  double sum = 0, integral = 0;
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k) {
      const float lobe = static_cast<float>((i * 37 + k * 61) % side) / side + 0.5f / side;
      const ScatterSample<float> s =
          surface.sample(wo, (static_cast<float>(i) + 0.5f) / side, (static_cast<float>(k) + 0.5f) / side, lobe);
      const bool through = s.crosses;
      sum += static_cast<double>(s.weight.y * (through ? s.inverse_eta2 : 1.0f)) / (side * side);
    }
  for (const dvec3& axis : lobe_axes(model, to_double(wo)))
    for (const double part :
         Cells(axis, model.narrow(view), model.roughness < 0.4 && !model.narrow(view)).integrals([&](const dvec3& w) {
           return (w.z > 0) == (axis.z > 0) ? surface.evaluate(to_float(w), wo) : 0.0;
         }))
      integral += part * (axis.z < 0 ? through_factor : 1);
  return {sum, integral};
}

// No surface sends back more than it gets: of flux, which has no factor n^2. Sampling and the integral of the BSDF give
// the same. A white metal loses what its facets send to one another; the table says how much.
TEST(Glossy, KeepsEnergyButForLightBetweenFacets) {
  std::cout << "light that a white metal loses, percent\n roughness";
  for (const double view : views) std::cout << "\t" << view << " rad";
  for (const double roughness : sweep) {
    std::cout << "\n " << roughness;
    for (const double view : views) {
      const Albedo a = albedo({"white metal", white_metal(roughness), true, roughness}, view);
      std::cout << "\t" << std::round(1000 * (1 - a.integral)) / 10;
      EXPECT_NEAR(a.sampled, a.integral, 0.01) << "roughness " << roughness << ", view " << view;
      EXPECT_LT(a.integral, 1.003) << "roughness " << roughness << ", view " << view;
    }
  }
  std::cout << "\n";
  for (const Model& model : models(sweep))
    for (const double view : views) {
      const Albedo a = albedo(model, view);
      EXPECT_NEAR(a.sampled, a.integral, 0.02 * std::max(1.0, a.integral)) << model.name << ", view " << view;
      EXPECT_LT(a.integral, model.front ? 1.003 : 1.5 * 1.5 * 1.003) << model.name << ", view " << view;
    }
}

// What `glimt report` draws is the integral of BSDF |cos|, up to the error of its midpoint rule. The BSDF is for
// radiance, which takes 1 / n^2 where it is refracted; flux does not.
TEST(Glossy, DirectionalAlbedoIsTheIntegral) {
  for (const double roughness : {0.25, 0.5, 1.0})
    for (const double view : {0.02, 0.25 * pi, 75 * pi / 180})
      for (const Model& model : {Model{"white metal", white_metal(roughness), true, roughness},
                                 Model{"glass", frosted(roughness), true, roughness}})
        EXPECT_NEAR(directional_albedo(model.material, view), albedo(model, view, 1.5 * 1.5).integral, 0.004)
            << model.name << " of roughness " << roughness << ", view " << view;
  for (const Material& smooth : {white_metal(0), frosted(0)})
    EXPECT_NEAR(directional_albedo(smooth, 0.3), 1, 1e-6) << "nothing is lost";
}

// Light may run both ways: f is symmetric for a metal, f / n^2 for glass, n the index on the side that light leaves to.
// Facets that are seen nearly edge-on send little light, of which rounding leaves fewer digits: hence 1e-6.
TEST(Glossy, IsReciprocal) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0, 1);
  for (const double roughness : sweep) {
    const Sample metallic(metal(roughness), true), outside(frosted(roughness), true), inside(frosted(roughness), false);
    int seen = 0;
    for (int i = 0; i < 2000; ++i) {
      const V a = towards(1.5 * number(random), 6 * number(random)),
              b = towards(1.5 * number(random), 6 * number(random));
      const auto f = [](const Sample& s, const V& wi, const V& wo) {
        return s.evaluate(wi, wo) / std::abs(to_double(wi).z);
      };
      EXPECT_NEAR(f(metallic, a, b), f(metallic, b, a), 1e-3 * f(metallic, a, b) + 1e-6) << roughness << ", " << i;
      EXPECT_NEAR(f(outside, a, b), f(outside, b, a), 1e-3 * f(outside, a, b) + 1e-6) << roughness << ", " << i;
      // To a, outside, from below; and from a to below, which is seen from inside with the normal turned.
      const V below{b.x, b.y, -b.z};
      const V from_inside{b.x, -b.y, b.z}, up{a.x, -a.y, -a.z};
      const double out = f(outside, below, a), in = f(inside, up, from_inside) / (1.5 * 1.5);
      EXPECT_NEAR(out, in, 2e-3 * out + 1e-6) << roughness << ", " << i;
      seen += out > 0;
    }
    EXPECT_GT(seen, 200) << "roughness " << roughness;
  }
}

// Fresnel at normal incidence: ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2); 1 at grazing; and for k = 0 that of glass.
TEST(Glossy, ConductorFresnel) {
  for (const double eta : {0.1, 0.5, 1.0, 1.5, 3.0})
    for (const double k : {0.0, 0.5, 2.0, 7.0}) {
      const auto share = [&](double cos) {
        return static_cast<double>(
            conductor_fresnel(static_cast<float>(cos), static_cast<float>(eta), static_cast<float>(k)));
      };
      const double normal = (std::pow(eta - 1, 2) + k * k) / (std::pow(eta + 1, 2) + k * k);
      EXPECT_NEAR(share(1), normal, 1e-6) << eta << " + " << k << " i";
      if (eta != 1 || k != 0) {
        EXPECT_NEAR(share(1e-6), 1, 1e-4) << eta << " + " << k << " i";
      }
      if (k != 0 || eta <= 1) continue;
      for (const double cos : {0.1, 0.4, 0.8}) {
        const float n = static_cast<float>(eta), of_glass = fresnel(static_cast<float>(cos), n, 1 / n, false).reflected;
        EXPECT_NEAR(share(cos), static_cast<double>(of_glass), 1e-5) << eta << ", cos " << cos;
      }
    }
}

}  // namespace
