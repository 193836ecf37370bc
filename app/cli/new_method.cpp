#include <iostream>

#include "app/cli/commands.h"
#include "app/files/output_file.h"

namespace app::cli {

extern const char* const double_loop;  // the example of this name

void new_method(const std::filesystem::path& file) {
  if (file.extension() != ".c" && file.extension() != ".cpp")
    throw UsageError(file.string() + ": the name must end in .c or .cpp, for C or C++");
  if (std::filesystem::exists(std::filesystem::symlink_status(file)))
    throw UsageError(file.string() + ": exists and is not replaced; name a new file");
  files::write_file(file, double_loop);
  std::cout << "wrote " << file.string() << "; see it beside the others: sbcollide --guest " << file.string() << '\n';
}

}  // namespace app::cli
