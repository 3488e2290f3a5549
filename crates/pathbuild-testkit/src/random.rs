//! Random numbers that depend only on a seed.

/// Deterministic pseudo-random numbers (`SplitMix64`).
#[derive(Clone, Debug)]
pub(crate) struct Random {
    state: u64,
}

impl Random {
    /// Creates a stream of numbers for a seed and a purpose.
    pub(crate) fn new(seed: u64, stream: u64) -> Self {
        let mut random = Self { state: seed };
        random.state ^= random.next().wrapping_add(stream.wrapping_mul(0xd134_2543_de82_ef95));
        random
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a whole number from 0 to `count` - 1.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        let below = self.next() % (count.max(1) as u64);
        usize::try_from(below).unwrap_or_default()
    }

    pub(crate) fn pick<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }

    /// Returns a random multiple of `step` from `low` to `high`.
    pub(crate) fn between(&mut self, low: f64, high: f64, step: f64) -> f64 {
        let mut steps = 1;
        while low + step * steps as f64 <= high + step * 1e-6 {
            steps += 1;
        }
        low + step * self.below(steps) as f64
    }

    /// Returns true with probability 1 / `count`.
    pub(crate) fn once_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }
}
