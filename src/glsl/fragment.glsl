//@if places

uniform int first_triangle; // the number of the draw's first triangle
//@if peels
uniform usampler2D nearer_places; // of the layer in front
uniform usampler2D opaque_places;
//@end
layout(location = 0) out vec4 pixel;
layout(location = 1) out uvec2 place; // the depth's bits, and the triangle's number + 1; 0: nothing is there
//@elif !old

out vec4 pixel;
//@end
//@if encoded

// Linear light to the numbers of a screen (sRGB, IEC 61966-2-1).
float encode(float x)
{
    x = saturate(x);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}
//@end

void main()
{
//@if places
    place = uvec2(floatBitsToUint(gl_FragCoord.z), uint(first_triangle + triangle) + 1u);
//@end
//@if peels
    // Of equal depths the lower number is in front.
    uvec2 nearer = texelFetch(nearer_places, ivec2(gl_FragCoord.xy), 0).xy;
    uvec2 opaque = texelFetch(opaque_places, ivec2(gl_FragCoord.xy), 0).xy;
    bool peeled = place.x < nearer.x || (place.x == nearer.x && place.y <= nearer.y);
    bool hidden = opaque.y != 0u && (place.x > opaque.x || (place.x == opaque.x && place.y > opaque.y));
    if (peeled || hidden) {
        discard;
    }
//@end
//@if shows_place
//@if depth
    float depth = -eye_position.z; // in front of the eye
    @pixel@ = vec4(depth, depth, depth, 1.0);
//@elif facing
    float side = gl_FrontFacing ? 1.0 : -1.0;
    @pixel@ = vec4(side, side, side, 1.0);
//@elif ids
    @pixel@ = vec4(float(triangle % 16777216), object, float(triangle / 16777216), 1.0);
//@else
    @pixel@ = vec4(1.0);
//@end
//@elif per_fragment
//@if passes_normal
    vec3 n = eye_normal;
//@if two_sided
    if (!gl_FrontFacing) {
        n = negate3(n);
    }
//@end
//@end
    vec4 light = light_point(@fragment_arguments@);
//@else
    vec4 light = front_light;
//@if two_sided
    if (!gl_FrontFacing) {
        light = back_light;
    }
//@end
//@end
//@if !shows_place
    light.a = saturate(light.a);
//@if exposes
    light.rgb = light.rgb * exposure;
//@end
//@if encoded
    @pixel@ = vec4(encode(light.r), encode(light.g), encode(light.b), light.a);
//@elif premultiplied
    @pixel@ = vec4(light.rgb * light.a, light.a);
//@else
    @pixel@ = light;
//@end
//@end
}
