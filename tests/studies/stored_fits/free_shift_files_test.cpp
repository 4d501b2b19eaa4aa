#include "studies/stored_fits/free_shift_files.hpp"

#include <cmath>

#include "core/messages/message_text.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("raw rows at several temperatures are fitted, and the shifts serve as a table",
          "[studies][fit][free_shifts]") {
  const TemporaryDirectory folder;
  const FractionalZener material{1e6, 500, 1e-2, 0.45};
  std::string rows = "frequency [Hz],storage_shear_modulus [MPa],loss_shear_modulus [MPa],temperature [degC]\n";
  for (const double celsius : {0.0, 9.98, 20.03, 30.02})
    for (const double frequency : {0.1, 0.5, 2.0, 10.0, 50.0}) {
      const auto modulus =
          complex_modulus(material, 2 * M_PI * frequency * std::pow(10, -8 * (celsius - 20) / (100 + celsius - 20)));
      rows += message_text<12>(frequency, ",", modulus.real() / 1e6, ",", modulus.imag() / 1e6, ",", celsius, "\n");
    }
  folder.write("raw.csv", rows);
  const auto fit = [&](const std::string& name, const std::string& more) {
    return folder
        .write(name + ".json",
               R"({"fit": ")" + name + R"(", "material": "fractional_zener", "data": "raw.csv", )" + more + "}")
        .string();
  };
  const auto run = [&](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> words{"fit", file, "--db", (folder / "a.db").string(), "--no-profiles"};
    words.insert(words.end(), more.begin(), more.end());
    return run_rollres(words, closed_form);
  };
  const ProgramRun found = run(fit("raw", R"("shift": "free")"),
                               {"--out", (folder / "out").string(), "--scene", (folder / "s.json").string()});
  INFO(found.out << found.err);
  CHECK(found.status == 0);
  CHECK_THAT(found.out, Contains("log10_a_T (0 degC)") && Contains("superposition holds") && Contains("WLF through"));
  const std::string table = file_text(folder / "out" / "shifts.csv");
  CHECK_THAT(table, Contains("temperature [K],log10_a_T [1]\n273.15,"));
  CHECK_THAT(file_text(folder / "out" / "shifts.svg"), Contains("WLF"));
  CHECK_THAT(file_text(folder / "out" / "van_gurp_palmen.svg"),
             Contains("loss angle") && Contains("superposition holds") && Contains("10 °C"));
  CHECK_THAT(found.out, Contains("vertical shifts b_T are left out"));
  CHECK_THAT(file_text(folder / "s.json"), Contains("shift_temperatures") && Contains("shift_factors"));

  const ProgramRun again = run(fit("again", R"("shift_table_file": "out/shifts.csv")"), {});
  INFO(again.out << again.err);
  CHECK(again.status == 0);

  const ProgramRun vertical =
      run(fit("vertical", R"("shift": "free", "vertical_shift": "free")"), {"--out", (folder / "out_b").string()});
  INFO(vertical.out << vertical.err);
  CHECK_THAT(file_text(folder / "out_b" / "shifts.csv"), Contains("temperature [K],log10_a_T [1],b_T [1]\n273.15,"));
  CHECK_THAT(run(fit("idle", R"("shift": "wlf", "vertical_shift": "free")"), {}).err,
             Contains("vertical_shift = \"free\": needs \"shift\": \"free\""));

  CHECK_THAT(run(fit("cold", R"("shift": "free", "reference_temperature": "-20 degC")"), {}).err,
             Contains("reference_temperature = 253.15: must be within shift_temperatures"));
  CHECK_THAT(run(fit("both", R"("shift": "free", "shift_table_file": "out/shifts.csv")"), {}).err,
             Contains("shift = \"free\": has no place beside shift_table_file"));
}
