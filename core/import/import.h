#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

/// Scenes of other programs, and bare meshes, as scenes of glimt.
namespace glimt {

/// What of a file has no counterpart here.
struct ImportNote {
  std::string place;    ///< "room.xml:12", or "room.glb"
  std::string what;     ///< "bsdf plastic"
  std::string instead;  ///< what is put in its place: "lambertian of its diffuse reflectance"
};

struct ImportedScene {
  Scene scene;
  std::vector<ImportNote> notes;
};

/// By its ending: .xml (Mitsuba 3), .gltf and .glb (glTF 2.0), .obj, .ply.
bool is_importable(const std::filesystem::path& file);

/// Throws SceneError.
ImportedScene import_scene(const std::filesystem::path& file);

/// "room.xml:12: bsdf plastic: lambertian of its diffuse reflectance in its place"
std::string text_of(const ImportNote& note);

/// Reads a scene file, or imports what is none; overrides as of read_scene. Throws SceneError.
ImportedScene read_or_import(const std::filesystem::path& file, std::span<const std::string> overrides = {});

}  // namespace glimt
