/* Schedules of shutter-curve for firmware in C99 and C++11. Nothing is allocated, and nothing is kept between two calls: any
 * of them may be called from an interrupt. Ticks count from the start of opening, timer_hz of them in a second. */
#ifndef SHUTTER_H
#define SHUTTER_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What each function returns: SHUTTER_OK, or why nothing was scheduled. What it was to fill is not to be used then. */
enum {
    SHUTTER_OK = 0,
    SHUTTER_NO_SPEED = -1,        /* there are not so many speeds */
    SHUTTER_NO_ROOM = -2,         /* a null pointer, one that is not aligned, or more than half of the memory */
    SHUTTER_RATE_ZERO = -3,       /* timer_hz is 0 */
    SHUTTER_RATE_TOO_HIGH = -4,   /* the shutter's interval has more than 2^31 ticks */
    SHUTTER_GAP = -5,             /* two triggers come closer than min_gap ticks */
    SHUTTER_DUTY = -6,            /* duty is not above 0 and at most 1 */
    SHUTTER_PULSE_TOO_SHORT = -7, /* a pulse is shorter than min_pulse ticks */
    SHUTTER_NO_TRIGGER = -8,      /* the frame has no trigger i */
    SHUTTER_OTHER = -9,           /* what this header does not know yet */
    SHUTTER_TOO_MANY = -10        /* a frame has at most 4194304 triggers */
};

typedef struct {
    uint32_t on;
    uint32_t off;
} shutter_pulse;

/* A frame of n triggers, each in the middle of an equal share of the exposure, no two closer than min_gap ticks. `speed` is a
 * place in the array of speeds that the library was built with. */
int32_t shutter_schedule(uint32_t speed, uint32_t timer_hz, uint32_t min_gap, uint32_t n, uint32_t *ticks);

/* Trigger i of a frame of n alone, for a handler that has no room for a frame. No gap is checked. */
int32_t shutter_tick(uint32_t speed, uint32_t timer_hz, uint32_t n, uint32_t i, uint32_t *tick);

/* A frame of n pulses of equal doses for a shutter in the light's path: the lamp is on for the part `duty` of each share, for
 * at least min_pulse ticks, and dark for at least min_gap ticks between two. */
int32_t shutter_pulses(uint32_t speed, float duty, uint32_t timer_hz, uint32_t min_pulse, uint32_t min_gap, uint32_t n,
                       shutter_pulse *pulses);

#ifdef __cplusplus
}
#endif

#endif
