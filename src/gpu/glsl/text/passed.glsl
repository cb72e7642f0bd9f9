// passed.glsl: functions that a program may replace. They therefore keep all of their parameters.

// The share of light i that reaches the point p in eye space: 1 if nothing blocks it. The program sets the share for a
// whole draw. To use a shadow map instead, look it up here.
float passed_light(int i, vec3 p)
{
    return lights_in_texture ? list_texel(light_list, i * LIGHT_TEXELS).w : passed[i];
}
