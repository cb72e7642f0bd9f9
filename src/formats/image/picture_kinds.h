// picture_kinds.h: picture formats that Lambent cannot read, so that an error can name them. The columns are the offset,
// the length and the bytes of the magic number, and the name.
#ifndef PICTURE_KINDS_H
#define PICTURE_KINDS_H

#define UNREAD_PICTURES(ROW)                                                                                           \
    ROW(0, 4, "II*\0", "a TIFF picture"), ROW(0, 4, "MM\0*", "a TIFF picture"),                                        \
        ROW(4, 8, "ftypmif1", "a HEIF picture"), ROW(0, 7, "\xabKTX 20", "a KTX 2 picture"),                           \
        ROW(0, 7, "\xabKTX 11", "a KTX picture"), ROW(4, 7, "ftyphei", "a HEIC picture"),                              \
        ROW(4, 4, "JXL ", "a JPEG XL picture"), ROW(0, 2, "\xff\x0a", "a JPEG XL picture"),                            \
        ROW(0, 4, "DDS ", "a DDS picture"), ROW(0, 4, "8BPS", "a Photoshop picture"),                                  \
        ROW(0, 4, "GIF8", "a GIF picture")

#endif
