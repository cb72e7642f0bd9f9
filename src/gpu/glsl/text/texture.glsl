// texture.glsl: texels of maps, and filters.

// Texture coordinates, and their derivatives with respect to the window's x and y.
STRUCT(footprint)
{
    vec2 at, dx, dy;
};

// The offsets from the pixel's centre of the centre itself, and of the samples, nearest first.
const vec2 sample_offsets[SAMPLES + 1] = vec2[SAMPLES + 1](SAMPLE_OFFSETS);

vec2 to_point = vec2(0.0); // from the sample to the point that is lit, in pixels
float point_w = 0.0; // 1/w at this point

// Finds the point at which all samples of the triangle in the pixel are lit, as weights_of in
// src/core/cpu/shade/attributes.inc: the pixel's centre or, if it is outside the triangle, the nearest sample inside.
void find_point(vec3 corner_weights, int sample_number)
{
    vec3 own = corner_weights * gl_FragCoord.w;
    vec3 by_x = dFdx(own);
    vec3 by_y = dFdy(own);
    to_point = vec2(0.0);
    vec2 current = sample_offsets[sample_number];
    for (int i = SAMPLES - 1; i >= 0; i--) {
        vec2 to = sample_offsets[i] - current;
        vec3 there = own + (by_x * to.x + by_y * to.y);
        to_point = i < sample_number && min(min(there.x, there.y), there.z) >= 0.0 ? to : to_point;
    }
    point_w = gl_FragCoord.w + (dFdx(gl_FragCoord.w) * to_point.x + dFdy(gl_FragCoord.w) * to_point.y);
}

// The value of a varying at this point. Divided by w, a varying is linear in the window (footprint_of).
#define AT_POINT(v) (((v) * gl_FragCoord.w + (dFdx((v) * gl_FragCoord.w) * to_point.x + dFdy((v) * gl_FragCoord.w) * to_point.y)) / point_w)

// The coordinates divided by w, and 1/w, are linear in the window. Their differences between neighbouring pixels are
// therefore exact derivatives, and the quotient rule gives the derivatives of the coordinates.
footprint footprint_of(vec2 at)
{
    float w = gl_FragCoord.w; // 1/w
    footprint f;
    f.at = POINT_AT;
    f.dx = (dFdx(at * w) - POINT_AT * dFdx(w)) / POINT_W;
    f.dy = (dFdy(at * w) - POINT_AT * dFdy(w)) / POINT_W;
    return f;
}

#define FILTER_LINEAR  0
#define FILTER_NEAREST 1
#define MIP_LINEAR     0
#define MIP_NEAREST    1
#define MIP_NONE       2

// How a value is computed from texels.
STRUCT(sampling)
{
    int wrap_s, wrap_t, magnify, minify, mip, probes;
};

// The shader computes the filters itself, because graphics cards round the weights, mostly to 1/256.
vec4 filtered(sampler2D map, int level, vec2 place, sampling how, int kind)
{
    // The size is computed, because textureSize in Mesa's software renderer uses one fragment's level for several
    // fragments.
    ivec2 size = max(textureSize(map, 0) >> level, 1);
    vec2 at = place * vec2(size);
    if (kind == FILTER_NEAREST) {
        return texelFetch(map, min(ivec2(at), size - 1), level);
    }
    at -= 0.5;
    vec2 corner = floor(at);
    vec2 part = at - corner;
    int x0 = neighbour(int(corner.x), size.x, how.wrap_s);
    int x1 = neighbour(int(corner.x) + 1, size.x, how.wrap_s);
    int y0 = neighbour(int(corner.y), size.y, how.wrap_t);
    int y1 = neighbour(int(corner.y) + 1, size.y, how.wrap_t);
    vec4 a = texelFetch(map, ivec2(x0, y0), level);
    vec4 b = texelFetch(map, ivec2(x1, y0), level);
    vec4 c = texelFetch(map, ivec2(x0, y1), level);
    vec4 d = texelFetch(map, ivec2(x1, y1), level);
    vec4 upper = a + (b - a) * part.x;
    vec4 lower = c + (d - c) * part.x;
    return upper + (lower - upper) * part.y;
}

// The value at a level of detail (OpenGL 4.6, section 8.14). All levels exist, down to one texel.
vec4 texel_at(sampler2D map, vec2 at, float detail, sampling how)
{
    vec2 place = vec2(wrapped(at.x, how.wrap_s), wrapped(at.y, how.wrap_t));
    if (!(detail > 0.0)) {
        return filtered(map, 0, place, how, how.magnify);
    }
    if (how.mip == MIP_NONE) {
        return filtered(map, 0, place, how, how.minify);
    }
    ivec2 size = textureSize(map, 0);
    int last = (floatBitsToInt(float(max(size.x, size.y))) >> 23) - 127; // the integer part of the logarithm to base 2
    if (how.mip == MIP_NEAREST) {
        int nearest = detail >= float(last) ? last : int(ceil(detail + 0.5)) - 1;
        return filtered(map, min(nearest, last), place, how, how.minify);
    }
    if (detail >= float(last)) {
        return filtered(map, last, place, how, how.minify);
    }
    int level = int(floor(detail));
    vec4 finer = filtered(map, level, place, how, how.minify);
    vec4 coarser = filtered(map, level + 1, place, how, how.minify);
    return finer + (coarser - finer) * (detail - float(level));
}

