#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "db/rows/fit_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/fit/fit_comparison.hpp"
#include "studies/fit/fit_record.hpp"
#include "studies/stored_fits/fit_chart.hpp"
#include "studies/stored_fits/stored_comparison.hpp"
#include "studies/stored_fits/stored_fit.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Contains;
using nlohmann::json;

namespace {

/// A fit of a parameter, and another.
FitRecord plain_fit(const std::string& name, double value, double relative_error) {
  FitRecord fit{};
  fit.name = name;
  fit.kind = "resistance";
  fit.definition = "{}";
  fit.status = "GOOD";
  fit.deviations_known = true;
  fit.chi_squared = 12;
  FitParameterRecord time{.name = "creep_time", .unit = "s", .value = value, .standard_error = relative_error * value};
  time.relative_error = relative_error;
  time.linear_lowest = value * std::exp(-1.96 * relative_error);
  time.linear_highest = value * std::exp(1.96 * relative_error);
  fit.parameters = {time};
  for (int i = 1; i <= 12; ++i) fit.data.push_back({"row", 1.0 * i, 0.1, 1.0 * i + 0.1, i == 7 ? 5.0 : 1.0, 0.05});
  return fit;
}

}  // namespace

TEST_CASE("two stored fits agree where their logarithms differ by less than 1.96 of both errors",
          "[studies][fit][compare]") {
  const FitRecord first = plain_fit("a", 1, 0.03);
  // ln 1.09 = 0.0862, sqrt(0.03^2 + 0.04^2) = 0.05
  const StoredComparison close = compare_fits(first, plain_fit("b", 1.09, 0.04));
  REQUIRE(close.parameters.size() == 1);
  CHECK(close.parameters[0].deviations == Approx(std::log(1.09) / 0.05));
  CHECK(close.agree());
  CHECK(close.same_data);
  CHECK(close.within(0.1));
  CHECK_FALSE(close.within(0.08));
  const StoredComparison far = compare_fits(first, plain_fit("b", 1.11, 0.04));
  CHECK_FALSE(far.agree());
  FitRecord other = plain_fit("c", 1, 0.03);
  other.parameters[0].name = "stiffening";
  other.data[3].measured = 77;
  const StoredComparison none = compare_fits(first, other);
  CHECK_FALSE(none.agree());
  CHECK_FALSE(none.same_data);
  CHECK(none.only_first == std::vector<std::string>{"creep_time"});
  CHECK_THAT(stored_comparison_summary(none), Contains("of other data") && Contains("only in c: stiffening"));
}

TEST_CASE("the ellipse of two parameters ends at their limits, as their intervals do", "[studies][fit][chart]") {
  FitRecord fit = plain_fit("a fit", 1, 0.03);
  fit.parameters.push_back({.name = "G_1", .unit = "Pa", .value = 1e6, .standard_error = 1e6});
  FitParameterRecord& modulus = fit.parameters.back();
  modulus.relative_error = 1;
  modulus.lowest = 0;
  fit.correlations.push_back({"creep_time", "G_1", 0.5});
  const auto charts = fit_charts(fit);
  const auto chart = std::find_if(charts.begin(), charts.end(), [](const auto& one) { return one.name == "ellipse"; });
  REQUIRE(chart != charts.end());
  double least = 1, most = 0;
  for (const ChartPoint& point : chart->request.curves.front().points) {
    least = std::min(least, point.y);
    most = std::max(most, point.y);
  }
  CHECK(least == 0);
  CHECK(most > 3);  // [MPa]
}

TEST_CASE("the counts of a fit's evaluations add up", "[studies][fit]") {
  const auto told = [](std::int64_t evaluations, std::int64_t solved, std::int64_t recalled) {
    FitRecord fit = plain_fit("a fit", 1, 0.03);
    fit.evaluations = evaluations;
    fit.solved = solved;
    fit.recalled = recalled;
    fit.failures = 0;
    return fit_statistics(fit).back().second;
  };
  CHECK_THAT(told(1961, 1814, 100), Contains("1961: 1814 scenes solved, 100 recalled, 47 repeated; 0 failed, in "));
  CHECK_THAT(told(15, 3, 12), Contains("15: 3 scenes solved, 12 recalled; 0 failed, in "));
  CHECK_THAT(told(101, 0, 0), Catch::StartsWith("101: 0 failed, in "));  // of a material
}

