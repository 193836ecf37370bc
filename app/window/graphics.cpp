#include "app/window/graphics.h"

#include "app/ui/widgets/dock.h"

namespace app::window {

void Graphics::clear() const {
  const ImVec4 colour = ui::dock_colour();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glClearColor(colour.x, colour.y, colour.z, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace app::window
