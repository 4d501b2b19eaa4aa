#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "db/rows/result_store.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/study/study.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/study_points.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers master_curve_file, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

constexpr const char* table = R"(# a rubber
frequency [kHz],storage_modulus [MPa],loss_modulus [MPa],note
0.001,3,0.3,slow
1,6,0.9,
1000,30,9,fast
)";

std::string scene_text(const std::string& material) {
  return R"({"radius": 0.02, "layer_thickness": 0.005, "speed": 1, "load": 1e4, )" + material + "}";
}

const std::string curve_scene = scene_text(R"("material": "master_curve", "listed_moduli": "shear",
    "master_curve_file": "rubber.csv")");

std::string refusal_of_table(const std::string& text) {
  const TemporaryDirectory folder;
  folder.write("rubber.csv", text);
  const auto scene = folder.write("scene.json", curve_scene);
  std::string message = message_of([&] { read_scene(scene); });
  const std::string place = folder.path.string() + "/";
  for (auto at = message.find(place); at != std::string::npos; at = message.find(place))
    message.erase(at, place.size());
  return message;
}

}  // namespace

TEST_CASE("a scene file names the table of a strain sweep, in per cent or not, and what it breaks is refused by name",
          "[studies][material]") {
  const std::string rubber = R"("material": "elastic", "static_shear_modulus": 1e6, "strain_sweep_file": "sweep.csv")";
  const auto read = [&](const std::string& text, const std::string& more = {}) {
    const TemporaryDirectory folder;
    folder.write("sweep.csv", text);
    return read_scene(folder.write("scene.json", scene_text(rubber + more)));
  };
  const std::string sweep = "strain [%],storage_modulus [MPa],loss_tangent\n0.1,7.46,0.1\n10,3.15,0.2\n";
  const RollingScene scene = read(sweep);
  CHECK(scene.sweep_strains == std::vector<double>{0.001, 0.1});
  CHECK(scene.sweep_storage_moduli == std::vector<double>{7.46e6, 3.15e6});
  CHECK(scene.sweep_loss_moduli[1] == Approx(0.63e6));
  const auto refusal = [&](const std::string& text, const std::string& more = {}) {
    return message_of([&] { read(text, more); });
  };
  CHECK_THAT(refusal(sweep, R"(, "sweep_strains": [1, 2])"), Contains("is in the strain_sweep_file; give one of them"));
  CHECK_THAT(refusal("strain,storage_modulus [Pa]\n1,2\n"), Contains("loss_modulus"));
  CHECK_THAT(refusal("strian [%],storage_modulus [Pa],loss_modulus [Pa]\n1,2,1\n"), Contains("strian"));
  CHECK_THAT(refusal("strain [%],storage_modulus [Pa],loss_modulus [Pa]\n-1,2,1\n"), Contains("must be > 0"));
  RollingScene falling = scene;
  falling.sweep_strains = {0.1, 0.001};
  CHECK_THAT(check(falling).front(), Contains("sweep_strains[1] = 0.001: must be above the one before"));
}

TEST_CASE("a scene file names the table of its master curve, relative to itself", "[studies][material]") {
  const TemporaryDirectory folder;
  folder.write("rubber.csv", table);
  const RollingScene scene = read_scene(folder.write("scene.json", curve_scene));
  CHECK(scene.material == MaterialModel::master_curve);
  CHECK(scene.frequencies == std::vector<double>{1, 1e3, 1e6});
  CHECK(scene.storage_moduli == std::vector<double>{3e6, 6e6, 30e6});
  CHECK(scene.loss_moduli == std::vector<double>{0.3e6, 0.9e6, 9e6});
  // What was read stands in the scene, so that it needs the table no more.
  CHECK(scene_json(parse_scene(scene_json(scene), "text")) == scene_json(scene));
  const std::string other = folder.write("other.csv", std::string(table) + "2e3,40,10,\n").string();
  CHECK(read_scene(folder / "scene.json", {"master_curve_file=" + other, "listed_moduli=shear"}).frequencies.size() ==
        4);
}

