#include <unistd.h>

#include <istream>
#include <optional>
#include <stdexcept>

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
  std::optional<std::string> scene, database, socket, files;
  std::string retry = "nothing";
  int jobs = 0;
};

void serve(const ServeArguments& arguments, Session& session) {
  const Retry retry = retry_named(arguments.retry);
  if (arguments.scene && arguments.files)
    throw std::invalid_argument("--files = " + *arguments.files +
                                ": a line that replaces inputs of SCENE names no files");
  if (retry != Retry::nothing && !arguments.database)
    throw std::invalid_argument("--retry = " + arguments.retry + ": needs --db");
  const ReadScene read =
      arguments.scene ? replacing_inputs_of(*arguments.scene) : whole_scenes(arguments.files.value_or(""));
  StoredEvaluations evaluations = arguments.database ? StoredEvaluations(session.evaluate, *arguments.database, retry)
                                                     : StoredEvaluations(session.evaluate);
  SceneService service(evaluations, read, arguments.jobs);
  if (!arguments.socket) {
    DescriptorBuffer input(STDIN_FILENO, service.failed());
    std::istream in(&input);
    return service.serve(in, session.out);
  }
  const StopSignal signal;
  serve_socket(
      *arguments.socket, StopSignal::requested(),
      [&](std::istream& in, std::ostream& out, const std::atomic<bool>& gone) { service.serve(in, out, gone); });
}

}  // namespace

void add_serve(Command& program, Session& session) {
  const auto [command, arguments] = program.add<ServeArguments>(
      "serve", "Answer scenes that come as lines of JSON, for programs that ask often", session, serve);
  command->add_option("scene SCENE", arguments.scene,
                      "scene file; a line then replaces inputs of it, as --set does, and is a whole scene otherwise");
  command->add_option("--db FILE", arguments.database,
                      "recall the answers stored here; store the others before they are written");
  command
      ->add_option("--retry WHICH", arguments.retry,
                   "with --db: solve again what is stored as failed, as not_converged, or all")
      ->one_of({"failed", "not_converged", "all"});
  command->add_option("--files FOLDER", arguments.files,
                      "lines may name files of this folder (master_curve_file, ...); without it, none");
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
