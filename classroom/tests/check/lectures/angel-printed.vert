// As the book prints it: the normal goes by the model-view matrix, and every light is a point.
attribute vec4 vPosition;
attribute vec3 vNormal;

uniform mat4 ModelView, Projection;
uniform vec4 LightPosition, AmbientProduct, DiffuseProduct, SpecularProduct;
uniform float Shininess;

varying vec4 color;

void main()
{
    vec3 pos = (ModelView * vPosition).xyz;
    vec3 L = normalize(LightPosition.xyz - pos);
    vec3 E = normalize(-pos);
    vec3 H = normalize(L + E);
    vec3 N = normalize(ModelView * vec4(vNormal, 0.0)).xyz;
    float Kd = max(dot(L, N), 0.0);
    float Ks = pow(max(dot(N, H), 0.0), Shininess);
    vec4 specular = Ks * SpecularProduct;
    if (dot(L, N) < 0.0)
        specular = vec4(0.0, 0.0, 0.0, 1.0);
    color = AmbientProduct + Kd * DiffuseProduct + specular;
    color.a = 1.0;
    gl_Position = Projection * ModelView * vPosition;
}
