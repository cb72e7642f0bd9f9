// wrapping.glsl: wrapping of texture coordinates.

#define WRAP_REPEAT    0
#define WRAP_CLAMP     1
#define WRAP_MIRROR    2

// A texture coordinate after wrapping: a position in the picture, 0...1.
float wrapped(float s, int wrap)
{
    if (!(abs(s) < 2.0e9)) {
        return s >= 2.0e9 && wrap == WRAP_CLAMP ? 1.0 : 0.0;
    }
    if (wrap == WRAP_CLAMP) {
        return clamp(s, 0.0, 1.0);
    }
    float part = s - floor(s);
    return wrap == WRAP_MIRROR && (int(floor(s)) & 1) == 1 ? 1.0 - part : part;
}

// The index of a texel after wrapping; before, it may be one texel outside the picture.
int neighbour(int i, int size, int wrap)
{
    if (wrap == WRAP_REPEAT) {
        return i < 0 ? size - 1 : (i >= size ? 0 : i);
    }
    return clamp(i, 0, size - 1);
}
