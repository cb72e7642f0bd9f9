//@if has_environment

// --- the environment
//@if cube_points

// The point where a direction meets a cube, -1...1 on its face, and the number of the face (OpenGL 4.6, 8.13).
vec3 cube_point(vec3 e)
{
    vec3 size = abs(e);
    bool on_x = size.x >= size.y && size.x >= size.z;
    bool on_y = !on_x && size.y >= size.z;
    float major = on_x ? size.x : (on_y ? size.y : size.z);
    bool minus = (on_x ? e.x : (on_y ? e.y : e.z)) < 0.0;
    float across = on_x ? (minus ? e.z : -e.z) : (on_y ? e.x : (minus ? -e.x : e.x));
    float down = on_y ? (minus ? -e.z : e.z) : -e.y;
    float face = (on_x ? 0.0 : (on_y ? 2.0 : 4.0)) + (minus ? 1.0 : 0.0);
    return major > 0.0 ? vec3(vec2(across, down) / major, face) : vec3(0.0, 0.0, face);
}
//@end

//@if cube_map
// Light from the environment along the direction d in eye space.
vec3 environment_color(vec3 d) { return @texture_cube@(environment, environment_matrix * d).rgb; }
//@else
// Light from the environment along the direction d in eye space. Each layer of the texture is a face of the cube with a
// border of one texel from its neighbours, so that the bilinear filter has no special case at the edges.
vec3 environment_color(vec3 d)
{
    vec3 point = cube_point(environment_matrix * d);
    int face = int(point.z);
    float side = float(textureSize(environment_faces, 0).x - 2);
    float middle = 0.5 * side + 0.5;
    vec2 texel = point.xy * (0.5 * side) + middle;
    texel = clamp(texel, vec2(0.5), vec2(side + 0.5));
    ivec2 corner = ivec2(texel);
    vec2 part = texel - vec2(corner);
    vec3 a = texelFetch(environment_faces, ivec3(corner, face), 0).rgb;
    vec3 b = texelFetch(environment_faces, ivec3(corner + ivec2(1, 0), face), 0).rgb;
    vec3 c = texelFetch(environment_faces, ivec3(corner + ivec2(0, 1), face), 0).rgb;
    vec3 f = texelFetch(environment_faces, ivec3(corner + ivec2(1, 1), face), 0).rgb;
    return mix3(mix3(a, b, part.x), mix3(c, f, part.x), part.y);
}
//@end
//@end
//@if environment_light

// Texel i of the prefiltered environment and of the irradiance.
vec3 environment_light_texel(float i)
{
    float row = floor(i / 1024.0);
//@if glsl_120
    return texture2D(environment_light, (vec2(i - 1024.0 * row, row) + 0.5) / vec2(1024.0, @level_rows@)).rgb;
//@else
    return texelFetch(environment_light, ivec2(int(i - 1024.0 * row), int(row)), 0).rgb;
//@end
}

// The light of a level at a point of a cube. Each level is six faces with a border of one texel, one after the other.
vec3 level_color(int level, vec3 point)
{
    const float sizes[@level_count@] = float[@level_count@](@level_sizes@);
    const float starts[@level_count@] = float[@level_count@](@level_starts@);
    float size = sizes[level];
    float side = size + 2.0;
    vec2 texel = clamp(point.xy * (0.5 * size) + (0.5 * size + 0.5), vec2(0.5), vec2(size + 0.5));
    vec2 corner = floor(texel);
    vec2 part = texel - corner;
    float first = starts[level] + (point.z * side + corner.y) * side + corner.x;
    vec3 a = environment_light_texel(first);
    vec3 b = environment_light_texel(first + 1.0);
    vec3 c = environment_light_texel(first + side);
    vec3 d = environment_light_texel(first + side + 1.0);
    return mix3(mix3(a, b, part.x), mix3(c, d, part.x), part.y);
}

vec3 irradiance_at(vec3 normal)
{
    return level_color(int(PREFILTERED_LAST) + 1, cube_point(environment_matrix * normal));
}

