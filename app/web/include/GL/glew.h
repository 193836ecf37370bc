#pragma once
// What the program uses of GLEW, over WebGL 2, which is OpenGL ES 3.0.

#include <GLES3/gl3.h>

enum { GLEW_OK = 0, GLEW_ERROR_NO_GLX_DISPLAY = 4 };
enum { GLEW_VERSION_4_5 = 0, GLEW_ARB_robustness = 0, GLEW_KHR_robustness = 1 };
inline GLboolean glewExperimental = GL_FALSE;
GLenum glewInit();  // in run_loop.cpp
inline const GLubyte* glewGetErrorString(GLenum) { return nullptr; }
GLenum glGetGraphicsResetStatus();  // in run_loop.cpp: an error from a loss of the context until a window is made anew
inline GLenum glGetGraphicsResetStatusARB() { return glGetGraphicsResetStatus(); }
