//! `flood`: water that rises about houses with people on their roofs.
//!
//! The water stands at `level + rise t`. Who has no life vest when it reaches the roof is carried off by the current.

use std::time::Duration;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde::Deserialize;
use toml::Spanned;

use super::people::People;
use super::placing::spread;
use super::{Field, Hazard, Object, ObjectClass};
use crate::mission::Point;
use crate::mission::file::{Draft, Faults, Section};
use crate::mission::weather::Weather;
use crate::mission::zone::Shape;

const MOST_HOUSES: u32 = 500;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FloodFile {
    zone: Spanned<String>,
    houses: Spanned<u32>,
    people: Spanned<u32>,
    #[serde(default)]
    animals: u32,
    min_gap: Spanned<f64>,
    roofs: Spanned<[f64; 2]>,
    level: Spanned<f64>,
    rise: Spanned<f64>,
    #[serde(default)]
    nodes: Vec<Spanned<Point>>,
}

#[derive(Debug)]
struct Flood {
    shape: Shape,
    houses: usize,
    people: usize,
    animals: usize,
    gap_m: f64,
    roofs_m: [f64; 2],
    level_m: f64,
    rise_m_s: f64,
    nodes: Vec<Point>,
}

/// Reads a `[[hazards]]` of kind `flood`; `rise` is in metres a minute.
pub(crate) fn read(
    section: Section<'_>,
    draft: &Draft,
    faults: &mut Faults,
) -> Option<Box<dyn Hazard>> {
    let file: FloodFile = faults.read(section)?;
    let roofs_m = *file.roofs.get_ref();
    let level_m = faults.number(&file.level, -20.0..=100.0, "level");
    if !(level_m < roofs_m[0] && roofs_m[0] <= roofs_m[1] && roofs_m[1] <= 100.0) {
        let fault = "`roofs` must be [low, high], above `level` and up to 100 m";
        faults.add(file.roofs.span(), fault);
    }
    let (houses, inhabited) = (
        *file.houses.get_ref(),
        file.people.get_ref().saturating_add(file.animals),
    );
    if !(1..=MOST_HOUSES).contains(&houses) {
        let fault = format!("`houses` must lie between 1 and {MOST_HOUSES}");
        faults.add(file.houses.span(), fault);
    }
    if *file.people.get_ref() < 1 || inhabited > houses {
        let fault = "there must be somebody, and a house for each of `people` and `animals`";
        faults.add(file.people.span(), fault);
    }
    let nodes = file.nodes.iter();
    Some(Box::new(Flood {
        shape: draft.task_zone(&file.zone, faults)?.shape.clone(),
        houses: houses as usize,
        people: *file.people.get_ref() as usize,
        animals: file.animals as usize,
        gap_m: faults.number(&file.min_gap, 0.0..=1000.0, "min_gap"),
        roofs_m,
        level_m,
        rise_m_s: faults.number(&file.rise, 0.0..=60.0, "rise") / 60.0,
        nodes: nodes.map(|node| faults.point(node, "nodes")).collect(),
    }))
}

impl Flood {
    /// When the water reaches a height; `None` where it never does.
    fn reaches(&self, height_m: f64) -> Option<Duration> {
        let seconds = (height_m - self.level_m) / self.rise_m_s;
        Duration::try_from_secs_f64(seconds).ok()
    }
}

impl Hazard for Flood {
    fn release(&self, _: &Weather, mut random: ChaCha8Rng) -> Box<dyn Field> {
        let houses = spread(
            &self.shape,
            self.houses,
            self.gap_m,
            Vec::new(),
            &mut random,
        );
        let mut people = People::new(self.nodes.clone());
        for (index, at) in houses.into_iter().enumerate() {
            let [low, high] = self.roofs_m;
            let height_m = low + (high - low) * random.random::<f64>();
            let on_roof = |class| Object {
                height_m,
                ..Object::new(class, at)
            };
            if index < self.people {
                people.add(on_roof(ObjectClass::Person), self.reaches(height_m));
            } else if index < self.people + self.animals {
                people.objects.push(on_roof(ObjectClass::Animal));
            }
        }
        Box::new(people)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::super::Load;
    use super::*;

    fn flooded() -> Box<dyn Field> {
        let hazard = Flood {
            shape: Shape::Circle {
                center: [0.0, 0.0],
                radius_m: 100.0,
            },
            houses: 8,
            people: 3,
            animals: 1,
            gap_m: 20.0,
            roofs_m: [3.0, 5.0],
            level_m: 1.0,
            rise_m_s: 0.5 / 60.0,
            nodes: vec![[0.0, -150.0]],
        };
        hazard.release(&Weather::CALM, ChaCha8Rng::seed_from_u64(4))
    }

    #[test]
    fn the_water_takes_whoever_has_no_vest_when_it_reaches_the_roof() {
        let mut field = flooded();
        let roofs: Vec<f64> = field
            .objects()
            .iter()
            .map(|object| object.height_m)
            .collect();
        let saved = field.objects()[0].at;
        assert!(
            field
                .affect(Load::Kit, saved)
                .is_some_and(|effect| effect.good)
        );
        for second in (0..600).step_by(10) {
            field.step(Duration::from_secs(second), &Weather::CALM);
            let level_m = 1.0 + 0.5 * second as f64 / 60.0;
            for (index, object) in field.objects().iter().enumerate() {
                let safe = index == 0 || object.class == ObjectClass::Animal;
                assert_eq!(object.present, safe || level_m < roofs[index], "{second} s");
            }
        }
        let care = field.care().unwrap_or_default();
        assert_eq!((care.people, care.helped, care.lost), (3, 1, 2));
    }

    #[test]
    fn a_node_counts_once_at_its_place() {
        let mut field = flooded();
        let mut placed = |at| {
            field
                .affect(Load::Node, at)
                .is_some_and(|effect| effect.good)
        };
        assert!(!placed([0.0, -143.0]));
        assert!(placed([0.0, -145.0]));
        assert!(!placed([0.0, -145.0]));
    }
}
