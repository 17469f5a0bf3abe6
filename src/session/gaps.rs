//! The parts of a file that have not been received yet.

use std::ops::Range;

/// Consecutive bytes of a file, and the offset of the first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileBytes {
    pub at: u32,
    pub bytes: Vec<u8>,
}

impl FileBytes {
    /// The range of the file that the bytes cover.
    pub fn range(&self) -> Range<u32> {
        self.at..self.at + self.bytes.len() as u32
    }

    /// Writes the bytes at their place in a file, which grows if it is shorter.
    pub fn write_to(&self, file: &mut Vec<u8>) {
        let range = self.range();
        let (start, end) = (range.start as usize, range.end as usize);
        if file.len() < end {
            file.resize(end, 0);
        }
        file[start..end].copy_from_slice(&self.bytes);
    }
}

/// The gaps of a file of known size: the ranges of missing bytes, in order, none adjacent to the next.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GapMap {
    size: u32,
    missing: Vec<Range<u32>>,
}

impl GapMap {
    /// A file that is missing completely.
    pub fn new(size: u32) -> Self {
        let mut map = Self {
            size,
            missing: Vec::new(),
        };
        map.open(0..size);
        map
    }

    /// A file of which only these ranges are missing; `None` if they are not in order or exceed the size.
    pub fn of_gaps(size: u32, missing: Vec<Range<u32>>) -> Option<Self> {
        let is_empty = |gap: &Range<u32>| gap.start >= gap.end;
        let is_in_order = missing.windows(2).all(|pair| pair[0].end < pair[1].start);
        let fits = missing.last().is_none_or(|last| last.end <= size);
        let is_sound = is_in_order && fits && !missing.iter().any(is_empty);
        is_sound.then_some(Self { size, missing })
    }

    /// The size of the whole file in bytes.
    pub fn size(&self) -> u32 {
        self.size
    }

    /// The gaps, in order.
    pub fn missing(&self) -> &[Range<u32>] {
        &self.missing
    }

    /// The number of missing bytes.
    pub fn missing_bytes(&self) -> u32 {
        self.missing.iter().map(|gap| gap.end - gap.start).sum()
    }

    pub fn is_complete(&self) -> bool {
        self.missing.is_empty()
    }

    /// The received share in percent, 0 to 100; 100 only if nothing is missing.
    pub fn percent(&self) -> u8 {
        if self.is_complete() {
            return 100;
        }
        let there = u64::from(self.size - self.missing_bytes());
        (there * 100 / u64::from(self.size)).min(99) as u8
    }

    /// Whether any byte of a range is missing.
    pub fn lacks(&self, stretch: &Range<u32>) -> bool {
        let at = self.missing.partition_point(|gap| gap.end <= stretch.start);
        let next = self.missing.get(at);
        stretch.start < stretch.end && next.is_some_and(|gap| gap.start < stretch.end)
    }

    /// Notes that a range was received; returns the number of new bytes. Bytes beyond the end are ignored.
    pub fn fill(&mut self, stretch: Range<u32>) -> u32 {
        let first = self.missing.partition_point(|gap| gap.end <= stretch.start);
        let behind = self.missing.partition_point(|gap| gap.start < stretch.end);
        if first >= behind || stretch.start >= stretch.end {
            return 0;
        }
        let before = self.missing[first].start..stretch.start;
        let after = stretch.end..self.missing[behind - 1].end;
        let touched: u32 = self.missing[first..behind]
            .iter()
            .map(|gap| gap.end - gap.start)
            .sum();
        let left: Vec<Range<u32>> = [before, after]
            .into_iter()
            .filter(|gap| gap.start < gap.end)
            .collect();
        let still: u32 = left.iter().map(|gap| gap.end - gap.start).sum();
        self.missing.splice(first..behind, left);
        touched - still
    }

    /// Whether filling a range would split a gap in two.
    pub fn splits(&self, stretch: &Range<u32>) -> bool {
        let at = self.missing.partition_point(|gap| gap.end <= stretch.start);
        let gap = self.missing.get(at);
        gap.is_some_and(|gap| gap.start < stretch.start && stretch.end < gap.end)
    }

