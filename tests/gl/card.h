// card.h: graphics cards need wider bounds than Mesa's software drivers, which compute in floats like the CPU device. Cards round corners
// and the weights of their interpolation to 1/256, and have their own pow and division. `docs/opengl.md` states the bounds.
#ifndef CARD_H
#define CARD_H

#include <stdbool.h>
#include <string.h>

// Whether a driver with this name (lam_device_name, GL_RENDERER) draws on a graphics card.
static inline bool is_card(const char *name) { return !strstr(name, "llvmpipe") && !strstr(name, "softpipe"); }

#endif
