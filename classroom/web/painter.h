// painter.h: the painter of a check with WebGL 2.
#ifndef PAINTER_H
#define PAINTER_H

#include <lambent/check.h>

extern const lam_check_painter web_painter;

// Returns whether the browser has stopped a shader since the last call. The page's WebGL context is then lost.
bool web_painter_was_stopped(void);

#endif
