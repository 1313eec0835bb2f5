/* What runs before main: the vector table, memory, the FPU, the timer. */
#include "host.h"

int main(void);
extern uint32_t stack_top, data_start, data_end, data_load, bss_start, bss_end;

void reset(void) __attribute__((noreturn));
void fault(void) __attribute__((noreturn));

union vector {
    uint32_t *stack;
    void (*handler)(void);
};
__attribute__((section(".vectors"), used)) static const union vector vectors[16] = {
    {.stack = &stack_top}, {.handler = reset}, {.handler = fault}, {.handler = fault},
};

void reset(void)
{
    for (uint32_t *to = &data_start, *from = &data_load; to < &data_end;) {
        *to++ = *from++;
    }
    for (uint32_t *to = &bss_start; to < &bss_end;) {
        *to++ = 0;
    }
#ifdef __ARM_FP
    /* The coprocessors that are the FPU. */
    *(volatile uint32_t *)0xE000ED88 |= 0xFu << 20;
    __asm__ volatile("dsb\nisb");
#endif
    if (host_has_timer()) {
        /* From close to its wrap, so that the frame crosses it. */
        HOST_COUNTER[0] = 200000;
        HOST_COUNTER[2] = 1 << 7 | 1 << 1;
    }
    main();
    host_exit(1);
}

void fault(void)
{
    host_text("fault\n");
    host_exit(1);
}
