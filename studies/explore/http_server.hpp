#pragma once

/// HTTP for a browser of this machine. The server's library (cpp-httplib, which brings OpenSSL) is behind a library of
/// ours that the first call loads, as other commands have no use for it.

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <string>

namespace rollres {

struct HttpRequest {
  std::string method, path;                  ///< "GET", "/token/answer"
  std::map<std::string, std::string> query;  ///< decoded; of a name that comes twice the first
  std::string host, origin;                  ///< headers; empty without them
  std::string body;
};

struct HttpReply {
  int status = 200;
  std::string type = "application/json", body = {};
  std::map<std::string, std::string> headers = {};
};

struct HttpServer {
  int port = 0;                                         ///< 0: any that is free
  std::size_t largest_body = 1'000'000;                 ///< a larger one is answered 413 [bytes]
  std::size_t longest_path = 300;                       ///< a longer one is answered 414 [bytes]
  std::function<HttpReply(const HttpRequest&)> answer;  ///< called by many threads; its exceptions become 500
  std::function<void(int port)> listening = {};         ///< called once, when the server can be reached
  const std::atomic<bool>& stop;                        ///< set from outside: return
};

/// Serves 127.0.0.1 until `stop` is set.
/// @throws std::runtime_error if the library cannot be loaded, or nobody may listen at the port
void serve_http(const HttpServer& server);

/// In the library: what serve_http calls. @return whether it could listen
using ServeByHttplib = bool (*)(const HttpServer&);

}  // namespace rollres
