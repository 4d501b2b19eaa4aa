#pragma once

/// Texts of files and of people on a terminal: control characters are shown, not obeyed.

#include <ostream>
#include <streambuf>
#include <string_view>

namespace rollres {

/// Whether a text begins with a control character: one of ASCII's, or of those that UTF-8 writes as C2 80 to C2 9F.
inline bool is_control(std::string_view text) {
  const auto code = [&](std::size_t at) { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0; };
  return !text.empty() && (code(0) < 0x20 || code(0) == 0x7f || (code(0) == 0xc2 && code(1) >= 0x80 && code(1) < 0xa0));
}

/// While it lives, what is written to a stream has its control characters but line breaks and tabs as \xNN. A carriage
/// return and "\x1b[K", which redraw a line of progress, pass if `redrawn`.
class PrintableStream : std::streambuf {
 public:
  PrintableStream(std::ostream& stream, bool redrawn);
  ~PrintableStream() override;
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  int_type overflow(int_type letter) override;
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int sync() override;

  std::ostream& stream_;
  std::streambuf* to_;
  bool redrawn_;
};

}  // namespace rollres
