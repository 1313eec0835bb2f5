/* The emulated board, and what it says to the host. */
#ifndef HOST_H
#define HOST_H

#include <stdint.h>

/* Has the board the timer of mps2-an386? */
int host_has_timer(void);
/* Its count, 25 MHz, wrapping: the CMSDK dual timer's first half, which counts downwards. In place, for every instruction
 * between two looks makes a pulse later. */
#define HOST_COUNTER ((volatile uint32_t *)0x40002000)
static inline uint32_t host_now(void)
{
    return ~HOST_COUNTER[1];
}
/* The lamp's line, up and down. */
void host_pulse(void);
void host_text(const char *text);
void host_number(uint32_t number);
void host_exit(int code) __attribute__((noreturn));

#endif
