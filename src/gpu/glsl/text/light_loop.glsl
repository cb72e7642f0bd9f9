    for (int i = LIGHTS_FIRST; i < LIGHTS_END; i++) {
        light_source light = light_of(i, m, front);
        light_sample t = toward_light(s.p, light, LIGHT_KIND, LIGHT_FALLOFF);
        if (gl1) {
            sum = add_arriving_ambient(sum, ambient_of(i, m, front), t);
        }
        if (has_light_shares) {
            t.attenuation = t.attenuation * passed_light(i, s.p);
        }
        if (tints_rays) {
            light = tinted_light(light,
                shadowed_light(lights_in_texture ? list_texel(light_list, i * 4) : lights[i].position, light, t,
                needs_tangent || layered ? 1.0 : dot3(s.n, t.l), LIGHT_KIND));
        } else if (shadows) {
            t.attenuation = t.attenuation * shadowed_light(lights_in_texture ? list_texel(light_list, i * 4) : lights[i].position,
                light, t, needs_tangent || layered ? 1.0 : dot3(s.n, t.l), LIGHT_KIND);
        }
        if (layered) {
            sum = add_layered(sum, light, t, layered_light(s, layering, t.l, LOBE, 0));
        } else {
            if (microfacet) {
                light = with_fresnel(light, mirror, s.v, t.l);
            }
            if (toned) {
                light = with_tone(light, s.n, t.l);
            }
            sum = add_reflected(sum, light, t, LOBE);
        }
    }