TEST_CASE("a further layer names its table as the first one does, and an override another", "[studies][material]") {
  const TemporaryDirectory folder;
  const std::string shear = "frequency [Hz],G' [MPa],G\" [MPa]\n";
  folder.write("cover.csv", shear + "1,3,0.3\n1e3,6,0.9\n");
  const std::string other = folder.write("other.csv", shear + "1,3,0.3\n1e3,6,0.9\n1e6,30,9\n").string();
  const std::string coated = scene_text(R"("material": "elastic", "static_shear_modulus": 1e9, "coating_layers":
    [{"layer_thickness": 0.002, "material": "master_curve", "master_curve_file": "cover.csv"}])");
  const auto file = folder.write("scene.json", coated);
  const RollingScene scene = read_scene(file);
  REQUIRE(scene.coating_layers.size() == 1);
  CHECK(scene.coating_layers.front().frequencies == std::vector<double>{1, 1e3});
  CHECK(scene.coating_layers.front().storage_moduli == std::vector<double>{3e6, 6e6});
  CHECK(scene_json(parse_scene(scene_json(scene), "text")) == scene_json(scene));
  const auto study =
      folder.write("study.json", R"({"study": "a", "scene": )" + coated + R"(, "axes": {"speed": [1, 2]}})");
  CHECK(points(read_study(study)).back().coating_layers.front().loss_moduli == std::vector<double>{0.3e6, 0.9e6});

  std::filesystem::remove(folder / "cover.csv");
  CHECK(read_scene(file, {"coating_layers[0].master_curve_file=" + other}).coating_layers.front().frequencies.size() ==
        3);
  CHECK_THAT(message_of([&] { read_scene(file); }), Contains("cover.csv"));
  folder.write("cover.csv", shear + "1,3,0.3\n1e3,6,0.9\n");
  CHECK_THAT(message_of([&] { read_scene(file, {"lower_layers[0].master_curve_file=" + other}); }),
             Contains("--set: lower_layers[0]"));
  folder.write("cover.csv", "frequency [Hz],storage_modulus [MPa],loss_modulus [MPa]\n1,3,0.3\n1e3,6,0.9\n");
  CHECK_THAT(message_of([&] { read_scene(file); }), Contains("coating_layers[0].listed_moduli is missing"));
}

