#include "rays/ray_module.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.h"

namespace tessera {
namespace {

std::string module_path() {
  if (const char* named = std::getenv("TESSERA_EMBREE_MODULE"); named && *named) {
    // A name without a slash would make dlopen search the system's folders.
    return std::filesystem::absolute(named).string();
  }
  std::error_code failure;
  const auto executable = std::filesystem::read_symlink("/proc/self/exe", failure);
  if (failure) throw Error("cannot find tessera_embree.so: " + failure.message());
  return (executable.parent_path() / "tessera_embree.so").string();
}

}  // namespace

std::unique_ptr<RayTracer> make_module_ray_tracer(RayScene&& scene) {
  const std::string file = module_path();
  // Never unloaded: the libraries behind it keep threads and exit handlers.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!library) throw Error(fmt::format("cannot load the ray module {}: {}", file, dlerror()));
  const auto make = reinterpret_cast<RayTracerFactory>(dlsym(library, ray_module_entry));
  if (!make)
    throw Error(
        fmt::format("{} is not a ray module of this build: it lacks {}", file, ray_module_entry));
  return std::unique_ptr<RayTracer>(make(std::move(scene)));
}

}  // namespace tessera
