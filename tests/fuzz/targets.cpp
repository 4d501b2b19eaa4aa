#include "tests/fuzz/targets.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "db/file/temporary_folder.hpp"
#include "db/merge/merge.hpp"
#include "db/queries/query.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/fit/fit_file.hpp"
#include "studies/fit/material_file.hpp"
#include "studies/fit/shift_file.hpp"
#include "studies/fit/strain_file.hpp"
#include "studies/optimise/design_file.hpp"
#include "studies/scene_io/formula.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/serve/scene_service.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/study/study.hpp"
#include "studies/text/files.hpp"
#include "studies/text/measured_table.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/units.hpp"
#include "tests/fuzz/random_scenes.hpp"
#include "tests/plain_scene.hpp"

namespace rollres {

namespace {

/// A folder with what the files under test name: scene.json, data.csv, moduli.csv, shifts.csv.
const std::filesystem::path& folder() {
  static const TemporaryFolder scratch;
  static const std::filesystem::path path = [] {
    std::ofstream(scratch / "scene.json")
        << R"({"indenter":"cylinder","radius":0.02,"layer_thickness":0.005,"static_shear_modulus":3e6,"stiffening":1,)"
           R"("creep_time":0.25,"speed":0.05,"load":2e4,"friction_coefficient":0.2})";
    std::ofstream(scratch / "data.csv") << "speed [km/h],rolling_resistance [N/m]\n1,20\n2,30\n5,40\n";
    std::ofstream(scratch / "moduli.csv")
        << "frequency [Hz],temperature [degC],storage_shear_modulus [MPa],loss_shear_modulus "
           "[MPa]\n1,0,2,0.2\n10,0,3,0.5\n1,20,1,0.1\n";
    std::ofstream(scratch / "shifts.csv") << "temperature [degC],a_T\n0,30\n10,5\n20,1\n30,0.2\n";
    return (scratch / "scene.json").parent_path();
  }();
  return path;
}

std::filesystem::path written(const char* name, std::string_view bytes) {
  std::ofstream(folder() / name, std::ios::binary) << bytes;
  return folder() / name;
}

/// Calls the parts one by one: what one refuses, the next may take.
template <class... Parts>
void each(const Parts&... parts) {
  const auto one = [](const auto& part) {
    try {
      part();
    } catch (const std::invalid_argument&) {
    } catch (const std::runtime_error&) {
    }
  };
  (one(parts), ...);
}

void read_scene_bytes(std::string_view bytes) { parse_scene(bytes, "scene"); }

void read_study_bytes(std::string_view bytes) {
  const auto file = written("study.json", bytes);
  each([&] { StudyPlan(read_study(file)).keys(); }, [&] { read_design_problems(file); });
}

void read_fit_bytes(std::string_view bytes) {
  const auto file = written("fit.json", bytes);
  each([&] { read_fit(file); }, [&] { read_material_fit(file); }, [&] { read_shift_fit(file); },
       [&] { read_strain_fit(file); });
}

/// A line of `rollres serve`.
void read_line_bytes(std::string_view bytes) {
  static const ReadScene read = replacing_inputs_of((folder() / "scene.json").string());
  const Json line = parse_object(bytes, "line 1");
  each([&] { read(line, "line 1"); }, [&] { whole_scenes()(line, "line 1"); });
}

void read_csv_bytes(std::string_view bytes) {
  const auto file = written("table.csv", bytes);
  each([&] { read_master_curve(file); },
       [&] {
         const MeasuredTable table = read_measured_table(file);
         for (const MeasuredColumn& column : table.columns)
           for (std::size_t row = 0; row < table.rows(); ++row)
             each([&] { measured_number(table, column, row, "m/s"); });
       });
}

void read_filter_bytes(std::string_view bytes) {
  static ResultStore store = [] {
    ResultStore filled(folder() / "filters.db");
    const RollingScene scene = plain_scene(1.0);
    const Evaluation one{evaluation_key(scene), scene, closed_form(scene)};
    filled.save({&one, 1});
    return filled;
  }();
  const std::string text(bytes);
  each([&] { run_query(store.database(), {.filters = {read_filter(text)}}); },
       [&] { run_query(store.database(), {.filters = {parse_filter(text)}, .columns = {text}, .sort = {text}}); },
       [&] { run_group_query(store.database(), {.aggregates = {parse_aggregate(text)}, .by = {"method"}}); });
}

void read_formula_bytes(std::string_view bytes) {
  const std::string text(bytes);
  const RollingScene scene = plain_scene(1.0);
  each([&] { Formula(text, FormulaNames::inputs_and_outputs)(scene, closed_form(scene)); },
       [&] { Condition(text, FormulaNames::inputs, Indenter::cylinder).holds(scene); });
}

void read_unit_bytes(std::string_view bytes) {
  each([&] { si_value(bytes, "m"); }, [&] { si_value(bytes, "N/m"); }, [&] { kelvin(bytes); },
       [&] { plain_number(bytes); });
}

void read_database_bytes(std::string_view bytes) {
  const auto forget = [](const char* name) {
    for (const char* suffix : {"", "-wal", "-shm", "-journal"})
      std::filesystem::remove(folder() / (std::string(name) + suffix));
  };
  for (const Access access : {Access::read, Access::write}) {
    forget("fuzzed.db");
    const auto file = written("fuzzed.db", bytes);
    each([&] {
      ResultStore store(file, access);
      each([&] { run_query(store.database(), {}); },
           [&] {
             for (const std::string& name : store.study_names())
               each([&] { store.study(name); }, [&] { store.failures(name); },
                    [&] {
                      for (const std::string& key : store.points(name)) store.find(key), store.find_fields(key);
                    });
           });
    });
  }
  forget("merged.db");
  each([&] { merge(open_database(folder() / "merged.db", Access::write), folder() / "fuzzed.db"); });
}

/// A scene is read and solved, within little time and memory.
void solve_scene_bytes(std::string_view bytes) {
  RollingScene scene = parse_scene(bytes, "scene");
  scene.time_limit = std::min(scene.time_limit.value_or(2), 2.0);
  scene.memory_limit = std::min(scene.memory_limit.value_or(5e8), 5e8);
  if (const std::string wrong = what_is_wrong(scene, solve(scene)); !wrong.empty()) throw std::logic_error(wrong);
}

constexpr std::array<FuzzTarget, 10> all{{{"scene", read_scene_bytes},
                                          {"study", read_study_bytes},
                                          {"fit", read_fit_bytes},
                                          {"csv", read_csv_bytes},
                                          {"filter", read_filter_bytes},
                                          {"formula", read_formula_bytes},
                                          {"unit", read_unit_bytes},
                                          {"database", read_database_bytes},
                                          {"line", read_line_bytes},
                                          {"solve", solve_scene_bytes}}};

}  // namespace

std::span<const FuzzTarget> fuzz_targets() { return all; }

void try_reading(const FuzzTarget& target, std::string_view bytes) {
  each([&] { target.read(bytes); });
}

}  // namespace rollres
