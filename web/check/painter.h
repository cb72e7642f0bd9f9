// painter.h: WebGL 2 as the painter of a check.
#ifndef PAINTER_H
#define PAINTER_H

#include <lambent/check.h>

extern const lam_check_painter web_painter;

// Whether the browser has stopped a shader since the last call, and the page's WebGL is lost.
bool web_painter_was_stopped(void);

#endif
