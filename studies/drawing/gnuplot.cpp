#include "studies/drawing/gnuplot.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <vector>

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

/// The environment without what would choose another terminal.
std::vector<char*> environment() {
  std::vector<char*> variables;
  for (char** one = environ; *one; ++one)
    if (!std::string_view(*one).starts_with("GNUTERM=")) variables.push_back(*one);
  variables.push_back(nullptr);
  return variables;
}

/// In the child: becomes the program, which ends with the thread that waits for it, whatever ends that. Writes the
/// system's error where that fails.
[[noreturn]] void become(const char* program, char* const* words, char* const* variables, const char* folder,
                         int output, int failure) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int input = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (::chdir(folder) == 0 && ::dup2(input, STDIN_FILENO) >= 0 && ::dup2(output, STDOUT_FILENO) >= 0 &&
      ::dup2(output, STDERR_FILENO) >= 0)
    ::execvpe(program, words, variables);
  const int error = errno;
  if (::write(failure, &error, sizeof error) < 0) {
  }  // nobody reads it
  ::_exit(127);
}

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
  const auto refuse = [&](int error) {
    const std::string hint = error == ENOENT ? "; is it installed (Debian: gnuplot-nox)?" : "";
    throw std::runtime_error(program + ": cannot be started (" + std::strerror(error) + ")" + hint);
  };
  std::array<int, 2> output, failure;
  if (pipe2(output.data(), O_CLOEXEC) != 0) refuse(errno);
  if (pipe2(failure.data(), O_CLOEXEC) != 0) {
    const int error = errno;
    close(output[0]);
    close(output[1]);
    refuse(error);
  }
  const std::filesystem::path parent = script.parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  std::string words[] = {program, "--default-settings", "./" + script.filename().string()};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  const std::vector<char*> variables = environment();
  const pid_t child = ::_Fork();
  if (child == 0) become(program.c_str(), arguments, variables.data(), folder.c_str(), output[1], failure[1]);
  int error = child < 0 ? errno : 0;
  close(output[1]);
  close(failure[1]);
  const std::string said = drain(output[0]), told = drain(failure[0]);
  if (told.size() == sizeof error) std::memcpy(&error, told.data(), sizeof error);

  int state = 0;
  while (child > 0 && waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
  if (error != 0) refuse(error);
  if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return;
  const std::string how = WIFEXITED(state) ? "exit status " + std::to_string(WEXITSTATUS(state))
                                           : "signal " + std::to_string(WTERMSIG(state));
  const std::string why = last_line(said);
  throw std::runtime_error(script.string() + ": " + program + " failed (" + how + ")" +
                           (why.empty() ? "" : ": " + why));
}

}  // namespace rollres::gnuplot
