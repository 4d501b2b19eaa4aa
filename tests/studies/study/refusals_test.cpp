/// Wrong scene and study files: each gets one line that names file, key, value and rule.

#include <algorithm>
#include <stdexcept>

#include "studies/study/study.hpp"
#include "tests/catch.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/study_points.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

/// A file with this text, and the message it deserves behind the file's name.
struct Wrong {
  std::string text, message;
};

/// The paper's cylinder with `more` in it; an input of `more` leaves out the good one.
std::string scene_with(const std::string& more) {
  std::string text;
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{{"radius", "0.02"},
                                                                                   {"layer_thickness", "0.005"},
                                                                                   {"static_shear_modulus", "3e6"},
                                                                                   {"stiffening", "1"},
                                                                                   {"creep_time", "0.25"},
                                                                                   {"speed", "0.05"},
                                                                                   {"load", "2e4"}})
    if (more.find('"' + key + '"') == std::string::npos) text += '"' + key + "\": " + value + ", ";
  return "{" + text + more + "}";
}

std::string scene_without(const std::string& key) {
  std::string text = scene_with("\"friction_coefficient\": 0.2");
  const auto start = text.find('"' + key + '"');
  return text.erase(start, text.find(", ", start) + 2 - start);
}

std::string study_with(const std::string& axes, const std::string& more = "") {
  return R"({"study": "s", "scene": )" + scene_with("\"friction_coefficient\": 0.2") + R"(, "axes": )" + axes + more +
         "}";
}

std::string sampled(const std::string& ranges) {
  return R"(, "sample": {"method": "sobol", "points": 5, "ranges": {)" + ranges + "}}";
}

