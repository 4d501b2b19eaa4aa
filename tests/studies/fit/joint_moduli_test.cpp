#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>

#include "core/material/fractional_zener.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"
#include "tests/studies/half_space_fit.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers fit_data, too: columns of moduli in fits of scenes.

using namespace rollres;
using nlohmann::json;

namespace {

constexpr double true_modulus = 1e6, true_stiffening = 2, true_time = 0.1;  // as half_space_scene

/// Moduli of that solid at 12 frequencies from 0.1 to 1000 rad/s, each off by a normal error of its relative deviation.
struct DrawnModuli {
  std::vector<double> frequencies, storage, loss;

  explicit DrawnModuli(double storage_noise = 0, double loss_noise = 0, std::uint64_t seed = 1) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 12; ++i) {
      const double omega = std::pow(10, -1 + 4 * i / 11.0);
      const auto modulus = complex_modulus(FractionalZener{true_modulus, true_stiffening, true_time, 1}, omega);
      frequencies.push_back(omega / (2 * std::numbers::pi));
      storage.push_back(modulus.real() * (1 + storage_noise * normal(random)));
      loss.push_back(modulus.imag() * (1 + loss_noise * normal(random)));
    }
  }

  /// A table under a heading "frequency [Hz]," and the one given. @param row  the cells of a row, from G', G"
  template <class Row>
  std::string table(const std::string& heading, const Row& row) const {
    std::ostringstream text;
    text.precision(15);
    text << "frequency [Hz]," << heading << '\n';
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      text << frequencies[i];
      for (const double cell : std::vector<double>(row(storage[i], loss[i]))) text << ',' << cell;
      text << '\n';
    }
    return text.str();
  }
};

/// Resistances of the same solid, 2 % said of each.
std::string resistances(double noise = 0, std::uint64_t seed = 1) {
  std::ostringstream text;
  text.precision(15);
  text << "load [N/m],speed [m/s],rolling_resistance [N/m],sigma [%]\n";
  for (const MeasuredScene& row : measured(quick_resistance, spread_speeds(0.005, 5, 8), {1e4, 4e4}, noise, seed))
    text << *row.scene.load << ',' << row.scene.speed << ',' << row.measured.value << ",2\n";
  return text.str();
}

json moduli_set(const json& more = json::object()) {
  json set{{"file", "dma.csv"},
           {"name", "dma"},
           {"output", "moduli"},
           {"listed_moduli", "shear"},
           {"set", {{"speed", 1}, {"load", 1e4}}}};
  set.update(more);
  if (set["listed_moduli"].is_null()) set.erase("listed_moduli");
  return set;
}

class Fits {
 public:
  /// @param moduli  the table of moduli; empty: none   @param more  keys of its data set
  ProgramRun run(const std::string& moduli, const std::string& resistance, const json& parameters,
                 const json& more = json::object()) const {
    json fit = half_space_fit();
    fit["parameters"] = parameters;
    fit["data"] = json::array();
    fit["starts"] = 1;
    if (!resistance.empty()) fit["data"].push_back({{"file", "rig.csv"}, {"name", "rig"}});
    if (!moduli.empty()) fit["data"].push_back(moduli_set(more));
    directory_.write("rig.csv", resistance);
    directory_.write("dma.csv", moduli);
    return run_rollres({"fit", directory_.write("fit.json", fit.dump()).string(), "--db",
                        (directory_ / "fits.db").string(), "--json", "--no-profiles"},
                       quick_resistance);
  }

  /// G0 alone, from moduli: its value and its relative error.
  std::pair<double, double> modulus(const std::string& moduli, const json& more = json::object(),
                                    const std::string& resistance = "") const {
    const ProgramRun made = run(moduli, resistance, {{"static_shear_modulus", "1.5 MPa"}}, more);
    CAPTURE(made.err);
    const json answer = json::parse(made.out);
    return {answer["parameters"][0]["value"], answer["parameters"][0]["relative_error"]};
  }

 private:
  TemporaryDirectory directory_;
};