// Level 0 is the environment, as a mirror shows it.
vec3 prefiltered_at(vec3 direction, float level)
{
    vec3 point = cube_point(environment_matrix * direction);
    float first = min_of(floor(level), PREFILTERED_LAST - 1.0);
    vec3 low = first > 0.5 ? level_color(int(first), point) : environment_color(direction);
    return mix3(low, level_color(int(first) + 1, point), level - first);
}
//@end
//@if occluded

// --- ambient occlusion

// The share of the light from all around that reaches this pixel's surface.
float unoccluded_share()
{
//@if catches
    if (unobstructed) {
        return 1.0;
    }
//@end
    return texelFetch(ambient_occlusion, ivec2(gl_FragCoord.xy), 0).r;
}
//@end
//@if !output_vector
//@if has_lights has_hemispheres

// --- lights and materials
//@if lights_in_texture

vec4 list_texel(sampler2D list, int number)
{
    return texelFetch(list, ivec2(number % @list_width@, number / @list_width@), 0);
}
//@end
//@if has_lights

// Light i, with the products of its colours and the material's.
light_source light_of(int i@list_parameter@)
{
    light_source light;
//@if lights_in_texture
    int first = i * @light_texels@;
    light.position = list_texel(light_list, first).xyz;
    light.direction = list_texel(light_list, first + 1).xyz;
//@if has_falloff
    vec4 attenuation = list_texel(light_list, first + 2);
//@end
//@if has_cone
    vec4 cone = list_texel(light_list, first + 3);
//@end
//@else
    light.position = lights[i].position.xyz;
    light.direction = lights[i].direction.xyz;
//@if has_falloff
    vec4 attenuation = lights[i].attenuation;
//@end
//@if has_cone
    vec4 cone = lights[i].cone;
//@end
//@end
//@if has_falloff
    light.constant = attenuation.x;
    light.linear = attenuation.y;
    light.quadratic = attenuation.z;
    light.inverse_range = attenuation.w;
//@end
//@if has_cone
    light.cos_cutoff = cone.x;
    light.exponent = cone.y;
    light.cos_outer = cone.z;
    light.inverse_width = cone.w;
//@end
//@if products
//@if lights_in_texture
    int product = $(first_product) + i * @product_texels@;
    light.diffuse = list_texel(product_list, product).rgb;
    light.specular = list_texel(product_list, product + 1).rgb;
//@else
    light.diffuse = $(diffuse_product[i]).rgb;
//@if highlights
    light.specular = $(specular_product[i]).rgb;
//@else
    light.specular = black3();
//@end
//@end
//@else
//@if lights_in_texture
//@if microfacet
    light.diffuse = mul3(@lambert@, list_texel(light_list, first + 4).rgb);
    light.specular = list_texel(light_list, first + 5).rgb;
//@elif highlights
    light.diffuse = mul3(m.diffuse.rgb, list_texel(light_list, first + 4).rgb);
    light.specular = mul3(m.specular.rgb, list_texel(light_list, first + 5).rgb);
//@else
    light.diffuse = mul3(m.diffuse.rgb, list_texel(light_list, first + 4).rgb);
    light.specular = black3();
//@end
//@else
//@if microfacet
    light.diffuse = mul3(@lambert@, lights[i].diffuse.rgb);
    light.specular = lights[i].specular.rgb;
//@elif highlights
    light.diffuse = mul3(m.diffuse.rgb, lights[i].diffuse.rgb);
    light.specular = mul3(m.specular.rgb, lights[i].specular.rgb);
//@else
    light.diffuse = mul3(m.diffuse.rgb, lights[i].diffuse.rgb);
    light.specular = black3();
//@end
//@end
//@end
//@if occluded
    // w: the share of the light that occlusion dims.
//@if lights_in_texture
    float occluded = list_texel(light_list, first + 1).w;
//@else
    float occluded = lights[i].direction.w;
//@end
    float kept = unoccluded_light(occluded, unoccluded_share());
    light.diffuse = scale3(light.diffuse, kept);
    light.specular = scale3(light.specular, kept);
//@end
    return light;
}
//@if has_light_shares

