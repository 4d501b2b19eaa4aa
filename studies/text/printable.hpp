#pragma once

/// Texts of files and of people on a terminal: control characters are shown, not obeyed.

#include <ostream>
#include <streambuf>

namespace rollres {

/// While it lives, what is written to a stream has its control characters as \xNN: all of ASCII's but line breaks and
/// tabs, and those that UTF-8 writes as C2 80 to C2 9F. A carriage return and "\x1b[K", which redraw a line of
/// progress, pass if `redrawn`.
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
