// annotation_letter.h: the size of the letters of annotations, for which a fitted camera leaves space.
#ifndef ANNOTATION_LETTER_H
#define ANNOTATION_LETTER_H

// Returns the height of a letter in pixels.
static inline double annotation_letter(int width, int height)
{
    double size = 0.024 * (width < height ? width : height);
    return size > 9 ? size : 9;
}

#endif
