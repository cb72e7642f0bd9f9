"""public_labels.py: the findings of a person who read lighting shaders in public repositories before the check was run on them.

(repository, fragment shader, vertex shader, label, names, reason). If a page or script contains several shaders, the path is `page#id`.
Labels: `right` (according to its course or tutorial); `wrong`, with the names of the true mistakes, as far as the check has names for them;
`unknown`: the check cannot run or judge it (another stage is missing, or the model is not a sum of ambient, diffuse and highlight). The shaders'
texts are not part of this project; classroom/tests/check/public.py reads them from a folder that the caller provides.
"""

INFO = "181x121x/InfoVis2018"
OGL = "JoeyDeVries/LearnOpenGL"
RS = "AgustinCB/learnopengl-rs"
COOK = "daw42/glslcookbook"
QT = "KuromoriSaru/OpenGLProject"
ANTON = "capnramses/antons_opengl_tutorials_book"
FEUP = "daviddias99/computer-graphics-feup-laig"
LIU = "tersimdev/liu-computer-graphics-project"
SOUND = "mozg1/ThreeJSWorkInProgress"

LABELS = [
    (INFO, "W06/Task2/w06_ex02.html#phong.frag", "W06/Task2/w06_ex02.html#phong.vert", "right", [], "Lambert in eye space, strengths as numbers"),
    (INFO, "W10/Task3/w10_index_task03.html#phong.frag", "W10/Task3/w10_index_task03.html#phong.vert", "right", [], "the same, the colour as a number"),
    (INFO, "W99/w15_main.html#PhongLambertian.frag", "W99/w15_main.html#Phong.vert", "right", [], "Lambert in eye space"),
    (INFO, "W99/w15_main.html#PhongPhong.frag", "W99/w15_main.html#Phong.vert", "wrong", ["spaces-mixed"], "the camera in world space minus a point in eye space"),
    (INFO, "W99/w15_main.html#PhongBlinn-Phong.frag", "W99/w15_main.html#Phong.vert", "wrong", [], "h.v in place of n.h, and the spaces mixed"),
    (INFO, "W99/w15_main.html#PhongCook-Torrance.frag", "W99/w15_main.html#Phong.vert", "wrong", ["spaces-mixed"], "a Cook-Torrance form of its own; the camera in world space minus a point in eye space"),
    (INFO, "W99/w15_main.html#PhongToon.frag", "W99/w15_main.html#Phong.vert", "wrong", ["spaces-mixed"], "toon steps; the camera in world space minus a point in eye space"),
    ("Abel-Lagonell/Computer-Graphics", "WebGL-Old/SpookyForest/SpookyForest.html#2dFragmentShader", "WebGL-Old/SpookyForest/SpookyForest.html#2dVertexShader", "unknown", [], "builds its matrices from vectors"),
    (RS, "src/bin/shaders/07.1-basiclightfragment.glsl", "src/bin/shaders/07.1-basiclightvertex.glsl", "wrong", ["normal-object-space"], "Normal = aNormal"),
    (RS, "src/bin/shaders/07.2-basiclightfragmentview.glsl", "src/bin/shaders/07.2-basiclightvertexview.glsl", "wrong", [], "lightPos is not declared: does not compile"),
    (RS, "src/bin/shaders/23.1-normal_mapping_fragment.glsl", "src/bin/shaders/23.1-normal_mapping_vertex.glsl", "unknown", [], "#include, and a geometry shader between the two"),
    ("Collinnn/Computer-Graphics", "Web-GL-exercises/Worksheet4/Shaders/fshaderw4p5.glsl", "Web-GL-exercises/Worksheet4/Shaders/vshaderw4p5.glsl", "wrong", ["normal-by-model-view", "normal-as-point", "unit-too-early"], "normals by the model matrix, w and all; l and v are normalized at the vertices"),
    (OGL, "src/2.lighting/2.1.basic_lighting_diffuse/2.1.basic_lighting.fs", "src/2.lighting/2.1.basic_lighting_diffuse/2.1.basic_lighting.vs", "wrong", ["normal-object-space"], "Normal = aNormal, which the next lesson corrects"),
    (OGL, "src/6.pbr/1.1.lighting/1.1.pbr.fs", "src/6.pbr/1.1.lighting/1.1.pbr.vs", "right", [], "the course's own"),
    (OGL, "src/6.pbr/2.1.1.ibl_irradiance_conversion/2.1.1.pbr.fs", "src/6.pbr/2.1.1.ibl_irradiance_conversion/2.1.1.pbr.vs", "wrong", ["normal-never-unit"], "N = Normal"),
    (QT, "visual-studio-c++/FinalProjectQT/FinalProjectQT/perPixel.frag", "visual-studio-c++/FinalProjectQT/FinalProjectQT/perPixel.vert", "wrong", ["normal-not-unit", "normal-unit-early"], "the interpolated normal is not normalized"),
    (QT, "visual-studio-c++/FinalProjectQT/FinalProjectQT/phong.frag", "visual-studio-c++/FinalProjectQT/FinalProjectQT/phong.vert", "wrong", ["normal-not-unit", "normal-unit-early"], "the same, and the half vector of a vertex"),
    (QT, "visual-studio-c++/FinalProjectQT/FinalProjectQT/toonf2.frag", "visual-studio-c++/FinalProjectQT/FinalProjectQT/toonf2.vert", "right", [], "toon steps of n.l, a directional light in eye space"),
    ("PLUMAS-research/cc3501-computer-graphics", "assets/multiple_lights_color.fs", "assets/multiple_lights_color.vs", "right", [], "LearnOpenGL's lights with vertex colours"),
    ("Tuck1297/cg-illuminationshading-2", "shaders/phong_color.frag", "shaders/phong_color.vert", "right", [], "Phong in world space, a list of lights"),
    (ANTON, "08_phong/test_fs.glsl", "08_phong/test_vs.glsl", "wrong", ["normal-by-model-view"], "normals by view * model"),
    (ANTON, "18_spotlights/test_fs.glsl", "18_spotlights/test_vs.glsl", "wrong", ["normal-by-model-view", "normal-never-unit"], "the same, never normalized"),
    (FEUP, "1st_Project/lib/CGF/shaders/Phong/multiple_light-phong-fragment.glsl", "1st_Project/lib/CGF/shaders/Phong/multiple_light-phong-vertex.glsl", "wrong", ["light-not-unit", "ambient-attenuated"], "n.l of a vector to the light that is not normalized"),
    (FEUP, "1st_Project/lib/CGF/shaders/Phong/phong-fragment.glsl", "1st_Project/lib/CGF/shaders/Phong/phong-vertex.glsl", "right", [], "a direction in the model's space, gated"),
    (COOK, "chapter03/shader/perfrag.fs", "chapter03/shader/perfrag.vs", "right", [], "Phong in eye space"),
    (COOK, "chapter03/shader/toon.fs", "chapter03/shader/toon.vs", "wrong", ["no-clamp"], "toon steps; n.l is not clamped, so the steps go below 0"),
    (COOK, "chapter05/shader/oit.fs", "chapter05/shader/oit.vs", "unknown", [], "writes linked lists, in two passes"),
    (COOK, "chapter06/shader/silhouette.fs", "chapter06/shader/silhouette.vs", "unknown", [], "a geometry shader between the two"),
    (COOK, "chapter06/shader/tessteapot.fs", "chapter06/shader/tessteapot.vs", "unknown", [], "tessellation shaders between the two"),
    (COOK, "chapter09/shader/particleinstanced.fs", "chapter09/shader/particleinstanced.vs", "wrong", ["normal-never-unit"], "the normal is never normalized"),
    (COOK, "chapter09/shader/wave.fs", "chapter09/shader/wave.vs", "unknown", [], "the surface is a wave that moves"),
    ("douzhongqiang/QtLearnOpenGL", "QtLearnOpenGL/09_Material/shader/fragmentshader.fsh", "QtLearnOpenGL/09_Material/shader/vertexshader.vsh", "wrong", ["normal-never-unit"], "the normal is not normalized after its matrix"),
    ("hamidib/Open-GL-Gouraud-Shader", "blinn_phong.frag.glsl", "blinn_phong.vert.glsl", "right", [], "two lights in eye space, no gate"),
    ("hamidib/Open-GL-Gouraud-Shader", "gouraud.frag.glsl", "gouraud.vert.glsl", "right", [], "the same at the vertices"),
    ("jleckron/LightingDemo", "src/graphics/shaders/asg5.js#ASG5_FSHADER", "src/graphics/shaders/asg5.js#ASG5_VSHADER", "right", [], "vertices are in world space; vertex colours"),
    ("kurtbixby/LearnOpenGL", "FirstTutorial/Shaders/Old/Diffuse.frag", "FirstTutorial/Shaders/Old/Diffuse.vert", "right", [], "LearnOpenGL's, normal matrix from the program"),
    ("kurtbixby/LearnOpenGL", "FirstTutorial/Shaders/Old/ViewLighting.frag", "FirstTutorial/Shaders/Old/ViewLighting.vert", "right", [], "the same in eye space"),
    (SOUND, "SoundVisualizer/shaders/CWshader_fs.glsl", "SoundVisualizer/shaders/CWshader_vs.glsl", "wrong", [], "vertPos is never written: does not link"),
    (SOUND, "SoundVisualizer/shaders/centralshader_fs.glsl", "SoundVisualizer/shaders/centralshader_vs.glsl", "wrong", ["normal-object-space", "clip-space-vectors"], "the position after the projection, normals in the model's space"),
    (SOUND, "SoundVisualizer/shaders/floorshader_fs.glsl", "SoundVisualizer/shaders/floorshader_vs.glsl", "wrong", ["normal-object-space", "clip-space-vectors"], "the same"),
    (SOUND, "SoundVisualizer/shaders/lineshader_fs.glsl", "SoundVisualizer/shaders/lineshader_vs.glsl", "wrong", ["normal-object-space", "clip-space-vectors"], "the same"),
    ("ozen/BezierSurfaces", "BezierSurfaces/fshader_phong.glsl", "BezierSurfaces/vshader_phong.glsl", "wrong", [], "the vector to the eye is the position itself"),
    ("processing/processing-docs", "content/examples/Topics/Shaders/GlossyFishEye/data/GlossyFrag.glsl", "content/examples/Topics/Shaders/GlossyFishEye/data/GlossyVert.glsl", "wrong", ["no-clamp"], "a light in eye space minus the vertex before its matrix; n.l is not clamped"),
    ("processing/processing-docs", "content/examples/Topics/Shaders/ToonShading/data/ToonFrag.glsl", "content/examples/Topics/Shaders/ToonShading/data/ToonVert.glsl", "wrong", ["normal-not-unit"], "toon steps; the interpolated normal is not normalized"),
    ("raysan5/raylib", "examples/models/resources/shaders/glsl100/voxel_lighting.fs", "examples/models/resources/shaders/glsl100/voxel_lighting.vs", "wrong", ["specular-times-n.l"], "the highlight is multiplied by the diffuse sum and has no light's colour"),
    ("raysan5/raylib", "examples/models/resources/shaders/glsl120/voxel_lighting.fs", "examples/models/resources/shaders/glsl120/voxel_lighting.vs", "wrong", ["specular-times-n.l"], "the same"),
    ("slackmoehrle/Computer-Graphics-Through-OpenGL-2nd", "Chapter20/BumpMappingPerPixelLight/fragmentShader.glsl", "Chapter20/BumpMappingPerPixelLight/vertexShader.glsl", "right", [], "a directional light and a distant viewer"),
    (LIU, "lab_practice/demoes/SimpleGUI 0.5/Demo Phong bunny and friends + GUI/phong.frag", "lab_practice/demoes/SimpleGUI 0.5/Demo Phong bunny and friends + GUI/phong.vert", "right", [], "a direction in eye space as numbers"),
    (LIU, "lab_practice/demoes/SimpleGUI 0.5/Demo put-lid-on-teapot/mphong.frag", "lab_practice/demoes/SimpleGUI 0.5/Demo put-lid-on-teapot/phong.vert", "right", [], "the same, and an ambient term"),
    (LIU, "lab_practice/lab1/lab1-6.frag", "lab_practice/lab1/lab1-6.vert", "wrong", ["no-clamp", "normal-not-unit"], "n.l is not clamped, neither the direction nor the normal is a unit vector"),
    ("williamblair/learnopengl", "08_02_phong/fragmentShader.glsl", "08_02_phong/vertexShader.glsl", "right", [], "LearnOpenGL's under other names"),
    ("williamblair/learnopengl", "30_bloom/lightFragmentShader.glsl", "30_bloom/lightVertexShader.glsl", "unknown", [], "no lighting at all: the lamp's own cube"),
]
