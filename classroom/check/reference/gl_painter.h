// gl_painter.h: the painter that draws with OpenGL, which is loaded at run time.
#ifndef GL_PAINTER_H
#define GL_PAINTER_H

#include <lambent/check.h>

// Returns a painter that uses OpenGL. `device` has the syntax of lam_gl_params.device and must stay valid while
// contexts are opened. NULL selects the first usable device.
lam_check_painter gl_painter(const char *device);

#endif
