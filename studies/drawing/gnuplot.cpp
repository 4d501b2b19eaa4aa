#include "studies/drawing/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

extern char** environ;

namespace rollres::gnuplot {

namespace {

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }
bool is_letter(char letter) {  // every byte of a Greek letter counts
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter & 0x80) != 0;
}

/// What gnuplot said last: the lines before it repeat the command.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ' || text.back() == '\r')) text.pop_back();
  const auto start = text.rfind('\n');
  return start == std::string::npos ? text : text.substr(start + 1);
}

struct SpawnActions {
  posix_spawn_file_actions_t actions;
  SpawnActions() { posix_spawn_file_actions_init(&actions); }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
};

/// Reads a descriptor to its end and closes it.
std::string drain(int descriptor) {
  std::string text;
  std::array<char, 4096> part;
  for (;;) {
    const ssize_t count = read(descriptor, part.data(), part.size());
    if (count > 0)
      text.append(part.data(), static_cast<std::size_t>(count));
    else if (count == 0 || errno != EINTR)
      break;
  }
  close(descriptor);
  return text;
}

}  // namespace

std::string quoted(std::string_view text) {
  // gnuplot 5.4 loses its way in several single quotes after one another; between double quotes it would execute what
  // stands in backquotes, unless they are written as numbers.
  const bool apostrophe = text.find('\'') != std::string_view::npos;
  const char quote = apostrophe ? '"' : '\'';
  std::string constant(1, quote);
  for (const char letter : text) {
    if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f)
      constant += ' ';
    else if (apostrophe && letter == '`')
      constant += "\\140";
    else if (apostrophe && letter == '@')
      constant += "\\100";
    else if (apostrophe && (letter == '\\' || letter == '"'))
      constant += {'\\', letter};
    else
      constant += letter;
  }
  return constant + quote;
}

std::string plain(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    if (std::string_view("^_@&~{}\\").find(letter) != std::string_view::npos) escaped += '\\';
    // XML takes these three letters for an end, and gnuplot's SVG has them as they are.
    if (letter == '>' && escaped.ends_with("]]")) escaped += "\u200b";
    escaped += letter;
  }
  return escaped;
}

std::string symbol(std::string_view text) {
  std::string markup;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t start = i;
    const bool after_letter = i > 0 && is_letter(text[i - 1]);
    if (text[i] == ' ') {  // words follow
      markup += plain(text.substr(i));
      break;
    }
    if (is_letter(text[i])) {
      while (i < text.size() && is_letter(text[i])) ++i;
      markup += "{/:Italic " + std::string(text.substr(start, i - start)) + "}";
    } else if (after_letter && text[i] == '_' && i + 1 < text.size()) {
      for (++i; i < text.size() && (is_letter(text[i]) || is_digit(text[i]));) ++i;
      markup += "_{" + std::string(text.substr(start + 1, i - start - 1)) + "}";
    } else if (after_letter && is_digit(text[i])) {
      while (i < text.size() && is_digit(text[i])) ++i;
      markup += "_{" + std::string(text.substr(start, i - start)) + "}";
    } else {
      markup += plain(text.substr(i++, 1));
    }
  }
  return markup;
}

void run(const std::filesystem::path& script, const std::string& program) {
  std::array<int, 2> pipe_ends;
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
    throw std::runtime_error(program + ": cannot be started (" + std::strerror(errno) + ")");

  const std::filesystem::path parent = script.parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  std::string words[] = {program, "--default-settings", "./" + script.filename().string()};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};

  SpawnActions spawn;
  posix_spawn_file_actions_addchdir_np(&spawn.actions, folder.c_str());
  posix_spawn_file_actions_addopen(&spawn.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&spawn.actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&spawn.actions, pipe_ends[1], STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &spawn.actions, nullptr, arguments, environ);
  close(pipe_ends[1]);
  const std::string said = drain(pipe_ends[0]);
  if (error != 0) {
    std::string hint = error == ENOENT ? "; is it installed (Debian: gnuplot-nox)?" : "";
    throw std::runtime_error(program + ": cannot be started (" + std::strerror(error) + ")" + hint);
  }

  int state = 0;
  while (waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return;
  const std::string how = WIFEXITED(state) ? "exit status " + std::to_string(WEXITSTATUS(state))
                                           : "signal " + std::to_string(WTERMSIG(state));
  const std::string why = last_line(said);
  throw std::runtime_error(script.string() + ": " + program + " failed (" + how + ")" +
                           (why.empty() ? "" : ": " + why));
}

}  // namespace rollres::gnuplot
