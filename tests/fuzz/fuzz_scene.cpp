// Arbitrary text as a scene file: it is read or refused in one line, and what is read is within the limits.

#include "softbody/scene/scene.h"
#include "text_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::TextFile text(".toml");
  const std::filesystem::path& file = text.write(data, size);
  try {
    const softbody::Scene scene = softbody::load_scene(file);
    if (const std::string wrong = collide::problem(scene.collision); !wrong.empty()) {
      std::fprintf(stderr, "read, but %s\n", wrong.c_str());
      std::abort();
    }
  } catch (const softbody::SceneError& error) {
    fuzz::require_one_line(error.what(), file);
  }
  return 0;
}
