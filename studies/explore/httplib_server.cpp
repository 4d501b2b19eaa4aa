// All of ours that needs cpp-httplib, a library by itself (http_server.hpp).

#include <httplib.h>

#include <chrono>
#include <memory>
#include <thread>

#include "studies/explore/http_server.hpp"

namespace rollres {

namespace {

constexpr std::size_t connections = 48;      // at a time; a browser has six
constexpr std::size_t most_of_one = 10'000;  // requests of a connection
constexpr std::time_t longest_silence = 5;   // of a client [s]
constexpr auto glance = std::chrono::milliseconds(50);

HttpRequest request_of(const httplib::Request& asked) {
  HttpRequest request{asked.method, asked.path, {}, asked.get_header_value("Host"), asked.get_header_value("Origin"),
                      asked.body};
  for (const auto& [name, value] : asked.params) request.query.emplace(name, value);
  return request;
}

void answer(const HttpServer& wanted, const httplib::Request& asked, httplib::Response& response) {
  HttpReply reply;
  try {
    reply = wanted.answer(request_of(asked));
  } catch (const std::exception& error) {
    reply = {500, "text/plain", error.what()};
  }
  response.status = reply.status;
  for (const auto& [name, value] : reply.headers) response.set_header(name.c_str(), value);
  // Not set_content: what is given whole the library compresses, for longer than most answers take.
  const auto body = std::make_shared<const std::string>(std::move(reply.body));
  response.set_content_provider(body->size(), reply.type.c_str(),
                                [body](std::size_t from, std::size_t size, httplib::DataSink& sink) {
                                  return sink.write(body->data() + from, size);
                                });
}

}  // namespace

extern "C" __attribute__((visibility("default"))) bool rollres_serve_by_httplib(const HttpServer& wanted) {
  using httplib::Server;
  Server server;
  server.new_task_queue = [] { return new httplib::ThreadPool(connections); };
  server.set_payload_max_length(wanted.largest_body);
  server.set_read_timeout(longest_silence);
  server.set_write_timeout(longest_silence);
  server.set_keep_alive_timeout(longest_silence);
  server.set_keep_alive_max_count(most_of_one);
  server.set_tcp_nodelay(true);
  // Not SO_REUSEPORT, the usual one: two servers would share a port.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_pre_routing_handler([&](const httplib::Request& asked, httplib::Response& response) {
    if (asked.path.size() > wanted.longest_path)
      response.status = 414;
    else if (asked.method == "GET")
      answer(wanted, asked, response);
    else if (asked.method == "POST")
      return Server::HandlerResponse::Unhandled;  // its body has not been read yet
    else
      response.status = 405;
    return Server::HandlerResponse::Handled;
  });
  server.Post(".*",
              [&](const httplib::Request& asked, httplib::Response& response) { answer(wanted, asked, response); });
  const bool bound = wanted.port != 0 && server.bind_to_port("127.0.0.1", wanted.port);
  const int port = wanted.port != 0 ? (bound ? wanted.port : -1) : server.bind_to_any_port("127.0.0.1");
  if (port < 0) return false;
  const std::jthread watch([&](const std::stop_token& ended) {
    while (!ended.stop_requested() && !(wanted.stop && server.is_running())) std::this_thread::sleep_for(glance);
    if (!ended.stop_requested()) server.stop();
  });
  if (wanted.listening) wanted.listening(port);
  server.listen_after_bind();
  return true;
}

}  // namespace rollres