const std::vector<Wrong> wrong_scenes{
    {scene_with(R"("layer_thicknes": "5 mm")"),
     R"(: layer_thicknes = "5 mm": unknown key; did you mean layer_thickness?)"},
    {scene_with(R"("schema": 1)"), R"(: schema = 1: unknown key; did you mean $schema?)"},
    {scene_with(R"("speed": "5 kg")"), R"(: speed = "5 kg": must have a unit of speed (m/s))"},
    {scene_with(R"("speed": "0.05")"),
     R"(: speed = "0.05": must be a number without quotes, or have a unit of speed (m/s))"},
    {scene_with(R"("speed": "fast")"), R"(: speed = "fast": must be a finite number, or one with a unit)"},
    {scene_with(R"("speed": "nan")"), R"(: speed = "nan": must be a finite number, or one with a unit)"},
    {scene_with(R"("speed": "infinite")"), R"(: speed = "infinite": must be a finite number, or one with a unit)"},
    {scene_with(R"("speed": 0)"), R"(: speed = 0: must be > 0)"},
    {scene_with(R"("speed": true)"), R"(: speed = true: must be a number or a text with a unit of speed (m/s))"},
    {scene_with(R"("speed": null)"), R"(: speed = null: must be a number or a text with a unit of speed (m/s))"},
    {scene_with(R"("speed": [1, 2])"), R"(: speed = [1,2]: must be a number or a text with a unit of speed (m/s))"},
    {scene_with(R"("speed": {"from": 1})"),
     R"(: speed = {"from":1}: must be a number or a text with a unit of speed (m/s))"},
    {scene_with(R"("speed": 1e999)"), R"(: speed: must be a finite number (number overflow parsing '1e999'))"},
    {scene_with(R"("speed": 0.05, "speed": 0.06)"), R"(: speed = 0.06: key given twice)"},
    {scene_with(R"("radius": "-2 cm")"), R"(: radius = "-2 cm": must be > 0)"},
    {scene_with(R"("load": "150 N")"),
     R"(: load = "150 N": must have a unit of force per length (N/m) for a cylinder; give its width too for that of the whole body)"},
    {scene_with(R"("indenter": "ball")"),
     R"(: indenter = "ball": must be one of cylinder, sphere, roller, profile, pressure)"},
    {scene_with(R"("method": "newtn")"),
     R"(: method = "newtn": must be one of automatic, newton, newton_dense, active_set, spectral, finite_strain, convolution; did you mean newton?)"},
    {scene_with(R"("method": 1)"),
     R"(: method = 1: must be one of automatic, newton, newton_dense, active_set, spectral, finite_strain, convolution)"},
    {scene_with(R"("period": 0.2, "series_terms": 1000.5)"), R"(: series_terms = 1000.5: must be a whole number)"},
    {scene_with(R"("series_terms": 1e300)"), R"(: series_terms = 1e+300: must be a whole number)"},
    {scene_with(R"("friction_coefficient": "5 N")"),
     R"(: friction_coefficient = "5 N": must be a number without a unit)"},
    {scene_with(R"("friction_coefficient": -0.2)"), R"(: friction_coefficient = -0.2: must be >= 0)"},
    {scene_with(R"("poisson_ratio": 0.6)"), R"(: poisson_ratio = 0.6: must be from 0 to 0.5)"},
    {scene_with(R"("period": 0.2, "method": "spectral")"), R"(: period = 0.2: not with method "spectral")"},
    {scene_with(R"("comment": 3)"), R"(: comment = 3: must be a text)"},
    {scene_with(R"("approach": "0.3 mm")"), R"(: approach = 0.0003: give load or approach, not both)"},
    {scene_with(R"("spacing": 1e-4, "tolerance": 0.01)"), R"(: tolerance = 0.01: give spacing or tolerance, not both)"},
    {scene_with(R"("drive": "torque")"), R"(: driving_torque is missing: drive "torque" needs it)"},
    {scene_with(R"("rotation_ratio": 1)"), R"(: rotation_ratio = 1: only with drive "rotation")"},
    {scene_without("radius"), R"(: radius is missing: every scene needs it (m))"},
    {scene_without("layer_thickness"), R"(: layer_thickness is missing: every scene needs it (m))"},
    {scene_without("static_shear_modulus"),
     R"(: static_shear_modulus is missing: give static_shear_modulus or static_young_modulus (Pa))"},
    {scene_without("speed"), R"(: speed is missing: every scene needs it (m/s))"},
    {scene_without("load"), R"(: load is missing: give load or approach)"},
    {scene_without("stiffening"), R"(: stiffening is missing: material "zener", the default, needs it (a number))"},
    {scene_without("creep_time"), R"(: creep_time is missing: material "zener", the default, needs it (s))"},
    {"[1, 2]", R"(: [1,2]: must be an object { ... })"},
    {"",
     ": line 1, column 1: syntax error while parsing value - unexpected end of input; expected '[', '{', or a literal"},
    {"{\n  \"radius\": 0.02,\n  \"speed\": NaN\n}",
     ": line 3, column 12: syntax error while parsing value - invalid literal; last read: '\"speed\": N'"},
    {"{\"radius\": 0.02,}", ": line 1, column 17: a comma stands before }, and nothing follows it: leave it out"},
    {"{\"radius\": 0,05}", ": line 1, column 14: 0,05 has a decimal comma: write 0.05"},
    {"{\"relaxation_times\": [1, 2, ]}",
     ": line 1, column 29: a comma stands before ], and nothing follows it: leave it out"},
    {"{“radius”: 0.02}",
     ": line 1, column 2: “ is a quote of typography: names and texts stand between straight ones, \""},
    {"{\"radius\": é}",
     ": line 1, column 12: syntax error while parsing value - invalid literal; last read: '\"radius\": \uFFFD'"},
    {"{\"radius\": 0.02} {}",
     ": line 1, column 18: syntax error while parsing value - unexpected '{'; expected end of input"},
};

