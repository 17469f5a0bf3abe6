//! Measurements over time, interpolated between their samples.

/// `N` numbers at ascending times, in seconds.
#[derive(Debug, Clone, PartialEq)]
pub struct Series<const N: usize> {
    samples: Vec<(f64, [f64; N])>,
}

impl<const N: usize> Default for Series<N> {
    fn default() -> Self {
        Self {
            samples: Vec::new(),
        }
    }
}

impl<const N: usize> Series<N> {
    /// Appends a sample; one that is older than the last is left out.
    pub fn push(&mut self, at_s: f64, values: [f64; N]) {
        if self.samples.last().is_none_or(|(last, _)| *last < at_s) {
            self.samples.push((at_s, values));
        }
    }

    pub fn last(&self) -> Option<(f64, [f64; N])> {
        self.samples.last().copied()
    }

    pub fn first(&self) -> Option<(f64, [f64; N])> {
        self.samples.first().copied()
    }

    /// The values at a time, on the line between the samples around it; `None` before the first and after the last.
    pub fn at(&self, at_s: f64) -> Option<[f64; N]> {
        let next = self.samples.partition_point(|(at, _)| *at < at_s);
        let (later_at, later) = self.samples.get(next)?;
        if *later_at <= at_s {
            return Some(*later);
        }
        let (earlier_at, earlier) = self.samples.get(next.checked_sub(1)?)?;
        let share = (at_s - earlier_at) / (later_at - earlier_at);
        Some(std::array::from_fn(|place| {
            earlier[place] + share * (later[place] - earlier[place])
        }))
    }
}