TEST_CASE("what each value was measured at is stored, drawn and exported", "[studies][fit][chart]") {
  const TemporaryDirectory directory;
  FitRecord fit = plain_fit("a fit", 1, 0.03);
  for (int i = 1; i <= 12; ++i) {
    fit.inputs.push_back({i, "speed", "m/s", 0.1 * i});
    fit.inputs.push_back({i, "load", "N/m", i % 2 == 0 ? 1e4 : 4e4});
    fit.inputs.push_back({i, "radius", "m", 0.1});  // one value for all
    fit.inputs.push_back({i, "temperature", "K", 243.15 + 10 * i});
    fit.data[static_cast<std::size_t>(i - 1)].x = 0.1 * i;
    fit.data[static_cast<std::size_t>(i - 1)].curve = 0;
    fit.curves.push_back({0, "", 0.1 * i, 1.0 * i, 0.1});
  }
  fit.x_name = "speed";
  fit.x_unit = "m/s";
  fit.y_name = "rolling resistance";
  fit.y_unit = "N/m";
  const auto file = directory / "fits.db";
  save_fit(open_database(file, Access::write), fit);
  const FitRecord read = *find_fit(open_database(file, Access::read), "a fit", FitParts::with_data);
  REQUIRE(read.inputs.size() == 48);
  CHECK(read.inputs[5].datum == 2);
  CHECK(read.inputs[5].name == "load");
  CHECK(read.inputs[5].value == 1e4);

  std::vector<std::string> names;
  for (const FitChart& chart : fit_charts(read)) {
    names.push_back(chart.name);
    if (chart.name == "residuals_temperature") {
      CHECK(chart.request.x.unit == "°C");
      CHECK(chart.request.curves.back().points.front().x == Approx(40));  // the outlier's 313.15 K
    }
    if (chart.name != "residuals_load") continue;
    CHECK(chart.request.x.name == "load");
    CHECK(chart.request.curves.back().points.size() == 2);  // the outlier, and a gap
    CHECK(chart.request.curves.back().points.front().y == 5);
  }
  CHECK(names == std::vector<std::string>{"data", "residuals", "residuals_load", "residuals_temperature",
                                          "residuals_fit", "quantiles"});

  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin() + 1, {"--db", file.string()});
    return run_rollres(words, quick_resistance);
  };
  const ProgramRun drawn = run({"chart", "--chart", "residuals_load", "--out", (directory / "picture").string()});
  INFO(drawn.err);
  CHECK(drawn.status == 0);
  CHECK(std::filesystem::file_size(directory / "picture.svg") > 1000);
  CHECK_THAT(run({"chart", "--fit", "a fit", "--chart", "residual"}).err, Contains("residuals"));
  CHECK_THAT(run({"chart", "--fit", "b fit"}).err, Contains("no such fit") && Contains("a fit"));
  CHECK_THAT(run({"chart", "--fit", "a fit", "--x", "load"}).err, Contains("is for studies"));
  CHECK(run({"export", "--out", (directory / "out").string()}).status == 0);
  CHECK_THAT(file_text(directory / "out" / "data.csv"), Contains("band,speed,load,radius,temperature\n"));
  CHECK(run({"compare", "a fit", "a fit"}).status == 0);
  const json same = json::parse(run({"compare", "a fit", "a fit", "--format", "json"}).out);
  CHECK(same["agree"] == true);
  CHECK(same["parameters"][0]["deviations"] == 0);
  CHECK(same["first"]["aicc"].get<double>() == Approx(12 + 2 + 4.0 / 10));
}

TEST_CASE("inputs of measured moduli are their frequencies and temperatures", "[studies][fit]") {
  const MaterialFile file = read_material_fit(source_directory() / "studies/examples/fit_temperatures.json");
  const std::vector<FitInputRecord> inputs = measured_inputs(file);
  REQUIRE(inputs.size() == 4 * file.data.size());
  CHECK(inputs[2].datum == 2);  // the loss modulus of the first row
  CHECK(inputs[2].value == file.data.front().angular_frequency);
  CHECK(inputs.back().name == "temperature");
  CHECK(inputs.back().value == file.data.back().temperature);
}

TEST_CASE("models with fitted noise are compared by their whole likelihood", "[studies][fit][compare]") {
  // One value each, whose noise of 2 and of 1 is fitted: -2 ln L = chi squared + ln variances.
  const auto candidate = [](const std::string& name, double deviation) {
    FitCandidate fit{name, name, "scene"};
    fit.report.status = FitStatus::good;
    fit.report.chi_squared = 6;
    fit.report.noise_terms = {{"noise_level", false, deviation, 0.1}};
    for (int i = 0; i < 6; ++i) fit.report.values.push_back({{10.0 + i, deviation}, 10.0 + i, 1, 0.1});
    return fit;
  };
  const FitComparison compared = compare({candidate("wide", 2), candidate("narrow", 1)});
  CHECK(compared.fits[0].name == "narrow");
  CHECK(compared.fits[0].parameters == 1);
  CHECK(compared.fits[0].likelihood == Approx(6));
  CHECK(compared.fits[1].likelihood == Approx(6 + 12 * std::log(2)));
}
