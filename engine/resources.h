#pragma once
// Where the files read at run time lie. Needs no graphics: its own target, sbcollide::resources.

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace engine {

/// A folder was not found. what() is one line: the folder, the places tried, and the variable SBCOLLIDE_DATA.
class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The folder `name` ("shaders", "assets"), whatever the working directory: inside $SBCOLLIDE_DATA if that is set, else
/// beside the executable, else in ../share/sbcollide of it, else in the checkout whose build/PRESET/bin it lies in,
/// else in the source folder that it was built from. Throws ResourceError.
std::filesystem::path find_folder(std::string_view name);

}  // namespace engine
