//! The iterators over a frame, which is the triggers or the pulses of one exposure: any item in constant time, from
//! either end.

/// The iterator `$name`, whose fields are a `frame`, of which item `i` is `frame.at(i)`, and the range of those that
/// are `left`.
macro_rules! iterate {
    ($name:ident, $item:ty) => {
        impl<const OCTAVES: usize> Iterator for $name<'_, OCTAVES> {
            type Item = $item;

            // Inlined into the caller's loop: most programs have only one, so the code is there once.
            #[inline(always)]
            fn next(&mut self) -> Option<$item> {
                let i = self.left.next()?;
                Some(self.frame.at(i))
            }

            #[inline]
            fn nth(&mut self, n: usize) -> Option<$item> {
                let i = self.left.nth(n)?;
                Some(self.frame.at(i))
            }

            #[inline]
            fn size_hint(&self) -> (usize, Option<usize>) {
                self.left.size_hint()
            }

            #[inline]
            fn count(self) -> usize {
                self.left.count()
            }

            #[inline]
            fn last(mut self) -> Option<$item> {
                self.next_back()
            }
        }

        impl<const OCTAVES: usize> DoubleEndedIterator for $name<'_, OCTAVES> {
            #[inline]
            fn next_back(&mut self) -> Option<$item> {
                let i = self.left.next_back()?;
                Some(self.frame.at(i))
            }

            #[inline]
            fn nth_back(&mut self, n: usize) -> Option<$item> {
                let i = self.left.nth_back(n)?;
                Some(self.frame.at(i))
            }
        }

        impl<const OCTAVES: usize> ExactSizeIterator for $name<'_, OCTAVES> {
            // `usize::MAX` where there are more: a `usize` may have 16 bits.
            #[inline]
            fn len(&self) -> usize {
                self.left.size_hint().0
            }
        }

        impl<const OCTAVES: usize> core::iter::FusedIterator for $name<'_, OCTAVES> {}

        impl<const OCTAVES: usize> core::fmt::Debug for $name<'_, OCTAVES> {
            fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                let mut out = out.debug_struct(stringify!($name));
                out.field("left", &self.left).finish_non_exhaustive()
            }
        }

        #[cfg(feature = "defmt")]
        impl<const OCTAVES: usize> defmt::Format for $name<'_, OCTAVES> {
            fn format(&self, out: defmt::Formatter<'_>) {
                let (name, left) = (stringify!($name), &self.left);
                defmt::write!(out, "{=str} {{ left: {}..{}, .. }}", name, left.start, left.end);
            }
        }
    };
}
pub(crate) use iterate;