// The share of light i that reaches the point p in eye space: 1 where nothing is in the way. The program sets it for a whole
// draw; a shadow map of its own is looked up here.
float passed_light(int i, vec3 p)
{
//@if lights_in_texture
    return list_texel(light_list, i * @light_texels@).w;
//@else
    return passed[i];
//@end
}
//@end
//@if gl1

// The ambient term of light i before attenuation: ka La.
vec3 ambient_of(int i@list_parameter@)
{
//@if products
//@if lights_in_texture
    return list_texel(product_list, $(first_product) + i * @product_texels@ + 2).rgb;
//@else
    return $(light_ambient_product[i]).rgb;
//@end
//@else
//@if lights_in_texture
    return mul3(m.ambient.rgb, list_texel(light_list, i * @light_texels@ + 6).rgb);
//@else
    return mul3(m.ambient.rgb, lights[i].ambient.rgb);
//@end
//@end
}
//@end
//@end
//@if has_hemispheres

hemisphere hemisphere_of(int i@list_parameter@)
{
    hemisphere h;
//@if lights_in_texture
    int first = @hemispheres_at@ + i * @hemisphere_texels@;
    h.up = list_texel(light_list, first).xyz;
//@if products
    int product = $(first_product) + @hemisphere_products_at@ + i * 2;
    h.sky = list_texel(product_list, product).rgb;
    h.ground = list_texel(product_list, product + 1).rgb;
//@else
    h.sky = mul3(m.ambient.rgb, list_texel(light_list, first + 1).rgb);
    h.ground = mul3(m.ambient.rgb, list_texel(light_list, first + 2).rgb);
//@end
//@else
    h.up = hemispheres[i].up.xyz;
//@if products
    h.sky = $(sky_product[i]).rgb;
    h.ground = $(ground_product[i]).rgb;
//@else
    h.sky = mul3(m.ambient.rgb, hemispheres[i].sky.rgb);
    h.ground = mul3(m.ambient.rgb, hemispheres[i].ground.rgb);
//@end
//@end
    return h;
}
//@end
//@end
//@end

//@if has_transmission
// What the last point that was lit lets through of the light behind it.
vec3 passing = vec3(0.0);

//@end
// --- lighting of a point

