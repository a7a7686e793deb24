/* The beginning of a program on a Cortex-M without an operating system: vectors, the floating-point unit, the C library. */
#include <stdint.h>

extern char __stack[];
extern void _start(void);

static void reset(void) {
    *(volatile uint32_t *)0xE000ED88u |= 0xFu << 20;
    __asm__ volatile("dsb\nisb");
    *(volatile uint32_t *)0xE000E014u = 0xFFFFFFu;
    *(volatile uint32_t *)0xE000E018u = 0;
    *(volatile uint32_t *)0xE000E010u = 5;
    _start();
}

static void stop(void) {
    for (;;) {
    }
}

__attribute__((section(".vectors"), used)) static void *const vectors[16] = {
    __stack, (void *)reset, (void *)stop, (void *)stop, (void *)stop, (void *)stop, (void *)stop};
