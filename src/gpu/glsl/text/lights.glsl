// lights.glsl: the lights, multiplied by the colours of a material.

// The share of the surrounding light that reaches the surface at this pixel.
float unoccluded_share()
{
    if (catches && unobstructed) {
        return 1.0;
    }
    return texelFetch(ambient_occlusion, ivec2(gl_FragCoord.xy), 0).r;
}

vec4 list_texel(sampler2D list, int number)
{
    return texelFetch(list, ivec2(number % LIST_WIDTH, number / LIST_WIDTH), 0);
}

// Light i, with the products of its colours and the material's.
light_source light_of(int i, Material m, bool front)
{
    light_source light;
    int first = i * LIGHT_TEXELS;
    light.position = (lights_in_texture ? list_texel(light_list, first) : lights[i].position).xyz;
    light.direction = (lights_in_texture ? list_texel(light_list, first + 1) : lights[i].direction).xyz;
    vec4 attenuation = lights_in_texture ? list_texel(light_list, first + 2) : lights[i].attenuation;
    vec4 cone = lights_in_texture ? list_texel(light_list, first + 3) : lights[i].cone;
    light.constant = attenuation.x;
    light.linear = attenuation.y;
    light.quadratic = attenuation.z;
    light.inverse_range = attenuation.w;
    light.cos_cutoff = cone.x;
    light.exponent = cone.y;
    light.cos_outer = cone.z;
    light.inverse_width = cone.w;
    if (products) {
        int product = (front ? first_product : back_first_product) + i * PRODUCT_TEXELS;
        light.diffuse = (lights_in_texture ? list_texel(product_list, product)
            : front ? diffuse_product[i]
            : back_diffuse_product[i]).rgb;
        light.specular = !highlights ? black3()
            : (lights_in_texture ? list_texel(product_list, product + 1)
            : front ? specular_product[i]
            : back_specular_product[i]).rgb;
    } else {
        light.diffuse = mul3(microfacet && !map_dielectric ? scale3(m.diffuse.rgb, 1.0 - m.metallic) : m.diffuse.rgb,
            (lights_in_texture ? list_texel(light_list, first + 4) : lights[i].diffuse).rgb);
        if (microfacet) {
            light.specular = (lights_in_texture ? list_texel(light_list, first + 5) : lights[i].specular).rgb;
        } else {
            light.specular = highlights
                ? mul3(m.specular.rgb, (lights_in_texture ? list_texel(light_list, first + 5) : lights[i].specular).rgb) : black3();
        }
    }
    if (occluded) {
        // w: the share of the light that occlusion dims.
        float occluded = (lights_in_texture ? list_texel(light_list, first + 1) : lights[i].direction).w;
        float kept = unoccluded_light(occluded, unoccluded_share());
        light.diffuse = scale3(light.diffuse, kept);
        light.specular = scale3(light.specular, kept);
    }
    return light;
}

// The ambient term of light i before attenuation: ka La.
vec3 ambient_of(int i, Material m, bool front)
{
    if (products) {
        return (lights_in_texture ? list_texel(product_list, (front ? first_product : back_first_product) + i * PRODUCT_TEXELS + 2)
            : front ? light_ambient_product[i] : back_light_ambient_product[i]).rgb;
    } else {
        return mul3(m.ambient.rgb, (lights_in_texture ? list_texel(light_list, i * LIGHT_TEXELS + 6) : lights[i].ambient).rgb);
    }
}

hemisphere hemisphere_of(int i, Material m, bool front)
{
    hemisphere h;
    int first = HEMISPHERES_AT + i * HEMISPHERE_TEXELS;
    h.up = (lights_in_texture ? list_texel(light_list, first) : hemispheres[i].up).xyz;
    if (products) {
        int product = (front ? first_product : back_first_product) + HEMISPHERE_PRODUCTS_AT + i * 2;
        h.sky = (lights_in_texture ? list_texel(product_list, product) : front ? sky_product[i] : back_sky_product[i]).rgb;
        h.ground = (lights_in_texture ? list_texel(product_list, product + 1) : front ? ground_product[i]
            : back_ground_product[i]).rgb;
    } else {
        h.sky = mul3(SKY_COLOR, (lights_in_texture ? list_texel(light_list, first + 1) : hemispheres[i].sky).rgb);
        h.ground = mul3(SKY_COLOR, (lights_in_texture ? list_texel(light_list, first + 2) : hemispheres[i].ground).rgb);
    }
    return h;
}
