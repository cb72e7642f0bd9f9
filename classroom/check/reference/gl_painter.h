// gl_painter.h: the painter that draws with OpenGL, which it finds at run time.
#ifndef GL_PAINTER_H
#define GL_PAINTER_H

#include <lambent/check.h>

// `device`: as lam_gl_params.device, used as long as contexts are opened; NULL: the first usable one.
lam_check_painter gl_painter(const char *device);

#endif
