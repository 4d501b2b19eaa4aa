#pragma once

/// The rules a scene must keep, and the method that it asks for.

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

/// Every rule the scene breaks, each as one line "key = value: rule" (ranges, and what must go together:
/// load or approach, spacing or tolerance, driving_torque with drive torque, ...). Empty: the scene can be solved.
std::vector<std::string> check(const RollingScene& scene);

/// Why an output is absent from every answer to such a scene, as the approach of a cylinder on a half-space is; empty
/// if it is not.
std::string why_absent(const RollingScene& scene, std::string_view output);

/// Why method spectral cannot be asked, as the rule that the scene breaks; empty if it can.
std::string spectral_refusal(const RollingScene& scene);
bool spectral_applies(const RollingScene& scene);

/// The method that solves the scene first: its own, or what `automatic` stands for.
Method resolved_method(const RollingScene& scene);

}  // namespace rollres
