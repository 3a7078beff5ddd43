#pragma once

#include <filesystem>
#include <optional>

#include "film/checkpoint.h"

namespace glimt {

/// glimt in the user's folder for what programs keep ($XDG_STATE_HOME, else ~/.local/state); empty where there is none.
std::filesystem::path autosave_folder();

/// A checkpoint that belongs to a running program: one that ends as it should removes it, one that crashes leaves it.
class Autosave {
 public:
  /// Takes a name of its own in the folder, which is made where it is missing. Throws std::runtime_error where nothing
  /// can be kept there.
  explicit Autosave(std::filesystem::path folder);
  ~Autosave();
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  /// Where this program keeps what it has.
  const std::filesystem::path& file() const { return file_; }
  /// The newest that a program which runs no more has left; nobody else finds it while this object lives. It stays
  /// until it is forgotten.
  const std::optional<std::filesystem::path>& left_behind() const { return left_behind_; }
  void forget_left_behind();

 private:
  void find_left_behind();

  std::filesystem::path folder_, file_;
  std::optional<std::filesystem::path> left_behind_;
  int lock_ = -1, left_behind_lock_ = -1;
};

}  // namespace glimt
