//! `minefield`: mines and scrap metal in the ground of a zone, placed by the seed.

use rand_chacha::ChaCha8Rng;

use super::placing::{revealed, spread};
use super::{Field, Hazard, MinePassed, Object, ObjectClass, Passage, TruthPiece};
use crate::commands::FindKind;
use crate::mission::format::{FileTable, KindOf, number, table as table_of, whole};
use crate::mission::report::distance_m;
use crate::mission::weather::Weather;
use crate::mission::zone::Shape;
use crate::text;

/// The maximum number of objects; more would slow a step down.
const MOST_OBJECTS: f64 = 2000.0;

#[derive(Debug, Clone)]
struct Minefield {
    shape: Shape,
    counts: [(ObjectClass, u32); 4],
    gap_m: f64,
}

#[derive(Debug, Clone)]
struct Laid {
    objects: Vec<Object>,
    /// The number of mines that ground robots have cleared.
    cleared: usize,
}

/// How far to each side of a ground robot's middle its flail, or without one its wheels, reach a mine, in metres.
const FLAIL_REACHES_M: f64 = 1.5;
const WHEELS_REACH_M: f64 = 0.5;
/// The maximum speed at which a flail strikes every spot of the ground.
pub(super) const FLAIL_UP_TO_M_S: f64 = 1.2;

pub(super) const KIND: KindOf<Box<dyn Hazard>> = KindOf {
    name: "minefield",
    about: "mines and scrap metal in the ground of a zone",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn Hazard>> {
    let zone = table.need_task_zone();
    let mines = table.need(
        "count",
        table_of(read_mines),
        "numbers of mines, at least 1 in all; at most 2000 objects with the scrap metal",
    );
    let scrap = whole(0, 2000, "pieces");
    let clutter = table.or(
        "clutter",
        scrap,
        0,
        "pieces of scrap metal, which sensors may take for mines",
    );
    let gap_m = table.need(
        "min_gap",
        number(0.0, 100.0, "m"),
        "minimum distance between objects",
    );
    let (zone, mines, gap_m) = (zone?, mines?, gap_m?);
    let counts = [
        mines[0],
        mines[1],
        mines[2],
        (ObjectClass::Clutter, clutter),
    ];
    let count = |counts: &[(ObjectClass, u32)]| -> f64 {
        counts.iter().map(|(_, count)| f64::from(*count)).sum()
    };
    let all = count(&counts);
    if count(&mines) < 1.0 || all > MOST_OBJECTS {
        let fault = text!("fault-mines", most = MOST_OBJECTS.to_string());
        table.fault_of("count", fault);
    }
    let (low, high) = zone.shape.bounds();
    let area_m2 = (high[0] - low[0]) * (high[1] - low[1]);
    // Discs with a radius of half the gap would then cover more than about 79 % of the area: random placement cannot do
    // that.
    if all * gap_m * gap_m > area_m2 {
        let zone = &zone.id;
        let fault = text!("fault-mines-gap", zone = zone, count = all.to_string());
        table.fault_of("min_gap", fault);
    }
    Some(Box::new(Minefield {
        shape: zone.shape,
        counts,
        gap_m,
    }))
}

#[expect(
    clippy::unnecessary_wraps,
    reason = "readers of tables share one signature"
)]
fn read_mines(table: &mut FileTable<'_>) -> Option<[(ObjectClass, u32); 3]> {
    let mut count = |key, about| table.or(key, whole(0, 2000, ""), 0, about);
    Some([
        (
            ObjectClass::MetalMine,
            count("metal", "mines with a high metal content"),
        ),
        (
            ObjectClass::MinimumMetalMine,
            count("min_metal", "mines with a very low metal content"),
        ),
        (
            ObjectClass::SurfaceMine,
            count("surface", "mines on the surface"),
        ),
    ])
}

impl Hazard for Minefield {
    fn release(&self, _: &Weather, mut random: ChaCha8Rng) -> Box<dyn Field> {
        let all = self.counts.iter().map(|(_, count)| *count as usize).sum();
        let places = spread(&self.shape, all, self.gap_m, Vec::new(), &mut random);
        let classes = self
            .counts
            .iter()
            .flat_map(|&(class, count)| (0..count).map(move |_| class));
        let objects = classes.zip(places);
        Box::new(Laid {
            objects: objects.map(|(class, at)| Object::new(class, at)).collect(),
            cleared: 0,
        })
    }
}

