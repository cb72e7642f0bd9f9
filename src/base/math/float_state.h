// float_state.h: the floating-point state that every result depends on.
//
// A host built with -ffast-math turns denormals off for its threads, and threads inherit it; a host may also have set
// another rounding. Every public call that computes, and every worker, runs between enter and leave.
#ifndef FLOAT_STATE_H
#define FLOAT_STATE_H

#include <stdint.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
// Round to nearest, denormals on, all exceptions masked.
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
// WebAssembly has exactly this state and no other.
static inline uint64_t float_state_enter(void) { return 0; }
static inline void float_state_leave(uint64_t saved) { (void)saved; }
#endif

#endif
