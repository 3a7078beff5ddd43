#include "chart/ablation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "chart/materials.h"
#include "chart/words.h"
#include "scene/fields.h"

namespace glimt {
namespace {

/// Values of a numeric setting worth trying.
std::vector<double> values_to_try(std::string_view key) {
  if (key == "shadow_rays") return {1, 2, 4, 8, 30};
  if (key == "max_depth") return {1, 2, 4, 8};
  if (key == "light_paths") return {0, 0.1, 0.3, 1};
  return {};
}

bool is_of_caustics(std::string_view key) {
  return key == "caustics" || key == "light_paths" || key == "sphere_connections";
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

struct AddPieces {
  const Scene& scene;
  std::vector<Piece>& pieces;
  std::string_view key;

  void operator()(const Choice<Settings>& choice) const {
    if (key == "method") return;
    for (std::size_t value = 0; value < choice.names.size(); ++value) {
      if (choice.get(scene.render) == static_cast<int>(value)) continue;
      Piece piece{words(key) + " " + std::string(choice.names[value]), key == "caustics", scene};
      choice.set(piece.scene.render, static_cast<int>(value));
      pieces.push_back(std::move(piece));
    }
  }
  template <class T>
  void operator()(const Value<Settings, T>& setting) const {
    for (const double value : values_to_try(key)) {
      if (setting.get(scene.render) == static_cast<T>(value)) continue;
      Piece piece{words(key) + " " + number(value), key == "max_depth", scene};
      setting.set(piece.scene.render, static_cast<T>(value));
      pieces.push_back(std::move(piece));
    }
  }
};

void set(const Field<Material>& field, Material& material, int value) {
  if (const auto* choice = std::get_if<Choice<Material>>(&field.member))
    choice->set(material, value);
  else if (const auto* number = std::get_if<Value<Material, double>>(&field.member))
    number->set(material, value);
}

/// The scene with that value in every material that reads the key, where this changes something.
void add_material_piece(const Scene& scene, std::vector<Piece>& pieces, std::string_view key, std::string_view name,
                        int value) {
  Piece piece{words(key) + " " + std::string(name), true, scene};
  for (Material& material : piece.scene.materials)
    if (is_used(scene, material.name))
      for (const auto& field : material_info(material.type).fields)
        if (field.key == key) set(field, material, value);
  if (piece.scene != scene && std::ranges::find(pieces, piece.name, &Piece::name) == pieces.end())
    pieces.push_back(std::move(piece));
}

/// Adds every other choice that materials have, and 0 in place of their numbers.
void add_material_pieces(const Scene& scene, std::vector<Piece>& pieces) {
  for (const MaterialInfo& info : material_infos())
    for (const auto& field : info.fields) {
      if (const auto* choice = std::get_if<Choice<Material>>(&field.member))
        for (std::size_t k = 0; k < choice->names.size(); ++k)
          add_material_piece(scene, pieces, field.key, choice->names[k], static_cast<int>(k));
      else if (std::holds_alternative<Value<Material, double>>(field.member) && field.min == 0 && !field.min_excluded)
        add_material_piece(scene, pieces, field.key, "0", 0);
    }
}

/// Renders both in turn, a part at a time, so that other load on the machine slows both alike. Returns the time of the
/// first divided by that of the second.
double render_both(const CompiledScene& a, Film& film_a, const CompiledScene& b, Film& film_b, const Plan& plan) {
  constexpr int parts = 4;
  double seconds_a = 0, seconds_b = 0;
  for (int part = 1; part <= parts; ++part) {
    const int count = plan.spp * part / parts - film_a.samples();
    if (count == 0) continue;
    seconds_a += seconds_of_pass(a, film_a, count, plan.execution);
    seconds_b += seconds_of_pass(b, film_b, count, plan.execution);
  }
  return seconds_a / seconds_b;
}

/// The results of one piece, one for each seed.
struct Series {
  std::vector<double> time, noise, efficiency, difference, mean;
};

Ablation summary(const Series& s) {
  const auto count = static_cast<double>(s.difference.size());
  double mean = 0, squares = 0;
  for (const double d : s.difference) mean += d / count;
  for (const double d : s.difference) squares += (d - mean) * (d - mean);
  return {quantile(s.time, 0.5),
          quantile(s.noise, 0.5),
          quantile(s.efficiency, 0.5),
          quantile(s.efficiency, 0.25),
          quantile(s.efficiency, 0.75),
          mean,
          std::sqrt(squares / (count - 1) / count),
          quantile(s.mean, 0.5)};
}

}  // namespace

std::vector<Piece> pieces_of(const Scene& scene) {
  std::vector<Piece> pieces;
  add_material_pieces(scene, pieces);
  const bool caustics = has_specular(scene);
  for (const auto& field : settings_fields())
    if (caustics || !is_of_caustics(field.key)) std::visit(AddPieces{scene, pieces, field.key}, field.member);
  return pieces;
}

double error_of_difference(const Film& a, const Film& b) {
  const Image a0 = a.half_mean(0), a1 = a.half_mean(1), b0 = b.half_mean(0), b1 = b.half_mean(1);
  const std::vector<double> weights = relative_weights(b0, b1, 1.0 * b.half_samples(0) / b.samples());
  double total = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    total += (static_cast<double>(a0.rgb[i]) - b0.rgb[i]) * (static_cast<double>(a1.rgb[i]) - b1.rgb[i]) * weights[i];
  return total / static_cast<double>(weights.size());
}

std::vector<Ablation> ablate(const Scene& scene, const std::vector<Piece>& pieces, const Plan& plan,
                             const std::function<void(double)>& report) {
  CompiledScene base = compile(scene);
  std::vector<CompiledScene> changed;
  changed.reserve(pieces.size());
  for (const Piece& piece : pieces) changed.push_back(compile(piece.scene));
  std::vector<Series> all(pieces.size());
  double done = 0;
  const double work = static_cast<double>(plan.seeds) * static_cast<double>(pieces.size());
  for (int run = 0; run < plan.seeds; ++run) {
    base.settings.seed = scene.render.seed + run;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      changed[i].settings.seed = base.settings.seed;
      Film part = make_film(changed[i]), whole = make_film(base);
      const double time = render_both(changed[i], part, base, whole, plan);
      const double noise = estimate_error(part).relmse_scaled / estimate_error(whole).relmse_scaled;
      all[i].time.push_back(time);
      all[i].noise.push_back(noise);
      all[i].efficiency.push_back(1 / (noise * time));
      all[i].mean.push_back(mean(part.mean()) / mean(whole.mean()));
      all[i].difference.push_back(error_of_difference(part, whole));
      if (report) report(++done / work);
    }
  }
  std::vector<Ablation> result;
  result.reserve(all.size());
  for (const Series& series : all) result.push_back(summary(series));
  return result;
}

std::string verdict(const Piece& piece, const Ablation& a) {
  // Five standard errors, since few seeds leave the standard error itself uncertain.
  const double margin = 5 * a.difference_error;
  const bool differs = a.difference - margin > visible_difference;
  // A standard error of 0 with unequal noise means that no sample has met the light that matters yet.
  const bool known = a.difference_error > 0 || a.noise == 1;
  const bool same = known && a.difference + margin < visible_difference;
  if (piece.model) return differs ? "needed: the image changes" : same ? "not needed here" : "more samples would tell";
  if (differs) return "changes the image";
  if (a.efficiency_low > 1.1) return "better";
  if (a.efficiency_high < 1 / 1.1) return "worse";
  return "no matter here";
}

}  // namespace glimt
