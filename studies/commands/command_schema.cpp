#include <ostream>

#include "studies/file_schema/json_schema.hpp"
#include "studies/program/commands.hpp"

namespace rollres {

namespace {

void schema(const std::string& what, Session& session) {
  session.out << (what == "scene"   ? scene_schema()
                  : what == "study" ? study_schema()
                  : what == "fit"   ? fit_schema()
                                    : optimisation_schema());
}

}  // namespace

void add_schema(Command& program, Session& session) {
  const auto [command, what] =
      program.add<std::string>("schema", "Print the JSON schema of a kind of files, for editors", session, schema);
  command->add_option("what KIND", what, "scene, study, fit or optimisation")
      ->required()
      ->one_of({"scene", "study", "fit", "optimisation"});
  command->footer(
      "An editor that knows JSON schemas completes and checks a file that begins with\n"
      "{\"$schema\": \"../schema/study.json\", ...}, where that is the output of this command, kept beside it.\n"
      "Example: rollres schema study > study.schema.json");
}

}  // namespace rollres
