// version.c: the library's version and build options.
#include <lambent/base.h>

#if defined(__clang__)
#define COMPILER "clang " __clang_version__
#elif defined(__GNUC__)
#define COMPILER "gcc " __VERSION__
#else
#define COMPILER "an unknown compiler"
#endif

#if defined(__x86_64__)
#define MACHINE "x86-64"
#elif defined(__aarch64__)
#define MACHINE "arm64"
#elif defined(__wasm__)
#define MACHINE "wasm"
#else
#define MACHINE "an unknown machine"
#endif

#ifdef NDEBUG
#define BUILD "release"
#else
#define BUILD "debug"
#endif

const char *lam_version(void) { return LAM_VERSION_TEXT; }

// The build file defines the list of libraries and instruction sets.
#ifndef BUILT_WITH
#define BUILT_WITH ""
#endif

const char *lam_build_info(void) { return COMPILER ", " MACHINE ", " BUILD BUILT_WITH; }
