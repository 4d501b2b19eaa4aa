#pragma once

/// A study: one scene and the axes along which it is varied. Every combination of the axes' values is one point.
///
///     {"study": "speed and load", "scene": "paper_cylinder.json", "set": {"method": "newton"},
///      "axes": {"speed": {"from": "1 mm/s", "to": "10 m/s", "points": 60, "spacing": "logarithmic"},
///               "load": ["10 kN/m", "20 kN/m"]},
///      "chart": {"x": "speed", "y": "rolling_resistance", "family": "load"}}
///
/// `scene` is the name of a scene file, relative to the study file, or the scene itself; `set` replaces inputs of it as
/// `--set` does; `chart` and `comment` may be left out. Every input can be an axis: `from`, `to` and `points` with
/// linear (the default) or logarithmic spacing, or a list; a choice such as `method` is a list of names.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene.hpp"

namespace rollres {

/// The values that one input takes.
struct Axis {
  std::string key;
  std::vector<double> values = {};      ///< [SI unit of the key]; empty for a choice
  std::vector<std::string> texts = {};  ///< names, for a choice; empty for a number
  bool logarithmic = false;             ///< spaced so; a chart draws it so

  std::size_t size() const { return values.empty() ? texts.size() : values.size(); }
};

/// What a chart of the study shows; empty where the file says nothing.
struct StudyChart {
  std::string x;       ///< an axis or an output
  std::string y;       ///< an output
  std::string family;  ///< the axis with one curve for each of its values
};

struct Study {
  std::string name;
  RollingScene base;  ///< inputs that are axes hold their first value; what only some drives of an axis use is kept
  std::vector<Axis> axes;
  StudyChart chart = {};
  std::string source = {};  ///< where the study was read from, for messages
};

/// Reads a study file and checks every point of it.
/// @throws std::invalid_argument one line naming file, key, value and the rule that is broken
/// @throws std::runtime_error if the study file or its scene file cannot be read
Study read_study(const std::filesystem::path& file);

/// The scenes of a study: every combination of the axes' values, the last axis varying fastest. An axis that gives one
/// of load and approach, or of spacing and tolerance, replaces the other.
/// @throws std::invalid_argument naming the point and the rule if a scene breaks one
std::vector<RollingScene> points(const Study& study);

}  // namespace rollres
