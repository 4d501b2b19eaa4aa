#include "studies/scene_io/scene_overrides.hpp"

#include "studies/scene_io/scene_file.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

std::vector<SceneEntry> entries_of(const std::string& more) {
  return scene_entries(parse_object(R"({"radius": 0.1, "layer_thickness": 0.01, "static_shear_modulus": 1e6,
    "stiffening": 2, "creep_time": 0.1, "speed": 1, )" +
                                        more + "}",
                                    "scene"),
                       {}, "scene");
}

RollingScene changed(const std::string& base, const Json& overrides, const std::vector<SceneEntry>& taken = {}) {
  return scene_from(overridden(entries_of(base), replacing_entries(overrides, "--set"), taken), "scene");
}

const SceneEntry no_width{"width", nullptr, "--set"};

}  // namespace

TEST_CASE("a load that is a plain number is refused where a width given or taken away would change what it is of",
          "[studies][scene_io][width]") {
  CHECK(message_of([] {
          changed(R"("load": 20000)", {{"width", 0.05}});
        }) == "--set: width = 0.05: load = 20000 was given per metre: give it too, of the whole body");
  CHECK(message_of([] { changed(R"("load": 1000, "width": 0.05)", Json::object(), {no_width}); }) ==
        "--set: width = null: load = 1000 was given of the whole body: give it too, per metre");
  CHECK(changed(R"("load": 1000, "width": 0.05)", {{"load", 20000}}, {no_width}).load == 20000);
  CHECK(changed(R"("load": 1000, "width": 0.05)", {{"width", 0.1}}).load == 1000);  // of the whole body, as it was
  CHECK(changed(R"("load": 20000)", {{"width", 0.05}, {"approach", "1 mm"}}).approach == 1e-3);  // replaces the load
  CHECK(changed(R"("approach": 0.001)", {{"width", 0.05}}).width == 0.05);
}

TEST_CASE("only inputs that may be absent are taken away", "[studies][scene_io]") {
  const std::string base = R"("load": 20000, "tolerance": 1e-3, "coating_layers": [{"layer_thickness": 0.002,
    "static_shear_modulus": 1e6, "stiffening": 1, "creep_time": 1, "temperature": 300, "reference_temperature": 290,
    "wlf_c1": 8, "wlf_c2": 100}])";
  CHECK_FALSE(changed(base, Json::object(), {{"tolerance", nullptr, "--set"}}).tolerance);
  CHECK(changed(base, Json::object(), {{"coating_layers", nullptr, "--set"}}).coating_layers.empty());
  CHECK_FALSE(changed(base, Json::object(), {{"coating_layers[0].temperature", nullptr, "--set"}})
                  .coating_layers[0]
                  .temperature);
  CHECK_THAT(message_of([&] {
               changed(base, Json::object(), {{"speed", nullptr, "--set"}});
             }),
             Contains("--set: speed = null: must be a number"));
  CHECK_THAT(message_of([&] { changed(base, {{"tolerance", nullptr}}); }), Contains("tolerance = null: must be"));
}

TEST_CASE("a table that --set replaces is not read", "[studies][scene_io]") {
  const TemporaryDirectory folder;
  const std::string good = "frequency [Hz],G' [MPa],G'' [MPa]\n0.1,1,0.1\n1,1.2,0.15\n10,1.5,0.2\n100,1.9,0.2\n";
  const auto table = folder.write("good.csv", good);
  folder.write("bad.csv", "frequency [Hz],G' [MPa],G'' [MPa]\n0.1,1\n");
  const auto scene = folder.write("scene.json", R"({"radius": 0.1, "layer_thickness": 0.01, "speed": 1, "load": 20000,
    "material": "master_curve", "master_curve_file": "bad.csv", "ignore_columns": ["tan"]})");
  CHECK_THAT(message_of([&] { read_scene(scene); }), Contains("bad.csv"));
  CHECK(read_scene(scene, {"master_curve_file=" + table.string()}).storage_moduli.size() == 4);
}

TEST_CASE("a table of a soft gel tells the unit of its moduli, and needs no other word", "[studies][scene_io]") {
  const TemporaryDirectory folder;
  folder.write("gel.csv", "frequency [Hz],G' [Pa],G'' [Pa]\n0.1,100,10\n1,120,15\n10,150,20\n100,190,20\n");
  const auto scene = folder.write("scene.json", R"({"radius": 0.1, "layer_thickness": 0.01, "speed": 1, "load": 20,
    "material": "master_curve", "master_curve_file": "gel.csv"})");
  CHECK(read_scene(scene).storage_moduli == std::vector<double>{100, 120, 150, 190});
}
