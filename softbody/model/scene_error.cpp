#include "softbody/model/scene_error.h"

#include <algorithm>
#include <utility>

namespace softbody {
namespace {

std::string without_controls(std::string message) {
  std::ranges::replace_if(
      message, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return message;
}

}  // namespace

SceneError::SceneError(std::string message) : std::runtime_error(without_controls(std::move(message))) {}

}  // namespace softbody