// The directions of the picture's rows and columns on the triangle through p, in eye space; not unit vectors.
void picture_axes(vec3 p, vec4 s, vec4 t, footprint f, out vec3 across, out vec3 down)
{
    float w = gl_FragCoord.w;
    vec3 px = (dFdx(p * w) - POINT_P * dFdx(w)) / POINT_W;
    vec3 py = (dFdy(p * w) - POINT_P * dFdy(w)) / POINT_W;
    vec2 dx = vec2(s.x * f.dx.x + s.y * f.dx.y, t.x * f.dx.x + t.y * f.dx.y);
    vec2 dy = vec2(s.x * f.dy.x + s.y * f.dy.y, t.x * f.dy.x + t.y * f.dy.y);
    float side = dx.x * dy.y - dy.x * dx.y < 0.0 ? -1.0 : 1.0;
    across = (px * dy.y - py * dx.y) * side;
    down = (py * dx.x - px * dy.x) * side;
}

if (anisotropic) {
    // By how much a footprint is longer than a probe. Footprints of which the longer axis is at most 1.25 times the
    // shorter one are filtered like squares.
    float probes_of(float x, float y, int most)
    {
        float ratio = 0.8 * sqrt(max(x, y) / max(min(x, y), 1.0e-30));
        return max(x, y) > 1.0 ? max(min(ratio, float(most)), 1.0) : 1.0;
    }
}

// The level of detail of a map or, if there are several probes, of each probe.
float map_level(sampler2D map, vec4 s, vec4 t, footprint f, int most)
{
    vec2 dx = vec2(s.x * f.dx.x + s.y * f.dx.y, t.x * f.dx.x + t.y * f.dx.y);
    vec2 dy = vec2(s.x * f.dy.x + s.y * f.dy.y, t.x * f.dy.x + t.y * f.dy.y);
    vec2 size = vec2(textureSize(map, 0));
    float x = dot(dx * size, dx * size);
    float y = dot(dy * size, dy * size);
    float longer = max(x, y);
    float level = longer > 1.0e-30 ? 0.5 * log2(min(longer, 1.0e30)) : -50.0;
    if (anisotropic) {
        return most > 1 ? level - log2(probes_of(x, y, most)) : level;
    }
    return level;
}

if (glsl_120) {
    // A texel, filtered by the hardware.
} else {
    // A texel of a map. s and t are rows of the matrix from the mesh's texture coordinates to the picture's.
}
vec4 map_texel(sampler2D map, vec4 s, vec4 t, footprint f, sampling how)
{
    if (glsl_120) {
        return texture2D(map, vec2(dot(s.xyz, vec3(f.at, 1.0)), dot(t.xyz, vec3(f.at, 1.0))));
    } else {
        vec2 at = vec2(s.x * f.at.x + s.y * f.at.y + s.z, t.x * f.at.x + t.y * f.at.y + t.z);
        vec2 dx = vec2(s.x * f.dx.x + s.y * f.dx.y, t.x * f.dx.x + t.y * f.dx.y);
        vec2 dy = vec2(s.x * f.dy.x + s.y * f.dy.y, t.x * f.dy.x + t.y * f.dy.y);
        if (exact_filter) {
            vec2 size = vec2(textureSize(map, 0));
            float x = dot(dx * size, dx * size);
            float y = dot(dy * size, dy * size);
            float longer = max(x, y);
            // Footprints of size zero or of unknown size are magnified.
            float detail = longer > 1.0e-30 ? 0.5 * log2(min(longer, 1.0e30)) : -50.0;
            if (anisotropic) {
                float ratio = how.probes > 1 ? probes_of(x, y, how.probes) : 1.0;
                if (ratio > 1.0) {
                    vec2 axis = x >= y ? dx : dy;
                    vec4 sum = vec4(0.0);
                    for (float i = 0.0; i < ratio; i += 1.0) {
                        float cell = min(ratio - i, 1.0); // the last cell of the axis may be shorter
                        vec2 place = at + axis * ((i + 0.5 * cell) / ratio - 0.5);
                        sum += cell * texel_at(map, place, detail - log2(ratio), how);
                    }
                    return sum / ratio;
                }
            }
            return texel_at(map, at, detail, how);
        } else {
            return textureGrad(map, at, dx, dy);
        }
    }
}
