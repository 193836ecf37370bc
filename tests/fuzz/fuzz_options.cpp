// Arbitrary words as the command line, one a line: they are taken with values in their ranges or refused in one line.

#include <string>

#include "app/cli/options.h"
#include "require.h"

namespace {

using fuzz::require;

/// Words with nothing between them but line ends; none asks for help, which would be printed.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words{"sbcollide"};
  while (!text.empty()) {
    const auto end = text.find('\n');
    std::string word(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    const std::string whole = word.substr(0, word.find('\0'));  // as a program is given it
    const bool short_options = whole.starts_with("-") && !whole.starts_with("--");
    if (whole.starts_with("--help") || whole == "--version" || (short_options && whole.find('h') != whole.npos))
      continue;
    words.push_back(whole);
  }
  return words;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::string> words = words_of({reinterpret_cast<const char*>(data), size});
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  try {
    const auto options = app::cli::parse_options(static_cast<int>(arguments.size()), arguments.data());
    if (!options) return 0;
    require(options->threads >= 1 && options->frames >= 1, "no threads or no frames");
    require(options->frame_time > 0, "a frame that takes no time");
    require(options->integrator.substeps.value_or(1) >= 1, "no substeps");
    require(options->picture_size().x > 0 && options->picture_size().y > 0, "a picture without pixels");
    for (const int frame : options->captures)
      require(frame >= 1 && frame <= options->frames, "a capture beyond the end");
    collide::Settings settings;
    app::cli::apply(options->detection, settings);
    require(collide::problem(settings).empty(), "settings that no detector takes");
  } catch (const app::UsageError& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos, "a refusal of several lines");
  }
  return 0;
}