    /// Notes that the file ends earlier: bytes beyond its end no longer count as missing.
    pub fn truncate(&mut self, size: u32) {
        self.size = self.size.min(size);
        let behind = self.missing.partition_point(|gap| gap.start < self.size);
        self.missing.truncate(behind);
        if let Some(last) = self.missing.last_mut() {
            last.end = last.end.min(self.size);
        }
    }

    /// Notes that a range is missing after all.
    pub fn open(&mut self, stretch: Range<u32>) {
        let stretch = stretch.start..stretch.end.min(self.size);
        if stretch.start >= stretch.end {
            return;
        }
        // Adjacent gaps are merged.
        let first = self.missing.partition_point(|gap| gap.end < stretch.start);
        let behind = self.missing.partition_point(|gap| gap.start <= stretch.end);
        let mut joined = stretch;
        for gap in &self.missing[first..behind] {
            joined = joined.start.min(gap.start)..joined.end.max(gap.end);
        }
        self.missing.splice(first..behind, [joined]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_stretch_in_the_middle_leaves_two_gaps() {
        let mut map = GapMap::new(100);
        assert_eq!(map.fill(40..60), 20);
        assert_eq!(map.missing(), [0..40, 60..100]);
        assert_eq!(map.fill(30..70), 20);
        assert_eq!(map.fill(0..30), 30);
        assert_eq!((map.percent(), map.missing_bytes()), (70, 30));
        assert_eq!(map.fill(70..200), 30);
        assert!(map.is_complete());
        assert_eq!(map.percent(), 100);
        map.open(90..200);
        assert_eq!(map.missing().first(), Some(&(90..100)));
    }

    #[test]
    fn an_empty_file_is_complete() {
        assert!(GapMap::new(0).is_complete());
        assert_eq!(GapMap::new(0).percent(), 100);
    }

    #[test]
    fn gaps_that_do_not_fit_are_none() {
        assert!(GapMap::of_gaps(10, vec![2..4, 6..10]).is_some());
        for gaps in [[2..4, 6..12], [4..6, 2..3], [2..2, 4..6], [2..4, 4..6]] {
            assert_eq!(GapMap::of_gaps(10, gaps.to_vec()), None);
        }
    }

    #[test]
    fn a_file_that_ends_earlier_lacks_nothing_behind_its_end() {
        let mut map = GapMap::new(100);
        map.fill(20..50);
        map.truncate(200);
        assert_eq!((map.size(), map.missing_bytes()), (100, 70));
        map.truncate(60);
        assert_eq!((map.size(), map.missing()), (60, &[0..20, 50..60][..]));
        map.truncate(50);
        assert_eq!((map.size(), map.missing_bytes()), (50, 20));
        map.truncate(0);
        assert!(map.is_complete());
    }

    #[derive(Debug, Clone)]
    enum Change {
        Fill(Range<u32>),
        Open(Range<u32>),
    }

    fn change() -> impl Strategy<Value = Change> {
        (0..260_u32, 0..60_u32, any::<bool>()).prop_map(|(start, len, fills)| {
            if fills {
                Change::Fill(start..start + len)
            } else {
                Change::Open(start..start + len)
            }
        })
    }

    proptest! {
        #[test]
        fn it_is_as_good_as_a_list_of_all_bytes(changes in proptest::collection::vec(change(), 0..60)) {
            const SIZE: usize = 250;
            let (mut map, mut bytes) = (GapMap::new(SIZE as u32), [true; SIZE]);
            for change in changes {
                let (stretch, is_missing) = match change.clone() {
                    Change::Fill(stretch) => (stretch, false),
                    Change::Open(stretch) => (stretch, true),
                };
                let within = (stretch.start as usize).min(SIZE)..(stretch.end as usize).min(SIZE);
                prop_assert_eq!(map.lacks(&stretch), bytes[within.clone()].contains(&true));
                let new = bytes[within.clone()].iter().filter(|byte| **byte).count();
                bytes[within].fill(is_missing);
                match change {
                    Change::Fill(stretch) => prop_assert_eq!(map.fill(stretch) as usize, new),
                    Change::Open(stretch) => map.open(stretch),
                }
                let known = GapMap::of_gaps(SIZE as u32, map.missing().to_vec());
                prop_assert_eq!(known.as_ref(), Some(&map));
                let missing = bytes.iter().filter(|byte| **byte).count();
                prop_assert_eq!(map.missing_bytes() as usize, missing);
            }
        }
    }
}
