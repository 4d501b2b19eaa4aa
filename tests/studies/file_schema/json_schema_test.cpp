#include "studies/file_schema/json_schema.hpp"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "studies/fit/fit_keys.hpp"
#include "studies/optimise/design_keys.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/study/study_keys.hpp"
#include "tests/catch.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers schema_parts, file_keys and command_schema, too.

using namespace rollres;

namespace {

std::string schema(const std::string& what) {
  const ProgramRun run = run_rollres({"schema", what}, {});
  CHECK(run.status == 0);
  return run.out;
}

/// Whether Python's jsonschema, a validator that knows nothing of this program, is installed.
bool validator_is_there() { return std::system("python3 -c 'import jsonschema' >/dev/null 2>&1") == 0; }

}  // namespace

TEST_CASE("the schemas that are shipped are those that the program prints", "[studies][schema]") {
  for (const std::string what : {"scene", "study", "fit", "optimisation"})
    CHECK(schema(what) == file_text(source_directory() / ("studies/schema/" + what + ".json")));
  CHECK(schema("keys") == file_text(source_directory() / "studies/keys.md"));
  CHECK(run_rollres({"schema"}, {}).status == 2);
  CHECK(run_rollres({"schema", "fits"}, {}).status == 2);
}

TEST_CASE("the schemas have every key that the readers accept", "[studies][schema]") {
  const Json scene = Json::parse(scene_schema()), study = Json::parse(study_schema());
  for (const InputKind& kind : written_kinds()) {
    const std::string key(kind.quantity.key);
    CAPTURE(key);
    CHECK(scene["properties"].contains(key));
    CHECK(study["properties"]["set"]["properties"].contains(key));
    CHECK(study["properties"]["axes"]["properties"].contains(key) != kind.list);
  }
  CHECK(scene["properties"].size() ==
        written_kinds().size() + 7);  // $schema, comment, master_curve_file, ignore_columns
  for (const FileKey& key : study_keys) CHECK(study["properties"].contains(std::string(key.key)));
  CHECK(study["properties"].size() == study_keys.size());
  const Json fit = Json::parse(fit_schema()), optimisation = Json::parse(optimisation_schema());
  for (const FileKey& key : fit_keys) CHECK(fit["else"]["properties"].contains(std::string(key.key)));
  const Json &material = fit["then"]["else"], &sweep = fit["then"]["then"];
  for (const FileKey& key : material_fit_keys) CHECK(material["properties"].contains(std::string(key.key)));
  for (const FileKey& key : strain_fit_keys) CHECK(sweep["properties"].contains(std::string(key.key)));
  for (const FileKey& key : design_keys) CHECK(optimisation["properties"].contains(std::string(key.key)));
  CHECK(scene["required"] == Json{"layer_thickness", "speed"});  // and one of radius and diameter
}

