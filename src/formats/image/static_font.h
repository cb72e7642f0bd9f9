// static_font.h: the caption font embedded in a static program (static_font.py), compressed with zlib.
#ifndef STATIC_FONT_H
#define STATIC_FONT_H

extern const unsigned char static_font[];
extern const unsigned long static_font_size, static_font_packed_size; // bytes

#endif
