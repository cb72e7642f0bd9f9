// explain_words.h: returns the names that the command line uses for the values of an explanation.
#ifndef EXPLAIN_WORDS_H
#define EXPLAIN_WORDS_H

#include <lambent/device.h>
#include <lambent/light.h>

static inline const char *shading_word(lam_shading shading)
{
    return shading == LAM_SHADING_PHONG ? "phong" : shading == LAM_SHADING_GOURAUD ? "gouraud" : "flat";
}

static inline const char *light_frame_word(lam_light_frame frame)
{
    static const char *const words[] = {[LAM_FRAME_WORLD] = "world",
                                        [LAM_FRAME_CAMERA] = "camera",
                                        [LAM_FRAME_OBJECT] = "object",
                                        [LAM_FRAME_MODEL] = "model",
                                        [LAM_FRAME_VIEW] = "view"};
    return words[frame];
}

#endif
