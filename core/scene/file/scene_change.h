#pragma once

#include <string>

#include "scene/fields.h"

namespace glimt {

/// A setting's value as text: "4", "sobol".
std::string setting_text(const Settings& settings, const Field<Settings>& field);

/// The first thing in which a scene is not what it should be, where it stops left out: "seed is 2, not 1". Empty where
/// the samples of both scenes are equal.
std::string first_change(const Scene& is, const Scene& should_be);

}  // namespace glimt
