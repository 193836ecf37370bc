#include "app/base/piped_program.h"

#include <system_error>

namespace app {

struct PipedProgram::System {};

PipedProgram::PipedProgram(std::vector<std::string>, int) {
  throw std::system_error(std::make_error_code(std::errc::no_such_file_or_directory));
}
PipedProgram::~PipedProgram() = default;
bool PipedProgram::send(std::span<const std::byte>) { return false; }
bool PipedProgram::finish() { return false; }
std::string PipedProgram::last_error_line() const { return {}; }

}  // namespace app
