// setjmp.h: declarations that wasi-libc lacks. Clang lowers calls of setjmp and longjmp to WebAssembly's exceptions
// (-wasm-enable-sjlj), with the help of setjmp.c.
#ifndef WEB_SETJMP_H
#define WEB_SETJMP_H

// The state of __wasm_setjmp and __wasm_longjmp: the call, and the value of longjmp.
typedef struct {
    void *frame;
    unsigned label;
    struct {
        void *buffer;
        int value;
    } sent;
} jmp_buf[1];

int setjmp(jmp_buf) __attribute__((returns_twice));
_Noreturn void longjmp(jmp_buf, int);

#endif