const std::vector<Wrong> wrong_studies{
    {R"({"study": "s"})", ": axes is missing: a study needs axes, a sample or uncertain inputs"},
    {R"({"scene": "a.json", "axes": {}})", ": study is missing: must be the name of the study"},
    {R"({"study": 5, "axes": {}})", ": study = 5: must be the name of the study"},
    {R"({"study": "s", "axes": {}})", ": axes = {}: must be an object with at least one input"},
    {R"({"study": "s", "axes": ["speed"]})", ": axes = [\"speed\"]: must be an object with at least one input"},
    {R"({"study": "s", "axes": {"speed": [1]}})", ": scene is missing: must be the name of a scene file, or a scene"},
    {R"({"study": "s", "scene": 3, "axes": {"speed": [1]}})",
     ": scene = 3: must be the name of a scene file, or a scene"},
    {R"({"study": "s", "scene": {"radus": 1}, "axes": {"speed": [1]}})",
     ": scene: radus = 1: unknown key; did you mean radius?"},
    {study_with(R"({"speed": [1]})", R"(, "chrt": {})"), ": chrt = {}: unknown key; did you mean chart?"},
    {study_with(R"({"sped": [1]})"), ": axes: sped = [1]: unknown key; did you mean speed?"},
    {study_with(R"({"speed": []})"), ": axes: speed = []: has no value: leave the axis out, or give it one"},
    {study_with(R"({"speed": 3})"),
     ": axes: speed = 3: must be a list of values, or an object with from, to and points"},
    {study_with(R"({"speed": [1, "2 kg"]})"), ": axes: speed = \"2 kg\": must have a unit of speed (m/s)"},
    {study_with(R"({"speed": [1, -1]})"), ": axes: speed = -1: must be > 0"},
    {study_with(R"({"speed": [1, "100 cm/s"]})"), ": axes: speed = \"100 cm/s\": value given twice"},
    {study_with(R"({"speed": [1], "speed": [2]})"), ": speed = [...]: key given twice"},
    {study_with(R"({"speed": {"from": 1, "to": 2}})"),
     ": axes: speed: points is missing: an interval has from, to and points"},
    {study_with(R"({"speed": {"from": 1, "points": 3}})"),
     ": axes: speed: to is missing: an interval has from, to and points"},
    {study_with(R"({"speed": {"from": 1, "to": 2, "points": 1.5}})"),
     ": axes: speed: points = 1.5: must be a whole number from 2 to 1000000"},
    {study_with(R"({"speed": {"from": 1, "to": 2, "points": 1}})"),
     ": axes: speed: points = 1: must be a whole number from 2 to 1000000"},
    {study_with(R"({"speed": {"from": 1, "to": "2 m", "points": 3}})"),
     ": axes: speed: to: speed = \"2 m\": must have a unit of speed (m/s)"},
    {study_with(R"({"speed": {"from": 1, "to": "100 cm/s", "points": 3}})"),
     ": axes: speed: to = \"100 cm/s\": must differ from \"from\""},
    {study_with(R"({"speed": {"from": 1, "to": 2, "points": 3, "spacing": "log"}})"),
     ": axes: speed: spacing = \"log\": must be one of linear, logarithmic"},
    {study_with(R"({"speed": {"from": 1, "to": 2, "point": 3}})"),
     ": axes: speed: point = 3: unknown key; did you mean points?"},
    {study_with(R"({"friction_coefficient": {"from": 0, "to": 1, "points": 3, "spacing": "logarithmic"}})"),
     ": axes: friction_coefficient: to = 1: logarithmic: both ends must be > 0"},
    {study_with(R"({"layer_thickness": {"from": 1e-3, "to": "infinite", "points": 3}})"),
     ": axes: layer_thickness: to = \"infinite\": the ends must be finite"},
    {study_with(R"({"series_terms": {"from": 10, "to": 11, "points": 3}})"),
     ": axes: series_terms: series_terms = 10.5: must be a whole number; give a list"},
    {study_with(R"({"method": {"from": 1, "to": 2, "points": 3}})"),
     ": axes: method: method = {\"from\":1,\"to\":2,\"points\":3}: must be a list of names"},
    {study_with(R"({"method": ["newton", "euler"]})"),
     ": axes: method = \"euler\": must be one of automatic, newton, newton_dense, active_set, spectral, finite_strain, "
     "convolution"},
    {study_with(R"({"drive": ["free", "torque"]})"),
     ": axes at drive = \"torque\": driving_torque is missing: drive \"torque\" needs it"},
    {study_with(R"({"load": [1], "approach": [1e-3]})"),
     ": axes: load = [1]: cannot be an axis together with approach"},
    {study_with(R"({"skew_angle": ["0 deg", "1 deg"]})", R"(, "set": {"method": "spectral"})"),
     ": axes at skew_angle = 1 deg: skew_angle = 1 deg: only with method \"automatic\", \"newton\" or "
     "\"newton_dense\""},
    {study_with(R"({"approach": [1e-3, 0.03]})"),
     ": axes at approach = 0.03: approach = 0.03: must be less than the radius"},
    {study_with(R"({"speed": {"from": 1, "to": 2, "points": 2000}, "load": {"from": 1, "to": 2, "points": 2000}})"),
     ": axes: make 4000000 points, more than 1000000"},
    {study_with(R"({"speed": [1]})", R"(, "set": {"sped": 1})"), ": set: sped = 1: unknown key; did you mean speed?"},
    {study_with(R"({"speed": [1]})", R"(, "set": {"speed": 1})"), ": set: speed = 1: is an axis of the study too"},
    {study_with(R"({"speed": [1]})", R"(, "set": {"load": "1 N"})"),
     ": set: load = \"1 N\": must have a unit of force per length (N/m) for a cylinder; "
     "give its width too for that of the whole body"},
    {study_with(R"({"speed": [1]})", R"(, "chart": {"colour": 1})"),
     ": chart: colour = 1: unknown key; known are name, x, y, family, map"},
    {study_with(R"({"speed": [1]})", R"(, "chart": {"x": "radius"})"),
     ": chart: x = \"radius\": must be an axis of the study or a number of the solution"},
    {study_with(R"({"speed": [1]})", R"(, "chart": {"y": "rolling_resistence"})"),
     ": chart: y = \"rolling_resistence\": must be a number of the solution; did you mean rolling_resistance?"},
    {study_with(R"({"speed": [1]})", R"(, "chart": {"x": "speed", "family": "speed"})"),
     ": chart: family = \"speed\": must differ from x"},
    {study_with(R"({"speed": [1]})", R"(, "charts": [{"x": "speed"}], "chart": {"x": "speed"})"),
     ": charts = [{\"x\":\"speed\"}]: give chart or charts, not both"},
    {study_with(R"({"speed": [1]})", R"(, "charts": {"x": "speed"})"),
     ": charts = {\"x\":\"speed\"}: must be a list of objects with name, x, y and family"},
    {study_with(R"({"speed": [1]})", R"(, "charts": [{"name": "a"}, {"x": "sped"}])"),
     ": charts: 2: x = \"sped\": must be an axis of the study or a number of the solution; did you mean speed?"},
    {study_with(R"({"speed": [1]})", R"(, "charts": [{"name": "a"}, {"name": "a"}])"),
     ": charts: 2: name = \"a\": name given twice"},
    {study_with(R"({"speed": [1]})", R"(, "charts": [{"name": "2"}])"),
     ": charts: 1: name = \"2\": must be a text, but not \"all\" and no number"},
    {study_with(R"({"speed": [1]})", R"(, "compute": "approach")"),
     ": compute = \"approach\": must be a list of outputs and of objects {name: formula}, or such an object"},
    {study_with(R"({"speed": [1]})", R"(, "compute": ["aproach"])"),
     ": compute = \"aproach\": unknown output; did you mean approach?"},
    {study_with(R"({"speed": [1]})", R"(, "compute": ["approach", "approach"])"),
     ": compute = \"approach\": given twice"},
    {study_with(R"({"speed": [1]})", R"(, "fields": 1)"), ": fields = 1: must be true or false"},
    {study_with(R"({"speed": [1]})", R"(, "$schema": 1)"), ": $schema = 1: must be a text"},
    {study_with(R"({"speed": [1]})", R"(, "constraints": "speed < 1")"),
     ": constraints = \"speed < 1\": must be a list of conditions between inputs"},
    {study_with(R"({"speed": [1]})", R"(, "constraints": ["speed < load", 3])"),
     ": constraints = 3: must be a list of conditions between inputs"},
    {study_with(R"({"speed": [1]})", R"(, "constraints": ["speed + 1"])"),
     ": constraint 1: speed + 1: must be two formulas with one of <= < >= > between them"},
    {study_with(R"({"speed": [1]})", R"(, "constraints": ["load > 0", ""])"),
     ": constraint 2: \"\": must be two formulas with one of <= < >= > between them"},
    {study_with(R"({"speed": [1]})", R"(, "constraints": ["load < "])"),
     ": constraint 1: load <: must be two formulas with one of <= < >= > between them"},
    {study_with(R"({"speed": [1]})", R"(, "constraints": [" >= 3"])"),
     ": constraint 1: >= 3: must be two formulas with one of <= < >= > between them"},
    {study_with(R"({"speed": [1]})", R"(, "constraints": ["peak_pressure < 1"])"),
     ": constraint 1: peak_pressure: peak_pressure is an output; here only inputs are known, before a scene is solved"},
    {study_with(R"({"speed": [1, 2]})", R"(, "constraints": ["speed > 2"])"),
     ": constraints: no point is left of 2: speed > 2 drops 2"},
    {study_with(R"({"speed": [1, 2]})", R"(, "constraints": ["approach < 1 mm"])"),
     ": axes at speed = 1: approach < 1 mm: cannot be decided, a number in it is absent from the scene"},
    {study_with(R"({"layer": {"zip": {"radius": [0.02, 0.03], "speed": [1, 2, 3]}}})"),
     ": axes: layer: zip: speed = [1,2,3]: has 3 values, but radius has 2"},
    {study_with(R"({"layer": {"zip": {"radius": [0.02]}}})"),
     ": axes: layer: zip = {\"radius\":[0.02]}: must be an object of two or more inputs, or of one with columns beside "
     "it"},
    {study_with(R"({"layer": {"zip": {"radius": [0.02], "sped": [1]}}})"),
     ": axes: layer: zip: sped = [1]: unknown key; did you mean speed?"},
    {study_with(R"({"layer": {"zip": {"radius": [0.02], "speed": ["1 kg"]}}})"),
     ": axes: layer: zip: speed = \"1 kg\": must have a unit of speed (m/s)"},
    {study_with(R"({"layer": {"zip": {"radius": [0.02], "speed": [1]}, "points": 3}})"),
     ": axes: layer: points = 3: unknown key; known are zip, columns"},
    {study_with(R"({"speed": {"zip": {"radius": [0.02], "speed": [1]}}})"),
     ": axes: speed: zip = {\"radius\":[0.02],\"speed\":[1]}: the name of a zip must not be that of an "
     "input, \"sample\" or \"uncertain\""},
    {study_with(R"({"layer": {"zip": {"radius": [0.02, 0.02], "speed": [1, 1]}}})"),
     ": axes: layer: zip: radius = 0.02: given twice with the same values of the inputs that vary together with it"},
    {study_with(R"({"speed": [1], "layer": {"zip": {"radius": [0.02], "speed": [1]}}})"),
     ": axes: layer: zip: speed = [1]: varies already"},
    {study_with(R"({"layer": {"zip": {"load": [1], "approach": [1e-3]}}})"),
     ": axes: layer: zip: load = [1]: cannot be an axis together with approach"},
    {study_with(R"({"speed": [1]})", R"(, "sample": 5)"), ": sample: must be an object with method, points and ranges"},
    {study_with(R"({"speed": [1]})", R"(, "sample": {"points": 5})"),
     ": sample: method is missing: must be one of sobol, latin_hypercube"},
    {study_with(R"({"speed": [1]})", R"(, "sample": {"method": "sobel", "points": 5})"),
     ": sample: method = \"sobel\": must be one of sobol, latin_hypercube; did you mean sobol?"},
    {study_with(R"({"speed": [1]})", R"(, "sample": {"method": "sobol", "points": 0})"),
     ": sample: points = 0: must be a whole number from 1 to 1000000"},
    {study_with(R"({"speed": [1]})", R"(, "sample": {"method": "sobol", "points": 5, "seed": -1})"),
     ": sample: seed = -1: must be a whole number >= 0"},
    {study_with(R"({"speed": [1]})", R"(, "sample": {"method": "sobol", "points": 5})"),
     ": sample: ranges is missing: must be an object with at least one input"},
    {study_with(R"({"speed": [1]})", sampled(R"("speed": {"from": 1, "to": 2})")),
     ": sample: ranges: speed = {\"from\":1,\"to\":2}: varies already"},
    {study_with(R"({"speed": [1]})", sampled(R"("radus": {"from": 1, "to": 2})")),
     ": sample: ranges: radus = {\"from\":1,\"to\":2}: unknown key; did you mean radius?"},
    {study_with(R"({"speed": [1]})", sampled(R"("radius": {"from": 1})")),
     ": sample: ranges: radius: to is missing: a range has from and to"},
    {study_with(R"({"speed": [1]})", sampled(R"("radius": {"from": 1, "to": 2, "points": 3})")),
     ": sample: ranges: radius: points = 3: unknown key; known are from, to, spacing"},
    {study_with(R"({"speed": [1]})", sampled(R"("radius": {"from": 0, "to": 2})")),
     ": sample: ranges: radius: from: radius = 0: must be > 0"},
    {study_with(R"({"speed": [1]})",
                sampled(R"("friction_coefficient": {"from": 0, "to": 2, "spacing": "logarithmic"})")),
     ": sample: ranges: friction_coefficient: to = 2: logarithmic: both ends must be > 0"},
    {study_with(R"({"speed": [1]})", sampled(R"("radius": [1, 2])")),
     ": sample: ranges: radius = [1,2]: must be an object with from and to"},
    {study_with(R"({"speed": [1]})", sampled(R"("method": {"from": 1, "to": 2})")),
     ": sample: ranges: method = {\"from\":1,\"to\":2}: must be an input that is a real number; make it an axis"},
};

