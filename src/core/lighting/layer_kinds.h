// layer_kinds.h: the layers that a physical material may have in addition to a metallic-roughness surface, as bits of a
// set. C and GLSL.
#define LAYER_DIELECTRIC   1 // its own f0 and f90
#define LAYER_CLEARCOAT    2
#define LAYER_SHEEN        4
#define LAYER_ANISOTROPY   8
#define LAYER_IRIDESCENCE  16
#define LAYER_TRANSMISSION 32
#define LAYER_VOLUME       64 // behind a surface that transmits
