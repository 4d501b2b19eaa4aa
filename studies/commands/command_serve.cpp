#include <unistd.h>

#include <istream>
#include <optional>

#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/run/stored_evaluations.hpp"
#include "studies/serve/descriptor_buffer.hpp"
#include "studies/serve/scene_service.hpp"
#include "studies/serve/unix_socket.hpp"

namespace rollres {

namespace {

struct ServeArguments {
  std::optional<std::string> scene, database, socket;
  int jobs = 0;
};

void serve(const ServeArguments& arguments, Session& session) {
  const ReadScene read = arguments.scene ? replacing_inputs_of(*arguments.scene) : read_whole_scene;
  StoredEvaluations evaluations = arguments.database ? StoredEvaluations(session.evaluate, *arguments.database)
                                                     : StoredEvaluations(session.evaluate);
  SceneService service(evaluations, read, arguments.jobs);
  if (!arguments.socket) {
    DescriptorBuffer input(STDIN_FILENO, service.failed());
    std::istream in(&input);
    return service.serve(in, session.out);
  }
  const StopSignal signal;
  serve_socket(*arguments.socket, StopSignal::requested(),
               [&](std::istream& in, std::ostream& out) { service.serve(in, out); });
}

}  // namespace

void add_serve(Command& program, Session& session) {
  const auto [command, arguments] = program.add<ServeArguments>(
      "serve", "Answer scenes that come as lines of JSON, for programs that ask often", session, serve);
  command->add_option("scene SCENE", arguments.scene,
                      "scene file; a line then replaces inputs of it, as --set does, and is a whole scene otherwise");
  command->add_option("--db FILE", arguments.database,
                      "recall answers that are stored here, store the others before they are written");
  command->add_option("--jobs N", arguments.jobs, "threads; default: one for each core")->between(1, 1024);
  command->add_option("--socket PATH", arguments.socket,
                      "listen at this Unix socket, for several programs at once, until interrupted; default: standard "
                      "input and output, until the input ends");
  command->footer(
      "A line of input is an object with the keys of a scene file and, if wanted, id. Each has a line of output, in "
      "the\n"
      "same order: the id (by default the number of the line) and the outputs, or the id, the line and an error. A "
      "bad\n"
      "line ends nothing.\n"
      "Example: echo '{\"id\": \"a\", \"speed\": \"1 m/s\"}' | rollres serve studies/examples/paper_cylinder.json");
}

}  // namespace rollres
