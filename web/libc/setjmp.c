// setjmp.c: the functions that clang calls for setjmp and longjmp on WebAssembly (LLVM, WebAssemblyLowerEmscriptenEHSjLj.cpp:
// "Wasm setjmp / longjmp handling").
//
// A function that calls setjmp marks the buffer with its own frame and the number of the call. longjmp throws the
// buffer as an exception; the function catches it, checks whether the buffer has its mark, and continues after that
// call.
#include <setjmp.h>
#include <stdint.h>

struct mark {
    void *frame;
    uint32_t label;
    struct {
        void *buffer;
        int value;
    } sent;
};

void __wasm_setjmp(void *buffer, uint32_t label, void *frame);
uint32_t __wasm_setjmp_test(void *buffer, void *frame);
_Noreturn void __wasm_longjmp(void *buffer, int value);

void __wasm_setjmp(void *buffer, uint32_t label, void *frame)
{
    struct mark *mark = buffer;
    mark->frame = frame;
    mark->label = label;
}

// The number of the setjmp call in this frame that made the buffer; 0 if none did.
uint32_t __wasm_setjmp_test(void *buffer, void *frame)
{
    struct mark *mark = buffer;
    return mark->frame == frame ? mark->label : 0;
}

void __wasm_longjmp(void *buffer, int value)
{
    enum { LONGJMP_TAG = 1 }; // one of LLVM's exception tags; 0 is C++'s
    struct mark *mark = buffer;
    mark->sent.buffer = buffer;
    mark->sent.value = value ? value : 1; // C11 7.13.2.1
    __builtin_wasm_throw(LONGJMP_TAG, &mark->sent);
}