const auto both = [](double storage, double loss) { return std::vector<double>{storage / 1e6, loss / 1e3}; };
constexpr const char* both_units = "storage_modulus [MPa],loss_modulus [kPa]";

}  // namespace

TEST_CASE("the error of a modulus fitted to moduli is that of their mean, weighted as their columns of sigma say",
          "[studies][fit]") {
  // All moduli are proportional to G0: n relative deviations s leave s/sqrt(n), and weights add.
  const Fits fits;
  const DrawnModuli exact;
  const auto check = [&](const std::pair<double, double>& found, double error) {
    CHECK(found.first == Approx(true_modulus).epsilon(1e-6));
    CHECK(found.second == Approx(error).epsilon(1e-3));
  };
  const std::string plain = exact.table(both_units, both);
  check(fits.modulus(plain, {{"sigma", "2 %"}}), 0.02 / std::sqrt(24));
  check(fits.modulus(plain, {{"sigma", {{"storage_modulus", "1 %"}, {"loss_modulus", "4 %"}}}}),
        1 / std::sqrt(12 / (0.01 * 0.01) + 12 / (0.04 * 0.04)));
  check(fits.modulus(exact.table(std::string(both_units) + ",sigma [%]",
                                 [](double storage, double loss) {
                                   return std::vector<double>{storage / 1e6, loss / 1e3, 2};
                                 })),
        0.02 / std::sqrt(24));
  check(fits.modulus(exact.table("storage_modulus [MPa],sigma [%]",
                                 [](double storage, double) {
                                   return std::vector<double>{storage / 1e6, 2};
                                 })),
        0.02 / std::sqrt(12));
  double information = 0;  // of a deviation of 0.1 MPa of each
  for (std::size_t i = 0; i < exact.storage.size(); ++i)
    information += (exact.storage[i] * exact.storage[i] + exact.loss[i] * exact.loss[i]) / 1e10;
  check(fits.modulus(exact.table(std::string(both_units) + ",sigma [MPa]",
                                 [](double storage, double loss) {
                                   return std::vector<double>{storage / 1e6, loss / 1e3, 0.1};
                                 })),
        1 / std::sqrt(information));
}

TEST_CASE("a loss tangent beside either modulus is as good as the other modulus in a fit of a scene",
          "[studies][fit]") {
  const Fits fits;
  const DrawnModuli drawn(0.02, 0.02);
  const json sigma{{"sigma", {{"storage_modulus", "1 %"}, {"loss_modulus", "4 %"}}}};
  const auto [value, error] = fits.modulus(drawn.table(both_units, both), sigma);
  for (const char* const name : {"tan_delta", "loss_tangent"}) {
    const auto beside_storage = fits.modulus(drawn.table("storage_modulus [MPa]," + std::string(name),
                                                         [](double storage, double loss) {
                                                           return std::vector<double>{storage / 1e6, loss / storage};
                                                         }),
                                             sigma);
    CHECK(beside_storage.first == Approx(value).epsilon(1e-8));
    CHECK(beside_storage.second == Approx(error).epsilon(1e-6));
  }
  const auto beside_loss = fits.modulus(drawn.table("loss_modulus [kPa],tan_delta",
                                                    [](double storage, double loss) {
                                                      return std::vector<double>{loss / 1e3, loss / storage};
                                                    }),
                                        sigma);
  CHECK(beside_loss.first == Approx(value).epsilon(1e-8));
  CHECK(beside_loss.second == Approx(error).epsilon(1e-6));
}