TEST_CASE("the schemas accept every example and refuse what the readers refuse", "[studies][schema]") {
  if (!validator_is_there()) {
    WARN("skipped: python3-jsonschema is not installed");
    return;
  }
  const TemporaryDirectory folder;
  const auto script = folder.write("validate.py", R"(
import copy, glob, json, sys
from jsonschema import Draft7Validator
folder = sys.argv[1]
valid = {}
for what in ('scene', 'study', 'fit', 'optimisation'):
    schema = json.load(open(folder + '/schema/' + what + '.json'))
    Draft7Validator.check_schema(schema)
    valid[what] = Draft7Validator(schema).is_valid
examples = [json.load(open(name)) for name in sorted(glob.glob(folder + '/examples/*.json'))]
fits = [example for example in examples if 'fit' in example]
optimisations = [example for example in examples if 'variables' in example]
examples = [example for example in examples if 'variables' not in example and 'fit' not in example]
scenes = [example for example in examples if 'study' not in example]
studies = [example for example in examples if 'study' in example]
assert len(scenes) >= 2 and len(studies) >= 3 and len(fits) >= 3 and len(optimisations) >= 1
for kind, files in (('scene', scenes), ('study', studies), ('fit', fits), ('optimisation', optimisations)):
    for file in files:
        assert valid[kind](file), file

def refused(kind, file, change):
    file = copy.deepcopy(file)
    change(file)
    assert not valid[kind](file), (kind, file)

scenes = [scene for scene in scenes if 'creep_time' in scene]
assert len(scenes) >= 2
for scene in scenes:
    refused('scene', scene, lambda s: s.update(sped=1))
    refused('scene', scene, lambda s: s.update(speed=0))
    refused('scene', scene, lambda s: s.update(speed='0.05'))
    refused('scene', scene, lambda s: s.update(method='newtn'))
    refused('scene', scene, lambda s: s.update(approach='1 mm'))
    refused('scene', scene, lambda s: s.update(radius='infinite'))
    refused('scene', scene, lambda s: s.pop('radius'))
    refused('scene', scene, lambda s: s.update(diameter=1))
    assert valid['scene']({**{k: v for k, v in scene.items() if k != 'radius'}, 'diameter': '2 cm'})
    refused('scene', scene, lambda s: s.pop('creep_time'))
    refused('scene', scene, lambda s: s.pop('static_shear_modulus'))
    refused('scene', scene, lambda s: s.update(static_young_modulus=1e6))
    refused('scene', scene, lambda s: s.update(material='prony', relaxation_times=[1]))
    refused('scene', scene, lambda s: s.update(material='prony', relaxation_times=[0], relaxation_moduli=[1]))
    assert valid['scene']({**scene, 'material': 'prony', 'relaxation_times': ['1 ms', 1], 'relaxation_moduli': [1, 2]})
    assert valid['scene']({**scene, 'material': 'master_curve', 'master_curve_file': 'rubber.csv'})
    assert valid['scene']({**scene, 'layer_thickness': 'infinite'})
    assert valid['scene']({**{k: v for k, v in scene.items() if k != 'creep_time'}, 'material': 'elastic'})
for fit in fits:
    refused('fit', fit, lambda f: f.update(los='huber'))
    refused('fit', fit, lambda f: f.update(starts=0))
    refused('fit', fit, lambda f: f.pop('data'))
    if 'material' in fit:
        refused('fit', fit, lambda f: f.update(material='prony series'))
        refused('fit', fit, lambda f: f.update(parameters={'speed': 1}))
        refused('fit', fit, lambda f: f.update(sigma='2 Pa'))
        if fit['material'] == 'kraus':
            assert valid['fit']({**fit, 'sweep_amplitude': 'peak_to_peak', 'sigma': '2 %'})
            refused('fit', fit, lambda f: f.update(terms=3))
            continue
        refused('fit', fit, lambda f: f.update(sweep_amplitude='peak'))
        assert valid['fit']({**fit, 'terms': 'auto', 'shift': 'wlf', 'reference_temperature': '20 degC', 'sigma': '2 %'})
    else:
        refused('fit', fit, lambda f: f.update(loss='hubber'))
        refused('fit', fit, lambda f: f.update(parameters={}))
        refused('fit', fit, lambda f: f.update(parameters={'method': 1}))
        refused('fit', fit, lambda f: f.update(parameters={'speed': {'strt': 1}}))
        refused('fit', fit, lambda f: f.update(output='rolling'))
        assert valid['fit']({**fit, 'data': [{'file': 'a.csv', 'sigma': '2 %', 'set': {'radius': '1 cm'}}, 'b.csv'],
                             'parameters': {'radius': [{'data': 'a'}, {'start': '1 mm', 'fixed': True}]}})
for optimisation in optimisations:
    refused('optimisation', optimisation, lambda o: o.update(minimise='load', maximise='load'))
    refused('optimisation', optimisation, lambda o: (o.pop('minimise', 0), o.pop('maximise', 0)))
    refused('optimisation', optimisation, lambda o: o.update(algorithm='bobika'))
    refused('optimisation', optimisation, lambda o: o.update(variables={'speed': {'from': 1}}))
    refused('optimisation', optimisation, lambda o: o.update(stop={'evaluations': 0}))
    refused('optimisation', optimisation, lambda o: o.update(variables={'speed': []}))
    refused('optimisation', optimisation, lambda o: o.update(variables={'drive': {'from': 1, 'to': 2}}))
    assert valid['optimisation']({**optimisation, 'scenes': [{'set': {'speed': 1}, 'weight': 0.3}],
                                  'pareto': {'maximise': 'load', 'points': 9}, 'over_scenes': 'max'})
zipped = {'run': {'zip': {'speed': [1, '2 m/s'], 'method': ['newton', 'active_set']}}}
for study in studies:
    assert valid['study']({**study, 'axes': zipped, 'fields': True, 'scene': {'radius': '5 mm'}})
    refused('study', study, lambda s: s.update(chrt={}))
    refused('study', study, lambda s: (s.pop('axes', 0), s.pop('sample', 0), s.pop('uncertain', 0)))
    refused('study', study, lambda s: s.update(axes={'sped': [1]}))
    refused('study', study, lambda s: s.update(axes={'speed': []}))
    refused('study', study, lambda s: s.update(axes={'speed': {'from': 1, 'to': 2}}))
    refused('study', study, lambda s: s.update(axes={'method': {'from': 1, 'to': 2, 'points': 3}}))
    refused('study', study, lambda s: s.update(axes={'run': {'zip': {'speed': [1]}}}))
    refused('study', study, lambda s: s.update(sample={'method': 'sobol', 'points': 3}))
    refused('study', study, lambda s: s.update(constraints='speed < 1'))
    refused('study', study, lambda s: s.update(compute=['aproach']))
    refused('study', study, lambda s: s.update(compute=['approach'], chart={'y': 'aproach'}))
    assert valid['study']({**{k: v for k, v in study.items() if k not in ('chart', 'charts')},
                           'compute': ['approach', {'power': 'load * speed'}], 'chart': {'y': 'power'}})
    refused('study', study, lambda s: s.update(compute={'2a': 'load'}))
    refused('study', study, lambda s: s.update(axes={'variant': {'one': {'speed': 1}}}))
    refused('study', study, lambda s: s.update(axes={'variant': {'one': {'speed': 1}, 'two': {'sped': 1}}}))
    refused('study', study, lambda s: s.update(axes={'master_curve_file': ['a.csv']}))
    refused('study', study, lambda s: s.update(chart={}, charts=[{}]))
)");
  const std::string command =
      "python3 '" + script.string() + "' '" + (source_directory() / "studies").string() + "' >/dev/null";
  CHECK(std::system(command.c_str()) == 0);
}
