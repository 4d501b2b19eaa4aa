#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <ostream>

#include "db/file/temporary_folder.hpp"
#include "studies/explore/explorer.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/text/files.hpp"

extern char** environ;

namespace rollres {

namespace {

struct ExploreArguments {
  std::string scene, database;
  int port = 0;
  bool no_browser = false;
};

/// Opens an address in the user's browser. The address holds the token, which must not stand among the words of a
/// process that others can list: the browser is given a file of ours that leads there.
void open_in_browser(const std::string& address, const TemporaryFolder& folder) {
  const std::filesystem::path file = folder / "explore.html";
  write_file(file,
             "<!DOCTYPE html><meta charset=\"utf-8\"><title>rollres explore</title><meta http-equiv=\"refresh\" "
             "content=\"0; url=" +
                 address + "\">\n");
  std::string program = "xdg-open", word = file.string();
  std::array<char*, 3> words{program.data(), word.data(), nullptr};
  pid_t process = 0;
  ::posix_spawnp(&process, words[0], nullptr, nullptr, words.data(),
                 environ);  // where it fails, the address is printed
}

void explore(const ExploreArguments& arguments, Session& session) {
  const StopSignal signal;
  Explorer explorer({.scene = arguments.scene,
                     .database = arguments.database,
                     .folder = std::filesystem::current_path(),
                     .stop = StopSignal::requested()},
                    session.evaluate);
  const TemporaryFolder folder;
  serve_http({.port = arguments.port,
              .answer = [&](const HttpRequest& request) { return explorer(request); },
              .listening =
                  [&](int port) {
                    explorer.be_at(port);
                    const std::string address =
                        "http://127.0.0.1:" + std::to_string(port) + "/" + explorer.token() + "/";
                    session.out << address << std::endl;
                    session.err << "Ctrl-C ends it\n";
                    if (!arguments.no_browser && (std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY")))
                      open_in_browser(address, folder);
                  },
              .stop = StopSignal::requested()});
}

}  // namespace

void add_explore(Command& program, Session& session) {
  const auto [command, arguments] = program.add<ExploreArguments>(
      "explore", "Move a scene by hand on a page in the browser, with its answer and stored studies", session, explore);
  command->add_option("scene SCENE", arguments.scene, "scene file to begin with; left out: the paper's cylinder");
  command->add_option("--db FILE", arguments.database, "database whose studies are shown, and into which studies run")
      ->or_usual_database();
  command->add_option("--port N", arguments.port, "port of this machine; left out: any that is free")
      ->between(1, 65535);
  command->add_flag("--no-browser", arguments.no_browser, "print the address only");
  command->footer(
      "The page is for programs of this machine that know the address, which is new each time. Files are read below "
      "the "
      "folder\nin which it was started, studies written into it. Example: rollres explore "
      "studies/examples/paper_cylinder.json");
}

}  // namespace rollres