bool one_line(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n';
}

}  // namespace

TEST_CASE("every wrong scene file is refused in one line, with exit status 2 and no other output",
          "[studies][refusal]") {
  const TemporaryDirectory directory;
  const Evaluate never = [](const RollingScene&) -> RollingSolution { throw std::logic_error("solved a wrong scene"); };
  for (const Wrong& wrong : wrong_scenes) {
    const std::string file = directory.write("scene.json", wrong.text).string();
    const ProgramRun run = run_rollres({"solve", file, "--json"}, never);
    INFO(wrong.text);
    CHECK(run.err == "rollres: " + file + wrong.message + "\n");
    CHECK(run.status == 2);
    CHECK(run.out.empty());
  }
}

TEST_CASE("every wrong override is refused in one line, with exit status 2", "[studies][refusal]") {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", scene_with("\"friction_coefficient\": 0.2")).string();
  const Evaluate never = [](const RollingScene&) -> RollingSolution { throw std::logic_error("solved a wrong scene"); };
  const std::vector<std::pair<std::vector<std::string>, std::string>> overrides{
      {{"sped=3"}, "--set: sped = 3: unknown key; did you mean speed?"},
      {{"speed"}, "--set: speed: must be KEY=VALUE"},
      {{"=3"}, "--set: =3: must be KEY=VALUE"},
      {{"speed="}, "--set: speed = \"\": must be a finite number, or one with a unit"},
      {{"speed=5 kg"}, "--set: speed = \"5 kg\": must have a unit of speed (m/s)"},
      {{"speed=nan"}, "--set: speed = \"nan\": must be a finite number, or one with a unit"},
      {{"speed=-1"}, "--set: speed = -1: must be > 0"},
      {{"speed=1", "speed=2"}, "--set: speed = 2: key given twice"},
      {{"method=secant"},
       "--set: method = \"secant\": must be one of automatic, newton, newton_dense, active_set, spectral, "
       "finite_strain, convolution"},
      {{"drive=torque"}, file + " with --set: driving_torque is missing: drive \"torque\" needs it"},
      {{"spacing=5 mm"}, file + " with --set: spacing = 0.005: must be at most a fifth of the radius"}};
  for (const auto& [words, message] : overrides) {
    std::vector<std::string> command{"solve", file};
    for (const std::string& word : words) command.insert(command.end(), {"--set", word});
    const ProgramRun run = run_rollres(command, never);
    CHECK(run.err == "rollres: " + message + "\n");
    CHECK(run.status == 2);
  }
}

