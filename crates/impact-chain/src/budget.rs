//! Bounds the number of events within one unit of time.

/// The largest mean number of events per gap within one unit of time 1/ω; beyond it a run is given
/// up. A hot chain has about one impact per gap; a chatter with r = 0.99 takes some 2500.
const EVENTS_PER_GAP: u64 = 100_000;

/// The events that a run may still have within the current unit of time.
#[derive(Clone, Debug)]
pub struct Budget<T> {
    /// The events that a run may have within one unit of time.
    pub bound: u64,
    left: u64,
    end: T,
}

impl<T: PartialOrd> Budget<T> {
    /// Creates the budget of a chain whose first unit of time has this end.
    pub fn new(gaps: usize, end: T) -> Self {
        let bound = EVENTS_PER_GAP * gaps as u64;
        Budget { bound, left: bound, end }
    }

    /// Takes an event at the time `now`, after which a unit of time would end at `next_end`;
    /// returns false if there is none left.
    #[inline(always)]
    pub fn spend(&mut self, now: T, next_end: impl FnOnce() -> T) -> bool {
        if now >= self.end {
            (self.end, self.left) = (next_end(), self.bound);
        }
        let has_left = self.left > 0;
        self.left -= u64::from(has_left);
        has_left
    }
}
