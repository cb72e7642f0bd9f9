"""lectures.py: programs of classroom/tests/check/lectures, which contain mistakes printed in the courses' own programs, and the expected findings.

`docs/check/contracts.md` is generated from the same rows (name, contract, title, verdict, mistakes or parts of hints; scripts/contracts.py).
"""

LECTURES = [
    ("pittsburgh-printed", "pittsburgh", "as printed: lit per fragment, after the projection", "refused",
     ["'eye_position' is not declared, but 'eye_point' is", "'gl_position' should be gl_Position", "write `void main()`",
      "'half' is a reserved word", "write uniform vec4 ambient_product"]),
    ("pittsburgh-compiled", "pittsburgh", "as printed, but corrected until it compiles", "differs",
     ["clip-space", "direction-minus-point", "distance-interpolated", "alpha-summed", "no-gate", "normal-unit-late"]),
    ("oregon-printed", "oregon", "as printed: flat and smooth values side by side", "refused", ["did you mean `vec3 vNs`"]),
    ("oregon-compiled", "oregon", "as printed, but corrected until it compiles", "passes", []),
    ("nyu-printed", "nyu", "as printed: several point lights", "refused", ["'attenuation' is not declared"]),
    ("nyu-compiled", "nyu", "as printed, but corrected until it compiles", "differs", ["normal-with-w"]),
    ("nyu-normals", "nyu", "as printed, but corrected until it compiles and with corrected normals", "differs", ["specular-not-attenuated"]),
    ("learnopengl-printed", "learnopengl", "as printed in \"Basic Lighting\"", "passes", []),
    ("learnopengl-casters", "learnopengl", "as printed in \"Light casters\": a point light", "passes", []),
    ("learnopengl-pbr-printed", "learnopengl-pbr", "as printed in \"PBR: Lighting\"", "passes", []),
    ("angel-printed", "angel", "as printed: lit per vertex", "differs", ["direction-as-point", "normal-by-model-view"]),
    ("mdn-printed", "mdn", "as printed", "differs", ["normal-never-unit"]),
    ("threejs-printed", "threejs", "as tutorials print it: a highlight by ShaderMaterial", "differs", ["normal-eye-space"]),
]
