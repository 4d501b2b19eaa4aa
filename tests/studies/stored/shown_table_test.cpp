#include "studies/stored/shown_table.hpp"

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

ShownColumns columns_of_names(const std::vector<std::string>& names, Indenter body) {
  ShownColumns columns;
  for (const std::string& name : names) columns.quantities.push_back(find_quantity_column(name));
  columns.bodies = {body};
  return columns;
}

}  // namespace

TEST_CASE("a column has one unit with a prefix in its heading, five digits, and temperatures in degrees Celsius",
          "[studies][stored][shown_table]") {
  const Table table{{"load", "speed", "temperature", "friction_coefficient"},
                    {{2e4, 1e-3, 253.15, 1.0 / 3}, {12345.678, 0.0123456, 293.15, Cell()}}};
  const ShownColumns columns = columns_of_names(table.columns, Indenter::cylinder);
  const Table shown = shown_table(table, columns, ShownUnits::scaled);
  CHECK(shown.columns ==
        std::vector<std::string>{"load [kN/m]", "speed [mm/s]", "temperature [°C]", "friction_coefficient"});
  CHECK(shown.rows[0] == std::vector<Cell>{20.0, 1.0, -20.0, 0.33333});
  CHECK(shown.rows[1] == std::vector<Cell>{12.346, 12.346, 20.0, Cell()});
  const Table si = shown_table(table, columns, ShownUnits::si);
  CHECK(si.columns[0] == "load [N/m]");
  CHECK(si.columns[2] == "temperature [K]");
  CHECK(si.rows == table.rows);
}

TEST_CASE("where cylinders stand beside spheres each cell has its own unit", "[studies][stored][shown_table]") {
  const Table table{{"load", "indenter"}, {{2e4, "cylinder"}, {30.0, "sphere"}}};
  ShownColumns columns{{find_quantity_column("load"), nullptr}, {Indenter::cylinder, Indenter::sphere}};
  const Table shown = shown_table(table, columns, ShownUnits::scaled);
  CHECK(shown.columns[0] == "load");
  CHECK(shown.rows[0][0] == Cell("20 kN/m"));
  CHECK(shown.rows[1][0] == Cell("30 N"));
  columns.bodies = {std::nullopt};
  CHECK(shown_table(table, columns, ShownUnits::scaled).columns[0] == "load [N/m or N]");
}

TEST_CASE("columns are dropped, the last named first, until the lines fit", "[studies][stored][shown_table]") {
  Table table{{"id", "speed [m/s]", "load [kN/m]", "status"}, {{std::int64_t{1}, 1.0, 2.0, "converged"}}};
  CHECK(fit_to_width(table, 60, {"speed", "load"}).empty());
  CHECK(fit_to_width(table, 30, {"speed", "load"}) == std::vector<std::string>{"load"});
  CHECK(table.columns == std::vector<std::string>{"id", "speed [m/s]", "status"});
  CHECK(table.rows[0].size() == 3);
}

TEST_CASE("a query shows by itself what varies, and a value copied from its table finds its row",
          "[studies][stored][shown_table]") {
  const TemporaryDirectory folder;
  const std::string database = folder / "a.db";
  const std::string study =
      folder
          .write("study.json", R"({"study": "warm", "scene": {"radius": 0.1, "layer_thickness": 0.01,
    "static_shear_modulus": 1e6, "stiffening": 2, "creep_time": 0.1, "speed": 0.0031748, "load": "10 kN/m", "wlf_c1": 9,
    "wlf_c2": "200 K", "reference_temperature": "20 degC"},
    "axes": {"temperature": ["-20 degC", "40 degC"], "layer_thickness": [0.0031747999, 0.01]}})")
          .string();
  REQUIRE(run_rollres({"sweep", study, "--db", database}, closed_form).status == 0);
  const auto query = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"query", "--db", database});
    return run_rollres(words, closed_form).out;
  };
  const std::string all = query({});
  CHECK_THAT(all, Contains("layer_thickness [mm]  temperature [°C]  rolling_resistance [mN/m]"));
  CHECK_THAT(all, Contains("3.1748               -20"));
  CHECK_THAT(all, !Contains("speed") && !Contains("load") && !Contains("indenter"));
  CHECK_THAT(query({"--format", "markdown"}), Contains("| temperature [°C] |"));
  CHECK_THAT(query({"--format", "csv"}), Contains("253.15"));
  CHECK_THAT(query({"--si"}), Contains("layer_thickness [m]  temperature [K]") && Contains("253.15"));
  CHECK_THAT(query({"layer_thickness=3.1748 mm", "--aggregate", "count", "--format", "csv"}), Contains("count\n2\n"));
  CHECK_THAT(query({"--by", "temperature", "--aggregate", "mean layer_thickness, stddev temperature, count"}),
             Contains("temperature [°C]  mean_layer_thickness [mm]") && Contains("-20") && Contains("6.5874"));
  const std::string shown = run_rollres({"show", "warm", "--db", database}, closed_form).out;
  CHECK_THAT(shown, Contains("temperature [°C]  layer_thickness [mm]") && Contains("in all points: ") &&
                        Contains("load = 10 kN/m"));
  const std::string solved = run_rollres({"show", "1", "--db", database}, closed_form).out;
  CHECK_THAT(solved, Contains("-20 °C") && !Contains("253.15"));
}

TEST_CASE("a weighted sum has the unit of its column times that of its weight", "[studies][stored][shown_table]") {
  const TemporaryDirectory folder;
  const std::string database = folder / "a.db";
  const auto study =
      folder.write("study.json",
                   R"({"study": "duty", "scene": {"radius": 0.1, "layer_thickness": 0.01, "static_shear_modulus": 1e6,
        "stiffening": 2, "creep_time": 0.1, "speed": 1, "load": 10000}, "axes": {"speed": [1, 2]},
        "compute": [{"share": "speed < 1.5 ? 0.25 : 0.75"}]})");
  REQUIRE(run_rollres({"sweep", study.string(), "--db", database}, closed_form).status == ExitStatus::answered);
  const auto heading = [&](const std::string& aggregate) {
    return run_rollres({"query", "--db", database, "study=duty", "--aggregate", aggregate}, closed_form).out;
  };
  CHECK_THAT(heading("sum rolling_resistance weighted share"), Contains("sum_rolling_resistance_weighted [N/m]"));
  CHECK_THAT(heading("sum rolling_resistance weighted speed"), Contains("sum_rolling_resistance_weighted [W/m]"));
  CHECK_THAT(heading("mean rolling_resistance weighted share"), Contains("mean_rolling_resistance_weighted [N/m]"));
}
