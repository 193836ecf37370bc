#include "engine/resources.h"

#include <cstdlib>
#include <string>
#include <system_error>

namespace engine {
namespace fs = std::filesystem;

namespace {

fs::path executable_folder() {
  std::error_code failed;
  const fs::path executable = fs::read_symlink("/proc/self/exe", failed);
  return failed ? fs::path(".") : executable.parent_path();
}

bool is_folder(const fs::path& path) {
  std::error_code failed;
  return fs::is_directory(path, failed);
}

}  // namespace

fs::path find_folder(std::string_view name) {
  if (const char* data = std::getenv("SBCOLLIDE_DATA"); data != nullptr && *data != '\0') {
    // No other folder is tried, because that would hide a mistake in the variable.
    if (fs::path folder = fs::path(data) / name; is_folder(folder)) return folder;
    throw ResourceError("SBCOLLIDE_DATA=" + std::string(data) + " has no folder '" + std::string(name) +
                        "': set it to the folder that holds shaders/ and assets/, or unset it");
  }
  const fs::path here = executable_folder();
  std::string tried;
  for (const fs::path& base : {here, here / SBCOLLIDE_DATA_FROM_PROGRAM}) {
    fs::path folder = (base / name).lexically_normal();
    if (is_folder(folder)) return folder;
    tried += (tried.empty() ? "" : ", ") + folder.string();
  }
  throw ResourceError("cannot find the folder '" + std::string(name) + "' (tried " + tried +
                      "): set SBCOLLIDE_DATA to the folder that holds it");
}

}  // namespace engine
