#include "studies/text/printable.hpp"

#include <string>

namespace rollres {

PrintableStream::PrintableStream(std::ostream& stream, bool redrawn)
    : stream_(stream), to_(stream.rdbuf()), redrawn_(redrawn) {
  const auto state = stream.rdstate();
  stream.rdbuf(this);  // forgets what failed before
  stream.setstate(state);
}

PrintableStream::~PrintableStream() {
  const auto state = stream_.rdstate();
  stream_.rdbuf(to_);
  stream_.setstate(state);
}

int PrintableStream::sync() { return to_ ? to_->pubsync() : -1; }

PrintableStream::int_type PrintableStream::overflow(int_type letter) {
  const char text = traits_type::to_char_type(letter);
  return xsputn(&text, 1) == 1 ? letter : traits_type::eof();
}

std::streamsize PrintableStream::xsputn(const char* text, std::streamsize count) {
  if (!to_) return 0;
  const std::string_view whole(text, static_cast<std::size_t>(count));
  std::string shown;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const auto code = static_cast<unsigned char>(whole[i]);
    const bool control = is_control(whole.substr(i)) && code != '\n' && code != '\t';
    if (!control || (redrawn_ && (code == '\r' || whole.substr(i, 3) == "\x1b[K"))) {
      shown += whole[i];
      continue;
    }
    constexpr const char* digits = "0123456789abcdef";
    const unsigned char byte = code == 0xc2 ? static_cast<unsigned char>(whole[++i]) : code;
    shown += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
  }
  return to_->sputn(shown.data(), static_cast<std::streamsize>(shown.size())) ==
                 static_cast<std::streamsize>(shown.size())
             ? count
             : 0;
}

}  // namespace rollres
