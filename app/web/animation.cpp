#include "app/render/animation.h"

#include "app/base/usage_error.h"

struct WebPMux {};

namespace app::render {

Animation::Animation(std::filesystem::path file) : out_(file), mux_(nullptr, nullptr) {
  throw UsageError("a page writes no animations");
}
void Animation::add(engine::Image, double) {}
void Animation::write(double) {}

}  // namespace app::render