TEST_CASE("Young's moduli in a fit of a scene give the shear modulus of a third, and ask which they are",
          "[studies][fit]") {
  const Fits fits;
  const DrawnModuli exact;
  const auto young = [](double storage, double loss) { return std::vector<double>{3 * storage / 1e6, 3 * loss / 1e3}; };
  const json sigma{{"sigma", "2 %"}};
  const double shear = fits.modulus(exact.table(both_units, both), sigma).first;
  const json said{{"sigma", "2 %"}, {"listed_moduli", "young"}};
  CHECK(fits.modulus(exact.table(both_units, young), said).first == Approx(shear).epsilon(1e-6));
  const json unsaid{{"listed_moduli", nullptr}};
  const json start{{"static_shear_modulus", "1.5 MPa"}};
  const ProgramRun named = fits.run(exact.table("E' [MPa],E'' [kPa]", young), "", start, unsaid);
  CHECK(json::parse(named.out)["parameters"][0]["value"].get<double>() == Approx(shear).epsilon(1e-6));
  CHECK_THAT(fits.run(exact.table(both_units, young), "", start, unsaid).err,
             Catch::Contains("listed_moduli is missing: storage_modulus of dma.csv: of shear or Young's?"));
  CHECK_THAT(fits.run("time [s],relaxation_modulus [MPa]\n1,1\n2,1\n", "", start,
                      {{"listed_moduli", nullptr}, {"output", "relaxation_modulus"}})
                 .err,
             Catch::Contains("name the column of the table relaxation_shear_modulus or relaxation_young_modulus"));
}

TEST_CASE("a fit of a scene warns of columns of moduli that were exchanged", "[studies][fit]") {
  const Fits fits;
  const DrawnModuli exact;
  const auto warnings = [&](const auto& row) {
    return json::parse(
               fits.run(exact.table(both_units, row), "", {{"static_shear_modulus", "1.5 MPa"}}).out)["warnings"]
        .dump();
  };
  const std::string asked =
      "dma.csv: the loss modulus is above the storage modulus in 12 of 12 rows: are the two swapped?";
  CHECK_THAT(warnings([](double storage, double loss) {
               return std::vector<double>{loss / 1e6, storage / 1e3};
             }),
             Catch::Contains(asked));
  CHECK_THAT(warnings(both), !Catch::Contains("swapped"));
}

TEST_CASE("a column of sigma without a unit is refused where the moduli beside it have different ones",
          "[studies][fit]") {
  const Fits fits;
  const DrawnModuli exact;
  const json start{{"static_shear_modulus", "1.5 MPa"}};
  const auto refused = [&](const std::string& heading, const auto& row) {
    const ProgramRun run = fits.run(exact.table(heading, row), "", start);
    CHECK(run.status == 2);
    return run.err;
  };
  CHECK_THAT(refused(std::string(both_units) + ",sigma",
                     [](double storage, double loss) {
                       return std::vector<double>{storage / 1e6, loss / 1e3, 0.1};
                     }),
             Catch::Contains("dma.csv: sigma: must have its unit in the heading"));
  CHECK_THAT(refused("storage_modulus [MPa],tan_delta,sigma",
                     [](double storage, double loss) {
                       return std::vector<double>{storage / 1e6, loss / storage, 0.1};
                     }),
             Catch::Contains("dma.csv: sigma: must have its unit in the heading"));
}

TEST_CASE("in a joint fit the information of moduli and of resistances adds up", "[studies][fit]") {
  const Fits fits;
  const DrawnModuli exact;
  const std::string moduli = exact.table("storage_modulus [MPa],tan_delta,sigma [%]", [](double storage, double loss) {
    return std::vector<double>{storage / 1e6, loss / storage, 5};
  });
  const auto alone = fits.modulus(moduli), beside = fits.modulus("", json::object(), resistances());
  const auto [value, error] = fits.modulus(moduli, json::object(), resistances());
  CHECK(value == Approx(true_modulus).epsilon(1e-5));
  CHECK(beside.first == Approx(true_modulus).epsilon(1e-5));
  CHECK(1 / (error * error) ==
        Approx(1 / (alone.second * alone.second) + 1 / (beside.second * beside.second)).epsilon(0.01));
}

