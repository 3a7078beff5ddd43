#include "viewer/state/scene_difference.h"

#include <cstdio>
#include <set>
#include <type_traits>
#include <utility>
#include <variant>

#include "chart/words.h"
#include "scene/fields.h"
#include "scene/pick.h"
#include "viewer/state/edit.h"
#include "viewer/widgets/labels.h"

namespace glimt {
namespace {

std::string text_of(int value) { return std::to_string(value); }
std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}
std::string text_of(const glm::dvec3& v) { return text_of(v.x) + " " + text_of(v.y) + " " + text_of(v.z); }

/// A field's value in words. Names of samplers and methods stand without their key.
template <class T>
std::string value_text(const Field<T>& field, const T& object) {
  return std::visit(
      [&](const auto& member) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, Choice<T>>) {
          const std::string name(member.names[static_cast<std::size_t>(member.get(object))]);
          return field.key == "sampler" || field.key == "method" ? name : words(field.key) + " " + name;
        } else {
          return words(field.key) + " " + text_of(member.get(object));
        }
      },
      field.member);
}

class Finder {
 public:
  Finder(const Scene& from, const Scene& to) : from_(from), to_(to) {}

  std::vector<Difference> find() {
    settings();
    if (from_.image != to_.image) add("image", size_text(from_.image), size_text(to_.image));
    if (from_.camera != to_.camera) add("camera", "first camera", "camera moved");
    if (objects_of(from_).size() != objects_of(to_).size()) {
      add("scene", from_.name, to_.name);
    } else {
      for (const ObjectId& object : objects_of(to_)) {
        if (!contains(from_, object)) continue;
        material(object);
        place(object);
      }
    }
    return std::move(found_);
  }

 private:
  void add(const std::string& key, std::string from, std::string to) {
    if (known_.insert(key).second) found_.push_back({key, std::move(from), std::move(to)});
  }

  template <class T>
  void field(const Field<T>& field, const std::string& owner, const T& from, const T& to) {
    const std::string a = value_text(field, from), b = value_text(field, to);
    if (a != b) add(owner + std::string(field.key), owner + a, owner + b);
  }

  void settings() {
    Settings from = from_.render;
    for (const auto& f : settings_fields()) {
      if (f.key == "spp" || f.key == "target_error") continue;
      field(f, "", from, to_.render);
      // A method sets other settings too. Only what differs from those is told.
      if (f.key == "method" && from.method != to_.render.method) set_method(from, to_.render.method);
    }
  }

  void material(const ObjectId& object) {
    const std::string &a = material_name_of(from_, object), &b = material_name_of(to_, object);
    const Material &from = *find_material(from_, a), &to = *find_material(to_, b);
    const std::string owner = (a == b ? b : display_name(to_, object)) + " ";
    const MaterialInfo &info = material_info(to.type), &was = material_info(from.type);
    if (from.type != to.type) {
      add(owner + "type", owner + std::string(was.name), owner + std::string(info.name));
      return;
    }
    for (const auto& f : info.fields) field(f, owner, from, to);
  }

  void place(const ObjectId& object) {
    const std::string owner = display_name(to_, object) + " ";
    if (object.kind == ObjectKind::sphere) {
      const Sphere &from = from_.spheres[object.index], &to = to_.spheres[object.index];
      if (from.radius != to.radius)
        add(owner + "radius", owner + "radius " + text_of(from.radius), owner + "radius " + text_of(to.radius));
      if (from.center != to.center) add(owner + "place", owner + "not moved", owner + "moved");
      return;
    }
    const bool same = object.kind == ObjectKind::mesh
                          ? from_.meshes[object.index].vertices == to_.meshes[object.index].vertices
                          : from_.polygons[object.index].vertices == to_.polygons[object.index].vertices;
    if (same) return;
    const double a = size_of(from_, object), b = size_of(to_, object);
    if (text_of(a) != text_of(b))
      add(owner + "size", owner + "size " + text_of(a), owner + "size " + text_of(b));
    else
      add(owner + "place", owner + "not moved", owner + "moved");
  }

  const Scene &from_, &to_;
  std::vector<Difference> found_;
  std::set<std::string> known_;
};

}  // namespace

std::vector<Difference> differences(const Scene& from, const Scene& to) { return Finder(from, to).find(); }

}  // namespace glimt
