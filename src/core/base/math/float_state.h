// float_state.h: the floating-point state that every result depends on.
//
// A host program built with -ffast-math disables denormals in its threads, and new threads inherit this state. A host
// may also set another rounding mode. Therefore every public function that computes, and every worker thread, runs
// between float_state_enter and float_state_leave.
#ifndef FLOAT_STATE_H
#define FLOAT_STATE_H

#include <stdint.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
// Sets rounding to nearest, enables denormals and masks all exceptions. Returns the previous state.
static inline uint64_t float_state_enter(void)
{
    unsigned saved = _mm_getcsr();
    _mm_setcsr(0x1f80);
    return saved;
}
static inline void float_state_leave(uint64_t saved) { _mm_setcsr((unsigned)saved); }
#elif defined(__aarch64__)
static inline uint64_t float_state_enter(void)
{
    uint64_t saved;
    __asm__ volatile("mrs %0, fpcr" : "=r"(saved));
    uint64_t wanted = 0;
    __asm__ volatile("msr fpcr, %0" : : "r"(wanted));
    return saved;
}
static inline void float_state_leave(uint64_t saved) { __asm__ volatile("msr fpcr, %0" : : "r"(saved)); }
#else
// WebAssembly always uses this floating-point state.
static inline uint64_t float_state_enter(void) { return 0; }
static inline void float_state_leave(uint64_t saved) { (void)saved; }
#endif

#endif
