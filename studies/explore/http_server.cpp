#include "studies/explore/http_server.hpp"

#include <dlfcn.h>

#include <stdexcept>

namespace rollres {

void serve_http(const HttpServer& server) {
  void* const library = dlopen("librollres_http.so", RTLD_NOW | RTLD_LOCAL);
  void* const function = library ? dlsym(library, "rollres_serve_by_httplib") : nullptr;
  if (!function)
    throw std::runtime_error(std::string(dlerror()) +
                             ": explore needs this part of rollres; install it beside the program");
  if (!reinterpret_cast<ServeByHttplib>(function)(server))
    throw std::runtime_error("127.0.0.1:" + std::to_string(server.port) +
                             ": cannot listen there; another program may do so: choose another --port");
}

}  // namespace rollres
