/* Fires the leaf shutter's pulses after the edge of a camera's sync, on QEMU's boards; prints what run.sh compares. */
#include <stddef.h>
#include <stdint.h>

#include "camera.h"
#include "host.h"
#include "shutter.h"

enum { LEAF, FAST };

/* The tick at which each pulse came, counted from the edge. */
static uint32_t fired[LEAF_TRIGGERS];

/* Pulses of the ticks that are given, each at the delay and its tick after the edge. */
static void fire(uint32_t edge, const uint32_t *ticks, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        uint32_t due = leaf_due(edge, ticks[i]);
        while ((int32_t)(host_now() - due) < 0) {
        }
        fired[i] = host_now() - edge;
        host_pulse();
    }
}

static void print_frame(uint32_t speed, const uint32_t *ticks, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        uint32_t alone = 0;
        if (shutter_tick(speed, CAMERA_TIMER_HZ, n, i, &alone) != SHUTTER_OK || alone != ticks[i]) {
            host_exit(1);
        }
        host_number(ticks[i]);
        host_text("\n");
    }
}

/* Every refusal, by its code. */
static void refusals(void)
{
    uint32_t ticks[4];
    shutter_pulse pulses[4];
    const int32_t codes[] = {
        shutter_schedule(2, 1000000, 0, 4, ticks),
        shutter_schedule(LEAF, 1000000, 0, 4, NULL),
        shutter_schedule(LEAF, 1000000, 0, UINT32_MAX, ticks),
        shutter_schedule(LEAF, 1000000, 0, 4, (uint32_t *)((uintptr_t)ticks + 1)),
        shutter_schedule(LEAF, 0, 0, 4, ticks),
        shutter_schedule(LEAF, 1000000, 100000, 4, ticks),
        shutter_pulses(LEAF, 0.0f, 1000000, 0, 0, 4, pulses),
        shutter_pulses(LEAF, 0.5f, 1000000, 100000, 0, 4, pulses),
        shutter_pulses(LEAF, 0.5f, 1000000, 0, 100000, 4, pulses),
        shutter_tick(LEAF, 1000000, 4, 4, ticks),
        shutter_tick(LEAF, 1000000, UINT32_MAX, 4, ticks),
        shutter_schedule(LEAF, 1000000, 0, 0, NULL),
    };
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++) {
        host_number((uint32_t)-codes[i]);
        host_text(" ");
    }
    host_text("\n");
}

int main(void)
{
    static uint32_t ticks[LEAF_TRIGGERS];
    static shutter_pulse pulses[LEAF_TRIGGERS];
    if (shutter_schedule(LEAF, LEAF_TIMER_HZ, LEAF_TIMER_HZ / 10000, LEAF_TRIGGERS, ticks) != SHUTTER_OK) {
        host_exit(1);
    }
    print_frame(LEAF, ticks, LEAF_TRIGGERS);
    uint32_t fast[FAST_TRIGGERS];
    if (shutter_schedule(FAST, FAST_TIMER_HZ, 0, FAST_TRIGGERS, fast) != SHUTTER_OK) {
        host_exit(1);
    }
    print_frame(FAST, fast, FAST_TRIGGERS);
    if (shutter_pulses(LEAF, 0.3f, LEAF_TIMER_HZ, 1, 1, LEAF_TRIGGERS, pulses) != SHUTTER_OK) {
        host_exit(1);
    }
    for (uint32_t i = 0; i < LEAF_TRIGGERS; i++) {
        host_number(pulses[i].on);
        host_text(" ");
        host_number(pulses[i].off);
        host_text("\n");
    }
    refusals();
    if (host_has_timer()) {
        /* What a capture unit holds of the edge. The ticks are the header's this time. */
        fire(host_now() + 1000, leaf_ticks, LEAF_TRIGGERS);
        for (uint32_t i = 0; i < LEAF_TRIGGERS; i++) {
            host_text("fired ");
            host_number(fired[i]);
            host_text("\n");
        }
    }
    host_exit(0);
}
