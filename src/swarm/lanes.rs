//! The division of parallel lines over an area among vehicles.

pub(super) use crate::plan::pattern::Lane;

/// Divides a row of lanes into `count` adjacent shares, none of them empty, as equal in length as
/// whole lanes allow. There must be at least `count` lanes.
pub(super) fn shares(lanes: &[Lane], count: usize) -> Vec<Vec<Lane>> {
    let total: f64 = lanes.iter().map(Lane::length_m).sum();
    let mut cuts = vec![0];
    let (mut at, mut flown) = (0, 0.0);
    for share in 1..count {
        let goal = total * share as f64 / count as f64;
        let last = lanes.len() - (count - share);
        // A lane belongs to the share in which its middle lies.
        while at < last && (at <= cuts[share - 1] || flown + lanes[at].length_m() / 2.0 <= goal) {
            flown += lanes[at].length_m();
            at += 1;
        }
        cuts.push(at);
    }
    cuts.push(lanes.len());
    cuts.windows(2)
        .map(|cut| lanes[cut[0]..cut[1]].to_vec())
        .collect()
}

/// The side and the end at which the shares begin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Start {
    pub last_lane: bool,
    pub far_end: bool,
}

impl Start {
    pub const ALL: [Self; 4] = [
        Self::new(false, false),
        Self::new(false, true),
        Self::new(true, false),
        Self::new(true, true),
    ];

    const fn new(last_lane: bool, far_end: bool) -> Self {
        Self { last_lane, far_end }
    }

    /// A share in the order and the directions in which it is flown: to and fro.
    pub fn order(self, share: &[Lane]) -> Vec<Lane> {
        let mut lanes = share.to_vec();
        if self.last_lane {
            lanes.reverse();
        }
        for (index, lane) in lanes.iter_mut().enumerate() {
            if self.far_end != (index % 2 == 1) {
                *lane = lane.reversed();
            }
        }
        lanes
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use proptest::prelude::*;

    use super::*;
    use crate::plan::pattern::{course, lanes};

    /// Stars of any depth: most of them are concave.
    fn polygon() -> impl Strategy<Value = Vec<DVec2>> {
        proptest::collection::vec(10.0..150.0f64, 3..12).prop_map(|radii| {
            let count = radii.len() as f64;
            let corner =
                |(index, radius): (usize, f64)| course(index as f64 / count * 360.0) * radius;
            radii.into_iter().enumerate().map(corner).collect()
        })
    }

    proptest! {
        #[test]
        fn shares_are_whole_and_differ_from_the_mean_by_a_lane_at_most(
            corners in polygon(),
            spacing in 3.0..15.0f64,
            count in 1usize..9,
        ) {
            let lanes = lanes(&corners, spacing, None).expect("lanes");
            prop_assume!(lanes.len() >= count);
            let shares = shares(&lanes, count);
            prop_assert_eq!(shares.len(), count);
            prop_assert_eq!(shares.concat(), lanes.clone());
            let length = |lanes: &[Lane]| lanes.iter().map(Lane::length_m).sum::<f64>();
            let longest = lanes.iter().map(Lane::length_m).fold(0.0, f64::max);
            let mean = length(&lanes) / count as f64;
            for share in &shares {
                prop_assert!(!share.is_empty());
                prop_assert!(length(share) <= mean + longest + 1e-6);
            }
        }
    }
}