TEST_CASE("a relaxation curve and a creep curve give the material back, with the error of their mean",
          "[studies][fit]") {
  // Of the Zener solid: G(t) = G0 (1 + f exp(-(1 + f) t/tau)), J(t) = (1 - f/(1 + f) exp(-t/tau))/G0.
  const Fits fits;
  std::ostringstream relaxation, creep;
  relaxation << "time [ms],relaxation_modulus [MPa],sigma [%]\n";
  creep << "time [ms],creep_compliance [1/MPa],sigma [%]\n";
  relaxation.precision(15);
  creep.precision(15);
  for (int i = 0; i < 10; ++i) {
    const double time = 1e-3 * std::pow(10, 3 * i / 9.0), f = true_stiffening;
    relaxation << 1e3 * time << ',' << true_modulus * (1 + f * std::exp(-(1 + f) * time / true_time)) / 1e6 << ",2\n";
    creep << 1e3 * time << ',' << (1 - f / (1 + f) * std::exp(-time / true_time)) / true_modulus * 1e6 << ",2\n";
  }
  const json all{{"static_shear_modulus", "1.5 MPa"}, {"stiffening", 1}, {"creep_time", 0.03}};
  for (const auto& [output, table] :
       {std::pair("relaxation_modulus", relaxation.str()), std::pair("creep_compliance", creep.str())}) {
    CAPTURE(output);
    const json set{{"output", output}};
    const auto [value, error] = fits.modulus(table, set);
    CHECK(value == Approx(true_modulus).epsilon(1e-6));
    CHECK(error == Approx(0.02 / std::sqrt(10)).epsilon(1e-3));
    const json answer = json::parse(fits.run(table, "", all, set).out);
    CHECK(answer["parameters"][1]["value"].get<double>() == Approx(true_modulus).epsilon(1e-3));
    CHECK(answer["parameters"][2]["value"].get<double>() == Approx(true_stiffening).epsilon(1e-3));
    CHECK(answer["parameters"][0]["value"].get<double>() == Approx(true_time).epsilon(1e-3));
    const auto [beside, less] = fits.modulus(table, set, resistances());
    CHECK(beside == Approx(true_modulus).epsilon(1e-5));
    CHECK(less < error);
  }
  CHECK_THAT(
      fits.run("frequency [Hz],relaxation_modulus [MPa]\n1,1\n2,1\n", "", all, {{"output", "relaxation_modulus"}}).err,
      Catch::Contains("frequency: unknown column"));
  CHECK_THAT(fits.run("relaxation_modulus [MPa]\n1\n2\n", "", all, {{"output", "relaxation_modulus"}}).err,
             Catch::Contains("has no column time"));
  CHECK_THAT(fits.run("time [s],relaxation_modulus [MPa]\n0,1\n2,1\n", "", all, {{"output", "relaxation_modulus"}}).err,
             Catch::Contains("time [s] = 0: must be > 0"));
}

TEST_CASE("intervals of a joint fit to loss tangents and resistances hold the truth as often as they say",
          "[studies][fit][long]") {
  const Fits fits;
  const json parameters{
      {"static_shear_modulus", "2 MPa"}, {"stiffening", 1}, {"creep_time", 0.03}, {"offset", {{"data", "rig"}}}};
  const std::map<std::string, double> truth{{"static_shear_modulus", true_modulus},
                                            {"stiffening", true_stiffening},
                                            {"creep_time", true_time},
                                            {"offset", 0}};
  std::map<std::string, int> held;
  constexpr int draws = 20;
  for (std::uint64_t seed = 1; seed <= draws; ++seed) {
    const DrawnModuli drawn(0.01, 0.03, seed);
    const std::string moduli = drawn.table("storage_modulus [MPa],tan_delta", [](double storage, double loss) {
      return std::vector<double>{storage / 1e6, loss / storage};
    });
    const json answer = json::parse(fits.run(moduli, resistances(0.02, seed), parameters,
                                             {{"sigma", {{"storage_modulus", "1 %"}, {"loss_modulus", "3 %"}}}})
                                        .out);
    for (const json& one : answer["parameters"]) {
      const std::string name = std::string(one["name"]).substr(0, std::string(one["name"]).find(" ("));
      const double low = one["linear_interval"]["lowest"], high = one["linear_interval"]["highest"];
      held[name] += low <= truth.at(name) && truth.at(name) <= high;
    }
  }
  CHECK(held.size() == truth.size());
  for (const auto& [name, count] : held) {
    CAPTURE(name);
    CHECK(count >= 16);  // of 20: three deviations of the binomial distribution below 95 %
  }
}
