//@if depth_ids shadows

uniform int first_triangle; // number of the draw's first triangle
//@end
//@if depth_ids
//@if peels
uniform usampler2D nearer_depth_ids; // of the previous layer
uniform usampler2D opaque_depth_ids;
//@end
layout(location = 0) out vec4 pixel;
layout(location = 1) out uvec2 depth_id; // bits of the depth, and triangle number + 1; 0: empty
//@if writes_transmittance
layout(location = 2) out vec4 through;
//@end
//@elif !glsl_120

out vec4 pixel;
//@end
//@if encodes

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
//@if has_maps
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
//@if output_depth
    float depth = -eye_position.z; // in front of the eye
    @pixel@ = vec4(depth, depth, depth, 1.0);
//@elif output_facing
    float side = gl_FrontFacing ? 1.0 : -1.0;
    @pixel@ = vec4(side, side, side, 1.0);
//@elif output_occlusion
//@if occluded
    float share = texelFetch(ambient_occlusion, ivec2(gl_FragCoord.xy), 0).r;
//@else
    float share = 1.0;
//@end
    @pixel@ = vec4(share, share, share, 1.0);
//@elif output_ids
    @pixel@ = vec4(float(triangle % 16777216), object, float(triangle / 16777216), 1.0);
//@else
    @pixel@ = vec4(1.0);
//@end
//@elif per_fragment
//@if needs_normal
//@if has_normal_map
    vec3 bitangent = bitangent_sign * cross3(eye_normal, eye_tangent);
    vec3 n = mapped_normal(maps.normal, eye_tangent, bitangent, eye_normal);
//@else
    vec3 n = eye_normal;
//@end
//@if has_coat_normal
//@if has_coat_normal_map
    vec3 coat_bitangent = bitangent_sign * cross3(eye_normal, eye_tangent);
    vec3 coat = mapped_normal(maps.coat_normal, eye_tangent, coat_bitangent, eye_normal);
//@else
    vec3 coat = eye_normal;
//@end
//@end
//@if has_bump_map
    n = bumped_normal(unit3(n), maps.across, maps.down, maps.slopes.x, maps.slopes.y);
//@end
//@if two_sided
    if (!gl_FrontFacing) {
        n = negate3(n);
//@if has_coat_normal
        coat = negate3(coat);
//@end
    }
//@end
//@end
//@if has_anisotropy
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
//@if shadows
    lit_triangle = first_triangle + triangle;
//@if from_vertices
    lit_corner = 2; // the one that OpenGL takes flat values from
//@end
//@end
//@if separate_texture_terms
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
//@if separate_texture_terms
    vec3 rest = front_rest;
//@end
//@if two_sided
    if (!gl_FrontFacing) {
        light = back_light;
//@if separate_texture_terms
        rest = back_rest;
//@end
    }
//@end
//@end
//@if !output_geometry
//@if separate_texture_terms
    // The diffuse map multiplies the ambient and diffuse light alone.
//@if color_map_last
    light.rgb = light.rgb * maps.color;
//@end
    light.rgb = light.rgb + rest;
//@if emission_map_last
    light.rgb = light.rgb + @glow@.rgb * maps.emission;
//@end
//@end
//@if opacity_map_last
    light.a = light.a * maps.opacity;
//@end
    light.a = saturate(light.a);
@alpha_rule@
//@if writes_transmittance
//@if has_transmission
    through = vec4(1.0 - light.a * (1.0 - passing), 1.0);
//@else
    through = vec4(vec3(1.0 - light.a), 1.0);
//@end
//@elif blends_transmission
    // One alpha for all channels: what goes through is blended without its colour.
    float solid = 1.0 - dot(passing, vec3(1.0 / 3.0));
    light = vec4(light.rgb / max(solid, 1.0e-3), light.a * solid);
//@end
//@if exposes
    light.rgb = light.rgb * exposure;
//@end
//@if has_tone
    light.rgb = saturate3(@tone@(tone_input(light.rgb)));
//@end
//@if encodes
    @pixel@ = vec4(encode(light.r), encode(light.g), encode(light.b), light.a);
//@elif premultiplied
    @pixel@ = vec4(light.rgb * light.a, light.a);
//@else
    @pixel@ = light;
//@end
//@end
}
