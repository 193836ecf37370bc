#include "app/files/inputs.h"

#include <mutex>
#include <set>
#include <system_error>

#include "app/base/usage_error.h"

namespace app::files {
namespace fs = std::filesystem;
namespace {

std::mutex inputs_mutex;  // guards protected_files
std::set<fs::path> protected_files;

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code missing;
  return fs::equivalent(a, b, missing);
}

}  // namespace

void protect_input(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored) && same_file(file, "/dev/stdout"))
    throw UsageError(file.string() + ": is an input, and standard output goes into it; send that to another file");
  const std::scoped_lock lock(inputs_mutex);
  protected_files.insert(fs::absolute(file));
}

void protect_input(const softbody::MeshSource& mesh) {
  if (mesh.imported) protect_input(mesh.file.path);
}

void protect_inputs(const softbody::Scene& scene) {
  for (const softbody::BodySource& body : scene.bodies) protect_input(body.mesh);
  if (scene.dropper) protect_input(scene.dropper->body.mesh);
}

void require_no_input(const fs::path& output) {
  std::error_code ignored;
  if (!fs::exists(output, ignored)) return;
  const std::scoped_lock lock(inputs_mutex);
  for (const fs::path& input : protected_files)
    if (same_file(output, input))
      throw UsageError(output.string() + ": cannot be written: it is the input " + input.string() +
                       "; name another file or folder");
}

}  // namespace app::files
