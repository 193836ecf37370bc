#pragma once
// Finds the files that are read at run time. Needs no graphics; a target of its own: sbcollide::resources.

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace engine {

/// A folder is missing. what() is one line: the folder, where it was searched, and the variable SBCOLLIDE_DATA.
struct ResourceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Finds the folder `name` ("shaders", "assets"), from any working directory. If $SBCOLLIDE_DATA is set, the folder
/// must be there. Otherwise it must be in the folder of the executable, as in a build folder, which has links
/// to those of the checkout, or in ../share/sbcollide beside that, as where the program is installed. Throws
/// ResourceError.
std::filesystem::path find_folder(std::string_view name);

}  // namespace engine
