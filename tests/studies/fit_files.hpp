#pragma once

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/fitting/measured_hunter.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

/// A fit file, its table, and a database, in a directory of their own.
struct FitFiles {
  TemporaryDirectory directory;
  std::string table = "load [kN/m],speed [cm/s],rolling_resistance [N/m],sigma [%]\n";

  explicit FitFiles(double noise = 0.02) {
    for (const rollres::MeasuredScene& row :
         measured(quick_resistance, spread_speeds(0.005, 5, 8), {1e4, 4e4}, noise)) {
      std::ostringstream line;
      line << *row.scene.load / 1e3 << ',' << row.scene.speed * 100 << ',' << row.measured.value << ',' << 100 * noise
           << '\n';
      table += line.str();
    }
  }

  std::string database() const { return (directory / "fit.db").string(); }
  ProgramRun run(const nlohmann::json& fit, std::vector<std::string> more = {}) const {
    directory.write("table.csv", table);
    std::vector<std::string> words{"fit", directory.write("fit.json", fit.dump()).string(), "--db", database()};
    words.insert(words.end(), more.begin(), more.end());
    return run_rollres(words, quick_resistance);
  }
};
