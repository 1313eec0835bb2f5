//! The ticks of a whole frame. What answers one trigger mostly answers the next ones as well: that is asked once for
//! all of these, and their fractions, which are equally far apart, are sums.

use crate::by_u64::Direct;
use crate::fraction::{Edge, Words};
use crate::ticks::Ticks;

/// A schedule that is being filled.
struct Schedule<'t> {
    /// The places that are left.
    places: &'t mut [u32],
    /// The least tick for the next one.
    earliest: u32,
    min_gap: u32,
}

impl Schedule<'_> {
    /// Fills the next `count` places, or all that are left, with the ticks of successive words. If one comes too soon:
    /// how many places are left after its own.
    #[inline(always)]
    fn fill(
        &mut self,
        count: u32,
        mut words: Words,
        tick_of: impl Fn(u32) -> u32,
    ) -> Result<(), usize> {
        let places = core::mem::take(&mut self.places);
        let count = places.len().min(usize::try_from(count).unwrap_or(usize::MAX));
        let Some((places, rest)) = places.split_at_mut_checked(count) else { return Ok(()) };
        let (mut places, mut earliest) = (places.iter_mut(), self.earliest);
        while let Some(place) = places.next() {
            let tick = tick_of(words.word);
            if tick < earliest {
                return Err(places.len() + rest.len());
            }
            *place = tick;
            // A sum beyond 32 bits is beyond all ticks.
            earliest = tick.saturating_add(self.min_gap);
            words.step();
        }
        (self.places, self.earliest) = (rest, earliest);
        Ok(())
    }
}

impl<const CELLS: usize> Ticks<'_, CELLS> {
    /// The ticks of [`at`](Self::at), one after the other, as long as they keep the gap. Else the trigger that does not.
    pub(crate) fn fill(&self, ticks: &mut [u32], min_gap: u32) -> Result<(), u32> {
        let Self { plan, fractions, plateau, .. } = self;
        let mut schedule = Schedule { places: ticks, earliest: 0, min_gap };
        while !schedule.places.is_empty() {
            let i = self.n() - schedule.places.len() as u32;
            let (u, words) = fractions.words(i.wrapping_mul(2) | 1);
            let scale = self.scale.as_ref();
            let direct = scale.and_then(|scale| Some((scale, plan.direct_u64(u, plateau)?)));
            let filled = match direct {
                Some((scale, Direct::Line)) => {
                    let count = fractions.within(plan.line_reaches(u, plateau));
                    schedule.fill(count, words, |word| scale.tick(plan.on_line(word)))
                }
                Some((scale, Direct::Octave(octave))) if fractions.are_many(octave.zeros) => {
                    let count = fractions.within(plan.octave_reaches(u, &octave, plateau));
                    let words = words.moved(octave.zeros, octave.less, octave.ahead);
                    schedule.fill(count, words, |word| scale.tick(octave.time_ahead(word)))
                }
                direct => {
                    let tick = match direct {
                        Some((scale, Direct::Octave(octave))) => scale.tick(octave.time(u)),
                        _ => self.searched(2 * i as u64 + 1, &Edge::TRIGGER),
                    };
                    schedule.fill(1, words, |_| tick)
                }
            };
            filled.map_err(|left| self.n() - 1 - left as u32)?;
        }
        Ok(())
    }
}
