//@if numbers_triangles

uniform int first_triangle; // number of the draw's first triangle
//@end
//@if depth_ids
//@if peels
uniform usampler2D nearer_depth_ids; // of the previous layer
uniform usampler2D opaque_depth_ids;
//@end
layout(location = 0) out vec4 pixel;
layout(location = 1) out uvec2 depth_id; // bits of the depth, and triangle number + 1; 0: empty
//@if transmits
layout(location = 2) out vec4 through;
//@end
//@elif !glsl_120

out vec4 pixel;
//@end
//@if encoded

// Encodes linear light as sRGB (IEC 61966-2-1).
float encode(float x)
{
    x = saturate(x);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}
//@end

void main()
{
//@if depth_ids
    depth_id = uvec2(floatBitsToUint(gl_FragCoord.z), uint(first_triangle + triangle) + 1u);
//@end
//@if peels
    // At equal depth the lower triangle number is in front.
    uvec2 nearer = texelFetch(nearer_depth_ids, ivec2(gl_FragCoord.xy), 0).xy;
    uvec2 opaque = texelFetch(opaque_depth_ids, ivec2(gl_FragCoord.xy), 0).xy;
    bool peeled = depth_id.x < nearer.x || (depth_id.x == nearer.x && depth_id.y <= nearer.y);
    bool occluded = opaque.y != 0u && (depth_id.x > opaque.x || (depth_id.x == opaque.x && depth_id.y > opaque.y));
    if (peeled || occluded) {
        discard;
    }
//@end
//@if mapped
//@if first_texcoords
    footprint first = footprint_of(surface_texcoord);
//@end
//@if second_texcoords
    footprint second = footprint_of(surface_second_texcoord);
//@end
    surface_maps maps = front_maps(@map_arguments@);
//@if back_material
    if (!gl_FrontFacing) {
        maps = back_maps(@map_arguments@);
    }
//@end
//@end
//@if value_masks
@value_mask@
//@end
//@if output_geometry
//@if depth
    float depth = -eye_position.z; // in front of the eye
    @pixel@ = vec4(depth, depth, depth, 1.0);
//@elif facing
    float side = gl_FrontFacing ? 1.0 : -1.0;
    @pixel@ = vec4(side, side, side, 1.0);
//@elif occlusion
//@if occluded
    float share = texelFetch(ambient_occlusion, ivec2(gl_FragCoord.xy), 0).r;
//@else
    float share = 1.0;
//@end
    @pixel@ = vec4(share, share, share, 1.0);
//@elif ids
    @pixel@ = vec4(float(triangle % 16777216), object, float(triangle / 16777216), 1.0);
//@else
    @pixel@ = vec4(1.0);
//@end
//@elif per_fragment
//@if passes_normal
//@if bends
    // None of the three is made unit after interpolation (MikkTSpace).
    vec3 bitangent = bitangent_sign * cross3(eye_normal, eye_tangent);
    vec3 n = eye_tangent * maps.bend.x + bitangent * maps.bend.y + eye_normal * maps.bend.z;
//@else
    vec3 n = eye_normal;
//@end
//@if coat_normal
//@if coat_bends
    vec3 coat_bitangent = bitangent_sign * cross3(eye_normal, eye_tangent);
    vec3 coat = eye_tangent * maps.coat_bend.x + coat_bitangent * maps.coat_bend.y + eye_normal * maps.coat_bend.z;
//@else
    vec3 coat = eye_normal;
//@end
//@end
//@if tilts
    n = unit3(n);
    n = n - (perpendicular3(maps.across, n) * maps.slopes.x + perpendicular3(maps.down, n) * maps.slopes.y);
//@end
//@if two_sided
    if (!gl_FrontFacing) {
        n = negate3(n);
//@if coat_normal
        coat = negate3(coat);
//@end
    }
//@end
//@end
//@if turns
//@if tangents
    float turn = bitangent_sign;
//@else
    float turn = 1.0;
//@end
//@if two_sided
    if (!gl_FrontFacing) {
        turn = -turn;
    }
//@end
//@end
//@if fragment_shadows
    lit_triangle = first_triangle + triangle;
//@if from_vertices
    lit_corner = 2; // the one that OpenGL takes flat values from
//@end
//@end
//@if apart
    vec3 rest;
//@end
    vec4 light = light_point(@fragment_arguments@);
//@if catches
    // Black, with the share of the light as alpha that does not reach the point.
    const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
    float received = dot(luminance, light.rgb);
    unobstructed = true;
    float all = dot(luminance, light_point(@fragment_arguments@).rgb);
    light = vec4(0.0, 0.0, 0.0, all > received ? light.a * (1.0 - received / all) : 0.0);
//@end
//@else
    vec4 light = front_light;
//@if apart
    vec3 rest = front_rest;
//@end
//@if two_sided
    if (!gl_FrontFacing) {
        light = back_light;
//@if apart
        rest = back_rest;
//@end
    }
//@end
//@end
//@if !output_geometry
//@if apart
    // The diffuse map multiplies the ambient and diffuse light alone.
//@if late_color
    light.rgb = light.rgb * maps.color;
//@end
    light.rgb = light.rgb + rest;
//@if late_emission
    light.rgb = light.rgb + @glow@.rgb * maps.emission;
//@end
//@end
//@if late_opacity
    light.a = light.a * maps.opacity;
//@end
    light.a = saturate(light.a);
//@if alpha_ruled
@alpha_rule@
//@end
//@if transmits
//@if passes
    through = vec4(1.0 - light.a * (1.0 - passing), 1.0);
//@else
    through = vec4(vec3(1.0 - light.a), 1.0);
//@end
//@elif passes_one_alpha
    // One alpha for all channels: what goes through is blended without its colour.
    float solid = 1.0 - dot(passing, vec3(1.0 / 3.0));
    light = vec4(light.rgb / max(solid, 1.0e-3), light.a * solid);
//@end
//@if exposed
    light.rgb = light.rgb * exposure;
//@end
//@if toned
    light.rgb = saturate3(@tone@(tone_input(light.rgb)));
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
