#include "studies/figures/material_export.hpp"

#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "core/material/material.hpp"
#include "core/material/prony_series.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

RollingScene with_series() {
  RollingScene scene = plain_scene();
  scene.material = MaterialModel::prony;
  scene.poisson_ratio = 0.45;
  scene.static_shear_modulus = 1e6;
  scene.stiffening = scene.creep_time = 0;
  scene.relaxation_times = {1e-4, 1e-2, 1.0};
  scene.relaxation_moduli = {8e6, 3e6, 5e5};
  scene.reference_temperature = 293.15;
  scene.temperature = 273.15;
  scene.wlf_c1 = 9;
  scene.wlf_c2 = 110;
  return scene;
}

/// What a reader of another program makes of its input.
struct ReadBack {
  PronySeries series;
  std::vector<double> shift;  ///< T0, C1, C2
};

std::vector<double> numbers(std::string line) {
  for (char& c : line)
    if (c == ',') c = ' ';
  std::istringstream words(line);
  std::vector<double> all;
  for (double one; words >> one;) all.push_back(one);
  return all;
}

/// Shares of a shear modulus at once.
PronySeries of_shares(double at_once, const std::vector<PronySeries::Term>& shares) {
  PronySeries series{at_once, {}};
  for (const PronySeries::Term& share : shares) {
    series.static_modulus -= at_once * share.modulus;
    series.terms.push_back({at_once * share.modulus, share.time});
  }
  return series;
}

ReadBack read_abaqus(const std::string& text) {
  std::istringstream lines(text);
  std::string line, keyword;
  std::vector<double> elastic;
  std::vector<PronySeries::Term> shares;
  ReadBack read;
  while (std::getline(lines, line)) {
    if (line.starts_with("**")) continue;
    if (line.starts_with('*')) {
      keyword = line;
      continue;
    }
    const std::vector<double> row = numbers(line);
    if (keyword == "*ELASTIC, MODULI=INSTANTANEOUS") elastic = row;
    if (keyword == "*VISCOELASTIC, TIME=PRONY") {
      CHECK(row.at(1) == row.at(0));
      shares.push_back({row.at(0), row.at(2)});
    }
    if (keyword == "*TRS, DEFINITION=WLF") read.shift = row;
  }
  read.series = of_shares(elastic.at(0) / (2 * (1 + elastic.at(1))), shares);
  return read;
}

ReadBack read_ansys(const std::string& text) {
  std::istringstream lines(text);
  std::string line, table;
  std::map<std::string, double> constants;
  std::vector<double> prony;
  ReadBack read;
  while (std::getline(lines, line)) {
    std::vector<std::string> words;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) words.push_back(cell);
    if (words.front() == "MP") constants[words.at(1)] = std::stod(words.at(3));
    if (words.front() == "TB") table = words.at(1) + words.at(words.size() - 1);
    if (words.front() != "TBDATA") continue;
    for (std::size_t i = 2; i < words.size(); ++i) {
      if (table == "PRONYSHEAR") prony.push_back(std::stod(words[i]));
      if (table == "SHIFTWLF") read.shift.push_back(std::stod(words[i]));
    }
  }
  std::vector<PronySeries::Term> shares;
  for (std::size_t i = 0; i + 1 < prony.size(); i += 2) shares.push_back({prony[i], prony[i + 1]});
  read.series = of_shares(constants.at("EX") / (2 * (1 + constants.at("PRXY"))), shares);
  return read;
}

/// Of rows with the modulus and the time in some columns, and constants in comments.
ReadBack read_rows(const std::string& text, std::size_t modulus, std::size_t time) {
  std::istringstream lines(text);
  ReadBack read;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (line.find("modulus at rest") != std::string::npos)
      read.series.static_modulus = std::stod(line.substr(colon + 2));
    if (line.find("Landel") != std::string::npos) read.shift = numbers(line.substr(line.rfind(": ") + 2));
    if (const std::vector<double> row = numbers(line); row.size() > std::max(modulus, time))
      read.series.terms.push_back({row[modulus], row[time]});
  }
  return read;
}

void check_same(const RollingScene& scene, const PronySeries& series) {
  for (int i = 0; i < 50; ++i) {
    const double omega = std::pow(10, -2 + 8 * i / 49.0);
    const std::complex<double> truth = complex_modulus(scene, omega), read = complex_modulus(series, omega);
    CHECK(std::abs(read - truth) < 1e-6 * std::abs(truth));
  }
}

}  // namespace

TEST_CASE("an exported series with its shift is that of the scene, read by the rules of other programs",
          "[studies][scene_io]") {
  const RollingScene scene = with_series();
  RollingScene at_reference = scene;
  at_reference.temperature = 293.15;
  for (const ReadBack& read :
       {read_abaqus(exported_material(scene, "layer", "abaqus")), read_ansys(exported_material(scene, "layer", "ansys")),
        read_rows(exported_material(scene, "layer", "comsol"), 1, 2), read_rows(exported_material(scene, "layer", "prony_csv"), 1, 0)}) {
    REQUIRE(read.series.terms.size() == 3);
    check_same(at_reference, read.series);
    CHECK(read.shift == std::vector<double>{293.15, 9, 110});
  }
}

TEST_CASE("VFT is exported as WLF, other shifts as the series at the temperature of the scene", "[studies][scene_io]") {
  RollingScene scene = with_series();
  scene.wlf_c1.reset();
  scene.wlf_c2.reset();
  scene.vft_b = 2000;
  scene.vft_temperature = 193.15;
  const ReadBack vft = read_abaqus(exported_material(scene, "layer", "abaqus"));
  REQUIRE(vft.shift.size() == 3);
  CHECK(vft.shift[1] == Approx(2000 / (100 * std::log(10.0))).epsilon(1e-12));
  CHECK(vft.shift[2] == Approx(100).epsilon(1e-12));
  scene.vft_b.reset();
  scene.vft_temperature.reset();
  scene.activation_energy = 1e5;
  const std::string text = exported_material(scene, "layer", "comsol");
  CHECK_THAT(text, Catch::Contains("at 273.15 K"));
  CHECK(read_rows(text, 1, 2).shift.empty());
  check_same(scene, read_rows(text, 1, 2).series);
}

TEST_CASE("a fractional solid is exported as a scene of a Prony series with the same moduli", "[studies][scene_io]") {
  RollingScene scene = plain_scene();
  scene.material = MaterialModel::fractional_zener;
  scene.fractional_order = 0.6;
  scene.stiffening = 30;
  scene.reference_temperature = 293.15;
  scene.temperature = 283.15;
  scene.activation_energy = 9e4;
  const TemporaryDirectory folder;
  const RollingScene read = read_scene(folder.write("scene.json", exported_material(scene, "layer", "scene")));
  CHECK(read.material == MaterialModel::prony);
  CHECK(read.activation_energy == scene.activation_energy);
  const CreepSpectrum creep = creep_spectrum(scene), again = creep_spectrum(read);
  for (int i = 0; i < 50; ++i) {
    const double omega = std::pow(10, -4 + 10 * i / 49.0);
    CHECK(std::abs(again(omega) / creep(omega) - 1.0) < 1e-6);
  }
}