//@if unlit
// The colour and opacity of an unlit surface.
//@else
// The light that leaves the point p of a surface towards the eye, and the opacity. The normal is on the visible side and has
// any length; p and normal are in eye space.
//@end
//@if vertex_colors
// `tint` is the vertex colour: a factor of the ambient and diffuse terms, and of the opacity.
//@end
//@if separate_texture_terms
// `rest` is the part of the light that the diffuse map does not multiply.
//@elif has_maps
// `maps` is what the material's textures say of the point.
//@end
vec4 light_point(@lit_parameters@)
{
//@if !products
//@if !output_vector
    Material m = material;
//@if back_material
    if (!front) {
        m = back_material;
    }
//@end
//@end
//@end
//@if unlit
//@if products
    terms sum = unlit_terms($(diffuse).rgb);
//@else
    terms sum = unlit_terms(m.diffuse.rgb);
//@end
//@end
//@if needs_surface
    surface s;
    s.p = p;
    s.n = unit3(normal);
    s.v = to_eye(p, @viewer@);
//@if needs_tangent
    s.t = perpendicular3(tangent, s.n);
//@else
    s.t = black3();
//@end
//@end
//@if output_vector
@output_vector@
//@else
//@if !unlit
//@if products
    terms sum = start_terms($(ambient_product).rgb, $(emission).rgb);
//@else
    terms sum = start_terms(mul3(m.ambient.rgb, ambient_light.rgb), m.emission.rgb);
//@end
@parameters@
//@if has_hemispheres
    for (int i = 0; i < @hemispheres@; i++) {
        sum = add_hemisphere(sum, s, hemisphere_of(i@list_argument@));
    }
//@end
//@if microfacet
//@if products
    vec3 base = $(diffuse).rgb;
//@else
    vec3 base = m.diffuse.rgb;
//@end
//@if vertex_colors
    base = mul3(base, tint.rgb);
//@end
//@if map_color
    base = mul3(base, maps.color);
//@end
//@if layered
    layer_values given;
    given.base = base;
    given.metallic = @metallic@;
    given.roughness = @roughness@;
//@if has_clearcoat
//@if has_coat_normal
    given.clearcoat_normal = unit3(coat);
//@else
    given.clearcoat_normal = s.n;
//@end
//@end
@layers@
    layered layering = layered_of(s, given, 0, 0);
//@elif single_scattering
    fresnel mirror = fresnel_of(base, @metallic@, 0.0);
//@else
    fresnel mirror = fresnel_of(base, @metallic@, scattering_gain(s, @roughness@));
//@end
//@end
@groups@
//@if map_dielectric
    sum.diffuse = scale3(sum.diffuse, maps.dielectric);
//@end
//@if map_specular
    sum.specular = mul3(sum.specular, maps.specular);
//@end
//@if map_emission
    sum.emission = mul3(sum.emission, maps.emission);
//@end
//@if map_occlusion
    sum.ambient = scale3(sum.ambient, maps.occlusion);
//@end
//@if occluded
    sum.ambient = scale3(sum.ambient, unoccluded_share());
//@end
//@if layered
    sum = cover_terms(sum, layering, 0);
//@if has_transmission
    passing = layered_transmittance(s, layering, given, 0);
//@end
//@end
//@if has_environment
//@if separate_reflection
    vec3 matte = black3(); // the matte part of the reflection
//@end
    if (present(s.n) && present(s.v)) {
//@if environment_light
        vec3 matt = scale3(base, 1.0 - @metallic@);
//@if layered
        layered_around around = layered_around_of(s, given, layering, 0);
        vec3 arriving = layered_surroundings(s, layering, matt, around.base, around.top, 0);
//@if separate_reflection
        matte = sub3(arriving, layered_surroundings(s, layering, black3(), around.base, around.top, 0));
//@end
//@else
        surroundings around = surroundings_of(s, @roughness@);
        vec3 arriving = surroundings_light(mirror, matt, around);
//@if separate_reflection
        matte = sub3(arriving, surroundings_light(mirror, black3(), around));
//@end
//@end
//@if map_occlusion
        arriving = scale3(arriving, maps.occlusion);
//@end
//@if occluded
        arriving = scale3(arriving, unoccluded_share());
//@end
        sum.reflection = add3(sum.reflection, arriving);
//@elif products
        sum = add_environment(sum, $(reflectivity).rgb, environment_color(mirror3(s.v, s.n)));
//@else
        sum = add_environment(sum, m.reflectivity.rgb, environment_color(mirror3(s.v, s.n)));
//@end
    }
//@end
//@end
//@if map_ambient
    sum.ambient = mul3(sum.ambient, maps.ambient);
//@if map_color
    sum.diffuse = mul3(sum.diffuse, maps.color);
//@end
//@elif map_color
    sum = tint_terms(sum, maps.color);
//@end
//@if vertex_colors
    sum = tint_terms(sum, tint.rgb);
//@end
//@if output_material
@parameters@
    return vec4(@output_material@, 1.0);
//@else
//@if separate_texture_terms
    vec3 color = @output_mapped@;
    rest = @output_rest@;
//@if clamped
    rest = vec3(saturate(rest.x), saturate(rest.y), saturate(rest.z));
//@end
//@else
    vec3 color = @output_term@;
//@end
//@if clamped
    // As in OpenGL 1, the colour of a vertex is clamped to 0...1.
    color = vec3(saturate(color.x), saturate(color.y), saturate(color.z));
//@end
//@if products
    float opacity = $(diffuse).a;
//@else
    float opacity = m.diffuse.a;
//@end
//@if vertex_colors
    opacity = opacity * tint.a;
//@end
//@if map_opacity
    opacity = opacity * maps.opacity;
//@end
//@if clamped
    opacity = saturate(opacity);
//@end
    return vec4(color, opacity);
//@end
//@end
}
