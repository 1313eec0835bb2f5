/* QEMU's mps2-an386 (Cortex-M4F, with a timer) and microbit (Cortex-M0, without): lamp, timer, semihosting. */
#include "host.h"

#define LEDS (*(volatile uint32_t *)0x40028000)

static uint32_t semihosting(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
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
