#include "material/lobes.h"

#include <algorithm>
#include <stdexcept>

namespace glimt {
namespace {

template <class M>
MaterialInfo info_of() {
  return {.name = M::name,
          .doc = M::doc,
          .fields = M::fields(),
          .lobe_class = M::lobe_class,
          .transmits = M::transmits,
          .emits = M::emits,
          .albedo = M::albedo,
          .radiance = M::radiance_of,
          .refractive_index = M::refractive_index};
}

template <class... M>
std::vector<MaterialInfo> infos_of(MaterialList<M...>) {
  return {info_of<M>()...};
}

template <class... M>
ChosenLobe lower_as(const Material& material, MaterialList<M...>) {
  ChosenLobe row;
  const auto lower_if = [&]<class One>(One) {
    if (material.type == One::name) One::lower(material, row);
  };
  (lower_if(M{}), ...);
  return row;
}

}  // namespace

std::span<const MaterialInfo> material_infos() {
  static const std::vector<MaterialInfo> infos = infos_of(AllMaterials{});
  return infos;
}

const MaterialInfo* find_material_info(std::string_view type) {
  const auto it = std::ranges::find(material_infos(), type, &MaterialInfo::name);
  return it == material_infos().end() ? nullptr : &*it;
}

const MaterialInfo& material_info(std::string_view type) {
  const MaterialInfo* info = find_material_info(type);
  if (!info) throw std::invalid_argument("there is no material type " + std::string(type));
  return *info;
}

ChosenLobe lower(const Material& material) { return lower_as(material, AllMaterials{}); }

}  // namespace glimt
