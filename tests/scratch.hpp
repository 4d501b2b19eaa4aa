#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "core/scene.hpp"
#include "core/solution.hpp"

/// A folder of its own for each test, removed with everything in it.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "rollres-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no scratch folder");
    folder_ = name;
  }
  ~Scratch() { std::filesystem::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

inline void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What `work` throws, or "nothing".
template <class Work>
std::string message_of(Work&& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing";
}

/// A scene that breaks no rule.
inline rollres::RollingScene plain_scene(double speed = 1.0, double load = 1e4) {
  rollres::RollingScene scene;
  scene.radius = 0.1;
  scene.layer_thickness = 0.01;
  scene.static_shear_modulus = 1e6;
  scene.stiffening = 2;
  scene.creep_time = 0.1;
  scene.friction_coefficient = 0.3;
  scene.speed = speed;
  scene.load = load;
  return scene;
}

/// A closed form in place of a solver: quick, and different for different scenes.
inline rollres::RollingSolution closed_form(const rollres::RollingScene& scene) {
  rollres::RollingSolution solution;
  solution.load = scene.load.value_or(1e9 * scene.approach.value_or(0));
  solution.rolling_resistance = 0.01 * solution.load * scene.speed / (1 + scene.speed * scene.speed);
  solution.rolling_resistance_coefficient = solution.rolling_resistance / solution.load;
  solution.contact_nodes = 31;
  solution.seconds = 1e-6;
  solution.method = scene.method;
  solution.status = rollres::Status::converged;
  return solution;
}