TEST_CASE("every wrong study file is refused in one line as wrong input", "[studies][refusal]") {
  const TemporaryDirectory directory;
  for (const Wrong& wrong : wrong_studies) {
    const auto file = directory.write("study.json", wrong.text);
    INFO(wrong.text);
    CHECK_THROWS_AS(points(read_study(file)), std::invalid_argument);
    CHECK_THROWS_WITH(points(read_study(file)), file.string() + wrong.message);
  }
}

TEST_CASE("whatever bytes a scene file holds, the answer is one line and exit status 2", "[studies][refusal]") {
  const TemporaryDirectory directory;
  const Evaluate never = [](const RollingScene&) -> RollingSolution { throw std::logic_error("solved a wrong scene"); };
  const std::string good = scene_with(R"("spacing": "0.25 mm", "comment": "ok")");
  unsigned random = 12345;
  const auto next = [&random] { return random = random * 1664525U + 1013904223U, random >> 8; };
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::string text = good;
    for (unsigned changes = 1 + next() % 3; changes > 0; --changes)
      text[next() % text.size()] = static_cast<char>(next());
    const std::string file = directory.write("scene.json", text).string();
    const ProgramRun run = run_rollres({"solve", file}, never);
    if (run.err.find("solved a wrong scene") != std::string::npos) continue;  // the change was harmless
    ++refused;
    INFO(text);
    CHECK(one_line(run.err));
    CHECK(run.status == 2);
    CHECK(run.out.empty());
  }
  CHECK(refused > 200);
}