TEST_CASE("master_curve_file takes a table of relaxation or of creep where its columns say so", "[studies][material]") {
  const TemporaryDirectory folder;
  const auto read = [&](const std::string& text, const std::vector<std::string>& set = {}) {
    folder.write("rubber.csv", text);
    return read_scene(folder.write("scene.json", scene_text(R"("material": "master_curve",
      "master_curve_file": "rubber.csv")")),
                      set);
  };
  const RollingScene scene = read("t [ms];E(t) [MPa];note\n1;9;\n100;6;\n10000;3;\n");
  CHECK(scene.material == MaterialModel::relaxation_curve);
  CHECK(scene.listed_moduli == ListedModuli::young);
  CHECK(scene.relaxation_times == std::vector<double>{1e-3, 0.1, 10});
  CHECK(scene.relaxation_moduli == std::vector<double>{9e6, 6e6, 3e6});
  CHECK(scene_json(parse_scene(scene_json(scene), "text")) == scene_json(scene));
  // An elastic solid has the reciprocal modulus of its compliance, exactly.
  const RollingScene creep = read("time (s),J(t) (1/MPa)\n1,0.5\n10,0.5\n100,0.5\n");
  CHECK(creep.listed_moduli == ListedModuli::shear);
  for (const double modulus : creep.relaxation_moduli) CHECK(modulus == Approx(2e6));
  CHECK(read("time [s],relaxation modulus [MPa]\n1,2\n10,1\n", {"listed_moduli=young"}).relaxation_moduli.size() == 2);

  const std::string moduli = "frequency [Hz],G' [MPa],G'' [MPa]\n1,2,0.1\n10,3,0.2\n";
  CHECK(read(moduli, {"master_curve_file=" + folder.write("j.csv", "t [s],J(t) [1/Pa]\n1,1e-6\n9,2e-6\n").string()})
            .material == MaterialModel::relaxation_curve);
  CHECK(read(moduli, {"material=relaxation_curve", "master_curve_file=" + (folder / "j.csv").string()})
            .relaxation_times.size() == 2);
}

TEST_CASE("tables of relaxation and creep that cannot be are refused by file, row and rule", "[studies][material]") {
  CHECK(refusal_of_table("time [s],G(t) [MPa]\n1,5\n10,3\n100,3.2\n") ==
        "rubber.csv, line 4: G(t) [MPa] = 3.2: a relaxation modulus must not rise with time, as it does from 3 in line "
        "3");
  CHECK(
      refusal_of_table("time [s],J(t) [1/MPa]\n10,3\n1,5\n") ==
      "rubber.csv, line 2: J(t) [1/MPa] = 3: a creep compliance must not fall with time, as it does from 5 in line 3");
  CHECK(refusal_of_table("time [s],G(t) [MPa]\n0,5\n10,3\n") == "rubber.csv, line 2: time [s] = 0: must be > 0");
  CHECK(refusal_of_table("time [s],J(t) [1/MPa]\n1e-50,3\n1,5\n") ==
        "rubber.csv, line 2: time [s] = 1e-50: must be from 1e-40 to 1e+40 s");
  CHECK(
      refusal_of_table("time [s],G(t) [MPa],J(t) [1/MPa]\n1,5,0.2\n10,3,0.33\n") ==
      "rubber.csv: give G(t) or J(t), not both: each row is of relaxation or of creep; ignore_columns leaves one out");
  CHECK_THAT(refusal_of_table("time [s],G(t) [MPa],storage_modulus [MPa]\n1,5,5\n10,3,3\n"),
             Contains("storage_modulus: unknown column; known are time, relaxation_modulus, creep_compliance, note"));
  CHECK_THAT(refusal_of_table("time [s],E(t) [MPa]\n1,5\n10,3\n"),
             Contains("listed_moduli = \"shear\": the columns of rubber.csv say young"));
}

TEST_CASE("a table of moduli that does not say whether they are of shear or Young's is refused with both choices",
          "[studies][material]") {
  const TemporaryDirectory folder;
  const std::string rows = "1,3,0.3\n1000,6,0.9\n", bare = "frequency [Hz],storage_modulus [MPa],loss_modulus [MPa]\n";
  const auto read = [&](const std::string& heading, const std::string& more = "",
                        const std::vector<std::string>& set = {}) {
    folder.write("rubber.csv", heading + rows);
    return read_scene(folder.write("scene.json", scene_text(R"("material": "master_curve",
      "master_curve_file": "rubber.csv")" + more)),
                      set);
  };
  const auto refusal = [&](const std::string& heading, const std::string& more = "",
                           const std::vector<std::string>& set = {}) {
    return message_of([&] { read(heading, more, set); });
  };
  CHECK_THAT(
      refusal(bare),
      Catch::EndsWith("scene.json: listed_moduli is missing: storage_moduli: of shear or Young's? Say \"shear\" or "
                      "\"young\", or name the column of the table storage_shear_modulus or storage_young_modulus"));
  CHECK(read(bare, R"(, "listed_moduli": "young")").listed_moduli == ListedModuli::young);
  for (const auto& [storage, loss, said] :
       {std::tuple("storage_young_modulus", "loss_young_modulus", ListedModuli::young),
        std::tuple("E'", "E''", ListedModuli::young), std::tuple("E′", "E″", ListedModuli::young),
        std::tuple("E'", "loss_modulus", ListedModuli::young),
        std::tuple("storage_shear_modulus", "loss_shear_modulus", ListedModuli::shear),
        std::tuple("G'", "\"G\"\" [MPa]\"", ListedModuli::shear)}) {
    const std::string unit = std::string_view(loss).ends_with('"') ? "" : " [MPa]";
    const std::string heading = std::string("frequency [Hz],") + storage + " [MPa]," + loss + unit + "\n";
    CAPTURE(heading);
    const RollingScene scene = read(heading);
    CHECK(scene.listed_moduli == said);
    CHECK(scene.storage_moduli == std::vector<double>{3e6, 6e6});
    CHECK(scene.loss_moduli == std::vector<double>{0.3e6, 0.9e6});
    CHECK(read(heading, R"(, "listed_moduli": ")" + std::string(name_of(said)) + '"').listed_moduli == said);
  }
  const std::string young = "frequency [Hz],E' [MPa],E'' [MPa]\n";
  CHECK_THAT(refusal(young, R"(, "listed_moduli": "shear")"),
             Contains("listed_moduli = \"shear\": the columns of rubber.csv say young"));
  CHECK_THAT(refusal("frequency [Hz],E' [MPa],G'' [MPa]\n"),
             Contains("rubber.csv: E' and G'': must both be of shear or both Young's"));
  CHECK_THAT(refusal("frequency [Hz],E' [MPa],storage_modulus [MPa]\n"),
             Contains("give storage_modulus or E', not both"));
  CHECK_THAT(refusal("frequency [Hz],E' [s],E'' [MPa]\n"), Contains("line 2: E' [s]: must have a unit of stress"));
  // What one table says does not hold for another one.
  const std::string other = "master_curve_file=" + folder.write("other.csv", bare + rows).string();
  CHECK_THAT(refusal(young, "", {other}), Contains("listed_moduli is missing"));
  CHECK(read(young, "", {other, "listed_moduli=shear"}).listed_moduli == ListedModuli::shear);
  CHECK(read(bare, R"(, "listed_moduli": "young")", {"load=2e4"}).listed_moduli == ListedModuli::young);
}

TEST_CASE("lists of moduli say what they are unless a shear modulus stands beside them", "[studies][material]") {
  const std::string series = R"("material": "prony", "relaxation_times": [1], "relaxation_moduli": [1e6], )";
  const auto refusal = [&](const std::string& material) {
    return message_of([&] { parse_scene(scene_text(material), "text"); });
  };
  CHECK(refusal(series + R"("static_shear_modulus": 1e6)") == "nothing");
  CHECK(refusal(series + R"("static_young_modulus": 1e6, "listed_moduli": "young")") == "nothing");
  CHECK(refusal(series + R"("static_young_modulus": 1e6)") ==
        "text: listed_moduli is missing: relaxation_moduli beside static_young_modulus: of shear or Young's? Say "
        "\"shear\" or \"young\"");
  const std::string curve = R"("material": "master_curve", "frequencies": [1, 10], "storage_moduli": [1e6, 2e6],
    "loss_moduli": [1e5, 2e5])";
  CHECK_THAT(refusal(curve), Contains("text: listed_moduli is missing: storage_moduli: of shear or Young's?"));
  const std::string rubber = R"("static_shear_modulus": 1e6, "stiffening": 1, "creep_time": 1, "coating_layers": [)";
  CHECK_THAT(refusal(rubber + R"({"layer_thickness": 0.001, )" + curve + "}]"),
             Contains("text: coating_layers[0].listed_moduli is missing: storage_moduli"));
  // What the program writes of such a layer says it, too.
  const RollingScene coated = parse_scene(
      scene_text(rubber + R"({"layer_thickness": 0.001, "listed_moduli": "shear", )" + curve + "}]"), "text");
  CHECK(scene_json(parse_scene(scene_json(coated), "again")) == scene_json(coated));
}

TEST_CASE("angular frequencies of a master curve become frequencies", "[studies][material]") {
  const TemporaryDirectory folder;
  folder.write("rubber.csv",
               "angular_frequency [rad/s],storage_modulus [Pa],loss_modulus [Pa]\n1,2e6,0\n100,3e6,1e5\n");
  const RollingScene scene = read_scene(folder.write("scene.json", curve_scene));
  CHECK(scene.frequencies[1] == Approx(100 / (2 * M_PI)).epsilon(5e-15));  // read to 15 digits
  CHECK(scene.loss_moduli[0] == 0);
}

TEST_CASE("a frequency in rad/s is an angular one, and rotations are refused", "[studies][material]") {
  const TemporaryDirectory folder;
  const auto frequencies = [&](const std::string& heading) {
    folder.write("rubber.csv", heading + ",storage_modulus [Pa],loss_modulus [Pa]\n1.7,2e6,0\n100,3e6,1e5\n");
    return read_scene(folder.write("scene.json", curve_scene)).frequencies;
  };
  const std::vector<double> turns = frequencies("frequency [rad/s]"), right = frequencies("angular_frequency [rad/s]");
  CHECK(turns == right);
  CHECK(frequencies("angular_frequency [krad/s]")[1] == Approx(1e3 * right[1]).epsilon(1e-15));
  CHECK(frequencies("frequency [s-1]") == frequencies("frequency [Hz]"));
  CHECK(
      message_of([&] { frequencies("frequency [rpm]"); })
          .ends_with("rubber.csv, line 2: frequency [rpm]: must have a unit of frequency (Hz) or rad/s, as an angular "
                     "frequency"));
  CHECK(message_of([&] { frequencies("angular_frequency [Hz]"); })
            .ends_with("angular_frequency [Hz]: must have a unit of rotational speed (rad/s), which is 2 π times a "
                       "frequency in Hz"));
}

TEST_CASE("a table in rad/s is to all digits the one in Hz", "[studies][material]") {
  const TemporaryDirectory folder;
  const auto frequencies = [&](const std::string& text) {
    folder.write("rubber.csv", text);
    return read_scene(folder.write("scene.json", curve_scene)).frequencies;
  };
  const std::string moduli = ",storage_modulus [Pa],loss_modulus [Pa]\n", ends = ",2e6,1e5\n";
  std::string hertz = "frequency [Hz]" + moduli, radians = "rad/s]" + moduli;
  for (const double frequency : {4.18e-3, 1.0, 3.7, 1.51e4, 9.89e12}) {
    std::ostringstream turns, angles;
    turns.precision(17), angles.precision(17);
    turns << frequency << ends, angles << 2 * M_PI * frequency << ends;
    hertz += turns.str(), radians += angles.str();
  }
  CHECK(frequencies("frequency [" + radians) == frequencies(hertz));
  CHECK(frequencies("angular_frequency [" + radians) == frequencies(hertz));
}

TEST_CASE("a loss tangent stands for one of the moduli, and columns are left out on request", "[studies][material]") {
  const TemporaryDirectory folder;
  const auto scene_of = [&](const std::string& text, const std::string& more = "") {
    folder.write("rubber.csv", text);
    return read_scene(folder.write("scene.json", scene_text(R"("material": "master_curve", "listed_moduli": "shear",
      "master_curve_file": "rubber.csv")" + more)));
  };
  const RollingScene from_storage = scene_of("frequency [Hz],storage_modulus [MPa],tan_delta\n1,2,0.5\n10,4,0\n");
  CHECK(from_storage.loss_moduli == std::vector<double>{1e6, 0});
  const RollingScene from_loss = scene_of("frequency [Hz],loss_modulus [MPa],loss_tangent\n1,1,0.5\n10,1,0.25\n");
  CHECK(from_loss.storage_moduli == std::vector<double>{2e6, 4e6});
  CHECK(refusal_of_table("frequency [Hz],loss_modulus [MPa],loss_tangent\n1,1,0\n10,1,0.25\n") ==
        "rubber.csv, line 2: loss_tangent = 0: must be > 0");
  CHECK(refusal_of_table("frequency [Hz],tan_delta\n1,1\n10,1\n") == "rubber.csv: has no column loss_modulus");

  const std::string strained = "frequency [Hz],strain [%],storage_modulus [MPa],loss_modulus [MPa]\n1,2,2,1\n9,2,4,1\n";
  CHECK(refusal_of_table(strained) ==
        "rubber.csv: strain: unknown column; known are frequency, angular_frequency, storage_modulus, loss_modulus, "
        "loss_tangent, tan_delta, note; ignore_columns leaves others out");
  CHECK(scene_of(strained, R"(, "ignore_columns": ["strain"])").storage_moduli == std::vector<double>{2e6, 4e6});
  CHECK_THAT(message_of([&] { scene_of(strained, R"(, "ignore_columns": ["stain"])"); }),
             Contains("rubber.csv: ignore_columns: stain: the table has no such column"));
  folder.write("scene.json", scene_text(R"("master_curve_file": "rubber.csv", "ignore_columns": ["strain"])"));
  CHECK_THAT(message_of([&] { read_scene(folder / "scene.json"); }),
             Contains("stiffening is missing: material \"zener\", the default, needs it (a number); "
                      "master_curve_file is given, for material \"master_curve\""));
  CHECK_THAT(message_of([&] { scene_of(strained, R"(, "ignore_columns": "strain")"); }),
             Contains("ignore_columns = \"strain\": must be a list of names"));
}

TEST_CASE("a master curve that is not passive, or no table, is refused with its line", "[studies][material]") {
  const std::string head = "frequency [Hz],storage_modulus [MPa],loss_modulus [MPa]\n1,3,0.3\n";
  CHECK(refusal_of_table(head + "10,4,-0.1\n") ==
        "rubber.csv, line 3: loss_modulus [MPa] = -0.1: must be >= 0: no passive material gives energy back");
  CHECK(refusal_of_table(head + "0,4,0.1\n") ==
        "rubber.csv, line 3: frequency [Hz] = 0: must be from 1e-30 to 1e+30 Hz");
  CHECK(refusal_of_table(head + "1e-310,4,0.1\n") ==
        "rubber.csv, line 3: frequency [Hz] = 1e-310: must be from 1e-30 to 1e+30 Hz");
  CHECK(refusal_of_table(head + "10,,0.1\n").starts_with("rubber.csv, line 3: storage_modulus [MPa]"));
  CHECK(refusal_of_table("frequency [Hz],storage_modulus [MPa]\n1,3\n") == "rubber.csv: has no column loss_modulus");
  CHECK(refusal_of_table("frequency [Hz],storage_modulus [MPa],lossmodulus [MPa]\n1,3,1\n") ==
        "rubber.csv: lossmodulus: unknown column; did you mean loss_modulus?");
  CHECK(refusal_of_table(head) == "rubber.csv: must have rows at two different frequencies at least");
}

TEST_CASE("lists of inputs have units, are overridden whole and cannot vary", "[studies][material]") {
  const std::string text = scene_text(R"("material": "prony", "static_young_modulus": "3 MPa", "listed_moduli": "shear",
    "relaxation_times": ["1 ms", 2], "relaxation_moduli": ["1 MPa", 2e6])");
  const RollingScene scene = parse_scene(text, "text", {"relaxation_times=[1, 0.5]", "poisson_ratio=0.4"});
  CHECK(scene.relaxation_times == std::vector<double>{1, 0.5});
  CHECK(scene.relaxation_moduli == std::vector<double>{1e6, 2e6});
  const auto refusal = [&](const std::string& override_word) {
    return message_of([&] { parse_scene(text, "text", {override_word}); });
  };
  CHECK(refusal("relaxation_times=[1, -1]") == "--set: relaxation_times[1] = -1: must be > 0");
  CHECK(refusal("relaxation_times=[1, 2") == "--set: relaxation_times = \"[1, 2\": must be a list: [1, 2]");
  CHECK(refusal("relaxation_times=1") == "--set: relaxation_times = 1: must be a list of numbers: [1, 2]");
  CHECK(refusal("relaxation_times=[1]") ==
        "text with --set: relaxation_moduli: has 2 values, but relaxation_times has 1");
  CHECK(refusal("relaxation_times=[\"1 m\", 2]") ==
        "--set: relaxation_times[0] = \"1 m\": must have a unit of time (s)");
  CHECK(refusal("static_shear_modulus=1e6") == "nothing");  // takes the place of Young's modulus

  const TemporaryDirectory folder;
  const auto study = folder.write(
      "study.json", R"({"study": "a", "scene": )" + text + R"(, "axes": {"relaxation_times": [[1, 2], [3, 4]]}})");
  CHECK_THAT(message_of([&] { read_study(study); }),
             Contains("a list cannot vary by itself; give each list in a variant"));
}

TEST_CASE("a scene with lists returns from the database bit by bit, and is found again", "[studies][material]") {
  const TemporaryDirectory folder;
  folder.write("rubber.csv", table);
  RollingScene scene = read_scene(folder.write("scene.json", curve_scene));
  scene.frequencies[1] = 0.1 + 0.2;
  scene.temperature = 293.15;
  ResultStore store(folder / "a.db");
  const Evaluation one{evaluation_key(scene), scene, closed_form(scene)};
  store.save({&one, 1});
  const auto found = store.find(evaluation_key(scene));
  REQUIRE(found);
  CHECK(static_cast<const MaterialInputs&>(found->scene) == static_cast<const MaterialInputs&>(scene));
  scene.loss_moduli[2] *= 1.001;
  CHECK_FALSE(store.find(evaluation_key(scene)));
}

TEST_CASE("a study sweeps the temperature of a master curve, and its record needs no other file",
          "[studies][material]") {
  const TemporaryDirectory folder;
  folder.write("rubber.csv", table);
  const std::string text =
      scene_text(R"("material": "master_curve", "listed_moduli": "young", "master_curve_file": "rubber.csv",
    "reference_temperature": "20 degC", "wlf_c1": 4.41, "wlf_c2": "137.64 K")");
  const auto file = folder.write("study.json", R"({"study": "cold", "scene": )" + text +
                                                   R"(, "axes": {"temperature": ["-20 degC", "253 K", "20 °C"]}})");
  const Study study = read_study(file);
  CHECK(study.axes.front().values == std::vector<double>{253.15, 253, 293.15});
  CHECK(points(study).front().frequencies.size() == 3);
  const std::string database = folder / "a.db";
  CHECK(run_rollres({"sweep", file.string(), "--db", database}, closed_form).status == 0);
  std::filesystem::remove(folder / "rubber.csv");
  const ProgramRun out = run_rollres({"export", "--db", database, "--out", (folder / "out").string()}, closed_form);
  CHECK(out.status == 0);
  CHECK(read_study(folder / "out" / "study.json").base.frequencies.size() == 3);
  CHECK(message_of([&] {
          parse_scene(scene_text(R"("static_shear_modulus": 1e6, "stiffening": 1, "creep_time": 1,
    "wlf_c2": "20 degC")"),
                      "text");
        }) == "text: wlf_c2 = \"20 degC\": must have a unit of temperature (K)");
}

TEST_CASE("a scene reads a table of shifts, in either column, and refuses a temperature beyond it",
          "[studies][material]") {
  const TemporaryDirectory folder;
  const auto read = [&](const std::string& shifts, const std::string& temperature) {
    folder.write("shift.csv", shifts);
    return read_scene(folder.write("scene.json", scene_text(R"("static_shear_modulus": 1e6, "stiffening": 1,
      "creep_time": 1, "shift_table_file": "shift.csv", "reference_temperature": "20 degC", "temperature": ")" +
                                                            temperature + "\"")));
  };
  const RollingScene plain = read("temperature [degC],a_T,b_T\n0,100,1.07\n20,1,1\n40,0.02,0.94\n", "0 degC");
  CHECK(plain.shift_temperatures == std::vector<double>{273.15, 293.15, 313.15});
  CHECK(plain.modulus_shifts == std::vector<double>{1.07, 1, 0.94});
  CHECK(read("temperature [K],log10_a_T\n273.15,2\n293.15,0\n", "0 degC").shift_factors == std::vector<double>{100, 1});
  CHECK_THAT(message_of([&] { read("temperature [K],log10_a_T\n273.15,2\n293.15,0\n", "-1.1 degC"); }),
             Catch::Contains("must be within shift_temperatures, 273.15 to 293.15 K"));
  CHECK_THAT(message_of([&] { read("temperature [K]\n273.15\n", "0 degC"); }), Catch::Contains("has no column a_T"));
  CHECK_THAT(message_of([&] { read("temperature [K],a_T\n273.15,-1\n", "0 degC"); }),
             Catch::Contains("a_T = -1: must be > 0"));
}

TEST_CASE("the example of a filled rubber has a peak of rolling resistance that moves with temperature",
          "[studies][examples]") {
  const Study study = read_study(source_directory() / "studies/examples/rubber_speed.json");
  REQUIRE(study.axes.front().key == "temperature");
  std::vector<RollingScene> scenes = points(study);
  CHECK(scenes.size() == 183);
  CHECK(scenes.back().speed / scenes.front().speed == Approx(1e12).epsilon(1e-12));
  CHECK(check(scenes.front()).empty());
  CHECK(solve(scenes[100]).status == Status::converged);
}
