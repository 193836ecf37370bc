// What emscripten's GLFW lacks.
mergeInto(LibraryManager.library, {
  glfwGetError: description => 0,
  glfwInitHint: (hint, value) => {},
  glfwGetKeyName: (key, scancode) => 0,  // keys then mean what they type
  glfwSetClipboardString: (window, text) => Module.copyText(UTF8ToString(text)),
  // The page knows whether the mouse is in the window; a drag may leave it.
  glfwGetWindowAttrib: (window, attribute) => attribute === 0x0002000B /* GLFW_HOVERED */ ?
      Module.hovered || GLFW.active.buttons !== 0 : GLFW.active.attributes[attribute],
});