impl Field for Laid {
    fn objects(&self) -> &[Object] {
        &self.objects
    }

    /// A flail that is slow enough clears every mine that it reaches; a mine that it misses goes off under the wheels.
    fn pass(&mut self, robot: Passage) -> Option<MinePassed> {
        let flails = robot.has_flail && robot.speed_m_s <= FLAIL_UP_TO_M_S;
        let reach_m = if flails {
            FLAIL_REACHES_M
        } else {
            WHEELS_REACH_M
        };
        let is_mine = |object: &&mut Object| object.class.kind() == Some(FindKind::Mine);
        let mut mines = self.objects.iter_mut().filter(is_mine);
        let mine = mines.find(|it| it.present && distance_m(it.at, robot.at) <= reach_m)?;
        mine.present = false;
        self.cleared += usize::from(flails);
        Some(if flails {
            MinePassed::Cleared
        } else {
            MinePassed::SetOff
        })
    }

    fn cleared(&self) -> usize {
        self.cleared
    }

    fn truth(&self) -> Vec<TruthPiece> {
        revealed(&self.objects)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;

    fn laid(seed: u64) -> Box<dyn Field> {
        let field = Minefield {
            shape: Shape::Polygon(vec![[0.0, 0.0], [60.0, 0.0], [60.0, 40.0], [0.0, 40.0]]),
            counts: [
                (ObjectClass::MetalMine, 6),
                (ObjectClass::MinimumMetalMine, 4),
                (ObjectClass::SurfaceMine, 3),
                (ObjectClass::Clutter, 9),
            ],
            gap_m: 5.0,
        };
        field.release(&Weather::CALM, ChaCha8Rng::seed_from_u64(seed))
    }

    #[test]
    fn the_seed_lays_all_of_them_in_the_zone_with_the_gap() {
        for seed in 0..50 {
            let field = laid(seed);
            let objects = field.objects();
            assert_eq!(objects.len(), 22);
            let mines = objects
                .iter()
                .filter(|object| object.class.kind() == Some(FindKind::Mine));
            assert_eq!(mines.count(), 13);
            for (index, object) in objects.iter().enumerate() {
                let [east, north] = object.at;
                assert!((0.0..=60.0).contains(&east) && (0.0..=40.0).contains(&north));
                for other in &objects[..index] {
                    assert!(distance_m(object.at, other.at) >= 5.0, "seed {seed}");
                }
            }
        }
    }

    #[test]
    fn another_seed_lays_another_field_and_the_same_seed_the_same() {
        assert_eq!(laid(1).objects(), laid(1).objects());
        assert_ne!(laid(1).objects(), laid(2).objects());
    }

    #[test]
    fn a_slow_flail_clears_a_mine_once_and_fast_or_bare_wheels_set_it_off() {
        for (speed_m_s, has_flail, passed) in [
            (1.0, true, MinePassed::Cleared),
            (2.0, true, MinePassed::SetOff),
            (1.0, false, MinePassed::SetOff),
        ] {
            let mut field = laid(3);
            let [east, north] = field.objects()[0].at;
            let at = |aside_m: f64| Passage {
                at: [east + aside_m, north],
                speed_m_s,
                has_flail,
            };
            assert_eq!(field.pass(at(1.6)), None);
            assert_eq!(field.pass(at(0.4)), Some(passed));
            assert_eq!(field.pass(at(0.4)), None, "it is gone");
            assert!(!field.objects()[0].present);
            let cleared = usize::from(passed == MinePassed::Cleared);
            assert_eq!(field.cleared(), cleared);
        }
    }

    #[test]
    fn scrap_does_not_go_off() {
        let mut field = laid(3);
        let scrap = field
            .objects()
            .iter()
            .find(|it| it.class == ObjectClass::Clutter);
        let robot = Passage {
            at: scrap.expect("there is some").at,
            speed_m_s: 3.0,
            has_flail: false,
        };
        assert_eq!(field.pass(robot), None);
    }
}
