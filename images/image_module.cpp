#include "images/image_module.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.h"

namespace tessera {
namespace {

std::string module_path(const std::string& given) {
  if (!given.empty()) return given;
  if (const char* named = std::getenv("TESSERA_IMAGE_MODULE"); named && *named) return named;
  std::error_code failure;
  const auto executable = std::filesystem::read_symlink("/proc/self/exe", failure);
  if (failure) throw Error("cannot find tessera_oiio.so: " + failure.message());
  return (executable.parent_path() / "tessera_oiio.so").string();
}

}  // namespace

std::unique_ptr<ImageModule> load_image_module(const std::string& path) {
  // A name without a slash would make dlopen search the system's folders.
  const std::string file = std::filesystem::absolute(module_path(path)).string();
  // Never unloaded: the libraries behind it keep threads and exit handlers.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!library) throw Error(fmt::format("cannot load the image module {}: {}", file, dlerror()));
  const auto make = reinterpret_cast<ImageModuleFactory>(dlsym(library, image_module_entry));
  if (!make)
    throw Error(fmt::format("{} is not an image module of this build: it lacks {}", file,
                            image_module_entry));
  return std::unique_ptr<ImageModule>(make());
}

}  // namespace tessera
