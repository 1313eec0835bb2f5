/* QEMU's mps2-an386 (Cortex-M4F, with a timer) and microbit (Cortex-M0, without): start, timer, semihosting. */
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

#define LEDS (*(volatile uint32_t *)0x40028000)

static uint32_t semihosting(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

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

int host_has_timer(void)
{
#ifdef __ARM_FP
    return 1;
#else
    return 0;
#endif
}

void host_pulse(void)
{
    LEDS = 1;
    LEDS = 0;
}

void host_text(const char *text)
{
    semihosting(0x04, text);
}

void host_number(uint32_t number)
{
    char text[11];
    char *at = text + sizeof text;
    *--at = 0;
    do {
        *--at = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    host_text(at);
}

void host_exit(int code)
{
    const uint32_t stopped[] = {0x20026, (uint32_t)code};
    semihosting(0x20, stopped);
    for (;;) {
    }
}
